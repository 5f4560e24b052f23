"""The search for an omega leaf: many linear searches, restarts near the best, exact polish."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from springcad.errors import InfeasibleError
from springcad.kinds.lever_arm.omega import (
    OmegaCase,
    OmegaDesign,
    OmegaSpread,
    omega_response,
)
from springcad.kinds.lever_arm.omega_form import (
    ANGLE_RANGE,
    ANGLES,
    LENGTH,
    THICKNESS_RANGE,
    VARIABLES,
    leaf_of,
    variables_of,
)
from springcad.kinds.lever_arm.omega_problem import ExactProblem, bounds, linear_problem
from springcad.kinds.lever_arm.omega_rows import STRESS_ROWS
from springcad.kinds.lever_arm.omega_starts import start_point
from springcad.optimise.random import uniform
from springcad.optimise.sqp import Evaluation, Solution, solve

Floats = NDArray[np.float64]
Searched = partial[Evaluation] | ExactProblem

ITERATIONS = 80
"""Of each linear search; that is enough to tell which optimum it is going to."""
FINISHING = 60
"""Of the best ones after that, and on the nonlinear beam."""
TRIMS, CLEARINGS = 4, 2
CLEAR_AT = np.linspace(0.0, 1.0, 5)
"""Of the stroke, where gaps are looked at on dense points; to the other side they are the same."""
ROUGH = 3e-3
"""Largest violation of a search that counts: 0.3 % of a limit, or of R_c."""
TOLERANCE = 1e-4
"""Of a search: change of the objective, relative to k/b, and violation."""
FEASIBLE = 2e-4
FINISHED, RESTARTED, POLISHED = 3, 3, 2
"""How many of the best are finished, how many restarts are made, and how many are polished."""
SHAKE_STREAM = 1_000_000
"""Of the random numbers: beyond those of any start."""
ANGLE_SHAKE, THICKNESS_SHAKE = 0.25, 0.15
"""Size of the random change before a restart, in rad and as a share."""


def find(case: OmegaCase, starts: int, seed: int, progress: Callable[[str], None]) -> OmegaDesign:
    """See ``omega.find_omega``."""
    with threadpool_limits(1, user_api="blas"):
        linear, spread = _linear_search(case, starts, seed, progress)
        exact = _polished(case, linear, progress)
    best = linear[0]
    return OmegaDesign(
        case=case,
        leaf=leaf_of(case, exact.variables),
        stiffness=stiffness(exact),
        linear_leaf=leaf_of(case, best.variables),
        linear_stiffness=stiffness(best),
        spread=spread,
    )


def stiffness(solution: Solution) -> float:
    """k/b, N/m per m, of a solution."""
    return float(np.exp(-solution.objective)) * 1e6


def _linear_search(
    case: OmegaCase, starts: int, seed: int, progress: Callable[[str], None]
) -> tuple[list[Solution], OmegaSpread]:
    """The best finished searches, best first, then the other feasible ones; the spread of all."""
    problem = partial(linear_problem, case)
    found: list[Solution] = []

    def search(start: Floats, label: str) -> None:
        at = solve(
            problem,
            start,
            bounds(case),
            values=partial(problem, slopes=False),
            index=len(found),
            max_iterations=ITERATIONS,
            tolerance=TOLERANCE,
        )
        found.append(at)
        progress(f"{label}: {stiffness(at) * 1e-6:.2f} N/mm per mm of width")

    for index in range(starts):
        search(start_point(case, seed, index), f"start {index + 1} of {starts}")
    for index in range(RESTARTED):
        for rank, best in enumerate(_best(found, 2, ROUGH)):
            shaken = _shaken(best.variables, seed, SHAKE_STREAM + 2 * index + rank)
            search(shaken, f"restart {2 * index + rank + 1} of {2 * RESTARTED}")
    progress("finishing the best searches")
    rough = _best(found, len(found), ROUGH)
    if not rough:
        claim = f"searches, of {len(found)}, that found a leaf within all limits"
        raise InfeasibleError(claim, 0.0, 1.0, "1")
    finished = [_continued(problem, case, at) for at in rough[:FINISHED]]
    good = _best(finished, FINISHED, FEASIBLE) or rough[:FINISHED]
    values = sorted((stiffness(at) for at in found if at.violation <= ROUGH), reverse=True)
    return [*good, *rough[FINISHED:]], OmegaSpread(len(found), np.array(values))


def _polished(case: OmegaCase, linear: list[Solution], progress: Callable[[str], None]) -> Solution:
    """The best of the linear leaves after a search on the nonlinear beam.

    The first ones, and where none of them keeps its limits there, the next that does.
    """
    found: list[Solution] = []
    for rank, at in enumerate(linear):
        if rank >= POLISHED and _best(found, 1, FEASIBLE):
            break
        progress(f"correcting leaf {rank + 1} on the nonlinear beam")
        problem = ExactProblem(case)
        start = replace(at, variables=_thinned(problem, at.variables))
        found.append(_cleared(case, _trimmed(problem, _continued(problem, case, start))))
    best = _best(found, 1, FEASIBLE)
    if not best:
        closest = min(found, key=lambda at: at.violation)
        if not np.isfinite(closest.violation):
            claim = f"leaves, of {len(found)}, that neither touch nor buckle on the nonlinear beam"
            raise InfeasibleError(claim, 0.0, 1.0, "1")
        claim = "largest violation of a limit, as a share of it, on the nonlinear beam"
        raise InfeasibleError(claim, closest.violation, FEASIBLE, "1")
    return best[0]


def _cleared(case: OmegaCase, at: Solution) -> Solution:
    """The leaf, searched on with wider gaps if those between the search's points are too small.

    A polygon through the points of a search cuts sharp bends short.
    """
    asked = case.min_gap
    for clearing in range(CLEARINGS + 1):
        leaf = leaf_of(case, at.variables)
        try:
            states = omega_response(leaf, case, 1.0, case.stroke * CLEAR_AT)
        except ArithmeticError:  # a leaf that has no equilibrium at the stroke is none
            return replace(at, violation=np.inf)
        gaps = np.concatenate([states.self_gap, states.wall_gap, states.corridor_gap])
        short = case.min_gap - float(np.min(gaps))
        if short <= 0.0:
            break
        if clearing == CLEARINGS:
            return replace(at, violation=np.inf)
        asked += short + FEASIBLE * case.enclosure_radius
        wider = replace(case, min_gap=asked)
        problem = ExactProblem(wider)
        at = _trimmed(problem, _continued(problem, wider, at))
    return at


def _trimmed(problem: ExactProblem, at: Solution) -> Solution:
    """The leaf with thickness and length so little changed that it keeps to the allowable stress.

    A search may stop where several stresses are a few parts in a thousand above it; the length
    follows so that the leaf still ends at the wall.
    """
    trimmed = at.variables.copy()
    for _ in range(TRIMS):
        trimmed = _thinned(problem, trimmed)
        end = problem(trimmed)
        trimmed[LENGTH] -= end.equalities[0] / end.equality_jacobian[0, LENGTH]
    end = problem(trimmed, slopes=False)
    return replace(at, variables=trimmed, objective=end.objective, violation=end.violation)


def _thinned(problem: ExactProblem, variables: Floats) -> Floats:
    """The leaf so much thinner that its stress is about the allowable one on the nonlinear beam.

    At a given displacement the stress is about proportional to the thickness.
    """
    thinner = variables.copy()
    margins = problem(thinner, slopes=False).inequalities[: 2 * STRESS_ROWS]
    thinner[THICKNESS_RANGE] *= 1.0 / (1.0 - float(np.min(margins)))
    return thinner


def _continued(problem: Searched, case: OmegaCase, at: Solution) -> Solution:
    # Snapped, so that rounding on another machine does not send the search elsewhere.
    start = variables_of(case, leaf_of(case, at.variables))
    return solve(
        problem,
        start,
        bounds(case),
        values=partial(problem, slopes=False),
        index=at.start,
        max_iterations=FINISHING,
        tolerance=TOLERANCE,
    )


def _best(solutions: Iterable[Solution], count: int, feasible_below: float) -> list[Solution]:
    """The ``count`` best feasible and different ones, best first."""
    feasible = sorted(
        (at for at in solutions if at.violation <= feasible_below),
        key=lambda at: (round(at.objective, 4), at.start),
    )
    kept: list[Solution] = []
    for at in feasible:
        if all(np.max(np.abs(at.variables - other.variables)) > 0.05 for other in kept):
            kept.append(at)
    return kept[:count]


def _shaken(variables: Floats, seed: int, stream: int) -> Floats:
    """The variables with a random change of angles and thicknesses."""
    draw = 2.0 * uniform(seed, stream, VARIABLES) - 1.0
    shaken = variables.copy()
    shaken[ANGLE_RANGE] += ANGLE_SHAKE * draw[:ANGLES]
    shaken[THICKNESS_RANGE] *= 1.0 + THICKNESS_SHAKE * draw[THICKNESS_RANGE]
    return shaken
