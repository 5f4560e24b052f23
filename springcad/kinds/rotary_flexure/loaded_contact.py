"""Where the contact stands at full load when the torque law stiffens.

At full load a flexure gives the torque T while it holds the energy W, so there it has the secant
stiffness T^2/(2 W). A law that stiffens asks for more of it than at rest: the camshaft must move
the contact along the pad towards the root, where the flexure is stiffer and the arm is longer.
"""

from __future__ import annotations

import math

from springcad.kinds.rotary_flexure.law import tapered_half_thickness

FARTHEST = 0.5
"""The contact may move by this share of the flexure's length at most."""
_HALVINGS = 60


def stiffening_by(shift: float, span: float, contact_radius: float, ratio: float) -> float:
    """Secant stiffness with the contact ``shift`` inside the pad over that at the pad's end.

    Small deflections of a straight flexure whose taper (004, Eq. 2) ends at the inner contact:
    with l = span - shift and u = shift/l, the compliance at the pad's end over that of the taper is
    1 - w^3 + 6 u (1 - w) + 3 u^2 (1/w - 1) + (w^2 + u)^3/(2 w^3), w = ``ratio`` being the tip's
    half thickness over the root's, and 1 - w^3/2 at the inner contact; the arms are the radii.
    """
    lever = span - shift
    u, w = shift / lever, ratio
    outer = 1.0 - w**3 + 6.0 * u * (1.0 - w) + 3.0 * u**2 * (1.0 / w - 1.0)
    outer += (w**2 + u) ** 3 / (2.0 * w**3)
    return ((contact_radius + shift) / contact_radius) ** 2 * outer / (1.0 - 0.5 * w**3)


def loaded_shift(
    stiffening: float,
    torque: float,
    *,
    span: float,
    contact_radius: float,
    count: int,
    thickness: float,
    design_stress: float,
    tip_half_thickness: float,
) -> float:
    """By how much the contact moves towards the root up to full load, m; nan if by too much.

    Args:
        stiffening: secant stiffness T^2/(2 W) of the law at full load over its stiffness at rest;
            up to 1 the contact stays where it is.
        torque: T, of the whole spring.
    """

    def reached(shift: float) -> float:
        force = torque / (count * (contact_radius + shift))
        root = float(tapered_half_thickness(force, span - shift, thickness, design_stress))
        ratio = min(tip_half_thickness / root, 1.0)
        return stiffening_by(shift, span, contact_radius, ratio)

    if stiffening <= 1.0:
        return 0.0
    low, high = 0.0, FARTHEST * span
    if not reached(high) >= stiffening:
        return math.nan
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if reached(middle) < stiffening else (low, middle)
    return high
