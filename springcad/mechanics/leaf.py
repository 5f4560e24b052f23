"""Closed forms for a straight cantilever leaf of rectangular section with a force at its free end.

Euler-Bernoulli beam, small deflection. x runs from the free end to the clamp (x = l), so that the
bending moment is F x. Width and thickness follow powers of x/l from their values at the clamp:
b(x) = b (x/l)^p and h(x) = h (x/l)^q. Integrating M^2/(2EI) over x gives the deflection
s = 12 c F l^3/(E b h^3) with c = 1/(3 - p - 3q). Paper 000, Eqs 10 to 19, has this for the constant
section, c = 1/3; each of its closed forms holds for the other shapes with their c.

The elastica is stiffer than this, if its end is free to slide and the force keeps its direction:
by 1.0, 1.4 and 1.8 % at s = l/10 and by 4.3, 5.6 and 7.6 % at s = l/5 for constant section,
triangle and parabola. Lengths are in m, forces in N, stresses and moduli in Pa; arguments may be
arrays that broadcast. Nothing is checked: lengths and moduli must be positive.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class LeafShape:
    """Width and thickness grow from the free end with (x/l) to these powers; p + 3q < 3."""

    width_exponent: float
    thickness_exponent: float

    @property
    def compliance_factor(self) -> float:
        """c = 1/(3 - p - 3q): deflection in units of F l^3/(E I) with I at the clamp."""
        return 1.0 / (3.0 - self.width_exponent - 3.0 * self.thickness_exponent)

    @property
    def volume_factor(self) -> float:
        """Volume over that of the block b h l: 1/(1 + p + q)."""
        return 1.0 / (1.0 + self.width_exponent + self.thickness_exponent)

    @property
    def volume_utilisation(self) -> float:
        """eta_A of paper 000, Eq. 15: stored energy over sigma^2/(2E) times the leaf's own volume.

        1/9 for a constant section; 1/3, the most that bending allows, for uniform strength.
        """
        return self.compliance_factor / (3.0 * self.volume_factor)


SHAPES: Mapping[str, LeafShape] = {
    "constant": LeafShape(0.0, 0.0),
    "triangular": LeafShape(1.0, 0.0),
    "parabolic": LeafShape(0.0, 0.5),
}
"""Constant section; triangle in plan view; parabola in side view (h = h0 sqrt(x/l)).

The last two have the same edge stress everywhere. Paper 000 prints the triangle as b = b0 x, which
lacks the division by l. Both end in a point or an edge: a real leaf needs material there to take
the force, which this leaves out.
"""


def stiffness(
    shape: LeafShape, modulus: ArrayLike, width: ArrayLike, length: ArrayLike, thickness: ArrayLike
) -> Floats:
    """k = E b h^3/(12 c l^3) [N/m], width and thickness at the clamp (paper 000, Eq. 11)."""
    E, b, L, h = _floats(modulus, width, length, thickness)
    return E * b * h**3 / (12.0 * shape.compliance_factor * L**3)


def clamp_stress(
    force: ArrayLike, width: ArrayLike, length: ArrayLike, thickness: ArrayLike
) -> Floats:
    """Edge stress 6 F l/(b h^2) [Pa] at the clamp, the same for every shape (paper 000, Eq. 12)."""
    F, b, L, h = _floats(force, width, length, thickness)
    return 6.0 * F * L / (b * h**2)


def edge_stress(
    shape: LeafShape,
    force: ArrayLike,
    width: ArrayLike,
    length: ArrayLike,
    thickness: ArrayLike,
    x: ArrayLike,
) -> Floats:
    """Edge stress 6 F x/(b(x) h(x)^2) [Pa] at ``x`` from the free end (paper 000, Eq. 16).

    Uniform for p + 2q = 1. ``x`` > 0.
    """
    local_width = width_at(shape, x, width, length)
    return clamp_stress(force, local_width, x, thickness_at(shape, x, thickness, length))


def width_at(shape: LeafShape, x: ArrayLike, width: ArrayLike, length: ArrayLike) -> Floats:
    """b(x) = b (x/l)^p [m] at ``x`` from the free end, ``width`` at the clamp."""
    place, b, L = _floats(x, width, length)
    return b * (place / L) ** shape.width_exponent


def thickness_at(shape: LeafShape, x: ArrayLike, thickness: ArrayLike, length: ArrayLike) -> Floats:
    """h(x) = h (x/l)^q [m] at ``x`` from the free end, ``thickness`` at the clamp."""
    place, h, L = _floats(x, thickness, length)
    return h * (place / L) ** shape.thickness_exponent


def stress_at_deflection(
    shape: LeafShape,
    modulus: ArrayLike,
    length: ArrayLike,
    thickness: ArrayLike,
    deflection: ArrayLike,
) -> Floats:
    """Edge stress E h s/(2 c l^2) [Pa] at the clamp for the deflection s of the free end."""
    E, L, h, s = _floats(modulus, length, thickness, deflection)
    return E * h * s / (2.0 * shape.compliance_factor * L**2)


def deflection_at_stress(
    shape: LeafShape, modulus: ArrayLike, length: ArrayLike, thickness: ArrayLike, stress: ArrayLike
) -> Floats:
    """Deflection 2 c l^2 sigma/(E h) [m] that brings the clamp to ``stress``: paper 000, Eq. 14."""
    E, L, h, sigma = _floats(modulus, length, thickness, stress)
    return 2.0 * shape.compliance_factor * L**2 * sigma / (E * h)


def thickness_for(
    shape: LeafShape,
    modulus: ArrayLike,
    length: ArrayLike,
    stress: ArrayLike,
    deflection: ArrayLike,
) -> Floats:
    """Thickness 2 c l^2 sigma/(E s) [m] at the clamp that reaches ``stress`` at ``deflection``.

    Paper 000, Eq. 17: the thickest leaf that may be bent so far, hence the stiffest.
    """
    E, L, sigma, s = _floats(modulus, length, stress, deflection)
    return 2.0 * shape.compliance_factor * L**2 * sigma / (E * s)


def greatest_stiffness(
    shape: LeafShape,
    modulus: ArrayLike,
    width: ArrayLike,
    length: ArrayLike,
    stress: ArrayLike,
    deflection: ArrayLike,
) -> Floats:
    """Stiffness (2 c^2/3) b l^3 sigma^3/(E^2 s^3) [N/m] of the leaf of ``thickness_for``.

    Paper 000, Eq. 19: 2/27 for a constant section; 1/6 and 8/27 for triangle and parabola. The
    parabola at full width is the best of all: it is at the stress everywhere with all its width.
    """
    E, b, L, sigma, s = _floats(modulus, width, length, stress, deflection)
    factor = 2.0 * shape.compliance_factor**2 / 3.0
    return factor * b * L**3 * sigma**3 / (E**2 * s**3)


def greatest_energy(
    shape: LeafShape,
    modulus: ArrayLike,
    width: ArrayLike,
    length: ArrayLike,
    stress: ArrayLike,
    deflection: ArrayLike,
) -> Floats:
    """Energy k s^2/2 [J] of the leaf of ``thickness_for`` at ``deflection``.

    (c^2/3) b l^3 sigma^3/(E^2 s): 1/27 (paper 000, Eq. 18), 1/12 and 4/27. The paper's section II-D
    has E = k s^2, which lacks the factor 1/2.
    """
    k = greatest_stiffness(shape, modulus, width, length, stress, deflection)
    return 0.5 * k * np.asarray(deflection, dtype=np.float64) ** 2


def volume(shape: LeafShape, width: ArrayLike, length: ArrayLike, thickness: ArrayLike) -> Floats:
    """Volume b h l/(1 + p + q) [m^3], width and thickness at the clamp."""
    b, L, h = _floats(width, length, thickness)
    return shape.volume_factor * b * L * h


def mass(
    shape: LeafShape, density: ArrayLike, width: ArrayLike, length: ArrayLike, thickness: ArrayLike
) -> Floats:
    """Mass [kg] for ``density`` [kg/m^3]."""
    return np.asarray(density, dtype=np.float64) * volume(shape, width, length, thickness)


def _floats(*values: ArrayLike) -> list[Floats]:
    return [np.asarray(value, dtype=np.float64) for value in values]
