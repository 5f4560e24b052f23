"""Measures of outlines and profiles: area, length, extent, joints, polygons, validity."""

from __future__ import annotations

import numpy as np
import shapely

from springcad.geometry.biarc import JOINT_GAP, arc_point, exact_polyline, is_finite
from springcad.geometry.outline import Arc, Circle, Contour, Curve, Floats, Outline, Piece, Profile
from springcad.geometry.polyline import (
    bounds,
    flatten,
    joint_turns,
    length,
    signed_area,
)

DEFAULT_CHORD = 1e-6
"""Largest distance between an arc and its chord where a contour becomes a polygon (m)."""


def contour_area(contour: Contour) -> float:
    """Enclosed area in m², positive when the contour runs counter-clockwise; exact on arcs."""
    return signed_area(exact_polyline(contour))


def contour_length(contour: Contour) -> float:
    """Circumference in m; exact on arcs."""
    return length(exact_polyline(contour))


def contour_bounds(contour: Contour) -> tuple[float, float, float, float]:
    """Smallest x, smallest y, largest x, largest y in m."""
    return bounds(exact_polyline(contour))


def contour_points(contour: Contour, chord: float = DEFAULT_CHORD) -> Floats:
    """Vertices (N, 2) of the inscribed polygon within ``chord`` (m); not repeated at the end."""
    return flatten(exact_polyline(contour), chord)


def profile_area(profile: Profile) -> float:
    """Area of the material in m²: the outer contour less the inner ones."""
    holes = sum(abs(contour_area(contour)) for contour in profile.inner)
    return abs(contour_area(profile.outer)) - holes


def profile_polar_moment(profile: Profile, chord: float = DEFAULT_CHORD) -> float:
    """Integral of r² over the material about the origin, m⁴; on polygons within ``chord`` (m).

    Over the triangle of the origin and an edge a b it is a×b (a·a + a·b + b·b)/12.
    """

    def of(contour: Contour) -> float:
        a = contour_points(contour, chord)
        b = np.roll(a, -1, axis=0)
        cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        return abs(float(cross @ np.sum(a * a + a * b + b * b, axis=1))) / 12.0

    return of(profile.outer) - sum(of(contour) for contour in profile.inner)


def profile_cut_length(profile: Profile) -> float:
    """Length of all cuts in m."""
    return sum(contour_length(contour) for contour in (profile.outer, *profile.inner))


def profile_polygon(profile: Profile, chord: float = DEFAULT_CHORD) -> shapely.Polygon:
    """The material as a polygon; chords deviate from the arcs by no more than ``chord`` (m)."""
    holes = [contour_points(contour, chord) for contour in profile.inner]
    return shapely.Polygon(contour_points(profile.outer, chord), holes)


def largest_joint_gap(outline: Outline) -> float:
    """Largest distance in m from the end of a piece to the start of the next; 0 if closed."""
    ends = np.array([piece_end(piece, 1.0)[0] for piece in outline.pieces])
    starts = np.array([piece_end(piece, 0.0)[0] for piece in outline.pieces])
    return float(np.max(np.hypot(*(np.roll(starts, -1, axis=0) - ends).T)))


def outline_corners(outline: Outline) -> Floats:
    """Signed turn (rad) at the start of each piece, (N,); 0 where the outline is smooth (G1)."""
    ends = np.roll([piece_end(piece, 1.0)[1] for piece in outline.pieces], 1, axis=0)
    starts = np.array([piece_end(piece, 0.0)[1] for piece in outline.pieces])
    cross = ends[:, 0] * starts[:, 1] - ends[:, 1] * starts[:, 0]
    return np.asarray(np.arctan2(cross, np.sum(ends * starts, axis=1)))


def sharpest_joint(contour: Contour) -> float:
    """Largest turn (rad, unsigned) between neighbouring segments of the whole contour."""
    return float(np.max(np.abs(joint_turns(exact_polyline(contour)))))


def piece_end(piece: Piece, side: float) -> tuple[Floats, Floats]:
    """Point and unit tangent at the start (``side`` 0) or at the end (1) of a piece."""
    if isinstance(piece, Curve):
        index = -1 if side else 0
        return piece.points[index], piece.tangents[index]
    if isinstance(piece, Arc):
        angle = piece.start_angle + side * piece.sweep
        turn = np.sign(piece.sweep) * np.array([-np.sin(angle), np.cos(angle)])
        return np.array(arc_point(piece, side)), turn
    chord = np.array(piece.end) - np.array(piece.start)
    return np.array(piece.end if side else piece.start), chord / np.hypot(*chord)


def profile_faults(profile: Profile, chord: float = DEFAULT_CHORD) -> tuple[str, ...]:
    """Why the profile is not a valid part, in words; empty if it is.

    Tested on polygons within ``chord`` (m): every contour finite, closed and simple, every inner
    contour strictly inside the outer one and strictly outside the other inner ones.
    """
    names = ["outer contour", *(f"inner contour {i + 1}" for i in range(len(profile.inner)))]
    contours = (profile.outer, *profile.inner)
    faults: list[str] = []
    polygons: list[shapely.Polygon] = []
    for name, contour in zip(names, contours, strict=True):
        fault = _contour_fault(contour, chord)
        if fault:
            faults.append(f"{name} {fault}")
        else:
            polygons.append(shapely.Polygon(contour_points(contour, chord)))
    if faults:
        return tuple(faults)
    outer, inner = polygons[0], polygons[1:]
    shapely.prepare(outer)
    for i, hole in enumerate(inner):
        if not shapely.contains_properly(outer, hole):
            faults.append(f"{names[i + 1]} is not inside the outer contour")
        faults.extend(
            f"{names[i + 1]} meets inner contour {j + 1}"
            for j in range(i)
            if shapely.intersects(hole, inner[j])
        )
    return tuple(faults)


def _contour_fault(contour: Contour, chord: float) -> str:
    if not is_finite(contour):
        return "has a coordinate that is not a finite number"
    if isinstance(contour, Circle):
        return "" if contour.radius > 0.0 else "is a circle without a radius"
    gap = largest_joint_gap(contour)
    if gap > JOINT_GAP:
        return f"is open by {gap * 1e3:.3g} mm"
    ring = shapely.LinearRing(contour_points(contour, chord))
    if not ring.is_simple:
        x, y = _crossing(ring)
        return f"cuts itself near x = {x * 1e3:.4f} mm, y = {y * 1e3:.4f} mm"
    return ""


def _crossing(ring: shapely.LinearRing) -> tuple[float, float]:
    reason = shapely.is_valid_reason(shapely.Polygon(ring))
    numbers = reason[reason.find("[") + 1 : reason.find("]")].split()
    return (float(numbers[0]), float(numbers[1])) if len(numbers) == 2 else (np.nan, np.nan)
