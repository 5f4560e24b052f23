"""Omega leaves as they are cut, and the pictures of the mechanism."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import shapely
from lever_cases import FITTINGS

from springcad.geometry.biarc import exact_polyline
from springcad.geometry.outline import Circle
from springcad.geometry.outline_ops import contour_points, profile_faults, profile_polygon
from springcad.geometry.polyline import joint_turns
from springcad.kinds.lever_arm.curved_foot import Room
from springcad.kinds.lever_arm.curved_part import curved_profile, hub_radius
from springcad.kinds.lever_arm.design import design_joint
from springcad.kinds.lever_arm.omega import OmegaLeaf, half_ribbon, half_start
from springcad.spec.source import read_spec

SPECS = Path(__file__).parents[2] / "specs"
WALL = 50e-3
CORRIDOR = 9.5e-3
"""The leaves were found for 12 mm: this and the room that the feet need for their fillets."""
FOLDED = OmegaLeaf(
    angle_coefficients=np.array(
        [-0.78623608, 0.5987827, 2.87488603, 1.67232378, -1.17328904, -1.22001967, -0.52307329,
         -4.9603705, -0.31211935, -1.79140715, -2.69064904]
    ),
    thickness_coefficients=np.array(
        [1.36399, 1.35867, 2.60523, 4.27196, 3.04065, 1.623, 2.72849, 2.36443, 3.78564, 4.47939]
    ) * 1e-3,
    length=0.193346539139,
    middle=0.0,
    hub_radius=4e-3,
)  # fmt: skip
"""A leaf of steel that a search found; it ends at 45 deg to the wall."""
THICK = OmegaLeaf(
    angle_coefficients=np.array(
        [0.30098116, 0.05856642, -0.60191837, -0.80447131, -0.72267766, -1.44490504, -2.26369651,
         -2.18675319, -2.13022506, -2.13116079, -2.14250796]
    ),
    thickness_coefficients=np.array(
        [5.50011, 8.61055, 7.90339, 5.99876, 5.02012, 8.60602, 12.2068, 15.8649, 18.36608, 19.84231]
    ) * 1e-3,
    length=0.103148351955,
    middle=0.036215255194,
    hub_radius=4e-3,
)  # fmt: skip
"""A leaf of POM, 20 mm thick where it ends."""
NAMED = {"folded": FOLDED, "thick": THICK}
LEAVES = pytest.mark.parametrize("name", NAMED)


@cache
def part(name: str, eye_wall: float = 2e-3):
    fittings = replace(FITTINGS, eye_wall=eye_wall)
    return curved_profile(NAMED[name], fittings, Room(WALL, 0.5 * CORRIDOR))


@LEAVES
def test_the_outline_is_one_symmetric_piece(name: str) -> None:
    profile = part(name)
    assert profile_faults(profile) == ()
    polygon = profile_polygon(profile)
    mirrored = shapely.transform(polygon, lambda points: points * [-1.0, 1.0])
    assert polygon.symmetric_difference(mirrored).area < 1e-9 * polygon.area + 1e-10
    assert len(profile.inner) == 1 + 2 * FITTINGS.hole_count


@LEAVES
def test_the_leaf_is_drawn_as_it_was_analysed(name: str) -> None:
    """Both edges between hub and foot, from the ribbon's own formula, lie on the outline."""
    leaf = NAMED[name]
    ribbon = half_ribbon(leaf)
    at = ribbon.at(np.linspace(0.15, 0.8, 40) * leaf.length)
    centre = np.column_stack([at.x, at.y]) + half_start(leaf) - [0.0, leaf.middle]
    normal = np.column_stack([-np.sin(at.angle), np.cos(at.angle)])
    boundary = profile_polygon(part(name)).exterior
    for side in (1.0, -1.0):
        points = centre + side * at.half_thickness[:, None] * normal
        assert shapely.distance(boundary, shapely.points(points)).max() < 2e-6


@LEAVES
def test_feet_are_outside_the_wall_and_aside_from_the_lever(name: str) -> None:
    profile, leaf = part(name), NAMED[name]
    points = contour_points(profile.outer) + np.array([0.0, leaf.middle])
    radius = np.hypot(*points.T)
    assert radius.max() == pytest.approx(WALL + FITTINGS.block_length, abs=1e-6)
    low = points[points[:, 1] < -0.5 * WALL]
    assert np.abs(low[:, 0]).min() > 0.5 * CORRIDOR - 1e-9
    for hole in profile.inner[1:]:
        assert isinstance(hole, Circle)
        x, y = hole.center
        place = float(np.hypot(x, y + leaf.middle))
        assert place == pytest.approx(WALL + 0.5 * FITTINGS.block_length)


@LEAVES
def test_inside_corners_are_round(name: str) -> None:
    """Every right turn of the counter-clockwise outline is part of an arc; corners turn left."""
    turns = joint_turns(exact_polyline(part(name).outer))
    assert turns.min() > -1e-3
    assert hub_radius(NAMED[name], FITTINGS) >= 4e-3


def test_a_larger_hub_swallows_more_of_the_leaf() -> None:
    wide = replace(FITTINGS, eye_wall=6e-3)
    assert profile_faults(part("folded", 6e-3)) == ()
    assert hub_radius(FOLDED, wide) == pytest.approx(8e-3)


@pytest.mark.parametrize("output", ["yoke", "crank-behind", "crank-ahead"])
def test_the_mechanism_is_shown_at_three_pivot_positions(output: str) -> None:
    """Lever, pivot and pins on one line, at rest and turned, the spring's pin on its guide."""
    spec = read_spec(SPECS / "lever-triangular.yaml", (f"mechanism.output={output}",))
    result = design_joint(spec, lambda _: None)
    assert [view.title[:11] for view in result.views] == [
        "Pivot at 5 ",
        "Pivot at 20",
        "Pivot at 35",
    ]
    for view, q in zip(result.views, (5e-3, 20e-3, 35e-3), strict=True):
        bars = [
            shape.line for shape in view.shapes
            if shape.role == "moved" and isinstance(shape.line, np.ndarray) and len(shape.line) == 2
        ]  # fmt: skip
        lever = next(bar for bar in bars if bar[1, 1] == pytest.approx(50e-3))
        first, second = lever[0] - [0.0, q], lever[1] - [0.0, q]
        assert first[0] * second[1] == pytest.approx(first[1] * second[0], abs=1e-12)
        assert lever[1, 0] == pytest.approx(8e-3)


def test_a_bent_leaf_is_as_long_as_before() -> None:
    """The centre lines that the views show: a leaf of steel hardly stretches."""
    spec = read_spec(SPECS / "lever-triangular.yaml")
    views = design_joint(spec, lambda _: None).views
    lines = [s.line for s in views[0].shapes if isinstance(s.line, np.ndarray) and len(s.line) > 9]
    rest, bent = (float(np.sum(np.hypot(*np.diff(line, axis=0).T))) for line in lines)
    assert rest == pytest.approx(70e-3)
    assert bent == pytest.approx(rest, rel=1e-3)
