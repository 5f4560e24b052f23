"""The spherical wrist: from the angles of its two axes to the rod, its torque and its stiffness.

The rod of a wrist at rest points along z. The tangents of the axis angles are those of the rod
seen along y and along x: a₃ ∝ (tan α_y, −tan α_x, 1) (003, Eq. 17, its last component corrected).
Each axis has its own leaves, so the energy is U(α_x, α_y) = U_x(α_x) + U_y(α_y).

Coordinates of the rod: the axis angles themselves; spherical, azimuth η about z and tilt δ from
z; or tangent-plane, small angles of the rod in two directions square to it, which are alike
everywhere. Arrays of axis angles (|α| < π/2) fit together (broadcasting), and their shape leads
all results; torque and stiffness of the axes are (..., 2), x first.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


class Spherical(NamedTuple):
    """Azimuth η and tilt δ of the rod [rad]."""

    azimuth: Floats
    tilt: Floats


class Derivatives(NamedTuple):
    """Of two output coordinates p by the axis angles α.

    ``first`` (..., 2, 2) is J with ∂p_k/∂α_i at [k, i]; ``second`` (..., 2, 2, 2) has
    ∂²p_k/∂α_i∂α_j at [k, i, j].
    """

    first: Floats
    second: Floats


def rod_direction(alpha_x: ArrayLike, alpha_y: ArrayLike) -> Floats:
    """Unit vector a₃ (..., 3) along the rod.

    (cos α_x sin α_y, −sin α_x cos α_y, cos α_x cos α_y)/√(1 − sin² α_x sin² α_y): Eq. 17 of 003,
    which prints sin α_y for the last cos α_y.
    """
    seen = _seen(alpha_x, alpha_y)
    return np.asarray(seen / np.linalg.norm(seen, axis=-1, keepdims=True))


def spherical(alpha_x: ArrayLike, alpha_y: ArrayLike) -> Spherical:
    """Exact: tan δ = √(tan² α_x + tan² α_y), η = atan2(−tan α_x, tan α_y), about z from x."""
    tan_x, tan_y = np.tan(alpha_x), np.tan(alpha_y)
    return Spherical(np.arctan2(-tan_x, tan_y), np.arctan(np.hypot(tan_x, tan_y)))


def spherical_small(alpha_x: ArrayLike, alpha_y: ArrayLike) -> Spherical:
    """η = atan2(α_x, α_y) and δ = √(α_x² + α_y²) (003, Eq. 18): small angles, η the other way."""
    return Spherical(np.arctan2(alpha_x, alpha_y), np.hypot(alpha_x, alpha_y))


def spherical_derivatives(alpha_x: ArrayLike, alpha_y: ArrayLike) -> Derivatives:
    """Of (η, δ) of ``spherical``; without value at rest, where η has none."""
    angles = np.stack(np.broadcast_arrays(alpha_x, alpha_y), axis=-1).astype(np.float64)
    tangent = np.tan(angles)
    slope = 1.0 + tangent**2
    polar = _polar_derivatives(tangent)
    # δ = atan h and η is counted the other way.
    h = np.linalg.norm(tangent, axis=-1)[..., None]
    by_h, by_hh = 1.0 / (1.0 + h**2), -2.0 * h / (1.0 + h**2) ** 2
    gradient = polar.first[..., 1, :]
    outer = gradient[..., :, None] * gradient[..., None, :]
    tilt = by_h[..., None] * polar.second[..., 1, :, :] + by_hh[..., None] * outer
    first = np.stack([-polar.first[..., 0, :], by_h * gradient], axis=-2)
    second = np.stack([-polar.second[..., 0, :, :], tilt], axis=-3)
    # Chain rule from tangents to angles.
    curving = first[..., None] * _diagonal(2.0 * tangent * slope)[..., None, :, :]
    turning = second * (slope[..., :, None] * slope[..., None, :])[..., None, :, :]
    return Derivatives(first * slope[..., None, :], turning + curving)


def spherical_derivatives_small(alpha_x: ArrayLike, alpha_y: ArrayLike) -> Derivatives:
    """Of (η, δ) of ``spherical_small``; ``first`` is Eq. 20 of 003, with α for its a."""
    return _polar_derivatives(
        np.stack(np.broadcast_arrays(alpha_x, alpha_y), axis=-1).astype(np.float64)
    )


def tangent_basis(alpha_x: ArrayLike, alpha_y: ArrayLike) -> Floats:
    """Unit vectors towards more tilt, and a₃ × that, as rows (..., 2, 3); x and y at rest."""
    azimuth, tilt = spherical(alpha_x, alpha_y)
    more = [np.cos(tilt) * np.cos(azimuth), np.cos(tilt) * np.sin(azimuth), -np.sin(tilt)]
    sideways = [-np.sin(azimuth), np.cos(azimuth), np.zeros_like(azimuth)]
    return np.stack([np.stack(more, axis=-1), np.stack(sideways, axis=-1)], axis=-2)


def tangent_derivatives(alpha_x: ArrayLike, alpha_y: ArrayLike) -> Derivatives:
    """Of geodesic coordinates about the rod's direction, in the basis ``tangent_basis`` [rad]."""
    seen, basis = _seen(alpha_x, alpha_y), tangent_basis(alpha_x, alpha_y)
    tangent = np.stack([-seen[..., 1], seen[..., 0]], axis=-1)
    slope = 1.0 + tangent**2
    # a₃ = v/|v|, and the basis e is square to v: ∂(e·a₃) = e·∂v/|v|, and once more.
    size = np.linalg.norm(seen, axis=-1)[..., None]
    toward = np.stack([-basis[..., :, 1], basis[..., :, 0]], axis=-1)
    first = toward * (slope / size)[..., None, :]
    shrink = -tangent * slope / size**2
    mixed = first[..., :, None] * shrink[..., None, None, :]
    curving = first[..., None] * _diagonal(2.0 * tangent)[..., None, :, :]
    return Derivatives(first, curving + mixed + np.swapaxes(mixed, -1, -2))


def output_torque(jacobian: Floats, torque: ArrayLike) -> Floats:
    """M_o = J⁻ᵀ M (..., 2) of the axis torques, from equal power; 003 prints Jᵀ M in Eq. 21."""
    column = np.asarray(torque, dtype=np.float64)[..., None]
    return np.asarray(np.linalg.solve(np.swapaxes(jacobian, -1, -2), column)[..., 0])


def output_stiffness(derivatives: Derivatives, torque: ArrayLike, stiffness: ArrayLike) -> Floats:
    """Hessian of U in the output coordinates (..., 2, 2), geometric term included.

    K_o = J⁻ᵀ [diag(k) − Σ_k M_o,k ∂²p_k/∂α²] J⁻¹. With ``tangent_derivatives`` this is the
    stiffness of the rod [N m/rad] against more tilt and against turning sideways, at rest too.
    """
    outer = output_torque(derivatives.first, torque)
    geometric = np.einsum("...k,...kij->...ij", outer, derivatives.second)
    axes = _diagonal(np.asarray(stiffness, dtype=np.float64))
    return _transformed(derivatives.first, axes - geometric)


def transformed_stiffness(jacobian: Floats, stiffness: ArrayLike) -> Floats:
    """J⁻ᵀ diag(k) J⁻¹ (..., 2, 2) (003, Eq. 22): right only where the axes carry no torque."""
    return _transformed(jacobian, _diagonal(np.asarray(stiffness, dtype=np.float64)))


def solid_angle(limit_x: float, limit_y: float) -> float:
    """Of the directions with |α_x| ≤ limit_x, |α_y| ≤ limit_y [sr]: 4 asin(sin l_x sin l_y)."""
    return 4.0 * float(np.arcsin(np.sin(limit_x) * np.sin(limit_y)))


def workspace_boundary(
    limit_x: float, limit_y: float, rod_length: float, count: int = 40
) -> Floats:
    """Tip of the rod along the edge of its workspace (4·count + 1, 3) [m], closed.

    From the corner (+, +) in (α_x, α_y) over (−, +), (−, −) and (+, −).
    """
    along = np.linspace(1.0, -1.0, count, endpoint=False)
    ones = np.ones(count)
    x = np.concatenate([along, -ones, -along, ones, [1.0]])
    y = np.concatenate([ones, along, -ones, -along, [1.0]])
    return rod_length * rod_direction(limit_x * x, limit_y * y)


def _seen(alpha_x: ArrayLike, alpha_y: ArrayLike) -> Floats:
    """(tan α_y, −tan α_x, 1), along the rod."""
    tan_x, tan_y = np.broadcast_arrays(np.tan(alpha_x), np.tan(alpha_y))
    return np.stack([tan_y, -tan_x, np.ones_like(tan_x)], axis=-1)


def _polar_derivatives(u: Floats) -> Derivatives:
    """Of atan2(u₀, u₁) and |u| by u (..., 2)."""
    x, y = u[..., 0], u[..., 1]
    square = x * x + y * y
    size = np.sqrt(square)
    angle = np.stack([y, -x], axis=-1) / square[..., None]
    unit = u / size[..., None]
    skew, twist = -2.0 * x * y / square**2, (x * x - y * y) / square**2
    by_angle = np.stack(
        [np.stack([skew, twist], axis=-1), np.stack([twist, -skew], axis=-1)], axis=-2
    )
    by_size = (np.eye(2) - unit[..., :, None] * unit[..., None, :]) / size[..., None, None]
    return Derivatives(np.stack([angle, unit], axis=-2), np.stack([by_angle, by_size], axis=-3))


def _diagonal(values: Floats) -> Floats:
    """(..., 2) → (..., 2, 2)."""
    return np.asarray(values[..., None] * np.eye(2))


def _transformed(jacobian: Floats, matrix: Floats) -> Floats:
    inverse = np.linalg.inv(jacobian)
    return np.asarray(np.swapaxes(inverse, -1, -2) @ matrix @ inverse)
