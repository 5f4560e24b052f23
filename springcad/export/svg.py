"""A finished design as one drawing at true size (mm): its parts, and views of them among mates."""

from __future__ import annotations

import math
from collections.abc import Sequence

from springcad.export.svg_cells import (
    CAPTION,
    GREY,
    ROLE_SIZE,
    SMALL_SIZE,
    Cell,
    cell_group,
    part_cell,
    view_cell,
)
from springcad.export.svg_shapes import INK
from springcad.export.svg_text import (
    Attributes,
    Point,
    clean,
    element,
    number,
    stroke_path,
    text_line,
    text_width,
)
from springcad.result import Result

_MARGIN = 8.0
_BETWEEN = 12.0  # mm between the cells of a row
_BETWEEN_ROWS = 6.0
_HEADER = 12.0
_FOOTER = 5.0
_TITLE_SIZE = 4.2
_PAGE_WIDTH = 281.0
"""That of A4 (mm). Views go on in a new row when they would be wider than this, the parts, or a
sheet of ``_SHAPE``."""
_SHAPE = 1.4
"""Width over height that many or large views should take, about."""


def result_to_svg(result: Result) -> str:
    """The drawing as SVG text; width and height are the true size in millimetres."""
    parts = [part_cell(part, result.name) for part in result.parts]
    views = [view_cell(view) for view in result.views]
    area = sum((cell.width + _BETWEEN) * (cell.height + CAPTION) for cell in (*parts, *views))
    widest = max(_row_width(parts), _PAGE_WIDTH, math.sqrt(_SHAPE * area))
    rows = [parts, *_rows(views, widest)]
    heights = [max((cell.height for cell in row), default=0.0) for row in rows]
    title_width = max(text_width(result.name, _TITLE_SIZE), 100.0)
    width = max(title_width, *map(_row_width, rows)) + 2.0 * _MARGIN
    drawing = sum(heights) + CAPTION * len(rows) + _BETWEEN_ROWS * (len(rows) - 1)
    height = 2.0 * _MARGIN + _HEADER + drawing + _FOOTER
    drawn = [
        element("rect", {"width": width, "height": height, "fill": "#ffffff"}),
        *_frame(result, width, height),
    ]
    top = _MARGIN + _HEADER
    for row, tallest in zip(rows, heights, strict=True):
        x = 0.5 * (width - _row_width(row))
        for cell in row:
            drawn.append(cell_group(cell, (x, top), tallest))
            x += cell.width + _BETWEEN
        top += tallest + CAPTION + _BETWEEN_ROWS
    content = "\n".join([f"<title>{clean(result.name)}</title>", *drawn])
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" version="1.1" width="{number(width)}mm" '
        f'height="{number(height)}mm" viewBox="0 0 {number(width)} {number(height)}" role="img">\n'
        f"{content}\n</svg>\n"
    )


def _row_width(row: Sequence[Cell]) -> float:
    return sum(cell.width for cell in row) + _BETWEEN * max(len(row) - 1, 0)


def _rows(cells: Sequence[Cell], widest: float) -> list[list[Cell]]:
    """The cells in order, as many in a row as fit into the width; always one."""
    rows: list[list[Cell]] = []
    for cell in cells:
        if rows and _row_width([*rows[-1], cell]) <= widest:
            rows[-1].append(cell)
        else:
            rows.append([cell])
    return rows


def _frame(result: Result, width: float, height: float) -> list[str]:
    """Border, title above, scale bar and remarks below."""
    inset = 0.5 * _MARGIN
    border: Attributes = {
        "x": inset,
        "y": inset,
        "width": width - _MARGIN,
        "height": height - _MARGIN,
        "fill": "none",
        "stroke": INK,
        "stroke-width": 0.25,
    }
    rule = _MARGIN + _HEADER - 3.5
    foot = height - _MARGIN - _FOOTER - 1.0
    title = (_MARGIN, _MARGIN + 4.5)
    return [
        element("rect", border),
        text_line(title, result.name, _TITLE_SIZE, color=INK, weight="bold"),
        text_line((width - _MARGIN, title[1]), result.kind, ROLE_SIZE, anchor="end", color=GREY),
        stroke_path(((inset, rule), (width - inset, rule)), INK, 0.18),
        stroke_path(((inset, foot), (width - inset, foot)), INK, 0.18),
        *_scale_bar((_MARGIN, foot + 4.0)),
        text_line(
            (width - _MARGIN, foot + 5.2),
            "dimensions in mm, scale 1:1",
            SMALL_SIZE,
            anchor="end",
            color=GREY,
        ),
    ]


def _scale_bar(start: Point) -> list[str]:
    """A bar of 20 mm in steps of 5 mm."""
    x, y = start
    steps = [
        element(
            "rect",
            {
                "x": x + 5.0 * i,
                "y": y,
                "width": 5.0,
                "height": 1.2,
                "fill": INK if i % 2 == 0 else "#ffffff",
                "stroke": INK,
                "stroke-width": 0.12,
            },
        )
        for i in range(4)
    ]
    return [*steps, text_line((x + 21.5, y + 1.4), "20 mm", SMALL_SIZE, color=GREY)]
