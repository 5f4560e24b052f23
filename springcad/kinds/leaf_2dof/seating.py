"""Where on a leaf a roller rests, and how hard it presses, when its centre is in a given place.

Frame: origin at the clamp, x along the unbent leaf, y towards the side it is bent to. The leaf is
a geometrically exact beam; the roller turns freely, so it is a frictionless contact.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.leaf_2dof import paper_unit
from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.mechanics.beam import BeamStates, PreparedBeam, RibbonBeam, contact_load, prepare

Floats = NDArray[np.float64]

_NODES = 12  # on one panel, clamp to contact; more change the torque by less than 1e-13 of it
_BEYOND = 1.5  # length of the modelled leaf over the farthest place of a roller
_TOLERANCE = 1e-12  # of the place of the roller, over the effective length
_MAX_ITERATIONS = 30
_LARGEST_STEP = 0.3  # of the slope, and of the station over itself
_DIFFERENCE = 1e-4  # of the slope, and of the station over itself, for derivatives


@dataclass(frozen=True)
class Seated:
    """A leaf under L rollers, each of its own lever at its own angle; all arrays lead with (L,).

    Attributes:
        beam: the leaf.
        states: of the leaf.
        force: normal force [N].
        bend: slope θ of the leaf at the contact [rad].
        force_rate, bend_rate: their derivatives by the angle of the lever.
    """

    beam: PreparedBeam
    states: BeamStates
    force: Floats
    bend: Floats
    force_rate: Floats
    bend_rate: Floats


def away(lever: Lever) -> float:
    """+1 where the roller moves away from the clamp as the lever turns, −1 where towards it."""
    return 1.0 if lever.clamp == "outboard" else -1.0


def rest_offset(leaf: Leaf, lever: Lever) -> float:
    """r + b/2 [m], from the centre of the roller to the centre line of the unbent leaf."""
    return lever.roller_radius + 0.5 * leaf.thickness


def shear_modulus(leaf: Leaf) -> float:
    """G = E/2(1 + ν) [Pa]."""
    return leaf.elastic_modulus / (2.0 * (1.0 + leaf.poisson_ratio))


def seat(leaf: Leaf, lever: Lever, length: Floats, angle: Floats, *, reach: float = 0.0) -> Seated:
    """The contacts at effective lengths (L,) and angles (L,) ≥ 0, by Newton's method.

    Args:
        reach: how far from the clamp the modelled leaf must go at least [m].

    Raises:
        ArithmeticError: no contact found, as the leaf would have to wrap round the roller or the
            roller is beyond the clamp.
    """
    goal = _roller(leaf, lever, length, angle)
    if np.min(goal[:, 0]) <= 0.0:
        raise ArithmeticError("no contact of roller and leaf: the roller is beyond the clamp")
    beam = _beam(leaf, max(reach, _BEYOND * float(np.max(goal[:, 0]))))
    press = _Press(beam, leaf, lever)
    station, slope = _linear_guess(leaf, lever, length, angle, goal)
    for _ in range(_MAX_ITERATIONS):
        values, by_station, by_slope = press.rates(station, slope)
        jacobian = np.stack([by_station[:, :2], by_slope[:, :2]], axis=-1)
        error = goal - values[:, :2]
        if np.max(np.abs(error) / length[:, None]) < _TOLERANCE:
            break
        move = np.linalg.solve(jacobian, error[..., None])[..., 0]
        size = np.maximum(np.abs(move[:, 0]) / station, np.abs(move[:, 1]))
        move *= np.minimum(1.0, _LARGEST_STEP / np.maximum(size, _TOLERANCE))[:, None]
        station = np.minimum(station + move[:, 0], press.last_station)
        slope = np.maximum(slope + move[:, 1], 0.0)
    else:
        raise ArithmeticError("no contact of roller and leaf found: the leaf is bent too far")
    sine, cosine = np.sin(angle), np.cos(angle)
    moving = lever.radius * np.stack([away(lever) * sine, cosine], axis=-1)
    moved = np.linalg.solve(jacobian, moving[..., None])[..., 0]
    rate = moved[:, :1] * by_station + moved[:, 1:] * by_slope
    states, values = press.states(station, slope)
    return Seated(beam, states, values[:, 2], values[:, 3], rate[:, 2], rate[:, 3])


@dataclass(frozen=True)
class _Press:
    """The leaf touched at a station with F s²/2EI, the slope that a linear leaf would have."""

    beam: PreparedBeam
    leaf: Leaf
    lever: Lever

    @property
    def last_station(self) -> float:
        return float(self.beam.edges[-1]) / (1.0 + 2.0 * _DIFFERENCE)

    def states(self, station: Floats, slope: Floats) -> tuple[BeamStates, Floats]:
        """And the centre of the roller that does it (x, y), its force and the bend: (L, 4)."""
        force = 2.0 * self.leaf.bending_stiffness * slope / station**2
        states = contact_load(self.beam, station, force, side=-1.0)
        centre = states.point + self.lever.roller_radius * states.normal
        bend = np.arctan2(states.normal[:, 0], -states.normal[:, 1])
        return states, np.column_stack([centre, force, bend])

    def rates(self, station: Floats, slope: Floats) -> tuple[Floats, Floats, Floats]:
        """Centre, force and bend (L, 4), and their derivatives by station and slope.

        Differences of second order, one-sided in the slope as the roller cannot pull.
        """
        d = _DIFFERENCE
        _, near = self.states(
            np.concatenate([station, station * (1.0 + d), station * (1.0 - d), station, station]),
            np.concatenate([slope, slope, slope, slope + d, slope + 2.0 * d]),
        )
        values, more, less, steep, steeper = near.reshape(5, len(station), -1)
        by_station = (more - less) / (2.0 * d * station[:, None])
        return values, by_station, (4.0 * steep - steeper - 3.0 * values) / (2.0 * d)


def _roller(leaf: Leaf, lever: Lever, length: Floats, angle: Floats) -> Floats:
    """Centre of the roller (L, 2)."""
    x = length + away(lever) * lever.radius * (1.0 - np.cos(angle))
    return np.stack([x, lever.radius * np.sin(angle) - rest_offset(leaf, lever)], axis=-1)


def _linear_guess(
    leaf: Leaf, lever: Lever, length: Floats, angle: Floats, goal: Floats
) -> tuple[Floats, Floats]:
    """Station and slope by the paper's beam, the contact moved as its slope says."""
    bend = paper_unit.bend_angle(lever, length, angle)
    station = goal[:, 0] - rest_offset(leaf, lever) * np.sin(bend)
    return np.maximum(station, 0.2 * goal[:, 0]), np.tan(bend)


def _beam(leaf: Leaf, length: float) -> PreparedBeam:
    return prepare(
        RibbonBeam(
            panel_edges=np.array([0.0, length]),
            curvature=np.zeros_like,
            half_thickness=lambda s: np.full_like(s, 0.5 * leaf.thickness),
            root_angle=0.0,
            thickness=leaf.width,
            elastic_modulus=leaf.elastic_modulus,
            shear_modulus=shear_modulus(leaf),
            nodes_per_panel=_NODES,
        )
    )
