"""Area, length, extent, joints, transforms, offsets: against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from geometry_shapes import clothoid, finger_ring, notched_circle, on_circle, polygon, toothed_shaft

from springcad.geometry.offset import fold_over, ribbon_edges
from springcad.geometry.outline import Arc, Circle, Curve, Line, Outline, Profile
from springcad.geometry.outline_ops import (
    contour_area,
    contour_bounds,
    contour_length,
    contour_points,
    largest_joint_gap,
    outline_corners,
    profile_area,
    profile_cut_length,
    profile_faults,
    profile_polygon,
    sharpest_joint,
)
from springcad.geometry.transform import backwards, mirror, rotate, translate

STADIUM = Outline(
    (
        Line((-2e-3, -1e-3), (2e-3, -1e-3)),
        Arc((2e-3, 0.0), 1e-3, -np.pi / 2, np.pi),
        Line((2e-3, 1e-3), (-2e-3, 1e-3)),
        Arc((-2e-3, 0.0), 1e-3, np.pi / 2, np.pi),
    )
)


def test_area_length_and_extent_of_a_stadium():
    assert contour_area(STADIUM) == pytest.approx(8e-6 + np.pi * 1e-6, rel=1e-14)
    assert contour_length(STADIUM) == pytest.approx(8e-3 + 2 * np.pi * 1e-3, rel=1e-14)
    assert contour_bounds(STADIUM) == pytest.approx((-3e-3, -1e-3, 3e-3, 1e-3), rel=1e-14)
    assert largest_joint_gap(STADIUM) < 1e-18
    assert np.max(np.abs(outline_corners(STADIUM))) < 1e-15


def test_area_and_length_of_a_circle_far_from_the_origin():
    circle = Circle((3.0, -7.0), 2e-3)
    assert contour_area(circle) == pytest.approx(np.pi * 4e-6, rel=1e-12)
    assert contour_length(circle) == pytest.approx(2 * np.pi * 2e-3, rel=1e-12)
    assert contour_bounds(circle) == pytest.approx((2.998, -7.002, 3.002, -6.998), abs=1e-15)


def test_area_of_a_circle_with_semicircular_notches():
    radius, notch, count = 33.5e-3, 1e-3, 8
    # The lens of two circles, one centred on the other.
    half = 2 * np.arcsin(0.5 * notch / radius)
    inner = np.arccos(0.5 * notch / radius)
    lens = radius**2 * (half - 0.5 * np.sin(2 * half)) + notch**2 * (
        inner - 0.5 * np.sin(2 * inner)
    )
    outline = notched_circle(radius, notch, count)
    assert contour_area(outline) == pytest.approx(np.pi * radius**2 - count * lens, rel=1e-13)


def test_profile_area_and_cut_length_count_the_holes():
    profile = Profile(Circle((0.0, 0.0), 3e-2), (Circle((1e-2, 0.0), 2e-3), STADIUM))
    assert profile_area(profile) == pytest.approx(
        np.pi * (9e-4 - 4e-6) - 8e-6 - np.pi * 1e-6, rel=1e-14
    )
    assert profile_cut_length(profile) == pytest.approx(
        2 * np.pi * (3e-2 + 2e-3 + 1e-3) + 8e-3, rel=1e-14
    )


def test_the_area_of_the_polygon_converges_linearly_with_the_chord_tolerance():
    profile = finger_ring()
    exact = profile_area(profile)
    errors = [abs(profile_polygon(profile, chord).area - exact) for chord in (4e-6, 1e-6, 2.5e-7)]
    assert errors[2] < 0.3 * errors[0]
    assert errors[2] < 2.5e-7 * profile_cut_length(profile)


def test_nearly_straight_arcs_lose_no_digits():
    rise = 1e-9
    radius = (25e-6 + rise**2) / (2 * rise)
    half = np.arcsin(5e-3 / radius)
    arc = Arc((0.0, rise - radius), radius, np.pi / 2 + half, -2 * half)
    outline = Outline(
        (
            arc,
            Line((5e-3, 0.0), (5e-3, -1e-3)),
            Line((5e-3, -1e-3), (-5e-3, -1e-3)),
            Line((-5e-3, -1e-3), (-5e-3, 0.0)),
        )
    )
    assert -contour_area(outline) == pytest.approx(1e-5 + 2 / 3 * 1e-2 * rise, rel=1e-12)
    assert contour_bounds(outline)[3] == pytest.approx(rise, rel=1e-6)
    assert len(contour_points(outline, 1e-6)) == 4


def test_moves_keep_area_and_length_and_mirroring_turns_the_sense():
    outline = finger_ring().inner[0]
    area, length = contour_area(outline), contour_length(outline)
    for moved, sign in (
        (rotate(outline, 0.3), 1.0),
        (translate(outline, 0.1, -0.2), 1.0),
        (mirror(outline, 1.1), -1.0),
        (Outline(backwards(outline.pieces)), -1.0),
    ):
        assert contour_area(moved) == pytest.approx(sign * area, rel=1e-10)
        assert contour_length(moved) == pytest.approx(length, rel=1e-12)
        assert largest_joint_gap(moved) < 1e-15


def test_points_move_where_they_should():
    line = Line((1.0, 0.0), (2.0, 0.0))
    assert rotate(line, np.pi / 2).end == pytest.approx((0.0, 2.0), abs=1e-15)
    assert translate(line, 1.0, 1.0) == Line((2.0, 1.0), (3.0, 1.0))
    assert mirror(line, np.pi / 4).end == pytest.approx((0.0, 2.0), abs=1e-15)
    assert rotate(Circle((1.0, 0.0), 3.0), np.pi).center == pytest.approx((-1.0, 0.0), abs=1e-15)
    moved = mirror(Profile(Circle((1.0, 0.0), 0.5), (Circle((1.0, 0.0), 0.1),)), np.pi / 2)
    assert moved.inner[0].center == pytest.approx((-1.0, 0.0), abs=1e-15)


def test_twice_mirrored_is_as_before():
    arc = Arc((1.0, 2.0), 3.0, 0.4, 1.2)
    again = mirror(mirror(arc, 0.3), 0.3)
    assert (again.start_angle, again.sweep) == pytest.approx((0.4, 1.2), rel=1e-14)
    assert again.center == pytest.approx((1.0, 2.0), rel=1e-14)


def test_the_edges_of_an_arc_shaped_ribbon_are_concentric_arcs():
    angle = np.linspace(0.0, 1.0, 40)
    normals = -np.column_stack((np.cos(angle), np.sin(angle)))
    line, ones = -10e-3 * normals, np.ones(40)
    left, right = ribbon_edges(line, normals, 100.0 * ones, 1e-3 * ones, 0.0 * ones)
    assert np.hypot(*left.points.T) == pytest.approx(9e-3 * ones, rel=1e-14)
    assert np.hypot(*right.points.T) == pytest.approx(11e-3 * ones, rel=1e-14)
    assert np.sum(left.tangents * left.points, axis=1) == pytest.approx(0.0 * ones, abs=1e-15)


def test_edge_tangents_are_the_derivatives_of_the_edges():
    count = 4001
    s = np.linspace(0.0, 20e-3, count)
    line = clothoid(20e-3, 1.5, count)
    normals = np.column_stack((-line.tangents[:, 1], line.tangents[:, 0]))
    curvature = 2 * 1.5 * s / 20e-3**2
    thickness = 1e-3 - 0.03 * s
    for edge in ribbon_edges(line.points, normals, curvature, thickness, np.full(count, -0.03)):
        numeric = edge.points[2:] - edge.points[:-2]
        numeric /= np.hypot(*numeric.T)[:, None]
        assert np.max(np.abs(numeric - edge.tangents[1:-1])) < 1e-7


def test_a_ribbon_bent_tighter_than_its_half_thickness_is_refused():
    assert fold_over(np.array([100.0, -700.0]), np.array([2e-3, 1e-3])) == pytest.approx(0.7)
    line = Curve(np.zeros((2, 2)), np.zeros((2, 2))).points
    normals = np.array([[0.0, 1.0], [0.0, 1.0]])
    with pytest.raises(ValueError, match="folds over"):
        ribbon_edges(line, normals, np.array([0.0, 1000.0]), np.full(2, 1e-3), np.zeros(2))


def test_sound_profiles_have_no_faults():
    assert profile_faults(finger_ring()) == ()
    assert profile_faults(toothed_shaft()) == ()


@pytest.mark.parametrize(
    ("profile", "words"),
    [
        (Profile(polygon((0, 0), (10, 10), (10, 0), (0, 8))), "outer contour cuts itself near x ="),
        (
            Profile(Circle((0, 0), 1e-2), (Circle((1e-2, 0), 1e-3),)),
            "inner contour 1 is not inside the outer contour",
        ),
        (
            Profile(Circle((0, 0), 1e-2), (Circle((0, 0), 2e-3), Circle((3e-3, 0), 2e-3))),
            "inner contour 2 meets inner contour 1",
        ),
        (
            Profile(Outline((Line((0, 0), (1, 0)), Line((1, 0), (1, 1)), Line((1, 1), (0, 1e-3))))),
            "outer contour is open by 1 mm",
        ),
        (Profile(Circle((0, np.nan), 1.0)), "outer contour has a coordinate"),
        (Profile(Circle((0, 0), 0.0)), "outer contour is a circle without a radius"),
        (
            Profile(Outline((Line((0, 0), (1, np.inf)), Line((1, np.inf), (0, 0))))),
            "outer contour has a coordinate that is not a finite number",
        ),
    ],
)
def test_faults_of_a_profile_are_named(profile, words):
    faults = profile_faults(profile)
    assert len(faults) == 1
    assert faults[0].startswith(words)


def test_a_sharp_joint_is_seen():
    corner = polygon((0, 0), (10, 0), (10, 10))
    assert sharpest_joint(corner) == pytest.approx(3 * np.pi / 4, rel=1e-12)
    assert outline_corners(corner)[1] == pytest.approx(np.pi / 2, rel=1e-12)
    assert sharpest_joint(Circle((0, 0), 1.0)) < 1e-15
    assert on_circle(1.0, 0.0) == (1.0, 0.0)
