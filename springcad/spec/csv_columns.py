"""A CSV file of two columns of numbers, with names and units in its first line.

The first line is as ``angle [deg], torque [N*m]``, ``angle (deg)`` or ``angle_deg``; then a point a
line. Empty lines, and lines that begin with ``#``, are passed over. The order of the columns is
free. The decimal sign is a point.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import TypeAlias

from springcad.errors import SpecError
from springcad.spec.common import Quantity
from springcad.spec.file_text import read_text
from springcad.spec.text import UNSAFE, listing, nearest, printable
from springcad.spec.tree import MAX_SCALAR, Path, Place
from springcad.spec.units import parse_quantity

Where: TypeAlias = Place | Path
"""Where something stands: in a file, or inside a value of the spec."""
Fault: TypeAlias = tuple[Where, str]


class FaultsError(ValueError):
    """Several faults of one value, each with its place."""

    def __init__(self, faults: Sequence[Fault]) -> None:
        super().__init__("; ".join(message for _, message in faults))
        self.faults = tuple(faults)


@dataclass(frozen=True)
class Column:
    """One of the two quantities of a curve; ``name`` is that of the column of a file."""

    name: str
    quantity: Quantity

    @property
    def title(self) -> str:
        """What stands over the column in a file."""
        return f"{self.name} [{self.quantity.dimension.unit}]"


@dataclass(frozen=True)
class Pair:
    """A point as it was typed: two numbers with units, and where they stand."""

    texts: tuple[object, object]
    places: tuple[Where, Where]

    def numbers(
        self, columns: tuple[Column, Column], faults: list[Fault]
    ) -> tuple[float, float] | None:
        """The point in SI; None, with the faults, where a text is no such quantity."""
        known, numbers = len(faults), []
        for column, text, place in zip(columns, self.texts, self.places, strict=True):
            try:
                numbers.append(float(column.quantity.read(text)))
            except ValueError as error:
                faults.append((place, f"{column.name}: {error}"))
        return (numbers[0], numbers[1]) if len(faults) == known else None


_Cell: TypeAlias = tuple[str, Place]

_TITLE = re.compile(r"(?P<name>[A-Za-z]+)\s*(?:\[(?P<a>[^\[\]]*)\]|\((?P<b>.*)\)|_(?P<c>\w+))?")


def read_pairs(path: FilePath, columns: tuple[Column, Column], faults: list[Fault]) -> list[Pair]:
    """The points in the file, in its order; lines that are none go to ``faults``.

    Raises FaultsError where the file or its first line cannot be read.
    """
    shown = printable(path, longest=500)
    try:
        text = read_text(path, shown)
    except SpecError as error:
        raise FaultsError([((), f"{shown}: {p.message}") for p in error.problems]) from error
    return pairs_in(text, shown, columns, faults)


def pairs_in(
    text: str, shown: str, columns: tuple[Column, Column], faults: list[Fault]
) -> list[Pair]:
    """The same for the text of a file; ``shown`` is its name in messages."""
    lines = list(_lines(text, shown, faults))
    if not lines:
        message = f"holds no line with the columns, {columns[0].title}, {columns[1].title}"
        raise FaultsError([*faults, (Place(shown, 1, 1), message)])
    units = _units(lines[0], columns)
    return [pair for line in lines[1:] if (pair := _pair(line, columns, units, faults))]


def _lines(text: str, shown: str, faults: list[Fault]) -> Iterator[list[_Cell]]:
    """The cells of each line that says something."""
    for number, line in enumerate(re.split("\r\n|\r|\n", text), start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        if len(line) > MAX_SCALAR:
            faults.append((Place(shown, number, 1), f"more than {MAX_SCALAR} characters"))
        elif unsafe := UNSAFE.search(line):
            place = Place(shown, number, unsafe.start() + 1)
            faults.append((place, f"the character {unsafe[0]!a} is not accepted"))
        else:
            yield list(_cells(line, shown, number))


def _cells(line: str, shown: str, number: int) -> Iterator[_Cell]:
    column = 1
    for cell in line.split(","):
        indent = len(cell) - len(cell.lstrip())
        yield cell.strip(), Place(shown, number, column + indent)
        column += len(cell) + 1


def _units(header: list[_Cell], columns: tuple[Column, Column]) -> dict[str, tuple[int, str]]:
    """Position and unit of each column, by its name; FaultsError if they are not as wanted."""
    wanted = {column.name: column for column in columns}
    titles = ", ".join(column.title for column in columns)
    found: dict[str, tuple[int, str]] = {}
    faults: list[Fault] = []
    for position, (text, place) in enumerate(header):
        match = _TITLE.fullmatch(text)
        name = match["name"].lower() if match else text
        if match is None or name not in wanted or name in found:
            faults.append((place, _bad_title(text, name, found, titles, tuple(wanted))))
            continue
        unit = (match["a"] or match["b"] or match["c"] or "").replace("_per_", "/")
        found[name] = (position, unit)
        try:
            parse_quantity(f"1 {unit}", wanted[name].quantity.dimension)
        except ValueError as error:
            faults.append((place, f"unit of {name}: {error}"))
    missing = [name for name in wanted if name not in found]
    if missing and not faults:
        faults.append((header[0][1], f"no column {listing(missing)}; write {titles}"))
    if faults:
        # a line of which nothing is as wanted is no first line at all
        raise FaultsError(faults if found else faults[:1])
    return found


def _bad_title(
    text: str, name: str, found: dict[str, tuple[int, str]], titles: str, known: tuple[str, ...]
) -> str:
    if name in found:
        return f"column {name} is given a second time"
    if ";" in text or "\t" in text:
        return f"columns are separated by commas; write {titles}"
    guess = nearest(name, known)
    hint = f"did you mean {guess}?" if guess else f"the first line is {titles}"
    return f"unknown column {printable(text)}; {hint}"


def _pair(
    line: list[_Cell],
    columns: tuple[Column, Column],
    units: dict[str, tuple[int, str]],
    faults: list[Fault],
) -> Pair | None:
    """The point of a line, its numbers with their units."""
    if len(line) != len(columns):
        message = f"must be two numbers with a comma between them, is {len(line)}"
        faults.append((line[0][1], message))
        return None
    texts, places = [], []
    for column in columns:
        position, unit = units[column.name]
        text, place = line[position]
        if not text:
            faults.append((place, f"{column.name} is empty"))
            return None
        texts.append(f"{text} {unit}")
        places.append(place)
    return Pair((texts[0], texts[1]), (places[0], places[1]))
