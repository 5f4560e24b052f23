"""The flexure ring as drawn, against polygons and closed forms that do not use the drawing code."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
import shapely
import shapely.affinity
from rotary_cases import law_of, rotary_model, spring_of

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Arc, Circle, Outline
from springcad.geometry.outline_ops import (
    contour_area,
    contour_points,
    largest_joint_gap,
    outline_corners,
    profile_area,
    profile_faults,
)
from springcad.kinds.rotary_flexure.decision import given_by
from springcad.kinds.rotary_flexure.ring import (
    Dowels,
    largest_fillet,
    rim_contour,
    ring_profile,
    root_fillet,
)
from springcad.kinds.rotary_flexure.root import BLEND_OVER_SMALLEST
from springcad.kinds.rotary_flexure.spring import Spring

RINGS = ("S1", "S2", "S4", "rotary-full")
CHORD = 1e-7
MICRON = 1e-6


def hole_of(spring: Spring) -> Outline:
    hole = spring.ring.inner[0]
    assert isinstance(hole, Outline)
    return hole


@cache
def hole_polygon(name: str) -> shapely.Polygon:
    """What is cut out of the ring."""
    return shapely.Polygon(contour_points(hole_of(spring_of(name)), CHORD))


@cache
def flexure_polygon(name: str) -> shapely.Polygon:
    """Flexure 0 by plain offsets of its centre line, with a round nose, and sunk into the rim."""
    spring = spring_of(name)
    ribbon = spring.found.ribbon
    at = ribbon.at(ribbon.dense_stations(4000))
    across = np.column_stack([-np.sin(at.angle), np.cos(at.angle)]) * at.half_thickness[:, None]
    line = np.column_stack([at.x, at.y])
    strip = shapely.Polygon(np.concatenate([line + across, (line - across)[::-1]]))
    nose = shapely.Point(line[-1]).buffer(float(at.half_thickness[-1]), quad_segs=2000)
    edges = np.stack([line + across, line - across])
    heading = -1.5 * edges[:, 0] + 2.0 * edges[:, 1] - 0.5 * edges[:, 2]
    beyond = edges[:, 0] - 2e-3 * heading / np.hypot(*heading.T)[:, None]
    sunk = shapely.Polygon([*edges[:, 0], *beyond[::-1]])
    local = shapely.union_all([strip, nose, sunk])
    return shapely.affinity.affine_transform(
        local, (-1.0, 0.0, 0.0, -1.0, spring.law.inputs.root_radius, 0.0)
    )


@pytest.mark.parametrize("name", RINGS)
def test_the_ring_is_one_closed_outer_and_one_closed_inner_contour(name: str) -> None:
    spring = spring_of(name)
    assert len(spring.ring.inner) == 1
    assert profile_faults(spring.ring) == ()
    assert largest_joint_gap(hole_of(spring)) < 1e-12


@pytest.mark.parametrize("name", RINGS)
def test_the_inner_contour_has_no_corner_and_the_outer_one_only_those_of_the_dowels(
    name: str,
) -> None:
    spring = spring_of(name)
    assert np.max(np.abs(outline_corners(hole_of(spring)))) < 1e-9
    assert isinstance(spring.ring.outer, Outline)
    corners = outline_corners(spring.ring.outer)
    dowels = spring.spec.mounting.dowels
    assert dowels is not None
    assert len(corners) == 2 * dowels.count
    # A rim circle and a dowel circle about a point of it meet at a right angle and a bit.
    turn = 0.5 * math.pi + math.asin(0.5 * dowels.radius / spring.case.outer_radius)
    np.testing.assert_allclose(corners, turn, atol=1e-9)


@pytest.mark.parametrize("name", RINGS)
def test_the_ring_looks_the_same_after_a_turn_by_one_pitch(name: str) -> None:
    hole = hole_polygon(name)
    pitch = 2.0 * math.pi / spring_of(name).law.inputs.count
    turned = shapely.affinity.rotate(hole, pitch, origin=(0.0, 0.0), use_radians=True)
    assert hole.symmetric_difference(turned).area < 1e-9 * hole.area


@pytest.mark.parametrize("name", RINGS)
def test_the_drawn_edges_are_those_of_the_designed_flexure(name: str) -> None:
    """Between root fillet and pad, and on pad and nose, within the tolerance of the arcs."""
    spring = spring_of(name)
    drawn = hole_polygon(name).exterior
    edge = np.asarray(flexure_polygon(name).exterior.coords)
    radius = np.hypot(*edge.T)
    inputs = spring.law.inputs
    pad = spring.found.ribbon.length - float(spring.found.ribbon.edges[-2])
    blend = inputs.contact_radius + pad
    free = (radius < inputs.root_radius - 2.5 * spring.fillet) & (np.abs(radius - blend) > 0.3e-3)
    assert free.sum() > 2500
    assert shapely.distance(shapely.points(edge[free]), drawn).max() < 1.15 * MICRON


@pytest.mark.parametrize("name", RINGS)
def test_material_beside_the_flexure_is_only_in_root_fillets_and_blends(name: str) -> None:
    spring, inputs = spring_of(name), spring_of(name).law.inputs
    pitch = 2.0 * math.pi / inputs.count
    reach = 1.2 * inputs.root_radius
    wedge = shapely.Polygon(
        [(0.0, 0.0), *((reach * math.cos(a), reach * math.sin(a)) for a in (-pitch, 0.0, pitch))]
    )
    disk = shapely.Point(0.0, 0.0).buffer(inputs.root_radius, quad_segs=20000)
    neighbours = [
        shapely.affinity.rotate(flexure_polygon(name), k * pitch, (0.0, 0.0), use_radians=True)
        for k in range(-5, 6)
    ]
    designed = shapely.union_all([*neighbours]).intersection(disk)
    drawn = disk.difference(hole_polygon(name))
    assert designed.intersection(wedge).difference(drawn.buffer(1.1 * MICRON)).area < 1e-14
    extra = drawn.intersection(wedge.buffer(-1e-5)).difference(designed.buffer(2.0 * MICRON))
    for piece in getattr(extra, "geoms", [extra]):
        radius = np.hypot(*np.asarray(piece.exterior.coords).T)
        near_root = radius.min() > inputs.root_radius - 3.0 * spring.fillet
        pad = spring.found.ribbon.length - float(spring.found.ribbon.edges[-2])
        near_pad = radius.max() < inputs.contact_radius + pad + 0.3e-3
        assert near_root or near_pad


def test_the_area_of_the_straight_ring_follows_from_closed_forms() -> None:
    """Rim less dowel lenses, plus 24 parabolas, pads, half-round noses, fillets and blends.

    The parabola 2 lambda_r sqrt(1 - x/l), whose end l is the contact at full load, covers
    4/3 l lambda_r (1 - w^3) down to the pad of w = tip over root; a fillet against a straight
    edge and a straight rim is (1 - pi/4) r^2, to which the slopes of taper and rim add some per
    cent.
    """
    spring = spring_of("S1")
    inputs = spring.law.inputs
    thick = float(spring.found.ribbon.at(np.zeros(1)).half_thickness[0])
    tip = inputs.tip_half_thickness
    w, problem = tip / thick, spring.found.problem
    flexure = 4.0 / 3.0 * problem.lever * thick * (1.0 - w**3) + 2.0 * tip * problem.pad_length
    flexure += 0.5 * math.pi * tip**2
    # The root is a chord of the rim's circle: its segment belongs to the flexure, too.
    flexure -= -2.0 / 3.0 * thick**3 / inputs.root_radius
    fillets = 2.0 * (1.0 - 0.25 * math.pi) * spring.fillet**2
    rim = math.pi * (spring.case.outer_radius**2 - inputs.root_radius**2) - 8.0 * lens(
        1e-3, spring.case.outer_radius
    )
    beside = profile_area(spring.ring) - rim - inputs.count * flexure
    assert beside == pytest.approx(inputs.count * fillets, rel=0.1)
    assert profile_area(spring.ring) == pytest.approx(
        rim + inputs.count * (flexure + fillets), rel=2e-3
    )


def lens(small: float, large: float) -> float:
    """Area common to two circles, the centre of the small one on the large one."""
    a = math.acos(0.5 * small / large)
    b = math.acos(1.0 - 0.5 * (small / large) ** 2)
    return small**2 * a + large**2 * b - 0.5 * small * math.sqrt(4.0 * large**2 - small**2)


@pytest.mark.parametrize(("count", "radius"), [(2, 1e-3), (8, 1e-3), (40, 2e-3)])
def test_a_dowel_takes_the_lens_of_two_circles_out_of_the_rim(count: int, radius: float) -> None:
    outer = 33.5e-3
    notched = abs(contour_area(rim_contour(outer, Dowels(count, radius))))
    assert math.pi * outer**2 - notched == pytest.approx(count * lens(radius, outer), rel=1e-9)


def test_without_dowels_the_rim_is_a_circle() -> None:
    assert rim_contour(33.5e-3, None) == Circle((0.0, 0.0), 33.5e-3)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("name", RINGS)
def test_a_root_fillet_touches_rim_and_edge(name: str, side: int) -> None:
    """Its circle is tangent to the rim's from inside, and keeps its radius from the edge."""
    spring = spring_of(name)
    root = spring.law.inputs.root_radius
    arc = root_fillet(spring.found.ribbon, root, spring.fillet, side).arc
    x, y = arc.center
    assert math.hypot(x - root, y) == pytest.approx(root - spring.fillet, abs=1e-12)
    centre = shapely.Point(root - x, -y)
    assert centre.distance(flexure_polygon(name)) == pytest.approx(spring.fillet, abs=3e-8)


@pytest.mark.parametrize("name", RINGS)
def test_no_hollow_arc_is_sharper_than_the_process_can_cut(name: str) -> None:
    """The hole runs counter-clockwise, so material bulges into it where arcs turn clockwise."""
    spring = spring_of(name)
    assert contour_area(hole_of(spring)) > 0.0
    hollow = [p.radius for p in hole_of(spring).pieces if isinstance(p, Arc) and p.sweep > 0.0]
    assert min(hollow) >= spring.spec.process.rules.min_inside_radius


def test_ribbon_of_local_stress_has_a_pad_of_constant_thickness() -> None:
    spring = spring_of(
        "S2", "stress=local", "target.stiffness=100 N*m/rad", "target.deflection=15 deg"
    )
    ribbon = spring.found.ribbon
    pad = np.linspace(float(ribbon.edges[-2]), ribbon.length, 50)
    tip = spring.law.inputs.tip_half_thickness
    np.testing.assert_allclose(ribbon.at(pad).half_thickness, tip, rtol=1e-12)
    assert np.max(np.abs(outline_corners(hole_of(spring)))) < 1e-9


def test_the_largest_fillet_leaves_a_land_and_the_next_does_not() -> None:
    spring = spring_of("S4")
    ribbon, inputs = spring.found.ribbon, spring.law.inputs
    found = largest_fillet(ribbon, inputs.root_radius, inputs.count, 0.15e-3, 5e-3)
    assert found >= spring.fillet

    def width(radius: float) -> float:
        angles = []
        for side in (1, -1):
            x, y = root_fillet(ribbon, inputs.root_radius, radius, side).arc.center
            angles.append(math.atan2(y, inputs.root_radius - x))
        return angles[0] - angles[1]

    pitch = 2.0 * math.pi / inputs.count
    assert width(found) < 0.98 * pitch < width(found + 2e-5)


def test_a_fillet_too_large_for_any_arc_is_not_one_that_fits() -> None:
    """Half the inner radius and more: there is no such arc, but smaller ones are found."""
    spring = spring_of("S1")
    ribbon, root = spring.found.ribbon, spring.law.inputs.root_radius
    with pytest.raises(ValueError, match="no root fillet"):
        root_fillet(ribbon, root, 0.6 * root, 1)
    found = largest_fillet(ribbon, root, 3, 0.15e-3, 0.6 * root)
    assert 5e-3 < found < 0.6 * root


def test_without_room_the_smallest_fillet_is_refused_with_the_one_that_fits() -> None:
    spring = spring_of("S4")
    ribbon, inputs = spring.found.ribbon, spring.law.inputs
    with pytest.raises(InfeasibleError, match="root fillet") as caught:
        largest_fillet(ribbon, inputs.root_radius, inputs.count, 1e-3, 2e-3)
    assert caught.value.limit == 1e-3
    fits = largest_fillet(ribbon, inputs.root_radius, inputs.count, 0.15e-3, 2e-3)
    assert caught.value.value == pytest.approx(fits, abs=1.1e-5)


EASY = "target.deflection=10 deg"
"""With fillets so large S1 bends over less of its length, and reaches less than its own."""


def test_a_fillet_that_does_not_fit_names_one_that_does() -> None:
    with pytest.raises(InfeasibleError, match="root fillet") as caught:
        spring_of("S1", EASY, "flexures.root_fillet=4 mm")
    asked = rotary_model("S1", EASY, "flexures.root_fillet=4 mm")
    (change,) = given_by(caught.value, asked)
    radius = change.overrides[0].removeprefix("flexures.root_fillet=").removesuffix(" mm")
    assert spring_of("S1", EASY, f"flexures.root_fillet={radius} mm").fillet * 1e3 == float(radius)


@pytest.mark.parametrize("tip_over_root", [0.3, 0.9, 0.999])
def test_thick_tips_still_make_a_closed_smooth_ring(tip_over_root: float) -> None:
    """The pad may begin before the root fillet ends; then the edge is one straight line."""
    from springcad.kinds.rotary_flexure.problem import FlexureProblem
    from springcad.kinds.rotary_flexure.shape import straight_ribbon

    law = law_of("S1")
    ribbon = straight_ribbon(
        FlexureProblem(
            span=law.span,
            root_radius=31e-3,
            count=8,
            root_half_thickness=law.root_half_thickness,
            tip_half_thickness=tip_over_root * law.root_half_thickness,
            serpentine_factor=1.0,
            bend_limit=0.3,
        )
    )
    blend = BLEND_OVER_SMALLEST * 0.15e-3
    ring = ring_profile(ribbon, 31e-3, 33.5e-3, 8, 1.4e-3, blend, None)
    assert profile_faults(ring) == ()
    assert isinstance(ring.inner[0], Outline)
    limit = 1e-9 if tip_over_root < 0.9 else 0.06  # a corner of the taper's last millimetres
    assert np.max(np.abs(outline_corners(ring.inner[0]))) < limit
