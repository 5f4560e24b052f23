"""Offset curves: the two edges of a curved ribbon of varying thickness, and pieces moved sideways.

With the centre line p(s), its tangent t, left normal n and curvature κ (n' = -κ t), the edges are
p ± λ n and their derivatives (1 ∓ κ λ) t ± λ' n. An edge folds over where |κ| λ reaches 1.
"""

from __future__ import annotations

import math

import numpy as np

from springcad.geometry.outline import Arc, Curve, Floats, Line, Piece


def fold_over(curvature: Floats, half_thickness: Floats) -> float:
    """Largest |κ| λ along the ribbon; the edges are smooth only while this is below 1."""
    return float(np.max(np.abs(curvature) * half_thickness))


def ribbon_edges(
    centre_line: Floats,
    normals: Floats,
    curvature: Floats,
    half_thickness: Floats,
    thickness_slope: Floats,
) -> tuple[Curve, Curve]:
    """Left and right edge of a ribbon, both along increasing arc length, with exact tangents.

    Args:
        centre_line: points p (N, 2) in m.
        normals: unit normals n (N, 2), to the left of the direction of travel.
        curvature: κ (N,) in 1/m, positive where the line turns to the left.
        half_thickness: λ (N,) in m.
        thickness_slope: dλ/ds (N,), dimensionless.

    Raises:
        ValueError: an edge folds over (|κ| λ >= 1).
    """
    worst = fold_over(curvature, half_thickness)
    if not worst < 1.0:
        raise ValueError(f"ribbon folds over: half thickness times curvature is {worst:.3g}")
    tangents = np.column_stack((normals[:, 1], -normals[:, 0]))

    def edge(side: float) -> Curve:
        along = (1.0 - side * curvature * half_thickness)[:, None] * tangents
        derivative = along + (side * thickness_slope)[:, None] * normals
        unit = derivative / np.hypot(*derivative.T)[:, None]
        return Curve(centre_line + (side * half_thickness)[:, None] * normals, unit)

    return edge(1.0), edge(-1.0)


def sideways(piece: Piece, distance: float) -> Piece:
    """A piece of an outline moved along its normal to the right of the direction of travel.

    The material of an outer contour, run counter-clockwise, lies on its left: so much of it, in
    metres, is left on, or taken off where ``distance`` is negative.

    Raises:
        ValueError: an arc with its centre on the right is smaller than the distance, or one with
            its centre on the left smaller than what is taken off.
    """
    match piece:
        case Line(start, end):
            length = math.dist(start, end)
            x = distance * (end[1] - start[1]) / length
            y = distance * (start[0] - end[0]) / length
            return Line((start[0] + x, start[1] + y), (end[0] + x, end[1] + y))
        case Arc(center, radius, start_angle, sweep):
            moved = radius + math.copysign(1.0, sweep) * distance
            if moved <= 0.0:
                raise ValueError(f"an arc of {radius} m cannot be moved by {distance} m")
            return Arc(center, moved, start_angle, sweep)
        case Curve(points, tangents):
            right = np.column_stack([tangents[:, 1], -tangents[:, 0]])
            return Curve(points + distance * right, tangents)
