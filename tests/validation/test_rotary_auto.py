"""Choosing for the user: in the envelope of S4 further than paper 004, and never by luck."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from rotary_cases import rotary_model

from springcad.kinds.rotary_flexure.aim import Aim, Pair
from springcad.kinds.rotary_flexure.candidates import candidate, candidates
from springcad.kinds.rotary_flexure.checks import spring_checks
from springcad.kinds.rotary_flexure.choosing import Choice, choose
from springcad.kinds.rotary_flexure.design import build_spring, spring_of
from springcad.kinds.rotary_flexure.rim import RIM_STEP, rim_check, rim_stress
from springcad.kinds.rotary_flexure.screening import screened

S4 = ("flexures.count=31", "envelope.contact_radius=5.1 mm", "flexures.root_fillet=0.2 mm",
      "flexures.min_deformed_gap=0.15 mm")  # fmt: skip
NARROW = ("envelope.contact_radius=4.16 mm", "optimiser.coefficients=13")


@cache
def choice_of(*overrides: str) -> Choice:
    return choose(rotary_model("rotary-auto", *overrides), spring_of, lambda _: None)


@pytest.mark.slow
def test_s4_with_its_own_count_and_radius_passes_14_3_degrees() -> None:
    """The paper's S4: 13.4 deg. Every check holds, and the next step is stopped by the gap."""
    choice = choice_of(*S4)
    assert np.degrees(choice.aim.value(choice.level)) >= 14.3 - 1e-9
    assert all(check.status != "fail" for check in spring_checks(choice.spring))
    assert min(float(stroke.gap.min()) for stroke in choice.spring.strokes) >= 0.15e-3
    assert choice.next is not None
    assert choice.next.stop is not None
    assert choice.next.stop.claim.startswith("gap")


@pytest.mark.slow
def test_what_is_chosen_is_what_a_spec_with_its_numbers_gives() -> None:
    """Nothing of the search is left in the design: typed in, the numbers give the same spring."""
    choice = choice_of(*S4)
    degrees = np.degrees(choice.aim.value(choice.level))
    typed = rotary_model("rotary-auto", *S4, f"target.deflection={degrees:.10g} deg")
    again = build_spring(typed, lambda _: None)
    assert again.found.gap == pytest.approx(choice.spring.found.gap, abs=1e-9)
    assert again.mass == pytest.approx(choice.spring.mass, rel=1e-9)


def test_rings_are_ranked_alike_every_time() -> None:
    aim = Aim.of(rotary_model("rotary-auto", *NARROW))
    first, second = candidates(aim), candidates(aim)
    assert first == second
    ring = first[0]
    assert screened(aim, ring) == screened(aim, ring)


def test_no_ring_left_out_by_its_bound_would_have_won() -> None:
    """On a small grid: a ring whose bound is below the best reach does not reach it."""
    aim = Aim.of(rotary_model("rotary-auto"))
    grid = [Pair(n, r) for n in (16, 28) for r in (4.02e-3, 12e-3)]
    rings = [ring for pair in grid if (ring := candidate(aim, pair)) is not None]
    reach = {ring.pair: found.level for ring in rings if (found := screened(aim, ring))}
    best = max(reach.values())
    pruned = [ring for ring in rings if ring.bound <= best]
    assert pruned
    assert all(reach.get(ring.pair, 0.0) <= best for ring in pruned)
    assert all(reach.get(ring.pair, 0.0) <= ring.bound for ring in rings)


def test_a_shape_reaches_further_than_straight_and_less_than_a_full_disk() -> None:
    """Notes of a trial with a clamped root: 14.33 deg for S4's count and contact radius."""
    aim = Aim.of(rotary_model("rotary-auto", *S4))
    ring = candidate(aim, Pair(31, 5.1e-3))
    assert ring is not None
    found = screened(aim, ring)
    assert found is not None
    assert 13.8 < np.degrees(aim.value(1) * found.level) < 14.5
    assert ring.straight < found.level < ring.bound


@pytest.mark.slow
def test_the_thinnest_rim_is_found_for_a_given_ring() -> None:
    """Only the rim is open: nothing else changes, and two steps less would bear too much."""
    choice = choice_of(
        "flexures.count=28", "envelope.contact_radius=4.5 mm", "target.deflection=13 deg",
        "envelope.outer_radius=auto", "flexures.root_fillet=auto", "optimiser.coefficients=13",
    )  # fmt: skip
    assert choice.pair == Pair(28, 4.5e-3)
    assert rim_check(choice.spring).status == "pass"
    case, force = choice.spring.case, float(choice.spring.strokes[0].force.max())
    narrower = case.outer_radius - case.inputs.root_radius - 2.0 * RIM_STEP
    span = choice.spring.law.span
    assert rim_stress(force, span, 4.5e-3, narrower, 0.0) > case.inputs.design_stress
