"""Gap between neighbouring flexures, measured on polygons of the finished ribbons.

All flexures of a ring carry the same load, so the neighbour of a deformed flexure is the same
polygon turned by one pitch about the centre of the ring.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray

from springcad.geometry.ribbon import Ribbon
from springcad.mechanics.beam import BeamStates, PreparedBeam
from springcad.mechanics.centre_line import deformed_points

Floats = NDArray[np.float64]

STATIONS = 400
NOSE_POINTS = 24
"""Stations along a flexure and points round its nose; chords then lie within 1 um of the edges."""


def flexure_gap(ribbon: Ribbon, root_radius: float, count: int) -> float:
    """Smallest gap between unloaded neighbours, m; negative where the polygon is not simple."""
    points = ribbon.at(ribbon.dense_stations(STATIONS))
    centre_line = np.column_stack([points.x, points.y])
    polygon = ribbon_polygon(centre_line, points.angle, points.half_thickness)
    return polygon_gap(polygon, (root_radius, 0.0), count)


def deformed_gaps(
    ribbon: Ribbon, beam: PreparedBeam, states: BeamStates, root_radius: float, count: int
) -> Floats:
    """Smallest gap between neighbours in each of the L deformed states, m (L,)."""
    stations = ribbon.dense_stations(STATIONS)
    half = ribbon.at(stations).half_thickness
    lines, angles = deformed_points(beam, states, stations)
    return np.array(
        [
            polygon_gap(ribbon_polygon(line, angle, half), (root_radius, 0.0), count)
            for line, angle in zip(lines, angles, strict=True)
        ]
    )


def ribbon_polygon(centre_line: Floats, angle: Floats, half_thickness: Floats) -> shapely.Polygon:
    """Polygon of a ribbon from its centre line (M, 2), with a round nose at the end."""
    normal = np.column_stack([-np.sin(angle), np.cos(angle)])
    offset = half_thickness[:, None] * normal
    around = angle[-1] + np.linspace(0.5 * math.pi, -0.5 * math.pi, NOSE_POINTS)[1:-1]
    nose = centre_line[-1] + half_thickness[-1] * np.column_stack([np.cos(around), np.sin(around)])
    return shapely.Polygon(
        np.concatenate([centre_line + offset, nose, (centre_line - offset)[::-1]])
    )


def polygon_gap(polygon: shapely.Polygon, centre: tuple[float, float], count: int) -> float:
    """Distance of a flexure to its neighbour; minus the root of their common area if they overlap.

    ``centre`` is that of the ring.

    -inf for a polygon that crosses itself: an edge has folded over.
    """
    if not polygon.is_valid:
        return -math.inf
    neighbour = shapely.affinity.rotate(
        polygon, 2.0 * math.pi / count, origin=centre, use_radians=True
    )
    distance = float(polygon.distance(neighbour))
    if distance > 0.0:
        return distance
    return -math.sqrt(float(polygon.intersection(neighbour).area))
