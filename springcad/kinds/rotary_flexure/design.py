"""The rotary flexure spring from spec to result: law, shape, ring, camshaft, response, checks."""

from __future__ import annotations

from dataclasses import replace

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Profile
from springcad.geometry.outline_ops import profile_area, profile_faults
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.camshaft import CamshaftInputs, design_camshaft
from springcad.kinds.rotary_flexure.case import Case, resolved_style
from springcad.kinds.rotary_flexure.checks import full_load_gaps
from springcad.kinds.rotary_flexure.feasibility import failures, require_feasible
from springcad.kinds.rotary_flexure.inputs import case_of, target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.response import stroke
from springcad.kinds.rotary_flexure.ring import Dowels, ring_profile
from springcad.kinds.rotary_flexure.sizing import Sized, size_flexure
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.target_law import Law
from springcad.result import Check, Progress


def build_spring(spec: RotaryFlexureSpec, progress: Progress) -> Spring:
    """The spring of a spec that leaves nothing open.

    Raises:
        InfeasibleError: no part can meet the spec.
    """
    case = case_of(spec).shifted
    feasibility = require_feasible(case)
    try:
        return spring_of(spec, case, feasibility, progress)
    except InfeasibleError:
        other = _other_style(case)
        if other is None:
            raise
        try:
            return spring_of(spec, other, feasibility, progress)
        except InfeasibleError:
            pass
        raise


def _other_style(case: Case) -> Case | None:
    """The case with the style that ``auto`` has not taken, where closed forms allow that too.

    Where straight flexures are just too strong or just too weak, one style may do in which the
    closed forms do not see it.
    """
    if case.style != "auto":
        return None
    taken = resolved_style(design_law(case.inputs), case.style)
    other = replace(case, style="straight" if taken == "serpentine" else "serpentine")
    return None if failures(other) else other


def spring_of(
    spec: RotaryFlexureSpec, case: Case, feasibility: tuple[Check, ...], progress: Progress
) -> Spring:
    """The spring of a case that is feasible; InfeasibleError where no part is found."""
    sized = size_flexure(spec, case, design_law(case.inputs), target_of(spec), progress)
    return _finished(spec, case, feasibility, sized, progress)


def spring_with_room(
    spec: RotaryFlexureSpec, case: Case, feasibility: tuple[Check, ...], progress: Progress
) -> Spring:
    """The same, given up before the camshaft where the sized flexures come too close at full load.

    Raises:
        InfeasibleError: no part is found, or the gap is below the smallest wanted.
    """
    sized = size_flexure(spec, case, design_law(case.inputs), target_of(spec), progress)
    for claim in full_load_gaps(spec, case, sized):
        if claim.status == "fail":
            raise InfeasibleError(claim.name, claim.value, claim.limit, claim.unit)
    return _finished(spec, case, feasibility, sized, progress)


def _finished(
    spec: RotaryFlexureSpec,
    case: Case,
    feasibility: tuple[Check, ...],
    sized: Sized,
    progress: Progress,
) -> Spring:
    """Ring, camshaft and stroke of flexures that are sized."""
    law, target, ribbon = design_law(case.inputs), target_of(spec), sized.found.ribbon
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
