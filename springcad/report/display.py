"""SI numbers as people read them, in one place: units, significant digits, plain text.

Everything else in springcad is SI. The terminal, the HTML report and the plots get their
millimetres, degrees and megapascals from here, so that no two of them can differ.
"""

from __future__ import annotations

import math
from typing import NamedTuple
from unicodedata import category

from springcad.result import Check, Comparison, Outcome

DIGITS = 4
_MOST_DIGITS = 15
_SMALLEST_PLAIN = 1e-4
_LARGEST_PLAIN = 1e7
_SIGNS_OF_PRINT = str.maketrans(
    {"*": "\N{MIDDLE DOT}", "-": "\N{MINUS SIGN}", " ": "\N{NO-BREAK SPACE}"}
)


class DisplayUnit(NamedTuple):
    """Multiply an SI number by ``scale`` to get the number of ``label`` (empty for a ratio)."""

    scale: float
    label: str


_DISPLAY_UNITS = {
    "1": DisplayUnit(1.0, ""),
    "m": DisplayUnit(1e3, "mm"),
    "m^2": DisplayUnit(1e6, "mm^2"),
    "m^3": DisplayUnit(1e9, "mm^3"),
    "m^4": DisplayUnit(1e12, "mm^4"),
    "1/m": DisplayUnit(1e-3, "1/mm"),
    "rad": DisplayUnit(180 / math.pi, "deg"),
    "Pa": DisplayUnit(1e-6, "MPa"),
    "N/m": DisplayUnit(1e-3, "N/mm"),
    "kg": DisplayUnit(1e3, "g"),
}


def display_unit(unit: str) -> DisplayUnit:
    """What the SI ``unit`` is shown in; a unit that is not converted (N*m, J, s) stays as it is."""
    return _DISPLAY_UNITS.get(unit, DisplayUnit(1.0, unit))


def format_number(value: float, digits: int = DIGITS) -> str:
    """``value`` with ``digits`` significant digits; powers of ten only far from one.

    Digits left of the decimal point are never rounded away. NaN is ``not computed``.
    """
    if math.isnan(value):
        return "not computed"
    if math.isinf(value):
        return "infinite" if value > 0 else "-infinite"
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    if not _SMALLEST_PLAIN <= abs(value) < _LARGEST_PLAIN:
        return f"{mantissa}e{int(exponent)}"
    return f"{value:.{max(0, digits - 1 - int(exponent))}f}"


def format_value(value: float, unit: str, digits: int = DIGITS) -> str:
    """An SI number as people read it, with its unit: ``format_value(0.253, "rad")`` is 14.50 deg.

    A whole number without a unit is a count and is shown as one.
    """
    if not math.isfinite(value):
        return format_number(value)
    scale, label = display_unit(unit)
    if not label and value == round(value) and abs(value) < _LARGEST_PLAIN:
        return str(round(value))
    number = format_number(value * scale, digits)
    return f"{number} {label}" if label else number


def format_check(check: Check) -> tuple[str, str]:
    """Value and limit of a check; more digits where a broken limit would look like a kept one."""
    if check.status != "pass":
        return format_apart(check.value, check.limit, check.unit)
    return format_value(check.value, check.unit), format_value(check.limit, check.unit)


def format_apart(value: float, limit: float, unit: str) -> tuple[str, str]:
    """Two SI numbers with so many digits that they do not look alike, unless they are."""
    scale, _ = display_unit(unit)
    digits = DIGITS
    while (
        value != limit
        and digits < _MOST_DIGITS
        and _rounded(value * scale, digits) == _rounded(limit * scale, digits)
    ):
        digits += 1
    return format_value(value, unit, digits), format_value(limit, unit, digits)


def _rounded(value: float, digits: int) -> float:
    return float(f"{value:.{digits - 1}e}")


def format_deviation(outcome: Outcome) -> str:
    """Deviation of an outcome from its target in per cent, signed; empty where there is none."""
    if outcome.target is None or outcome.target == 0:
        return ""
    per_cent = 100 * (outcome.value - outcome.target) / abs(outcome.target)
    if not math.isfinite(per_cent):
        return ""
    return f"{per_cent:+.2f} %" if abs(per_cent) >= 0.005 else "0.00 %"


def format_difference(value: float, comparison: Comparison) -> str:
    """A difference (or its tolerance) in the measure of a comparison, in per cent if relative."""
    if not comparison.relative:
        return format_value(value, comparison.unit, 2)
    return f"{100 * value:.2f} %" if math.isfinite(value) else format_number(value)


def typeset(quantity: str) -> str:
    """A formatted number with the signs of print, kept on one line; for pages, not terminals."""
    return quantity.translate(_SIGNS_OF_PRINT)


def printable(text: str) -> str:
    """``text`` without characters that could steer a terminal or reorder a line of a page."""
    return "".join(c if _is_plain(c) else "\N{REPLACEMENT CHARACTER}" for c in text)


def _is_plain(character: str) -> bool:
    # isprintable() knows one space only; the no-break space and its like are harmless too.
    return character.isprintable() or character == "\n" or category(character) == "Zs"
