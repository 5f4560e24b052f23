"""Changes of a spec that may make it feasible, each as it would be typed, the mildest first."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from springcad.kinds.rotary_flexure.law_easing import eased_laws
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec

FACTORS = (
    1.01, 1.02, 1.03, 1.04, 1.06, 1.08, 1.1, 1.13, 1.16, 1.2, 1.25, 1.3, 1.4, 1.5, 1.6, 1.75, 2.0,
    2.3, 2.6, 3.0, 4.0, 5.0,
)  # fmt: skip
"""By which numbers are raised and lowered."""
DIGITS = 3
"""Of a number that is changed."""


@dataclass(frozen=True)
class Change:
    """A change of a spec.

    Attributes:
        key: of the spec.
        overrides: as after ``--set``.
        words: what to do, for people.
        size: by how much, 0 for nothing; the same for halving and doubling.
    """

    key: str
    overrides: tuple[str, ...]
    words: str
    size: float

    @classmethod
    def of(cls, key: str, value: str, words: str, size: float) -> Change:
        """A change of one value."""
        return cls(key, (f"{key}={value}",), words, size)

    def also(self, other: Change) -> Change:
        """Both changes together."""
        overrides, words = (*self.overrides, *other.overrides), f"{self.words} and {other.words}"
        return Change(self.key, overrides, words, self.size + other.size)


@dataclass(frozen=True)
class Knob:
    """A number of a spec: its key, the unit it is typed in and that unit in SI, none of a count."""

    key: str
    unit: str
    scale: float
    upwards: bool = True
    downwards: bool = True


_DEG, _MM = math.pi / 180.0, 1e-3
KNOBS = (
    Knob("target.deflection", "deg", _DEG),
    Knob("flexures.bend_limit", "", 1.0, downwards=False),
    Knob("envelope.thickness", "mm", _MM),
    Knob("stack.sheet", "mm", _MM),
    Knob("flexures.count", "", 1.0),
    Knob("envelope.contact_radius", "mm", _MM),
    Knob("envelope.root_radius", "mm", _MM),
    Knob("envelope.outer_radius", "mm", _MM, downwards=False),
    Knob("flexures.tip_thickness", "mm", _MM),
    Knob("target.stiffness", "N*m/rad", 1.0),
    Knob("mounting.dowels.radius", "mm", _MM, upwards=False),
    Knob("camshaft.bore_radius", "mm", _MM, upwards=False),
    Knob("camshaft.backlash", "mm", _MM),
    Knob("camshaft.min_tooth", "mm", _MM, upwards=False),
    Knob("flexures.min_gap", "mm", _MM, upwards=False),
    Knob("flexures.min_deformed_gap", "mm", _MM, upwards=False),
    Knob("flexures.root_fillet", "mm", _MM, upwards=False),
    Knob("flexures.fillet_stress", "MPa", 1e6, downwards=False),
    Knob("material.design_stress", "MPa", 1e6, upwards=False),
)
"""What may be changed. The design stress may only be lowered: raising it is not a cure."""


def ways_of(spec: RotaryFlexureSpec) -> Iterator[tuple[Change, ...]]:
    """Every way to change the spec, from mild to far: one number, the style or the law."""
    if spec.flexures.style != "auto":
        yield tuple(_set("flexures.style", style) for style in ("straight", "auto")
                    if style != spec.flexures.style)  # fmt: skip
    if spec.target.law is not None and not isinstance(spec.target.deflection, str):
        yield tuple(
            _eased(share, law) for share, law in eased_laws(spec.target.law, spec.target.deflection)
        )
    for knob in KNOBS:
        start = _number(spec, knob)
        if start is None:
            continue
        if knob.upwards:
            yield _turned(knob, start, 1)
        if knob.downwards:
            yield _turned(knob, start, -1)
    if not isinstance(spec.flexures.root_fillet, str):
        yield (_set("flexures.root_fillet", "auto"),)


def _set(key: str, value: str) -> Change:
    return Change.of(key, value, f"set {key} to {value}", 0.0)


def _eased(share: float, law: str) -> Change:
    part = "all" if share == 1.0 else f"{share:.0%}"
    words = (
        f"set target.law to {law} ({part} of the law replaced by a constant stiffness that ends "
        "at the same torque)"
    )
    return Change.of("target.law", law, words, share)


def _number(spec: RotaryFlexureSpec, knob: Knob) -> float | None:
    """The number as it would be typed; None where the spec gives none or leaves it open."""
    value: object = spec
    for name in knob.key.split("."):
        value = getattr(value, name, None)
    if not isinstance(value, (int, float)) or value <= 0.0:
        return None
    return value / knob.scale


def more_backlash(spec: RotaryFlexureSpec, more: float) -> Change:
    """The backlash raised by so much (m), to whole hundredths of a millimetre."""
    now = spec.camshaft.backlash / _MM
    value = math.ceil(100.0 * (now + more / _MM)) / 100.0
    words = f"raise camshaft.backlash from {now:.4g} to {value:g} mm"
    return Change.of("camshaft.backlash", f"{value:g} mm", words, 0.0)


def _turned(knob: Knob, start: float, way: int) -> tuple[Change, ...]:
    """A number changed step by step, as far as it changes at all when it is rounded."""
    digits = 0 if knob.key == "flexures.count" else DIGITS - 1 - math.floor(math.log10(start))
    values = (round(start * factor**way, digits) for factor in FACTORS)
    unit = f" {knob.unit}" if knob.unit else ""
    verb = "raise" if way > 0 else "lower"
    return tuple(
        Change.of(
            knob.key,
            f"{value:g}{unit}",
            f"{verb} {knob.key} from {start:.4g} to {value:g}{unit}",
            abs(math.log(value / start)),
        )
        for value in dict.fromkeys(values)
        if (value - start) * way > 0.0 and value > 0.0
    )
