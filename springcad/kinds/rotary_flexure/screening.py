"""How high a ring reaches, by the search for its shape alone.

The shape is searched for on the design law, whose root is clamped, and bent once by its full load:
tens of milliseconds, against seconds for a spring that is sized and turned through its stroke. The
gap that is left falls as the ring fills; where it is the least one wanted, the ring reaches no
higher. This ranks rings; what the best of them really reach is found by designing them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.aim import Aim, Pair, Trial
from springcad.kinds.rotary_flexure.candidates import Candidate
from springcad.kinds.rotary_flexure.checks import DEFORMED_GAP
from springcad.kinds.rotary_flexure.correction import gap_allowance
from springcad.kinds.rotary_flexure.curvature_form import CurvatureOptimum, optimise, reoptimise
from springcad.kinds.rotary_flexure.feasibility import straight_gap
from springcad.kinds.rotary_flexure.full_load import Demand, loads_of, stiffness_at_rest
from springcad.kinds.rotary_flexure.inputs import target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.kinds.rotary_flexure.root import flexure_on
from springcad.kinds.rotary_flexure.search import problem_of
from springcad.kinds.rotary_flexure.shape import curvature_ribbon
from springcad.mechanics.torque_law import TorqueLaw

Floats = NDArray[np.float64]

FIRST_FILL, FILL_STEP = 0.65, 0.05
"""Density factors at which shapes are searched for, each from the shape before."""
FINEST = 0.02
"""Where no shape is found, steps of fill are halved down to this one."""
STARTS = 2
"""Searches where there is no shape to start from."""
HALVINGS = 24


@dataclass(frozen=True)
class Screened:
    """A ring, the last level of straight flexures, its bound, the level that it reaches, and the
    fall of its gap per level there, m."""

    pair: Pair
    straight: int
    bound: int
    level: float
    fall: float


@dataclass(frozen=True)
class _Shape:
    """A shape and by how much its neighbours come closer at full load, per tenth, m."""

    line: CurvatureOptimum
    allowance: Floats


def has_room(trial: Trial) -> bool:
    """Whether the best shape on the design law leaves the gaps wanted, at rest and at full load."""
    return _left(trial, None)[1] >= 0.0


def screened(aim: Aim, candidate: Candidate) -> Screened | None:
    """What the ring reaches on the design law; None where no shape is found at all."""
    pair, levels = candidate.pair, list(_levels(aim, candidate))
    straight, bound = candidate.straight, candidate.bound
    level, spare, fall = math.nan, math.nan, 0.0
    shape: _Shape | None = None
    while levels:
        higher = levels.pop(0)
        next_shape, left = _left(aim.at(pair, higher), shape)
        if left < 0.0 and math.isnan(level):
            return None
        if left == -math.inf:
            middle = 0.5 * (level + higher)
            levels = [middle] if _fill(aim, pair, higher) - _fill(aim, pair, level) > FINEST else []
            continue
        fall = 0.0 if math.isnan(level) else (spare - left) / (higher - level)
        if left < 0.0:
            return Screened(pair, straight, bound, level + spare / fall, fall)
        level, spare, shape = higher, left, next_shape
    return Screened(pair, straight, bound, level, max(fall, 0.0))


def _levels(aim: Aim, candidate: Candidate) -> Iterator[float]:
    """The last level of straight flexures, then even steps of fill, and the bound."""
    pair, low, high = candidate.pair, candidate.straight, candidate.bound
    yield low
    fill, densest = FIRST_FILL, _fill(aim, pair, high)
    while fill < densest:
        if fill > _fill(aim, pair, low):
            yield _level_of(aim, pair, fill, low, high)
        fill += FILL_STEP
    if high > low:
        yield high


def _fill(aim: Aim, pair: Pair, level: float) -> float:
    return design_law(aim.at(pair, level).case.inputs).density_factor


def _level_of(aim: Aim, pair: Pair, fill: float, low: float, high: float) -> float:
    """The level between two at which the ring is filled so much; the fill rises with the level."""
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _fill(aim, pair, middle) < fill else (low, middle)
    return low


def _left(trial: Trial, shape: _Shape | None) -> tuple[_Shape | None, float]:
    """The best shape on the design law and what its gap has to spare, m.

    Minus infinity where there is no shape. The gap at full load is that at rest, less the allowance
    of the shape before.
    """
    law, case = design_law(trial.case.inputs), trial.case
    asked = trial.spec.flexures.min_deformed_gap or DEFORMED_GAP
    if case.style == "straight":
        return None, straight_gap(law) - case.min_gap
    plain = problem_of(trial.spec, law)
    if shape is None:
        line = optimise(plain, starts=STARTS, seed=trial.spec.optimiser.seed)
        if line is None:
            return None, -math.inf
        shape = _Shape(line, _allowance(trial, plain, line))
    problem = replace(plain, gap_allowance=shape.allowance)
    line = reoptimise(problem, shape.line, freeze=False)
    if line is None:
        return None, -math.inf
    least = max(asked, case.min_gap - float(shape.allowance.max()))
    return _Shape(line, _allowance(trial, problem, line)), line.gap - least


def _allowance(trial: Trial, problem: FlexureProblem, line: CurvatureOptimum) -> Floats:
    """By how much neighbours of this shape come closer at full load; 0 where it bears no such load.

    The load is scaled to the stiffness that the shape has.
    """
    inputs, law = trial.case.inputs, target_of(trial.spec)
    angle, one = np.array([law.deflection]), 1.0 / inputs.count
    full = TorqueLaw(angle, one * law.torque(angle), one * law.energy(angle))
    at_rest = one * float(law.stiffness(np.zeros(1))[0])
    demand = Demand(inputs.root_radius, inputs.contact_radius, full, at_rest)
    ribbon = curvature_ribbon(problem, line)
    beam = flexure_on(trial.spec, trial.case, ribbon, 0.0)
    try:
        share = stiffness_at_rest(ribbon, beam, demand) / at_rest
        states = loads_of(ribbon, beam, demand, share)
    except InfeasibleError:
        return np.zeros(10)
    return gap_allowance(ribbon, beam, states, inputs.root_radius, inputs.count)
