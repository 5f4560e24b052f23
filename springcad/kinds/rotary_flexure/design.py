"""The rotary flexure spring from spec to result: law, shape, ring, camshaft, response, checks."""

from __future__ import annotations

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Profile
from springcad.geometry.outline_ops import profile_area, profile_faults
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.aim import is_open
from springcad.kinds.rotary_flexure.camshaft import CamshaftInputs, design_camshaft
from springcad.kinds.rotary_flexure.case import Case, resolved_style
from springcad.kinds.rotary_flexure.checks import spring_checks
from springcad.kinds.rotary_flexure.choice_report import with_choice
from springcad.kinds.rotary_flexure.choosing import Choice, choose
from springcad.kinds.rotary_flexure.feasibility import failures, require_feasible
from springcad.kinds.rotary_flexure.full_load import DIRECTIONS
from springcad.kinds.rotary_flexure.inputs import case_of, rotary_spec, target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.overrange import end_of_use
from springcad.kinds.rotary_flexure.response import stroke
from springcad.kinds.rotary_flexure.ring import Dowels, ring_profile
from springcad.kinds.rotary_flexure.sizing import size_flexure
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.stack import of_sheet, stack_of
from springcad.kinds.rotary_flexure.summary import summarise
from springcad.kinds.rotary_flexure.trials import (
    BEND_LIMIT,
    DEFLECTION,
    THICKER_TIP,
    THINNER_TIP,
    changes_that_work,
)
from springcad.kinds.target_law import Law
from springcad.result import Check, Progress, Result
from springcad.spec.source import Spec


def design_spring(spec: Spec, progress: Progress) -> Result:
    """Design ring and camshaft and say what they do; what is left open is chosen first.

    Raises:
        InfeasibleError: no part can meet the spec.
    """
    spring, choice = decide(rotary_spec(spec.model), progress)
    result = summarise(spec, spring)
    return result if choice is None else with_choice(result, choice)


def decide(spec: RotaryFlexureSpec, progress: Progress) -> tuple[Spring, Choice | None]:
    """The spring, and how it was chosen where the spec leaves something open.

    Raises:
        InfeasibleError: no part can meet the spec.
    """
    try:
        if not is_open(spec):
            return build_spring(spec, progress), None
        choice = choose(spec, spring_of, progress)
        return choice.spring, choice
    except InfeasibleError as error:
        raise of_sheet(error, stack_of(spec)) from error


def build_spring(spec: RotaryFlexureSpec, progress: Progress) -> Spring:
    """The spring itself, without words about it.

    Raises:
        InfeasibleError: no part can meet the spec; with changes that were tried and that work.
    """
    case = case_of(spec).shifted
    feasibility = require_feasible(case)
    try:
        return spring_of(spec, case, feasibility, progress)
    except InfeasibleError as error:
        progress("no part can be made: trying what would help")
        bends = resolved_style(design_law(case.inputs), case.style) == "serpentine"
        knobs = (*([BEND_LIMIT] if bends else []), DEFLECTION, THICKER_TIP, THINNER_TIP)
        raise error.with_remedies(*changes_that_work(spec, knobs, _is_possible, _passes)) from error


def _is_possible(spec: RotaryFlexureSpec) -> bool:
    """Whether every closed form holds."""
    return not failures(case_of(spec).shifted)


def _passes(spec: RotaryFlexureSpec) -> bool:
    """Whether the spec can be designed and every check of the spring holds."""
    try:
        spring = spring_of(spec, case_of(spec).shifted, (), lambda _: None)
    except InfeasibleError:
        return False
    return all(claim.status != "fail" for claim in spring_checks(spring))


def spring_of(
    spec: RotaryFlexureSpec, case: Case, feasibility: tuple[Check, ...], progress: Progress
) -> Spring:
    """The spring of a case that is feasible; InfeasibleError where no part is found."""
    law, target = design_law(case.inputs), target_of(spec)
    sized = size_flexure(spec, case, law, target, progress)
    ribbon = sized.found.ribbon
    progress("making the ring")
    dowels = spec.mounting.dowels
    ring = ring_profile(
        ribbon,
        case.inputs.root_radius,
        case.outer_radius,
        case.inputs.count,
        sized.fillet,
        sized.blend,
        Dowels(dowels.count, dowels.radius) if dowels else None,
    )
    _require_valid("flexure ring", ring)
    progress("making the camshaft")
    inputs = camshaft_inputs(spec, case, target, ribbon)
    camshaft = design_camshaft(sized.beam, inputs)
    _require_valid("camshaft", camshaft.profile)
    progress("turning the spring through its stroke")
    clockwise, counter_clockwise = (
        stroke(ribbon, sized.beam, camshaft, inputs, direction, spec.camshaft.friction)
        for direction in (-1, 1)
    )
    forward, backward = (
        end_of_use(ribbon, sized.beam, camshaft, inputs, direction, case.yield_strength)
        for direction in DIRECTIONS
    )
    return Spring(
        spec=spec,
        case=case,
        law=law,
        target=target,
        feasibility=feasibility,
        sized=sized,
        ring=ring,
        camshaft_inputs=inputs,
        camshaft=camshaft,
        strokes=(counter_clockwise, clockwise),
        ends=(forward, backward),
        mass=profile_area(ring) * case.inputs.thickness * spec.material.values.density.value,
    )


def camshaft_inputs(
    spec: RotaryFlexureSpec, case: Case, target: Law, ribbon: Ribbon
) -> CamshaftInputs:
    """The camshaft for the torque law of the spec."""
    return CamshaftInputs(
        root_radius=case.inputs.root_radius,
        count=case.inputs.count,
        nose_station=ribbon.length,
        pad_start=float(ribbon.edges[-2]),
        deflection=target.deflection,
        torque=target.torque,
        energy=target.energy,
        poisson_ratio=spec.material.values.poisson_ratio.value,
        sheets=case.stack.parallel,
        bore_radius=case.camshaft_bore_radius,
        backlash=spec.camshaft.backlash,
    )


def _require_valid(part: str, profile: Profile) -> None:
    """A drawing that a shop could not cut is never written."""
    faults = profile_faults(profile)
    if faults:
        raise InfeasibleError(
            f"faults in the outline of the {part} ({'; '.join(faults)})", len(faults), 0.0, "1"
        )
