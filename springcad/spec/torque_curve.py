"""A torque curve in a CSV file of its own: simulated or measured, of a design that was written.

angle [deg], torque [N*m]
0.05, 0.018
0.10, 0.037
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path as FilePath
from typing import TypeAlias, cast

from springcad.errors import Problem
from springcad.spec.common import Quantity
from springcad.spec.csv_columns import Column, Fault, FaultsError, Pair, pairs_in
from springcad.spec.file_text import read_text
from springcad.spec.points import MAX_POINTS, Point, Points
from springcad.spec.source import spec_error
from springcad.spec.text import printable
from springcad.spec.tree import Place
from springcad.spec.units import ANGLE, TORQUE, show

COLUMNS = (
    Column("angle", Quantity(ANGLE, "0 deg", "60 deg")),
    Column("torque", Quantity(TORQUE, "0 N*m", "1000000 N*m")),
)
"""Magnitudes, of one direction."""
BENCH_COLUMNS = (
    Column("angle", Quantity(ANGLE, "-90 deg", "90 deg")),
    Column("torque", Quantity(TORQUE, "-1000000 N*m", "1000000 N*m")),
)
MAX_BENCH_POINTS = 20_000


@dataclass(frozen=True)
class TorqueFile:
    """What the file holds.

    Attributes:
        shown: its name in messages.
        points: angle [rad] and torque [N m]. Of ``read_torque_file`` they ascend, the torque from
            its first that is not 0; of ``read_bench_file`` they are as recorded.
        places: where the angle of each point stands.
    """

    shown: str
    points: Points
    places: tuple[Place, ...]

    @property
    def sha256(self) -> str:
        """Of the numbers to 12 digits: the same in any unit and with any comment."""
        lines = (f"{angle:.11e},{torque:.11e}" for angle, torque in self.points)
        return sha256("\n".join(lines).encode("ascii")).hexdigest()

    def problem(self, message: str, point: int | None = None) -> Problem:
        """A problem with a point, or with the whole file."""
        place = Place(self.shown, 1, 1) if point is None else self.places[point]
        return place.problem(message)


def read_torque_file(path: FilePath) -> TorqueFile:
    """The curve in the CSV file ``path``.

    Raises SpecError with every problem, in the order of the file.
    """
    return _read(path, COLUMNS, MAX_POINTS, _ascending)


def read_bench_file(path: FilePath) -> TorqueFile:
    """What a bench test recorded: signed angles and torques, in the order of the file.

    Raises SpecError with every problem, in the order of the file.
    """
    return _read(path, BENCH_COLUMNS, MAX_BENCH_POINTS, _as_recorded)


_Chosen: TypeAlias = Callable[[list[Pair], list[Fault]], tuple[Points, tuple[Place, ...]]]


def _read(path: FilePath, columns: tuple[Column, Column], most: int, chosen: _Chosen) -> TorqueFile:
    """The curve of at most ``most`` points that are as ``chosen`` wants them."""
    shown = printable(path, longest=500)
    text, faults = read_text(path, shown), list[Fault]()
    try:
        pairs = pairs_in(text, shown, columns, faults)
    except FaultsError as error:
        raise spec_error(_problem(fault) for fault in error.faults) from error
    if len(pairs) > most:
        place = pairs[most].places[0]
        faults.append((place, f"more than {most} points; give fewer"))
    points, places = chosen(pairs[:most], faults)
    if not faults and not points:
        faults.append((Place(shown, 1, 1), "has no points below its first line"))
    if faults:
        raise spec_error(_problem(fault) for fault in faults)
    return TorqueFile(shown, points, places)


def _as_recorded(pairs: list[Pair], faults: list[Fault]) -> tuple[Points, tuple[Place, ...]]:
    """The points; those that are none go to ``faults``."""
    read = [(pair.numbers(BENCH_COLUMNS, faults), cast(Place, pair.places[0])) for pair in pairs]
    known = [(point, place) for point, place in read if point is not None]
    return tuple(point for point, _ in known), tuple(place for _, place in known)


def _problem(fault: Fault) -> Problem:
    """In a file every fault has a place."""
    where, message = fault
    return cast(Place, where).problem(message)


def _ascending(pairs: list[Pair], faults: list[Fault]) -> tuple[Points, tuple[Place, ...]]:
    """The points; those that are none, or do not follow on the one before, go to ``faults``."""
    points: list[Point] = []
    places: list[Place] = []
    for pair in pairs:
        point = pair.numbers(COLUMNS, faults)
        if point is None:
            continue
        # Also a point that is out of place is the one before the next: one mistake, one fault.
        if points and (fault := _does_not_follow(pair, points[-1], point)):
            faults.append(fault)
        points.append(point)
        places.append(cast(Place, pair.places[0]))
    return tuple(points), tuple(places)


def _does_not_follow(pair: Pair, before: Point, point: Point) -> Fault | None:
    if point[0] <= before[0]:
        message = f"angle must be more than {show(before[0], ANGLE)}; give loading only"
        return pair.places[0], message
    if point[1] < before[1] or point[1] == before[1] > 0.0:
        least = show(before[1], TORQUE)
        return pair.places[1], f"torque must be more than {least}; give means where it is noisy"
    return None
