"""What a refusal says: the limit, and changes of the spec that were designed before they are told.

A design takes seconds. So of each way to change the spec the mildest change is looked for that
passes every closed form and whose flexures have a shape on the design law; that one is designed
and, where a check stops it, one or two that go further. A way without a shape at its
end and in its middle is given up at once. Ways are tried by the size of their change; all is
counted, never timed.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from springcad.errors import SpecError
from springcad.kinds.rotary_flexure.changes import Change
from springcad.result import Progress
from springcad.spec.source import Spec, changed_spec

MOST = 2
"""Changes told at most."""
DESIGNS = 6
"""Springs designed at most:"""
FURTHER = (0, 2, 4, 8)
"""of one way the mildest change that has a shape, and these further on."""
ALIKE = 0.05
"""Changes that differ by less in size are tried in the order in which they are given."""
SHAPES = 30
"""Shapes searched for at most."""

Way = tuple[Change, ...]


@dataclass(frozen=True)
class Judges:
    """What a changed spec must pass, cheap before dear.

    Attributes:
        is_possible: by closed forms.
        has_shape: by a search for the shape on the design law.
        missing: by a whole design, with every check: nothing, a further change that would end the
            only failure, or None where there is no spring.
    """

    is_possible: Callable[[Spec], bool]
    has_shape: Callable[[Spec], bool]
    missing: Callable[[Spec], Way | None]


def changes_that_work(
    spec: Spec, ways: Iterable[Way], judges: Judges, progress: Progress, first: str = ""
) -> tuple[str, ...]:
    """Changes of the spec after which it can be designed, as advice to people, MOST at most.

    Args:
        first: key that is changed before the others.
    """
    possible = [way for changes in ways if (way := _possible(spec, changes, judges))]
    possible.sort(key=lambda way: (way[0].change.key != first, round(way[0].change.size / ALIKE)))
    search, found = _Search(judges, progress), dict[str, str]()
    for way in possible:
        if len(found) == MOST or search.designs == 0:
            break
        change = None if way[0].change.key in found else search.mildest(way)
        if change is not None:
            found[change.key] = change.words
    return tuple(found.values())


@dataclass(frozen=True)
class _Trial:
    change: Change
    spec: Spec

    def also(self, more: Change) -> _Trial:
        return _Trial(self.change.also(more), changed_spec(self.spec, more.overrides))


def _possible(spec: Spec, changes: Way, judges: Judges) -> list[_Trial]:
    """What a spec may say and closed forms allow of a way, up to where they forbid it again."""
    trials: list[_Trial] = []
    for change in changes:
        try:
            trial = _Trial(change, changed_spec(spec, change.overrides))
        except SpecError:
            continue
        if judges.is_possible(trial.spec):
            trials.append(trial)
        elif trials:
            break
    return trials


@dataclass
class _Search:
    """The judges, and how often they may still be asked."""

    judges: Judges
    progress: Progress
    shapes: int = SHAPES
    designs: int = DESIGNS

    def mildest(self, way: list[_Trial]) -> Change | None:
        """The first change that has a shape, or one further on, that works when it is designed."""
        last = len(way) - 1
        end = next((place for place in (last, last // 2) if self._has_shape(way[place])), None)
        if end is None:
            return None
        first = bisect_left(way, True, hi=end, key=self._has_shape)
        for place in dict.fromkeys(min(first + further, end) for further in FURTHER):
            change = self._working(way[place])
            if change is not None:
                return change
        return None

    def _has_shape(self, trial: _Trial) -> bool:
        self.shapes -= 1
        return self.shapes >= 0 and self.judges.has_shape(trial.spec)

    def _working(self, trial: _Trial) -> Change | None:
        """The change if it works, with what it takes besides."""
        if self.designs == 0:
            return None
        self.designs -= 1
        self.progress(f"trying: {trial.change.words}")
        missing = self.judges.missing(trial.spec)
        if missing is None:
            return None
        return self._working(trial.also(missing[0])) if missing else trial.change
