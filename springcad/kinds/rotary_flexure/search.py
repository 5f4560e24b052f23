"""The search for the shape of one flexure, and the same shape adapted to a corrected problem."""

from __future__ import annotations

from dataclasses import dataclass

from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.case import Case, resolved_style
from springcad.kinds.rotary_flexure.clearance import flexure_gap
from springcad.kinds.rotary_flexure.control_points import (
    ControlPointOutcome,
    optimise_control_points,
    reoptimise_control_points,
)
from springcad.kinds.rotary_flexure.curvature_form import CurvatureOptimum, optimise, reoptimise
from springcad.kinds.rotary_flexure.law import DesignLaw
from springcad.kinds.rotary_flexure.problem import FlexureProblem, thickened
from springcad.kinds.rotary_flexure.shape import curvature_ribbon, straight_ribbon
from springcad.kinds.rotary_flexure.shape_refusal import NoShapeError
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.result import Progress

Line = CurvatureOptimum | ControlPointOutcome


@dataclass(frozen=True)
class Found:
    """A shape and how it was found.

    Attributes:
        problem: what it was found for.
        ribbon: the flexure.
        line: its centre line in the form of the search, None where it is straight.
        gap: smallest gap between unloaded neighbours, on polygons, m.
        starts, feasible: searches made and searches that met every constraint; 0 if straight.
        gaps: centre-line clearance that each feasible search reached, m, best first.
    """

    problem: FlexureProblem
    ribbon: Ribbon
    line: Line | None
    gap: float
    starts: int = 0
    feasible: int = 0
    gaps: tuple[float, ...] = ()

    @property
    def style(self) -> str:
        """Straight or serpentine."""
        return "straight" if self.line is None else "serpentine"


def find_shape(spec: RotaryFlexureSpec, case: Case, law: DesignLaw, progress: Progress) -> Found:
    """The straight flexure of the design law, or the best serpentine one found for it.

    Raises:
        InfeasibleError: no search met the requirements.
    """
    problem, settings = problem_of(spec, law), spec.optimiser
    if resolved_style(law, case.style) == "straight":
        shift = law.inputs.shift
        return _found(thickened(problem, law.straight_thickness_factor, shift), None)
    line: Line | None
    if settings.form == "control-points":
        line = optimise_control_points(
            problem,
            starts=settings.starts,
            seed=settings.seed,
            control_points=settings.control_points,
            weighting=settings.weighting,
            progress=progress,
        )
    else:
        line = optimise(
            problem,
            starts=settings.starts,
            seed=settings.seed,
            coefficients=settings.coefficients,
            progress=progress,
        )
    return _serpentine(spec, problem, line)


def adapted(
    spec: RotaryFlexureSpec, found: Found, problem: FlexureProblem, *, freeze: bool
) -> Found:
    """The shape near ``found`` that meets ``problem``, with ``freeze`` the nearest one.

    Raises:
        InfeasibleError: the search from there does not meet the requirements.
    """
    if found.line is None:
        return _found(problem, None)
    line: Line | None
    if isinstance(found.line, ControlPointOutcome):
        line = reoptimise_control_points(
            problem, found.line, spec.optimiser.weighting, freeze=freeze
        )
    else:
        line = reoptimise(problem, found.line, freeze=freeze)
    return _serpentine(spec, problem, line, corrected=True)


def problem_of(spec: RotaryFlexureSpec, law: DesignLaw) -> FlexureProblem:
    """What the shape of one flexure must meet by the design law."""
    plain = FlexureProblem(
        span=law.span,
        root_radius=law.inputs.root_radius,
        count=law.inputs.count,
        root_half_thickness=law.root_half_thickness,
        tip_half_thickness=law.inputs.tip_half_thickness,
        serpentine_factor=law.serpentine_factor,
        bend_limit=spec.flexures.bend_limit,
        max_root_angle=spec.flexures.max_root_angle,
        local_stress=spec.stress == "local",
    )
    return plain if law.inputs.shift == 0.0 else thickened(plain, 1.0, law.inputs.shift)


def _serpentine(
    spec: RotaryFlexureSpec, problem: FlexureProblem, line: Line | None, *, corrected: bool = False
) -> Found:
    points = line if isinstance(line, ControlPointOutcome) else None
    if line is None or (points is not None and not points.feasible):
        claim = f"searches, of {spec.optimiser.starts}, that found a flexure within all limits"
        if corrected:
            claim += " once it was corrected for full load"
        raise NoShapeError(claim, problem, points)
    return _found(problem, line)


def _found(problem: FlexureProblem, line: Line | None) -> Found:
    if line is None:
        ribbon = straight_ribbon(problem)
    elif isinstance(line, ControlPointOutcome):
        ribbon = line.ribbon
    else:
        ribbon = curvature_ribbon(problem, line)
    gap = flexure_gap(ribbon, problem.root_radius, problem.count)
    if line is None:
        return Found(problem, ribbon, None, gap)
    if isinstance(line, ControlPointOutcome):
        return Found(
            problem, ribbon, line, gap, line.starts, line.feasible_starts, (line.smallest_gap,)
        )
    return Found(
        problem, ribbon, line, gap, line.starts, line.feasible, tuple(line.spread.tolist())
    )
