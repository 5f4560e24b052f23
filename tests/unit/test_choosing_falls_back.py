"""A choice ends in a spring wherever straight flexures make one, or says what it tried."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from rotary_cases import rotary_model

from springcad.errors import InfeasibleError, SpecError
from springcad.kinds.rotary_flexure.aim import Aim
from springcad.kinds.rotary_flexure.candidates import candidates
from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.choosing import choose
from springcad.kinds.rotary_flexure.climbing import Climb
from springcad.kinds.rotary_flexure.decision import decide
from springcad.kinds.rotary_flexure.design import spring_of
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.result import Check, Progress
from springcad.spec.source import read_spec

SPEC = Path(__file__).parents[2] / "specs/rotary-auto.yaml"
PLAIN = ("flexures={count: auto}", "camshaft={}", "process=wire-edm", "optimiser={}")
"""The envelope with nothing but defaults."""


def plain(*overrides: str) -> RotaryFlexureSpec:
    return rotary_model("rotary-auto", *PLAIN, *overrides)


def only_straight(
    spec: RotaryFlexureSpec, case: Case, feasibility: tuple[Check, ...], progress: Progress
) -> Spring:
    """Designs that find no gap for a bent flexure."""
    if case.style != "straight":
        raise InfeasibleError("gap between neighbouring flexures", 0.1e-3, 0.3e-3, "m")
    return spring_of(spec, case, feasibility, progress)


def nothing(
    spec: RotaryFlexureSpec, case: Case, feasibility: tuple[Check, ...], progress: Progress
) -> Spring:
    """Designs of which none has a gap."""
    raise InfeasibleError("gap between neighbouring flexures", 0.1e-3, 0.3e-3, "m")


def test_a_ring_whose_bent_flexures_fail_is_made_with_straight_ones() -> None:
    """Straight flexures of 30 in a ring reach 12.8 deg (004, Eq. 11); none higher is ever made."""
    spec = plain("flexures.count=30", "envelope.contact_radius=4.49 mm")
    choice = choose(spec, only_straight, lambda _: None)
    (ring,) = choice.allowed
    assert choice.level == ring.straight
    assert choice.spring.found.style == "straight"
    assert np.degrees(choice.aim.value(choice.level)) == pytest.approx(12.8, abs=0.06)


def test_the_first_straight_ring_that_passes_is_the_best_of_them() -> None:
    """Rings are tried in the order of what straight flexures reach: no later one is better."""
    aim = Aim.of(plain())
    rings = candidates(aim)
    climb = Climb(aim, only_straight, lambda _: None)
    climb.straight(rings)
    assert climb.best is not None
    assert climb.best.level == rings[0].straight
    assert len(climb.designs) == 1
    assert np.degrees(aim.value(climb.best.level)) > 12.0


def test_a_refusal_says_what_was_tried() -> None:
    spec = plain("flexures.count=30", "envelope.contact_radius=4.49 mm")
    with pytest.raises(
        InfeasibleError, match=r"last ring tried .*30 flexures.* 1 rings? w"
    ) as told:
        choose(spec, nothing, lambda _: None)
    assert told.value.value < told.value.limit


def test_a_deflection_out_of_reach_is_refused_with_one_that_was_designed() -> None:
    """20 deg are beyond a full disk (16.8 deg); the remedy, typed in, gives a spring."""
    fixed = ("flexures.count=30", "envelope.contact_radius=4.49 mm", "envelope.outer_radius=auto")
    with pytest.raises(InfeasibleError) as told:
        decide(read_spec(SPEC, (*PLAIN, *fixed, "target.deflection=20 deg")), lambda _: None)
    assert told.value.claim.startswith("deflection against a full disk, of the ring that comes")
    assert np.degrees(told.value.limit) == pytest.approx(16.8, abs=0.05)
    remedy = next(words for words in told.value.remedies if "target.deflection" in words)
    degrees = remedy.split(" to ")[1].split(" deg")[0]
    choice = choose(plain(*fixed, f"target.deflection={degrees} deg"), spring_of, lambda _: None)
    assert choice.spring.found.style == "straight"


def test_the_largest_deflection_of_a_law_that_grows_without_end_is_no_traceback() -> None:
    law = "target={law: {exponential: {scale: 10 N*m, decade: 10 deg}}, deflection: max}"
    with pytest.raises(SpecError, match=r"max needs target\.stiffness"):
        read_spec(SPEC, (law,))


@pytest.mark.slow
def test_nothing_but_defaults_reaches_further_than_the_best_straight_ring() -> None:
    """Straight flexures reach 13.45 deg; what is found with the process's own limits, 14.15."""
    choice = choose(plain(), spring_of, lambda _: None)
    assert np.degrees(choice.aim.value(choice.level)) >= 14.0
    assert choice.level > choice.allowed[0].straight
