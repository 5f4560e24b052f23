"""The rotary flexure spring from spec to result; where there is none, why, and what would help."""

from __future__ import annotations

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.aim import Aim, is_open
from springcad.kinds.rotary_flexure.candidates import any_candidate, candidates
from springcad.kinds.rotary_flexure.case import resolved_style
from springcad.kinds.rotary_flexure.changes import Change, more_backlash, ways_of
from springcad.kinds.rotary_flexure.checks import INTERFERENCE
from springcad.kinds.rotary_flexure.choice_report import with_choice
from springcad.kinds.rotary_flexure.choosing import Choice, choose
from springcad.kinds.rotary_flexure.climbing import Climb
from springcad.kinds.rotary_flexure.curvature_form import optimise
from springcad.kinds.rotary_flexure.design import build_spring, spring_with_room
from springcad.kinds.rotary_flexure.feasibility import failures
from springcad.kinds.rotary_flexure.inputs import case_of, rotary_spec
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.refusal import MOST, Judges, changes_that_work
from springcad.kinds.rotary_flexure.screening import STARTS
from springcad.kinds.rotary_flexure.search import problem_of
from springcad.kinds.rotary_flexure.shape_refusal import BEND, NoShapeError, limit_of
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.stack import of_sheet, stack_of
from springcad.kinds.rotary_flexure.straight_limit import STRAIGHT_LIMIT
from springcad.kinds.rotary_flexure.summary import summarise
from springcad.result import Progress, Result
from springcad.spec.source import Spec

DEFLECTION = "target.deflection"
FIRST = {
    BEND: "flexures.bend_limit",
    "gap": "flexures.min_gap",
    "root fillet": "flexures.root_fillet",
}
"""How a claim begins, and the key that is changed first for it."""


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
        told = _with_its_limit(error, model)
        first = next((key for claim, key in FIRST.items() if told.claim.startswith(claim)), "")
        judges = OF_A_CHOICE if is_open(model) else OF_A_RING
        # Straight flexures have been sized at their limit: that deflection needs no other trial.
        sized = error.remedies if error.claim == STRAIGHT_LIMIT else ()
        ways = [way for way in ways_of(model) if not (sized and way and way[0].key == DEFLECTION)]
        remedies = (*sized, *changes_that_work(spec, ways, judges, progress, first))[:MOST]
        if not remedies:
            remedies = tuple(f"{words}, by closed forms alone" for words in error.remedies)
        told = InfeasibleError(told.claim, told.value, told.limit, told.unit, remedies)
        raise of_sheet(told, stack_of(model)) from error


def _with_its_limit(error: InfeasibleError, spec: RotaryFlexureSpec) -> InfeasibleError:
    if not isinstance(error, NoShapeError):
        return error
    return limit_of(error, spec.optimiser, case_of(spec).min_gap)


def _ring_is_possible(spec: Spec) -> bool:
    return not failures(case_of(spec.model))


def _ring_has_shape(spec: Spec) -> bool:
    """Whether few searches on the design law, whatever form is asked for, leave the wanted gap."""
    model = rotary_spec(spec.model)
    case = case_of(model).shifted
    law = design_law(case.inputs)
    if resolved_style(law, case.style) == "straight":
        return True
    settings = model.optimiser
    found = optimise(
        problem_of(model, law),
        starts=STARTS,
        seed=settings.seed,
        coefficients=settings.coefficients,
    )
    return found is not None and found.gap >= case.min_gap


def _missing_to_ring(spec: Spec) -> tuple[Change, ...] | None:
    model = rotary_spec(spec.model)
    try:
        return _missing(spec, build_spring(model, lambda _: None))
    except InfeasibleError:
        return None


def _missing(spec: Spec, spring: Spring) -> tuple[Change, ...] | None:
    """Nothing where no check of the report fails; the backlash where nothing but that does."""
    failed = [claim for claim in summarise(spec, spring).checks if claim.status == "fail"]
    if [claim for claim in failed if not claim.name.endswith(INTERFERENCE)]:
        return None
    return tuple(more_backlash(spring.spec, claim.value) for claim in failed)


def _some_ring_is_possible(spec: Spec) -> bool:
    return any_candidate(Aim.of(rotary_spec(spec.model)))


def _some_ring_is_straight(spec: Spec) -> bool:
    """Such rings are designed in any choice, and quickly."""
    return any(ring.has_straight for ring in candidates(Aim.of(rotary_spec(spec.model))))


def _missing_to_first_straight_ring(spec: Spec) -> tuple[Change, ...] | None:
    """Of the first ring that a choice falls back on: where that passes, the choice has a spring."""
    aim = Aim.of(rotary_spec(spec.model))
    tried = Climb(aim, spring_with_room, lambda _: None)
    tried.straight([ring for ring in candidates(aim) if ring.has_straight][:1])
    best = tried.best
    return None if best is None or best.spring is None else _missing(spec, best.spring)


OF_A_RING = Judges(_ring_is_possible, _ring_has_shape, _missing_to_ring)
OF_A_CHOICE = Judges(
    _some_ring_is_possible, _some_ring_is_straight, _missing_to_first_straight_ring
)
