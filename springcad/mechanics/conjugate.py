"""The rigid profile that makes an elastic part answer with a wanted torque law.

Frictionless contact of a rigid profile with a conservative elastic part obeys n dU/dθ = τ. So at
each angle θ the part must hold the energy W(θ) = ∫ τ dθ while it transmits τ(θ): two equations for
the contact force F and the station s of the contact on the part,

    n F p(θ, F, s) = τ(θ),   n U(θ, F, s) = W(θ),

with p the arm (torque per unit force) and n the number of equal parts. The contact point in the
frame of the body that carries the profile is the profile; that it is tangent to the part (the
envelope condition) follows from the energy balance. Derivations: docs/theory/conjugate-profiles.md.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.mechanics.conjugate_contact import find_contacts
from springcad.mechanics.conjugate_faults import refuse_search
from springcad.mechanics.contact import half_width
from springcad.mechanics.elastic_part import ElasticPart
from springcad.mechanics.torque_law import TorqueLaw, require_law, share_of_one

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Flank:
    """A conjugate profile, one row per angle; points and directions in the profile's own frame.

    Attributes:
        direction: in which the turning body turns: +1 counter-clockwise, −1 clockwise.
        angle: turned, a magnitude, ascending (A,) [rad].
        force: contact force of one part (A,) [N].
        station: of the contact on the part, in the part's own coordinate (A,).
        points, normals, tangents: (A, 2); normals point into the profile, tangents along the
            mate's surface, as in ``ContactState``.
        curvature: of the profile, convex positive (A,) [1/m].
        mate_curvature: of the mate at the contact, convex positive (A,) [1/m].
        speed: of the contact along the profile, along ``tangents`` (A,) [m/rad].
        sliding: ``speed`` less the speed of the contact along the mate (A,) [m/rad].
        pressure_angle: between the contact normal and the way of the turning body's point of
            contact (A,) [rad].
    """

    direction: int
    angle: Floats
    force: Floats
    station: Floats
    points: Floats
    normals: Floats
    tangents: Floats
    curvature: Floats
    mate_curvature: Floats
    speed: Floats
    sliding: Floats
    pressure_angle: Floats

    @property
    def radius(self) -> Floats:
        """Radius of curvature of the profile, positive where it is convex (A,) [m]."""
        with np.errstate(divide="ignore"):
            return 1.0 / self.curvature

    @property
    def relative_curvature(self) -> Floats:
        """Curvature of the profile and its mate together, > 0 without undercut (A,) [1/m]."""
        return self.curvature + self.mate_curvature


def conjugate_flank(
    part: ElasticPart,
    law: TorqueLaw,
    *,
    count: int,
    direction: int,
    station_limits: tuple[float, float],
    intervals: int = 8,
) -> Flank:
    """The profile with which ``count`` equal parts follow the law.

    Args:
        law: at four or more angles.
        station_limits: where contact is possible on the part. Where more than one contact would
            do, the one nearest to the first limit is taken.
        intervals: as many equal ones between the limits are searched.

    Raises:
        InfeasibleError: the law is none, or no contact within the limits gives it at some angle;
            see ``flank_faults`` for profiles that cannot be made.
    """
    require_law(law)
    search = find_contacts(part, share_of_one(law, count), station_limits, intervals)
    if not search.found.all():
        refuse_search(part, law, count, station_limits, search)
    force = np.where(law.torque > 0.0, search.contact.force, 0.0)
    station = search.contact.station
    state = part(law.angle, force, station)
    columns = np.column_stack([state.point, state.tangent, state.arc])
    slope = np.asarray(CubicSpline(law.angle, columns)(law.angle, 1))
    speed = np.einsum("ai,ai->a", slope[:, 0:2], state.tangent)
    bend = np.einsum("ai,ai->a", slope[:, 2:4], state.normal)
    with np.errstate(divide="ignore"):
        curvature = bend / speed
    return Flank(
        direction=direction,
        angle=law.angle,
        force=force,
        station=station,
        points=state.point,
        normals=state.normal,
        tangents=state.tangent,
        curvature=curvature,
        mate_curvature=state.mate_curvature,
        speed=speed,
        sliding=speed - slope[:, 4],
        pressure_angle=np.arccos(np.clip(state.arm / state.reach, -1.0, 1.0)),
    )


def between(flank: Flank, first: float, last: float) -> Flank:
    """The flank from one angle to another (rad, magnitudes)."""
    return at_rows(flank, np.flatnonzero((flank.angle >= first) & (flank.angle <= last)))


def at_rows(flank: Flank, rows: NDArray[np.intp]) -> Flank:
    """The flank at some of its angles."""
    columns = {
        field.name: getattr(flank, field.name)[rows]
        for field in fields(flank)
        if field.name != "direction"
    }
    return replace(flank, **columns)


def until(flank: Flank, angle: float) -> Flank:
    """The flank up to ``angle`` (rad, a magnitude)."""
    return between(flank, 0.0, angle)


def hertz_half_width(flank: Flank, width: float, modulus: float) -> Floats:
    """Half width (A,) [m] of the contact strip of a profile without undercut.

    Args:
        width: thickness of the sheet [m].
        modulus: of the contact, ``contact.contact_modulus`` [Pa].
    """
    return half_width(flank.force, width, flank.relative_curvature, modulus)
