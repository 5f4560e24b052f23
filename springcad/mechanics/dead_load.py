"""A ribbon under a force that keeps its direction in space, as a weight does.

In the frame of the loaded section such a force is known but for one angle, that from the section
to the force; it is right when the root comes out at its own angle. Strong forces leave several
such angles (the elastica has looped states), of which one is reached by raising the load from zero.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springcad.mechanics.beam import BeamStates, PreparedBeam, follower_load
from springcad.mechanics.centre_line import unloaded_points

Floats = NDArray[np.float64]

_TOLERANCE = 1e-10  # of the direction [rad]
_MAX_ITERATIONS = 10
_LARGEST_TURN = 0.3  # of the angle in one step of the load [rad]
_SMALLEST_STEP = 1e-6  # of the load
_DIFFERENCE = 1e-6  # of the angle, for its derivatives [rad]


def dead_load(prepared: PreparedBeam, station: ArrayLike, force: ArrayLike) -> BeamStates:
    """States under centre-line forces (L, 2) [N] that keep their direction in the flexure frame.

    Of all states in balance with a force this is the one reached by raising it from zero: every
    step of the load leads from one stable state to a stable state close by.

    Raises:
        ArithmeticError: the beam buckles or snaps before the whole force acts; or the force is so
            large, far beyond 100 EI/s_c², that rounding hides the angle.
    """
    force = np.atleast_2d(np.asarray(force, dtype=np.float64))
    size, direction = np.hypot(force[:, 0], force[:, 1]), np.arctan2(force[:, 1], force[:, 0])
    station = np.broadcast_to(np.asarray(station, dtype=np.float64), size.shape)
    angle = direction - unloaded_points(prepared, station)[1]
    reached, step, slope = np.zeros_like(size), np.ones_like(size), np.ones_like(size)
    while np.any(reached < 1.0):
        target = np.minimum(reached + step, 1.0)
        goal = (station, target * size, direction)
        good, found, new_slope = _follow(prepared, goal, angle, slope)
        reached, angle = np.where(good, target, reached), np.where(good, found, angle)
        slope, step = np.where(good, new_slope, slope), np.where(good, 2.0, 0.5) * step
        if np.min(step) < _SMALLEST_STEP:
            worst = int(np.argmin(step))
            raise ArithmeticError(
                f"no stable state follows beyond {reached[worst]:.3%} of the dead load of "
                f"{size[worst]:.6g} N: the beam buckles or snaps, or the load is far beyond "
                "its strength"
            )
    return follower_load(prepared, station, size * np.cos(angle), size * np.sin(angle))


def _follow(
    prepared: PreparedBeam, goal: tuple[Floats, Floats, Floats], start: Floats, slope: Floats
) -> tuple[NDArray[np.bool_], Floats, Floats]:
    """Newton's method for the angle from the section to the force, begun at that of the last state.

    Let v(s) be the derivative, with respect to the angle, of the direction of the force against
    the section at s: 1 at the loaded section. A state is stable while v > 0 all along the beam
    (Jacobi's condition) and while ``slope``, the derivative of the direction with the root held,
    is positive. Two states meet only where the slope is 0. So a step is good when all its
    iterates are stable with slopes between half and twice that of the last state.

    Args:
        goal: loaded station, size and direction of the force, each (L,).
        start: angle of the last state (L,).
        slope: of the last state (L,).

    Returns: whether the step is good, the angle and the slope there, each (L,).
    """
    station, size, direction = goal
    angle, good = start, np.ones(len(start), dtype=bool)
    for _ in range(_MAX_ITERATIONS):
        force_direction, rotation = _directions(prepared, station, size, angle)
        beside = _directions(prepared, station, size, angle + _DIFFERENCE)
        new_slope = (beside[0] - force_direction) / _DIFFERENCE
        field = new_slope[:, None] - (beside[1] - rotation) / _DIFFERENCE
        good = (
            good
            & (np.abs(angle - start) < _LARGEST_TURN)
            & (np.min(field, axis=1) > 0.0)
            & (0.5 * slope < new_slope)
            & (new_slope < 2.0 * slope)
        )
        error = force_direction - direction
        open_ = good & (np.abs(error) > _TOLERANCE)
        if not np.any(open_):
            return good, angle, new_slope
        angle = np.where(open_, angle - error / np.where(open_, new_slope, 1.0), angle)
    return good & ~open_, angle, new_slope


def _directions(
    prepared: PreparedBeam, station: Floats, size: Floats, angle: Floats
) -> tuple[Floats, Floats]:
    """Direction of the force (L,) and angles of the tangent (L, N) in the flexure frame."""
    states = follower_load(prepared, station, size * np.cos(angle), size * np.sin(angle))
    return angle + states.end_rotation, states.rotation
