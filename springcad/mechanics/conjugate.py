"""The rigid flank that makes an elastic part answer with a wanted torque law.

Frictionless contact of a rigid profile with a conservative elastic part obeys n dU/dθ = τ. So at
each angle θ the part must hold the energy W(θ) = ∫ τ dθ while it transmits τ(θ): two equations for
the contact force F and the place s of the contact on the part,

    n F p(F, s) = τ(θ),   n U(F, s) = W(θ),

with p the moment arm of the contact normal about the centre and n the number of equal parts. The
contact point carried back into the profile's own frame is the flank; that the flank is tangent to
the part (the envelope condition) follows from the energy balance.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.errors import InfeasibleError
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]

_TOLERANCE = 1e-9
_MAX_ITERATIONS = 30


@dataclass(frozen=True)
class Contact:
    """States of an elastic part for L pairs of force and station, about the centre of rotation.

    Attributes:
        arm: moment of the unit contact force about the centre, > 0 (L,) [m].
        energy: stored in the part (L,) [J].
        point: of contact (L, 2) [m].
        normal: of the part's surface there, outward, so into the profile (L, 2).
        tangent: of the part's surface towards larger stations (L, 2).
    """

    arm: Floats
    energy: Floats
    point: Floats
    normal: Floats
    tangent: Floats


class ElasticPart(Protocol):
    """An elastic part pressed at the surface station s [m] with the normal force F [N]."""

    def __call__(self, force: Floats, station: Floats) -> Contact: ...


@dataclass(frozen=True)
class Flank:
    """A conjugate flank, one row per angle; points and directions in the profile's own frame.

    Attributes:
        direction: +1 when the profile turns counter-clockwise, −1 clockwise.
        angle: of the profile, a magnitude, ascending, > 0 (A,) [rad].
        force: contact force of one part (A,) [N].
        station: contact station on the part (A,) [m].
        points, normals, tangents: (A, 2); normals point into the profile, tangents follow the
            part's surface towards larger stations.
        radius: of curvature, positive where the profile is convex; a flat part needs that.
        sliding: speed of the contact over the profile less that over the part, along
            ``tangents`` (A,) [m/rad].
    """

    direction: int
    angle: Floats
    force: Floats
    station: Floats
    points: Floats
    normals: Floats
    tangents: Floats
    radius: Floats
    sliding: Floats


def conjugate_flank(
    part: ElasticPart,
    angle: Floats,
    torque: Floats,
    energy: Floats,
    *,
    count: int,
    direction: int,
    station: float,
    station_limits: tuple[float, float],
) -> Flank:
    """The flank with which ``count`` equal parts give ``torque`` at ``angle``.

    Args:
        part: the elastic part, its point and directions in the fixed frame.
        angle: ascending angles > 0, four or more (A,) [rad].
        torque: the law τ, > 0 (A,) [N m].
        energy: its integral W from zero, > 0 (A,) [J].
        station: where the search begins [m].
        station_limits: where contact is possible on the part [m].

    Raises:
        InfeasibleError: at some angle no contact within the limits gives torque and energy.
    """
    force, stations = _solve(part, angle, torque, energy, count, station, station_limits)
    contact = part(force, stations)
    points = rotated(contact.point, -direction * angle)
    normals = rotated(contact.normal, -direction * angle)
    tangents = rotated(contact.tangent, -direction * angle)
    slope = _slopes(angle, np.column_stack([points, tangents, stations]))
    speed = np.einsum("ai,ai->a", slope[:, 0:2], tangents)
    bend = np.einsum("ai,ai->a", slope[:, 2:4], normals)
    with np.errstate(divide="ignore"):
        radius = speed / bend
    return Flank(
        direction=direction,
        angle=angle,
        force=force,
        station=stations,
        points=points,
        normals=normals,
        tangents=tangents,
        radius=radius,
        sliding=speed - slope[:, 4],
    )


def until(flank: Flank, angle: float) -> Flank:
    """The flank up to ``angle`` (rad, a magnitude)."""
    within = flank.angle <= angle
    columns = {
        field.name: getattr(flank, field.name)[within]
        for field in fields(flank)
        if field.name != "direction"
    }
    return replace(flank, **columns)


def _solve(
    part: ElasticPart,
    angle: Floats,
    torque: Floats,
    energy: Floats,
    count: int,
    station: float,
    limits: tuple[float, float],
) -> tuple[Floats, Floats]:
    """Force and station at every angle by Newton's method on all angles at once."""

    def residuals(force: Floats, stations: Floats) -> Floats:
        copies = len(force) // len(angle)
        contact = part(force, stations)
        balance = count * force * contact.arm / np.tile(torque, copies) - 1.0
        stored = count * contact.energy / np.tile(energy, copies) - 1.0
        return np.stack([balance, stored]).reshape(2, copies, -1)

    stations = np.full_like(angle, station)
    force = torque / (count * part(np.ones_like(angle), stations).arm)
    step = 1e-6
    longest = 0.25 * (limits[1] - limits[0])
    for _ in range(_MAX_ITERATIONS):
        trial_force = np.concatenate([force, force * (1.0 + step), force])
        trial_station = np.concatenate([stations, stations, stations * (1.0 - step)])
        value = residuals(trial_force, trial_station)
        here = value[:, 0]
        if np.max(np.abs(here)) < _TOLERANCE:
            return force, stations
        by_force = (value[:, 1] - here) / (force * step)
        by_station = (value[:, 2] - here) / (-stations * step)
        jacobian = np.stack([by_force, by_station], axis=-1).transpose(1, 0, 2)
        change = np.linalg.solve(jacobian, -here.T[..., None])[..., 0]
        force = force + np.clip(change[:, 0], -0.5 * force, 0.5 * force)
        wanted = stations + change[:, 1]
        stations = np.clip(stations + np.clip(change[:, 1], -longest, longest), *limits)
    first = int(np.argmax(np.max(np.abs(here), axis=0) > 1e3 * _TOLERANCE))
    outwards = bool(wanted[first] > stations[first])
    bound = limits[1] if outwards else limits[0]
    raise InfeasibleError(
        f"no contact gives the torque law at {np.degrees(angle[first]):.2f} deg: the part is too "
        f"{'stiff' if outwards else 'soft'}, contact would have to lie "
        f"{'beyond' if outwards else 'before'} {1e3 * bound:.3f} mm along it",
        float(wanted[first]),
        bound,
        "m",
    )


def _slopes(angle: Floats, values: Floats) -> Floats:
    """Derivatives (A, m) of smooth columns by angle, from a cubic spline."""
    return np.asarray(CubicSpline(angle, values)(angle, 1))
