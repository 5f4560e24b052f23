"""One half of an omega leaf as it is drawn, from the hub to where its centre line ends."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

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

    def edge(self, station: float, side: float) -> tuple[Floats, Floats]:
        """Point and unit tangent of the left (side 1) or right (-1) edge, going outwards."""
        at = self.ribbon.at(np.array([station]))
        along = np.array([math.cos(at.angle[0]), math.sin(at.angle[0])])
        across = np.array([-along[1], along[0]])
        point = self.start + np.array([at.x[0], at.y[0]]) + side * at.half_thickness[0] * across
        bend = 1.0 - side * at.half_thickness[0] * at.curvature[0]
        tangent = bend * along + side * at.thickness_slope[0] * across
        return point, tangent / np.hypot(*tangent)

    def beyond(self, station: float, side: float, radius: float) -> tuple[Floats, Floats]:
        """Point of an edge, straight on beyond the end, and the centre of the circle beside it."""
        within = min(station, self.ribbon.length)
        point, tangent = self.edge(within, side)
        point = point + (station - within) * tangent
        return point, point + side * radius * np.array([-tangent[1], tangent[0]])


def arc_between(center: Floats, radius: float, start: Floats, end: Floats, side: float) -> Arc:
    """From start to end about the centre; counter-clockwise for side 1."""
    first = math.atan2(*(start - center)[::-1])
    last = math.atan2(*(end - center)[::-1])
    sweep = side * ((side * (last - first)) % (2.0 * math.pi))
    return Arc((float(center[0]), float(center[1])), radius, first, sweep)


def line_between(start: Floats, end: Floats) -> Line:
    return Line((float(start[0]), float(start[1])), (float(end[0]), float(end[1])))
