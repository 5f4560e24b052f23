"""Values of a spec that are lists of numbers with units: coefficients, bounds, and ranges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pydantic_core import CoreSchema, core_schema

from springcad.spec.common import Quantity
from springcad.spec.csv_columns import Fault, FaultsError
from springcad.spec.units import Dimension, parse_quantity

MAX_COEFFICIENTS = 8
LARGEST = 1e40


@dataclass(frozen=True)
class Coefficients:
    """Type annotation of the coefficients of a polynomial of the angle, lowest power first.

    The n-th is a torque per angle to the power ``first`` + n; the value in the model is a tuple,
    SI.
    """

    first: int

    def read(self, value: object) -> tuple[float, ...]:
        """The coefficients in SI; FaultsError, or ValueError in words for the user."""
        if not isinstance(value, list) or not 1 <= len(value) <= MAX_COEFFICIENTS:
            raise ValueError(
                f"must be a list of 1 to {MAX_COEFFICIENTS} coefficients, lowest power first: "
                f"[{', '.join(f'1 {per_angle(self.first + n).unit}' for n in range(2))}, ...]"
            )
        faults: list[Fault] = []
        numbers = []
        for index, item in enumerate(value):
            dimension = per_angle(self.first + index)
            try:
                if not isinstance(item, str):
                    raise ValueError(f"needs a unit, for example 1 {dimension.unit}")
                numbers.append(parse_quantity(item, dimension))
                if abs(numbers[-1]) > LARGEST:
                    raise ValueError("is larger than any joint's")
            except ValueError as error:
                faults.append(((str(index),), str(error)))
        if faults:
            raise FaultsError(faults)
        return tuple(numbers)

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, *_: object) -> dict[str, Any]:
        items = {"type": "string"}
        return {"type": "array", "items": items, "minItems": 1, "maxItems": MAX_COEFFICIENTS}


def per_angle(power: int) -> Dimension:
    """The dimension of a torque per angle to a power."""
    rad, deg = (unit if power == 1 else f"{unit}^{power}" for unit in ("rad", "deg"))
    return Dimension(f"a torque per {rad}", f"N*m/{rad}", (f"N*m/{rad}", f"N*m/{deg}"))


@dataclass(frozen=True)
class Bounds:
    """Type annotation of a quantity that is given, or free between two bounds.

    ``3.4 mm`` or ``[3 mm, 3.5 mm]``; the value in the model is (low, high), SI, equal if given.
    """

    quantity: Quantity

    def read(self, value: object) -> tuple[float, float]:
        """The bounds in SI; ValueError in words for the user."""
        if not isinstance(value, list):
            number = float(self.quantity.read(value))
            return number, number
        if len(value) != 2:
            raise ValueError("must be one value, or two bounds [low, high]")
        return _low_and_high(value, self.quantity, "must have its lower bound first")

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, *_: object) -> dict[str, Any]:
        return {"anyOf": [_one_schema(self.quantity), _pair_schema(self.quantity)]}


@dataclass(frozen=True)
class Range:
    """Type annotation of a range ``[10 mm, 45 mm]`` of a quantity, all of which is wanted.

    The value in the model is (least, greatest), SI; ``words`` of the quantity stand as typed.
    """

    quantity: Quantity

    def read(self, value: object) -> tuple[float, float] | str:
        """The range in SI; ValueError in words for the user."""
        if isinstance(value, str) and value in self.quantity.words:
            return value
        if not isinstance(value, list) or len(value) != 2:
            words = "".join(f", or {word}" for word in self.quantity.words)
            raise ValueError(f"must be a list of two values, [least, greatest]{words}")
        return _low_and_high(value, self.quantity, "must have its least value first")

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, *_: object) -> dict[str, Any]:
        pair, words = _pair_schema(self.quantity), list(self.quantity.words)
        return {"anyOf": [{"enum": words}, pair]} if words else pair


def _low_and_high(items: list[object], quantity: Quantity, fault: str) -> tuple[float, float]:
    low, high = (float(quantity.read(item)) for item in items)
    if not low < high:
        raise ValueError(fault)
    return low, high


def _one_schema(quantity: Quantity) -> dict[str, Any]:
    return {"type": "string", "pattern": quantity.dimension.pattern}


def _pair_schema(quantity: Quantity) -> dict[str, Any]:
    return {"type": "array", "items": _one_schema(quantity), "minItems": 2, "maxItems": 2}
