"""The flanks of a camshaft as its drawing has them, for contact with what is cut from it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.polyline import (
    BulgePolyline,
    directions_at,
    points_at,
    segment_lengths,
    spread_places,
)
from springcad.mechanics.fem.rigid_profile import RigidProfile, rigid_profile
from springcad.written import IncompleteDesignError

Floats = NDArray[np.float64]

STEP = 1.0 / 1500.0
"""Distance of the points of a flank over the radius of the tip circle: 4 um for one of 6 mm, whose
arcs of 0.15 mm are then exact within 0.1 nm."""
_SAME = 1e-7
"""Points this near the tip circle are on it (m); drawings are rounded to a nanometre."""


def drawn_flank(camshaft: BulgePolyline, direction: int) -> RigidProfile:
    """The flank of ``direction`` beside flexure 0, from the tip circle to the bottom of its slot.

    Args:
        camshaft: its outer contour (m), counter-clockwise about the origin.
        direction: +1 for the flank that pushes counter-clockwise.

    Raises:
        IncompleteDesignError: the contour has no tooth spaces between arcs of a tip circle.
    """
    slot = _slot_segments(camshaft)
    counts = np.zeros(len(camshaft.points))
    step = STEP * float(np.hypot(*camshaft.points.T).max())
    counts[slot] = np.maximum(np.ceil(segment_lengths(camshaft)[slot] / step), 2.0)
    segment, fraction = spread_places(counts)
    # The slot may run through the first vertex of the contour.
    shift = int(np.flatnonzero(segment == slot[0])[0])
    places = np.roll(segment, -shift), np.roll(fraction, -shift)
    points, tangents = points_at(camshaft, *places), directions_at(camshaft, *places)
    deepest = int(np.argmin(np.hypot(*points.T)))
    half = slice(0, deepest) if direction > 0 else slice(deepest, None)
    return rigid_profile(points[half], tangents[half])


def _slot_segments(camshaft: BulgePolyline) -> NDArray[np.intp]:
    """Segments of the tooth space nearest the polar angle 0, in the order of the contour."""
    count = len(camshaft.points)
    radius = np.hypot(*camshaft.points.T)
    middle = points_at(camshaft, np.arange(count, dtype=np.float64), np.full(count, 0.5))
    tip = float(radius.max())
    ends_outside = (tip - radius < _SAME) & (tip - np.roll(radius, -1) < _SAME)
    is_land = ends_outside & (np.abs(np.hypot(*middle.T) - tip) < _SAME)
    begins = np.flatnonzero(is_land & ~np.roll(is_land, -1))
    if not len(begins):
        raise IncompleteDesignError("the drawing of the camshaft has no tooth spaces")
    slots = [_until_land((int(begin) + 1) % count, is_land) for begin in begins]
    angles = [float(np.abs(np.arctan2(*_deepest(camshaft, slot)[::-1]))) for slot in slots]
    return slots[int(np.argmin(angles))]


def _until_land(first: int, is_land: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Segments from ``first`` to the last before the next land."""
    length = int(np.argmax(np.roll(is_land, -first)))
    return (first + np.arange(length)) % len(is_land)


def _deepest(camshaft: BulgePolyline, slot: NDArray[np.intp]) -> Floats:
    """The vertex of a slot that is nearest the centre."""
    points = camshaft.points[slot]
    return np.asarray(points[np.argmin(np.hypot(*points.T))])
