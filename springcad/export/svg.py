"""A finished design as one drawing: every part at true size (mm), side by side, with dimensions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from springcad.export.dxf import part_file
from springcad.export.svg_dimensions import Callouts, arrange, draw
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
from springcad.geometry.biarc import fit_contour
from springcad.geometry.outline import Contour, Floats
from springcad.geometry.outline_ops import contour_bounds
from springcad.geometry.polyline import BulgePolyline, radii
from springcad.result import Part, Result

_MARGIN = 8.0
_BETWEEN = 12.0  # mm between the cells of two parts
_HEADER = 12.0
_CAPTION = 12.0
_FOOTER = 5.0
_TITLE_SIZE, _ROLE_SIZE, _SMALL_SIZE = 4.2, 3.0, 2.4
_INK, _GREY, _MATERIAL = "#111111", "#555555", "#e3e9ef"
_CUT_WIDTH = 0.1


@dataclass(frozen=True)
class _Cell:
    """One part and the room that it takes on the sheet, all in mm."""

    part: Part
    bounds: tuple[float, float, float, float]
    callouts: Callouts
    width: float
    height: float


def result_to_svg(result: Result) -> str:
    """The drawing as SVG text; width and height are the true size in millimetres."""
    cells = [_cell(part, result.name) for part in result.parts]
    tallest = max((cell.height for cell in cells), default=0.0)
    wide = sum(cell.width for cell in cells) + _BETWEEN * max(len(cells) - 1, 0)
    title_width = max(text_width(result.name, _TITLE_SIZE), 100.0)
    width = max(wide, title_width) + 2.0 * _MARGIN
    height = 2.0 * _MARGIN + _HEADER + tallest + _CAPTION + _FOOTER
    drawn = [
        element("rect", {"width": width, "height": height, "fill": "#ffffff"}),
        *_frame(result, width, height),
    ]
    x = 0.5 * (width - wide)
    for cell in cells:
        drawn.append(_part_group(cell, (x, _MARGIN + _HEADER), tallest, result.name))
        x += cell.width + _BETWEEN
    content = "\n".join([f"<title>{clean(result.name)}</title>", *drawn])
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" version="1.1" width="{number(width)}mm" '
        f'height="{number(height)}mm" viewBox="0 0 {number(width)} {number(height)}" role="img">\n'
        f"{content}\n</svg>\n"
    )


def _cell(part: Part, name: str) -> _Cell:
    bounds = np.array(contour_bounds(part.profile.outer)) * 1e3
    x0, y0, x1, y1 = (float(value) for value in bounds)
    callouts = arrange(part.dimensions, 0.5e-3 * (x0 + x1))
    drawing = callouts.left_width + (x1 - x0) + callouts.right_width
    captions = max(text_width(line, _ROLE_SIZE) for line in _captions(part, name))
    height = max(y1 - y0 + 6.0, callouts.height + 4.0)
    return _Cell(part, (x0, y0, x1, y1), callouts, max(drawing, captions), height)


def _captions(part: Part, name: str) -> tuple[str, str]:
    file = part_file(name, part.suffix)
    return part.role, f"{number(part.thickness * 1e3)} mm {part.material}, {file}"


def _part_group(cell: _Cell, corner: Point, tallest: float, name: str) -> str:
    """The part in the middle of its cell, its callouts beside it and its captions below."""
    x0, y0, x1, y1 = cell.bounds
    callouts = cell.callouts
    drawing = callouts.left_width + (x1 - x0) + callouts.right_width
    left = corner[0] + 0.5 * (cell.width - drawing) + callouts.left_width
    top = corner[1] + 0.5 * (tallest - (y1 - y0))
    origin = (left - x0, top + y1)
    role, details = _captions(cell.part, name)
    middle, below = left + 0.5 * (x1 - x0), corner[1] + tallest + 5.0
    profile = cell.part.profile
    contours, tolerance = (profile.outer, *profile.inner), cell.part.tolerance
    data = " ".join(_contour_data(contour, origin, tolerance) for contour in contours)
    shape: Attributes = {
        "d": data,
        "fill": _MATERIAL,
        "fill-rule": "evenodd",
        "stroke": _INK,
        "stroke-width": _CUT_WIDTH,
        "stroke-linejoin": "round",
    }
    content = [
        f"<title>{clean(role)}</title>",
        element("path", shape),
        *draw(callouts, origin, (left, top, left + (x1 - x0), top + (y1 - y0))),
        text_line((middle, below), role, _ROLE_SIZE, anchor="middle", color=_INK, weight="bold"),
        text_line((middle, below + 4.0), details, _SMALL_SIZE, anchor="middle", color=_GREY),
    ]
    return element("g", {}, "\n" + "\n".join(content) + "\n")


def _contour_data(contour: Contour, origin: Point, tolerance: float) -> str:
    """Path data with true arcs; ``origin`` is where the part's frame lies on the sheet (mm)."""
    polyline = fit_contour(contour, tolerance)
    x = origin[0] + 1e3 * polyline.points[:, 0]
    y = origin[1] - 1e3 * polyline.points[:, 1]
    return f"M{number(x[0])} {number(y[0])}{_segments_data(polyline, x, y)}Z"


def _segments_data(polyline: BulgePolyline, x: Floats, y: Floats) -> str:
    written = []
    for i, (bulge, radius) in enumerate(zip(polyline.bulges, radii(polyline) * 1e3, strict=True)):
        end = (i + 1) % len(x)
        to = f"{number(x[end])} {number(y[end])}"
        if bulge == 0.0 or radius > 1e5:
            written.append(f"L{to}")
        else:
            # The sheet has y downwards: a turn to the left is against SVG's positive sense.
            r = number(radius)
            written.append(f"A{r} {r} 0 0 {0 if bulge > 0.0 else 1} {to}")
    return "".join(written)


def _frame(result: Result, width: float, height: float) -> list[str]:
    """Border, title above, scale bar and remarks below."""
    inset = 0.5 * _MARGIN
    border: Attributes = {
        "x": inset,
        "y": inset,
        "width": width - _MARGIN,
        "height": height - _MARGIN,
        "fill": "none",
        "stroke": _INK,
        "stroke-width": 0.25,
    }
    rule = _MARGIN + _HEADER - 3.5
    foot = height - _MARGIN - _FOOTER - 1.0
    title = (_MARGIN, _MARGIN + 4.5)
    return [
        element("rect", border),
        text_line(title, result.name, _TITLE_SIZE, color=_INK, weight="bold"),
        text_line((width - _MARGIN, title[1]), result.kind, _ROLE_SIZE, anchor="end", color=_GREY),
        stroke_path(((inset, rule), (width - inset, rule)), _INK, 0.18),
        stroke_path(((inset, foot), (width - inset, foot)), _INK, 0.18),
        *_scale_bar((_MARGIN, foot + 4.0)),
        text_line(
            (width - _MARGIN, foot + 5.2),
            "dimensions in mm, scale 1:1",
            _SMALL_SIZE,
            anchor="end",
            color=_GREY,
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
                "fill": _INK if i % 2 == 0 else "#ffffff",
                "stroke": _INK,
                "stroke-width": 0.12,
            },
        )
        for i in range(4)
    ]
    return [*steps, text_line((x + 21.5, y + 1.4), "20 mm", _SMALL_SIZE, color=_GREY)]
