"""Constraint rows that the forms of the centre line share: zone minima with their gradients.

A minimum over the whole flexure has kinks that stop a quasi-Newton search. The minimum of each
zone is nearly always one smooth row, and the rows together say the same.
"""

from __future__ import annotations

import numpy as np

from springcad.geometry.neighbours import Indices, neighbour_gaps, zone_gaps, zone_minimum
from springcad.optimise import dual
from springcad.optimise.dual import Dual


def gap_rows(
    x: Dual, y: Dual, half_thickness: Dual, root_radius: float, count: int, zones: Indices
) -> Dual:
    """Smallest clearance to the neighbour in each zone; see ``neighbour_gaps``."""
    points = neighbour_gaps(x.value, y.value, half_thickness.value, root_radius, count)
    gaps = zone_gaps(points, zones)
    i, j = gaps.point, gaps.partner
    gradient = (
        gaps.own[:, :1] * x.gradient[i]
        + gaps.own[:, 1:] * y.gradient[i]
        + gaps.other[:, :1] * x.gradient[j]
        + gaps.other[:, 1:] * y.gradient[j]
        - half_thickness.gradient[i]
        - half_thickness.gradient[j]
    )
    return Dual(gaps.gap, gradient)


def bend_rows(bend: Dual, limit: float, zones: Indices) -> Dual:
    """``limit - |half thickness x curvature|`` where it is smallest in each zone."""
    sharpest = zone_minimum(-np.abs(bend.value), zones)
    return limit - dual.absolute(bend[sharpest])
