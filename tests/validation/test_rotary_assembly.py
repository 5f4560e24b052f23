"""Ring and camshaft as a shop cuts them: both drawings of S2 read back and put together."""

from __future__ import annotations

import math
from functools import cache

import ezdxf
import ezdxf.path
import numpy as np
import pytest
import shapely
import shapely.affinity
from rotary_cases import spring_of

from springcad.export.dxf import part_to_dxf
from springcad.kinds.rotary_flexure.design import Spring
from springcad.result import Part

BACKLASH = "camshaft.backlash=0.05 mm"
CHORD = 1e-7


def read_back(text: str) -> shapely.Polygon:
    """The part of a drawing: the outermost contour less those within it, in metres."""
    from io import StringIO

    contours = []
    for entity in ezdxf.read(StringIO(text)).modelspace():
        path = ezdxf.path.make_path(entity)
        points = np.array([(p.x, p.y) for p in path.flattening(1e3 * CHORD)])
        contours.append(shapely.Polygon(1e-3 * points))
    contours.sort(key=lambda polygon: -polygon.area)
    return shapely.Polygon(contours[0].exterior, [inner.exterior for inner in contours[1:]])


@cache
def parts(*overrides: str) -> tuple[Spring, shapely.MultiPolygon, shapely.Polygon]:
    """The spring, the inner ends of its flexures as drawn, and its camshaft as drawn."""
    spring = spring_of("S2", *overrides)
    drawn = (
        read_back(part_to_dxf(Part("", "part", profile, 4.5e-3, "steel")))
        for profile in (spring.ring, spring.camshaft.profile)
    )
    ring, camshaft = drawn
    tips = ring.intersection(shapely.Point(0.0, 0.0).buffer(8e-3))
    return spring, tips, camshaft


def depth(tips: shapely.MultiPolygon, camshaft: shapely.Polygon, angle: float = 0.0) -> float:
    """How deep the camshaft, turned by ``angle``, stands in the tips anywhere, m."""
    turned = shapely.affinity.rotate(camshaft, angle, origin=(0.0, 0.0), use_radians=True)
    common = tips.intersection(turned)
    if common.is_empty:
        return 0.0
    points = shapely.points(shapely.get_coordinates(common))
    return float(max(shapely.distance(points, part.boundary).max() for part in (tips, turned)))


def test_at_rest_the_parts_only_touch() -> None:
    spring, tips, camshaft = parts()
    assert depth(tips, camshaft) < spring.camshaft.slot.preload + 1e-6


def test_every_tooth_stands_between_two_tips() -> None:
    """On a circle just beyond the contact radius tips and teeth take turns, 24 of each."""
    spring, tips, camshaft = parts()
    radius = spring.law.inputs.contact_radius + 0.05e-3
    angle = np.linspace(0.0, 2.0 * math.pi, 36000, endpoint=False)
    circle = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    owners = []
    shapely.prepare(tips)
    shapely.prepare(camshaft)
    points = shapely.points(circle)
    for tip, tooth in zip(
        shapely.contains(tips, points), shapely.contains(camshaft, points), strict=True
    ):
        if tip != tooth and (not owners or owners[-1] != ("tip" if tip else "tooth")):
            owners.append("tip" if tip else "tooth")
    if owners[0] == owners[-1]:
        owners.pop()
    assert owners == ["tip", "tooth"] * 24


def test_at_rest_there_is_the_backlash_asked_for() -> None:
    """The camshaft turns until it presses: 0.05 mm in all at the contact radius."""
    _, tips, camshaft = parts(BACKLASH)
    assert depth(tips, camshaft) == 0.0
    travel = []
    for way in (1.0, -1.0):
        free, held = 0.0, 0.02
        while held - free > 1e-5:
            middle = 0.5 * (free + held)
            touches = depth(tips, camshaft, way * middle) > 0.0
            free, held = (free, middle) if touches else (middle, held)
        travel.append(6e-3 * free)
    assert sum(travel) == pytest.approx(0.05e-3, abs=2e-6)
    assert travel[0] == pytest.approx(travel[1], abs=1e-6)


@pytest.mark.parametrize("overrides", [(), (BACKLASH,)], ids=["tight", "backlash"])
def test_turned_to_full_load_the_deformed_tip_stands_on_its_flank(
    overrides: tuple[str, ...],
) -> None:
    """It touches the tooth as drawn, and cuts neither that tooth nor its neighbour."""
    spring, _, camshaft = parts(*overrides)
    for stroke in spring.strokes:
        turn = stroke.direction * (stroke.angle[-1] + spring.camshaft.slot.free_play)
        turned = shapely.affinity.rotate(camshaft, turn, origin=(0.0, 0.0), use_radians=True)
        contact = shapely.Point(np.array([31e-3, 0.0]) - stroke.full.point[0])
        assert contact.distance(turned.exterior) < 3e-6
