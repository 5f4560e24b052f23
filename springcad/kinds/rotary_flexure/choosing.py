"""The choice of what a spec leaves open: count, contact radius, rim, style and the objective.

Three stages, each on what the one before has left, the same answer every time:

1. closed forms give each ring a bound and drop those that no level of the objective saves
   (``candidates``);
2. the search for the shape on the design law ranks the most promising ones and what lies around
   the best of them (``screening``);
3. the best are designed in full, level by level, until a check stops them.

What is chosen is designed like any other spec: one with the chosen numbers gives the same spring.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.aim import Aim, Pair
from springcad.kinds.rotary_flexure.candidates import (
    Candidate,
    candidate,
    candidates,
    rounded_up,
    worth,
)
from springcad.kinds.rotary_flexure.checks import DEFORMED_GAP, spring_checks
from springcad.kinds.rotary_flexure.feasibility import Case, feasibility_checks
from springcad.kinds.rotary_flexure.rim import rim_check
from springcad.kinds.rotary_flexure.screening import Screened, screened
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.result import Check, Progress

Build = Callable[[RotaryFlexureSpec, Case, tuple[Check, ...], Progress], Spring]

FIRST = 5
"""Rings screened before the search goes on around the best of them,"""
AROUND = 9
"""and at most so many around it."""
DESIGNS = 7
"""Springs designed at most."""
COUNT_MOVES = (1.2, 1.08, 1.0 / 1.08)
RADIUS_MOVES = (1.1, 1.03, 1.0 / 1.03)
"""Steps around the best ring, as factors."""
LONGEST_STEP = 4
"""Levels by which a design that passes is left behind at most: each time twice as many."""
WARY = 0.7
"""Share of the gap that is left which the next level may take."""
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


@dataclass(frozen=True)
class Design:
    """A ring that was designed at a level: the spring if it passes, or what stopped it."""

    pair: Pair
    level: int
    spring: Spring | None
    stop: Stop | None


@dataclass(frozen=True)
class Choice:
    """What was chosen and what from.

    Attributes:
        aim: what for.
        spring: the chosen one, at ``level`` with ``pair``.
        bound: the level that closed forms allow this ring.
        allowed: rings within the closed forms.
        considered: rings whose shape was searched for on the design law, as they were tried.
        designs: springs designed in full, as they were tried.
    """

    aim: Aim
    spring: Spring
    pair: Pair
    level: int
    bound: int
    allowed: tuple[Candidate, ...]
    considered: tuple[Screened, ...]
    designs: tuple[Design, ...]

    @property
    def next(self) -> Design | None:
        """The same ring at the lowest level above the chosen one at which it was tried."""
        above = [d for d in self.designs if d.pair == self.pair and d.level > self.level]
        return min(above, key=lambda design: design.level, default=None)


def choose(spec: RotaryFlexureSpec, build: Build, progress: Progress) -> Choice:
    """The best spring that the search finds.

    Raises:
        InfeasibleError: none passes; with what stopped the most promising one.
    """
    aim = Aim.of(spec)
    progress("closed forms: which rings are possible")
    allowed = candidates(aim)
    if not allowed:
        raise InfeasibleError("rings within the closed-form limits", 0.0, 1.0, "1")
    considered = _considered(aim, allowed, progress)
    search = _Search(aim, build, progress)
    for ring in _order(aim, considered):
        search.climb(ring)
    best = search.best
    if best is None or best.spring is None:
        raise _refusal(search.designs)
    bound = next(ring.bound for ring in considered if ring.pair == best.pair)
    designs = tuple(search.designs)
    return Choice(aim, best.spring, best.pair, best.level, bound, allowed, considered, designs)


def _order(aim: Aim, considered: tuple[Screened, ...]) -> list[Screened]:
    """The best rings first; of light ones, all of one level, every second, third, … before those
    between, so that a few designs find out how light a ring may be."""
    best = sorted(considered, key=lambda s: -worth(aim, s.pair, s.level))
    if aim.objective != "mass":
        return best
    strides = [n * (n + 1) // 2 for n in range(len(best))]
    first = [best[n] for n in strides if n < len(best)]
    return first + [ring for n, ring in enumerate(best) if n not in strides]


def _considered(
    aim: Aim, allowed: tuple[Candidate, ...], progress: Progress
) -> tuple[Screened, ...]:
    """The first rings that have a shape, and those around the best, until none is better."""
    found: dict[Pair, Screened | None] = {}

    def best() -> Screened | None:
        shaped = [ring for ring in found.values() if ring is not None]
        return max(shaped, key=lambda ring: worth(aim, ring.pair, ring.level), default=None)

    def look(ring: Candidate) -> None:
        leader = best()
        # Of all that have the one level of the mass, a lighter one may fail where a heavier holds.
        if aim.objective != "mass" and leader is not None and ring.bound <= leader.level:
            return
        found[ring.pair] = screened(aim, ring)
        progress(f"searching for shapes, ring {len(found)}: {ring.pair}")

    for ring in allowed:
        shaped = sum(seen is not None for seen in found.values())
        if shaped >= FIRST or len(found) >= 2 * FIRST:
            break
        look(ring)
    tried, here = len(found), None
    while (leader := best()) is not None and leader is not here and len(found) < tried + AROUND:
        here = leader
        for pair in _around(aim, leader.pair):
            near = candidate(aim, pair) if pair not in found else None
            if near is not None:
                look(near)
    return tuple(ring for ring in found.values() if ring is not None)


def _around(aim: Aim, pair: Pair) -> list[Pair]:
    """Rings next to one: other counts with as wide teeth, other radii."""
    count, radius = pair.count, pair.contact_radius
    open_radius = isinstance(aim.spec.envelope.contact_radius, str)
    counts = [round(count * move) for move in COUNT_MOVES] + [count + 1, count - 1]
    moves = []
    if isinstance(aim.spec.flexures.count, str):
        for other in counts:
            at = rounded_up(radius * other / count) if open_radius else radius
            moves.append(Pair(other, at))
    if open_radius:
        moves += [Pair(count, rounded_up(move * radius)) for move in RADIUS_MOVES]
    return [move for move in moves if move.count >= 3]


@dataclass
class _Search:
    """Designs in full, the best so far, and where the camshaft was too weak."""

    aim: Aim
    build: Build
    progress: Progress
    designs: list[Design] = field(default_factory=list)
    best: Design | None = None
    weak_radius: float = 0.0

    def climb(self, ring: Screened) -> None:
        """Design one ring at higher and higher levels; only what would be better than the best."""
        aim, pair = self.aim, ring.pair
        if pair.contact_radius <= self.weak_radius:
            return
        least = aim.lowest
        if self.best is not None:
            if worth(aim, pair, ring.bound) <= worth(aim, self.best.pair, self.best.level):
                return
            least = self.best.level + 1 if aim.objective != "mass" else 0
        low, high = least - 1, ring.bound + 1
        level, step = max(least, min(math.floor(ring.level), ring.bound)), 0
        while low < level < high and len(self.designs) < DESIGNS:
            design = self._designed(pair, level)
            if design.spring is not None:
                low, self.best = level, design
                step = min(max(2 * step, self._up(ring, design.spring)), LONGEST_STEP)
                level = min(low + step, max(low + 1, (low + high) // 2))
            elif low >= least:
                high, level = level, (low + level) // 2
            else:
                high = level
                if design.stop is not None and "camshaft" in design.stop.claim:
                    if "torsion" in design.stop.claim:
                        self.weak_radius = max(self.weak_radius, pair.contact_radius)
                    return
                level -= self._back(ring, design.stop)

    def _up(self, ring: Screened, spring: Spring) -> int:
        return max(1, math.floor(WARY * _spare_gap(spring) / ring.fall)) if ring.fall > 0.0 else 1

    def _back(self, ring: Screened, stop: Stop | None) -> int:
        if stop is not None and stop.lack is not None and ring.fall > 0.0:
            return max(1, math.ceil(stop.lack / ring.fall))
        return max(1, round(CAUTION * ring.bound))

    def _designed(self, pair: Pair, level: int) -> Design:
        self.progress(f"designing {pair}, level {level} of the {self.aim.objective}")
        trial = self.aim.at(pair, level)
        try:
            feasibility = feasibility_checks(trial.case)
            spring = self.build(trial.spec, trial.case, feasibility, lambda _: None)
        except InfeasibleError as error:
            stop = Stop(error.claim, error.value, error.limit, error.unit)
            design = Design(pair, level, None, stop)
        else:
            failed = [c for c in choice_checks(self.aim, spring) if c.status == "fail"]
            stops = [Stop(c.name, c.value, c.limit, c.unit) for c in failed]
            design = Design(pair, level, None if stops else spring, stops[0] if stops else None)
        self.designs.append(design)
        return design


def _spare_gap(spring: Spring) -> float:
    """What the gaps at rest and at full load have to spare, the smaller, m."""
    deformed = min(float(stroke.gap.min()) for stroke in spring.strokes)
    asked = spring.spec.flexures.min_deformed_gap or DEFORMED_GAP
    return min(deformed - asked, spring.found.gap - spring.case.min_gap)


def choice_checks(aim: Aim, spring: Spring) -> tuple[Check, ...]:
    """The checks of a spring, with that of its rim where it is chosen."""
    checks = spring_checks(spring)
    if isinstance(aim.spec.envelope.outer_radius, str):
        checks = (*checks, rim_check(spring))
    return checks


def _refusal(designs: list[Design]) -> InfeasibleError:
    stop = designs[0].stop if designs else None
    if stop is None:
        claim = "rings with a shape of the flexures within all limits"
        return InfeasibleError(claim, 0.0, 1.0, "1")
    claim = f"{stop.claim}, of the most promising ring ({designs[0].pair})"
    return InfeasibleError(claim, stop.value, stop.limit, stop.unit)
