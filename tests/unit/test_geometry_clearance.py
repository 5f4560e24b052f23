"""Webs, gaps and inside radii of shapes whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from geometry_shapes import finger_ring, on_circle, polygon, toothed_shaft

from springcad.geometry.biarc import fit_outline, polyline_outline
from springcad.geometry.clearance import (
    nearest,
    smallest_gap,
    smallest_inside_radius,
    smallest_web,
)
from springcad.geometry.outline import Arc, Circle, Line, Outline, Profile
from springcad.geometry.outline_ops import profile_polygon
from springcad.geometry.transform import rotate


def web(profile, **options):
    found = smallest_web(profile, **options)
    return found and found.distance * 1e3


def gap(profile, **options):
    found = smallest_gap(profile, **options)
    return found and found.distance * 1e3


def dumb_bell(neck_mm, radius_mm):
    """Two lobes joined by a neck between two circular bites."""
    reach = radius_mm + 0.5 * neck_mm
    corners = [(-10.0, -reach), (-radius_mm, -reach), (radius_mm, -reach), (10.0, -reach),
               (10.0, reach), (radius_mm, reach), (-radius_mm, reach), (-10.0, reach)]  # fmt: skip
    points = [(x * 1e-3, y * 1e-3) for x, y in corners]
    radius = radius_mm * 1e-3
    return Profile(
        Outline(
            (
                Line(points[0], points[1]),
                Arc((0.0, -reach * 1e-3), radius, np.pi, -np.pi),
                Line(points[2], points[3]),
                Line(points[3], points[4]),
                Line(points[4], points[5]),
                Arc((0.0, reach * 1e-3), radius, 0.0, -np.pi),
                Line(points[6], points[7]),
                Line(points[7], points[0]),
            )
        )
    )


COMB = Profile(
    polygon((0, 0), (9, 0), (9, 5), (8.7, 5), (8.7, 1), (7, 1), (7, 5), (6.6, 5), (6.6, 1),
            (6.1, 1), (6.1, 5), (0, 5))
)  # fmt: skip
SLOTTED = Profile(polygon((0, 0), (10, 0), (10, 10), (6, 10), (6, 2), (5.3, 2), (5.3, 10), (0, 10)))


def test_a_slot_in_a_rectangle():
    assert web(SLOTTED) == pytest.approx(2.0, rel=1e-12)
    assert gap(SLOTTED) == pytest.approx(0.7, rel=1e-12)


def test_a_comb_has_its_thinnest_tooth_and_its_narrowest_gap():
    assert web(COMB) == pytest.approx(0.3, rel=1e-12)
    assert gap(COMB) == pytest.approx(0.5, rel=1e-12)


def test_a_ring_is_as_thin_as_its_radii_say_and_its_bore_as_wide():
    ring = Profile(Circle((0, 0), 10e-3), (Circle((0, 0), 9e-3),))
    assert web(ring) == pytest.approx(1.0, rel=1e-12)
    assert gap(ring) == pytest.approx(18.0, rel=1e-12)


def test_an_eccentric_ring_is_thinnest_on_the_side_of_its_bore():
    found = smallest_web(Profile(Circle((0, 0), 10e-3), (Circle((0.5e-3, 0), 9e-3),)))
    assert found.distance == pytest.approx(0.5e-3, rel=1e-6)
    assert found.start[0] > 9e-3
    assert abs(found.start[1]) < 2e-5


def longest_ray_beside(neck, radius, spacing):
    """Ray from one circle to the other, radial to the first, that starts half a spacing away."""
    apart, angle = 2 * radius + neck, 0.5 * spacing / radius
    return apart * np.cos(angle) - np.sqrt(radius**2 - (apart * np.sin(angle)) ** 2) - radius


@pytest.mark.parametrize(("neck", "radius"), [(0.3, 1.0), (0.05, 3.0), (1.2, 0.4)])
def test_the_neck_of_a_dumb_bell(neck, radius):
    found = web(dumb_bell(neck, radius))
    assert neck <= found + 1e-9
    assert found <= longest_ray_beside(neck, radius, 0.02) + 1e-9


def test_the_measured_neck_converges_with_the_second_order_of_the_spacing():
    profile = rotate(dumb_bell(0.3, 1.0), 0.4321)
    for spacing in (0.16, 0.04, 0.01):
        found = web(profile, spacing=spacing * 1e-3)
        assert found + 1e-9 >= 0.3
        assert found <= longest_ray_beside(0.3, 1.0, spacing) + 1e-9
    assert longest_ray_beside(0.3, 1.0, 0.01) - 0.3 < 4e-5


def test_two_corners_that_face_each_other_are_measured_from_point_to_point():
    plate = polygon((-10, -10), (10, -10), (10, 10), (-10, 10))
    left = polygon((-5, 0), (-3, -2), (-0.15, 0.0), (-3, 2))
    right = polygon((0.15, 0.1), (3, -2), (5, 0), (3, 2))
    assert web(Profile(plate, (left, right))) == pytest.approx(np.hypot(0.3, 0.1), rel=1e-12)


def test_a_corner_that_points_at_a_wall():
    plate = polygon((-10, -2), (10, -2), (10, 10), (-10, 10))
    diamond = polygon((0, -1.75), (3, 1.25), (0, 4.25), (-3, 1.25))
    assert web(Profile(plate, (diamond,))) == pytest.approx(0.25, rel=1e-4)


@pytest.mark.parametrize("degrees", [5.0, 15.0, 30.0, 45.0, 59.0, 61.0, 90.0])
def test_a_sharp_corner_is_not_a_web(degrees):
    angle = np.radians(degrees)
    tip = polygon((0, 0), (10, 0), (10 * np.cos(angle), 10 * np.sin(angle)))
    found = web(Profile(tip))
    assert found is None or found > 1.0


def test_a_cut_off_corner_is_a_web_as_wide_as_the_cut():
    found = web(Profile(polygon((0, -0.05), (10, -1), (10, 1), (0, 0.05))))
    assert found == pytest.approx(0.1, rel=0.05)


def test_the_blade_behind_a_sharp_point_is_a_web():
    assert web(Profile(polygon((0, 0), (10, 0), (12, 0.25), (10, 0.5), (0, 0.5)))) == pytest.approx(
        0.5, rel=1e-12
    )


def test_the_tips_of_a_ring_of_fingers_and_the_gaps_between_them():
    profile = finger_ring()
    assert web(profile) == pytest.approx(0.7, abs=1e-3)
    # An independent figure: polygon distance of two neighbouring fingers beyond the root.
    polygon_ = profile_polygon(profile)
    tips = shapely.intersection(polygon_, shapely.Point(0, 0).buffer(20e-3))
    fingers = list(tips.geoms)
    assert len(fingers) == 24
    closest = min(nearest(a, b).distance for i, a in enumerate(fingers) for b in fingers[:i])
    # The polygons lie inside the fingers by up to 1 um on either side of the gap.
    assert gap(profile) == pytest.approx(closest * 1e3, abs=2.5e-3)


def test_a_fitted_ring_measures_like_the_model():
    model = finger_ring()
    fitted = Profile(
        polyline_outline(fit_outline(model.outer)),
        tuple(polyline_outline(fit_outline(contour)) for contour in model.inner),
    )
    assert web(fitted) == pytest.approx(web(model), abs=4e-3)
    assert gap(fitted) == pytest.approx(gap(model), abs=4e-3)


def test_a_solid_disc_has_no_gap_and_is_as_wide_as_its_diameter():
    disc = Profile(Circle((1.0, 1.0), 4e-3))
    assert gap(disc) is None
    assert web(disc) == pytest.approx(8.0, rel=1e-9)


def test_turning_a_part_does_not_change_what_is_measured():
    for profile in (SLOTTED, COMB, toothed_shaft()):
        turned = rotate(profile, 1.234)
        assert web(turned) == pytest.approx(web(profile), rel=1e-9)
        assert gap(turned) == pytest.approx(gap(profile), rel=1e-9)


def test_nearest_gives_both_points():
    found = nearest(shapely.Point(0, 0), shapely.LineString([(1, -1), (1, 1)]))
    assert (found.distance, found.start, found.end) == (1.0, (0.0, 0.0), (1.0, 0.0))


def test_the_inside_radius_is_that_of_the_tightest_hollow_arc():
    assert smallest_inside_radius(dumb_bell(0.3, 1.0)) == pytest.approx(1e-3, rel=1e-12)
    hole = Profile(Circle((0, 0), 1e-2), (Circle((0, 0), 1e-3),))
    assert smallest_inside_radius(hole) == pytest.approx(1e-3, rel=1e-12)
    assert smallest_inside_radius(Profile(Circle((0, 0), 1e-2))) == np.inf
    assert smallest_inside_radius(SLOTTED) == 0.0


def test_a_bore_drawn_as_many_short_lines_has_the_radius_of_the_bore():
    angles = np.linspace(0.0, 2.0 * np.pi, 101)[:-1]
    bore = polygon(*(np.array(on_circle(2.0, a)) for a in angles))
    plate = Profile(polygon((-10, -10), (10, -10), (10, 10), (-10, 10)), (bore,))
    assert smallest_inside_radius(plate) == pytest.approx(2e-3, rel=1e-3)
    assert gap(plate) == pytest.approx(4.0, rel=2e-3)
