"""The pictures of a roller cam show it as the forward analysis says it is."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
import shapely

from springcad.geometry.outline import Curve, Profile
from springcad.geometry.outline_ops import contour_bounds, profile_polygon
from springcad.kinds.roller_cam.design import make_joint
from springcad.kinds.roller_cam.inputs import roller_spec
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.kinds.roller_cam.views import full_deflection, joint_views
from springcad.result import View
from springcad.spec.source import read_spec

SPEC = Path(__file__).parents[2] / "specs" / "roller-linear.yaml"
TEN_MICROMETRES = 1e-5


@cache
def made() -> MadeJoint:
    return make_joint(roller_spec(read_spec(SPEC, []).model), lambda _: None)


def shown(view: View, role: str) -> list[shapely.Polygon]:
    """The material of all shapes of a role."""
    contours = [shape.line for shape in view.shapes if shape.role == role]
    assert not any(isinstance(line, np.ndarray) for line in contours)
    profiles = [line if isinstance(line, Profile) else Profile(line) for line in contours]
    return [profile_polygon(profile) for profile in profiles]


def test_the_tip_moves_as_the_forward_analysis_says_and_the_mount_rests() -> None:
    joint, moved = made(), full_deflection(made())
    beam = joint.joint.cantilever
    tip, clamp, corner = moved(
        np.array([[0.0, 0.0], [-beam.length, 1e-3], [-beam.length - 5e-3, 6e-3]])
    )
    np.testing.assert_allclose(tip, joint.stroke.tip.displacement[-1], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(clamp, [-beam.length, 1e-3], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(corner, [-beam.length - 5e-3, 6e-3], rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("number", [0, 1])
def test_the_roller_touches_the_element_and_cuts_into_nothing(number: int) -> None:
    view = joint_views(made())[number]
    (element,), (mirrored, roller) = shown(view, "part"), shown(view, "mate")
    assert element.distance(roller) < TEN_MICROMETRES
    common = element.intersection(roller)
    assert common.area < TEN_MICROMETRES * 1e-3
    assert not mirrored.intersects(element)
    assert mirrored.intersection(roller).area < TEN_MICROMETRES * 1e-3


def test_at_rest_the_roller_touches_both_elements_alike() -> None:
    view = joint_views(made())[0]
    (element,), (mirrored, roller) = shown(view, "part"), shown(view, "mate")
    assert element.distance(roller) == pytest.approx(mirrored.distance(roller), abs=1e-7)
    assert element.area == pytest.approx(mirrored.area, rel=1e-9)


def test_bending_keeps_the_area_and_makes_no_new_corners() -> None:
    rest, turned = joint_views(made())[:2]
    (before,), (after,) = shown(rest, "part"), shown(turned, "part")
    assert after.area == pytest.approx(before.area, rel=2e-3)
    (bent,) = [shape.line.outer for shape in turned.shapes if shape.role == "part"]
    for piece in bent.pieces:
        assert isinstance(piece, Curve)
        chords = np.diff(piece.points, axis=0)
        aligned = np.sum(chords * piece.tangents[:-1], axis=1) / np.hypot(*chords.T)
        assert aligned.min() > 0.97


def test_along_the_drum_the_roller_turns_about_the_axis_of_the_drum() -> None:
    joint, view = made(), joint_views(made())[2]
    roller, angle = joint.joint.roller, joint.stroke.angle[-1]
    rest, turned = (shape.line for shape in view.shapes if shape.role == "moved")
    for disc, way in ((rest, 0.0), (turned, roller.drum_radius * np.sin(angle))):
        centre = 0.5 * (disc.min(axis=0) + disc.max(axis=0))
        assert centre[1] == pytest.approx(roller.offset - way, abs=1e-9)
        to_axis = centre - [-roller.drum_radius, roller.offset]
        assert np.hypot(*to_axis) == pytest.approx(roller.drum_radius, rel=1e-9)
    sheet = next(shape.line for shape in view.shapes if shape.role == "part")
    x0, y0, x1, y1 = contour_bounds(sheet)
    assert (x1 - x0) == pytest.approx(joint.joint.cantilever.width)
    assert (y0, y1) == pytest.approx(contour_bounds(joint.element.outer)[1::2])
