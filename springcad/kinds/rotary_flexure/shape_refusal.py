"""Which limit stops the search for a shape, and by how much: said of the best shape there is.

A search ends in one of two ways. It meets every limit, but neighbours overlap: then the gap is
what stops it, and the smallest overlap found is told. Or it meets no limit, as bends as flat as
asked for cannot store the energy in the room there is: then the bend limit is raised until it does,
and the flattest bends found are told.
"""

from __future__ import annotations

from dataclasses import replace

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.control_points import ControlPointOutcome
from springcad.kinds.rotary_flexure.curvature_form import (
    FEASIBLE,
    CurvatureOptimum,
    optimise,
    reoptimise,
    start_point,
)
from springcad.kinds.rotary_flexure.curvature_problem import CurvatureProblem
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.kinds.rotary_flexure.spec_sections import Optimiser
from springcad.optimise.sqp import solve_from_many

SHARPEST = 0.6
"""Largest bend limit that a spec may give."""
BEND_STEP = 0.01
SEARCHES = 3
"""To name a limit fewer searches are made than to find a shape."""
GAP = "gap between neighbouring flexures in the best shape found"
BEND = "half thickness x curvature in the flattest shape found"


class NoShapeError(InfeasibleError):
    """No search met every limit of a problem.

    Attributes:
        problem: what was searched for.
        nearest: of the control points, the shape that misses by least; None for the curvature form.
    """

    def __init__(
        self, claim: str, problem: FlexureProblem, nearest: ControlPointOutcome | None
    ) -> None:
        super().__init__(claim, 0.0, 1.0, "1")
        self.problem = problem
        self.nearest = nearest


def limit_of(miss: NoShapeError, settings: Optimiser, min_gap: float) -> InfeasibleError:
    """The refusal with the limit that stops the search; ``min_gap`` (m) is the gap wanted."""
    if miss.nearest is not None:
        return _of_control_points(miss, miss.nearest, min_gap)
    settings = settings.model_copy(update={"starts": min(settings.starts, SEARCHES)})
    gap = _largest_gap(miss.problem, settings)
    if gap is not None and gap < min_gap:
        return _told(miss, GAP, gap, min_gap, "m")
    flattest = _flattest(miss.problem, settings)
    if flattest is not None:
        return _told(miss, BEND, flattest, miss.problem.bend_limit, "1")
    return miss


def _told(miss: NoShapeError, claim: str, value: float, limit: float, unit: str) -> InfeasibleError:
    words = f"{claim} ({miss.claim}: none)"
    return InfeasibleError(words, value, limit, unit)


def _largest_gap(problem: FlexureProblem, settings: Optimiser) -> float | None:
    """Of the shapes that meet all other limits, m, negative where neighbours overlap; or None."""
    searched = CurvatureProblem(problem, coefficients=settings.coefficients)
    starts = [start_point(searched, settings.seed, index) for index in range(settings.starts)]
    ends = solve_from_many(searched, starts, searched.bounds)
    gaps = [float(end.variables[-1]) for end in ends if end.violation <= FEASIBLE]
    return max(gaps) * problem.root_half_thickness if gaps else None


def _flattest(problem: FlexureProblem, settings: Optimiser) -> float | None:
    """The smallest bend limit, in whole steps, down to which a shape is found; None for none."""
    shape: CurvatureOptimum | None = optimise(
        replace(problem, bend_limit=SHARPEST),
        starts=settings.starts,
        seed=settings.seed,
        coefficients=settings.coefficients,
    )
    if shape is None:
        return None
    works, fails = round(SHARPEST / BEND_STEP), round(problem.bend_limit / BEND_STEP)
    while works - fails > 1:
        middle = (works + fails) // 2
        flatter = replace(problem, bend_limit=BEND_STEP * middle)
        found = reoptimise(flatter, shape, freeze=False)
        works, fails = (works, middle) if found is None else (middle, fails)
        shape = found or shape
    return round(BEND_STEP * works, 2)


def _of_control_points(
    miss: NoShapeError, nearest: ControlPointOutcome, min_gap: float
) -> InfeasibleError:
    """The limit that the nearest shape misses by most, as a share of the limit."""
    problem = miss.problem
    claims = (
        (GAP, nearest.smallest_gap, min_gap, "m"),
        (BEND, nearest.largest_bend, problem.bend_limit, "1"),
        ("serpentine factor of the nearest shape found", nearest.serpentine_factor,
         problem.serpentine_factor, "1"),
    )  # fmt: skip
    misses = (
        (min_gap - nearest.smallest_gap) / min_gap,
        nearest.largest_bend / problem.bend_limit - 1.0,
        abs(nearest.serpentine_factor / problem.serpentine_factor - 1.0),
    )
    return _told(miss, *claims[misses.index(max(misses))])
