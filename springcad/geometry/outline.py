"""Closed planar outlines made of smooth pieces, and the parts that they bound.

An outline is a chain of pieces, each smooth, joined end to start; corners exist only between
pieces. Units are metres. Right-handed plane: a positive turn is counter-clockwise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Line:
    """Straight from ``start`` to ``end``."""

    start: tuple[float, float]
    end: tuple[float, float]


@dataclass(frozen=True)
class Arc:
    """Circular arc from ``start_angle`` through the signed angle ``sweep`` (rad, CCW positive)."""

    center: tuple[float, float]
    radius: float
    start_angle: float
    sweep: float


@dataclass(frozen=True)
class Curve:
    """A smooth curve through ``points`` (N, 2) with unit ``tangents`` (N, 2) along its direction.

    The points are dense: between two of them the curve is the G1 biarc of points and tangents.
    """

    points: Floats
    tangents: Floats


Piece = Line | Arc | Curve


@dataclass(frozen=True)
class Outline:
    """A closed chain of pieces; each begins where the one before it ends, the last at the first."""

    pieces: tuple[Piece, ...]


@dataclass(frozen=True)
class Circle:
    """A full circle: a bore, a rim, a dowel hole."""

    center: tuple[float, float]
    radius: float


Contour = Outline | Circle


@dataclass(frozen=True)
class Profile:
    """A flat part: one outer contour and any number of inner ones."""

    outer: Contour
    inner: tuple[Contour, ...] = ()
