"""Curves become few arcs: within the tolerance, smooth, with ends and lengths kept."""

from __future__ import annotations

import numpy as np
import pytest
from geometry_shapes import both_ways, clothoid, dense, ellipse, finger_edges, finger_ring, sine

from springcad.geometry.biarc import (
    BulgePolyline,
    exact_polyline,
    fit_contour,
    fit_curve,
    fit_outline,
    polyline_outline,
)
from springcad.geometry.outline import Arc, Circle, Curve, Line, Outline
from springcad.geometry.outline_ops import largest_joint_gap, outline_corners, piece_end
from springcad.geometry.polyline import flatten, joint_turns, signed_area
from springcad.geometry.transform import backwards, mirror, rotate

CURVES = {
    "ellipse": ellipse(20e-3, 10e-3, 6000),
    "sine": sine(40e-3, 3e-3, 3.0, 6000),
    "clothoid": clothoid(30e-3, 3.0, 6000),
    "finger edge": finger_edges(count=6000)[0],
}


def chain(pieces):
    return np.concatenate([dense(piece, 300) for piece in pieces])


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("tolerance", [1e-5, 2e-6, 5e-7])
def test_no_point_of_the_fit_is_farther_from_the_curve_than_the_tolerance(name, tolerance):
    curve = CURVES[name]
    assert both_ways(chain(fit_curve(curve, tolerance)), curve.points) <= tolerance


@pytest.mark.parametrize("name", CURVES)
def test_the_fit_uses_the_tolerance_it_is_given(name):
    curve = CURVES[name]
    assert both_ways(chain(fit_curve(curve, 2e-6)), curve.points) > 1e-6


@pytest.mark.parametrize("name", CURVES)
def test_arcs_meet_smoothly_and_the_ends_are_kept(name):
    curve = CURVES[name]
    pieces = fit_curve(curve)
    turns = outline_corners(Outline(pieces))[1:]
    assert np.max(np.abs(turns)) < 1e-9
    for side, index in ((0.0, 0), (1.0, -1)):
        piece = pieces[index]
        point, tangent = piece_end(piece, side)
        assert np.hypot(*(point - curve.points[index])) < 1e-12
        assert np.hypot(*(tangent - curve.tangents[index])) < 1e-9


@pytest.mark.parametrize("name", CURVES)
def test_the_number_of_arcs_grows_with_the_inverse_cube_root_of_the_tolerance(name):
    # A biarc deviates by the third power of its length.
    coarse, fine = (len(fit_curve(CURVES[name], tolerance)) for tolerance in (4e-9, 4e-9 / 64))
    assert np.log(fine / coarse) / np.log(64) == pytest.approx(1 / 3, abs=0.01)


def test_the_fit_converges_to_the_area_of_the_ellipse():
    outline = Outline((ellipse(20e-3, 10e-3, 6000),))
    errors = [
        abs(signed_area(fit_outline(outline, tolerance)) - np.pi * 2e-4)
        for tolerance in (1e-5, 1e-6, 1e-7)
    ]
    assert errors[0] < 1e-5 * 0.097  # tolerance times circumference
    assert errors[2] < 0.05 * errors[0]


def test_the_samples_themselves_converge_with_the_fourth_order():
    errors = [
        abs(signed_area(exact_polyline(Outline((ellipse(20e-3, 10e-3, n + 1),)))) - np.pi * 2e-4)
        for n in (50, 100, 200)
    ]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx([4.0, 4.0], abs=0.1)


def test_a_circle_given_as_a_curve_comes_back_as_arcs_of_that_circle():
    pieces = fit_curve(ellipse(5e-3, 5e-3, 400))
    assert len(pieces) <= 5
    for piece in pieces:
        assert isinstance(piece, Arc)
        assert piece.radius == pytest.approx(5e-3, rel=1e-9)


def test_a_straight_curve_is_one_line():
    points = np.column_stack((np.linspace(0.0, 0.03, 50), np.linspace(0.0, 0.01, 50)))
    direction = np.array([3.0, 1.0]) / np.sqrt(10.0)
    assert fit_curve(Curve(points, np.tile(direction, (50, 1)))) == (
        Line((0.0, 0.0), (0.03, 0.01)),
    )


def test_equal_tangents_across_a_shift_give_the_s_of_two_equal_arcs():
    curve = Curve(np.array([[0.0, 0.0], [2e-3, 1e-3]]), np.array([[1.0, 0.0], [1.0, 0.0]]))
    first, second = fit_curve(curve)
    assert isinstance(first, Arc)
    assert isinstance(second, Arc)
    assert first.sweep == pytest.approx(-second.sweep, rel=1e-12)
    assert first.radius == pytest.approx(second.radius, rel=1e-12)


def test_samples_too_coarse_for_any_biarc_are_refused():
    half_circle = Curve(np.array([[0.0, 0.0], [0.0, 1e-3]]), np.array([[1.0, 0.0], [1.0, 0.0]]))
    with pytest.raises(ValueError, match="turns too far"):
        fit_curve(half_circle)


def test_lines_and_arcs_pass_exactly_and_long_arcs_are_split():
    arc = Arc((1e-3, 2e-3), 3e-3, 0.3, 5.5)
    start, end = piece_end(arc, 0.0)[0], piece_end(arc, 1.0)[0]
    polyline = fit_outline(Outline((arc, Line(tuple(end), tuple(start)))))
    assert len(polyline.points) == 3
    assert polyline.bulges == pytest.approx([np.tan(5.5 / 8), np.tan(5.5 / 8), 0.0], rel=1e-15)
    segment = 0.5 * 9e-6 * (5.5 - np.sin(5.5))
    assert signed_area(polyline) == pytest.approx(segment, rel=1e-13)


def test_an_open_outline_is_refused():
    with pytest.raises(ValueError, match=r"open by 0\.001 m"):
        fit_outline(Outline((Line((0.0, 0.0), (1.0, 0.0)), Line((1.0, 0.001), (0.0, 0.0)))))


@pytest.mark.parametrize("name", CURVES)
def test_a_turned_or_mirrored_curve_gives_the_turned_or_mirrored_fit(name):
    curve = CURVES[name]
    for move in (lambda c: rotate(c, 0.7), lambda c: mirror(c, 0.4)):
        moved = chain(fit_curve(move(curve)))
        expected = chain([move(piece) for piece in fit_curve(curve)])
        assert np.max(np.abs(moved - expected)) < 1e-10


@pytest.mark.parametrize("name", CURVES)
def test_a_curve_run_through_backwards_gives_the_same_arcs(name):
    curve = CURVES[name]
    forth = fit_curve(curve)
    back = backwards(fit_curve(*backwards((curve,))))
    assert len(back) == len(forth)
    assert np.max(np.abs(chain(back) - chain(forth))) < 1e-10


def test_a_fitted_ring_is_closed_and_smooth_where_the_model_is():
    profile = finger_ring(fitted=True)
    outline = profile.inner[0]
    assert isinstance(outline, Outline)
    assert largest_joint_gap(outline) < 1e-12
    corners = np.abs(joint_turns(fit_contour(outline)))
    # Two sharp roots for each of 24 fingers; every other joint, noses included, is smooth to the
    # taper of 1.4 degrees, which the half circle of the nose does not follow.
    assert np.sum(corners > 0.03) == 48


def test_a_polyline_and_its_outline_are_the_same_line():
    polyline = fit_outline(Outline((ellipse(20e-3, 10e-3),)))
    again = fit_outline(polyline_outline(polyline))
    assert isinstance(again, BulgePolyline)
    assert np.max(np.abs(again.points - polyline.points)) < 1e-13
    assert np.max(np.abs(again.bulges - polyline.bulges)) < 1e-14


def test_a_circle_flattens_to_points_on_it_within_the_chord_tolerance():
    points = flatten(fit_contour(Circle((1.0, 2.0), 3e-2)), 1e-6)
    radius = np.hypot(points[:, 0] - 1.0, points[:, 1] - 2.0)
    chord = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    assert radius == pytest.approx(np.full(len(points), 3e-2), rel=1e-12)
    assert np.max(3e-2 - np.sqrt(9e-4 - 0.25 * chord**2)) <= 1e-6
