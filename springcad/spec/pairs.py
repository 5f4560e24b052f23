"""Lists of pairs in a spec: S-N points, and the levels of a load histogram.

sn: [[1e3, 1500 MPa], [1e6, 700 MPa]]
histogram: [[20 N*m, 1e4], [35 N*m, 500]]
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, TypeAlias

from pydantic_core import CoreSchema, core_schema

from springcad.spec.common import Quantity
from springcad.spec.csv_columns import Fault, FaultsError
from springcad.spec.text import printable
from springcad.spec.units import TORQUE

MOST_PAIRS = 1000

Pair: TypeAlias = tuple[Any, Any]
Judge: TypeAlias = Callable[[Pair, Pair], str | None]
"""What is wrong with a pair, given the one before it."""


class Reader(Protocol):
    """What reads one number of a pair."""

    def read(self, value: object) -> object:
        """The number in SI; ValueError in words for the user."""
        ...


@dataclass(frozen=True)
class Number:
    """A bare number above ``above``, up to ``most``."""

    above: float
    most: float

    def read(self, value: object) -> float:
        if not isinstance(value, (int, float)) or isinstance(value, bool):
            raise ValueError(f"must be a bare number, is {printable(repr(value), 30)}")
        if not self.above < value <= self.most:
            raise ValueError(
                f"must be more than {self.above:g} and at most {self.most:g}, "
                f"is {printable(value, 30)}"
            )
        return float(value)


class Load(NamedTuple):
    """A load of a histogram: a torque (``unit`` N*m) or a share of the full deflection (1)."""

    value: float
    unit: str


class LoadReader:
    """A torque with its unit, or a bare share of the full deflection."""

    def read(self, value: object) -> Load:
        if isinstance(value, str):
            torque = Quantity(TORQUE, "0 N*m", "1000000 N*m").read(value)
            return Load(float(torque), TORQUE.unit)
        return Load(Number(0.0, 1.0).read(value), "1")


@dataclass(frozen=True)
class Pairs:
    """Type annotation of a list of at least ``least`` pairs; the value is a tuple of pairs, SI.

    ``words`` stand for a pair in messages.
    """

    first: Reader
    second: Reader
    words: str
    least: int
    judge: Judge

    def read(self, value: object) -> tuple[Pair, ...]:
        """The pairs; FaultsError, or ValueError in words for the user."""
        if not isinstance(value, list) or not self.least <= len(value) <= MOST_PAIRS:
            raise ValueError(f"must be a list of {self.least} to {MOST_PAIRS} pairs {self.words}")
        faults: list[Fault] = []
        pairs: list[Pair] = []
        for index, item in enumerate(value):
            place = (str(index),)
            if not isinstance(item, list) or len(item) != 2:
                faults.append((place, f"must be a pair {self.words}"))
                continue
            numbers = []
            readers = (self.first, self.second)
            for position, (reader, text) in enumerate(zip(readers, item, strict=True)):
                try:
                    numbers.append(reader.read(text))
                except ValueError as error:
                    faults.append(((*place, str(position)), str(error)))
            if len(numbers) < 2:
                continue
            pair = (numbers[0], numbers[1])
            if pairs and (message := self.judge(pairs[-1], pair)):
                faults.append((place, message))
            pairs.append(pair)
        if faults:
            raise FaultsError(faults)
        return tuple(pairs)

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, *_: object) -> dict[str, Any]:
        pair = {"type": "array", "minItems": 2, "maxItems": 2}
        return {"type": "array", "items": pair, "minItems": self.least, "maxItems": MOST_PAIRS}


def falls(before: Pair, pair: Pair) -> str | None:
    """Of S-N points: more cycles, less stress."""
    if not pair[0] > before[0]:
        return "cycles must be more than those of the point before"
    return None if pair[1] < before[1] else "stress must be less than that of the point before"


def alike(before: Pair, pair: Pair) -> str | None:
    """Of histogram levels: all torques, or all shares."""
    if pair[0].unit == before[0].unit:
        return None
    return "give torques, or shares of the deflection, not both"
