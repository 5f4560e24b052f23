"""The dimensions of a part as callouts, their texts in two columns beside it.

An arrow points at the feature, its leader runs to a text to the left or to the right of the part,
on the side where the feature lies. A length also shows the line that it measures.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from springcad.export.svg_text import Point, arrow_head, stroke_path, text_line, text_width
from springcad.result import Dimension

COLOR = "#1b4f8f"
TEXT_SIZE = 2.4
_LINE_WIDTH = 0.12
_ARROW = 1.8
_ROW = 4.2  # mm from one text to the next
_SHELF = 2.0  # mm of leader beside the text
_LEAD = 5.0  # mm from the part to the columns
_INSIDE = 4.0 * _ARROW  # shorter lengths have their arrows outside


@dataclass(frozen=True)
class Callouts:
    """The callouts of one part: those to its left and to its right, from the top down."""

    left: tuple[Dimension, ...]
    right: tuple[Dimension, ...]

    @property
    def left_width(self) -> float:
        return _column_width(self.left)

    @property
    def right_width(self) -> float:
        return _column_width(self.right)

    @property
    def height(self) -> float:
        return _ROW * max(len(self.left), len(self.right))


def arrange(dimensions: Sequence[Dimension], middle: float) -> Callouts:
    """Each dimension on the side of x = ``middle`` (m) where its feature lies, by height."""
    ordered = sorted(dimensions, key=lambda d: -_anchor(d)[1])
    left = tuple(d for d in ordered if _anchor(d)[0] < middle)
    return Callouts(left, tuple(d for d in ordered if d not in left))


def draw(callouts: Callouts, origin: Point, bounds: tuple[float, float, float, float]) -> list[str]:
    """SVG elements; ``origin`` (mm) is where the part's frame lies, ``bounds`` (mm) the part."""
    drawn = [*_centre_lines((*callouts.left, *callouts.right), origin)]
    for side, column in ((-1.0, callouts.left), (1.0, callouts.right)):
        edge = (bounds[0] if side < 0.0 else bounds[2]) + side * _LEAD
        rows = _spread([_drawn(origin, _anchor(d))[1] for d in column], bounds[1], bounds[3])
        for dimension, row in zip(column, rows, strict=True):
            drawn.extend(_callout(dimension, origin, (edge, row), side))
    return drawn


def dimension_text(dimension: Dimension) -> str:
    """The measured value in mm, with R or a diameter sign, and the label.

    A label that states the value itself stands alone.
    """
    length = math.dist(dimension.start, dimension.end) * 1e3
    sign, factor = {"radius": ("R", 1.0), "diameter": ("\u2300", 2.0), "linear": ("", 1.0)}[
        dimension.kind
    ]
    value = f"{factor * length:.3f}".rstrip("0").rstrip(".")
    if re.search(rf"(?<![\d.]){re.escape(value)}(?!\.?\d)", dimension.label):
        return dimension.label
    return f"{sign}{value} {dimension.label}".strip()


def _column_width(column: Sequence[Dimension]) -> float:
    if not column:
        return 0.0
    return _LEAD + _SHELF + 1.0 + max(text_width(dimension_text(d), TEXT_SIZE) for d in column)


def _anchor(dimension: Dimension) -> Point:
    """The point (m) that the arrow of the leader points at."""
    if dimension.kind != "linear":
        return dimension.end
    (x0, y0), (x1, y1) = dimension.start, dimension.end
    return 0.5 * (x0 + x1), 0.5 * (y0 + y1)


def _drawn(origin: Point, point: Point) -> Point:
    """A point of the part (m, y upwards) on the sheet (mm, y downwards)."""
    return origin[0] + 1e3 * point[0], origin[1] - 1e3 * point[1]


def _spread(wanted: Sequence[float], top: float, bottom: float) -> list[float]:
    """Rows near the ``wanted`` heights (increasing), ``_ROW`` apart, about the part's middle."""
    rows: list[float] = []
    for height in wanted:
        rows.append(max(height, rows[-1] + _ROW) if rows else height)
    if not rows:
        return rows
    free = max(0.5 * (top + bottom - _ROW * (len(rows) - 1)), top)
    shift = min(0.0, max(bottom - rows[-1], free - rows[0]))
    return [row + shift for row in rows]


def _callout(dimension: Dimension, origin: Point, elbow: Point, side: float) -> Iterator[str]:
    target = _drawn(origin, _anchor(dimension))
    shelf = (elbow[0] + side * _SHELF, elbow[1])
    yield stroke_path((target, elbow, shelf), COLOR, _LINE_WIDTH)
    if dimension.kind == "linear":
        yield from _measured_line(_drawn(origin, dimension.start), _drawn(origin, dimension.end))
    else:
        yield arrow_head(target, (target[0] - elbow[0], target[1] - elbow[1]), _ARROW, COLOR)
    at = (shelf[0] + side * 0.8, elbow[1] + 0.35 * TEXT_SIZE)
    anchor = "start" if side > 0.0 else "end"
    yield text_line(at, dimension_text(dimension), TEXT_SIZE, anchor=anchor, color=COLOR)


def _measured_line(start: Point, end: Point) -> Iterator[str]:
    """The line measured; arrows inside if they fit, else outside with a short tail each."""
    x, y = end[0] - start[0], end[1] - start[1]
    size = math.hypot(x, y) or 1.0
    if size >= _INSIDE:
        yield stroke_path((start, end), COLOR, _LINE_WIDTH)
        yield arrow_head(start, (-x, -y), _ARROW, COLOR)
        yield arrow_head(end, (x, y), _ARROW, COLOR)
        return
    tail = 2.0 * _ARROW / size
    before, after = (
        (start[0] - tail * x, start[1] - tail * y),
        (end[0] + tail * x, end[1] + tail * y),
    )
    yield stroke_path((before, after), COLOR, _LINE_WIDTH)
    yield arrow_head(start, (x, y), _ARROW, COLOR)
    yield arrow_head(end, (-x, -y), _ARROW, COLOR)


def _centre_lines(dimensions: Sequence[Dimension], origin: Point) -> Iterator[str]:
    """A cross of chain lines through the centre of each set of round dimensions."""
    arms: dict[Point, float] = {}
    for dimension in dimensions:
        if dimension.kind != "linear":
            arm = 1e3 * math.dist(dimension.start, dimension.end) + 2.5
            arms[dimension.start] = max(arms.get(dimension.start, 0.0), arm)
    for centre, arm in arms.items():
        x, y = _drawn(origin, centre)
        for line in (((x - arm, y), (x + arm, y)), ((x, y - arm), (x, y + arm))):
            yield stroke_path(line, "#7a7a7a", 0.09, dashes="4 0.8 0.6 0.8")
