"""A DXF drawing from anywhere, read as closed contours: what a cutting shop's software would see.

Polylines with bulges, circles, lines, arcs, ellipses and splines of the model space are read.
Loose ends that meet within ``JOIN_TOLERANCE`` are joined. Everything else is counted, not guessed.
"""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from springcad.errors import SpringcadError
from springcad.geometry.outline import Floats
from springcad.geometry.polyline import BulgePolyline

JOIN_TOLERANCE = 1e-5
"""Ends of lines and arcs within this distance (m) are taken to be one point."""

LARGEST_FILE = 8 * 2**20
MOST_CONTOURS = 2000

_UNITS = {1: ("inches", 25.4e-3), 4: ("millimetres", 1e-3)}
_FLATTENING = 1e-7  # m: ellipses and splines are read as chords within this distance
_FARTHEST = 100.0  # m: no coordinate of a part is farther out
_STRAIGHT = 1e-10  # m: an arc that rises less above its chord is a line
_SAME = 1e-9  # m: neighbouring vertices nearer than this are one


class DrawingError(SpringcadError):
    """The file is not a drawing that can be read."""

    exit_code = 3


@dataclass(frozen=True)
class DrawnContour:
    """One closed contour (m), its layer, and the number of entities that it was joined from."""

    polyline: BulgePolyline
    layer: str
    joined_from: int


@dataclass(frozen=True)
class Drawing:
    """What a DXF holds, in metres.

    Attributes:
        unit: what the drawing says its unit is; empty if it says nothing or nothing usable.
        metres: length of one drawing unit (that of a millimetre if none is stated).
        contours: every closed contour.
        open_ends: where lines end that nothing continues, (N, 2).
        widest_join: largest distance bridged where two ends were joined.
        strays: how many entities of each type are no contour.
        structure_errors: errors that the audit of the file structure found.
    """

    unit: str
    metres: float
    contours: tuple[DrawnContour, ...]
    open_ends: Floats
    widest_join: float
    strays: dict[str, int]
    structure_errors: int

    @property
    def polylines(self) -> tuple[BulgePolyline, ...]:
        """The contours as lines and arcs."""
        return tuple(contour.polyline for contour in self.contours)


@dataclass(frozen=True)
class _Path:
    """An entity as vertices (N + 1, 2) and bulges (N,); closed if the last vertex is the first."""

    points: Floats
    bulges: Floats
    layer: str

    def backwards(self) -> _Path:
        return _Path(self.points[::-1], -self.bulges[::-1], self.layer)


def read_drawing(path: Path) -> Drawing:
    """Read any DXF; raises DrawingError for what is no readable drawing."""
    document = _document(path)
    unit, metres = _UNITS.get(document.header.get("$INSUNITS", 0), ("", 1e-3))
    paths: list[_Path] = []
    strays: Counter[str] = Counter()
    for entity in document.modelspace():
        read = _entity_path(entity, metres)
        if read is None:
            strays[entity.dxftype()] += 1
        else:
            paths.append(read)
    closed = [path for path in paths if _is_closed(path)]
    loose = [path for path in paths if not _is_closed(path)]
    joined, open_ends, widest = _joined(loose)
    contours = [_contour([path]) for path in closed] + [_contour(chain) for chain in joined]
    if len(contours) > MOST_CONTOURS:
        raise DrawingError(f"{len(contours)} contours; at most {MOST_CONTOURS} are checked")
    errors = len(document.audit().errors)
    sound = tuple(contour for contour in contours if contour is not None)
    strays["degenerate contour"] += len(contours) - len(sound)
    return Drawing(unit, metres, sound, open_ends, widest, dict(+strays), errors)


def _document(path: Path) -> Any:
    if not path.is_file():
        raise DrawingError("there is no such file" if not path.exists() else "not a plain file")
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise DrawingError(f"cannot be read: {error.strerror}") from error
    if len(data) > LARGEST_FILE:
        raise DrawingError(f"larger than {LARGEST_FILE // 2**20} MiB; not read")
    if b"\0" in data:
        raise DrawingError("binary, not a text DXF; save it as ASCII DXF R2010")
    text = data.decode("utf-8", errors="replace").replace("\r\n", "\n")
    try:
        from ezdxf.filemanagement import read

        return read(io.StringIO(text))
    # ezdxf meets damaged files with errors of every type, from KeyError to RecursionError.
    except Exception as error:
        reason = " ".join(str(error).split())[:200] or type(error).__name__
        raise DrawingError(f"not a readable DXF: {reason}") from error


def _entity_path(entity: Any, metres: float) -> _Path | None:
    """The entity in metres, or None if it is no curve in the plane of the drawing."""
    try:
        read = _READERS.get(entity.dxftype(), lambda _: None)(entity)
        if read is None:
            return None
        points, bulges = read
        if entity.dxf.get("extrusion", (0.0, 0.0, 1.0))[2] < 0.0 and entity.dxftype() in _OCS:
            points, bulges = points * [-1.0, 1.0], -bulges
    # A hostile entity (a spline without knots, an ellipse of axis zero) fails anywhere in ezdxf.
    except Exception:
        return None
    points = points * metres
    if not (np.isfinite(bulges).all() and np.max(np.abs(points), initial=0.0) < _FARTHEST):
        return None
    return _tidy(_Path(points, bulges, str(entity.dxf.layer)))


def _polyline_vertices(entity: Any) -> tuple[Floats, Floats]:
    if entity.dxftype() == "LWPOLYLINE":
        vertices, closed = entity.get_points("xyb"), entity.closed
    elif entity.is_2d_polyline:
        vertices, closed = [_old_vertex(v) for v in entity.vertices], entity.is_closed
    else:
        raise ValueError("not a plane polyline")
    table = np.array(vertices, dtype=np.float64).reshape(-1, 3)
    if closed:
        return np.vstack((table[:, :2], table[:1, :2])), table[:, 2]
    return table[:, :2], table[:-1, 2]


def _old_vertex(vertex: Any) -> tuple[float, float, float]:
    place = vertex.dxf.location
    return place.x, place.y, vertex.dxf.get("bulge", 0.0)


def _line_vertices(entity: Any) -> tuple[Floats, Floats]:
    start, end = entity.dxf.start, entity.dxf.end
    if start.z != end.z:
        raise ValueError("not in the plane")
    return np.array([start.vec2, end.vec2], dtype=np.float64), np.zeros(1)


def _arc_vertices(entity: Any) -> tuple[Floats, Floats]:
    begin = np.radians(entity.dxf.start_angle)
    sweep = np.radians(entity.dxf.end_angle) - begin
    return _round_vertices(entity, begin, (sweep % (2.0 * np.pi)) or 2.0 * np.pi)


def _circle_vertices(entity: Any) -> tuple[Floats, Floats]:
    return _round_vertices(entity, 0.0, 2.0 * np.pi)


def _round_vertices(entity: Any, begin: float, sweep: float) -> tuple[Floats, Floats]:
    angles = begin + np.array([0.0, 0.5, 1.0]) * sweep
    center = np.array([entity.dxf.center.x, entity.dxf.center.y])
    points = center + entity.dxf.radius * np.column_stack((np.cos(angles), np.sin(angles)))
    return points, np.full(2, np.tan(0.125 * sweep))


def _flattened_vertices(entity: Any) -> tuple[Floats, Floats]:
    size = np.array([*entity.dxf.major_axis] if entity.dxftype() == "ELLIPSE" else [0.0])
    reach = [size, *map(np.asarray, getattr(entity, "control_points", ()))]
    if max(float(np.max(np.abs(values), initial=0.0)) for values in reach) > _FARTHEST / 1e-3:
        raise ValueError("too large")
    points = np.array([p.vec2 for p in entity.flattening(_FLATTENING / 1e-3)], dtype=np.float64)
    return points, np.zeros(len(points) - 1)


_READERS: dict[str, Any] = {
    "LWPOLYLINE": _polyline_vertices,
    "POLYLINE": _polyline_vertices,
    "LINE": _line_vertices,
    "ARC": _arc_vertices,
    "CIRCLE": _circle_vertices,
    "ELLIPSE": _flattened_vertices,
    "SPLINE": _flattened_vertices,
}
_OCS = ("LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE")
"""Entities whose coordinates are mirrored in x where their extrusion points down."""


def _tidy(path: _Path) -> _Path | None:
    """Without vertices that repeat the one before; None if nothing is left."""
    chords = np.hypot(*np.diff(path.points, axis=0).T)
    keep = chords > _SAME
    if not np.any(keep):
        return None
    bulges = np.where(np.abs(path.bulges) * chords < 2.0 * _STRAIGHT, 0.0, path.bulges)
    points = np.vstack((path.points[:-1][keep], path.points[-1:]))
    return _Path(points, bulges[keep], path.layer)


def _is_closed(path: _Path) -> bool:
    return len(path.bulges) > 1 and _gap(path.points[0], path.points[-1]) <= _SAME


def _gap(first: Floats, second: Floats) -> float:
    return float(np.hypot(*(second - first)))


def _joined(paths: list[_Path]) -> tuple[list[list[_Path]], Floats, float]:
    """Closed chains of paths, the ends that nothing continues, and the widest gap bridged."""
    if not paths:
        return [], np.empty((0, 2)), 0.0
    ends = np.array([path.points[side] for path in paths for side in (0, -1)])
    partner = _partners(ends)
    chains: list[list[_Path]] = []
    loose = list(np.flatnonzero(partner < 0))
    done: set[int] = set()
    for end in loose:
        done.update(index for index, _ in _walk(int(end), partner))
    widest = 0.0
    for index in range(len(paths)):
        if index in done:
            continue
        steps = list(_walk(2 * index, partner))
        done.update(step for step, _ in steps)
        chain = [paths[i].backwards() if reverse else paths[i] for i, reverse in steps]
        following = chain[1:] + chain[:1]
        widest = max(
            widest,
            *(_gap(a.points[-1], b.points[0]) for a, b in zip(chain, following, strict=True)),
        )
        chains.append(chain)
    return chains, ends[loose], widest


def _partners(ends: Floats) -> np.ndarray[Any, np.dtype[np.intp]]:
    """For each end (2 i is the start of path i, 2 i + 1 its end) the one that it meets, or -1.

    Where three or more ends meet there is no telling which belong together: all of them are open.
    """
    tree = cKDTree(ends)
    _, near = tree.query(ends, k=[1, 2, 3], distance_upper_bound=JOIN_TOLERANCE)
    partner = np.full(len(ends), -1, dtype=np.intp)
    for i, row in enumerate(np.asarray(near)):
        others = [int(j) for j in row if j < len(ends) and j != i]
        if len(others) == 1:
            partner[i] = others[0]
    mutual = (partner >= 0) & (partner[partner] == np.arange(len(ends)))
    return np.where(mutual, partner, -1)


def _walk(end: int, partner: np.ndarray[Any, np.dtype[np.intp]]) -> Iterator[tuple[int, bool]]:
    """Paths from an end on, with whether each is run through backwards, until open or round."""
    first = end // 2
    while True:
        yield end // 2, bool(end % 2)
        end = int(partner[end ^ 1])
        if end < 0 or end // 2 == first:
            return


def _contour(chain: list[_Path]) -> DrawnContour | None:
    """The chain as one contour; None if it encloses nothing."""
    points = np.concatenate([path.points[:-1] for path in chain])
    bulges = np.concatenate([path.bulges for path in chain])
    if len(points) < 2 or (len(points) == 2 and not np.any(bulges)):
        return None
    return DrawnContour(BulgePolyline(points, bulges), chain[0].layer, len(chain))
