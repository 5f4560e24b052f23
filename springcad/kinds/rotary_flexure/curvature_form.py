"""The centre line as a curvature spline: the default form of the shape optimisation.

Searches start from random waves, or from the shape that was found for a problem much alike.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.rotary_flexure.curvature_problem import COEFFICIENTS, CurvatureProblem
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.optimise.random import uniform
from springcad.optimise.sqp import Solution, best, solve_from_many

Floats = NDArray[np.float64]


def start_point(problem: CurvatureProblem, seed: int, index: int) -> Floats:
    """A random wave that already has the wanted serpentine factor.

    The tangent angle is a sine of two to four half waves, a weaker one of one half wave more and a
    slope at the root, all with random strength; bisection on the amplitude puts the search on the
    energy constraint from the beginning.
    """
    basis, draw = problem.basis, uniform(seed, index, 4)
    sigma, weights = basis.grid.nodes, basis.grid.weights
    half_waves = 2.0 + np.floor(3.0 * draw[0])
    shape = np.sin(np.pi * half_waves * sigma) * (1.0 if draw[1] < 0.5 else -1.0)
    shape += (draw[2] - 0.5) * np.sin(np.pi * (half_waves + 1.0) * sigma)
    shape += (draw[3] - 0.5) * np.cos(0.5 * np.pi * sigma)
    shape /= np.max(np.abs(shape))

    def at_amplitude(amplitude: float) -> tuple[float, float]:
        """Length of the curved part and energy, both as in the constraints."""
        along = np.cos(amplitude * shape)
        length = (problem.span - problem.pad) / float(weights @ along)
        taper = np.sqrt(
            np.maximum(1.0 - length * (basis.grid.cumulative @ along) / problem.lever, 0)
        )
        stored = float(weights @ (taper * problem.factor**-3.0))
        return length, length * stored + problem.pad_energy

    low, high = 0.0, 1.4
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if at_amplitude(middle)[1] < problem.energy else (low, middle)
    length, _ = at_amplitude(low)
    # Least squares for coefficients and root angle: angle = psi0 + S * (angle basis) c.
    columns = np.column_stack([length * basis.angle, np.ones(len(shape))])
    fitted = np.linalg.lstsq(columns, low * shape, rcond=None)[0]
    return np.concatenate([fitted[:-1], [length / problem.span, fitted[-1], 0.0]])


NEAR = 0.1
"""Weight of the gap where the search goes on from an earlier shape. The method takes the curvature
of the objective for one until it has learnt it: the less the gap weighs, the shorter are its first
steps, and the fewer it takes. From random waves that gains nothing."""
FEASIBLE = 1e-6
"""Constraints are of order one; a search that ends within this of them has met them."""


@dataclass(frozen=True)
class CurvatureOptimum:
    """The best centre line found, SI, and how the search went.

    Attributes:
        coefficients: of kappa(s), 1/m, the last one zero (see ``curvature_knots``).
        length: of the curved part, m.
        root_angle: rad.
        gap: smallest clearance to the neighbour along the curved part, m.
        starts, feasible: how many searches were made, and how many of them met every constraint
            and left a gap.
        spread: gap of every feasible search, m, best first.
    """

    coefficients: Floats
    length: float
    root_angle: float
    gap: float
    starts: int
    feasible: int
    spread: Floats


def optimise(
    flexure: FlexureProblem,
    *,
    starts: int,
    seed: int,
    coefficients: int = COEFFICIENTS,
    progress: Callable[[str], None] = lambda _: None,
) -> CurvatureOptimum | None:
    """Search from ``starts`` random waves; None when no search met the constraints.

    Variables are snapped to a grid far below any tolerance, so that the last digits of the linear
    algebra of another machine do not show.
    """
    problem = CurvatureProblem(flexure, coefficients=coefficients)
    solutions = solve_from_many(
        problem,
        [start_point(problem, seed, index) for index in range(starts)],
        problem.bounds,
        values=partial(problem, slopes=False),
        progress=progress,
    )
    # A search may end with neighbours that overlap: all rows hold, with a negative gap.
    sound = [s for s in solutions if s.violation <= FEASIBLE and s.variables[-1] > 0.0]
    winner = best(sound, feasible_below=FEASIBLE)
    if winner is None:
        return None
    spread = np.sort([s.variables[-1] * flexure.root_half_thickness for s in sound])[::-1]
    return replace(_optimum(flexure, winner), starts=starts, feasible=len(sound), spread=spread)


def reoptimise(
    flexure: FlexureProblem, earlier: CurvatureOptimum, *, freeze: bool
) -> CurvatureOptimum | None:
    """The optimum near that of a problem not much different; None where none is found.

    With ``freeze`` it is the nearest shape that meets the constraints, whatever its gap. A search
    that stops before it meets them goes on once from there: its estimate of the curvature of the
    objective may be what stopped it.
    """
    unit = flexure.root_half_thickness
    start = np.concatenate(
        [
            earlier.coefficients[:-1] * unit,
            [earlier.length / flexure.span, earlier.root_angle, earlier.gap / unit],
        ]
    )
    problem = CurvatureProblem(flexure, start if freeze else None, len(start) - 3, NEAR)
    values = partial(problem, slopes=False)
    (solution,) = solve_from_many(problem, [start], problem.bounds, values=values)
    if solution.violation > FEASIBLE:
        start = solution.variables
        (solution,) = solve_from_many(problem, [start], problem.bounds, values=values)
    if solution.violation > FEASIBLE or solution.variables[-1] <= 0.0:
        return None
    near = _optimum(flexure, solution)
    return replace(near, starts=earlier.starts, feasible=earlier.feasible, spread=earlier.spread)


def _optimum(flexure: FlexureProblem, solution: Solution) -> CurvatureOptimum:
    unit, variables = flexure.root_half_thickness, solution.variables
    # A shape and its mirror image are equally good; rounding must not choose between them.
    mirror = 1.0 if variables[0] >= 0.0 else -1.0
    free = np.round(mirror * variables[:-3] / unit, 6)
    return CurvatureOptimum(
        coefficients=np.append(free, 0.0),
        length=round(float(variables[-3]) * flexure.span, 9),
        root_angle=round(mirror * float(variables[-2]), 9),
        gap=float(variables[-1]) * unit,
        starts=1,
        feasible=1,
        spread=variables[-1:] * unit,
    )
