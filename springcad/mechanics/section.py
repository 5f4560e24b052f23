"""Rectangular section of a ribbon: sheet thickness t, width 2λ in the plane of bending.

The sheet thickness is out of the plane; λ is half of what is seen in the drawing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

SHEAR_CORRECTION = 5.0 / 6.0
"""Effective share of the area of a rectangular section in shear (Timoshenko, ν-independent)."""

_SERIES_BELOW = 0.05
_SHIFT_SERIES = np.array([10196 / 155925, 428 / 4725, 44 / 315, 4 / 15, 1.0])


def area(thickness: float, half_thickness: ArrayLike) -> Floats:
    """Area 2 t λ [m²] of the section."""
    return 2.0 * thickness * np.asarray(half_thickness, dtype=np.float64)


def second_moment_of_area(thickness: float, half_thickness: ArrayLike) -> Floats:
    """Second moment of area I = 2 t λ³/3 [m⁴] for in-plane bending (paper 004, before Eq. 1)."""
    return (2.0 / 3.0) * thickness * np.asarray(half_thickness, dtype=np.float64) ** 3


def nominal_bending_stress(
    thickness: float, half_thickness: ArrayLike, moment: ArrayLike
) -> Floats:
    """Edge stress 1.5 |M|/(t λ²) [Pa] of a straight beam under M [N m] (paper 004, Eq. 1)."""
    lam = np.asarray(half_thickness, dtype=np.float64)
    return 1.5 * np.abs(np.asarray(moment, dtype=np.float64)) / (thickness * lam**2)


def curved_beam_factor(curvature_ratio: ArrayLike) -> Floats:
    """Inner-fibre stress over nominal stress of a curved beam with rectangular section.

    Args:
        curvature_ratio: z = λ |κ|, half thickness over radius of the centre line; 0 <= z < 1.

    Returns:
        K(z) = (1 − zη/3)/(η (1 − z)) with η = 3 (1/z − 1/artanh z)/z; 1 for z = 0.
        This is Winkler's curved bar, σ = M (y)/(A e (r_n − y)) at the inner fibre, written for a
        section of depth 2λ (Young, Roark's Formulas for Stress and Strain, 7th ed., table 9.1).
    """
    z = np.asarray(curvature_ratio, dtype=np.float64)
    eta = _neutral_axis_shift(z)
    return (1.0 - z * eta / 3.0) / (eta * (1.0 - z))


def _neutral_axis_shift(z: Floats) -> Floats:
    """η(z); z η/3 is the shift of the neutral axis from the centre line, over λ.

    Near z = 0 the closed form loses all digits, so the power series of η in z² is used there.
    """
    small = z < _SERIES_BELOW
    safe = np.where(small, 0.5, z)
    closed = 3.0 * (1.0 / safe - 1.0 / np.arctanh(safe)) / safe
    return np.where(small, np.polyval(_SHIFT_SERIES, z * z), closed)
