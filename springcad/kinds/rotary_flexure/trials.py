"""Changes of a spec that make a design possible, found by designing with the numbers printed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec

Works = Callable[[RotaryFlexureSpec], bool]


@dataclass(frozen=True)
class Knob:
    """A number of the spec and the values tried for it, the mildest first.

    Attributes:
        section, name: where it stands in the spec.
        unit, scale: as people type it, of the SI value ``scale``.
        factors: on the value; ``values`` are tried instead where they are given.
        digits: after the point, of what is tried and printed.
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
TIP_THICKNESS = Knob("flexures", "tip_thickness", " mm", 1e-3, 2, (1.2, 0.8, 1.5, 2.0))


def changes_that_work(
    spec: RotaryFlexureSpec, knobs: tuple[Knob, ...], works: Works
) -> Iterator[str]:
    """For each knob the first value with which ``works`` holds, as advice to people."""
    for knob in knobs:
        section = getattr(spec, knob.section)
        start = getattr(section, knob.name) / knob.scale
        rising = [value for value in knob.values if value > start]
        for wanted in rising or [factor * start for factor in knob.factors]:
            value = round(wanted, knob.digits)
            changed = section.model_copy(update={knob.name: value * knob.scale})
            if value > 0.0 and works(spec.model_copy(update={knob.section: changed})):
                verb = "raise" if value > start else "lower"
                key = f"{knob.section}.{knob.name}"
                yield f"{verb} {key} from {start:.4g} to {value:g}{knob.unit}"
                break
