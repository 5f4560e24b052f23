"""Both halves of an omega leaf at full stroke with small displacements, with gradients.

The hub moves to (u, y_A). The left half is the mirror image of the right half moved to -u and
turned the other way, so both are told as states of the right half, at +u and at -u. The moments of
both halves on the hub cancel, so with small displacements there is none, and the two states are
opposite to each other. The beam is Winkler's curved bar, see ``omega_exact``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.omega import OmegaCase
from springcad.kinds.lever_arm.omega_form import Half, basis
from springcad.mechanics.section import SHEAR_CORRECTION
from springcad.optimise import dual
from springcad.optimise.dual import Dual

Floats = NDArray[np.float64]

_CURVED = 3.0 / np.array([5.0, 7.0, 9.0, 11.0, 13.0])  # J/I - 1 as a series in (kappa h/2)^2


@dataclass(frozen=True)
class HalfState:
    """One half at the nodes, with gradients; lengths over R_c, forces per width over E R_c."""

    x: Dual
    y: Dual
    moment: Dual
    tension: Dual

    @property
    def bare(self) -> HalfState:
        """The values alone."""
        return HalfState(self.x.bare, self.y.bare, self.moment.bare, self.tension.bare)


@dataclass(frozen=True)
class States:
    """The right half at +u and at -u; ``force`` is that of the lever on the whole spring."""

    plus: HalfState
    minus: HalfState
    force: Dual


def shear_softness(case: OmegaCase) -> float:
    """E A over the shear stiffness G A_s."""
    return case.elastic_modulus / (SHEAR_CORRECTION * case.shear_modulus)


@dataclass(frozen=True)
class Softness:
    """12/(h^3 J/I) for bending and 1/h for stretch, and the curvature, at the nodes."""

    bending: Dual
    direct: Dual
    curvature: Dual


def softness(half: Half) -> Softness:
    """Of Winkler's curved bar: J = int y^2/(1 - kappa y) dA takes the place of I."""
    ratio = 0.5 * (half.node_bend * half.thickness)
    square = ratio * ratio
    powers, stiffer = square, 1.0 + _CURVED[0] * square
    for factor in _CURVED[1:].tolist():
        powers = powers * square
        stiffer = stiffer + factor * powers
    bending = 12.0 * (dual.power(half.thickness, -3.0) * dual.power(stiffer, -1.0))
    return Softness(bending, dual.power(half.thickness, -1.0), half.node_bend)


def linear_states(case: OmegaCase, half: Half) -> States:
    """Small displacements: one 2 x 2 flexibility of the half at the hub's middle."""
    to_end, weights = basis().to_end, basis().grid.weights[None, :]
    x, y, soft = half.x, half.y - half.middle, softness(half)
    cos, sin = dual.cos(half.angle), dual.sin(half.angle)
    # Stretch under unit forces, with the part that comes from bending.
    by_x, by_y = cos + soft.curvature * y, sin - soft.curvature * x
    slide = shear_softness(case)
    u = case.stroke / case.enclosure_radius

    def integral(density: Dual) -> Dual:
        return half.length * density.mapped(weights)

    xx = integral(soft.bending * y * y + soft.direct * (by_x * by_x + slide * (sin * sin)))
    yy = integral(soft.bending * x * x + soft.direct * (by_y * by_y + slide * (cos * cos)))
    xy = integral(soft.direct * (by_x * by_y - slide * (sin * cos)) - soft.bending * x * y)
    scale = dual.power(xx * yy - xy * xy, -1.0)
    force_x, force_y = u * (yy * scale), -u * (xy * scale)

    moment = x * force_y - y * force_x
    tension, shear = -(force_x * cos + force_y * sin), force_x * sin - force_y * cos
    stretch = soft.direct * (tension + soft.curvature * moment)
    bent = soft.bending * moment + soft.curvature * stretch
    across = slide * (soft.direct * shear) - half.length * bent.mapped(to_end)
    move_x = -(half.length * (stretch * cos - across * sin).mapped(to_end))
    move_y = -(half.length * (stretch * sin + across * cos).mapped(to_end))
    return States(
        HalfState(half.x + move_x, half.y + move_y, moment, tension),
        HalfState(half.x - move_x, half.y - move_y, -moment, -tension),
        2.0 * force_x,
    )
