"""What the judges of all kinds share: numbers that repeat, and the drawing beside the mesh."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from springcad.geometry.polyline import BulgePolyline, flatten, signed_area
from springcad.written import IncompleteDesignError, WrittenDesign

Floats = NDArray[np.float64]

OUTLINE_TOLERANCE = 3e-6
"""How far a mesh may lie from the part as drawn (m): drawings follow the design within 2 um."""
_CHORD = 1e-8


def snapped(value: float) -> float:
    """Six digits: what differs beyond them between linear algebra libraries says nothing."""
    return float(f"{value:.5e}")


def drawn_outline(written: WrittenDesign, part: str, suffix: str = "") -> BulgePolyline:
    """The outer contour of a part's drawing; IncompleteDesignError where there is none."""
    contours = written.contours.get(suffix, ())
    if not contours:
        raise IncompleteDesignError(f"the drawing of the {part} lacks its contour")
    return max(contours, key=lambda line: abs(signed_area(line)))


def distance_from(outline: BulgePolyline, points: Floats) -> float:
    """Largest distance (m) of points (N, 2) from a closed outline."""
    corners = flatten(outline, _CHORD)
    chords = shapely.linestrings(np.stack([corners, np.roll(corners, -1, axis=0)], axis=1))
    _, distance = shapely.STRtree(chords).query_nearest(
        shapely.points(points), return_distance=True, all_matches=False
    )
    return float(distance.max())
