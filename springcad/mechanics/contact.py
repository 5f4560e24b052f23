"""Line contact of two cylinders, or of a cylinder and a plane (Hertz)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def contact_modulus(
    elastic_modulus: float, poisson_ratio: float, other_modulus: float, other_ratio: float
) -> float:
    """E* [Pa] with 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ (Johnson, Contact Mechanics, Eq. 4.6)."""
    return 1.0 / (
        (1.0 - poisson_ratio**2) / elastic_modulus + (1.0 - other_ratio**2) / other_modulus
    )


def half_width(
    force: ArrayLike, width: float, relative_curvature: ArrayLike, modulus: float
) -> Floats:
    """Half width b = √(4 F /(π w E* κ)) [m] of the contact strip (Johnson, Eq. 4.43).

    Args:
        force: normal force [N], >= 0.
        width: length of the line of contact, the thickness of the sheet [m].
        relative_curvature: κ₁ + κ₂ [1/m], convex positive; > 0.
        modulus: E* from ``contact_modulus`` [Pa].
    """
    load = np.asarray(force, dtype=np.float64) / width
    curvature = np.asarray(relative_curvature, dtype=np.float64)
    return np.sqrt(4.0 * load / (np.pi * modulus * curvature))


def peak_pressure(
    force: ArrayLike, width: float, relative_curvature: ArrayLike, modulus: float
) -> Floats:
    """Largest pressure p₀ = √(F E* κ/(π w)) [Pa] in the strip (Johnson, Eq. 4.45).

    Arguments as for ``half_width``; also 0 for κ = 0.
    """
    load = np.asarray(force, dtype=np.float64) / width
    curvature = np.asarray(relative_curvature, dtype=np.float64)
    return np.sqrt(load * modulus * curvature / np.pi)
