"""The cubic spline with zero end slopes, and how it changes when a knot moves.

Between knots ``i`` and ``i + 1`` the spline is ``a + b d + c d² + e d³`` with ``d = x - X_i``; its
``coefficients`` have shape (intervals, 4). Lengths in any one unit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ClampedSpline:
    """A spline through the knots (x, y), each (m + 2,), with slopes there; end slopes are zero."""

    x: Floats
    y: Floats
    slope: Floats
    coefficients: Floats

    def __call__(self, x: Floats) -> Floats:
        """Value and first three derivatives at ``x`` (N,): shape (4, N)."""
        return piecewise_cubic(self.x, self.coefficients, x)


def piecewise_cubic(knots: Floats, coefficients: Floats, x: Floats) -> Floats:
    """Value and three derivatives at ``x`` (N,) of cubics (..., intervals, 4): (4, ..., N)."""
    interval = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, knots.size - 2)
    d = x - knots[interval]
    a, b, c, e = (coefficients[..., interval, power] for power in range(4))
    return np.stack(
        (a + d * (b + d * (c + d * e)), b + d * (2 * c + 3 * d * e), 2 * c + 6 * d * e, 6 * e)
    )


def clamped_spline(x: Floats, y: Floats) -> ClampedSpline:
    """Interpolate the knots ``x`` (increasing) and ``y``, shape (m + 2,), m ≥ 1."""
    step = np.diff(x)
    chord = np.diff(y) / step
    right_side = 3 * (chord[:-1] / step[:-1] + chord[1:] / step[1:])
    slope = np.zeros_like(y)
    slope[1:-1] = np.linalg.solve(_continuity(step), right_side)
    return ClampedSpline(x, y, slope, _hermite(step, y, slope))


def knot_derivatives(spline: ClampedSpline) -> Floats:
    """The splines dS/dX_k, then dS/dy_k, of the m interior knots: coefficients (2 m, m + 1, 4).

    dS/dX_k is taken at fixed x. It has the value -S' and the slope -S'' at the moved knot, because
    the knot carries its ordinate and its slope along, plus what the other slopes answer; those
    follow from the continuity of S'' (the tridiagonal system), differentiated.
    """
    x, y, slope = spline.x, spline.y, spline.slope
    step, m = np.diff(x), x.size - 2
    inner = np.arange(m)
    chord = 6 * np.diff(y) / step
    # The residual of knot i under a change of the step to its left, and of the one to its right.
    left = (chord - slope[:-1] - 2 * slope[1:]) / step**2
    right = (chord - 2 * slope[:-1] - slope[1:]) / step**2

    residual = np.zeros((m, 2 * m))
    residual[inner, inner] = left[:-1] - right[1:]
    residual[inner[1:], inner[:-1]] = -left[1:-1]
    residual[inner[:-1], inner[1:]] = right[1:-1]
    pull = 3 / step**2
    residual[inner, m + inner] = pull[1:] - pull[:-1]
    residual[inner[1:], m + inner[:-1]] = pull[1:-1]
    residual[inner[:-1], m + inner[1:]] = -pull[1:-1]

    value, change = np.zeros((2 * m, m + 2)), np.zeros((2 * m, m + 2))
    value[inner, 1 + inner] = -slope[1:-1]
    value[m + inner, 1 + inner] = 1.0
    change[:, 1:-1] = -np.linalg.solve(_continuity(step), residual).T
    change[inner, 1 + inner] -= 2 * spline.coefficients[1:, 2]
    return _hermite(step, value, change)


def _continuity(step: Floats) -> Floats:
    """Matrix of the condition that S'' is continuous at the interior knots, for their slopes."""
    inverse = 1 / step
    matrix = np.diag(2 * (inverse[:-1] + inverse[1:]))
    off = np.arange(step.size - 2)
    matrix[off, off + 1] = matrix[off + 1, off] = inverse[1:-1]
    return matrix


def _hermite(step: Floats, value: Floats, slope: Floats) -> Floats:
    """Coefficients (..., intervals, 4) from values and slopes (..., knots)."""
    chord = np.diff(value) / step
    start, end = slope[..., :-1], slope[..., 1:]
    square = (3 * chord - 2 * start - end) / step
    cube = (start + end - 2 * chord) / step**2
    return np.stack((value[..., :-1], start, square, cube), axis=-1)
