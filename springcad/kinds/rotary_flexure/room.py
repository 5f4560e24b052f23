"""Room in the ring: gaps between neighbours, cam teeth, the filled annulus, the cam's core.

Closed forms in SI, floats or arrays; symbols as in :mod:`springcad.kinds.rotary_flexure.law`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Real = float | NDArray[np.float64]


def annulus_area(root_radius: Real, contact_radius: Real) -> Real:
    """Area between contact and root radius, m2 (004, II-B)."""
    return math.pi * (root_radius**2 - contact_radius**2)


def neighbour_gap(
    span: Real,
    contact_radius: Real,
    count: Real,
    root_half_thickness: Real,
    tip_half_thickness: Real = 0.0,
) -> Real:
    """Smallest edge gap between straight neighbours outside the tip pads, m.

    By symmetry it is twice the smallest distance from an edge to the bisector between two
    flexures, 2 (rho sin(pi/n) - lambda cos(pi/n)) at radius rho = r + L q, which is smallest at
    q = (lambda_r / (2 L tan(pi/n)))^2: a pinch one or two millimetres outside the contact. It
    bounds the gap of any serpentine with the same taper: near the tip the neighbours' centre
    lines cannot be farther apart than 2 rho sin(pi/n). Beside the pads the cam's tooth fills the
    gap: see :func:`tooth_width`.
    """
    half_pitch = math.pi / np.asarray(count, dtype=np.float64)
    pinch = (root_half_thickness / (2.0 * span * np.tan(half_pitch))) ** 2
    pad = np.minimum((tip_half_thickness / root_half_thickness) ** 2, 1.0)
    q = np.clip(pinch, pad, 1.0)
    half_thickness = np.maximum(root_half_thickness * np.sqrt(q), tip_half_thickness)
    radius = contact_radius + span * q
    gap: Real = 2.0 * (radius * np.sin(half_pitch) - half_thickness * np.cos(half_pitch))
    return gap


def tooth_width(contact_radius: Real, count: Real, tip_half_thickness: Real) -> Real:
    """What is left for a cam tooth between two tips, 2 pi r / n - 2 lambda_t, m."""
    return 2.0 * math.pi * contact_radius / count - 2.0 * tip_half_thickness


def deflection_bound(
    stiffness: Real,
    root_radius: Real,
    contact_radius: Real,
    thickness: Real,
    design_stress: Real,
    elastic_modulus: Real,
    density_factor: Real = 1.0,
) -> Real:
    """Deflection of a spring whose flexures fill this share of the annulus, rad.

    004, Eq. 10 with n A_serp = f_d A_annulus: sigma_d sqrt(t f_d pi (R^2 - r^2) / (3 E k)). At
    f_d = 1, a full disk, it is the bound that no shape and no number of flexures can pass.
    """
    volume = thickness * density_factor * annulus_area(root_radius, contact_radius)
    return design_stress * np.sqrt(volume / (3.0 * elastic_modulus * stiffness))


def packing_bound(root_radius: Real, contact_radius: Real, count: Real, smallest_gap: Real) -> Real:
    """Largest density factor that leaves every neighbour gap at or above ``smallest_gap``.

    On every circle between r and R an arc of at least the gap lies free between neighbours, so
    gaps take n d (R - r) of the annulus pi (R - r)(R + r): f_d <= 1 - n d / (pi (R + r)).
    """
    return 1.0 - count * smallest_gap / (math.pi * (root_radius + contact_radius))


def hub_shear_stress(torque: Real, core_radius: Real, bore_radius: Real = 0.0) -> Real:
    """Torsional shear at the surface of the cam's round core, 2 T c / (pi (c^4 - b^4)), Pa."""
    return 2.0 * torque * core_radius / (math.pi * (core_radius**4 - bore_radius**4))
