"""The leaves from spec to result: section, lengths, strokes, limits, part, wrist."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from springcad.errors import InfeasibleError
from springcad.geometry.outline_ops import profile_area, profile_faults
from springcad.kinds.leaf_2dof import estimate
from springcad.kinds.leaf_2dof.case import END_MARGIN, Case, Setup
from springcad.kinds.leaf_2dof.feasibility import exact_checks, require_feasible, setup_of
from springcad.kinds.leaf_2dof.inputs import case_of, leaf_spec
from springcad.kinds.leaf_2dof.limits import Reach, reach
from springcad.kinds.leaf_2dof.made import MadeLeaves
from springcad.kinds.leaf_2dof.parts import Planform, leaf_profile
from springcad.kinds.leaf_2dof.rods import diagonal_stiffness, rod_states
from springcad.kinds.leaf_2dof.sizing import GRID
from springcad.kinds.leaf_2dof.spec import Leaf2dofSpec
from springcad.kinds.leaf_2dof.summary import summarise
from springcad.kinds.leaf_2dof.unit import UnitStroke, stroke
from springcad.kinds.leaf_2dof.wrist import workspace_boundary
from springcad.result import Progress, Result
from springcad.spec.source import Spec

STROKES = 6
"""Effective lengths at which whole strokes are told."""
BETWEEN = 7
"""Steps from one of these to the next, at which limits are told."""
ANGLES = 41
"""Angles of a stroke."""
_PASSES = 6


def design_wrist(spec: Spec, progress: Progress) -> Result:
    """Design the leaves and say what the wrist does with them.

    Raises:
        InfeasibleError: no leaf can meet the spec.
    """
    return summarise(spec, make_leaves(leaf_spec(spec.model), progress))


def make_leaves(spec: Leaf2dofSpec, progress: Progress) -> MadeLeaves:
    """The leaves themselves, without words about them.

    Raises:
        InfeasibleError: no leaf can meet the spec; with changes that were tried and that work.
    """
    case = case_of(spec)
    require_feasible(case)
    progress("finding the leaf" if case.is_sized else "bending the leaf")
    case, setup = _exact(case)
    require_feasible(case)
    leaf, lever = setup.leaf, setup.lever
    lengths = np.linspace(setup.shortest, setup.longest, (STROKES - 1) * BETWEEN + 1)
    limit = None if math.isinf(case.max_bend_angle) else case.max_bend_angle
    within = reach(leaf, lever, lengths, case.design_stress, limit)
    strokes = _strokes(case, setup, within)
    planform = _planform(spec, setup, strokes)
    profile = leaf_profile(planform)
    faults = profile_faults(profile)
    if faults:
        claim = f"faults in the outline of the leaf ({'; '.join(faults)})"
        raise InfeasibleError(claim, len(faults), 0.0, "1")
    most = float(strokes.angle[-1, -1])
    density = spec.material.values.density.value
    return MadeLeaves(
        spec=spec,
        case=case,
        feasibility=exact_checks(case, setup),
        setup=setup,
        strokes=strokes,
        lengths=lengths,
        reach=within,
        yield_reach=reach(leaf, lever, lengths, case.yield_strength),
        planform=planform,
        profile=profile,
        rods=rod_states(setup, most),
        diagonal=diagonal_stiffness(setup, strokes.angle[-1]),
        boundary=workspace_boundary(most, most, spec.wrist.rod_length),
        mass=profile_area(profile) * leaf.thickness * density,
    )


def _exact(case: Case) -> tuple[Case, Setup]:
    """The case with stress and slope of the exact unit, and the setup that follows from it."""
    setup = setup_of(case)
    for _ in range(_PASSES):
        at = setup.leaf, setup.lever, setup.longest, case.deflection
        try:
            exact = stroke(*at)
        except ArithmeticError:
            return case, setup
        case = replace(case, stress_factor=float(exact.stress) / estimate.stress(*at))
        bent = estimate.bend(*at)
        if bent is not None:
            case = replace(case, slope_factor=float(exact.bend_angle) / bent.slope)
        before, setup = setup, setup_of(case)
        if setup == before:
            break
    return case, setup


def _strokes(case: Case, setup: Setup, within: Reach) -> UnitStroke:
    """Of one leaf (P, A): to what is allowed, at the longest length as far as asked."""
    lengths = within.unit.length[::BETWEEN]
    ends = np.minimum(within.unit.angle[::BETWEEN], case.deflection)
    ends[-1] = min(case.deflection, float(within.by_geometry[-1]))
    angles = ends[:, None] * np.linspace(0.0, 1.0, ANGLES)
    return stroke(setup.leaf, setup.lever, lengths[:, None], angles)


def _planform(spec: Leaf2dofSpec, setup: Setup, strokes: UnitStroke) -> Planform:
    """The leaf goes on behind the furthest contact, corners and margin included."""
    travel = max(0.0, float(np.max(strokes.station - strokes.length)))
    overhang = travel + END_MARGIN + spec.leaf.end_radius
    return Planform(
        width=setup.leaf.width,
        mount=spec.mount.length,
        guide=spec.guide.length,
        longest=setup.longest,
        overhang=round(math.ceil(overhang / (10.0 * GRID)) * 10.0 * GRID, 9),
        end_radius=spec.leaf.end_radius,
        hole_count=spec.mount.holes,
        hole_diameter=spec.mount.hole_diameter,
    )
