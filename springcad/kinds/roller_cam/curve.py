"""A contact profile as a smooth curve through its contacts, in the frame of the tip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline, make_interp_spline

from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]

QUINTIC = 5
_DENSE = 800


@dataclass(frozen=True)
class ProfileCurve:
    """The profile from its first contact on, the material to its left.

    Attributes:
        spline: points over the place, the length of the chords between contacts, from 0 [m].
    """

    spline: BSpline

    @property
    def length(self) -> float:
        """Place of the last contact [m]."""
        return float(self.spline.t[-1])

    def points(self, place: Floats) -> Floats:
        """Points (M, 2) at places (M,); before 0 and beyond the length on the end tangents."""
        within = np.clip(place, 0.0, self.length)
        return np.asarray(self.spline(within) + (place - within)[:, None] * self.tangents(place))

    def tangents(self, place: Floats) -> Floats:
        """Unit tangents (M, 2) towards larger places."""
        slope = self.spline(np.clip(place, 0.0, self.length), 1)
        return np.asarray(slope / np.hypot(*slope.T)[:, None])

    def normals(self, place: Floats) -> Floats:
        """Unit normals (M, 2) into the material."""
        tangent = self.tangents(place)
        return np.stack([-tangent[:, 1], tangent[:, 0]], axis=-1)

    def curvature(self, place: Floats) -> Floats:
        """Convex positive (M,) [1/m]; 0 on the straight ends."""
        first, second = self.spline(place, 1), self.spline(place, 2)
        cross = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
        within = (place >= 0.0) & (place <= self.length)
        return np.where(within, cross / np.hypot(*first.T) ** 3, 0.0)

    def on_circle(self, beyond: Floats) -> tuple[Floats, Floats]:
        """Points and unit tangents (M, 2) on the last contact's circle of curvature.

        Args:
            beyond: length along it from the last contact (M,) [m].
        """
        end = np.array([self.length])
        turn = self.curvature(end) * beyond
        tangent = np.broadcast_to(self.tangents(end), (len(beyond), 2))
        chord = beyond * np.sinc(0.5 * turn / np.pi)  # sin(x)/x of half the turn
        points = self.points(end) + chord[:, None] * rotated(tangent, 0.5 * turn)
        return points, rotated(tangent, turn)

    def dense(self, count: int = _DENSE) -> Floats:
        """Evenly spaced points (count, 2) that stand for the curve [m]."""
        return self.points(np.linspace(0.0, self.length, count))


def curve_through(points: Floats, degree: int = QUINTIC) -> tuple[ProfileCurve, Floats]:
    """The spline through contacts (A, 2) over their chord length, and their places (A,)."""
    place = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    return ProfileCurve(make_interp_spline(place, points, k=degree)), place
