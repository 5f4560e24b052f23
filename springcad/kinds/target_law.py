"""Torque over angle that a joint is to have: exponential, polynomial, table or stiffness.

A law is given over the angle from the end of the dead zone, up to which there is no torque. Every
antiderivative is exact: the contact profile follows from torque *and* energy.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly

from springcad.kinds.interpolation import positive_curve, rising_curve
from springcad.mechanics.torque_law import TorqueLaw

Floats = NDArray[np.float64]
Curve = Callable[[Floats], Floats]

OVERRUN = 0.15
"""Share of the deflection by which a law goes on beyond it, for the end of the profile."""


@dataclass(frozen=True)
class Rise:
    """A law over the angle from the end of its dead zone, x >= 0; curves of arrays of any shape.

    Attributes:
        torque: τ(x) [N m], 0 at 0.
        energy: the integral of τ from 0 [J].
        stiffness: dτ/dx [N m/rad].
        words: one line for people, with the interpolation.
        points: given x and τ, or none (P, 2).
    """

    torque: Curve
    energy: Curve
    stiffness: Curve
    words: str
    points: Floats


@dataclass(frozen=True)
class Law:
    """A law over the magnitude of the angle from rest; both directions alike.

    Attributes:
        deflection: largest angle, dead zone included [rad]; the curves go on smoothly beyond it.
        dead_zone: angle up to which the torque is 0 [rad].
        torque [N m], energy [J], stiffness [N m/rad]: of arrays of angles. At the end of the dead
            zone the stiffness is that of what follows.
        words: one line for people, with the interpolation.
        points: angle from rest and torque of each given point, or none (P, 2).
    """

    deflection: float
    dead_zone: float
    torque: Curve
    energy: Curve
    stiffness: Curve
    words: str
    points: Floats


def law_of(rise: Rise, deflection: float, *, dead_zone: float = 0.0, share: float = 1.0) -> Law:
    """The law that begins at the end of the dead zone and has ``share`` of the torque of ``rise``.

    ``share`` is 1 for a law of one group, and one over their number for a law of the joint.
    """

    def after_dead_zone(curve: Curve) -> Curve:
        def of_angle(angle: Floats) -> Floats:
            x = np.asarray(angle, dtype=np.float64) - dead_zone
            return np.where(x < 0.0, 0.0, share * curve(np.maximum(x, 0.0)))

        return of_angle

    return Law(
        deflection=deflection,
        dead_zone=dead_zone,
        torque=after_dead_zone(rise.torque),
        energy=after_dead_zone(rise.energy),
        stiffness=after_dead_zone(rise.stiffness),
        words=rise.words,
        points=rise.points * [1.0, share] + [dead_zone, 0.0],
    )


def sampled(law: Law, angle: Floats) -> TorqueLaw:
    """The law at ascending angles, as the conjugate solver takes it; none in the dead zone."""
    at_rest = float(law.stiffness(np.array([law.dead_zone]))[0])
    return TorqueLaw(angle, law.torque(angle), law.energy(angle), at_rest)


def exponential(scale: float, decade: float) -> Rise:
    """τ = scale (10^(x/decade) − 1) (001, section 4.3, with 3/20 N m and 1 deg)."""
    rate = math.log(10.0) / decade
    return Rise(
        torque=lambda x: scale * np.expm1(rate * x),
        energy=lambda x: scale * (np.expm1(rate * x) / rate - x),
        stiffness=lambda x: scale * rate * np.exp(rate * x),
        words=f"{scale:.6g} N*m (10^(angle/{math.degrees(decade):.6g} deg) - 1)",
        points=np.zeros((0, 2)),
    )


def polynomial(coefficients: Sequence[float], end: float) -> Rise:
    """τ = c₁ x + c₂ x² + … up to ``end``, with cₙ in N m/radⁿ."""
    powers = [*coefficients[::-1], 0.0]
    torque = PPoly(np.array(powers)[:, None], np.array([0.0, end]))
    degree = len(coefficients)
    words = f"polynomial of degree {degree}" if degree > 1 else f"{powers[0]:.6g} N*m/rad, constant"
    return _continued(torque, words, np.zeros((0, 2)))


def table(points: Floats) -> Rise:
    """Through angles and torques (P, 2): ascending angles, torques that never fall, 0 at 0."""
    torque, how = rising_curve(points[:, 0], points[:, 1])
    return _continued(torque, f"table of {len(points)} points, {how}", points)


def stiffness_polynomial(coefficients: Sequence[float], end: float) -> Rise:
    """Stiffness k₀ + k₁ x + … up to ``end``, with kₙ in N m/radⁿ⁺¹; the torque is its integral."""
    integrated = [factor / (power + 1.0) for power, factor in enumerate(coefficients)]
    rise = polynomial(integrated, end)
    degree = len(coefficients) - 1
    words = f"stiffness a polynomial of degree {degree}, integrated"
    return Rise(rise.torque, rise.energy, rise.stiffness, words, rise.points)


def stiffness_table(points: Floats) -> Rise:
    """Stiffness through angles and stiffnesses (P, 2), >= 0, from 0 on; the torque is its integral.

    The stiffness is C¹ and so the torque is C².
    """
    stiffness, how = positive_curve(points[:, 0], points[:, 1])
    torque = stiffness.antiderivative()
    words = f"stiffness at {len(points)} points, {how}, integrated: torque C2"
    return _continued(torque, words, np.column_stack([points[:, 0], torque(points[:, 0])]))


def _continued(torque: PPoly, words: str, points: Floats) -> Rise:
    """A piecewise torque, continued beyond its last point with the slope of its stiffness there.

    That slope s fades over a length L: k = k₁ + s L (1 − exp(−d/L)) at the distance d. With
    L <= k₁/|s| it stays positive, and finite whatever the last piece does.
    """
    energy, stiffness = torque.antiderivative(), torque.derivative()
    end = torque.x[-1]
    torque_1, energy_1, k_1, s = (
        float(curve(end)) for curve in (torque, energy, stiffness, stiffness.derivative())
    )
    k_1 = max(k_1, 0.0)
    fade = min(OVERRUN * end, k_1 / abs(s)) if s else OVERRUN * end
    if fade == 0.0:
        fade, s = OVERRUN * end, 0.0

    def beyond(x: Floats, within: PPoly, continuation: Curve) -> Floats:
        d = np.maximum(x - end, 0.0)
        return np.where(x <= end, within(np.minimum(x, end)), continuation(d))

    def risen(d: Floats) -> Floats:
        return np.asarray(-s * fade * np.expm1(-d / fade))

    return Rise(
        torque=lambda x: beyond(
            x, torque, lambda d: torque_1 + (k_1 + s * fade) * d - fade * risen(d)
        ),
        energy=lambda x: beyond(
            x,
            energy,
            lambda d: energy_1 + torque_1 * d + (k_1 + s * fade) * d**2 / 2.0
            - fade * (s * fade * d - fade * risen(d)),
        ),
        stiffness=lambda x: beyond(x, stiffness, lambda d: k_1 + risen(d)),
        words=words,
        points=points,
    )  # fmt: skip
