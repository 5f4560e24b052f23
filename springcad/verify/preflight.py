"""Re-read a drawing and hold it to what cutting needs: closed, simple, nested, wide enough."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
import shapely

from springcad.geometry.clearance import Width, narrowest, tightest
from springcad.geometry.outline import Floats
from springcad.geometry.polyline import BulgePolyline, flatten, signed_area, turned_round
from springcad.result import Check, check
from springcad.verify.drawing import JOIN_TOLERANCE, Drawing, DrawnContour, read_drawing

if TYPE_CHECKING:
    from springcad.materials.process import Process

_CHORD = 2e-7  # m: contours are compared as polygons within this distance
_DIGITS = 8  # of a metre: widths are exact to about the rounding of the drawing's coordinates
_SOURCE = "the file, read again"

OUTER = "CUT_OUTER"
INNER = "CUT_INNER"


@dataclass(frozen=True)
class _Nesting:
    """How contours lie: which cut themselves, how many pairs meet, how many enclose each."""

    crossed: list[int]
    meeting: int
    depths: list[int]


def preflight(path: Path, process: Process | None = None) -> tuple[Check, ...]:
    """Checks of any DXF; raises ``DrawingError`` for a file that is no readable drawing."""
    return drawing_checks(read_drawing(path), process)


def drawing_checks(drawing: Drawing, process: Process | None = None) -> tuple[Check, ...]:
    """Checks of a drawing; widths are held against ``process`` if one is given."""
    nesting = _nesting([contour.polyline for contour in drawing.contours])
    checks = [*_file_checks(drawing), *_contour_checks(drawing, nesting)]
    if drawing.contours and not nesting.crossed and not nesting.meeting:
        sides = _material_sides(drawing.contours, nesting.depths)
        checks.extend(_width_checks(sides, process))
    return tuple(checks)


def _none_of(
    name: str,
    count: int,
    remedy: str,
    *,
    source: str = _SOURCE,
    otherwise: Literal["warn", "fail"] = "fail",
) -> Check:
    return check(
        name, float(count), "<=", 0.0, "1", source=source, remedy=remedy, otherwise=otherwise
    )


def _file_checks(drawing: Drawing) -> Iterator[Check]:
    yield _none_of(
        "errors in the file structure",
        drawing.structure_errors,
        "save the drawing again as DXF R2010",
        source="audit of ezdxf",
    )
    scale = f"1 drawing unit = {drawing.metres * 1e3:g} mm"
    yield check(
        "length unit stated",
        float(bool(drawing.unit)),
        ">=",
        1.0,
        "1",
        source=f"$INSUNITS: {drawing.unit}, {scale}" if drawing.unit else f"none; {scale} assumed",
        remedy="set the unit of the drawing to millimetres or inches",
    )
    strays = ", ".join(f"{count} {kind}" for kind, count in sorted(drawing.strays.items()))
    yield _none_of(
        "entities that are no contour",
        sum(drawing.strays.values()),
        f"remove them or make them polylines: {strays}",
    )


def _contour_checks(drawing: Drawing, nesting: _Nesting) -> Iterator[Check]:
    contours, ends = drawing.contours, drawing.open_ends
    yield _none_of("open ends", len(ends), f"close the contour {_place(ends)}")
    joined = [contour for contour in contours if contour.joined_from > 1]
    yield _none_of(
        "contours joined from separate entities",
        len(joined),
        f"make them polylines; ends up to {drawing.widest_join * 1e6:.2g} um apart were joined",
        source=f"{_SOURCE}; ends within {JOIN_TOLERANCE * 1e6:g} um count as one point",
        otherwise="warn",
    )
    crossed = [contours[i].polyline.points for i in nesting.crossed]
    yield _none_of(
        "contours that cut themselves",
        len(crossed),
        f"untangle the contour {_place(crossed[0] if crossed else ends)}",
    )
    yield _none_of(
        "pairs of contours that meet, cross or repeat",
        nesting.meeting,
        "remove repeated contours; keep inner contours clear of the outer one",
    )
    wrong = sum(
        contour.layer == (INNER if depth % 2 == 0 else OUTER)
        for contour, depth in zip(contours, nesting.depths, strict=True)
    )
    yield _none_of(
        "contours on the wrong layer",
        wrong,
        f"{OUTER} holds outer contours, {INNER} those inside an outer one",
    )
    parts = sum(depth % 2 == 0 for depth in nesting.depths)
    yield check(
        "parts in the drawing", float(parts), ">=", 1.0, "1", source=_SOURCE, remedy="draw a part"
    )


def _width_checks(sides: list[BulgePolyline], process: Process | None) -> Iterator[Check]:
    """Web, gap and inside radius of all contours, which run with the material on the left."""
    rule = (
        f"rays along the normals; rule of {process.name}" if process else "measured; no rule given"
    )
    web = narrowest(sides)
    gap = narrowest([turned_round(side) for side in sides])
    if web:
        limit = process.min_web if process else 0.0
        yield _wide_enough("smallest web", web.distance, limit, rule, _at(web))
    if gap:
        limit = process.min_gap if process else 0.0
        yield _wide_enough("smallest gap", gap.distance, limit, rule, _at(gap))
    radius = tightest(sides)
    if np.isfinite(radius):
        limit = process.min_inside_radius if process else 0.0
        yield _wide_enough("smallest inside radius", radius, limit, rule, "round inside corners")


def _wide_enough(name: str, value: float, limit: float, source: str, remedy: str) -> Check:
    value, limit = round(value, _DIGITS), round(limit, _DIGITS)
    return check(name, value, ">=", limit, "m", source=source, remedy=remedy)


def _at(width: Width) -> str:
    return f"widen it {_place(np.array([width.start]))}"


def _place(points: Floats) -> str:
    """Where the first of the points lies, for people."""
    if not len(points):
        return ""
    x, y = points[0] * 1e3
    return f"near x = {x:.3f} mm, y = {y:.3f} mm"


def _nesting(polylines: list[BulgePolyline]) -> _Nesting:
    rings = [shapely.LinearRing(flatten(polyline, _CHORD)) for polyline in polylines]
    crossed = [i for i, ring in enumerate(rings) if not ring.is_simple]
    polygons = np.array([shapely.Polygon(ring) for ring in rings], dtype=object)
    shapely.prepare(polygons)
    depths, meeting = [0] * len(polygons), 0
    sound = np.setdiff1d(np.arange(len(polygons)), crossed)
    pairs = shapely.STRtree(polygons[sound]).query(polygons[sound], predicate="intersects")
    for first, second in sound[pairs.T]:
        if first == second:
            continue
        if shapely.contains_properly(polygons[first], polygons[second]):
            depths[second] += 1
        elif first < second and not shapely.contains_properly(polygons[second], polygons[first]):
            meeting += 1
    return _Nesting(crossed, meeting, depths)


def _material_sides(contours: tuple[DrawnContour, ...], depths: list[int]) -> list[BulgePolyline]:
    """The contours run through with the material on the left; odd depths are holes."""
    sides = []
    for contour, depth in zip(contours, depths, strict=True):
        hole = -1.0 if depth % 2 else 1.0
        wrong = hole * signed_area(contour.polyline) < 0.0
        sides.append(turned_round(contour.polyline) if wrong else contour.polyline)
    return sides
