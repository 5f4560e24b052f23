"""An elastic part seated on a given rigid profile: which force and torque at which angle?

The forward problem to ``springcad.mechanics.conjugate``, by geometry and equilibrium alone: it
knows neither the torque law nor the energy balance. With friction in the part's contact it gives
the loading and the unloading torque.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.mechanics.elastic_part import ElasticPart

Floats = NDArray[np.float64]

_TOLERANCE = 1e-9
_MAX_ITERATIONS = 40
_STEP = 1e-6
_LONGEST = np.array([[0.3], [0.1], [0.1]])
"""Longest change of an iteration, over the scales of force, station and place."""


@dataclass(frozen=True)
class Seat:
    """The part on the profile at those angles at which it touches it, A of them.

    Attributes:
        angle: turned, a magnitude (A,) [rad].
        force: normal contact force of one part (A,) [N].
        station: of the contact on the part, in the part's own coordinate (A,).
        place: of the contact on the profile, chord length from its first point (A,) [m].
        torque: of all parts, > 0 against the motion (A,) [N m].
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
    force: Floats,
    station: Floats,
    station_limits: tuple[float, float],
) -> Seat:
    """Find where ``count`` parts touch a smooth profile, and how hard.

    At each angle the mate's surface and the profile share a point and a tangent: three equations
    for force, station and place, by Newton's method, all angles at once. Angles at which no
    contact within the limits is found are left out.

    Args:
        profile: dense points (M, 2) of the profile in its own frame, along a smooth curve.
        angle: magnitudes (A,) [rad].
        force, station: where the search begins (A,); the contact without friction, for example.
        station_limits: where contact is possible on the part.
    """
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(profile, axis=0).T))])
    curve = CubicSpline(length, profile)
    start = part(angle, force, station).point
    nearest = np.hypot(*(start[:, None, :] - profile).transpose(2, 0, 1)).argmin(axis=1)
    low, high = sorted(station_limits)
    scale = np.stack(
        [
            np.maximum(force, 1e-3 * force.max()),
            np.full_like(angle, high - low),
            np.full_like(angle, length[-1]),
        ]
    )
    unknown = np.stack([force, station, length[nearest]])
    found = np.zeros(len(angle), dtype=np.bool_)
    rows = np.arange(len(angle))
    for _ in range(_MAX_ITERATIONS):
        change = _newton_step(part, curve, angle[rows], unknown[:, rows], scale[:, rows])
        unknown[:, rows] += np.clip(change, -_LONGEST, _LONGEST) * scale[:, rows]
        unknown[1] = np.clip(unknown[1], low, high)
        done = np.abs(change).max(axis=0) < _TOLERANCE
        found[rows[done]] = True
        rows = rows[~done]
        if not len(rows):
            break
    angle, (force, station, place) = angle[found], unknown[:, found]
    state = part(angle, force, station)
    return Seat(angle, force, station, place, count * force * state.arm, count * state.energy)


def _newton_step(
    part: ElasticPart, curve: CubicSpline, angle: Floats, unknown: Floats, scale: Floats
) -> Floats:
    """Change (3, A) of force, station and place over their scales."""
    # Force and place go up, the station down: the end of a part is its upper limit.
    steps = _STEP * np.array([1.0, -1.0, 1.0])
    trials = (
        unknown[:, None]
        + np.column_stack([np.zeros(3), np.diag(steps)])[..., None] * scale[:, None]
    )
    force, station, place = trials.reshape(3, -1)
    state = part(np.tile(angle, 4), force, station)
    length = curve.x[-1]
    gap, along = (state.point - curve(place)) / length, curve(place, 1)
    cross = state.tangent[:, 0] * along[:, 1] - state.tangent[:, 1] * along[:, 0]
    values = np.stack([gap[:, 0], gap[:, 1], cross]).reshape(3, 4, -1)
    here = values[:, 0]
    jacobian = (values[:, 1:] - here[:, None]) / steps[:, None]
    return np.linalg.solve(jacobian.transpose(2, 0, 1), -here.T[..., None])[..., 0].T
