"""Rings that were designed at a level, and the level that follows from what stopped them."""

from __future__ import annotations

import math
from dataclasses import dataclass

from springcad.kinds.rotary_flexure.aim import Pair
from springcad.kinds.rotary_flexure.camshaft import NO_TOOTH
from springcad.kinds.rotary_flexure.checks import THIN_TOOTH
from springcad.kinds.rotary_flexure.screening import Screened
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.straight_limit import STRAIGHT_LIMIT

LONGEST_STEP = 4
"""Levels by which a design that passes is left behind at most."""
CAUTION = 0.02
"""Where a shape is not found at all, the next level is lower by this share of the bound."""


@dataclass(frozen=True)
class Stop:
    """The limit that a ring did not keep; SI."""

    claim: str
    value: float
    limit: float
    unit: str

    @property
    def lack(self) -> float | None:
        """By how much a gap is too small, m; None for other limits."""
        return self.limit - self.value if self.claim.startswith("gap") else None

    @property
    def tooth(self) -> float | None:
        """Thickness of a tooth that is too thin, m, negative for none; None for other limits."""
        return self.value if self.claim in (THIN_TOOTH, NO_TOOTH) else None

    @property
    def no_shape(self) -> bool:
        """Whether no shape was found, by how much whatever."""
        return self.claim.startswith("searches")

    @property
    def straight_share(self) -> float | None:
        """Of the deflection, that straight flexures reach; None for other limits."""
        return self.limit / self.value if self.claim == STRAIGHT_LIMIT else None


@dataclass(frozen=True)
class Design:
    """A ring that was designed at a level: the spring if it passes, or what stopped it; with the
    last level that closed forms allow it."""

    pair: Pair
    level: int
    bound: int
    spring: Spring | None
    stop: Stop | None


def steps_up(levels: int, spare: float, fall: float, stop: Stop | None) -> int:
    """Levels from one that passes, with ``spare`` gap, to the next to be designed.

    Args:
        levels: up to one that fails, or to the bound.
        fall: of the gap per level, m.
        stop: what stopped the one that fails; None where none has been designed.
    """
    if stop is None:
        steps = math.floor(spare / fall) if fall > 0.0 else 1
        return max(1, min(steps, LONGEST_STEP, levels - 1))
    if stop.lack is None:
        return levels // 2
    return max(1, math.floor(levels * spare / (spare + stop.lack)))


def steps_down(ring: Screened, design: Design, earlier: Stop | None, last: int) -> int:
    """Levels from one that fails down to the next.

    A gap says how much is missing; where that was too little, the step doubles. Other limits do
    not: after a careful step the next one is half of the way to the level of straight flexures.

    Args:
        earlier: what stopped the level above; None where none was designed.
        last: the step from there.
    """
    stop = design.stop
    if stop is not None and stop.lack is not None and ring.fall > 0.0:
        doubled = 0 if earlier is None or earlier.lack is None else 2 * last
        return max(doubled, 1, math.ceil(stop.lack / ring.fall))
    if earlier is not None:
        return max(1, (design.level - ring.straight) // 2)
    return max(1, round(CAUTION * ring.bound))
