"""Closed forms of what cantilever and roller can do at all, whatever the profile."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.roller_cam.joint import Cantilever, Joint, Roller
from springcad.kinds.roller_cam.part import roller_contact
from springcad.kinds.roller_cam.tip import linear_tip
from springcad.mechanics.section import SHEAR_CORRECTION, area

Floats = NDArray[np.float64]

LEAST_OVERRUN = 1.03
"""Share of the deflection up to which the cantilever must be able to follow the law: the strip of
contact at full stroke needs a profile on both sides of it."""
_CONTACTS = np.geomspace(1e-6, 0.5 * math.pi, 300)
"""Contact angles round the roller between which the one that holds the energy is interpolated."""


def tip_stiffness(cantilever: Cantilever) -> float:
    """Force across the tip per deflection, by bending, shear and the turning of the clamp (N/m).

    001 counts bending only, which is 3 % stiffer for its cantilever.
    """
    sheared = SHEAR_CORRECTION * cantilever.shear_modulus
    section = float(area(cantilever.width, 0.5 * cantilever.height))
    clamp = cantilever.root_compliance * cantilever.length**2
    return 1.0 / (1.0 / cantilever.tip_stiffness + cantilever.length / (sheared * section) + clamp)


def required_arm(torque: Floats, energy: Floats, stiffness: float) -> Floats:
    """Least arm with which a tip of this stiffness gives the torque holding the energy (m).

    With the force F = τ/arm it holds at least F²/(2k), when the roller is right over the tip.
    Nan or inf for an energy too small to count.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return torque / np.sqrt(2.0 * stiffness * energy)


def end_stress(joint: Joint, angle: float, torque: float, energy: float) -> float:
    """Stress at the clamp where the cantilever gives the torque holding the energy (Pa).

    By small rotations; inf where no contact gives it.
    """
    turned = np.full_like(_CONTACTS, angle)
    touch = roller_contact(joint.roller, turned, _CONTACTS)
    force = torque / (touch.reach * -touch.normal[:, 1])
    state = linear_tip(joint.cantilever)(touch.point, force[:, None] * touch.normal)
    beyond = np.flatnonzero((state.energy >= energy) & (state.energy > 0.0))
    last = int(beyond[-1]) if len(beyond) else -1
    if last < 0 or last + 1 == len(_CONTACTS):
        return math.inf
    rows = slice(last, last + 2)
    share = np.interp(-math.log(energy), -np.log(state.energy[rows]), [0.0, 1.0])
    return float(state.stress[last] + share * (state.stress[last + 1] - state.stress[last]))


def lowest_point(roller: Roller, angle: float) -> float:
    """Height of the turned roller's lowest point over the axis of the cantilever at rest (m)."""
    return roller.offset - roller.drum_radius * math.sin(angle) - roller.radius * math.cos(angle)
