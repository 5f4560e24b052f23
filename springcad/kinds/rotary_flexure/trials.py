"""Changes of a spec that make a design possible, found by designing with the numbers printed."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass

from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec

Judge = Callable[[RotaryFlexureSpec], bool]

MOST = 2
"""Changes given at most: each one costs a few designs to find."""


@dataclass(frozen=True)
class Knob:
    """A number of the spec and the values tried for it, the mildest first.

    Attributes:
        section, name: where it stands in the spec.
        unit, scale: as people type it, of the SI value ``scale``.
        digits: after the point, of what is tried and printed.
        factors: on the value; ``values`` above it are tried instead where they are given.
    """

    section: str
    name: str
    unit: str
    scale: float
    digits: int
    factors: tuple[float, ...] = ()
    values: tuple[float, ...] = ()


DEFLECTION = Knob(
    "target", "deflection", " deg", math.pi / 180.0, 2, (0.98, 0.96, 0.94, 0.92, 0.9, 0.85, 0.8)
)
BEND_LIMIT = Knob("flexures", "bend_limit", "", 1.0, 2, values=(0.2, 0.3, 0.4, 0.5, 0.6))
THICKER_TIP = Knob("flexures", "tip_thickness", " mm", 1e-3, 2, (1.2, 1.5, 2.0))
THINNER_TIP = Knob("flexures", "tip_thickness", " mm", 1e-3, 2, (0.8,))


@dataclass(frozen=True)
class _Trial:
    """A changed spec and the change in words."""

    spec: RotaryFlexureSpec
    words: str


def changes_that_work(
    spec: RotaryFlexureSpec, knobs: tuple[Knob, ...], is_possible: Judge, works: Judge
) -> tuple[str, ...]:
    """Changes of one number after which ``works`` holds, as advice to people, ``MOST`` at most.

    A design takes seconds. So a knob is given up where its farthest value that is possible does not
    work; where that works, the mildest one that does is looked for by halving the rest. What is
    given has been designed in any case.

    Args:
        is_possible: by closed forms, which cost nothing.
        works: by a whole design.
    """
    found: list[str] = []
    for knob in knobs:
        if len(found) == MOST:
            break
        trials = [trial for trial in _trials(spec, knob) if is_possible(trial.spec)]
        if trials and works(trials[-1].spec):
            *milder, _ = trials
            mildest = bisect_left(milder, True, key=lambda trial: works(trial.spec))
            found.append(trials[mildest].words)
    return tuple(found)


def _trials(spec: RotaryFlexureSpec, knob: Knob) -> list[_Trial]:
    section = getattr(spec, knob.section)
    start = getattr(section, knob.name) / knob.scale
    wanted = knob.values or [factor * start for factor in knob.factors]
    trials = []
    for value in (round(number, knob.digits) for number in wanted):
        if value <= 0.0 or (knob.values and value <= start):
            continue
        changed = section.model_copy(update={knob.name: value * knob.scale})
        verb = "raise" if value > start else "lower"
        words = f"{verb} {knob.section}.{knob.name} from {start:.4g} to {value:g}{knob.unit}"
        trials.append(_Trial(spec.model_copy(update={knob.section: changed}), words))
    return trials
