"""The search for the shape of one flexure."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from springcad.errors import InfeasibleError
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.clearance import flexure_gap
from springcad.kinds.rotary_flexure.control_points import optimise_control_points
from springcad.kinds.rotary_flexure.curvature_form import optimise
from springcad.kinds.rotary_flexure.feasibility import Case, resolved_style
from springcad.kinds.rotary_flexure.law import DesignLaw, straight_thickness_factor
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.kinds.rotary_flexure.shape import curvature_ribbon, straight_ribbon
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.result import Progress


@dataclass(frozen=True)
class Found:
    """A shape and how it was found.

    Attributes:
        ribbon: the flexure.
        style: straight or serpentine.
        gap: smallest gap between unloaded neighbours, on polygons, m.
        starts, feasible: searches made and searches that met every constraint; 0 if straight.
        gaps: centre-line clearance that each feasible search reached, m, best first.
    """

    ribbon: Ribbon
    style: str
    gap: float
    starts: int = 0
    feasible: int = 0
    gaps: tuple[float, ...] = ()


def find_shape(
    spec: RotaryFlexureSpec, case: Case, law: DesignLaw, progress: Progress, correction: float
) -> Found:
    """The straight flexure that the stiffness asks for, or the best serpentine one found.

    ``correction`` is a factor on the law's serpentine factor: above 1 for a softer flexure.

    Raises:
        InfeasibleError: no search met the requirements, or the gap is below the smallest wanted.
    """
    found = _search(spec, case, law, progress, correction)
    if found is None:
        claim = f"searches, of {spec.optimiser.starts}, that found a flexure within all limits"
        raise InfeasibleError(claim, 0.0, 1.0, "1")
    if found.gap < case.min_gap:
        claim = "gap between neighbouring flexures"
        raise InfeasibleError(claim, found.gap, case.min_gap, "m", _smaller_gap(spec, found))
    return found


def _smaller_gap(spec: RotaryFlexureSpec, found: Found) -> tuple[str, ...]:
    """The gap that was found, where that is wide enough for the process."""
    asked = spec.flexures.min_gap
    if asked is None or found.gap < spec.process.rules.min_gap:
        return ()
    gap = math.floor(1e5 * found.gap) / 1e2
    return (f"lower flexures.min_gap from {1e3 * asked:.4g} to {gap:g} mm",)


def problem_of(spec: RotaryFlexureSpec, law: DesignLaw, correction: float) -> FlexureProblem:
    """What the shape of one flexure must meet; see ``find_shape``."""
    return FlexureProblem(
        span=law.span,
        root_radius=law.inputs.root_radius,
        count=law.inputs.count,
        root_half_thickness=law.root_half_thickness,
        tip_half_thickness=law.inputs.tip_half_thickness,
        serpentine_factor=correction * law.serpentine_factor,
        bend_limit=spec.flexures.bend_limit,
        max_root_angle=spec.flexures.max_root_angle,
        local_stress=spec.stress == "local",
    )


def _search(
    spec: RotaryFlexureSpec, case: Case, law: DesignLaw, progress: Progress, correction: float
) -> Found | None:
    problem, settings = problem_of(spec, law, correction), spec.optimiser

    def gap(ribbon: Ribbon) -> float:
        return flexure_gap(ribbon, problem.root_radius, problem.count)

    corrected = replace(law, serpentine_factor=problem.serpentine_factor)
    if resolved_style(corrected, case.style) == "straight":
        ratio = problem.tip_half_thickness / problem.root_half_thickness
        thicker = float(straight_thickness_factor(problem.serpentine_factor, ratio))
        ribbon = straight_ribbon(problem, thicker)
        return Found(ribbon, "straight", gap(ribbon))
    if settings.form == "control-points":
        outcome = optimise_control_points(
            problem,
            starts=settings.starts,
            seed=settings.seed,
            control_points=settings.control_points,
            weighting=settings.weighting,
            progress=progress,
        )
        if not outcome.feasible:
            return None
        return Found(
            outcome.ribbon,
            "serpentine",
            gap(outcome.ribbon),
            outcome.starts,
            outcome.feasible_starts,
            (outcome.smallest_gap,),
        )
    optimum = optimise(problem, starts=settings.starts, seed=settings.seed, progress=progress)
    if optimum is None:
        return None
    ribbon = curvature_ribbon(problem, optimum)
    gaps = tuple(optimum.spread.tolist())
    return Found(ribbon, "serpentine", gap(ribbon), optimum.starts, optimum.feasible, gaps)
