"""The joint of paper 001 with elements round its profile, for the tests of the roller-cam."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

from springcad.kinds.roller_cam.element import ElementDimensions, Mount, Mounting
from springcad.kinds.roller_cam.joint import Cantilever, Joint, Roller
from springcad.kinds.roller_cam.synthesis import ContactProfile, synthesise
from springcad.kinds.target_law import Law, exponential, law_of

DEGREE = math.pi / 180.0
JOINT = Joint(Cantilever(24.4e-3, 4.9e-3, 3.4e-3, 206e9, 0.29), Roller(4e-3, 40e-3, 8.95e-3))
"""Drum, roller and offset are not in the paper."""
LAW: Law = law_of(exponential(0.15, DEGREE), 1.9 * DEGREE)


def dimensions(
    thickness: float = 2e-3, *, mounting: Mounting = "plates", root_fillet: float = 0.5e-3
) -> ElementDimensions:
    """Of an element with a contact part of this thickness (m)."""
    return ElementDimensions(
        thickness=thickness,
        root_fillet=root_fillet,
        foot_fillet=0.5e-3,
        rounding=0.05e-3,
        gap=0.2e-3,
        mount=Mount(10e-3, 15e-3, 4e-3, 2, mounting),
    )


def clamped(thickness: float) -> ElementDimensions:
    """With hardly a root fillet and plates up to the face: the clamp of beam theory."""
    return dimensions(thickness, root_fillet=0.1e-3)


@cache
def rigid_profile() -> ContactProfile:
    """The profile of the exponential law as if the contact part were rigid."""
    return synthesise(JOINT, LAW)


def joint_with(drum_radius: float, offset: float) -> Joint:
    """The joint with another drum (m)."""
    return replace(JOINT, roller=replace(JOINT.roller, drum_radius=drum_radius, offset=offset))
