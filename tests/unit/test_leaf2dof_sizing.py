"""The leaf that is sized: meets its targets on the exact unit, and none is shorter."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from math import inf

import numpy as np
import pytest
from leaf2_cases import DEGREE, MM, PAPER_LEAF, PAPER_LEVER
from leaf2dof_specs import made_leaves, shipped_case

from springcad.kinds.leaf_2dof import estimate, paper_unit
from springcad.kinds.leaf_2dof.case import Case
from springcad.kinds.leaf_2dof.feasibility import setup_of
from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.kinds.leaf_2dof.limits import useful_stroke
from springcad.kinds.leaf_2dof.seating import rest_offset
from springcad.kinds.leaf_2dof.sizing import length_for
from springcad.kinds.leaf_2dof.unit import rest_stiffness, stroke

CASE = replace(shipped_case("design"), leaves=2)


@pytest.mark.parametrize("clamp", ["outboard", "inboard"])
@pytest.mark.parametrize("roller", [2.0, 5.0, 10.0])
def test_the_estimate_of_stress_and_slope_is_as_close_as_it_says(clamp: str, roller: float) -> None:
    """0.6 % for w/xi up to 0.5 and 1.1 % up to 0.7, lengths from 15 to 60 mm, strains up to 1 %."""
    lever = Lever(25 * MM, roller * MM, clamp)
    for length, slenderness in product((15 * MM, 30 * MM, 60 * MM), (25, 100, 1000)):
        leaf = Leaf(10 * MM, length / slenderness, 208e9, 0.3)
        bend = np.arctan(min(np.tan(40 * DEGREE), 0.5 * length / rest_offset(leaf, lever)))
        end = min(float(paper_unit.deflection_at_bend(lever, length, bend)), 30 * DEGREE)
        exact = stroke(leaf, lever, length, end * np.array([0.1, 0.5, 1.0]))
        for angle, exact_stress, slope in zip(
            exact.angle, exact.stress, exact.bend_angle, strict=True
        ):
            bent = estimate.bend(leaf, lever, length, angle)
            if bent is None or exact_stress > 2.08e9:
                continue
            q = bent.deflection / bent.reach
            error = 0.006 if q <= 0.5 else 0.011
            stress = estimate.stress(leaf, lever, length, angle)
            assert stress == pytest.approx(exact_stress, rel=error)
            assert bent.slope == pytest.approx(slope, rel=error)


@pytest.mark.parametrize("roller", [2.0, 5.0, 10.0])
def test_the_estimate_knows_where_the_torque_peaks(roller: float) -> None:
    """Within 1.1 % of the exact unit's angle (measured; 1.5 % is claimed), from 0.8 arms on."""
    lever = Lever(25 * MM, roller * MM, "outboard")
    leaf = Leaf(10 * MM, 0.6 * MM, 208e9, 0.3)
    for length in (20 * MM, 45 * MM, 150 * MM):
        peak = float(useful_stroke(leaf, lever, [length])[0])
        assert estimate.stiffness(leaf, lever, length, peak / 1.015) > 0.0
        assert estimate.stiffness(leaf, lever, length, peak * 1.015) < 0.0


def test_the_estimate_is_the_elastica_to_second_order() -> None:
    """Its error falls with the fourth power of the angle: 16 times for half of it."""
    lever = Lever(25 * MM, 5 * MM, "outboard")
    leaf = Leaf(10 * MM, 0.002 * MM, 208e9, 0.3)
    errors = []
    for angle in (20 * DEGREE, 10 * DEGREE):
        exact = float(stroke(leaf, lever, 30 * MM, angle).stress)
        errors.append(estimate.stress(leaf, lever, 30 * MM, angle) / exact - 1.0)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.3)


def test_the_effective_length_for_a_stiffness_is_the_inverse_of_the_stiffness() -> None:
    for length in (5 * MM, 10 * MM, 45 * MM):
        stiffness = 2 * float(rest_stiffness(PAPER_LEAF, PAPER_LEVER, length))
        assert length_for(PAPER_LEAF, PAPER_LEVER, 2, stiffness) == pytest.approx(length, rel=1e-12)


def test_the_sized_leaf_has_the_stiffness_range_and_uses_the_design_stress() -> None:
    made = made_leaves("design")
    setup, case = made.setup, made.case
    assert setup.leaves == 2
    for length, wanted in ((setup.longest, 1.5), (setup.shortest, 50.0)):
        found = setup.leaves * float(rest_stiffness(setup.leaf, setup.lever, length))
        assert found == pytest.approx(wanted, rel=5e-4)
    assert float(made.full.angle[-1]) == pytest.approx(12 * DEGREE)
    assert case.design_stress * 0.998 < float(made.full.stress[-1]) <= case.design_stress
    assert made.planform.length <= case.leaf_room
    for value in (setup.leaf.width, setup.leaf.thickness, setup.shortest, setup.longest):
        assert value * 1e6 == pytest.approx(round(value * 1e6), abs=1e-6)


def test_the_fewest_leaves_that_do_are_taken() -> None:
    """One leaf would need more thickness or width than allowed, and is not the answer."""
    one = setup_of(replace(CASE, leaves=1))
    assert (one.leaf.width, one.leaf.thickness) == (CASE.width, CASE.thickness)
    at = one.leaf, one.lever, one.longest, CASE.deflection
    assert estimate.stress(*at) > 1.05 * CASE.design_stress
    assert setup_of(replace(CASE, leaves=None)) == setup_of(CASE)


@pytest.mark.parametrize("stress", [480e6, 600e6])
@pytest.mark.parametrize("clamp", ["outboard", "inboard"])
def test_no_leaf_within_the_bounds_is_shorter(clamp: str, stress: float) -> None:
    """Of a grid of sections, each with the length that the wanted stiffness asks of it, none that
    is shorter than the one found bears the deflection on the exact unit, and a longer one does.
    """
    case = replace(CASE, clamp=clamp, design_stress=stress)
    setup = setup_of(case)
    width, thickness = np.meshgrid(
        np.linspace(case.least_width, case.width, 9),
        np.linspace(case.least_thickness, case.thickness, 21),
    )
    longer_bears = False
    for a, b in zip(width.ravel(), thickness.ravel(), strict=True):
        leaf = case.leaf(float(a), float(b))
        length = length_for(leaf, case.lever, 2, case.least_stiffness)
        about = estimate.stress(leaf, case.lever, length, case.deflection)
        if length * (1 + 2e-3) >= setup.longest:
            longer_bears |= length < 1.1 * setup.longest and about < 0.99 * stress
        elif about < 1.02 * stress:
            assert float(stroke(leaf, case.lever, length, case.deflection).stress) > stress
    assert longer_bears


def test_bounds_that_bind_are_kept() -> None:
    thin = setup_of(replace(CASE, thickness=0.4 * MM, width=30 * MM))
    assert thin.leaf.thickness <= 0.4 * MM
    wide = setup_of(replace(CASE, least_width=9.99 * MM, least_thickness=0.75 * MM))
    assert (wide.leaf.width, wide.leaf.thickness) == (9.99 * MM, 0.75 * MM)
    at = wide.leaf, wide.lever, wide.longest, CASE.deflection
    assert estimate.stress(*at) < 0.9 * CASE.design_stress


def test_a_bend_angle_makes_the_leaf_longer_within_the_bounds() -> None:
    free, bound = (
        setup_of(replace(CASE, max_bend_angle=limit, thickness=1 * MM))
        for limit in (inf, 6 * DEGREE)
    )
    assert bound.longest > 1.2 * free.longest
    bent = estimate.bend(bound.leaf, bound.lever, bound.longest, CASE.deflection)
    assert bent is not None
    assert bent.slope <= 6 * DEGREE
    assert CASE.least_width <= bound.leaf.width <= CASE.width


def test_leaves_are_added_until_the_exact_unit_keeps_the_bend_angle() -> None:
    """Five at the upper bounds of the section bend by 5.017 deg, which is less than 1 % too much:
    the estimate alone must not settle their number.
    """
    made = made_leaves(
        "design", "leaf.max_bend_angle=5 deg", "envelope.leaf_length=98.4 mm",
    )  # fmt: skip
    assert made.setup.leaves == 6
    assert float(made.full.bend_angle[-1]) <= made.case.max_bend_angle
    lengths = setup_of(replace(made.case, leaves=5)).longest, made.setup.longest
    assert lengths[0] < lengths[1]


def test_the_shortest_length_clears_the_guide() -> None:
    """A wide range of stiffness asks for a short leaf: the whole leaf grows until it clears."""
    case: Case = replace(CASE, greatest_stiffness=5000.0, thickness=2 * MM, leaf_room=inf)
    setup = setup_of(case)
    assert setup.shortest == pytest.approx(case.roller_radius + case.clearance, abs=0.02 * MM)
    assert setup.longest > setup_of(CASE).longest
