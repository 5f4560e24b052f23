"""Stress and slope of a bent leaf by a formula, close enough to size it and to search with.

The linear leaf of paper 003 with two corrections. The roller's contact moves along the leaf, which
counts most for short leaves; this is geometry. And the force turns with a strongly bent leaf: with
q = w/ξ the elastica under an end force normal to its end has, to second order, the slope
3q/2 (1 − 9q²/28) and the moment 3 EI w/ξ² (1 − 15q²/14) at its clamp. Written as 1/(1 + …) these
hold far beyond: within 0.6 % up to q = 0.5 (a slope of 40 deg) and 1.1 % up to 0.7, for strains up
to 1 %, either clamp and any size. The torque follows from slope and reach.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from springcad.kinds.leaf_2dof.leaf import Leaf, Lever

ESTIMATE_ERROR = 0.01
"""Share by which the estimates may be wrong."""
STROKE_ERROR = 0.015
"""Share by which the angle at which the torque peaks may be wrong."""
_OF_SLOPE, _OF_MOMENT = 9.0 / 28.0, 15.0 / 14.0
_STEP = 1e-4  # of the angle
_PASSES = 30
_SETTLED = 1e-9


class Bend(NamedTuple):
    """How a roller bends a leaf.

    Attributes:
        deflection: w of the leaf at the contact (m).
        reach: ξ, distance of the contact from the clamp along the unbent leaf (m).
        slope: θ of the leaf at the contact (rad).
    """

    deflection: float
    reach: float
    slope: float


def bend(leaf: Leaf, lever: Lever, length: float, angle: float) -> Bend | None:
    """At an effective length and an angle > 0; None where the leaf would bend by more than 45°."""
    away = 1.0 if lever.clamp == "outboard" else -1.0
    R, offset = lever.radius, lever.roller_radius + 0.5 * leaf.thickness
    slope = 0.0
    for _ in range(_PASSES):
        reach = length + away * R * (1.0 - math.cos(angle)) - offset * math.sin(slope)
        deflection = R * math.sin(angle) + offset * (math.cos(slope) - 1.0)
        if not 0.0 < deflection < reach:
            return None
        q = deflection / reach
        before, slope = slope, 1.5 * q / (1.0 + _OF_SLOPE * q * q)
        if abs(slope - before) < _SETTLED:
            break
    return Bend(deflection, reach, slope)


def stress(leaf: Leaf, lever: Lever, length: float, angle: float) -> float:
    """At the clamp: 3 E b w/(2 ξ² (1 + 15q²/14)) [Pa]; infinite where ``bend`` knows none."""
    bent = bend(leaf, lever, length, angle)
    if bent is None:
        return math.inf
    q = bent.deflection / bent.reach
    linear = 1.5 * leaf.elastic_modulus * leaf.thickness * bent.deflection / bent.reach**2
    return linear / (1.0 + _OF_MOMENT * q * q)


def stiffness(leaf: Leaf, lever: Lever, length: float, angle: float) -> float:
    """Derivative of the torque of one leaf [N m/rad], negative beyond the torque's peak.

    Minus infinity where ``bend`` knows no leaf. The peak is within STROKE_ERROR of the exact
    unit's, for lengths from 0.8 arms on.
    """
    ends = [_torque(leaf, lever, length, angle * (1.0 + way * _STEP)) for way in (1.0, -1.0)]
    if math.isinf(ends[0]) or math.isinf(ends[1]):
        return -math.inf
    return (ends[0] - ends[1]) / (2.0 * _STEP * angle)


def _torque(leaf: Leaf, lever: Lever, length: float, angle: float) -> float:
    """F R cos(φ ± θ) with F = 2 θ EI (1 + θ²/30)/ℓ² and ℓ = ξ (1 + 4θ²/15), to second order."""
    bent = bend(leaf, lever, length, angle)
    if bent is None:
        return -math.inf
    square = bent.slope**2
    arc = bent.reach * (1.0 + 4.0 * square / 15.0)
    force = 2.0 * bent.slope * leaf.bending_stiffness / arc**2 * (1.0 + square / 30.0)
    turned = angle + bent.slope if lever.clamp == "outboard" else angle - bent.slope
    return force * lever.radius * math.cos(turned)
