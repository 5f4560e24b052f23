"""Closed polylines with bulges: straight lines and circular arcs in one exact, plain form.

The bulge of the segment from one vertex to the next is tan(sweep / 4): 0 for a straight line, 1
for a half circle to the left. This is the form that a DXF stores. Units are metres and radians.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from springcad.geometry.outline import Floats

LARGEST_STEP = np.pi / 8
"""No chord of a flattened arc spans more than this angle, however coarse the tolerance."""


@dataclass(frozen=True)
class BulgePolyline:
    """Closed: ``points`` (N, 2) and the ``bulges`` (N,) of the segments that begin at them."""

    points: Floats
    bulges: Floats

    @property
    def chords(self) -> Floats:
        """Vector from each vertex to the next, the last to the first, (N, 2)."""
        return np.roll(self.points, -1, axis=0) - self.points


def sweeps(polyline: BulgePolyline) -> Floats:
    """Signed angle through which each segment turns, (N,)."""
    return 4.0 * np.arctan(polyline.bulges)


def radii(polyline: BulgePolyline) -> Floats:
    """Radius of each segment, (N,); infinite where it is straight."""
    chord = np.hypot(*polyline.chords.T)
    bulge = np.abs(polyline.bulges)
    # A bulge may be so small that its radius is too large for a number: that is straight.
    with np.errstate(divide="ignore", over="ignore"):
        return np.asarray(chord * (1.0 + bulge**2) / (4.0 * bulge))


def segment_lengths(polyline: BulgePolyline) -> Floats:
    """Arc length of each segment, (N,)."""
    half = 0.5 * sweeps(polyline)
    return np.asarray(np.hypot(*polyline.chords.T) / np.sinc(half / np.pi))


def length(polyline: BulgePolyline) -> float:
    """Circumference."""
    return float(np.sum(segment_lengths(polyline)))


def signed_area(polyline: BulgePolyline) -> float:
    """Enclosed area, positive when the polyline runs counter-clockwise.

    Shoelace sum of the chords plus the circular segments c²(θ - sin θ) / (8 sin²(θ/2)).
    """
    points = polyline.points - polyline.points[0]
    x, y = points.T
    triangles = 0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)
    angle = sweeps(polyline)
    # Below 0.01 rad the closed form loses digits; the next term of the series is under 1e-12.
    small = np.abs(angle) < 0.01
    wide = np.where(small, 1.0, angle)
    factor = np.where(
        small,
        angle / 12.0 * (1.0 + angle**2 / 30.0),
        (wide - np.sin(wide)) / (8.0 * np.sin(0.5 * wide) ** 2),
    )
    return float(triangles + np.sum(factor * np.sum(polyline.chords**2, axis=1)))


def points_at(polyline: BulgePolyline, segment: Floats, fraction: Floats) -> Floats:
    """Points (M, 2) at the ``fraction`` of the arc length of the segments with index ``segment``.

    Exact on arcs of any flatness: no centre is formed.
    """
    index = np.asarray(segment, dtype=np.intp)
    half = 0.5 * sweeps(polyline)[index]
    scale = fraction * np.sinc(fraction * half / np.pi) / np.sinc(half / np.pi)
    chord = polyline.chords[index] * scale[:, None]
    return polyline.points[index] + rotate_vectors(chord, (fraction - 1.0) * half)


def directions_at(polyline: BulgePolyline, segment: Floats, fraction: Floats) -> Floats:
    """Unit tangents (M, 2) at the same places as ``points_at``."""
    index = np.asarray(segment, dtype=np.intp)
    half = 0.5 * sweeps(polyline)[index]
    chord = polyline.chords[index]
    unit = chord / np.hypot(*chord.T)[:, None]
    return rotate_vectors(unit, (2.0 * fraction - 1.0) * half)


def joint_turns(polyline: BulgePolyline) -> Floats:
    """Signed angle by which the direction jumps at each vertex, (N,); 0 where it is smooth."""
    count = np.arange(len(polyline.points), dtype=np.float64)
    begin = directions_at(polyline, count, np.zeros(len(count)))
    end = np.roll(directions_at(polyline, count, np.ones(len(count))), 1, axis=0)
    return np.asarray(
        np.arctan2(end[:, 0] * begin[:, 1] - end[:, 1] * begin[:, 0], np.sum(end * begin, axis=1))
    )


def flat_places(polyline: BulgePolyline, tolerance: float) -> tuple[Floats, Floats]:
    """Segment index (M,) and fraction (M,) of each vertex of ``flatten``."""
    angle = np.abs(sweeps(polyline))
    rise = 0.5 * np.abs(polyline.bulges) * np.hypot(*polyline.chords.T)
    bent = (rise > tolerance) | (angle > LARGEST_STEP)
    ratio = np.minimum(tolerance / radii(polyline)[bent], 1.0)
    # 1 - cos(step/2) = 2 sin²(step/4) holds its digits where the ratio is tiny.
    step = np.minimum(4.0 * np.arcsin(np.sqrt(0.5 * ratio)), LARGEST_STEP)
    counts = np.ones_like(angle)
    counts[bent] = np.ceil(angle[bent] / step - 1e-9)
    return spread_places(counts)


def spread_places(counts: Floats) -> tuple[Floats, Floats]:
    """Segment index and fraction of the starts of ``counts`` equal stretches of each segment."""
    whole = counts.astype(np.intp)
    segment = np.repeat(np.arange(len(whole)), whole)
    rank = np.arange(len(segment)) - np.repeat(np.cumsum(whole) - whole, whole)
    return segment.astype(np.float64), rank / whole[segment]


def flatten(polyline: BulgePolyline, tolerance: float) -> Floats:
    """Vertices (M, 2) of the inscribed polygon whose chords deviate by no more than ``tolerance``.

    The first vertex is not repeated at the end.
    """
    return points_at(polyline, *flat_places(polyline, tolerance))


def bounds(polyline: BulgePolyline) -> tuple[float, float, float, float]:
    """Smallest x, smallest y, largest x, largest y, extremes of the arcs included."""
    corners = [polyline.points]
    angle = sweeps(polyline)
    begin = directions_at(polyline, np.arange(len(angle), dtype=np.float64), np.zeros(len(angle)))
    heading = np.arctan2(begin[:, 1], begin[:, 0])
    for axis in range(-4, 5):
        # An arc is extreme where its direction is parallel to an axis.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            fraction = (0.5 * np.pi * axis - heading) / angle
        inside = np.flatnonzero((fraction > 0.0) & (fraction < 1.0))
        corners.append(points_at(polyline, inside.astype(np.float64), fraction[inside]))
    every = np.concatenate(corners)
    low, high = every.min(axis=0), every.max(axis=0)
    return float(low[0]), float(low[1]), float(high[0]), float(high[1])


def turned_round(polyline: BulgePolyline) -> BulgePolyline:
    """The same closed line run through the other way, from the same first vertex."""
    points = np.roll(polyline.points[::-1], 1, axis=0)
    return BulgePolyline(points, -polyline.bulges[::-1])


def rotate_vectors(vectors: Floats, angles: Floats) -> Floats:
    """Each vector (N, 2) turned by its own angle (N,)."""
    cos, sin = np.cos(angles), np.sin(angles)
    x, y = vectors.T
    return np.column_stack((cos * x - sin * y, sin * x + cos * y))
