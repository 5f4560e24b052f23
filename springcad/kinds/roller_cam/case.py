"""One group of a roller cam to be judged before it is designed, and what may be changed in it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.knobs import Knob
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.target_law import Law

Floats = NDArray[np.float64]

ANGLES = 200
"""Angles at which the law is looked at."""


@dataclass(frozen=True)
class Case:
    """One group to be judged, SI.

    Attributes:
        law: of the group.
        deflection: largest angle; may be below that of the law.
        joint: one element and its roller; of a cantilever that is to be sized, the stiffest.
        is_sized: whether the cantilever is to be sized.
        least_height: of the cantilever.
        design_stress, yield_strength: allowed in bending, and of the material.
        clearance: least gap between roller and cantilever.
        foot_fillet: radius between cantilever and contact part, below the profile's lower end.
        torque_share: by which all torques of the law are multiplied.
    """

    law: Law
    deflection: float
    joint: Joint
    is_sized: bool
    least_height: float
    design_stress: float
    yield_strength: float
    clearance: float
    foot_fillet: float
    torque_share: float = 1.0

    @property
    def wanted(self) -> Law:
        """The law with its deflection and its torques as they are in this case."""
        law, share = self.law, self.torque_share
        return replace(
            law,
            deflection=self.deflection,
            torque=lambda angle: share * law.torque(angle),
            energy=lambda angle: share * law.energy(angle),
            stiffness=lambda angle: share * law.stiffness(angle),
            points=law.points * [1.0, share],
        )

    @property
    def angle(self) -> Floats:
        """Angles beyond the dead zone (ANGLES,)."""
        dead = self.law.dead_zone
        return dead + (self.deflection - dead) * np.arange(1, ANGLES + 1) / ANGLES


KNOBS = (
    Knob("joint.drum_radius", "mm", 1e-3, "joint.roller.drum_radius"),
    Knob("joint.roller_offset", "mm", 1e-3, "joint.roller.offset"),
    Knob("joint.roller_radius", "mm", 1e-3, "joint.roller.radius"),
    Knob("target.deflection", "deg", math.pi / 180.0, "deflection", upwards=False),
    Knob("all torques of target.law", "%", 0.01, "torque_share", upwards=False),
    Knob("material.design_stress", "MPa", 1e6, "design_stress", upwards=False),
)
"""What a user may change, most telling first. Raising a stress is not a cure."""
CANTILEVER_KNOBS = (
    Knob("cantilever.length", "mm", 1e-3, "joint.cantilever.length"),
    Knob("cantilever.height", "mm", 1e-3, "joint.cantilever.height"),
    Knob("envelope.thickness", "mm", 1e-3, "joint.cantilever.width"),
)
"""The same for a cantilever that is given."""


def knobs_of(case: Case) -> tuple[Knob, ...]:
    """What may be changed in this case."""
    return KNOBS if case.is_sized else KNOBS + CANTILEVER_KNOBS
