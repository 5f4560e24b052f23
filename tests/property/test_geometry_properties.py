"""What holds for every smooth curve and every simple outline, not only for chosen ones."""

from __future__ import annotations

import io

import numpy as np
import pytest
import shapely
from ezdxf.filemanagement import read
from geometry_shapes import both_ways, dense
from hypothesis import given, settings
from hypothesis import strategies as st

from springcad.export.dxf import part_to_dxf
from springcad.geometry.biarc import exact_polyline, fit_curve
from springcad.geometry.outline import Curve, Outline, Profile
from springcad.geometry.outline_ops import contour_area, contour_length, outline_corners
from springcad.geometry.polyline import (
    BulgePolyline,
    bounds,
    flatten,
    length,
    signed_area,
    turned_round,
)
from springcad.geometry.transform import rotate
from springcad.result import Part

amplitudes = st.lists(st.floats(-0.12, 0.12), min_size=4, max_size=8)


def wavy_circle(harmonics, radius=10e-3, count=1500):
    """Closed smooth curve r(a) = R (1 + sum c_k cos(k a) / k), with exact tangents."""
    angle = np.linspace(0.0, 2.0 * np.pi, count)
    r, slope = np.ones_like(angle), np.zeros_like(angle)
    for k, c in enumerate(harmonics, start=2):
        r += c / k * np.cos(k * angle)
        slope -= c * np.sin(k * angle)
    outward = np.column_stack((np.cos(angle), np.sin(angle)))
    along = np.column_stack((-np.sin(angle), np.cos(angle)))
    points = radius * r[:, None] * outward
    tangents = slope[:, None] * outward + r[:, None] * along
    points[-1], tangents[-1] = points[0], tangents[0]
    return Curve(points, tangents / np.hypot(*tangents.T)[:, None])


@settings(max_examples=25)
@given(amplitudes, st.sampled_from([1e-5, 2e-6, 3e-7]))
def test_a_fit_is_smooth_and_within_its_tolerance(harmonics, tolerance):
    curve = wavy_circle(harmonics)
    pieces = fit_curve(curve, tolerance)
    fitted = np.concatenate([dense(piece, 100) for piece in pieces])
    model = flatten(exact_polyline(Outline((curve,))), 1e-9)
    # The chords of the dense points add less than 0.1 um.
    assert both_ways(fitted, np.vstack((model, model[:1]))) <= tolerance + 1e-7
    assert np.max(np.abs(outline_corners(Outline(pieces)))) < 1e-9


@settings(max_examples=25)
@given(amplitudes, st.floats(-3.0, 3.0))
def test_area_and_length_do_not_change_when_a_shape_is_turned(harmonics, angle):
    outline = Outline((wavy_circle(harmonics, count=200),))
    turned = rotate(outline, angle)
    assert contour_area(turned) == pytest.approx(contour_area(outline), rel=1e-12)
    assert contour_length(turned) == pytest.approx(contour_length(outline), rel=1e-12)


@st.composite
def bulge_polylines(draw):
    """Star-shaped polylines, each chord with its own bulge."""
    count = draw(st.integers(3, 9))
    radius = np.array(draw(st.lists(st.floats(5e-3, 15e-3), min_size=count, max_size=count)))
    bulge = draw(st.lists(st.floats(-0.9, 0.9), min_size=count, max_size=count))
    angle = 2.0 * np.pi * np.arange(count) / count
    points = radius[:, None] * np.column_stack((np.cos(angle), np.sin(angle)))
    return BulgePolyline(points, np.array(bulge))


@settings(max_examples=100)
@given(bulge_polylines())
def test_closed_forms_agree_with_a_fine_polygon(polyline):
    points = flatten(polyline, 1e-9)
    polygon = shapely.LinearRing(points)
    x, y = np.vstack((points, points[:1])).T
    area = 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
    assert length(polyline) == pytest.approx(polygon.length, rel=1e-6)
    assert signed_area(polyline) == pytest.approx(area, abs=1e-9 * polygon.length)
    assert bounds(polyline) == pytest.approx(polygon.bounds, abs=2e-9)
    assert signed_area(turned_round(polyline)) == pytest.approx(-signed_area(polyline), rel=1e-12)


@settings(max_examples=50)
@given(bulge_polylines())
def test_a_drawing_keeps_area_and_length(polyline):
    from springcad.geometry.biarc import polyline_outline

    part = Part("", "any", Profile(polyline_outline(polyline)), 1e-3, "steel")
    (entity,) = read(io.StringIO(part_to_dxf(part))).modelspace()
    table = np.array(entity.get_points("xyb"))
    again = BulgePolyline(table[:, :2] * 1e-3, table[:, 2])
    assert length(again) == pytest.approx(length(polyline), rel=1e-6)
    assert abs(signed_area(again)) == pytest.approx(
        abs(signed_area(polyline)), abs=2e-9 * length(polyline)
    )
