"""Dry friction between an elastic part and its profile: loading, unloading and what is lost.

Coulomb's law with one coefficient and full sliding: the tangential force on the mate of the profile
has the direction in which the profile drags it, and turns round when the motion does. The short
stick at the turning point is left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.cam_contact import Seat
from springcad.mechanics.conjugate import Flank

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class FrictionLoop:
    """Torque of all parts while the angle grows and while it falls; arrays (A,), SI.

    Attributes:
        angle: magnitudes, ascending.
        loading, unloading: torque against the motion and with it [N m].
        loss: energy lost from zero to the last angle and back [J].
        sliding_work: the same loss from force, coefficient and sliding speed of the frictionless
            contact, a second way that needs no forward solution [J].
    """

    angle: Floats
    loading: Floats
    unloading: Floats
    loss: float
    sliding_work: float

    @property
    def loss_share(self) -> float:
        """Loss of a cycle over the work of loading."""
        return self.loss / _integral(self.angle, self.loading)


def sliding_path(flank: Flank) -> float:
    """Length that a part slides along the profile from rest to the last angle [m]."""
    return _integral(flank.angle, np.abs(flank.sliding))


def sliding_loss(flank: Flank, count: int) -> float:
    """Energy lost in a cycle per unit of a small coefficient of friction, 2 n ∫ F |v| dθ [J].

    F and the sliding speed v are those of the frictionless contact of ``count`` parts.
    """
    return 2.0 * count * _integral(flank.angle, flank.force * np.abs(flank.sliding))


def friction_loop(
    flank: Flank, ahead: Seat, behind: Seat, coefficient: float, *, count: int
) -> FrictionLoop:
    """Put together the loop of ``count`` parts from two forward solutions.

    Args:
        flank: the frictionless contact; its sliding says which way the profile drags the part.
        ahead, behind: the parts seated on the profile with the tangential force ``coefficient``
            times the normal one on the mate along its tangent (``ContactState``), and against it.
        coefficient: Coulomb's, >= 0.
    """
    pushed, pulled = (
        np.interp(flank.angle, np.append(0.0, seat.angle), np.append(0.0, seat.torque))
        for seat in (ahead, behind)
    )
    slides_ahead = flank.sliding > 0.0
    loading = np.where(slides_ahead, pulled, pushed)
    unloading = np.where(slides_ahead, pushed, pulled)
    return FrictionLoop(
        angle=flank.angle,
        loading=loading,
        unloading=unloading,
        loss=_integral(flank.angle, loading - unloading),
        sliding_work=coefficient * sliding_loss(flank, count),
    )


def _integral(angle: Floats, values: Floats) -> float:
    """Trapezoidal integral from angle 0, where all that is integrated vanishes."""
    return float(np.trapezoid(np.append(0.0, values), np.append(0.0, angle)))
