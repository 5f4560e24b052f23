"""The 8-node serendipity quadrilateral, the 3-node edge and their integration points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
"""Reference coordinates of the corner nodes 1-4."""

MID_SIDES = np.array([[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]])
"""Reference coordinates of the mid-side nodes 5-8."""


def gauss_points(order: int = 3) -> tuple[Floats, Floats]:
    """Points (order², 2) and weights (order²,) of the Gauss rule on the square [−1, 1]²."""
    x, w = np.polynomial.legendre.leggauss(order)
    points = np.stack(np.meshgrid(x, x, indexing="ij"), axis=-1).reshape(-1, 2)
    return points, np.outer(w, w).ravel()


def shape_functions(points: Floats) -> tuple[Floats, Floats]:
    """Shape functions (G, 8) and their derivatives (G, 2, 8) at reference points (G, 2)."""
    x, y = points[:, :1], points[:, 1:]
    cx, cy = CORNERS.T
    corner = 0.25 * (1.0 + x * cx) * (1.0 + y * cy) * (x * cx + y * cy - 1.0)
    corner_x = 0.25 * cx * (1.0 + y * cy) * (2.0 * x * cx + y * cy)
    corner_y = 0.25 * cy * (1.0 + x * cx) * (2.0 * y * cy + x * cx)

    mx, my = MID_SIDES.T
    flat = mx == 0.0
    middle = np.where(
        flat, 0.5 * (1.0 - x**2) * (1.0 + y * my), 0.5 * (1.0 + x * mx) * (1.0 - y**2)
    )
    middle_x = np.where(flat, -x * (1.0 + y * my), 0.5 * mx * (1.0 - y**2))
    middle_y = np.where(flat, 0.5 * my * (1.0 - x**2), -y * (1.0 + x * mx))

    value = np.concatenate([corner, middle], axis=1)
    slope_x = np.concatenate([corner_x, middle_x], axis=1)
    slope_y = np.concatenate([corner_y, middle_y], axis=1)
    return value, np.stack([slope_x, slope_y], axis=1)


def edge_shape_functions(x: Floats) -> tuple[Floats, Floats]:
    """Shape functions of the edge (start, middle, end) and derivatives, both (G, 3), at x (G,)."""
    value = np.stack([0.5 * x * (x - 1.0), 1.0 - x**2, 0.5 * x * (x + 1.0)], axis=1)
    return value, np.stack([x - 0.5, -2.0 * x, x + 0.5], axis=1)
