"""Points of a curve in a spec: a list of pairs in place, or the name of a CSV file beside the spec.

table: [[0 deg, 0 N*m], [1 deg, 1.35 N*m], [1.9 deg, 11.76 N*m]]
table: torque.csv
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any, TypeAlias

from pydantic import ValidationInfo
from pydantic_core import CoreSchema, core_schema

from springcad.spec.csv_columns import Column, Fault, FaultsError, Pair, read_pairs
from springcad.spec.text import UNSAFE
from springcad.spec.units import show

FOLDER = "folder"
"""Key of pydantic's validation context: the folder of the spec, in which files are looked for."""
MAX_POINTS = 1000

Point: TypeAlias = tuple[float, float]
Points: TypeAlias = tuple[Point, ...]
Judge: TypeAlias = Callable[[Point | None, Point], str | None]
"""What is wrong with the second number of a point, given the point before it."""


@dataclass(frozen=True)
class CurvePoints:
    """Type annotation of two or more points of a curve ``of`` something ``over`` another thing.

    The value in the model is ``Points``, SI. They ascend from 0 in the first number, by at least
    ``step``; ``judge`` has a say about the second.
    """

    over: Column
    of: Column
    step: float
    judge: Judge

    def read(self, value: object, info: ValidationInfo) -> Points:
        """The points in SI; FaultsError, or ValueError in words for the user."""
        faults: list[Fault] = []
        if isinstance(value, str):
            folder = (info.context or {}).get(FOLDER, FilePath())
            pairs = read_pairs(folder / beside(value), (self.over, self.of), faults)
        elif isinstance(value, list):
            pairs = list(self._listed(value, faults))
        else:
            raise ValueError(f"must be the name of a CSV file, or a list of pairs {self.words}")
        points = self._points(pairs[: MAX_POINTS + 1], faults)
        if faults:
            raise FaultsError(faults)
        if not 2 <= len(points) <= MAX_POINTS:
            count = len(points) if len(points) <= MAX_POINTS else "more"
            raise ValueError(f"must have from 2 to {MAX_POINTS} points, has {count}")
        return points

    @property
    def words(self) -> str:
        """A point, for people."""
        return f"[{self.over.name} in {_unit(self.over)}, {self.of.name} in {_unit(self.of)}]"

    def _listed(self, value: list[object], faults: list[Fault]) -> Iterator[Pair]:
        """The points of a list in the spec."""
        for index, item in enumerate(value):
            place = (str(index),)
            if isinstance(item, list) and len(item) == 2:
                yield Pair((item[0], item[1]), ((*place, "0"), (*place, "1")))
            else:
                faults.append((place, f"must be a pair {self.words}"))

    def _points(self, pairs: Sequence[Pair], faults: list[Fault]) -> Points:
        """The numbers; pairs that are no point, or not in their place, go to ``faults``."""
        points: list[Point] = []
        for pair in pairs:
            point = pair.numbers((self.over, self.of), faults)
            if point is None:
                continue
            before, known = points[-1] if points else None, len(faults)
            if message := self._out_of_order(before, point):
                faults.append((pair.places[0], message))
            elif message := self.judge(before, point):
                faults.append((pair.places[1], message))
            if len(faults) == known or before is None:
                points.append(point)
        return tuple(points)

    def _out_of_order(self, before: Point | None, point: Point) -> str | None:
        if before is None:
            return None if point[0] == 0.0 else f"the first {self.over.name} must be 0"
        if point[0] >= before[0] + self.step:
            return None
        return f"{self.over.name} must be more than {show(before[0], self.over.quantity.dimension)}"

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, *_: object) -> dict[str, Any]:
        point = {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 2}
        points = {"type": "array", "items": point, "minItems": 2, "maxItems": MAX_POINTS}
        return {"anyOf": [{"type": "string"}, points]}


def _unit(column: Column) -> str:
    return column.quantity.dimension.unit


def beside(name: str, what: str = "a CSV file") -> FilePath:
    """The path of a file that goes with its spec wherever that goes; ValueError for any other."""
    path = FilePath(name)
    if not path.name or path.is_absolute() or ".." in path.parts or UNSAFE.search(name):
        raise ValueError(f"must be {what} beside the spec file or in a folder below it")
    return path
