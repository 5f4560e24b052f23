"""Smooth curves as few circular arcs: G1 biarcs within a stated tolerance.

A biarc joins two points with given directions by two arcs that share their tangent where they
meet. Of the one-parameter family the one with equal control lengths d is taken (Bolton, "Biarc
curves", Computer-Aided Design 7, 1975, 89-92), which treats both ends alike. With v = p1 - p0:

    2 d² (1 - t0·t1) + 2 d v·(t0 + t1) - v·v = 0,      joint = (p0 + p1 + d (t0 - t1)) / 2

A fit takes the longest stretches whose biarc stays within the tolerance of the dense curve, from
both ends towards the middle, so that a curve run through backwards gives the same arcs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from springcad.geometry.biarc_stretches import ComplexPoints, joint_of, longest_stretches
from springcad.geometry.outline import Arc, Circle, Contour, Curve, Floats, Line, Outline, Piece
from springcad.geometry.polyline import BulgePolyline

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
        return joint_of(start, start_tangent, end, end_tangent)


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
    knots = longest_stretches(points, headings, tolerance)
    return _as_pairs(points[knots]), _as_pairs(headings[knots])
