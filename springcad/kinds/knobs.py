"""Changes that make an infeasible case feasible, found by trying the very numbers that are printed.

A knob is one number of the spec in the unit in which people type it. Values are tried on a grid of
three significant digits, so what is printed is what was tested and nothing is rounded afterwards.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Case = TypeVar("Case", bound="DataclassInstance")

FURTHEST = 2.0
"""Knobs are turned by this factor at most."""
FAR = 30.0
"""And by this one where a number may be far off, as by a slip of its unit."""
STRIDE = 0.02
"""The first search steps by this share of the value; the printed grid follows between two steps."""
MOST = 4
"""Remedies given at most, those with the smallest relative change."""


@dataclass(frozen=True)
class Knob:
    """A number of the spec that may be changed.

    Attributes:
        key: its path in the spec.
        unit: as people type it, of the SI value ``scale``; empty for a count.
        target: its path in the case.
        upwards: whether it may be raised as well as lowered.
    """

    key: str
    unit: str
    scale: float
    target: str
    upwards: bool = True


@dataclass(frozen=True)
class Turn:
    """A knob turned from ``start`` to ``value``, which works on to ``last`` (None: far enough)."""

    knob: Knob
    start: float
    value: float
    last: float | None

    @property
    def change(self) -> float:
        """Relative change, the same for halving and doubling."""
        return abs(math.log(self.value / self.start))

    def __str__(self) -> str:
        up = self.value > self.start
        sign = "≥ " if up else "≤ "
        beyond = ""
        if self.last == self.value:
            sign = ""
        elif self.last is not None:
            beyond = f" ({'up' if up else 'down'} to {self.last:g})"
        unit = f" {self.knob.unit}" if self.knob.unit else ""
        verb = "raise" if up else "lower"
        return f"{verb} {self.knob.key} from {self.start:.4g} to {sign}{self.value:g}{unit}{beyond}"


def remedies(
    case: Case, knobs: Sequence[Knob], failures: Callable[[Case], Sequence[str]]
) -> tuple[str, ...]:
    """Changes after which nothing fails: of one number, or of several where no single one helps.

    ``failures`` names what fails for a case; of one that no spec may state it must name more than
    of ``case``, so that it is not taken for a step on the way. Every remedy returned was tried as
    printed; the smallest changes come first. Empty when nothing within a factor of FURTHEST was
    found, and when nothing fails.
    """
    if not failures(case):
        return ()
    singles = _turns(case, knobs, lambda tried: not failures(tried))
    if singles:
        return tuple(str(turn) for turn in singles[:MOST])
    firsts = _helpful(case, knobs, failures)[:MOST]
    chains = [chain for turn in firsts if (chain := _chain(case, turn, knobs, failures))]
    chains.sort(key=lambda chain: sum(turn.change for turn in chain))
    return tuple(" and ".join(str(turn) for turn in chain) for chain in chains)


def far_remedies(
    case: Case, knobs: Sequence[Knob], failures: Callable[[Case], Sequence[str]]
) -> tuple[str, ...]:
    """As ``remedies``, of one number alone, turned by up to a factor of FAR."""
    turns = _turns(case, knobs, lambda tried: not failures(tried), FAR)
    return tuple(str(turn) for turn in turns[:MOST])


def _chain(
    case: Case, turn: Turn, knobs: Sequence[Knob], failures: Callable[[Case], Sequence[str]]
) -> list[Turn]:
    """``turn`` and the further turns after which nothing fails; empty if none are found."""
    case = changed(case, turn.knob, turn.value)
    others = [knob for knob in knobs if knob != turn.knob]
    last = _turns(case, others, lambda tried: not failures(tried))
    if last:
        return [turn, last[0]]
    helpful = _helpful(case, others, failures)
    rest = _chain(case, helpful[0], others, failures) if helpful else []
    return [turn, *rest] if rest else []


def _helpful(
    case: Case, knobs: Sequence[Knob], failures: Callable[[Case], Sequence[str]]
) -> list[Turn]:
    """Turns that cure the first failure and leave fewer; exact values, as other turns follow."""
    failing = failures(case)

    def works(tried: Case) -> bool:
        left = failures(tried)
        return failing[0] not in left and len(left) < len(failing)

    return [replace(turn, last=turn.value) for turn in _turns(case, knobs, works)]


def _turns(
    case: Case, knobs: Sequence[Knob], works: Callable[[Case], bool], furthest: float = FURTHEST
) -> list[Turn]:
    """The smallest turn of each knob that works, smallest first."""
    found = []
    for knob in knobs:
        ways = (
            _turn(case, knob, way, works, furthest) for way in ((1, -1) if knob.upwards else (-1,))
        )
        found += sorted((turn for turn in ways if turn), key=lambda turn: turn.change)[:1]
    return sorted(found, key=lambda turn: turn.change)


def _turn(
    case: Case, knob: Knob, way: int, works: Callable[[Case], bool], furthest: float
) -> Turn | None:
    """The nearest value in one direction that works, and how far on it goes on working."""
    start = value_of(case, knob)
    if start <= 0.0:
        return None
    digits = 0 if not knob.unit else 2 - math.floor(math.log10(start))

    def value(index: int) -> float:
        return round(index * 10.0**-digits, digits)

    def tried(index: int) -> bool:
        return works(changed(case, knob, value(index)))

    def edge(inside: int, outside: int, state: bool) -> int:
        """Between two indices of different state, the last one in ``state`` from ``inside``."""
        while abs(outside - inside) > 1:
            middle = (inside + outside) // 2
            inside, outside = (middle, outside) if tried(middle) == state else (inside, middle)
        return inside

    here = start * 10.0**digits
    indices = _indices(here, way, furthest)
    before = round(here)
    for position, index in enumerate(indices):
        if tried(index):
            first = edge(index, before, True) if position else index
            break
        before = index
    else:
        return None
    inside = index
    for outside in indices[position + 1 :]:
        if not tried(outside):
            return Turn(knob, start, value(first), value(edge(inside, outside, True)))
        inside = outside
    return Turn(knob, start, value(first), None)


def _indices(here: float, way: int, furthest: float) -> list[int]:
    """Of the values tried: steps of STRIDE of the value there, from next to here to the end."""
    index = math.floor(here) + 1 if way > 0 else math.ceil(here) - 1
    end = max(1, round(here * furthest**way))
    indices = []
    while (end - index) * way >= 0:
        indices.append(index)
        index += way * max(1, round(STRIDE * index))
    return indices


def value_of(case: Any, knob: Knob) -> float:
    """The number that the knob turns, in the unit in which people type it."""
    for name in knob.target.split("."):
        case = getattr(case, name)
    return float(case) / knob.scale


def changed(case: Case, knob: Knob, value: float) -> Case:
    """The case with the knob at ``value``, in the unit in which people type it."""
    si = value * knob.scale if knob.unit else int(value)
    return _replaced(case, knob.target, si)


def _replaced(case: Case, path: str, value: Any) -> Case:
    name, _, rest = path.partition(".")
    if rest:
        value = _replaced(getattr(case, name), rest, value)
    return replace(case, **{name: value})
