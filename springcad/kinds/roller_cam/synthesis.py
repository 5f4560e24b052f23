"""The profile that gives the joint its torque law, by the energy balance.

Every contact is solved by itself (``springcad.mechanics.conjugate``); a quintic spline through them
is the profile, and goes on along its end tangents. Derivation: docs/theory/roller-cam.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.errors import InfeasibleError
from springcad.kinds.roller_cam.curve import ProfileCurve, curve_through
from springcad.kinds.roller_cam.joint import Cantilever, Joint
from springcad.kinds.roller_cam.part import (
    STATION_LIMITS,
    ContactCompliance,
    part_with,
    roller_contact,
)
from springcad.kinds.roller_cam.tip import TipModel, TipState, exact_tip
from springcad.kinds.target_law import Law, sampled
from springcad.mechanics.conjugate import Flank, conjugate_flank
from springcad.mechanics.flank_faults import require_no_fold, require_no_undercut

Floats = NDArray[np.float64]

ANGLES = 100
OVERRUNS = (1.12, 1.06, 1.03, 1.0)
_INTERVALS = 12
_COARSE = 32
_GRADING = 2
"""Coarse angles go with this power of their number: near rest the contact moves fast."""
_NO_SLOPE = 1e-9
"""A slope at rest below this share of the mean slope counts as none."""


@dataclass(frozen=True)
class ContactProfile:
    """The profile on the tip of the cantilever, and the joint at A angles; frame of the tip, SI.

    Attributes:
        joint: one cantilever and its roller.
        flank: the contacts (force, points, curvature, sliding, pressure angle ...) from the end of
            the dead zone to the end of the overrun; stations are ln γ. Where the law begins with
            a slope, its first row is the limit at rest.
        torque, energy: of the law, for one group (A,).
        tip: of the cantilever (displacement, rotation, energy, stress at the clamp).
        place: of the contacts along the profile, from its first point (A,).
        curve: the profile over the place.
    """

    joint: Joint
    flank: Flank
    torque: Floats
    energy: Floats
    tip: TipState
    place: Floats
    curve: ProfileCurve

    @property
    def gamma(self) -> Floats:
        """Contact angle round the roller, 0 beside it, π/2 under it (A,) [rad]."""
        return np.asarray(np.exp(self.flank.station))

    @property
    def pull(self) -> Floats:
        """Force along the cantilever, tension positive (A,) [N]."""
        return np.asarray(self.flank.force * np.sin(self.flank.pressure_angle))

    @property
    def push(self) -> Floats:
        """Force across the cantilever, −y positive (A,) [N]."""
        return np.asarray(self.flank.force * np.cos(self.flank.pressure_angle))

    def angle_of(self, place: Floats) -> Floats:
        """The angle at which the roller touches the profile at ``place``, constant beyond it."""
        order = np.argsort(self.place)
        ends = self.place[order[[0, -1]]]
        spline = CubicSpline(self.place[order], self.flank.angle[order])
        return np.asarray(spline(np.clip(place, *ends)))


def synthesise(
    joint: Joint,
    law: Law,
    *,
    beam: Callable[[Cantilever], TipModel] = exact_tip,
    compliance: ContactCompliance | None = None,
    angles: int = ANGLES,
    overruns: Sequence[float] = OVERRUNS,
) -> ContactProfile:
    """The profile with which one group follows ``law``, and a little beyond its deflection.

    The overrun is left out as far as the joint cannot follow the law there.

    Args:
        beam: model of the cantilever.
        compliance: of the contact part over the angle; rigid without.
        angles: number of contacts solved, evenly over angle and profile.
        overruns: shares of the deflection to which the profile is tried to be made, in this order.

    Raises:
        InfeasibleError: the cantilever cannot store the law's energy, the slope at rest is out of
            its range, the profile would fold back or be undercut by the roller.
    """
    if angles < _COARSE // 2:
        raise ValueError(f"a profile needs at least {_COARSE // 2} angles")
    for overrun in overruns[:-1]:
        try:
            return _profile(joint, law, beam, compliance, angles, overrun)
        except InfeasibleError:
            continue
    return _profile(joint, law, beam, compliance, angles, overruns[-1])


def _profile(
    joint: Joint,
    law: Law,
    beam: Callable[[Cantilever], TipModel],
    compliance: ContactCompliance | None,
    angles: int,
    overrun: float,
) -> ContactProfile:
    tip = beam(joint.cantilever)
    part = part_with(joint, tip, compliance=compliance)
    sloped = rises_at_once(law)

    def flank_at(angle: Floats) -> Flank:
        return conjugate_flank(
            part,
            sampled(law, angle if sloped else angle[1:]),
            count=1,
            direction=1,
            station_limits=STATION_LIMITS,
            intervals=_INTERVALS,
        )

    last = overrun * law.deflection
    steps = np.linspace(0.0, 1.0, _COARSE + 1) ** _GRADING
    coarse = flank_at(law.dead_zone + (last - law.dead_zone) * steps)
    first = np.zeros((0, 2)) if sloped else _beside(joint, law.dead_zone)
    _, place = _curve(first, coarse)
    way = place if place[-1] > 0.0 else place[0] - place
    flank = flank_at(_even_angles(law.dead_zone, coarse.angle, way, angles))
    require_no_fold(flank)
    curve, place = _curve(first, flank)
    flank = replace(flank, curvature=curve.curvature(place))
    require_no_undercut(flank)
    wanted = sampled(law, flank.angle)
    touch = roller_contact(joint.roller, flank.angle, np.exp(flank.station))
    return ContactProfile(
        joint=joint,
        flank=flank,
        torque=wanted.torque,
        energy=wanted.energy,
        tip=tip(touch.point, flank.force[:, None] * touch.normal),
        place=place,
        curve=curve,
    )


def rises_at_once(law: Law) -> bool:
    """Whether the law begins with a slope; without, the roller touches with its side at rest."""
    ends = np.array([law.dead_zone, law.deflection])
    return bool(law.stiffness(ends)[0] > _NO_SLOPE * law.torque(ends)[1] / (ends[1] - ends[0]))


def _even_angles(rest: float, angle: Floats, way: Floats, count: int) -> Floats:
    """Angles (count,) from ``rest``, even in the mean of angle and way along the profile."""
    later = angle > rest
    angle = np.concatenate([[rest], angle[later]])
    # A profile that folds back is refused later, by its angles.
    way = np.concatenate([[0.0], np.maximum.accumulate(np.maximum(way[later], 0.0))])
    measure = way / max(way[-1], np.finfo(np.float64).tiny) + (angle - rest) / (angle[-1] - rest)
    return np.interp(np.linspace(0.0, measure[-1], count), measure, angle)


def _beside(joint: Joint, dead_zone: float) -> Floats:
    """Where the roller touches, at the end of the dead zone, a profile without stiffness."""
    return roller_contact(joint.roller, np.array([dead_zone]), np.zeros(1)).point


def _curve(first: Floats, flank: Flank) -> tuple[ProfileCurve, Floats]:
    """The curve through the contacts, behind ``first`` (0 or 1, 2), and the contacts' places.

    A contact may run up the profile; the curve runs down all the same.
    """
    points = np.concatenate([first, flank.points])
    if flank.speed[-1] > 0.0:
        curve, place = curve_through(points)
    else:
        curve, place = curve_through(points[::-1])
        place = place[::-1]
    return curve, place[len(first) :]
