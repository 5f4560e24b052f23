"""Physical quantities as text: ``33.5 mm``, ``150 N*m/rad``, ``912 N/mm^2`` to SI floats.

Only a number and a product of the units below are accepted. The text is held to that form by a
regular expression before pint sees the unit, so that no expression in a spec is ever evaluated.
Angle is a dimension of its own here (in SI it is none), so that a stiffness in N*m/rad cannot be
confused with a torque in N*m. Magnitudes are decimal until the end: ``4.5 mm`` is exactly the
float that ``0.0045`` is.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from decimal import Decimal
from functools import cache
from typing import TYPE_CHECKING

from springcad.spec.text import nearest, printable

if TYPE_CHECKING:
    from pint import UnitRegistry

_UNITS = {
    "m": "[length]",
    "cm": "0.01 * m",
    "mm": "0.001 * m",
    "um": "0.000001 * m",
    "in": "0.0254 * m",
    "kg": "[mass]",
    "g": "0.001 * kg",
    "s": "[time]",
    "rad": "[angle]",
    "deg": "0.01745329251994329576923690768 * rad",
    "N": "kg * m / s**2",
    "kN": "1000 * N",
    "lbf": "4.4482216152605 * N",
    "Pa": "N / m**2",
    "kPa": "1000 * Pa",
    "MPa": "1000000 * Pa",
    "GPa": "1000000000 * Pa",
    "psi": "lbf / in**2",
    "ksi": "1000 * psi",
    "J": "N * m",
    "Nm": "N * m",
    "Nmm": "N * mm",
}
_SPELLINGS = str.maketrans(
    {"µ": "u", "μ": "u", "°": "deg", "·": "*", "⋅": "*", "×": "*", "²": "^2", "³": "^3", "−": "-"}
)

_NUMBER = re.compile(r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?(?![0-9.,])")
_UNIT = r"[A-Za-z]+(?:\^?-?[1-9])?"
_PRODUCT = rf"{_UNIT}(?:[*/]{_UNIT})*"
_FACTOR = rf"(?:{_UNIT}|\({_PRODUCT}\))"
_EXPRESSION = re.compile(rf"{_FACTOR}(?:[*/]{_FACTOR})*")
_LONGEST = 60


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity: its name with article, the unit people read it in, and the usual ones."""

    name: str
    unit: str
    units: tuple[str, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The single unit names that occur in ``units``."""
        return tuple(dict.fromkeys(re.findall("[A-Za-z]+", " ".join(self.units))))

    @property
    def pattern(self) -> str:
        """Regular expression (ECMA) of the usual ways to write it, for editors."""
        units = "|".join(_spellings(unit) for unit in self.units)
        return rf"^\s*[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?\s*({units})\s*$"


def _spellings(unit: str) -> str:
    """The unit as a regular expression that allows for spaces and the other signs."""
    for sign, signs in (
        ("*", r"\s*[* ·⋅]\s*"),
        ("/", r"\s*/\s*"),
        ("deg", "(deg|°)"),
        ("um", "[uµμ]m"),
        ("^2", r"(\^2|\*\*2|2|²)"),
        ("^3", r"(\^3|\*\*3|3|³)"),
    ):
        unit = unit.replace(sign, signs)
    return unit


LENGTH = Dimension("a length", "mm", ("mm", "cm", "m", "um", "in"))
ANGLE = Dimension("an angle", "deg", ("deg", "rad"))
STRESS = Dimension("a stress", "MPa", ("MPa", "GPa", "kPa", "Pa", "N/mm^2", "ksi", "psi"))
STIFFNESS = Dimension(
    "a torsional stiffness",
    "N*m/rad",
    ("N*m/rad", "N*m/deg", "Nm/rad", "Nm/deg", "N*mm/rad", "N*mm/deg", "lbf*in/rad", "lbf*in/deg"),
)
LINEAR_STIFFNESS = Dimension("a linear stiffness", "N/mm", ("N/mm", "N/m", "kN/mm", "lbf/in"))
DENSITY = Dimension("a density", "kg/m^3", ("kg/m^3", "g/cm^3"))
TORQUE = Dimension("a torque", "N*m", ("N*m", "Nm", "N*mm", "lbf*in"))
FORCE = Dimension("a force", "N", ("N", "kN", "lbf"))
MASS = Dimension("a mass", "kg", ("kg", "g"))
TIME = Dimension("a time", "s", ("s",))
_KNOWN = (LENGTH, ANGLE, STRESS, STIFFNESS, DENSITY, TORQUE, FORCE, MASS, TIME)


def parse_quantity(text: str, dimension: Dimension) -> float:
    """The value of ``text`` in SI; ValueError, in words for the user, where it is none."""
    number, unit_text = _split(text.strip(), dimension)
    expression = _expression(unit_text, dimension)
    unit = _registry().parse_units(expression)
    if unit.dimensionality != _registry().parse_units(_pint(dimension.unit)).dimensionality:
        raise ValueError(_wrong_dimension(text, unit.dimensionality, dimension))
    value = float(_registry().Quantity(Decimal(number), unit).to_base_units().magnitude)
    if not math.isfinite(value):
        raise ValueError("must be a finite number")
    return value


def show(value: float, dimension: Dimension) -> str:
    """``value`` (SI) as people read it: ``33.5 mm``."""
    return f"{value / parse_quantity(f'1 {dimension.unit}', dimension):.6g} {dimension.unit}"


def _split(text: str, dimension: Dimension) -> tuple[str, str]:
    """The number and the text of the unit."""
    example = f"for example 33.5 {dimension.unit}"
    if len(text) > _LONGEST:
        raise ValueError(f"is too long for a number with a unit, {example}")
    match = _NUMBER.match(text)
    if match is None:
        if re.match(r"[-+]?\.?(nan|inf)", text, re.IGNORECASE):
            raise ValueError("must be a finite number")
        if re.match(r"[-+]?[0-9.]+,[0-9]", text):
            raise ValueError(f"write the decimal sign as a point and no thousands sign, {example}")
        raise ValueError(f"{printable(text)} is not a number with a unit, {example}")
    unit = text[match.end() :].strip()
    if not unit:
        raise ValueError(f"needs a unit, for example {match[0]} {dimension.unit}")
    return match[0], unit


def _expression(text: str, dimension: Dimension) -> str:
    """The unit as an expression that is safe to hand to pint."""
    tidy = re.sub(r"\s*(\*\*|[*/^()])\s*", r"\1", text.translate(_SPELLINGS)).replace("**", "^")
    tidy = re.sub(r"\s+", "*", tidy)
    if len(tidy) > _LONGEST or not _EXPRESSION.fullmatch(tidy):
        raise ValueError(f"cannot read the unit {printable(text)}; write {_usual(dimension)}")
    for name in re.findall("[A-Za-z]+", tidy):
        if name not in _UNITS:
            guess = nearest(name, dimension.names)
            hint = f"did you mean {guess}?" if guess else f"write {_usual(dimension)}"
            raise ValueError(f"unknown unit {printable(name)}; {hint}")
    return _pint(tidy)


def _pint(expression: str) -> str:
    """Powers as pint writes them: ``mm^2`` and ``mm2`` become ``mm**2``."""
    return re.sub(r"\^?(-?[1-9])", r"**\1", expression)


def _usual(dimension: Dimension) -> str:
    return ", ".join(dimension.units[:4])


def _wrong_dimension(text: str, found: object, expected: Dimension) -> str:
    registry = _registry()
    same = (d for d in _KNOWN if registry.parse_units(_pint(d.unit)).dimensionality == found)
    known = next(same, None)
    if known is TORQUE and expected is STIFFNESS:
        return f"{printable(text)} is a torque; a stiffness is per rad or per deg, as in N*m/rad"
    what = f"is {known.name}" if known else "has the wrong unit"
    return f"{printable(text)} {what}, expected {expected.name} ({_usual(expected)})"


@cache
def _registry() -> UnitRegistry[Decimal]:
    """A registry of the accepted units only; its base units are those of SI."""
    with _without_arrays():
        from pint import UnitRegistry
    registry: UnitRegistry[Decimal] = UnitRegistry(None, non_int_type=Decimal)
    for name, definition in _UNITS.items():
        registry.define(f"{name} = {definition}")
    return registry


@contextmanager
def _without_arrays() -> Iterator[None]:
    """Hide numpy and scipy from an import, unless they are loaded already.

    pint imports both where it finds them, only for quantities that are arrays. Ours are scalars,
    and a spec that is refused shall not wait for numpy.
    """
    hidden = [name for name in ("numpy", "scipy") if name not in sys.modules]
    for name in hidden:
        sys.modules[name] = None  # type: ignore[assignment]
    try:
        yield
    finally:
        for name in hidden:
            del sys.modules[name]
