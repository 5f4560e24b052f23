"""A bench test as it was recorded: which way the spring was travelling, and which points count."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

TURN = 0.05
"""The travel has turned when the angle has come back by this share of the largest: more than
noise, less than a cycle."""
SETTLED = 0.1
"""After a turn under load, points count when the angle is this share of the largest away from it:
before, the tips may still stick to the camshaft."""


@dataclass(frozen=True)
class Travel:
    """Of each point (N,): +1 while the angle grows (as a number), -1 while it falls; and whether
    the tips slide for certain."""

    direction: NDArray[np.intp]
    settled: NDArray[np.bool_]


def travel_of(angle: Floats) -> Travel:
    """The travel at angles (N,) [rad] in the order in which they were measured.

    Noise does not matter that is less than ``TURN`` times the largest angle. The first direction
    is that of the first way of that length; an angle that never goes as far has direction +1.
    """
    largest = float(np.max(np.abs(angle), initial=0.0))
    turns = _turns(angle, TURN * largest)
    direction = np.ones(len(angle), dtype=np.intp)
    settled = np.ones(len(angle), dtype=np.bool_)
    for begin, end in pairwise(turns):
        part = slice(begin, end)
        way = 1 if angle[min(end, len(angle) - 1)] >= angle[begin] else -1
        direction[part] = way
        if abs(angle[begin]) > SETTLED * largest:
            settled[part] = way * (angle[part] - angle[begin]) >= SETTLED * largest
    return Travel(direction, settled)


def _turns(angle: Floats, least: float) -> list[int]:
    """Indices where the travel turns, between 0 and N: the extremes of a zigzag of ``least``."""
    turns, low, high, way = [0], 0, 0, 0
    for index, value in enumerate(angle):
        if value > angle[high]:
            high = index
        if value < angle[low]:
            low = index
        if way >= 0 and angle[high] - value > least:
            turns += [high] * (way > 0)
            way, low = -1, index
        elif way <= 0 and value - angle[low] > least:
            turns += [low] * (way < 0)
            way, high = 1, index
    return [*turns, len(angle)]
