"""Changes of a spec, each as it would be typed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec

DIGITS = 3
"""Of a number that is changed."""
_MM = 1e-3


@dataclass(frozen=True)
class Change:
    """A change of a spec.

    Attributes:
        key: of the spec.
        overrides: as after ``--set``.
        words: what to do, for people.
        size: by how much, the same for halving and doubling; 0 for what is no number, and for a
            limit that was found.
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
        return Change(f"{self.key}, {other.key}", overrides, words, self.size + other.size)


@dataclass(frozen=True)
class Knob:
    """A number of a spec: its key, the unit it is typed in and that unit in SI, none of a count."""

    key: str
    unit: str
    scale: float
    upwards: bool = True
    downwards: bool = True

    def start(self, spec: RotaryFlexureSpec) -> float | None:
        """The number as it would be typed; None where the spec gives none or leaves it open."""
        value: object = spec
        for name in self.key.split("."):
            value = getattr(value, name, None)
        if not isinstance(value, (int, float)) or value <= 0.0:
            return None
        return value / self.scale

    def turned(
        self, spec: RotaryFlexureSpec, way: int, factors: Sequence[float]
    ) -> tuple[Change, ...]:
        """The number changed step by step, as far as it changes at all when it is rounded.

        Args:
            way: 1 upwards, -1 downwards.
        """
        start = self.start(spec)
        if start is None or not (self.upwards if way > 0 else self.downwards):
            return ()
        digits = DIGITS - 1 - math.floor(math.log10(start)) if self.unit or start < 1.0 else 0
        values = dict.fromkeys(round(start * factor**way, digits) for factor in factors)
        return tuple(
            self._to(start, value, abs(math.log(value / start)))
            for value in values
            if (value - start) * way > 0.0 and value > 0.0
        )

    def lowered_below(self, spec: RotaryFlexureSpec, limit: float) -> tuple[Change, ...]:
        """The number lowered to the next hundredth below a limit (SI) that was found for it."""
        start = self.start(spec)
        value = (math.ceil(round(100.0 * limit / self.scale, 6)) - 1) / 100.0
        if start is None or not 0.0 < value < start:
            return ()
        return (self._to(start, value, 0.0),)

    def _to(self, start: float, value: float, size: float) -> Change:
        unit = f" {self.unit}" if self.unit else ""
        verb = "raise" if value > start else "lower"
        words = f"{verb} {self.key} from {start:.4g} to {value:g}{unit}"
        return Change.of(self.key, f"{value:g}{unit}", words, size)


def more_backlash(spec: RotaryFlexureSpec, more: float) -> Change:
    """The backlash raised by so much (m), to whole hundredths of a millimetre."""
    now = spec.camshaft.backlash / _MM
    value = math.ceil(100.0 * (now + more / _MM)) / 100.0
    words = f"raise camshaft.backlash from {now:.4g} to {value:g} mm"
    return Change.of("camshaft.backlash", f"{value:g} mm", words, 0.0)
