"""The search for a cantilever within bounds, by sequential quadratic programming.

In the logarithms of length, height and width, volume and tip stiffness are linear, and stress and
energy nearly so: what is searched is almost a linear program, and a few steps end the search. Each
step solves the contacts of the synthesis at a few angles; no profile is made.
Derivation: docs/theory/roller-cam.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.roller_cam.joint import Cantilever, Joint, Roller
from springcad.kinds.roller_cam.limits import LEAST_OVERRUN, lowest_point
from springcad.kinds.roller_cam.part import STATION_LIMITS, part_with, roller_contact
from springcad.kinds.roller_cam.synthesis import rises_at_once
from springcad.kinds.roller_cam.tip import TipModel, linear_tip
from springcad.kinds.target_law import Law, sampled
from springcad.mechanics.conjugate_contact import balance, find_contacts
from springcad.mechanics.torque_law import TorqueLaw, share_of_one
from springcad.optimise.sqp import Evaluation, Problem, Solution, best, solve_from_many

Floats = NDArray[np.float64]
Beam = Callable[[Cantilever], TipModel]
Objective = Literal["max_stiffness", "min_volume", "min_stress", "target_stiffness"]

ANGLES = 24
"""Angles at which stress and energy are looked at, evenly spaced."""
SIZES = ("length", "height", "width")
"""The first three variables are the logarithms of these (m); the fourth is that of the stress
allowed, over the design stress."""
VOLUME = np.array([1.0, 1.0, 1.0, 0.0])
STIFFNESS = np.array([-3.0, 3.0, 1.0, 0.0])
STRESS = np.array([0.0, 0.0, 0.0, 1.0])
"""Gradients of the logarithms of volume, of tip stiffness and of the stress allowed."""

STRESS_RESERVE = 1e-6
ENERGY_RESERVE = 1e-4
"""By these shares the stress stays below what is allowed, and the energy that the cantilever holds
at least, the roller right over its tip, below that of the law."""
_FEASIBLE = 1e-7
"""Largest violation of a limit, of its logarithm."""
_AS_GOOD = 1e-6
_AT_BOUND = 1e-8
_TOLERANCE = 1e-8
_ITERATIONS = 25
_STEP = 1e-5
_INTERVALS = 12
_NO_STATE = 5.0
"""Stands for the logarithm of a stress or an energy that no load on the cantilever gives."""
_FREE = 6.0
"""The logarithm of a stress allowed without limit, over the design stress."""


@dataclass(frozen=True)
class SizingTask:
    """What is to be sized, SI.

    Attributes:
        law: of one group.
        roller: the cantilever's mate.
        low, high: the cantilever with every size at its lower, and at its upper bound.
        objective: what for.
        stiffness: of the tip in bending, to be met; None where it is free.
        design_stress: allowed at the clamp up to the deflection.
        clearance: least gap between roller and cantilever.
    """

    law: Law
    roller: Roller
    low: Cantilever
    high: Cantilever
    objective: Objective
    stiffness: float | None
    design_stress: float
    clearance: float

    @property
    def largest_height(self) -> float:
        """Upper bound of the height, as far as the turned roller leaves room for it (m)."""
        lowest = lowest_point(self.roller, self.law.deflection)
        return min(self.high.height, 2.0 * (lowest - self.clearance))

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Logarithms of the bounds of ``SIZES``, lower and upper, each (3,)."""
        return _sizes(self.low), _sizes(replace(self.high, height=self.largest_height))

    def cantilever(self, variables: Floats) -> Cantilever:
        """The cantilever of given variables, a size at a bound being exactly that bound."""
        sizes = dict(zip(SIZES, np.exp(variables[:3]).tolist(), strict=True))
        for name, size in sizes.items():
            for bound in (getattr(self.low, name), getattr(self.high, name)):
                if math.isclose(size, bound, rel_tol=_AT_BOUND):
                    sizes[name] = bound
        return replace(self.low, **sizes)

    @property
    def stiffness_range(self) -> tuple[float, float]:
        """Tip stiffness of the softest and of the stiffest cantilever within the bounds (N/m)."""
        softest, _, stiffest = (self.cantilever(sizes) for sizes in self._from_soft_to_stiff())
        return softest.tip_stiffness, stiffest.tip_stiffness

    @property
    def first_to_try(self) -> Cantilever:
        """The cantilever of the wanted stiffness, or the stiffest, that yields least in shear.

        At a given stiffness in bending that is the widest. It holds the least energy while it gives
        a torque: where it holds more than the law has stored, so do all within the bounds.
        """
        path = self._from_soft_to_stiff()
        stiffness = path @ STIFFNESS[:3]
        wanted = stiffness[-1]
        if self.stiffness is not None:
            wanted = math.log(self.stiffness) - _at_one(self.low)
        return self.cantilever(np.array([np.interp(wanted, stiffness, way) for way in path.T]))

    def _from_soft_to_stiff(self) -> Floats:
        """Logarithms of the sizes: softest, the same with the largest width, stiffest (3, 3)."""
        low, high = self.bounds
        softest = np.array([high[0], low[1], low[2]])
        widest = np.array([high[0], low[1], high[2]])
        return np.stack([softest, widest, np.array([low[0], high[1], high[2]])])


@dataclass(frozen=True)
class Loads:
    """A cantilever at A angles of the law.

    Attributes:
        stress: at the clamp (A,) [Pa].
        excess: logarithm of the least energy that it holds while it gives the torque, over that
            of the law; must not be positive (A,).
    """

    stress: Floats
    excess: Floats


def loads_of(task: SizingTask, beam: Beam, cantilever: Cantilever, wanted: TorqueLaw) -> Loads:
    """Stress and energy where the cantilever follows the law.

    Where it cannot, the stress is that with the roller right over the tip: it goes on smoothly.
    """
    tip = beam(cantilever)
    part = part_with(Joint(cantilever, task.roller), tip)
    unknown = np.full_like(wanted.angle, np.nan)
    over_tip = balance(part, wanted, np.full_like(unknown, STATION_LIMITS[1]), unknown)
    station, force = over_tip.station.copy(), over_tip.force.copy()
    rows = np.flatnonzero(over_tip.excess <= 0.0)
    if len(rows):
        contact = find_contacts(part, wanted.at(rows), STATION_LIMITS, _INTERVALS).contact
        station[rows], force[rows] = contact.station, contact.force
    touch = roller_contact(task.roller, wanted.angle, np.exp(station))
    state = tip(touch.point, np.nan_to_num(force)[:, None] * touch.normal)
    return Loads(
        stress=np.where(np.isnan(force), np.inf, state.stress),
        excess=np.where(np.isnan(over_tip.excess), _NO_STATE, over_tip.excess),
    )


def samples(law: Law) -> TorqueLaw:
    """The law of one group at ``ANGLES`` angles, the limit at rest included where there is one.

    A last angle follows, up to which the profile has to go.
    """
    angle = np.linspace(law.dead_zone, law.deflection, ANGLES + 1)
    angle = np.append(angle, LEAST_OVERRUN * law.deflection)
    return share_of_one(sampled(law, angle if rises_at_once(law) else angle[1:]), 1)


def least_stress(task: SizingTask, beam: Beam) -> Solution | None:
    """The cantilever with the least stress, allowed or not; None if none can follow the law."""
    low, high = task.bounds
    starts = [np.append(sizes, _FREE) for sizes in (_sizes(task.first_to_try), 0.5 * (low + high))]
    return _search(task, beam, STRESS, (-_FREE, _FREE), starts)


def least_of(task: SizingTask, beam: Beam, objective: Floats, first: Solution) -> Solution:
    """The cantilever within the design stress for which a linear objective (4,) is least.

    Args:
        first: one that is within all limits.
    """
    low, high = task.bounds
    sizes = (first.variables[:3], _sizes(task.first_to_try), 0.5 * (low + high))
    found = _search(task, beam, objective, (0.0, 0.0), [np.append(start, 0.0) for start in sizes])
    return found or first


def _search(
    task: SizingTask,
    beam: Beam,
    objective: Floats,
    stress: tuple[float, float],
    starts: list[Floats],
) -> Solution | None:
    """By small rotations first, which takes a tenth of the time and leaves little to do."""
    low, high = task.bounds
    bounds = np.append(low, stress[0]), np.append(high, stress[1])
    ways = [starts]
    if beam is not linear_tip:
        rough = _search(task, linear_tip, objective, stress, starts)
        ways = [[rough.variables], starts] if rough else ways
    for way in ways:
        solutions = solve_from_many(
            _problem(task, beam, objective),
            way,
            bounds,
            max_iterations=_ITERATIONS,
            tolerance=_TOLERANCE,
        )
        if found := best(solutions, feasible_below=_FEASIBLE, as_good=_AS_GOOD):
            return found
    return None


def _problem(task: SizingTask, beam: Beam, objective: Floats) -> Problem:
    """Forward differences do: the logarithms are nearly linear."""
    wanted = samples(task.law)
    low, high = task.bounds
    free = np.flatnonzero(low < high)
    equality = np.zeros((0, 4)) if task.stiffness is None else STIFFNESS[None]
    offset = np.full(len(equality), math.log(task.stiffness or 1.0) - _at_one(task.low))

    def limits(variables: Floats) -> Floats:
        loads = loads_of(task, beam, task.cantilever(variables), wanted)
        stress = np.log(np.maximum(loads.stress[:-1] / task.design_stress, math.exp(-_FREE)))
        stress = np.where(np.isfinite(stress), stress, _NO_STATE)
        return np.concatenate(
            [variables[3] - stress - STRESS_RESERVE, -loads.excess - ENERGY_RESERVE]
        )

    def problem(variables: Floats) -> Evaluation:
        here = limits(variables)
        jacobian = np.zeros((len(here), 4))
        jacobian[: len(wanted.angle) - 1, 3] = 1.0
        for column in free:
            moved = variables.copy()
            moved[column] += _STEP
            jacobian[:, column] = (limits(moved) - here) / _STEP
        return Evaluation(
            objective=float(objective @ variables),
            gradient=objective,
            equalities=equality @ variables - offset,
            equality_jacobian=equality,
            inequalities=here,
            inequality_jacobian=jacobian,
        )

    return problem


def _at_one(cantilever: Cantilever) -> float:
    """Logarithm of the tip stiffness E w h³/(4 l³) with all sizes 1 m."""
    return math.log(cantilever.elastic_modulus / 4.0)


def _sizes(cantilever: Cantilever) -> Floats:
    return np.log([getattr(cantilever, name) for name in SIZES])
