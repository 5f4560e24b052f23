"""A part as a DXF drawing that a cutting shop takes without repair.

DXF R2010 (AC1024) in millimetres. Every contour is one closed LWPOLYLINE whose arcs are bulges, a
full circle is a CIRCLE; the outer contour lies on layer ``CUT_OUTER``, the inner ones on
``CUT_INNER``. Same part, same bytes: the metadata is fixed, coordinates are rounded to 1e-6 mm
and bulges to 1e-9, nothing depends on the clock, the locale or an ``ezdxf.ini``.
"""

from __future__ import annotations

import configparser
import io
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

import numpy as np

from springcad.errors import SpringcadError
from springcad.geometry.biarc import fit_contour
from springcad.geometry.outline import Circle, Contour, Floats
from springcad.geometry.outline_ops import contour_bounds
from springcad.geometry.polyline import BulgePolyline, signed_area, turned_round
from springcad.result import Part

OUTER_LAYER = "CUT_OUTER"
INNER_LAYER = "CUT_INNER"
_LAYER_COLORS = {OUTER_LAYER: 1, INNER_LAYER: 5}  # red and blue of the AutoCAD colour index

COORDINATE_DIGITS = 6  # of a millimetre
BULGE_DIGITS = 9
_SHORTEST = 1.5e-6  # mm: two vertices nearer than this differ by rounding only


def part_file(name: str, suffix: str) -> str:
    """Name of the drawing of a part of the design ``name``."""
    return f"{name}-{suffix}.dxf" if suffix else f"{name}.dxf"


def part_to_dxf(part: Part) -> str:
    """The text of the drawing; curves become G1 biarcs within the part's tolerance.

    Raises ValueError for a coordinate that is not finite or an outline that is open.
    """
    with _fixed_metadata() as ezdxf:
        document = ezdxf.new("R2010", units=ezdxf.units.MM)
        document.header["$MEASUREMENT"] = 1
        document.layers.remove("Defpoints")
        for name, color in _LAYER_COLORS.items():
            document.layers.add(name, color=color)
        modelspace = document.modelspace()
        _add_contour(modelspace, part.profile.outer, OUTER_LAYER, 1.0, part.tolerance)
        for contour in part.profile.inner:
            _add_contour(modelspace, contour, INNER_LAYER, -1.0, part.tolerance)
        x0, y0, x1, y1 = _rounded(np.array(contour_bounds(part.profile.outer)) * 1e3)
        modelspace.reset_extents((x0, y0, 0.0), (x1, y1, 0.0))
        # ezdxf would register these in the order of a set, which changes with the hash seed
        for name in sorted(document.entitydb.dxf_types_in_use()):
            document.classes.add_class(name)
        stream = io.StringIO()
        document.write(stream)
    return stream.getvalue()


@contextmanager
def _fixed_metadata() -> Iterator[ModuleType]:
    """ezdxf without dates and random identifiers in what it writes."""
    try:
        import ezdxf
        from ezdxf._options import options
    except configparser.Error as error:
        raise SpringcadError(f"ezdxf.ini cannot be read: {error}") from error
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield ezdxf
    finally:
        options.write_fixed_meta_data_for_testing = before


def _add_contour(
    modelspace: Any, contour: Contour, layer: str, side: float, tolerance: float
) -> None:
    """``side`` 1 writes a polyline counter-clockwise, -1 clockwise."""
    if isinstance(contour, Circle):
        x, y, radius = _rounded(np.array([*contour.center, contour.radius]) * 1e3)
        modelspace.add_circle((x, y), radius, dxfattribs={"layer": layer})
        return
    polyline = fit_contour(contour, tolerance)
    if side * signed_area(polyline) < 0.0:
        polyline = turned_round(polyline)
    vertices = drawing_vertices(polyline)
    modelspace.add_lwpolyline(vertices, format="xyb", close=True, dxfattribs={"layer": layer})


def drawing_vertices(polyline: BulgePolyline) -> list[tuple[float, float, float]]:
    """x, y (mm) and bulge of each vertex as they stand in drawings, rounded, no two alike.

    Raises ValueError for a number that is not finite.
    """
    points = polyline.points * 1e3
    step = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    keep = step > _SHORTEST
    xy, bulges = _rounded(points[keep]), _rounded(polyline.bulges[keep], BULGE_DIGITS)
    return [(float(x), float(y), float(bulge)) for (x, y), bulge in zip(xy, bulges, strict=True)]


def _rounded(values: Floats, digits: int = COORDINATE_DIGITS) -> Floats:
    if not np.isfinite(values).all():
        raise ValueError("a coordinate of the drawing is not a finite number")
    return np.round(values, digits) + 0.0  # turns -0.0 into 0.0
