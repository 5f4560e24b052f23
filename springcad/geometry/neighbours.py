"""Clearance between a flexure and its neighbours in a ring, with gradients for an optimiser.

A flexure is a tube: a centre line of points ``C_i = (x_i, y_i)`` with half thicknesses ``h_i``, in
the flexure frame (origin on the root circle of radius R, x towards the centre of the ring at
(R, 0)). Its neighbour ``C'`` is the same tube turned by 2π/n about (R, 0). The neighbour on the
other side needs no work of its own: it sees the same pairs with i and j exchanged.

The clearance of a pair is ``|C_i - C'_j| - h_i - h_j``. The distance alone grows again once two
centre lines have crossed, so it carries a sign: negative where C_i lies on the wrong side of the
neighbour's tangent at its nearest point j. The test is local (only the nearest point is asked),
which makes the clearance continuous and monotone through contact and through a crossing.
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


class NeighbourGaps(NamedTuple):
    """For each point i of N: its smallest clearance to the neighbour and where that is.

    Attributes:
        gap: signed clearance (N,), m.
        partner: index j of the nearest point of the neighbour (N,).
        own: d gap / d C_i (N, 2), a unit vector.
        other: d gap / d C_j (N, 2), with C_j in the frame of the flexure itself.

    d gap / d h_i = d gap / d h_j = -1. The derivatives are those of the pair (i, partner), which
    is the derivative of the minimum wherever the nearest point is unique (Danskin).
    """

    gap: Floats
    partner: Indices
    own: Floats
    other: Floats


class ZoneGaps(NamedTuple):
    """For each of P zones the smallest of its gaps: the pair (i, j) and the pair's derivatives."""

    gap: Floats
    point: Indices
    partner: Indices
    own: Floats
    other: Floats


def neighbour_gaps(
    x: Floats, y: Floats, half_thickness: Floats, root_radius: float, count: int
) -> NeighbourGaps:
    """Signed clearance of each point of a flexure to the flexure turned by 2π/``count``.

    Points run from root to tip; ``x``, ``y``, ``half_thickness`` have shape (N,), N ≥ 3, in m.
    Points sampled with spacing δ overestimate the clearance of the smooth tubes by up to
    δ²/(4 |C_i - C'_j|).
    """
    turn_cos, turn_sin = cos(2 * pi / count), sin(2 * pi / count)
    along = x - root_radius
    x_other = root_radius + turn_cos * along - turn_sin * y
    y_other = turn_sin * along + turn_cos * y

    # In place: two arrays of N² instead of six keep the work in the cache.
    clearance = x[:, None] - x_other
    clearance *= clearance
    across = y[:, None] - y_other
    across *= across
    clearance += across
    np.sqrt(clearance, out=clearance)
    clearance -= half_thickness
    partner = clearance.argmin(axis=1)

    dx, dy = x - x_other[partner], y - y_other[partner]
    # A distance of zero has no direction; any unit vector will do there.
    distance = np.maximum(np.hypot(dx, dy), 1e-12)
    ahead, behind = np.minimum(partner + 1, x.size - 1), np.maximum(partner - 1, 0)
    side = (x_other[ahead] - x_other[behind]) * dy - (y_other[ahead] - y_other[behind]) * dx
    sign = np.where(side < 0.0, -1.0, 1.0)
    ux, uy = sign * dx / distance, sign * dy / distance
    return NeighbourGaps(
        sign * distance - half_thickness - half_thickness[partner],
        partner,
        np.column_stack((ux, uy)),
        -np.column_stack((turn_cos * ux + turn_sin * uy, turn_cos * uy - turn_sin * ux)),
    )


def zone_index(points: int, zones: int) -> Indices:
    """Cut ``points`` consecutive points into ``zones`` nearly equal runs: indices (zones, k).

    Shorter runs repeat their last point, so that ``values[index]`` is a plain array to reduce.
    """
    edges = np.linspace(0, points, zones + 1).round().astype(np.intp)
    starts, last = edges[:-1, None], edges[1:, None] - 1
    index: Indices = np.minimum(starts + np.arange(int((last - starts).max()) + 1), last)
    return index


def zone_minimum(values: Floats, zones: Indices) -> Indices:
    """Index of the smallest of ``values`` in each zone of ``zone_index``: shape (zones,)."""
    smallest: Indices = zones[np.arange(len(zones)), values[zones].argmin(axis=1)]
    return smallest


def zone_gaps(gaps: NeighbourGaps, zones: Indices) -> ZoneGaps:
    """The smallest gap of each zone: rows ``gap >= d`` in place of one min() with its kinks."""
    point = zone_minimum(gaps.gap, zones)
    return ZoneGaps(gaps.gap[point], point, gaps.partner[point], gaps.own[point], gaps.other[point])
