"""Straight flexures turn until the exact beam, not the law of small deflections, ends it."""

from __future__ import annotations

import math
import re
from functools import cache

import numpy as np
import pytest
from rotary_cases import SPECS, rotary_model

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.decision import decide, given_by
from springcad.kinds.rotary_flexure.design import build_spring
from springcad.kinds.rotary_flexure.full_load import demand_of, loads_of
from springcad.kinds.rotary_flexure.inputs import case_of, target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.sizing import Sized, size_flexure
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.straight_limit import STRAIGHT_LIMIT, straight_limit
from springcad.spec.source import read_spec

DESIGN_STRESS = 912e6


def quiet(_: str) -> None:
    pass


def sized(*overrides: str) -> Sized:
    spec = rotary_model("S1", *overrides)
    case = case_of(spec).shifted
    return size_flexure(spec, case, design_law(case.inputs), target_of(spec), quiet)


@cache
def refusal(*overrides: str) -> InfeasibleError:
    with pytest.raises(InfeasibleError) as refused:
        sized(*overrides)
    assert refused.value.claim == STRAIGHT_LIMIT
    return refused.value


def stress_along(flexure: Sized, spring_of: tuple[str, ...]) -> np.ndarray:
    """Nominal stress before the pad at full load, both directions, from a solution of its own."""
    spec = rotary_model("S1", *spring_of)
    inputs = case_of(spec).inputs
    demand = demand_of(target_of(spec), inputs.root_radius, inputs.contact_radius, inputs.count)
    ribbon = flexure.found.ribbon
    states = loads_of(ribbon, flexure.beam, demand)
    before = states[0].stations[-1] <= ribbon.edges[-2]
    return np.max([state.nominal_stress[-1][before] for state in states], axis=0)


@pytest.mark.slow
def test_the_largest_deflection_of_s1_uses_the_whole_flexure() -> None:
    """``max`` ends a step of 0.05 deg or less from it, every section within 0.5 % of 912 MPa."""
    spring, choice = decide(read_spec(SPECS / "S1.yaml", ("target.deflection=max",)), quiet)
    assert choice is not None
    reached = math.degrees(spring.case.inputs.deflection)
    assert reached == pytest.approx(12.75, abs=1e-9)
    stress = stress_along(spring.sized, (f"target.deflection={reached!r} deg",))
    np.testing.assert_allclose(stress, DESIGN_STRESS, rtol=5e-3)
    assert choice.next is not None
    assert choice.next.stop is not None
    assert choice.next.stop.claim == STRAIGHT_LIMIT


def test_the_closed_form_of_small_deflections_is_no_limit() -> None:
    """004, Eq. 11 ends at 12.56 deg; 12.7 deg is designed, below the design stress everywhere."""
    change = ("target.deflection=12.7 deg",)
    flexure = sized(*change)
    stress = stress_along(flexure, change)
    assert stress.max() < DESIGN_STRESS
    np.testing.assert_allclose(stress, DESIGN_STRESS, rtol=6e-3)


def test_a_refusal_names_the_deflection_at_which_the_stress_is_the_design_stress() -> None:
    error = refusal("target.deflection=12.85 deg")
    limit = math.degrees(error.limit)
    assert 12.56 < limit < 12.8
    at_limit = sized(f"target.deflection={limit!r} deg")
    np.testing.assert_allclose(
        stress_along(at_limit, (f"target.deflection={limit!r} deg",)), DESIGN_STRESS, rtol=1e-3
    )


def test_the_advice_is_the_limit_rounded_down_and_works() -> None:
    error = refusal("target.deflection=12.85 deg")
    (change,) = given_by(error, rotary_model("S1", "target.deflection=12.85 deg"))
    advised = re.search(r"lower target\.deflection from 12\.85 to ([0-9.]+) deg", change.words)
    assert advised is not None
    assert 0.0 <= math.degrees(error.limit) - float(advised[1]) < 0.01
    assert sized(f"target.deflection={advised[1]} deg").level <= 1.0


def test_the_limit_does_not_depend_on_what_was_asked_for() -> None:
    near, far = (refusal(f"target.deflection={deg} deg").limit for deg in (12.85, 13.4))
    assert near == pytest.approx(far, rel=3e-4)


def test_a_ring_of_any_stiffness_at_its_limit_holds_the_energy_of_its_sections() -> None:
    """Eq. 9 with equality: U = sigma^2 t A/(6 E) of each flexure at its limit, within what rim,
    shear and the pad hold besides, 3 %."""
    error = refusal("target.deflection=12.85 deg")
    flexure = sized(f"target.deflection={math.degrees(error.limit)!r} deg")
    ribbon = flexure.found.ribbon
    area = float(ribbon.grid.weights @ (2.0 * ribbon.half_thickness))
    by_area = DESIGN_STRESS**2 * 4.5e-3 * area / (6.0 * 200e9)
    assert 0.5 * 150.0 * error.limit**2 / 24 == pytest.approx(by_area, rel=0.03)


@pytest.mark.parametrize(("power", "factor"), [(1.0, 1.3), (1.4, 1.02), (0.8, 1.1)])
def test_secants_find_where_a_power_law_is_one(power: float, factor: float) -> None:
    def level(deflection: float) -> float:
        return factor * (deflection / 0.2) ** power

    found = straight_limit(level, 0.2, level(0.2))
    assert found == pytest.approx(0.2 * factor ** (-1.0 / power), rel=2e-4)


def test_flexures_stronger_than_needed_are_not_refused() -> None:
    assert sized("target.deflection=10 deg").level < 0.8


@pytest.mark.slow
def test_a_whole_spring_between_closed_form_and_limit_passes_every_check() -> None:
    spring: Spring = build_spring(rotary_model("S1", "target.deflection=12.7 deg"), quiet)
    assert spring.sized.level < 1.0


@pytest.mark.slow
def test_auto_takes_straight_flexures_as_far_as_they_go() -> None:
    """From 12.65 to 12.8 deg the closed forms suggest waves, for which there is no room."""
    auto, straight = (
        build_spring(
            rotary_model("S1", "target.deflection=12.7 deg", f"flexures.style={style}"), quiet
        )
        for style in ("auto", "straight")
    )
    assert auto.found.style == "straight"
    assert auto.mass == straight.mass
