"""An elastic part seated on a given rigid profile: which force and torque at which angle?

The forward problem to ``springcad.mechanics.conjugate``; with friction in the part's contact it
gives the loading and the unloading torque.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.mechanics.conjugate import Contact, ElasticPart
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]

_TOLERANCE = 1e-9
_MAX_ITERATIONS = 40


@dataclass(frozen=True)
class Seat:
    """The part on the profile at those angles at which it touches it, A of them.

    Attributes:
        angle: of the profile, a magnitude (A,) [rad].
        force: normal contact force of one part (A,) [N].
        station: of the contact on the part (A,) [m].
        place: of the contact on the profile, chord length from its first point (A,) [m].
        torque: of all parts, > 0 against ``direction`` (A,) [N m].
        energy: of all parts (A,) [J].
    """

    angle: Floats
    force: Floats
    station: Floats
    place: Floats
    torque: Floats
    energy: Floats


def seat(
    part: ElasticPart,
    profile: Floats,
    angle: Floats,
    *,
    count: int,
    direction: int,
    force: Floats,
    station: Floats,
    station_limits: tuple[float, float] = (-np.inf, np.inf),
) -> Seat:
    """Find where ``count`` parts touch a smooth profile, and how hard.

    At each angle the part's surface and the profile share a point and a tangent: three equations
    for force, station and place, by Newton's method on all angles at once. Angles at which no
    contact within the limits is found are left out.

    Args:
        profile: dense points (M, 2) of the profile in its own frame, along a smooth curve.
        angle: magnitudes (A,) [rad].
        force, station: where the search begins (A,); the contact without friction, for example.
        station_limits: where contact is possible on the part [m].
    """
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(profile, axis=0).T))])
    curve = CubicSpline(length, profile)
    start = part(force, station)
    here = rotated(start.point, -direction * angle)
    distance = np.hypot(*(here[:, None, :] - profile[None]).transpose(2, 0, 1))
    scale = np.stack([np.maximum(force, 1e-3 * force.max()), np.full_like(angle, length[-1])])
    unknown = np.stack([force, station, length[np.argmin(distance, axis=1)]])

    def residuals(force: Floats, station: Floats, place: Floats) -> tuple[Floats, Contact]:
        contact = part(force, station)
        turn = -direction * np.tile(angle, len(force) // len(angle))
        gap = (rotated(contact.point, turn) - curve(place)) / length[-1]
        tangent, along = rotated(contact.tangent, turn), curve(place, 1)
        cross = tangent[:, 0] * along[:, 1] - tangent[:, 1] * along[:, 0]
        return np.stack([gap[:, 0], gap[:, 1], cross]), contact

    steps = 1e-6 * np.stack([scale[0], -scale[1], scale[1]])
    for _ in range(_MAX_ITERATIONS):
        trials = [unknown, *(unknown + np.eye(3)[i][:, None] * steps for i in range(3))]
        values = residuals(*np.concatenate(trials, axis=1))[0].reshape(3, 4, -1)
        value = values[:, 0]
        jacobian = ((values[:, 1:] - value[:, None]) / steps).transpose(2, 0, 1)
        change = np.linalg.solve(jacobian, -value.T[..., None])[..., 0].T
        limit = np.stack([0.3 * scale[0], 0.1 * scale[1], 0.1 * scale[1]])
        unknown = unknown + np.clip(change, -limit, limit)
        unknown[1] = np.clip(unknown[1], *station_limits)
        found = np.max(np.abs(change / np.stack([scale[0], scale[1], scale[1]])), 0) < _TOLERANCE
        if found.all():
            break
    unknown = unknown[:, found]
    contact = part(unknown[0], unknown[1])
    return Seat(
        angle=angle[found],
        force=unknown[0],
        station=unknown[1],
        place=unknown[2],
        torque=count * unknown[0] * contact.arm,
        energy=count * contact.energy,
    )
