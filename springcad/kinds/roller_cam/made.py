"""A finished roller cam, before anything is said about it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Profile
from springcad.kinds.roller_cam.case import Case
from springcad.kinds.roller_cam.compensation import Compensated
from springcad.kinds.roller_cam.correction import Correction
from springcad.kinds.roller_cam.drawn import DrawnProfile
from springcad.kinds.roller_cam.element import ElementGeometry
from springcad.kinds.roller_cam.forward import Stroke
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.roller_cam.spec import RollerCamSpec
from springcad.kinds.target_law import Law
from springcad.mechanics.contact_strip import Strips
from springcad.mechanics.friction import FrictionLoop
from springcad.result import Check

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class MadeJoint:
    """Everything that was decided about one joint and what it does; SI.

    Attributes:
        spec, case, law: what it was designed for; the law is that of one group.
        correction: by a curve from elsewhere; None without.
        followed: the law that our model is to follow: ``law``, with a correction its pseudo law.
        feasibility: the closed-form checks that it passed before.
        joint: one element and its roller.
        compensated: the profile, and the compliance of the element.
        stepwise_distance: of the profile of paper 001's iteration from that of the energy balance;
            None where it finds none.
        geometry, element: the element, and as a part.
        drawn: its profile as the arcs of the drawing.
        stroke: one group seated on the drawn profile.
        strips: on which the roller touches the drawn profile, over the stroke.
        expected_angle: at the torques of the stroke; its own, with a correction those expected
            where the curve is from (A,).
        gap: smallest distance of roller and profile at each angle of the stroke, the contact part
            rigid: of a yielding one nothing is known beside the contact (A,).
        sensitivity: torque per outward offset of the profile (A,) [N m/m].
        friction: loading and unloading, None without friction.
        mass: of one element.
    """

    spec: RollerCamSpec
    case: Case
    law: Law
    correction: Correction | None
    followed: Law
    feasibility: tuple[Check, ...]
    joint: Joint
    compensated: Compensated
    stepwise_distance: float | None
    geometry: ElementGeometry
    element: Profile
    drawn: DrawnProfile
    stroke: Stroke
    strips: Strips
    expected_angle: Floats
    gap: Floats
    sensitivity: Floats
    friction: FrictionLoop | None
    mass: float
