"""What a refusal says: changes of the spec that were designed before they are told.

A design takes seconds, a search for a shape a tenth of that, closed forms a thousandth. So of each
way to change the spec the mildest change is looked for that passes every closed form and whose
flexures have room; ways with a small one are followed first. A design that fails says by how much:
from two of them follows how far to go, and a way that gets no nearer is given up. All is counted,
never timed.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_left
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from springcad.errors import SpecError
from springcad.kinds.rotary_flexure.changes import Change
from springcad.kinds.rotary_flexure.ways import Way
from springcad.result import Progress
from springcad.spec.source import Spec, changed_spec

MOST = 2
"""Changes told at most."""
DESIGNS = 6
"""Springs designed at most,"""
DESIGNS_OF_A_WAY = 3
"""so many of them of one way."""
SHAPES = 12
"""Shapes searched for at most."""
ALIKE = 0.05
"""Changes that differ by less in size are tried in the order in which they are given."""
STEP = 0.03
"""By how much larger the second change of a way that is designed is."""
NEAR = math.log(1.35)
"""A change with room that is no larger is designed before other ways are looked at."""


@dataclass(frozen=True)
class Verdict:
    """What a design came to.

    Attributes:
        claim: what stopped it first; empty where nothing did.
        miss: by how much, as a share of the limit.
        cure: a further change that would end this only failure.
    """

    claim: str = ""
    miss: float = 0.0
    cure: Change | None = None

    @classmethod
    def missed(cls, claim: str, value: float, limit: float, cure: Change | None = None) -> Verdict:
        """A limit that was not kept; numbers in the words of a claim change with the design."""
        return cls(
            re.sub(r"[\d.]+", "", claim), abs(value / limit - 1.0) if limit else math.inf, cure
        )


@dataclass(frozen=True)
class Judges:
    """What a changed spec must pass, cheap before dear.

    Attributes:
        is_possible: by closed forms.
        has_room: by a search for the shape alone.
        design: by a whole design, with every check.
    """

    is_possible: Callable[[Spec], bool]
    has_room: Callable[[Spec], bool]
    design: Callable[[Spec], Verdict]


def changes_that_work(
    spec: Spec, rounds: Iterable[Iterable[Way]], judges: Judges, progress: Progress
) -> tuple[str, ...]:
    """Changes of the spec after which it can be designed, as advice to people, MOST at most.

    Args:
        rounds: of ways; a round is tried where the ones before have led to nothing.
    """
    search = _Search(spec, judges, progress)
    for ways in rounds:
        found = search.mildest(ways)
        if found:
            return found
    return ()


@dataclass(frozen=True)
class _Trial:
    change: Change
    spec: Spec

    def also(self, more: Change) -> _Trial:
        return _Trial(self.change.also(more), changed_spec(self.spec, more.overrides))


@dataclass
class _Lane:
    """A way as far as closed forms allow it, and how far it was followed.

    Attributes:
        place: of the trial that comes next.
        has_room: whether there is room for the flexures at that place; False before it was sought.
        verdicts: of the designs so far, with the sizes of their changes.
    """

    trials: list[_Trial]
    place: int = 0
    has_room: bool = False
    verdicts: list[tuple[float, Verdict]] = field(default_factory=list)

    @property
    def next(self) -> _Trial:
        return self.trials[self.place]

    @property
    def key(self) -> str:
        return self.next.change.key

    @property
    def turn(self) -> int:
        """Whose turn is next: the lane with the least."""
        size = self.next.change.size
        return -1 if self.has_room and size <= NEAR else round(size / ALIKE)

    def goes_on(self, verdict: Verdict) -> bool:
        """Whether there is a change further on that may do, after one that failed."""
        self.verdicts.append((self.next.change.size, verdict))
        ahead, end = self._size_ahead(), len(self.trials) - 1
        if len(self.verdicts) == DESIGNS_OF_A_WAY or self.place == end or math.isinf(ahead):
            return False
        sizes = [trial.change.size for trial in self.trials]
        self.place = min(bisect_left(sizes, ahead, lo=self.place + 1), end)
        return True

    def _size_ahead(self) -> float:
        """Size of the change at which the failed claim would be met, by a line through two designs;
        infinite where the second is no nearer."""
        (size, verdict), *earlier = self.verdicts[::-1]
        if not earlier or earlier[0][1].claim != verdict.claim:
            return size + STEP
        before, miss = earlier[0][0], earlier[0][1].miss
        if not verdict.miss < miss < math.inf:
            return math.inf
        return size + verdict.miss * (size - before) / (miss - verdict.miss)


@dataclass
class _Search:
    """The spec and its judges, and how often they may still be asked."""

    spec: Spec
    judges: Judges
    progress: Progress
    shapes: int = SHAPES
    designs: int = DESIGNS

    def mildest(self, ways: Iterable[Way]) -> tuple[str, ...]:
        """The smallest changes of different ways that work."""
        lanes = [_Lane(trials) for way in ways if (trials := self._possible(way))]
        found: dict[str, str] = {}
        while lanes and len(found) < MOST and self.designs > 0:
            lane = min(lanes, key=lambda lane: lane.turn)
            if lane.key not in found and self._followed(lane, found):
                continue
            lanes.remove(lane)
        return tuple(found.values())

    def _followed(self, lane: _Lane, found: dict[str, str]) -> bool:
        """Look for a way's first change with room, or design from there on; False at its end."""
        if not lane.has_room:
            return self._has_room_ahead(lane)
        while self.designs > 0:
            change, verdict = self._designed(lane.next)
            if not verdict.claim:
                found[lane.key] = change.words
                break
            if not lane.goes_on(verdict):
                break
        return False

    def _possible(self, way: Way) -> list[_Trial]:
        """What a spec may say and closed forms allow of a way, up to where they forbid it again.

        Nothing where they forbid it at its end, in its middle and at its quarter.
        """
        last = len(way) - 1
        if not any(self._allowed(way[place]) for place in {last // 4, last // 2, last} if way):
            return []
        trials: list[_Trial] = []
        for change in way:
            trial = self._allowed(change)
            if trial is not None:
                trials.append(trial)
            elif trials:
                break
        return trials

    def _allowed(self, change: Change) -> _Trial | None:
        """The trial of a change that a spec may say and closed forms allow."""
        try:
            changed = changed_spec(self.spec, change.overrides)
        except SpecError:
            return None
        return _Trial(change, changed) if self.judges.is_possible(changed) else None

    def _has_room_ahead(self, lane: _Lane) -> bool:
        """Go to the first change with room for the flexures, if its middle or its end has any."""
        first, last = 0, len(lane.trials) - 1
        for end in dict.fromkeys((last // 2, last)):
            if self._has_room(lane.trials[end]):
                lane.place = bisect_left(lane.trials, True, lo=first, hi=end, key=self._has_room)
                lane.has_room = True
                return True
            first = end + 1
        return False

    def _has_room(self, trial: _Trial) -> bool:
        self.shapes -= 1
        return self.shapes >= 0 and self.judges.has_room(trial.spec)

    def _designed(self, trial: _Trial) -> tuple[Change, Verdict]:
        """A design, and where it would take one change more, that one as well."""
        self.designs -= 1
        self.progress(f"trying: {trial.change.words}")
        verdict = self.judges.design(trial.spec)
        if verdict.cure is None or self.designs == 0:
            return trial.change, verdict
        return self._designed(trial.also(verdict.cure))
