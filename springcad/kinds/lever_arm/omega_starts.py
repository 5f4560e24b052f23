"""Where searches for an omega leaf begin: seeded random lines that fit the enclosure roughly."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_lsq_spline

from springcad.kinds.lever_arm.omega import OmegaCase
from springcad.kinds.lever_arm.omega_form import (
    ANGLE_RANGE,
    LENGTH,
    MIDDLE,
    THICKNESS_RANGE,
    VARIABLES,
    half_of,
    knots,
)
from springcad.kinds.lever_arm.omega_problem import STEEPEST_START, bounds
from springcad.kinds.lever_arm.omega_rows import stress_rows
from springcad.kinds.lever_arm.omega_states import linear_states
from springcad.optimise.random import uniform

Floats = NDArray[np.float64]

DRAWS = 200
"""Lines drawn for one start; the one that fits best is taken."""
_NUMBERS = 8
_LINE = 61
_SHARE = np.linspace(0.0, 1.0, _LINE)
_ROOM = 0.1  # wanted between two parts of a line, in R_c
_SHORTEST, _LONGEST = 1.5, 5.5  # length of a half, in R_c


def start_point(case: OmegaCase, seed: int, index: int) -> Floats:
    """Variables of start number ``index``."""
    draws = uniform(seed, index, DRAWS * _NUMBERS).reshape(DRAWS, _NUMBERS)
    angles = _angles(case, draws)
    low, high = np.asarray(case.middle) / case.enclosure_radius
    middle = low + (high - low) * draws[:, 6]
    length, misfit = _fit(case, angles, middle)
    wanted = _SHORTEST + (_LONGEST - _SHORTEST) * draws[0, 7]
    chosen = int(np.argmin(misfit + 0.1 * np.abs(length - wanted)))
    variables = np.empty(VARIABLES)
    spline = make_lsq_spline(_SHARE, angles[chosen], knots(3), 3)
    variables[ANGLE_RANGE] = spline.c
    variables[LENGTH], variables[MIDDLE] = length[chosen], middle[chosen]
    return stressed(case, variables)


def _angles(case: OmegaCase, draws: Floats) -> Floats:
    """Tangent angles (D, K): an even turn to the right, for free leaves with waves on it."""
    first = STEEPEST_START * (2.0 * draws[:, :1] - 1.0)
    if case.topology == "omega":
        bow = _SHARE + 0.3 * (2.0 * draws[:, 1:2] - 1.0) * np.sin(np.pi * _SHARE)
        return np.asarray(first - np.pi * (0.2 + 1.3 * draws[:, 2:3]) * bow)
    turn = np.pi * (2.0 * draws[:, 1:2] - 1.4)
    waves = 0.5 + 2.5 * draws[:, 2:3]
    strength = 2.2 * draws[:, 3:4]
    phase = 2.0 * np.pi * draws[:, 4:5]
    wave = np.sin(2.0 * np.pi * waves * _SHARE + phase) - np.sin(phase)
    return np.asarray(first + turn * _SHARE + strength * wave)


def _fit(case: OmegaCase, angles: Floats, middle: Floats) -> tuple[Floats, Floats]:
    """Length that ends each line on the wall, and how badly it fits (D,), both in R_c."""
    steps = np.diff(_SHARE) * 0.5
    along = np.stack([np.cos(angles), np.sin(angles)])
    line = np.concatenate(
        [np.zeros((2, len(angles), 1)), np.cumsum(steps * (along[..., 1:] + along[..., :-1]), -1)],
        axis=-1,
    )
    x, y = line[..., -1]
    square, product = np.maximum(x * x + y * y, 1e-6), middle * y
    length = (-product + np.sqrt(product**2 + square * (1.0 - middle**2))) / square
    x, y = length[:, None] * line
    y = y + middle[:, None]
    outside = np.max(np.hypot(x, y), axis=1) - 1.0
    crossed = -np.min(x, axis=1)
    corridor = 0.5 * case.corridor / case.enclosure_radius
    inside_corridor = (y < middle[:, None] - corridor) & (x < corridor)
    distance = np.hypot(x[:, :, None] - x[:, None], y[:, :, None] - y[:, None])
    between = length[:, None, None] * np.abs(_SHARE[:, None] - _SHARE)
    tight = _ROOM - np.min(np.where(between > np.pi * _ROOM, distance, 1.0), axis=(1, 2))
    far = np.maximum(length - _LONGEST, 0.0) + np.maximum(_SHORTEST - length, 0.0)
    misfit = (
        np.maximum(outside, 0.0)
        + np.maximum(crossed, 0.0)
        + 3.0 * np.maximum(tight, 0.0)
        + inside_corridor.mean(axis=1)
        + far
    )
    return length, misfit


def stressed(case: OmegaCase, variables: Floats) -> Floats:
    """The variables with an even thickness at which the peak stress is near the allowable one.

    At a given displacement the stress is about proportional to the thickness.
    """
    lower, upper = bounds(case)
    found = variables.copy()
    found[THICKNESS_RANGE] = lower[THICKNESS_RANGE]
    for _ in range(3):
        half = half_of(case, found, slopes=False)
        states = linear_states(case, half)
        rows = stress_rows(case, half, [states.plus])
        peak = 1.0 - float(np.min(rows.value))
        found[THICKNESS_RANGE] = np.clip(
            found[THICKNESS_RANGE] / peak, lower[THICKNESS_RANGE], upper[THICKNESS_RANGE]
        )
    return found
