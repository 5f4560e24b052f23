"""Smooth curves as few circular arcs: G1 biarcs within a stated tolerance.

A biarc joins two points with given directions by two arcs that share their tangent where they
meet. Of the one-parameter family the one with equal control lengths d is taken (Bolton, "Biarc
curves", Computer-Aided Design 7, 1975, 89-92), which treats both ends alike. With v = p1 - p0:

    2 d² (1 - t0·t1) + 2 d v·(t0 + t1) - v·v = 0,      joint = (p0 + p1 + d (t0 - t1)) / 2

A fit takes the longest stretches whose biarc stays within the tolerance of the dense curve, from
both ends towards the middle, so that a curve run through backwards gives the same arcs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import math

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Arc, Circle, Contour, Curve, Floats, Line, Outline, Piece
from springcad.geometry.polyline import BulgePolyline

ComplexPoints = NDArray[np.complex128]

DEFAULT_TOLERANCE = 2e-6
"""Largest deviation of fitted arcs from a curve (m)."""

JOINT_GAP = 1e-8
"""Two pieces whose ends are farther apart than this (m) do not make a closed outline."""

_MARGIN = 0.99  # the deviation is taken at finitely many points; between them it grows by < 1 %
_FLAT = 3e-10  # a smaller bulge has a centre so far away that the ends lose their digits
_SMOOTH = 1e-10  # rad: below this, a bulge is rounding, and two arcs of a biarc are one


@dataclass(frozen=True)
class _Chain:
    """Open chain of segments: vertices (N + 1, 2) and bulges (N,)."""

    points: Floats
    bulges: Floats


def biarc_joints(
    start: ComplexPoints,
    start_tangent: ComplexPoints,
    end: ComplexPoints,
    end_tangent: ComplexPoints,
) -> tuple[ComplexPoints, ComplexPoints]:
    """Joints, and unit tangents there, of the biarcs between pairs of points.

    Points and unit tangents x + i y, of any one shape. Where the ends ask for two half circles
    (equal tangents across the chord) there is no such biarc and the result is not finite.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return _joint(start, start_tangent, end, end_tangent)


def _joint(start, start_tangent, end, end_tangent):
    """The same of arrays or of single numbers, by their own rules of division by zero."""
    v, total, apart = end - start, start_tangent + end_tangent, start_tangent - end_tangent
    along, squared = (v.conjugate() * total).real, (v.conjugate() * v).real
    # 1 - t0·t1 = |t0 - t1|²/2, without cancellation; this form of the root is exact at t0 = t1.
    spread = (apart.conjugate() * apart).real
    d = squared / (along + (along**2 + spread * squared) ** 0.5)
    return 0.5 * (start + end + d * apart), (v - d * total) / (2.0 * d)


def arc_bulges(start: Floats, tangent: Floats, end: Floats) -> Floats:
    """Bulges (N,) of the arcs that leave ``start`` along the unit ``tangent`` and meet ``end``."""
    chord = end - start
    cross = tangent[:, 0] * chord[:, 1] - tangent[:, 1] * chord[:, 0]
    return np.asarray(cross / (np.hypot(*chord.T) + np.sum(tangent * chord, axis=1)))


def fit_outline(outline: Outline, tolerance: float = DEFAULT_TOLERANCE) -> BulgePolyline:
    """Lines and arcs as they are, curves as biarcs within ``tolerance`` (m), G1 inside a curve.

    Raises ValueError where the outline is open or not finite, or a curve too coarse to be fitted.
    """
    return fit_contour(outline, tolerance)


def fit_contour(contour: Contour, tolerance: float = DEFAULT_TOLERANCE) -> BulgePolyline:
    """``fit_outline`` for any contour; a full circle is two half circles."""
    _demand_finite(contour)
    if isinstance(contour, Circle):
        return _full_circle(contour)
    return _closed([_fitted_chain(p, tolerance) for p in contour.pieces])


def exact_polyline(contour: Contour) -> BulgePolyline:
    """The contour with nothing left out: every interval of a curve is its own biarc.

    Raises ValueError where the contour is open or not finite.
    """
    _demand_finite(contour)
    if isinstance(contour, Circle):
        return _full_circle(contour)
    return _closed([_exact_chain(piece) for piece in contour.pieces])


def fit_curve(curve: Curve, tolerance: float = DEFAULT_TOLERANCE) -> tuple[Line | Arc, ...]:
    """The curve as lines and arcs within ``tolerance`` (m); ends and end tangents are kept."""
    chain = _fitted_chain(curve, tolerance)
    return tuple(
        _segment_piece(chain.points[i], chain.points[i + 1], float(chain.bulges[i]))
        for i in range(len(chain.bulges))
    )


def polyline_outline(polyline: BulgePolyline) -> Outline:
    """A closed polyline with bulges as an outline of lines and arcs."""
    ends = np.roll(polyline.points, -1, axis=0)
    bulges = [float(bulge) for bulge in polyline.bulges]
    return Outline(tuple(map(_segment_piece, polyline.points, ends, bulges)))


def arc_point(arc: Arc, fraction: float) -> tuple[float, float]:
    """Point of the arc at a fraction of its sweep."""
    angle = arc.start_angle + fraction * arc.sweep
    return (
        arc.center[0] + arc.radius * float(np.cos(angle)),
        arc.center[1] + arc.radius * float(np.sin(angle)),
    )


def is_finite(contour: Contour) -> bool:
    """Whether every number of the contour is finite."""
    if isinstance(contour, Circle):
        return bool(np.isfinite([*contour.center, contour.radius]).all())
    return all(np.isfinite(_numbers(piece)).all() for piece in contour.pieces)


def _numbers(piece: Piece) -> Floats:
    if isinstance(piece, Curve):
        return np.concatenate((piece.points, piece.tangents))
    if isinstance(piece, Arc):
        return np.array([*piece.center, piece.radius, piece.start_angle, piece.sweep])
    return np.array([piece.start, piece.end])


def _demand_finite(contour: Contour) -> None:
    if not is_finite(contour):
        raise ValueError("a coordinate of the outline is not a finite number")


def _segment_piece(start: Floats, end: Floats, bulge: float) -> Line | Arc:
    (x0, y0), (x1, y1) = map(float, start), map(float, end)
    if abs(bulge) < _FLAT:
        return Line((x0, y0), (x1, y1))
    lift = (1.0 - bulge**2) / (4.0 * bulge)
    center = (0.5 * (x0 + x1) - lift * (y1 - y0), 0.5 * (y0 + y1) + lift * (x1 - x0))
    radius = float(np.hypot(x1 - x0, y1 - y0)) * (1.0 + bulge**2) / (4.0 * abs(bulge))
    start_angle = float(np.arctan2(y0 - center[1], x0 - center[0]))
    return Arc(center, radius, start_angle, 4.0 * float(np.arctan(bulge)))


def _full_circle(circle: Circle) -> BulgePolyline:
    (x, y), radius = circle.center, circle.radius
    return BulgePolyline(np.array([[x + radius, y], [x - radius, y]]), np.array([1.0, 1.0]))


def _closed(chains: list[_Chain]) -> BulgePolyline:
    for i, chain in enumerate(chains):
        gap = float(np.hypot(*(chain.points[0] - chains[i - 1].points[-1])))
        if not gap <= JOINT_GAP:
            raise ValueError(f"outline is open by {gap:.3g} m before piece {i}")
    return BulgePolyline(
        np.concatenate([chain.points[:-1] for chain in chains]),
        np.concatenate([chain.bulges for chain in chains]),
    )


def _simple_chain(piece: Line | Arc) -> _Chain:
    if isinstance(piece, Line):
        return _Chain(np.array([piece.start, piece.end]), np.zeros(1))
    # A bulge of more than a half circle grows without bound; such arcs are split.
    parts = max(1, int(np.ceil(abs(piece.sweep) / np.pi - 1e-12)))
    points = np.array([arc_point(piece, i / parts) for i in range(parts + 1)])
    return _Chain(points, np.full(parts, np.tan(0.25 * piece.sweep / parts)))


def _exact_chain(piece: Piece) -> _Chain:
    if isinstance(piece, Curve):
        return _biarc_chain(piece.points, piece.tangents)
    return _simple_chain(piece)


def _fitted_chain(piece: Piece, tolerance: float) -> _Chain:
    if not isinstance(piece, Curve):
        return _simple_chain(piece)
    return _without_needless_joints(*_knots(piece, _MARGIN * tolerance))


def _biarc_chain(points: Floats, tangents: Floats) -> _Chain:
    """Two arcs between each two neighbours of N points: 2 N - 1 vertices."""
    vertices, headings = (_as_pairs(z) for z in _with_joints(points, tangents))
    return _Chain(vertices, arc_bulges(vertices[:-1], headings[:-1], vertices[1:]))


def _with_joints(points: Floats, tangents: Floats) -> tuple[ComplexPoints, ComplexPoints]:
    """The N points and the joints of the biarcs between them, (2 N - 1,), with tangents."""
    vertices = np.empty(2 * len(points) - 1, dtype=np.complex128)
    headings = np.empty_like(vertices)
    vertices[0::2], headings[0::2] = _as_complex(points), _as_complex(tangents)
    vertices[1::2], headings[1::2] = biarc_joints(
        vertices[:-1:2], headings[:-1:2], vertices[2::2], headings[2::2]
    )
    return vertices, headings


def _as_complex(points: Floats) -> ComplexPoints:
    return points[:, 0] + 1j * points[:, 1]


def _as_pairs(points: ComplexPoints) -> Floats:
    return np.column_stack([points.real, points.imag])


def _without_needless_joints(points: Floats, tangents: Floats) -> _Chain:
    """The biarcs between the points; where one arc or line meets both ends, only that one."""
    double = _biarc_chain(points, tangents)
    forward = arc_bulges(points[:-1], tangents[:-1], points[1:])
    backward = -arc_bulges(points[1:], -tangents[1:], points[:-1])
    one = np.abs(forward - backward) < _SMOOTH
    bulges = double.bulges.copy()
    bulges[0::2] = np.where(one, 0.5 * (forward + backward), bulges[0::2])
    bulges[np.abs(bulges) < _SMOOTH] = 0.0
    keep = np.ones(len(double.points), dtype=bool)
    keep[1::2] = ~one
    return _Chain(double.points[keep], bulges[keep[:-1]])


def _knots(curve: Curve, tolerance: float) -> tuple[Floats, Floats]:
    """Points and tangents where the biarcs of the fit begin and end."""
    points, headings = _with_joints(curve.points, curve.tangents)

    def fits(first: int, last: int) -> bool:
        window = slice(min(first, last), max(first, last) + 1)
        return _deviation(points[window], headings[window]) <= tolerance

    front, back = [0], [len(points) - 1]
    while not fits(front[-1], back[-1]):
        ahead = _reach(fits, front, back[-1])
        behind = _reach(fits, back, front[-1])
        middle = (ahead + behind) // 2
        if ahead < behind:
            front.append(ahead)
            back.append(behind)
        elif fits(front[-1], middle) and fits(middle, back[-1]):
            # Two biarcs are enough for what is left: they meet half way.
            front.append(middle)
            break
        else:
            front.append(ahead)
    knots = front + back[::-1]
    return _as_pairs(points[knots]), _as_pairs(headings[knots])


def _reach(fits: Callable[[int, int], bool], knots: list[int], limit: int) -> int:
    """The farthest sample from the last knot towards ``limit`` that one biarc attains.

    Samples have the even indices; the span is doubled as long as it fits, then bisected. It begins
    well below that of the biarc before.
    """
    origin, step = knots[-1], 2 if limit > knots[-1] else -2
    most = (limit - origin) // step
    before = (origin - knots[-2]) // step if len(knots) > 1 else 0
    likely = 1 << max(before.bit_length() - 1, 0)
    good, bad = 0, likely if likely <= most and fits(origin, origin + step * likely) else 1
    while bad <= most and fits(origin, origin + step * bad):
        good, bad = bad, min(2 * bad, most) if bad < most else most + 1
    if good == 0:
        raise ValueError(f"curve turns too far within one interval, after point {origin // 2}")
    while bad - good > 1:
        middle = (good + bad) // 2
        good, bad = (middle, bad) if fits(origin, origin + step * middle) else (good, middle)
    return origin + step * good


def _deviation(points: ComplexPoints, headings: ComplexPoints) -> float:
    """Largest distance of the points of a stretch from the biarc between its ends; inf if none.

    The stretch must nowhere turn by 90° or more from the direction at the joint: it and the biarc
    are then two graphs over the same axis and this distance is the distance both ways.
    """
    start, end = complex(points[0]), complex(points[-1])
    tangent = complex(headings[0])
    try:
        joint, direction = _joint(start, tangent, end, complex(headings[-1]))
    except ZeroDivisionError:
        return math.inf
    turned = direction.conjugate()
    if (headings * turned).real.min() <= 0.0:
        return math.inf
    local = (points - joint) * turned
    along, across = local.real, local.imag
    before, after = _curvature(start, tangent, joint), _curvature(joint, direction, end)
    curvature = np.where(along < 0.0, before, after)
    # Distance from the circle through the joint, in a form that is exact for a straight line.
    bent = curvature * (along**2 + across**2) - 2.0 * across
    root = np.sqrt(np.maximum(1.0 + curvature * bent, 0.0))
    return float((np.abs(bent) / (1.0 + root)).max())


def _curvature(start: complex, tangent: complex, end: complex) -> float:
    chord = end - start
    return 2.0 * (tangent.conjugate() * chord).imag / abs(chord) ** 2
