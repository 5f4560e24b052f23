"""Design law of the rotary flexure spring: closed forms of paper 004, section II, as functions.

A ring of n cantilever flexures points inward from the root radius R; a camshaft pushes each tip at
the contact radius r with a force F at right angles to the radius. ``x`` runs along the radius from
the root (x = 0) to the contact (x = L = R - r); ``lever`` is the distance L - x of a section from
the line of the force. A section is 2 lambda high (in the plane) and t wide (the sheet).

All values are SI. Every function takes floats or arrays that broadcast. Validity: small rotations,
slender flexures, rigid rim, force at right angles to the radius (the assumptions of 004, II-A).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.rotary_flexure.room import annulus_area, neighbour_gap, tooth_width

Real = float | NDArray[np.float64]


def tip_force(stiffness: Real, deflection: Real, contact_radius: Real, count: Real) -> Real:
    """Force on one tip, F = k theta / (r n), N (004, text before Eq. 7)."""
    return stiffness * deflection / (contact_radius * count)


def bending_stress(force: Real, lever: Real, half_thickness: Real, thickness: Real) -> Real:
    """Stress on both edges of a section, sigma = 3 F (L - x) / (2 t lambda^2), Pa (004, Eq. 1)."""
    return 3.0 * force * lever / (2.0 * thickness * half_thickness**2)


def tapered_half_thickness(
    force: Real, lever: Real, thickness: Real, design_stress: Real, smallest: Real = 0.0
) -> Real:
    """Half thickness that puts a section at the design stress, m (004, Eq. 2).

    lambda = sqrt(3 F (L - x) / (2 t sigma_d)), held at or above ``smallest``: the law alone ends in
    an edge of zero thickness, which nobody can cut.
    """
    law = np.sqrt(3.0 * force * lever / (2.0 * thickness * design_stress))
    return np.maximum(law, smallest)


def tip_pad_length(span: Real, root_half_thickness: Real, tip_half_thickness: Real) -> Real:
    """Length at the tip over which Eq. 2 is thinner than the tip, L (lambda_t / lambda_r)^2, m."""
    return span * (tip_half_thickness / root_half_thickness) ** 2


def bending_curvature(
    force: Real, lever: Real, half_thickness: Real, thickness: Real, elastic_modulus: Real
) -> Real:
    """Curvature that the load adds, M / (E I) with I = 2 t lambda^3 / 3, 1/m (004, II-A).

    Its integral times y over the arc length, divided by F, is the cross compliance: the radial
    motion of the tip under a tangential force. On the taper of Eq. 2 it goes as (1 - x/L)^(-1/2),
    so both directions of a serpentine spring agree when the integral of y (1 - x/L)^(-1/2) is zero.
    """
    return 3.0 * force * lever / (2.0 * elastic_modulus * thickness * half_thickness**3)


def strain_energy_per_length(
    force: Real, lever: Real, half_thickness: Real, thickness: Real, elastic_modulus: Real
) -> Real:
    """Bending energy per arc length M^2 / (2 E I), J/m: the integrand of 004, Eq. 3.

    On the taper of Eq. 2 it becomes the integrand of Eqs 4 and 5, sigma_d^2 t lambda / (3 E).
    """
    curvature = bending_curvature(force, lever, half_thickness, thickness, elastic_modulus)
    return 0.5 * force * lever * curvature


def straight_energy(
    force: Real, span: Real, thickness: Real, design_stress: Real, elastic_modulus: Real
) -> Real:
    """Energy of a straight tapered flexure, J: sqrt(2 t F L^3 sigma_d^3 / 27) / E (004, Eq. 6)."""
    stored = 2.0 * thickness * force * span**3 * design_stress**3 / (27.0 * elastic_modulus**2)
    return np.sqrt(stored)


def straight_energy_at(
    stiffness: Real,
    deflection: Real,
    contact_radius: Real,
    count: Real,
    span: Real,
    thickness: Real,
    design_stress: Real,
    elastic_modulus: Real,
) -> Real:
    """Energy of one straight tapered flexure sized for k theta, J (004, Eq. 7)."""
    force = tip_force(stiffness, deflection, contact_radius, count)
    return straight_energy(force, span, thickness, design_stress, elastic_modulus)


def energy_of_area(area: Real, thickness: Real, design_stress: Real, elastic_modulus: Real) -> Real:
    """Energy of a flexure of this area with both edges at the design stress, J (004, Eqs 8, 9).

    ``area`` is the effective area: see :func:`effective_width`.
    """
    return design_stress**2 * thickness * area / (6.0 * elastic_modulus)


def effective_width(law_half_thickness: Real, half_thickness: Real) -> Real:
    """Width that counts for Eq. 9 where a section is thicker than Eq. 2, 2 lambda0^4/lambda^3, m.

    The energy per arc length is M^2/(2 E I) with M as lambda0^2 and I as lambda^3. Its integral
    over the arc length is the effective area; a section twice too thick stores an eighth.
    """
    return 2.0 * law_half_thickness**4 / half_thickness**3


def required_area(
    stiffness: Real,
    deflection: Real,
    count: Real,
    thickness: Real,
    design_stress: Real,
    elastic_modulus: Real,
) -> Real:
    """Effective area one flexure needs, 3 k theta^2 E / (n sigma_d^2 t), m2 (004, Eq. 10)."""
    energy = stiffness * deflection**2 * elastic_modulus
    return 3.0 * energy / (count * design_stress**2 * thickness)


def straight_area(span: Real, root_half_thickness: Real) -> Real:
    """Area of a straight tapered flexure, A_nom = 4 L lambda_r / 3, m2 (integral of 004, Eq. 2)."""
    return 4.0 * span * root_half_thickness / 3.0


def straight_deflection(
    stiffness: Real,
    span: Real,
    contact_radius: Real,
    count: Real,
    thickness: Real,
    design_stress: Real,
    elastic_modulus: Real,
) -> Real:
    """Deflection at which straight flexures reach the design stress, rad (004, Eq. 11).

    theta = (8 t n L^3 sigma_d^3 / (27 E^2 k r))^(1/3); a serpentine flexure of the factor f_s
    reaches theta f_s^(2/3), because its area goes as theta^2 and A_nom as theta^(1/2).
    """
    numerator = 8.0 * thickness * count * (span * design_stress) ** 3
    return np.cbrt(numerator / (27.0 * elastic_modulus**2 * stiffness * contact_radius))


def straight_serpentine_factor(tip_ratio: Real) -> Real:
    """Effective serpentine factor of a straight flexure with a minimum tip thickness.

    ``tip_ratio`` is lambda_t / lambda_r. The taper down to the pad stores (1 - ratio^3) of A_nom,
    the pad ratio^3 / 2: together 1 - ratio^3 / 2. From ratio 1 on the flexure is a plain bar of
    half thickness lambda_t and the factor is 1 / (2 ratio^3).
    """
    cube = tip_ratio**3
    return np.where(cube <= 1.0, 1.0 - cube / 2.0, 0.5 / np.maximum(cube, 1.0))


def straight_thickness_factor(serpentine_factor: Real, tip_ratio: Real) -> Real:
    """Factor m on Eq. 2 that gives a straight flexure exactly the wanted stiffness; else nan.

    lambda = max(m lambda0, lambda_t) stores u - ratio^3 u^2 / 2 of A_nom with u = m^-3; setting
    this equal to f_s gives u. The edges are then at sigma_d / m^2. nan where the tip alone is
    stiffer than wanted.
    """
    cube = tip_ratio**3
    with np.errstate(invalid="ignore"):
        root = np.sqrt(1.0 - 2.0 * cube * serpentine_factor)
    return np.cbrt((1.0 + root) / (2.0 * serpentine_factor))


def ring_mass(
    flexure_area: Real,
    count: Real,
    root_radius: Real,
    outer_radius: Real,
    thickness: Real,
    density: Real,
) -> Real:
    """Mass of flexures and plain rim, kg; 004, Table I has outer_radius = R + 2.5 mm."""
    rim = math.pi * (outer_radius**2 - root_radius**2)
    return density * thickness * (count * flexure_area + rim)


@dataclass(frozen=True)
class LawInputs:
    """What the law starts from, SI: k, theta (each way), R, r, n, t, E, sigma_d, lambda_t.

    Of a torque law that is not linear, k and theta are those of the linear one with the same torque
    T and energy W at full load: k = T^2/(2 W), theta = 2 W/T. ``shift`` is then by how much the
    contact has moved from r towards the root (see :mod:`loaded_contact`).
    """

    stiffness: float
    deflection: float
    root_radius: float
    contact_radius: float
    count: int
    thickness: float
    elastic_modulus: float
    design_stress: float
    tip_half_thickness: float
    shift: float = 0.0

    @property
    def loaded_radius(self) -> float:
        """Radius of the contact at full load, m."""
        return self.contact_radius + self.shift


@dataclass(frozen=True)
class DesignLaw:
    """The design law solved for one spring, SI; made by :func:`design_law`.

    Attributes:
        inputs: what it was solved for.
        torque, energy: k theta and k theta^2 / 2 of the whole spring.
        span: L = R - r.
        lever: distance from the root to the contact at full load, L but for a law that stiffens.
        force: on one tip at the full deflection.
        root_half_thickness: lambda_r of Eq. 2.
        tip_pad_length: length at the tip with the constant half thickness lambda_t.
        required_area: effective area of one flexure, Eq. 10.
        nominal_area: A_nom of the straight flexure of Eq. 2.
        flexure_area: true area of one serpentine flexure: effective area and the pad's excess.
        serpentine_factor, density_factor: f_s, f_d.
        straight_deflection: Eq. 11.
        straight_factor: effective f_s of a straight flexure with this tip, just below 1.
        straight_thickness_factor: m on Eq. 2 for a straight flexure of this stiffness (or nan).
        pinch_gap: gap between neighbours of the thickness of Eq. 2, :func:`neighbour_gap`.
        tooth_width: what is left for a cam tooth.
    """

    inputs: LawInputs
    torque: float
    energy: float
    span: float
    lever: float
    force: float
    root_half_thickness: float
    tip_pad_length: float
    required_area: float
    nominal_area: float
    flexure_area: float
    serpentine_factor: float
    density_factor: float
    straight_deflection: float
    straight_factor: float
    straight_thickness_factor: float
    pinch_gap: float
    tooth_width: float


def design_law(inputs: LawInputs) -> DesignLaw:
    """Solve the design law; ValueError unless 0 < contact_radius < root_radius."""
    k, theta, n = inputs.stiffness, inputs.deflection, inputs.count
    root, contact, t = inputs.root_radius, inputs.contact_radius, inputs.thickness
    modulus, stress, tip = inputs.elastic_modulus, inputs.design_stress, inputs.tip_half_thickness
    if not 0.0 < contact < root:
        raise ValueError(f"contact radius {contact} m must lie between 0 and root radius {root} m")
    loaded = inputs.loaded_radius
    lever = root - loaded
    force = tip_force(k, theta, loaded, n)
    thick = float(tapered_half_thickness(force, lever, t, stress))
    ratio = tip / thick
    area = float(required_area(k, theta, n, t, stress, modulus))
    nominal = float(straight_area(lever, thick))
    factor = area / nominal
    return DesignLaw(
        inputs=inputs,
        torque=k * theta,
        energy=0.5 * k * theta**2,
        span=root - contact,
        lever=lever,
        force=float(force),
        root_half_thickness=thick,
        tip_pad_length=inputs.shift + float(tip_pad_length(lever, thick, tip)),
        required_area=area,
        nominal_area=nominal,
        flexure_area=area + nominal * ratio**3,
        serpentine_factor=factor,
        density_factor=n * area / float(annulus_area(root, contact)),
        straight_deflection=float(straight_deflection(k, lever, loaded, n, t, stress, modulus)),
        straight_factor=float(straight_serpentine_factor(ratio)),
        straight_thickness_factor=float(straight_thickness_factor(factor, ratio)),
        pinch_gap=float(neighbour_gap(lever, loaded, n, thick, tip)),
        tooth_width=float(tooth_width(contact, n, tip)),
    )
