"""The gap between neighbouring flexures, against closed forms and brute force."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from rotary_cases import law_of, problem_for, spring_of

from springcad.geometry.outline_ops import profile_polygon
from springcad.kinds.rotary_flexure.clearance import flexure_gap, polygon_gap
from springcad.kinds.rotary_flexure.room import neighbour_gap
from springcad.kinds.rotary_flexure.shape import straight_ribbon


@pytest.mark.parametrize("name", ["S1", "S2", "S4"])
def test_the_gap_of_straight_flexures_is_at_the_pinch_or_between_the_tips(name: str) -> None:
    """Whichever is smaller: 1.25 and 1.22 mm for S1, 0.63 and 0.68 mm for S4."""
    law, inputs = law_of(name), law_of(name).inputs
    ribbon = straight_ribbon(problem_for(name, 0.3))
    pinch = neighbour_gap(
        law.span,
        inputs.contact_radius,
        inputs.count,
        law.root_half_thickness,
        inputs.tip_half_thickness,
    )
    noses = 2.0 * inputs.contact_radius * math.sin(math.pi / inputs.count)
    tips = noses - 2.0 * inputs.tip_half_thickness
    gap = flexure_gap(ribbon, inputs.root_radius, inputs.count)
    assert gap == pytest.approx(min(float(pinch), tips), abs=2e-6)


@pytest.mark.parametrize("count", [8, 60])
def test_needles_are_as_far_apart_as_their_tips(count: int) -> None:
    """A thin strip keeps 2 r sin(pi/n) - 2 lambda_t to its neighbour, nose centre at r."""
    root, contact, half = 31e-3, 6e-3, 0.1e-3
    x = np.linspace(0.0, root - contact, 50)
    around = np.linspace(0.5 * np.pi, -0.5 * np.pi, 400)[1:-1]
    nose = np.column_stack([x[-1] + half * np.cos(around), half * np.sin(around)])
    top = np.column_stack([x, np.full_like(x, half)])
    strip = shapely.Polygon(np.concatenate([top, nose, (top * [1.0, -1.0])[::-1]]))
    tip_gap = 2.0 * contact * math.sin(math.pi / count) - 2.0 * half
    inner = 2.0 * (contact * math.sin(math.pi / count) - half * math.cos(math.pi / count))
    gap = polygon_gap(strip, (root, 0.0), count)
    assert tip_gap - 1e-7 <= gap <= inner + 1e-7


def test_overlapping_flexures_have_a_gap_below_zero_that_grows_with_the_overlap() -> None:
    ribbon = spring_of("S1").found.ribbon
    gaps = [flexure_gap(ribbon, 31e-3, count) for count in (24, 60, 80, 120)]
    assert gaps[0] > 0.0 > gaps[1] > gaps[2] > gaps[3]
    assert math.isfinite(gaps[3])


def test_a_flexure_that_crosses_itself_has_no_gap_at_all() -> None:
    bow_tie = shapely.Polygon([(0.0, 0.0), (1e-3, 1e-3), (1e-3, 0.0), (0.0, 1e-3)])
    assert polygon_gap(bow_tie, (31e-3, 0.0), 24) == -math.inf


@pytest.mark.parametrize("name", ["S1", "S2", "S4", "rotary-full"])
def test_the_drawn_flexures_keep_the_gap_that_is_reported(name: str) -> None:
    """Brute force on the drawing: cut off at the root fillets the ring falls into its flexures."""
    spring = spring_of(name)
    inside = spring.law.inputs.root_radius - 1.5 * spring.fillet
    disk = shapely.Point(0.0, 0.0).buffer(inside, quad_segs=500)
    flexures = list(profile_polygon(spring.ring).intersection(disk).geoms)
    assert len(flexures) == spring.law.inputs.count
    gap = min(flexures[0].distance(other) for other in flexures[1:])
    assert gap == pytest.approx(spring.found.gap, abs=3e-6)


@pytest.mark.parametrize("name", ["S2", "S4"])
def test_load_closes_the_gap_steadily(name: str) -> None:
    """From what it is at rest, in both directions, without a jump."""
    spring = spring_of(name)
    for stroke in spring.strokes:
        assert stroke.gap[0] == pytest.approx(spring.found.gap, rel=0.05)
        assert stroke.gap[-1] < stroke.gap[0]
        assert np.max(np.abs(np.diff(stroke.gap))) < 0.2 * stroke.gap[0]
        assert stroke.gap_angle[-1] == stroke.angle[-1]
