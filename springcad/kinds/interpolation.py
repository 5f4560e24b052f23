"""Rising curves through given points, twice continuously differentiable."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BPoly, CubicSpline, PchipInterpolator, PPoly

Floats = NDArray[np.float64]

ROUND_OFF = 1e-9
"""A slope may be negative by this share of the mean slope and counts as 0."""
_STEEPEST = 1.25
"""Slope at a point over the smaller chord slope beside it; to 1.25 a rising quintic exists."""


def rising_curve(x: Floats, y: Floats) -> tuple[PPoly, str]:
    """A C² curve through points that never fall, and what it is in words.

    It is the not-a-knot cubic spline if that never falls either, else a quintic that is shaped by
    its slopes and curvatures at the points.

    Args:
        x: ascending (P,), two or more.
        y: not descending (P,).
    """
    cubic = CubicSpline(x, y, bc_type="not-a-knot")
    if never_falls(cubic, ROUND_OFF * (y[-1] - y[0]) / (x[-1] - x[0])):
        return cubic, "not-a-knot cubic spline (C2)"
    return _rising_quintic(x, y), "monotone quintic (C2), as the cubic spline would fall"


def positive_curve(x: Floats, y: Floats) -> tuple[PPoly, str]:
    """A C¹ curve through points that are not negative, without going below them; and its words."""
    if len(x) == 2:
        return CubicSpline(x, y), "straight line"
    return PchipInterpolator(x, y), "monotone cubic between points (C1)"


def never_falls(curve: PPoly, allowance: float) -> bool:
    """Whether the slope of a piecewise polynomial is nowhere below −``allowance``."""
    return least(curve.derivative())[1] >= -allowance


def least(curve: PPoly) -> tuple[float, float]:
    """Place and value of the smallest value of a piecewise polynomial over its pieces."""
    turns = curve.derivative().roots(extrapolate=False) if curve.c.shape[0] > 1 else np.zeros(0)
    places = np.concatenate([curve.x, turns[np.isfinite(turns)]])
    values = curve(places)
    # a jump between pieces belongs to both
    ends = np.polyval(curve.c, np.diff(curve.x))
    places, values = np.append(places, curve.x[1:]), np.append(values, ends)
    lowest = int(np.argmin(values))
    return float(places[lowest]), float(values[lowest])


def _rising_quintic(x: Floats, y: Floats) -> PPoly:
    """Quintic Hermite curve whose Bernstein coefficients ascend in each interval.

    That is enough for it to rise (Dougherty, Edelman & Hyman, Math. Comp. 52 (1989) 471). The six
    coefficients ascend if both slopes are >= 0, each at most 1.25 times the chord's, and the second
    derivatives lie in intervals that hold 0: so those of an estimate are brought into them.
    """
    width, chord = np.diff(x), np.diff(y) / np.diff(x)
    beside = np.minimum(np.append(chord, np.inf), np.append(np.inf, chord))
    slope = np.minimum(PchipInterpolator(x, y).derivative()(x), _STEEPEST * beside)
    slope = np.maximum(slope, 0.0) if len(x) > 2 else np.full(2, chord[0])
    room = 10.0 / width * (chord - 0.4 * (slope[:-1] + slope[1:]))
    high = np.minimum(np.append(room, np.inf), np.append(np.inf, 4.0 * slope[1:] / width))
    low = np.maximum(np.append(-4.0 * slope[:-1] / width, -np.inf), np.append(-np.inf, -room))
    bend = np.clip(np.gradient(slope, x), np.minimum(low, 0.0), np.maximum(high, 0.0))
    return PPoly.from_bernstein_basis(BPoly.from_derivatives(x, np.column_stack([y, slope, bend])))
