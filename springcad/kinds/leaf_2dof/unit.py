"""One leaf under one roller, exactly: large deflection, and a contact that moves along the leaf.

The leaf is a geometrically exact beam with shear and stretch (``springcad.mechanics.beam``). The
roller turns freely on the lever, so its force passes through its centre along the normal of the
leaf; the contact is wherever that holds. All results are of one leaf; an axis has n of them under
load in either direction, and its torque, stiffness and energy are n times those told here.
Length and angle may be arrays that fit together (broadcasting); results have their common shape.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.kinds.leaf_2dof.seating import away, rest_offset, seat, shear_modulus
from springcad.mechanics.centre_line import deformed_points
from springcad.mechanics.contact import peak_pressure
from springcad.mechanics.section import SHEAR_CORRECTION, area

Floats = NDArray[np.float64]

SMOOTH_GUIDE = 0.57
"""By so many of its thicknesses a leaf between smooth faces without play seems longer."""


@dataclass(frozen=True)
class UnitStroke:
    """One leaf and its roller, SI; all arrays have the shape of length and angle together.

    Attributes:
        length: effective length L, from the clamp to the roller at rest.
        angle: φ of the lever, either sign.
        torque: on the lever that holds it there, with the sign of the angle.
        stiffness: dM/dφ; where φ = 0 that of a leaf just touched.
        energy: of the leaf, which is ∫ M dφ.
        force: between roller and leaf, normal to the leaf.
        bend_angle: θ, slope of the leaf at the contact.
        station: of the contact along the leaf from the clamp; L at rest.
        stress: largest, on the edge at the clamp, without a notch.
    """

    length: Floats
    angle: Floats
    torque: Floats
    stiffness: Floats
    energy: Floats
    force: Floats
    bend_angle: Floats
    station: Floats
    stress: Floats


def stroke(leaf: Leaf, lever: Lever, length: ArrayLike, angle: ArrayLike) -> UnitStroke:
    """The unit with the effective length and the lever at the angle.

    The leaf goes on behind the contact as far as needed; ``station`` says how far.

    Raises:
        ArithmeticError: no contact found: the lever would have to wrap the leaf round the roller,
            far beyond any elastic sheet.
    """
    both = np.broadcast_arrays(np.asarray(length, float), np.asarray(angle, float))
    at, turned = (values.ravel() for values in both)
    size, side = np.abs(turned), away(lever)
    seated = seat(leaf, lever, at, size)
    # The roller's force turns with the leaf: its arm about the pivot is R cos(φ ± θ).
    inclined = size + side * seated.bend
    arm = lever.radius * np.cos(inclined)
    arm_rate = -lever.radius * np.sin(inclined) * (1.0 + side * seated.bend_rate)
    found = UnitStroke(
        length=at,
        angle=turned,
        torque=np.sign(turned) * seated.force * arm,
        stiffness=seated.force_rate * arm + seated.force * arm_rate,
        energy=seated.states.energy,
        force=seated.force,
        bend_angle=seated.bend,
        station=seated.states.end_station,
        stress=seated.states.peak_nominal_stress,
    )
    shaped = (getattr(found, field.name).reshape(both[0].shape) for field in fields(found))
    return UnitStroke(*shaped)


def rest_stiffness(leaf: Leaf, lever: Lever, length: ArrayLike) -> Floats:
    """dM/dφ at rest [N m/rad]: R² over the compliance L³/3EI + L/GA_s of the leaf with shear."""
    at = np.asarray(length, dtype=np.float64)
    shearing = SHEAR_CORRECTION * shear_modulus(leaf) * area(leaf.width, 0.5 * leaf.thickness)
    return np.asarray(lever.radius**2 / (at**3 / (3.0 * leaf.bending_stiffness) + at / shearing))


def rest_stiffness_range(leaf: Leaf, lever: Lever, length: ArrayLike) -> tuple[Floats, Floats]:
    """What real leaves may have for ``rest_stiffness``, least and greatest [N m/rad].

    Least: faces of the guide that the leaf can slide on, without play, clamp it as if it were
    0.57 b longer (0.13 b where it cannot slide; plane stress). Greatest: a leaf so wide that it
    bends as a plate, with E/(1 − ν²).
    """
    longer = np.asarray(length, dtype=np.float64) + SMOOTH_GUIDE * leaf.thickness
    plate = rest_stiffness(leaf, lever, length) / (1.0 - leaf.poisson_ratio**2)
    return rest_stiffness(leaf, lever, longer), plate


def contact_pressure(leaf: Leaf, lever: Lever, force: ArrayLike, modulus: float) -> Floats:
    """Hertz's largest pressure [Pa] of the roller on the leaf, a line of the leaf's width.

    Args:
        modulus: E* of leaf and roller, from ``springcad.mechanics.contact.contact_modulus``.
    """
    return peak_pressure(force, leaf.width, 1.0 / lever.roller_radius, modulus)


def bent_line(leaf: Leaf, lever: Lever, length: float, angle: float, stations: Floats) -> Floats:
    """Centre line of the leaf at stations (M,) from its clamp, in the frame of the lever (M, 2).

    Origin at the pivot, roller at rest at (R, 0), roller bends the leaf towards the side of the
    angle. The unbent leaf is at y = ±(r + b/2). Stations may go beyond the contact.
    """
    reach = float(np.max(stations))
    seated = seat(leaf, lever, np.array([length]), np.array([abs(angle)]), reach=reach)
    x, y = deformed_points(seated.beam, seated.states, stations)[0][0].T
    along = lever.radius + away(lever) * (length - x)
    across = y + rest_offset(leaf, lever)
    return np.column_stack([along, across if angle >= 0.0 else -across])


def curvature_parameter(leaf: Leaf, stress: ArrayLike) -> Floats:
    """Searle's a² κ/b at the clamp, with κ = 2σ/(E b): below 1 a beam, far above 10 a plate.

    The bending stiffness of a wide leaf grows from E I to E I/(1 − ν²) with it.
    """
    curvature = 2.0 * np.asarray(stress) / (leaf.elastic_modulus * leaf.thickness)
    return np.asarray(leaf.width**2 * curvature / leaf.thickness)
