"""One half of an omega leaf as it is drawn, from the hub to where its centre line ends."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springcad.geometry.outline import Arc, Line
from springcad.geometry.ribbon import Ribbon

Floats = NDArray[np.float64]

LEFT, RIGHT = 1.0, -1.0
"""Edges of a half, seen from the hub outwards."""


@dataclass(frozen=True)
class Half:
    """The right half: its ribbon, where it begins, the hub, and the height of that [m]."""

    ribbon: Ribbon
    start: Floats
    hub: float
    middle: float

    def edge(self, stations: ArrayLike, side: float) -> tuple[Floats, Floats]:
        """Points and unit tangents (..., 2) of the left (side 1) or right (-1) edge at stations.

        Tangents go outwards.
        """
        places = np.asarray(stations, dtype=np.float64)
        at = self.ribbon.at(np.atleast_1d(places))
        along = np.column_stack([np.cos(at.angle), np.sin(at.angle)])
        across = _left(along)
        points = self.start + np.column_stack([at.x, at.y])
        points = points + (side * at.half_thickness)[:, None] * across
        bend = 1.0 - side * at.half_thickness * at.curvature
        tangents = bend[:, None] * along + (side * at.thickness_slope)[:, None] * across
        tangents /= np.hypot(*tangents.T)[:, None]
        shape = (*places.shape, 2)
        return points.reshape(shape), tangents.reshape(shape)

    def beyond(self, stations: ArrayLike, side: float, radius: float) -> tuple[Floats, Floats]:
        """Points of an edge, straight on beyond its end, and centres of the circles beside it."""
        places = np.asarray(stations, dtype=np.float64)
        within = np.minimum(places, self.ribbon.length)
        points, tangents = self.edge(within, side)
        points = points + (places - within)[..., None] * tangents
        return points, points + side * radius * _left(tangents)


def _left(vectors: Floats) -> Floats:
    """Turned by a right angle, (..., 2)."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def arc_between(center: Floats, radius: float, start: Floats, end: Floats, side: float) -> Arc:
    """From start to end about the centre; counter-clockwise for side 1."""
    first = math.atan2(*(start - center)[::-1])
    last = math.atan2(*(end - center)[::-1])
    sweep = side * ((side * (last - first)) % (2.0 * math.pi))
    return Arc((float(center[0]), float(center[1])), radius, first, sweep)


def line_between(start: Floats, end: Floats) -> Line:
    return Line((float(start[0]), float(start[1])), (float(end[0]), float(end[1])))
