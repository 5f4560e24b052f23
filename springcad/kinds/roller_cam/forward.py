"""What the joint does with a given profile: torque, stress, contact and friction over the angle.

By geometry and equilibrium alone (``seating``): it knows neither the law nor the energy balance by
which the profile was made.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.roller_cam.curve import ProfileCurve
from springcad.kinds.roller_cam.joint import Cantilever, Joint, Roller
from springcad.kinds.roller_cam.part import roller_curvature
from springcad.kinds.roller_cam.seating import Contacts, PlaceCompliance, loading, seat_roller
from springcad.kinds.roller_cam.tip import TipModel, TipState, carried
from springcad.mechanics.cam_contact import Seat
from springcad.mechanics.conjugate import Flank
from springcad.mechanics.friction import FrictionLoop, friction_loop
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]
Carried = Callable[[Cantilever], TipModel]

_OFFSET = 1e-7
"""Offset of the profile for the sensitivity (m)."""


@dataclass(frozen=True)
class Stroke:
    """One group of the joint at A angles, SI; where the roller is clear of the profile all is 0.

    Attributes:
        angle: magnitudes (A,).
        torque, energy: of the group (A,).
        force: on the profile, in space (A, 2).
        place: of the contact on the profile, chord length from its first point; nan if clear (A,).
        gamma: contact angle round the roller, nan if clear (A,).
        curvature: of profile and roller together at the contact (A,).
        tip: of the cantilever; its stress is that at the clamp.
    """

    angle: Floats
    torque: Floats
    energy: Floats
    force: Floats
    place: Floats
    gamma: Floats
    curvature: Floats
    tip: TipState

    @property
    def normal_force(self) -> Floats:
        """Between roller and profile, friction included (A,) [N]."""
        return np.asarray(np.hypot(*self.force.T))


def forward(
    joint: Joint,
    curve: ProfileCurve,
    angle: Floats,
    *,
    beam: Carried = carried,
    friction: float = 0.0,
    compliance: PlaceCompliance | None = None,
    offset: float = 0.0,
) -> Stroke:
    """The joint with a given profile at given angles.

    Args:
        curve: of the profile in the frame of the tip; ``curve_through`` makes one of points.
        angle: magnitudes (A,) [rad].
        beam: ``carried`` or ``linear_carried``.
        friction: tangential over normal force on the roller, positive towards its underside.
        compliance: of the contact part; rigid without.
        offset: of the whole profile outward, towards the roller [m].

    Raises:
        InfeasibleError: the roller leaves the end of the profile before the last angle.
    """
    loaded = loading(curve, beam(joint.cantilever), friction, compliance, offset)
    touching, place, contacts = seat_roller(joint, curve, loaded, angle)
    return _stroke(joint.roller, curve, angle, touching, place, contacts)


def _stroke(
    roller: Roller,
    curve: ProfileCurve,
    angle: Floats,
    touching: NDArray[np.bool_],
    place: Floats,
    contacts: Contacts,
) -> Stroke:
    """Torque by virtual work, and the rest, put in their rows."""
    across, along = contacts.normal.T * [[1.0], [-1.0]]
    gamma = np.arctan2(np.cos(angle) * along, across)
    reach = roller.drum_radius * np.cos(angle) - roller.radius * np.sin(angle) * np.sin(gamma)
    tip = contacts.tip

    def touched(values: Floats, clear: float = 0.0) -> Floats:
        return np.where(touching if values.ndim == 1 else touching[:, None], values, clear)

    return Stroke(
        angle=angle,
        torque=touched(-reach * contacts.force[:, 1]),
        energy=touched(contacts.energy),
        force=touched(contacts.force),
        place=touched(place, np.nan),
        gamma=touched(gamma, np.nan),
        curvature=touched(curve.curvature(place) + roller_curvature(roller, angle, gamma)),
        tip=TipState(
            touched(tip.displacement),
            touched(tip.rotation),
            touched(tip.energy),
            touched(tip.stress),
        ),
    )


def least_gap(joint: Joint, curve: ProfileCurve, stroke: Stroke) -> Floats:
    """Smallest distance of roller and profile at each angle (A,) [m], negative inside the roller.

    Exact at the contact, elsewhere to first order in the tilt of the roller. Where the roller
    rests on the profile it is 0, unless it cuts into the profile somewhere else.
    """
    roller = joint.roller
    placed = (
        rotated(curve.dense()[None], stroke.tip.rotation[:, None])
        + stroke.tip.displacement[:, None]
    )
    sunk = roller.offset - roller.drum_radius * np.sin(stroke.angle)
    centre = np.stack([np.full_like(sunk, roller.start), sunk], axis=-1)
    half = roller.radius * np.stack([np.ones_like(sunk), np.cos(stroke.angle)], axis=-1)
    scaled = (placed - centre[:, None]) / half[:, None]
    size = np.hypot(scaled[..., 0], scaled[..., 1])
    steepness = np.hypot(*(scaled / half[:, None]).transpose(2, 0, 1))
    return np.asarray(((size - 1.0) * size / steepness).min(axis=1))


def offset_sensitivity(
    joint: Joint, curve: ProfileCurve, angle: Floats, *, beam: Carried = carried
) -> Floats:
    """Torque per uniform outward offset of the profile (A,) [N m/m]; over the torque, a share."""
    more, less = (
        forward(joint, curve, angle, beam=beam, offset=sign * _OFFSET).torque
        for sign in (1.0, -1.0)
    )
    return np.asarray((more - less) / (2.0 * _OFFSET))


def roller_friction(
    joint: Joint,
    curve: ProfileCurve,
    flank: Flank,
    coefficient: float,
    *,
    beam: Carried = carried,
) -> FrictionLoop:
    """Loading and unloading with the tangential over the normal force on the roller's surface.

    For a roller on a pin that is the friction of the pin times its radius over the roller's.

    Args:
        flank: the frictionless contact, which says which way the roller slides or turns.
    """
    ahead, behind = (
        _seat(forward(joint, curve, flank.angle, beam=beam, friction=sign * coefficient))
        for sign in (1.0, -1.0)
    )
    return friction_loop(flank, ahead, behind, coefficient, count=1)


def _seat(stroke: Stroke) -> Seat:
    """As the mechanics core has it."""
    station = np.log(stroke.gamma)
    return Seat(
        stroke.angle, stroke.normal_force, station, stroke.place, stroke.torque, stroke.energy
    )
