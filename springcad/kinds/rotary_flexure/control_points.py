"""The search for the control points of a centre line (004, section III), and the flexure found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.neighbours import neighbour_gaps
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.control_point_problem import (
    ControlPointProblem,
    Weighting,
    spline_through,
)
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.kinds.rotary_flexure.spline_ribbon import spline_ribbon
from springcad.optimise.random import uniform
from springcad.optimise.sqp import Solution, best, solve_from_many

Floats = NDArray[np.float64]

FINE_POINTS = 321
"""Points at which the finished shape is measured."""
FEASIBLE_BELOW = 1e-4
"""Largest violation of a feasible shape; see ``ControlPointOutcome.violation``."""


@dataclass(frozen=True)
class ControlPointOutcome:
    """The best shape found, or, if none is feasible, the one that misses by least.

    Attributes:
        feasible: whether all requirements hold at the best shape.
        violation: its largest miss, of order one: f_s, mean(y)/L, z, gap / root half thickness.
        knots: control points with both ends (m + 2, 2), m.
        ribbon: the flexure with its pad.
        cost: Eqs 15 and 16, weighted.
        smallest_gap: tube clearance to the neighbour along the spline, m, negative where they
            overlap.
        largest_bend: largest half thickness x curvature.
        serpentine_factor: effective f_s reached.
        starts, feasible_starts: how many were tried, how many ended feasible.
        variables: of the search, where it ended.
    """

    feasible: bool
    violation: float
    knots: Floats
    ribbon: Ribbon
    cost: float
    smallest_gap: float
    largest_bend: float
    serpentine_factor: float
    starts: int
    feasible_starts: int
    variables: Floats


def optimise_control_points(
    flexure: FlexureProblem,
    *,
    starts: int,
    seed: int,
    control_points: int = 2,
    weighting: Weighting = "gap",
    progress: Callable[[str], None] = lambda _: None,
) -> ControlPointOutcome:
    """Best of ``starts`` local searches; the same arguments give the same bits.

    ``flexure.bend_limit`` may be infinite: then the fold-over constraint is left out, as in the
    paper. Where no start meets the requirements, ``feasible`` is False and the shape is the one
    that misses by least. ``flexure.local_stress`` belongs to the curvature form: ValueError here.
    """
    if flexure.local_stress:
        raise ValueError("the control-point form sizes for the nominal stress only")
    problem = ControlPointProblem(flexure, control_points, weighting)
    points = (start_point(problem, seed, index) for index in range(starts))
    solutions = solve_from_many(problem, points, problem.bounds, progress=progress)
    found = best(solutions, feasible_below=FEASIBLE_BELOW)
    nearest = min(solutions, key=lambda s: (round(s.violation, 6), s.start))
    feasible = sum(s.violation <= FEASIBLE_BELOW for s in solutions)
    return _outcome(problem, found or nearest, len(solutions), feasible)


def reoptimise_control_points(
    flexure: FlexureProblem, earlier: ControlPointOutcome, weighting: Weighting, *, freeze: bool
) -> ControlPointOutcome:
    """The optimum near that of a problem not much different.

    With ``freeze`` it is the nearest shape that meets the constraints, whatever its cost.
    """
    problem = ControlPointProblem(
        flexure, len(earlier.knots) - 2, weighting, earlier.variables, freeze=freeze
    )
    (solution,) = solve_from_many(problem, [earlier.variables], problem.bounds)
    return _outcome(problem, solution, earlier.starts, earlier.feasible_starts)


def start_point(problem: ControlPointProblem, seed: int, index: int) -> Floats:
    """Random control points whose amplitude already gives the wanted serpentine factor."""
    m = problem.m
    draw = uniform(seed, index, 2 * m)
    variables = np.zeros(2 * m + 1)
    variables[:m] = 2.0 * draw[:m] - 1.0
    variables[m:-1] = np.where(np.arange(m) % 2, 1.0, -1.0) * (0.2 + 0.8 * draw[m:])
    line = problem.line(variables)
    width = line.weights.value * line.taper.value
    target = problem.flexure.serpentine_factor * problem.lever / 1.5 - problem.pad_energy

    low, high = 0.0, 0.5 * problem.span
    for _ in range(40):
        middle = 0.5 * (low + high)
        reached = width @ np.sqrt(1.0 + (middle * line.slope.value) ** 2)
        low, high = (middle, high) if reached < target else (low, middle)
    variables[m:-1] *= low
    variables[-1] = 0.1
    return variables


def _outcome(
    problem: ControlPointProblem, shape: Solution, starts: int, feasible_starts: int
) -> ControlPointOutcome:
    flexure, unit = problem.flexure, problem.flexure.root_half_thickness
    # Snapped far below any tolerance: the last digits of another machine's algebra do not show.
    x, y = (np.round(unit * knots.value, 10) for knots in problem.knots(shape.variables))
    spline = spline_through(x, y, flexure.span - flexure.pad_length)
    ribbon = spline_ribbon(flexure, spline)
    at = ribbon.at(ribbon.dense_stations(FINE_POINTS))
    curved = at.x <= spline.x[-1] + 1e-9
    gaps = neighbour_gaps(
        at.x[curved], at.y[curved], at.half_thickness[curved], flexure.root_radius, flexure.count
    )
    return ControlPointOutcome(
        feasible=shape.violation <= FEASIBLE_BELOW,
        violation=shape.violation,
        knots=np.column_stack((spline.x, spline.y)),
        ribbon=ribbon,
        cost=shape.objective,
        smallest_gap=float(gaps.gap.min()),
        largest_bend=ribbon.largest_bend,
        serpentine_factor=float(problem.serpentine_factor(problem.line(shape.variables)).value[0]),
        starts=starts,
        feasible_starts=feasible_starts,
        variables=shape.variables,
    )
