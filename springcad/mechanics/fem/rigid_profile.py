"""A rigid body with a smooth outline: distance of points to it, normals and curvature."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline, CubicSpline
from scipy.spatial import KDTree

Floats = NDArray[np.float64]

_MAX_ITERATIONS = 12


@dataclass(frozen=True)
class RigidProfile:
    """A piecewise cubic curve with the body on its left; made by ``rigid_profile``.

    Attributes:
        places: curve parameter of the points (M,), the chord length from the first [m].
        points: (M, 2) [m], in the frame of the body; the body turns about the origin.
        curve: place → point.
        closed: whether the last point is the first.
    """

    places: Floats
    points: Floats
    curve: CubicHermiteSpline
    tree: KDTree
    closed: bool


@dataclass(frozen=True)
class Projection:
    """The nearest points of a profile; arrays of the shape of the given points.

    Attributes:
        gap: distance [m], negative inside the body; infinite beyond the ends of an open profile.
        place: parameter of the nearest point [m].
        normal, tangent: of the profile there, (..., 2); the normal points out of the body.
        curvature: of the profile, positive where the body is convex [1/m].
        speed: arc length per unit of ``place``.
    """

    gap: Floats
    place: Floats
    normal: Floats
    tangent: Floats
    curvature: Floats
    speed: Floats


def rigid_profile(points: Floats, tangents: Floats | None = None) -> RigidProfile:
    """A profile through points (M, 2) [m] in boundary order, the body on the left.

    The curve is closed when the first point is repeated as the last. ``tangents`` (M, 2), of any
    length, are used where the curvature jumps (arcs that meet lines); without them the curve is
    the cubic spline. Points must be close against the radius of curvature: the error of the
    outline is about R (step/R)⁴/100.
    """
    steps = np.hypot(*np.diff(points, axis=0).T)
    if len(points) < 3 or np.any(steps <= 0.0):
        raise ValueError("a rigid profile needs three or more points, all apart")
    places = np.concatenate([[0.0], np.cumsum(steps)])
    closed = bool(np.hypot(*(points[-1] - points[0])) <= 1e-9 * places[-1])
    if closed:
        points = np.concatenate([points[:-1], points[:1]])
    if tangents is None:
        slopes = CubicSpline(places, points, bc_type="periodic" if closed else "not-a-knot")(
            places, 1
        )
    else:
        slopes = tangents / np.hypot(*tangents.T)[:, None]
    curve = CubicHermiteSpline(places, points, slopes)
    tree = KDTree(points[:-1] if closed else points)
    return RigidProfile(places, points, curve, tree, closed)


def project(profile: RigidProfile, points: Floats) -> Projection:
    """Nearest points of the profile to points (..., 2) [m] given in the frame of the body.

    The search starts at the nearest of the profile's points and is exact for points nearer to the
    outline than its concave radius of curvature.
    """
    shape = points.shape[:-1]
    flat = points.reshape(-1, 2)
    nearest = profile.tree.query(flat)[1]
    length = profile.places[-1]
    place = profile.places[nearest]
    longest = np.max(np.diff(profile.places))
    for _ in range(_MAX_ITERATIONS):
        foot, slope, bend = _with_derivatives(profile, place)
        away = flat - foot
        along = np.sum(away * slope, axis=1)
        steepness = np.sum(slope**2, axis=1) - np.sum(away * bend, axis=1)
        step = along / np.where(steepness > 0.1, steepness, 1.0)
        moved = place + np.clip(step, -longest, longest)
        moved = np.mod(moved, length) if profile.closed else np.clip(moved, 0.0, length)
        change = np.abs(moved - place)
        place = moved
        if np.max(np.minimum(change, length - change)) < 1e-14 * length:
            break

    foot, slope, bend = _with_derivatives(profile, place)
    away = flat - foot
    speed = np.hypot(*slope.T)
    tangent = slope / speed[:, None]
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)
    gap = np.sum(away * normal, axis=1)
    if not profile.closed:
        beyond = np.abs(np.sum(away * tangent, axis=1)) > 1e-9 * length
        ends = (place <= 0.0) | (place >= length)
        gap = np.where(beyond & ends, np.inf, gap)
    curvature = (slope[:, 0] * bend[:, 1] - slope[:, 1] * bend[:, 0]) / speed**3
    return Projection(
        gap.reshape(shape),
        place.reshape(shape),
        normal.reshape(*shape, 2),
        tangent.reshape(*shape, 2),
        curvature.reshape(shape),
        speed.reshape(shape),
    )


def _with_derivatives(profile: RigidProfile, place: Floats) -> tuple[Floats, Floats, Floats]:
    """Points of the curve at places (P,), and its first two derivatives there, each (P, 2)."""
    interval = np.searchsorted(profile.places, place, side="right") - 1
    interval = np.minimum(interval, len(profile.places) - 2)
    h = (place - profile.places[interval])[:, None]
    cubic, square, linear, start = profile.curve.c[:, interval]
    point = start + h * (linear + h * (square + h * cubic))
    return point, linear + h * (2.0 * square + 3.0 * h * cubic), 2.0 * square + 6.0 * h * cubic
