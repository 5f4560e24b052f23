"""The contact in which an elastic part gives a wanted torque and holds the wanted energy.

At each angle F p(θ, F, s) = τ and U(θ, F, s) = W for the normal force F and the station s of the
contact. The first is monotone in F; solved for it, the second is one equation for s between two
limits. Each angle is solved by itself: the limits are searched for a bracket, in order, and the
bracket is closed. So there is no start to guess, and no error grows from angle to angle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.elastic_part import ElasticPart
from springcad.mechanics.torque_law import TorqueLaw

Floats = NDArray[np.float64]

TOUCH = 1e-9
"""A force under which every part is at rest (N)."""
_BALANCED = 1e-11
"""Relative error of the torque."""
_CLOSED = 5e-11
"""Relative error of the energy; more than twice that of the torque, with whose square it goes."""
_FOUND = 1e-8
"""A bracket closed on a larger |excess| holds a jump, not a root."""
_MAX_ITERATIONS = 60
_LEAST_SLOPE = 0.2
"""Of ln(F p) over ln F, for a step."""
_HALVINGS = 12


@dataclass(frozen=True)
class Trial:
    """The part giving the torque at one station for each of A angles.

    Attributes:
        station: (A,).
        force: nan where no force gives the torque (A,) [N].
        excess: logarithm of the energy held over the energy wanted, nan with the force (A,).
    """

    station: Floats
    force: Floats
    excess: Floats

    def at(self, rows: NDArray[np.intp]) -> Trial:
        """The trial at some of the angles."""
        return Trial(self.station[rows], self.force[rows], self.excess[rows])


@dataclass(frozen=True)
class Search:
    """Contacts found, and how near the part comes where there is none.

    Attributes:
        found: (A,).
        contact: where found, the contact; elsewhere the trial with the smallest |excess|.
        farthest: the trial with the largest |excess|.
    """

    found: NDArray[np.bool_]
    contact: Trial
    farthest: Trial


def find_contacts(
    part: ElasticPart, law: TorqueLaw, limits: tuple[float, float], intervals: int
) -> Search:
    """The contact nearest to the first of the limits, at every angle.

    Args:
        law: what is asked of one part, torque and energy > 0.
        limits: of the station, in the order of the search.
        intervals: this many equal ones are searched for a change of sign of U − W. Two roots in
            one of them are found all the same where |U − W| is smallest at its ends.
    """
    unknown = np.full_like(law.angle, np.nan)
    ladder: list[Trial] = []
    for station in np.linspace(*limits, intervals + 1):
        guess = ladder[-1].force if ladder else unknown
        ladder.append(balance(part, law, np.full_like(unknown, station), guess))
    excess = np.stack([trial.excess for trial in ladder])
    crosses = excess[:-1] * excess[1:] <= 0.0
    found: NDArray[np.bool_] = np.asarray(crosses.any(axis=0))
    first = crosses.argmax(axis=0)
    lower, upper = _pick(ladder, first), _pick(ladder, first + 1)
    if not found.all():
        rows = np.flatnonzero(~found)
        before, nearest = _nearest(part, law.at(rows), [trial.at(rows) for trial in ladder])
        _put(lower, rows, before)
        _put(upper, rows, nearest)
        found[rows] = before.excess * nearest.excess < 0.0
    rows = np.flatnonzero(found)
    _put(upper, rows, _close(part, law.at(rows), lower.at(rows), upper.at(rows)))
    found &= np.abs(upper.excess) < _FOUND
    return Search(found, upper, _pick(ladder, _smallest(-np.abs(excess))))


def balance(part: ElasticPart, law: TorqueLaw, station: Floats, guess: Floats) -> Trial:
    """The force with which the part gives the torque at each station.

    Newton's method on ln(F p/τ); the slope of the arm p is taken from the last two forces.

    Args:
        guess: of the force, nan where there is none (A,) [N].
    """
    blank = np.isnan(guess)
    if blank.any():
        rest = part(law.angle[blank], np.full(blank.sum(), TOUCH), station[blank])
        guess = guess.copy()
        with np.errstate(divide="ignore"):
            guess[blank] = law.torque[blank] / rest.arm
    result = Trial(station, np.full_like(station, np.nan), np.full_like(station, np.nan))
    rows = np.flatnonzero((guess > 0.0) & np.isfinite(guess))
    force = guess[rows]
    last_force, last_arm = np.zeros_like(force), np.full_like(force, np.nan)
    for _ in range(_MAX_ITERATIONS):
        if not len(rows):
            break
        state = part(law.angle[rows], force, station[rows])
        with np.errstate(all="ignore"):
            error = np.log(force * state.arm / law.torque[rows])
            slope = 1.0 + (1.0 - last_arm / state.arm) / (1.0 - last_force / force)
            excess = np.log(state.energy / law.energy[rows])
        # Beyond its largest torque a part would give less with more force: no way leads on there.
        spent = slope <= 0.0
        done = (np.abs(error) < _BALANCED) & ~spent
        on = (np.abs(error) >= _BALANCED) & np.isfinite(error) & ~(spent & (error < 0.0))
        result.force[rows[done]], result.excess[rows[done]] = force[done], excess[done]
        slope = np.where(slope > 0.0, np.maximum(slope, _LEAST_SLOPE), 1.0)
        rows, last_force, last_arm = rows[on], force[on], state.arm[on]
        force = last_force * np.exp(-error[on] / slope[on])
    return result


def _close(part: ElasticPart, law: TorqueLaw, old: Trial, new: Trial) -> Trial:
    """The contact between trials of different sign.

    Regula falsi with the weights of Anderson & Björck, BIT 13 (1973) 253.
    """
    result = new.at(np.arange(len(new.station)))
    rows = np.arange(len(new.station))
    for _ in range(_MAX_ITERATIONS):
        if not len(rows):
            break
        way = new.excess / (new.excess - old.excess)
        station = new.station + way * (old.station - new.station)
        guess = new.force * (old.force / new.force) ** way
        trial = balance(part, law.at(rows), station, guess)
        _put(result, rows, trial)
        with np.errstate(all="ignore"):
            weight = 1.0 - trial.excess / new.excess
        weight = np.where(weight > 0.0, weight, 0.5)
        same = trial.excess * new.excess > 0.0
        old = Trial(
            np.where(same, old.station, new.station),
            np.where(same, old.force, new.force),
            np.where(same, weight * old.excess, new.excess),
        )
        on = np.flatnonzero(np.abs(trial.excess) > _CLOSED)
        rows, old, new = rows[on], old.at(on), trial.at(on)
    return result


def _nearest(part: ElasticPart, law: TorqueLaw, ladder: list[Trial]) -> tuple[Trial, Trial]:
    """A trial of the other sign, or that with the smallest |excess|, and the trial before it."""
    best = _smallest(np.abs(np.stack([trial.excess for trial in ladder])))
    last = len(ladder) - 1
    left, middle, right = (_pick(ladder, np.clip(best + i, 0, last)) for i in (-1, 0, 1))
    sign, rows = np.sign(middle.excess), np.arange(len(best))
    before, found = left.at(rows), middle.at(rows)
    for _ in range(_HALVINGS):
        inner = [
            balance(part, law.at(rows), 0.5 * (a.station + b.station), middle.force)
            for a, b in ((left, middle), (middle, right))
        ]
        trials = [left, inner[0], middle, inner[1], right]
        best = 1 + _smallest(np.stack([sign[rows] * trial.excess for trial in trials[1:4]]))
        left, middle, right = (_pick(trials, best + i) for i in (-1, 0, 1))
        _put(before, rows, left)
        _put(found, rows, middle)
        on = np.flatnonzero(~(sign[rows] * middle.excess < 0.0))
        rows, left, middle, right = rows[on], left.at(on), middle.at(on), right.at(on)
        if not len(rows):
            break
    return before, found


def _smallest(values: Floats) -> NDArray[np.intp]:
    """Row of the smallest number of each column, nan left aside."""
    return np.asarray(np.where(np.isnan(values), np.inf, values).argmin(axis=0))


def _pick(trials: Sequence[Trial], index: NDArray[np.intp]) -> Trial:
    """For each angle one of the trials."""
    columns = np.arange(len(index))
    return Trial(
        np.stack([trial.station for trial in trials])[index, columns],
        np.stack([trial.force for trial in trials])[index, columns],
        np.stack([trial.excess for trial in trials])[index, columns],
    )


def _put(into: Trial, rows: NDArray[np.intp], trial: Trial) -> None:
    """Write the trial into some of the angles."""
    into.station[rows], into.force[rows] = trial.station, trial.force
    into.excess[rows] = trial.excess
