"""Parts, mates, limits and axes as SVG paths, each in the style of its role.

The styles differ in line and tone, not in colour alone: they are told apart in a grey print too.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.export.svg_text import Attributes, Point, element, number
from springcad.geometry.biarc import fit_contour
from springcad.geometry.outline import Contour, Profile
from springcad.geometry.outline_ops import contour_bounds
from springcad.geometry.polyline import BulgePolyline, radii
from springcad.result import Shape

Floats = NDArray[np.float64]

INK = "#111111"
_NEARLY_STRAIGHT = 1e5  # mm
_STYLES: dict[str, Attributes] = {
    "part": {"fill": "#e3e9ef", "stroke": INK, "stroke-width": 0.1},
    "mate": {"fill": "#f6f6f6", "stroke": "#6b6b6b", "stroke-width": 0.13},
    "moved": {
        "fill": "none",
        "stroke": "#444444",
        "stroke-width": 0.1,
        "stroke-dasharray": "1.4 0.7",
    },
    "limit": {
        "fill": "none",
        "stroke": "#9c4a2f",
        "stroke-width": 0.16,
        "stroke-dasharray": "3 0.8 0.5 0.8",
    },
    "axis": {
        "fill": "none",
        "stroke": "#7a7a7a",
        "stroke-width": 0.09,
        "stroke-dasharray": "4 0.8 0.6 0.8",
    },
}


def shape_path(shape: Shape, origin: Point, tolerance: float) -> str:
    """The path of a shape; ``origin`` is where its frame lies on the sheet (mm).

    ``tolerance``: within which arcs follow its curves (m).
    """
    style = _STYLES[shape.role]
    if isinstance(shape.line, np.ndarray):
        style = {**style, "fill": "none"}
        data = _open_data(shape.line, origin)
    else:
        data = " ".join(_contour_data(each, origin, tolerance) for each in _contours(shape.line))
    written: Attributes = {"d": data, "fill": style["fill"], "fill-rule": "evenodd"}
    return element("path", {**written, **style, "stroke-linejoin": "round"})


def shape_bounds(shape: Shape) -> tuple[float, float, float, float]:
    """Smallest x, smallest y, largest x, largest y (m)."""
    if isinstance(shape.line, np.ndarray):
        (x0, y0), (x1, y1) = shape.line.min(axis=0), shape.line.max(axis=0)
        return float(x0), float(y0), float(x1), float(y1)
    return contour_bounds(_contours(shape.line)[0])


def _contours(line: Contour | Profile) -> tuple[Contour, ...]:
    """All contours, the outer one first."""
    return (line.outer, *line.inner) if isinstance(line, Profile) else (line,)


def _open_data(points: Floats, origin: Point) -> str:
    x, y = origin[0] + 1e3 * points[:, 0], origin[1] - 1e3 * points[:, 1]
    return "M" + "L".join(f"{number(a)} {number(b)}" for a, b in zip(x, y, strict=True))


def _contour_data(contour: Contour, origin: Point, tolerance: float) -> str:
    """Path data with true arcs."""
    polyline = fit_contour(contour, tolerance)
    x = origin[0] + 1e3 * polyline.points[:, 0]
    y = origin[1] - 1e3 * polyline.points[:, 1]
    return f"M{number(x[0])} {number(y[0])}{_segments_data(polyline, x, y)}Z"


def _segments_data(polyline: BulgePolyline, x: Floats, y: Floats) -> str:
    written = []
    for i, (bulge, radius) in enumerate(zip(polyline.bulges, radii(polyline) * 1e3, strict=True)):
        end = (i + 1) % len(x)
        to = f"{number(x[end])} {number(y[end])}"
        if bulge == 0.0 or radius > _NEARLY_STRAIGHT:
            written.append(f"L{to}")
        else:
            # The sheet has y downwards: a turn to the left is against SVG's positive sense.
            r = number(radius)
            written.append(f"A{r} {r} 0 0 {0 if bulge > 0.0 else 1} {to}")
    return "".join(written)
