"""The contact profile as its drawing has it: arcs within a tolerance that the torque can bear."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.biarc import DEFAULT_TOLERANCE, arc_point, fit_curve
from springcad.geometry.outline import Arc, Curve
from springcad.kinds.roller_cam.curve import ProfileCurve, curve_through
from springcad.kinds.roller_cam.element import ElementGeometry

Floats = NDArray[np.float64]

FINEST = 1e-8
"""Smallest tolerance of a drawing (m): it is rounded to a nanometre."""
TIGHTER = 0.4
"""Factor by which a tolerance is lowered that the torque cannot bear."""
_STEP = 5e-6
_CUBIC = 3


@dataclass(frozen=True)
class DrawnProfile:
    """The profile as arcs.

    Attributes:
        tolerance: how far the arcs may lie from the design (m).
        curve: through dense points of the arcs, from the profile's upper end.
        upper: place of that end on the designed curve (m).
        torque_change: largest change of the torque that the arcs cause, over the full torque.
    """

    tolerance: float
    curve: ProfileCurve
    upper: float
    torque_change: float = math.nan


def drawn_profile(geometry: ElementGeometry, upper: float, tolerance: float) -> DrawnProfile:
    """The profile of an element as lines and arcs within ``tolerance`` (m)."""
    points: list[Floats] = []
    for piece in fit_curve(Curve(geometry.points, geometry.tangents), tolerance):
        if isinstance(piece, Arc):
            count = max(int(np.ceil(abs(piece.sweep) * piece.radius / _STEP)), 1)
            points += [np.array(arc_point(piece, k / count)) for k in range(count)]
        else:
            start, end = np.array(piece.start), np.array(piece.end)
            count = max(int(np.ceil(np.hypot(*(end - start)) / _STEP)), 1)
            points += [start + (end - start) * k / count for k in range(count)]
    curve, _ = curve_through(np.stack([*points, geometry.points[-1]]), _CUBIC)
    return DrawnProfile(tolerance, curve, upper)


def tolerance_for(torque: float, sensitivity: Floats) -> float:
    """Uniform offset (m) that changes the torque by no more than ``torque``, within the limits.

    Args:
        sensitivity: torque per offset of the profile at every angle (A,) [N m/m].
    """
    return float(np.clip(torque / np.max(sensitivity), FINEST, DEFAULT_TOLERANCE))
