"""One leaf under one roller as paper 003 has it: a linear beam, loaded at its effective length.

All torques, stiffnesses and energies are of one leaf; the paper's Table 1 needs two per axis.
Angles [rad] and lengths [m] may be arrays that fit together (numpy broadcasting); the results
have their common shape. Formulas are odd (torque) or even (stiffness, energy) in the angle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springcad.kinds.leaf_2dof.leaf import Leaf, Lever

Floats = NDArray[np.float64]


def force(leaf: Leaf, lever: Lever, length: ArrayLike, angle: ArrayLike) -> Floats:
    """F = 3 EI R sin φ/L³ [N], positive for either direction (003, Eq. 6)."""
    sine = np.sin(np.abs(np.asarray(angle, dtype=np.float64)))
    return np.asarray(3.0 * leaf.bending_stiffness * lever.radius * sine / np.power(length, 3.0))


def torque(leaf: Leaf, lever: Lever, length: ArrayLike, angle: ArrayLike) -> Floats:
    """M = F (R cos φ − r sin φ) [N m], with the sign of the angle (003, Eqs 13, 14).

    The arm is that of a force which stays upright on a point of the lever; the force of a roller
    turns with the leaf (``unit``).
    """
    size = np.abs(np.asarray(angle, dtype=np.float64))
    arm = lever.radius * np.cos(size) - lever.roller_radius * np.sin(size)
    return np.asarray(np.sign(angle) * force(leaf, lever, length, size) * arm)


def stiffness(leaf: Leaf, lever: Lever, length: ArrayLike, angle: ArrayLike) -> Floats:
    """K = 3 EI (R² cos 2φ − R r sin 2|φ|)/L³ [N m/rad] (003, Eq. 16, which lacks the bars)."""
    twice = 2.0 * np.abs(np.asarray(angle, dtype=np.float64))
    R, r = lever.radius, lever.roller_radius
    shape = R * R * np.cos(twice) - R * r * np.sin(twice)
    return np.asarray(3.0 * leaf.bending_stiffness * shape / np.power(length, 3.0))


def energy(leaf: Leaf, lever: Lever, length: ArrayLike, angle: ArrayLike) -> Floats:
    """∫ M dφ from rest [J], with M of Eq. 14."""
    size = np.abs(np.asarray(angle, dtype=np.float64))
    R, r = lever.radius, lever.roller_radius
    shape = 0.5 * R * np.sin(size) ** 2 - r * (0.5 * size - 0.25 * np.sin(2.0 * size))
    return np.asarray(3.0 * leaf.bending_stiffness * R * shape / np.power(length, 3.0))


def bend_angle(lever: Lever, length: ArrayLike, angle: ArrayLike) -> Floats:
    """Slope θ of the leaf at the roller [rad], with tan θ = F L²/2EI = 3 R sin φ/(2L).

    Paper 003 has θ = F L²/2EI in Eq. 3 and its tangent in Eq. 8; the tangent is kept.
    """
    sine = np.sin(np.abs(np.asarray(angle, dtype=np.float64)))
    return np.asarray(np.arctan(1.5 * lever.radius * sine / np.asarray(length)))


def deflection_at_bend(lever: Lever, length: ArrayLike, bend: ArrayLike) -> Floats:
    """φ = asin(2 L tan θ/(3 R)) [rad] at the bend angle θ (003, Eq. 8).

    π/2, the most that a lever can do, where no angle bends the leaf so far.
    """
    sine = 2.0 * np.asarray(length) * np.tan(bend) / (3.0 * lever.radius)
    return np.asarray(np.arcsin(np.minimum(sine, 1.0)))


def stress(leaf: Leaf, lever: Lever, length: ArrayLike, angle: ArrayLike) -> Floats:
    """σ = 6 F L/(a b²) [Pa] at the clamp (003, Eq. 10)."""
    load = force(leaf, lever, length, angle)
    return np.asarray(6.0 * load * np.asarray(length) / (leaf.width * leaf.thickness**2))


def least_length(leaf: Leaf, bend: ArrayLike, stress_limit: ArrayLike) -> Floats:
    """L = E b tan θ/σ [m], the shortest length that may be bent to θ (003, Eqs 11, 12)."""
    slope = np.tan(np.asarray(bend, dtype=np.float64))
    return np.asarray(leaf.elastic_modulus * leaf.thickness * slope / np.asarray(stress_limit))


def deflection_at_stress(
    leaf: Leaf, lever: Lever, length: ArrayLike, stress_limit: ArrayLike
) -> Floats:
    """φ = asin(2 L² σ/(3 E b R)) [rad] at which the clamp reaches the stress (Eqs 6, 10).

    Quadratic in L, where Eq. 8 with a fixed θ is linear. π/2 where the stress is not reached.
    """
    scale = 3.0 * leaf.elastic_modulus * leaf.thickness * lever.radius
    sine = 2.0 * np.asarray(length, dtype=np.float64) ** 2 * np.asarray(stress_limit) / scale
    return np.asarray(np.arcsin(np.minimum(sine, 1.0)))
