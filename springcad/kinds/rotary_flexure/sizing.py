"""The flexure sized for its stiffness and its stress as the spring it will be.

The design law clamps the flexure at the root radius and knows small deflections only. Finite
elements of the root say how far the first is from the truth (``root_compliance``), a beam with
large deflections on the camshaft to be how far the second is. From the shape that the search finds
for the law, thickness, pad and length are corrected (``correction``) until the stiffness at rest
is the wanted one and the stress at full load is the allowed one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from springcad.errors import InfeasibleError
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.correction import (
    Loading,
    corrected,
    gap_allowance,
    loading,
    stations_of,
    straight_level,
)
from springcad.kinds.rotary_flexure.full_load import demand_of, loads_of, stiffness_at_rest
from springcad.kinds.rotary_flexure.law import DesignLaw, design_law
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.kinds.rotary_flexure.relief import Relief, allowed_share
from springcad.kinds.rotary_flexure.root import Root, chosen_root, flexure_on, root_with
from springcad.kinds.rotary_flexure.root_compliance import RootModel
from springcad.kinds.rotary_flexure.search import Found, adapted, find_shape
from springcad.kinds.rotary_flexure.settling import CLOSE, EVEN, Settling
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.straight_limit import (
    STRAIGHT_EXCESS,
    STRAIGHT_LIMIT,
    STRAIGHT_STRESS,
    straight_limit,
)
from springcad.kinds.target_law import Law, law_of, polynomial
from springcad.mechanics.beam import BeamStates, PreparedBeam
from springcad.result import Progress

SOFTER = 0.9995
"""Stiffness at rest, over the wanted one, that the sizing aims at: a flexure that is too stiff
would have to be touched beyond its nose."""
FILLET_THAT_FITS = "root fillet that fits between neighbours"
NEIGHBOURS = "gap between neighbouring flexures"
"""Limits of room, each with the number that would do."""
PASSES = 16
SHAPED = 3
"""In the first passes the shape is optimised for its gap at full load; then it only follows the
thickness, so that the passes settle."""
FILLETED = 2
"""In the first passes the fillet is chosen; then it stays."""


@dataclass(frozen=True)
class Sized:
    """A flexure with its root.

    Attributes:
        found: its shape.
        fillet: root fillet radius, m.
        blend: radius between taper and pad, m.
        root: what the root adds to a clamped beam.
        beam: the flexure as a beam on the root's spring.
        stiffness_at_rest: of the whole ring with contact at the contact radius, N m/rad.
        root_relief: stress allowed at the root over the design stress, below 1 for the fillets'
            sake.
        evenness: largest deviation of the stress at full load from the allowed one before the pad,
            as a share.
        level: stress of a straight flexure over the allowed one, the same before the pad; 1 for a
            serpentine one, whose length makes it so.
        passes: corrections of the shape that were made.
    """

    found: Found
    fillet: float
    blend: float
    root: RootModel
    beam: PreparedBeam
    stiffness_at_rest: float
    root_relief: float
    evenness: float
    level: float
    passes: int


def size_flexure(
    spec: RotaryFlexureSpec, case: Case, law: DesignLaw, target: Law, progress: Progress
) -> Sized:
    """Shape, fillet and root of the flexures for the torque law ``target``.

    Raises:
        InfeasibleError: no shape or no fillet fits, the gap is below the smallest wanted, straight
            flexures would bear more than the design stress, or the sizing does not settle.
    """
    progress("searching for the shape of the flexures")
    sized = corrected_for(spec, case, target, find_shape(spec, case, law, progress), progress)
    _require_room(spec, case, sized)
    _require_strength(spec, case, sized, progress)
    return sized


def corrected_for(
    spec: RotaryFlexureSpec, case: Case, target: Law, found: Found, progress: Progress
) -> Sized:
    """The shape that the search found for the design law, corrected until it is right.

    Raises:
        InfeasibleError: no shape or no fillet fits, or the sizing does not settle.
    """
    inputs = case.inputs
    demand = demand_of(target, inputs.root_radius, inputs.contact_radius, inputs.count)
    root, relief, settling = None, Relief(), Settling()
    kept: Sized | None = None
    best = (True, math.inf)
    for number in range(PASSES):
        progress(f"correcting the flexures for full load, pass {number + 1}")
        if number < FILLETED or root is None:
            root = chosen_root(spec, case, found.ribbon, root)
        else:
            root = root_with(spec, case, found.ribbon, root.fillet)
        beam = flexure_on(spec, case, found.ribbon, root.model.compliance)
        stiffness = stiffness_at_rest(found.ribbon, beam, demand)
        share = stiffness / (SOFTER * demand.stiffness)
        states = loads_of(found.ribbon, beam, demand, share)
        relief = _relieved(spec, root, states, relief)
        load = _loading(spec, case, found.ribbon, states, relief.share, share)
        level = 1.0 if found.line else straight_level(found.problem, found.ribbon, load)
        sized = Sized(
            found=found,
            fillet=root.fillet,
            blend=root.blend,
            root=root.model,
            beam=beam,
            stiffness_at_rest=inputs.count * stiffness,
            root_relief=relief.share,
            evenness=load.unevenness(found.ribbon, level),
            level=level,
            passes=number,
        )
        off = abs(share - 1.0)
        rank = (not relief.kept, sized.evenness)
        if off <= CLOSE and rank <= best:
            kept, best = sized, rank
        if kept is sized and rank <= (False, EVEN):
            return sized
        if settling.ended(off, sized.evenness, shaping=number <= SHAPED):
            break
        problem = corrected(found.problem, found.ribbon, load, level)
        if found.line and number < SHAPED:
            problem = _with_allowance(problem, found.ribbon, beam, states)
        found = adapted(spec, found, problem, freeze=number >= SHAPED)
    if kept is not None:
        return kept
    wanted = inputs.count * demand.stiffness
    claim = "stiffness at rest that the sizing arrives at"
    raise InfeasibleError(claim, sized.stiffness_at_rest, wanted, "N*m/rad")


def _loading(
    spec: RotaryFlexureSpec,
    case: Case,
    ribbon: Ribbon,
    states: tuple[BeamStates, BeamStates],
    relief: float,
    share: float,
) -> Loading:
    stations = stations_of(ribbon, states)
    return loading(
        ribbon,
        states,
        case.inputs.root_radius - case.inputs.contact_radius,
        share * case.inputs.design_stress * allowed_share(ribbon, stations, relief),
        share,
        local=spec.stress == "local",
    )


def _relieved(
    spec: RotaryFlexureSpec, root: Root, states: tuple[BeamStates, BeamStates], relief: Relief
) -> Relief:
    """The relief of the root that the stress of its fillets asks for."""
    limit = spec.flexures.fillet_stress
    if limit is None:
        return relief
    nominal = max(float(state.nominal_stress[-1, 0]) for state in states)
    return relief.after(root.model.fillet_stress_factor * nominal, limit)


def _with_allowance(
    problem: FlexureProblem,
    ribbon: Ribbon,
    beam: PreparedBeam,
    states: tuple[BeamStates, BeamStates],
) -> FlexureProblem:
    allowance = gap_allowance(ribbon, beam, states, problem.root_radius, problem.count)
    return replace(problem, gap_allowance=allowance)


def _require_strength(
    spec: RotaryFlexureSpec, case: Case, sized: Sized, progress: Progress
) -> None:
    """Refuse straight flexures that are too weak, with the deflection that they do reach."""
    if sized.level <= 1.0 + STRAIGHT_EXCESS:
        return
    if case.law is not None:
        allowed = case.inputs.design_stress
        raise InfeasibleError(STRAIGHT_STRESS, sized.level * allowed, allowed, "Pa")

    def level(deflection: float) -> float:
        tried = replace(case, inputs=replace(case.inputs, deflection=deflection))
        found = find_shape(spec, tried, design_law(tried.inputs), progress)
        target = law_of(polynomial((case.inputs.stiffness,), deflection), deflection)
        return corrected_for(spec, tried, target, found, progress).level

    progress("looking for the deflection that straight flexures reach")
    asked = case.inputs.deflection
    limit = straight_limit(level, asked, sized.level)
    raise InfeasibleError(STRAIGHT_LIMIT, asked, limit, "rad")


def _require_room(spec: RotaryFlexureSpec, case: Case, sized: Sized) -> None:
    """Refuse a fillet or a gap that is smaller than asked for, with what is there."""
    fillet, gap = spec.flexures.root_fillet, sized.found.gap
    if not isinstance(fillet, str) and sized.fillet < fillet:
        raise InfeasibleError(FILLET_THAT_FITS, sized.fillet, fillet, "m")
    if gap < case.min_gap:
        raise InfeasibleError(NEIGHBOURS, gap, case.min_gap, "m")
