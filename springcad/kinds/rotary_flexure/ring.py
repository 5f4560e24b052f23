"""The flexure ring as a part: n ribbons with noses and root fillets, the rim and its mounting.

Global frame: centre of the ring at the origin; flexure 0 lies on the positive x axis. A flexure's
own frame has its origin at the root and x inward, so its point (x, y) lies at (R - x, -y).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from springcad.errors import InfeasibleError
from springcad.geometry.biarc import fit_curve
from springcad.geometry.outline import Arc, Circle, Contour, Curve, Line, Outline, Piece, Profile
from springcad.geometry.ribbon import Ribbon
from springcad.geometry.transform import backwards, rotate, translate

Floats = NDArray[np.float64]

EDGE_POINTS = 500
"""Points along one edge of a flexure, to which arcs are fitted."""
FIT_TOLERANCE = 1e-6
"""Largest deviation of the part's arcs from the edges of the designed ribbon, m."""
ROUND_OFF = 1e-9
"""Stations closer than this are one, m."""
SMOOTH = 1e-9
"""Turns smaller than this are none, rad."""
FILLET_STEP = 1e-5
"""Fillet radii are multiples of this, m."""
RIM_LAND = 0.02
"""Share of the pitch at the root that stays a plain arc of the rim between two fillets."""


@dataclass(frozen=True)
class Dowels:
    """Semicircular cut-outs around the rim for the dowel pins of the housing, SI."""

    count: int
    radius: float


@dataclass(frozen=True)
class Fillet:
    """Root fillet on one edge: where it leaves the edge and meets the rim, flexure frame, m.

    ``station`` is negative where the edge had to go on straight beyond the root to meet it.
    """

    station: float
    arc: Arc


def root_fillet(ribbon: Ribbon, root_radius: float, radius: float, side: int) -> Fillet:
    """The arc of ``radius`` tangent to the left (+1) or right (-1) edge and to the rim's circle.

    Raises:
        ValueError: there is no such arc (``largest_fillet`` finds radii for which there is one).
    """
    fillet = _tangent_fillet(ribbon, root_radius, radius, side)
    if fillet is None:
        raise ValueError(f"no root fillet of {radius} m touches both the rim and the flexure")
    return fillet


def _tangent_fillet(ribbon: Ribbon, root_radius: float, radius: float, side: int) -> Fillet | None:
    """The same; None where the edge turns along the rim, or away before the arc reaches it."""

    def centres(stations: Floats) -> tuple[Floats, Floats]:
        """Centres of circles on the free side of the edge, and where they touch it."""
        points, tangents = edge_points(ribbon, stations, side)
        return points + side * radius * np.column_stack([-tangents[:, 1], tangents[:, 0]]), points

    def outside(stations: Floats) -> Floats:
        middle, _ = centres(stations)
        return np.hypot(middle[:, 0] - root_radius, middle[:, 1]) - (root_radius - radius)

    half = float(ribbon.half_thickness[0])
    reach = np.linspace(-4.0 * (half + radius), 0.5 * ribbon.length, 200)
    within = outside(reach) < 0.0
    if within[0] or not within.any():
        return None
    first = int(np.argmax(within))
    low, high = float(reach[first - 1]), float(reach[first])
    station = float(brentq(lambda s: float(outside(np.array([s]))[0]), low, high, xtol=1e-13))
    (middle,), (point,) = centres(np.array([station]))
    rim_angle = math.atan2(middle[1], middle[0] - root_radius)
    edge_angle = math.atan2(point[1] - middle[1], point[0] - middle[0])
    start, end = (rim_angle, edge_angle) if side > 0 else (edge_angle, rim_angle)
    sweep = (end - start) % (2.0 * math.pi)
    return Fillet(station, Arc((float(middle[0]), float(middle[1])), radius, start, sweep))


def edge_points(ribbon: Ribbon, stations: Floats, side: int) -> tuple[Floats, Floats]:
    """Points and unit tangents (root to tip) of an edge; straight on before the root."""
    edge = ribbon.boundary(np.maximum(stations, 0.0))[0 if side > 0 else 1]
    before = np.minimum(stations, 0.0)[:, None]
    return edge.points + before * edge.tangents, edge.tangents


def largest_fillet(
    ribbon: Ribbon, root_radius: float, count: int, smallest: float, largest: float
) -> float:
    """The largest root fillet up to ``largest`` that leaves a land of the rim between neighbours.

    Raises:
        InfeasibleError: not even ``smallest`` fits.
    """

    def fits(radius: float) -> bool:
        left, right = (_tangent_fillet(ribbon, root_radius, radius, side) for side in (1, -1))
        if left is None or right is None:
            return False
        width = _rim_angle(left, root_radius) - _rim_angle(right, root_radius)
        return width <= (1.0 - RIM_LAND) * 2.0 * math.pi / count

    if fits(largest):
        return largest
    low, high = 0, math.ceil(largest / FILLET_STEP)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if fits(middle * FILLET_STEP) else (low, middle)
    found = low * FILLET_STEP
    if found >= smallest:
        return found
    if fits(smallest):
        return smallest
    claim = "root fillet that fits between neighbours, against the process"
    raise InfeasibleError(claim, found, smallest, "m")


def flexure_pieces(
    ribbon: Ribbon, root_radius: float, fillet: float, blend: float
) -> tuple[Piece, ...]:
    """Rim, left edge, nose, right edge, rim: one flexure with its fillets, in its own frame.

    ``blend`` is the radius in the hollow corner where the taper meets the straight pad, at least.

    Raises:
        ValueError: there is no root fillet of that radius.
    """
    (left, upwards), (right, downwards) = (
        flexure_side(ribbon, root_radius, fillet, blend, side) for side in (1, -1)
    )
    return (left.arc, *upwards, nose_arc(ribbon), *backwards(downwards), right.arc)


def flexure_side(
    ribbon: Ribbon, root_radius: float, fillet: float, blend: float, side: int
) -> tuple[Fillet, tuple[Line | Arc, ...]]:
    """The root fillet of a side, and the edge as it is cut from there to the nose."""
    found = root_fillet(ribbon, root_radius, fillet, side)
    return found, _edge(ribbon, found.station, blend, side)


def nose_arc(ribbon: Ribbon) -> Arc:
    """The round end of the flexure, from its left to its right."""
    end = ribbon.at(np.array([ribbon.length]))
    return Arc(
        center=(float(end.x[0]), float(end.y[0])),
        radius=float(end.half_thickness[0]),
        start_angle=float(end.angle[0]) + 0.5 * math.pi,
        sweep=-math.pi,
    )


def ring_profile(
    ribbon: Ribbon,
    root_radius: float,
    outer_radius: float,
    count: int,
    fillet: float,
    blend: float,
    dowels: Dowels | None,
) -> Profile:
    """The whole ring, all pieces lines and arcs within ``FIT_TOLERANCE`` of the design."""
    one = flexure_pieces(ribbon, root_radius, fillet, blend)
    first, last = one[0], one[-1]
    assert isinstance(first, Arc)
    assert isinstance(last, Arc)
    pitch = 2.0 * math.pi / count
    begin = last.start_angle + last.sweep
    land = Arc(
        center=(root_radius, 0.0),
        radius=root_radius,
        start_angle=begin,
        sweep=(first.start_angle + pitch - begin) % (2.0 * math.pi),
    )
    sector = [translate(rotate(p, math.pi), root_radius, 0.0) for p in (*one, land)]
    hole = Outline(tuple(rotate(p, k * pitch) for k in range(count) for p in sector))
    return Profile(rim_contour(outer_radius, dowels), (hole,))


def rim_contour(outer_radius: float, dowels: Dowels | None) -> Contour:
    """The outside of the ring: a circle (press fit), or with half-round cut-outs for dowels."""
    if dowels is None:
        return Circle((0.0, 0.0), outer_radius)
    pitch = 2.0 * math.pi / dowels.count
    # The corners of a cut are seen from the centre at this angle to either side of the dowel.
    corner = 2.0 * math.asin(0.5 * dowels.radius / outer_radius)
    pieces: list[Piece] = []
    for k in range(dowels.count):
        at = k * pitch
        centre = (outer_radius * math.cos(at), outer_radius * math.sin(at))
        start = at + 1.5 * math.pi - 0.5 * corner
        pieces.append(Arc(centre, dowels.radius, start, corner - math.pi))
        pieces.append(Arc((0.0, 0.0), outer_radius, at + corner, pitch - 2.0 * corner))
    return Outline(tuple(pieces))


def _rim_angle(fillet: Fillet, root_radius: float) -> float:
    """Angle about the centre at which a fillet meets the rim, 0 on the flexure's axis, < pi."""
    x, y = fillet.arc.center
    return math.atan2(y, root_radius - x)


def _edge(ribbon: Ribbon, station: float, blend: float, side: int) -> tuple[Line | Arc, ...]:
    """One edge from its root fillet to the nose: taper, blend and pad."""
    first, pad_start = max(station, 0.0), float(ribbon.edges[-2])
    _, tip = _pad_line(ribbon, side)
    if first >= pad_start - ROUND_OFF:
        (start,), _ = edge_points(ribbon, np.array([station]), side)
        return (Line(_pair(start), _pair(tip)),)
    last, radius = _blend(ribbon, blend, first, side)
    stations = ribbon.dense_stations(EDGE_POINTS)
    between = stations[(stations > first + ROUND_OFF) & (stations < last - ROUND_OFF)]
    taper = ribbon.boundary(np.array([first, *between, last]))[0 if side > 0 else 1]
    pieces = (*fit_curve(taper, FIT_TOLERANCE), *_blend_and_pad(ribbon, taper, radius, side))
    if station >= 0.0:
        return pieces
    (start, root), _ = edge_points(ribbon, np.array([station, 0.0]), side)
    return (Line(_pair(start), _pair(root)), *pieces)


def _blend_and_pad(
    ribbon: Ribbon, taper: Curve, radius: float, side: int
) -> tuple[Arc, Line] | tuple[Line]:
    """From the end of the taper along an arc of ``radius`` and the straight pad to the nose."""
    end, tip = _pad_line(ribbon, side)
    along = (tip - end) / np.hypot(*(tip - end))
    free = side * np.array([-along[1], along[0]])
    point, heading = taper.points[-1], taper.tangents[-1]
    turn = math.atan2(heading[0] * along[1] - heading[1] * along[0], float(heading @ along))
    if abs(turn) < SMOOTH:
        return (Line(_pair(point), _pair(tip)),)
    middle = point + side * radius * np.array([-heading[1], heading[0]])
    start_angle = math.atan2(*(point - middle)[::-1])
    touch = middle - radius * free
    return (Arc(_pair(middle), radius, start_angle, turn), Line(_pair(touch), _pair(tip)))


def _blend(ribbon: Ribbon, smallest: float, first: float, side: int) -> tuple[float, float]:
    """Where beyond ``first`` an arc tangent to the pad leaves the taper, and its radius.

    The radius is ``smallest`` unless only an arc from the very end of the taper will do: a larger
    one where that lies above the pad, as in a flexure thickened for its inner fibres, or a smaller
    one where the taper is nowhere high enough.
    """
    end, tip = _pad_line(ribbon, side)
    along = (tip - end) / np.hypot(*(tip - end))
    free = side * np.array([-along[1], along[0]])

    def above(stations: Floats) -> tuple[Floats, Floats]:
        """Height of the taper over the pad, and by how much an arc of unit radius comes down."""
        points, headings = edge_points(ribbon, stations, side)
        turned = np.column_stack([-headings[:, 1], headings[:, 0]])
        return (points - end) @ free, 1.0 - side * (turned @ free)

    def left_over(stations: Floats) -> Floats:
        height, drop = above(stations)
        return height - smallest * drop

    pad_start = float(ribbon.edges[-2])
    before = pad_start - np.geomspace(
        ROUND_OFF, min(0.5 * pad_start, 0.99 * (pad_start - first)), 60
    )
    clear = left_over(before) > 0.0
    if clear[0] or not clear.any():
        last = before[[0 if clear[0] else -1]]
        height, drop = (float(value[0]) for value in above(last))
        return float(last[0]), height / drop if drop > 0.0 else smallest
    low, high = float(before[int(np.argmax(clear))]), float(before[0])
    station = brentq(lambda s: float(left_over(np.array([s]))[0]), low, high)
    return float(station), smallest


def _pad_line(ribbon: Ribbon, side: int) -> tuple[Floats, Floats]:
    """First and last point of an edge of the straight pad."""
    stations = np.array([ribbon.edges[-2], ribbon.length])
    edge = ribbon.boundary(stations)[0 if side > 0 else 1]
    return edge.points[0], edge.points[1]


def _pair(point: Floats) -> tuple[float, float]:
    return float(point[0]), float(point[1])
