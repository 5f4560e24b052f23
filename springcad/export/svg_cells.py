"""What stands in one place of a drawing: shapes with their callouts beside and a caption below."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from springcad.export.dxf import part_file
from springcad.export.svg_dimensions import Callouts, arrange, draw
from springcad.export.svg_shapes import INK, shape_bounds, shape_path
from springcad.export.svg_text import Point, clean, element, number, text_line, text_width
from springcad.geometry.biarc import DEFAULT_TOLERANCE
from springcad.result import Dimension, Part, Shape, View

GREY = "#555555"
CAPTION = 12.0
"""Room below a row of cells for their captions (mm)."""
ROLE_SIZE, SMALL_SIZE = 3.0, 2.4


@dataclass(frozen=True)
class Cell:
    """Shapes and the room that they take on the sheet, all in mm.

    Attributes:
        captions: lines below, the first in bold.
        shapes: drawn in this order, their curves as arcs within ``tolerance`` (m).
        bounds: of the shapes, y upwards.
        callouts: of the dimensions.
        width, height: of the cell without its captions.
    """

    captions: tuple[str, ...]
    shapes: tuple[Shape, ...]
    tolerance: float
    bounds: tuple[float, float, float, float]
    callouts: Callouts
    width: float
    height: float


def part_cell(part: Part, name: str) -> Cell:
    """A part of the design ``name``, with what it is cut from and its file."""
    file = part_file(name, part.suffix)
    details = f"{number(part.thickness * 1e3)} mm {part.material}, {file}"
    shapes = (Shape(part.profile, "part"),)
    return _cell((part.caption, details), shapes, part.dimensions, part.tolerance)


def view_cell(view: View) -> Cell:
    """Parts among their mates."""
    return _cell((view.title,), view.shapes, view.dimensions, DEFAULT_TOLERANCE)


def _cell(
    captions: tuple[str, ...],
    shapes: tuple[Shape, ...],
    dimensions: Sequence[Dimension],
    tolerance: float,
) -> Cell:
    bounds = np.array([shape_bounds(shape) for shape in shapes]) * 1e3
    (x0, y0), (x1, y1) = bounds[:, :2].min(axis=0), bounds[:, 2:].max(axis=0)
    callouts = arrange(dimensions, 0.5e-3 * float(x0 + x1))
    drawing = callouts.left_width + float(x1 - x0) + callouts.right_width
    written = max(text_width(line, ROLE_SIZE) for line in captions)
    return Cell(
        captions=captions,
        shapes=shapes,
        tolerance=tolerance,
        bounds=(float(x0), float(y0), float(x1), float(y1)),
        callouts=callouts,
        width=max(drawing, written),
        height=max(float(y1 - y0) + 6.0, callouts.height + 4.0),
    )


def cell_group(cell: Cell, corner: Point, tallest: float) -> str:
    """The shapes in the middle of a cell at ``corner`` in a row of that height; callouts, captions.

    All in mm, y downwards.
    """
    x0, y0, x1, y1 = cell.bounds
    callouts = cell.callouts
    drawing = callouts.left_width + (x1 - x0) + callouts.right_width
    left = corner[0] + 0.5 * (cell.width - drawing) + callouts.left_width
    top = corner[1] + 0.5 * (tallest - (y1 - y0))
    origin = (left - x0, top + y1)
    heading, *details = cell.captions
    middle, below = _caption_middle(cell, corner[0], left), corner[1] + tallest + 5.0
    content = [
        f"<title>{clean(heading)}</title>",
        *(shape_path(shape, origin, cell.tolerance) for shape in cell.shapes),
        *draw(callouts, origin, (left, top, left + (x1 - x0), top + (y1 - y0))),
        text_line((middle, below), heading, ROLE_SIZE, anchor="middle", color=INK, weight="bold"),
        *(
            text_line((middle, below + 4.0), line, SMALL_SIZE, anchor="middle", color=GREY)
            for line in details
        ),
    ]
    return element("g", {}, "\n" + "\n".join(content) + "\n")


def _caption_middle(cell: Cell, start: float, left: float) -> float:
    """Under the shapes, as far as the captions stay in the cell that begins at ``start``."""
    heading, *details = cell.captions
    widths = [text_width(heading, ROLE_SIZE), *(text_width(d, SMALL_SIZE) for d in details)]
    half = 0.5 * max(widths)
    under = left + 0.5 * (cell.bounds[2] - cell.bounds[0])
    return min(max(under, start + half), start + cell.width - half)
