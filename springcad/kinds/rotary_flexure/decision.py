"""The rotary flexure spring from spec to result; where there is none, why, and what would help."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.aim import Aim, Trial, is_open
from springcad.kinds.rotary_flexure.candidates import any_candidate, candidates
from springcad.kinds.rotary_flexure.case import resolved_style
from springcad.kinds.rotary_flexure.changes import Change, more_backlash
from springcad.kinds.rotary_flexure.checks import INTERFERENCE, spring_checks
from springcad.kinds.rotary_flexure.choice_report import with_choice
from springcad.kinds.rotary_flexure.choosing import Choice, choose
from springcad.kinds.rotary_flexure.climbing import Climb
from springcad.kinds.rotary_flexure.design import build_spring, spring_with_room
from springcad.kinds.rotary_flexure.feasibility import closed_forms, failures
from springcad.kinds.rotary_flexure.inputs import case_of, rotary_spec, target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.refusal import Judges, Verdict, changes_that_work
from springcad.kinds.rotary_flexure.screening import has_room
from springcad.kinds.rotary_flexure.search import find_shape
from springcad.kinds.rotary_flexure.shape_refusal import NoShapeError, limit_of
from springcad.kinds.rotary_flexure.sizing import FILLET_THAT_FITS, NEIGHBOURS, size_flexure
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.stack import of_sheet, stack_of
from springcad.kinds.rotary_flexure.straight_limit import STRAIGHT_LIMIT
from springcad.kinds.rotary_flexure.summary import summarise
from springcad.kinds.rotary_flexure.ways import KNOB, rounds_of
from springcad.result import Check, Progress, Result
from springcad.spec.source import Spec

GIVEN_BY = {
    STRAIGHT_LIMIT: "target.deflection",
    NEIGHBOURS: "flexures.min_gap",
    FILLET_THAT_FITS: "flexures.root_fillet",
}
"""Claims that name a number which will do, and the key of the number."""
NOT_TRIED = 2
"""Changes told at most that only closed forms allow."""
NO_DENSER = 1.0 + 1e-9
"""Of density factors that are the same but for rounding."""


def design_spring(spec: Spec, progress: Progress) -> Result:
    """Design ring and camshaft and say what they do; what is left open is chosen first.

    Raises:
        InfeasibleError: no part can meet the spec; with changes that were designed.
    """
    spring, choice = decide(spec, progress)
    result = summarise(spec, spring)
    return result if choice is None else with_choice(result, choice)


def decide(spec: Spec, progress: Progress) -> tuple[Spring, Choice | None]:
    """The spring, and how it was chosen where the spec leaves something open.

    Raises:
        InfeasibleError: no part can meet the spec; with changes that were designed.
    """
    model = rotary_spec(spec.model)
    try:
        if not is_open(model):
            return build_spring(model, progress), None
        choice = choose(model, spring_with_room, progress)
        return choice.spring, choice
    except InfeasibleError as error:
        progress("no part can be made: trying what would help")
        remedies = _remedies(spec, model, error, progress)
        told = _with_its_limit(error, model)
        told = InfeasibleError(told.claim, told.value, told.limit, told.unit, remedies)
        raise of_sheet(told, stack_of(model)) from error


def _remedies(
    spec: Spec, model: RotaryFlexureSpec, error: InfeasibleError, progress: Progress
) -> tuple[str, ...]:
    """Changes that were designed; where none of them works, what closed forms alone would allow."""
    given = given_by(error, model)
    judges = OF_A_CHOICE if is_open(model) else of_a_ring(model)
    work = changes_that_work(spec, rounds_of(model, given), judges, progress)
    if work or error.claim in GIVEN_BY:
        return work
    words = "closed forms allow it, but it was not designed"
    return tuple(f"{remedy}, {words}" for remedy in error.remedies[:NOT_TRIED])


def given_by(error: InfeasibleError, model: RotaryFlexureSpec) -> tuple[Change, ...]:
    """The change to the number that a refusal of one sheet names, as it stands in the spec."""
    key = GIVEN_BY.get(error.claim)
    if key is None:
        return ()
    turns = error.claim == STRAIGHT_LIMIT
    limit = stack_of(model).series * error.limit if turns else error.value
    return KNOB[key].lowered_below(model, limit)


def _with_its_limit(error: InfeasibleError, spec: RotaryFlexureSpec) -> InfeasibleError:
    if not isinstance(error, NoShapeError):
        return error
    return limit_of(error, spec.optimiser, case_of(spec).min_gap)


def of_a_ring(model: RotaryFlexureSpec) -> Judges:
    """The judges of a spec that leaves nothing open.

    Where the ring is within the closed forms and yet has no room, a denser one has none either.
    """
    case = case_of(model)
    densest = math.inf if failures(case) else design_law(case.shifted.inputs).density_factor
    return Judges(partial(_ring_is_possible, densest=densest), _ring_has_room, _ring_designed)


def _silent(_: str) -> None:
    """Progress of a trial, which is nobody's concern."""


def _ring_is_possible(spec: Spec, densest: float) -> bool:
    case = case_of(spec.model)
    if failures(case):
        return False
    return design_law(case.shifted.inputs).density_factor <= NO_DENSER * densest


def _ring_has_room(spec: Spec) -> bool:
    """Whether straight flexures can be sized; of others, whether a search leaves the gap."""
    model = rotary_spec(spec.model)
    case = case_of(model).shifted
    law = design_law(case.inputs)
    try:
        if resolved_style(law, case.style) == "straight":
            return bool(size_flexure(model, case, law, target_of(model), _silent))
        if model.optimiser.form == "control-points":
            return find_shape(model, case, law, _silent).gap >= case.min_gap
    except InfeasibleError:
        return False
    return has_room(Trial(model, case))


def _ring_designed(spec: Spec) -> Verdict:
    model = rotary_spec(spec.model)
    case = case_of(model).shifted
    try:
        spring = spring_with_room(model, case, closed_forms(case), _silent)
    except InfeasibleError as error:
        return Verdict.missed(error.claim, error.value, error.limit)
    return _verdict(spec, spring)


def _verdict(spec: Spec, spring: Spring) -> Verdict:
    """What the checks of the report say of a spring, those of the ring before all others."""
    judges: tuple[Callable[[], tuple[Check, ...]], ...] = (
        lambda: spring_checks(spring),
        lambda: summarise(spec, spring).checks,
    )
    for checks in judges:
        failed = [claim for claim in checks() if claim.status == "fail"]
        if failed:
            worst = max(claim.value for claim in failed)
            only = all(claim.name.endswith(INTERFERENCE) for claim in failed)
            cure = more_backlash(spring.spec, worst) if only else None
            return Verdict.missed(failed[0].name, failed[0].value, failed[0].limit, cure)
    return Verdict()


def _some_ring_is_possible(spec: Spec) -> bool:
    return any_candidate(Aim.of(rotary_spec(spec.model)))


def _some_ring_is_straight(spec: Spec) -> bool:
    """Such rings are designed in any choice, and quickly."""
    return any(ring.has_straight for ring in candidates(Aim.of(rotary_spec(spec.model))))


def _straight_ring_designed(spec: Spec) -> Verdict:
    """Of the rings that a choice falls back on: where one passes, the choice has a spring."""
    aim = Aim.of(rotary_spec(spec.model))
    tried = Climb(aim, spring_with_room, _silent)
    tried.straight(candidates(aim))
    if tried.best is not None and tried.best.spring is not None:
        return _verdict(spec, tried.best.spring)
    stop = next(design.stop for design in tried.designs if design.stop is not None)
    return Verdict.missed(stop.claim, stop.value, stop.limit)


OF_A_CHOICE = Judges(_some_ring_is_possible, _some_ring_is_straight, _straight_ring_designed)
