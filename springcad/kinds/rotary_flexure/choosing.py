"""The choice of what a spec leaves open: count, contact radius, rim, style and the objective.

Three stages, each on what the one before has left, the same answer every time:

1. closed forms give each ring a bound and drop those that no level of the objective saves
   (``candidates``);
2. the search for the shape on the design law ranks the most promising ones and what lies around
   the best of them (``screening``);
3. the best are designed in full, level by level, until a check stops them (``climbing``).

What is chosen is designed like any other spec: one with the chosen numbers gives the same spring.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from springcad.kinds.rotary_flexure.aim import Aim, Pair
from springcad.kinds.rotary_flexure.candidates import (
    Candidate,
    candidate,
    candidates,
    promise,
    rounded_up,
    worth,
)
from springcad.kinds.rotary_flexure.choice_refusal import nothing_made, nothing_possible
from springcad.kinds.rotary_flexure.climbing import MISSES, Build, Climb
from springcad.kinds.rotary_flexure.screening import Screened, screened
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.tried import Design
from springcad.result import Progress

PATIENCE = 3
"""Rings screened in turn, none of them better than the best, before the search goes on around it,
and again before it ends;"""
MOST = 14
"""so many at most."""
COUNT_MOVES = (1.2, 1.08, 1.0 / 1.08)
RADIUS_MOVES = (1.1, 1.03, 1.0 / 1.03)
"""Steps around the best ring, as factors."""


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
        InfeasibleError: none passes; with what was tried and what stopped it.
    """
    aim = Aim.of(spec)
    progress("closed forms: which rings are possible")
    allowed = candidates(aim)
    if not allowed:
        raise nothing_possible(aim)
    considered = _considered(aim, allowed, progress)
    search = Climb(aim, build, progress)
    fallen_back = False
    for ring in _order(aim, considered):
        search.climb(ring)
        if search.best is None and not fallen_back and len(search.designs) >= MISSES:
            search.straight(allowed)
            fallen_back = True
    search.straight(allowed)
    best = search.best
    if best is None or best.spring is None:
        raise nothing_made(search.designs)
    considered = (*considered, *search.widened)
    designs = tuple(search.designs)
    return Choice(aim, best.spring, best.pair, best.level, best.bound, allowed, considered, designs)


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

    def look(rings: Iterable[Candidate], *, move_on: bool) -> None:
        """At one after the other until so many are not better than the best, or one is."""
        worse = 0
        for ring in rings:
            leader = best()
            # All have the one level of the mass: a lighter one may fail where a heavier holds.
            beaten = leader is not None and ring.bound <= leader.level and aim.objective != "mass"
            if ring.pair in found or beaten:
                continue
            if worse == PATIENCE or len(found) == MOST:
                return
            found[ring.pair] = screened(aim, ring)
            progress(f"searching for shapes, ring {len(found)}: {ring.pair}")
            if best() is leader:
                worse += 1
            elif move_on:
                return
            else:
                worse = 0

    look(allowed, move_on=False)
    here = None
    while (leader := best()) is not None and leader is not here:
        here = leader
        near = (candidate(aim, pair) for pair in _around(aim, leader.pair))
        look(sorted((ring for ring in near if ring is not None), key=promise), move_on=True)
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
