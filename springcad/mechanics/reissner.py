"""Reissner's geometrically exact beam, from a loaded section back along the beam.

In the frame of the loaded section (at the origin, its tangent along x) force and moment there are
given, so the equations of ``springcad.mechanics.beam`` are an initial value problem.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.lobatto import running_integral
from springcad.mechanics.section import SHEAR_CORRECTION, area, second_moment_of_area

Floats = NDArray[np.float64]

_TOLERANCE = 1e-12
_MAX_ITERATIONS = 200


class Stiffness(NamedTuple):
    """EI [N m²], EA [N] and GA_s [N] at the nodes."""

    bending: Floats
    stretching: Floats
    shearing: Floats


class Fields(NamedTuple):
    """At the nodes (L, P, n) in the frame of the loaded section; ``energy`` of the beam (L,) [J].

    ``positions`` are (L, P, n, 2).
    """

    rotation: Floats
    positions: Floats
    moment: Floats
    tension: Floats
    energy: Floats


def stiffness(
    thickness: float, half_thickness: Floats, elastic_modulus: float, shear_modulus: float
) -> Stiffness:
    """Of the rectangular section; plain EI also where the beam is curved."""
    section = area(thickness, half_thickness)
    return Stiffness(
        elastic_modulus * second_moment_of_area(thickness, half_thickness),
        elastic_modulus * section,
        SHEAR_CORRECTION * shear_modulus * section,
    )


def integrate_back(
    shape: tuple[Floats, Floats], section: Stiffness, loads: tuple[Floats, Floats, Floats]
) -> Fields:
    """Picard iteration for all loads at once; it converges faster than geometrically.

    Args:
        shape: half the panel lengths (L, P) and the unloaded curvature (L, P, n).
        section: at the nodes.
        loads: tangential force, normal force and moment on the last section (L,).

    Raises:
        ArithmeticError: no convergence; bending by many turns.
    """
    half, curvature = shape
    f_t, f_n, end_moment = (load[:, None, None] for load in loads)

    def from_end(slope: Floats) -> Floats:
        """−∫ from s to the loaded station."""
        integral = running_integral(slope, half)
        return integral - integral[:, -1:, -1:]

    rotation = from_end(curvature)
    for _ in range(_MAX_ITERATIONS):
        cos, sin = np.cos(rotation), np.sin(rotation)
        tension, shear = f_t * cos + f_n * sin, f_n * cos - f_t * sin
        stretch, slide = 1.0 + tension / section.stretching, shear / section.shearing
        x, y = from_end(stretch * cos - slide * sin), from_end(stretch * sin + slide * cos)
        moment = end_moment - x * f_n + y * f_t
        before, rotation = rotation, from_end(curvature + moment / section.bending)
        if np.max(np.abs(rotation - before)) < _TOLERANCE:
            break
    else:
        raise ArithmeticError("the beam did not converge: the loads are far beyond its strength")
    density = (
        moment**2 / section.bending + tension**2 / section.stretching + shear**2 / section.shearing
    )
    energy = 0.5 * running_integral(density, half)[:, -1, -1]
    return Fields(rotation, np.stack([x, y], axis=-1), moment, tension, energy)
