"""A flexure under a contact force by scipy's general solvers, each as favourably as we can.

The unknowns and equations are those of ``springcad.mechanics.beam``; the force is known in the
frame of the loaded section.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_bvp, solve_ivp

from springcad.mechanics.beam import BeamStates, PreparedBeam, RibbonBeam
from springcad.mechanics.centre_line import unloaded_points
from springcad.mechanics.plane import rotated
from springcad.mechanics.section import SHEAR_CORRECTION

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class OneLoad:
    """One contact load: station, force in the frame of the section [N], arm along its normal."""

    station: float
    axial: float
    transverse: float
    offset: float


Method = Callable[[PreparedBeam, OneLoad], Floats]
"""Gives the contact point (2,) in the flexure frame."""


def load_of(beam: PreparedBeam, states: BeamStates, index: int, side: float) -> OneLoad:
    """The load of a state of springcad's beam; only what was put in is taken from it."""
    station = float(states.end_station[index])
    axial, transverse = rotated(states.force[index], -states.end_rotation[index])
    offset = side * float(beam.beam.half_thickness(np.array(station)))
    return OneLoad(station, float(axial), float(transverse), offset)


def backward_integration(tolerance: float, *, in_panels: bool = False) -> Method:
    """DOP853 from the contact to the root, an initial value problem.

    ``in_panels`` stops at every panel edge, where the taper has kinks: for a reference.
    """

    def contact_point(prepared: PreparedBeam, load: OneLoad) -> Floats:
        beam = prepared.beam
        slope = _scalar_slope(beam, load)
        edges = prepared.edges[prepared.edges < load.station][::-1] if in_panels else [0.0]
        state, start = np.zeros(3), load.station
        for end in edges:
            path = solve_ivp(slope, (start, end), state, "DOP853", rtol=tolerance, atol=1e-15)
            state, start = path.y[:, -1], float(end)
        moment = -load.offset * load.axial - state[0] * load.transverse + state[1] * load.axial
        turn = beam.root_angle + beam.root_compliance * moment - state[2]
        return rotated(np.array([0.0, load.offset]) - state[:2], turn)

    return contact_point


def _scalar_slope(beam: RibbonBeam, load: OneLoad) -> Callable[[float, Floats], list[float]]:
    axial, transverse, modulus = load.axial, load.transverse, beam.elastic_modulus
    shear_modulus, thickness = SHEAR_CORRECTION * beam.shear_modulus, beam.thickness

    def slope(s: float, state: Floats) -> list[float]:
        x, y, angle = state
        cos, sin = math.cos(angle), math.sin(angle)
        lam, curvature = float(beam.half_thickness(s)), float(beam.curvature(s))
        area = 2.0 * lam * thickness
        stretch = 1.0 + (axial * cos + transverse * sin) / (modulus * area)
        slide = (transverse * cos - axial * sin) / (shear_modulus * area)
        moment = (y - load.offset) * axial - x * transverse
        return [
            stretch * cos - slide * sin,
            stretch * sin + slide * cos,
            curvature + moment / (modulus * area * lam**2 / 3.0),
        ]

    return slope


def collocation(tolerance: float) -> Method:
    """solve_bvp from the unloaded shape, lengths over the station, the end's angle a parameter."""

    def contact_point(prepared: PreparedBeam, load: OneLoad) -> Floats:
        beam, length = prepared.beam, load.station
        scale = math.hypot(load.axial, load.transverse) * length

        def slopes(sigma: Floats, state: Floats, end: Floats) -> Floats:
            fx, fy = rotated(np.array([load.axial, load.transverse]), end[0])
            cos, sin = np.cos(state[2]), np.sin(state[2])
            lam = beam.half_thickness(sigma * length)
            area = 2.0 * lam * beam.thickness
            stretch = 1.0 + (fx * cos + fy * sin) / (beam.elastic_modulus * area)
            slide = (fy * cos - fx * sin) / (SHEAR_CORRECTION * beam.shear_modulus * area)
            along, across = stretch * cos - slide * sin, stretch * sin + slide * cos
            stiffness = beam.elastic_modulus * area * lam**2 / 3.0
            bend = length * (beam.curvature(sigma * length) + scale * state[3] / stiffness)
            return np.stack([along, across, bend, (across * fx - along * fy) * length / scale])

        def ends(root: Floats, tip: Floats, end: Floats) -> Floats:
            turned = root[2] - beam.root_angle - beam.root_compliance * scale * root[3]
            moment = tip[3] + load.offset * load.axial / scale
            return np.array([root[0], root[1], turned, tip[2] - end[0], moment])

        inner = prepared.edges[prepared.edges < length]
        s = np.append(np.concatenate([inner, 0.5 * (inner + np.append(inner[1:], length))]), length)
        s.sort()
        points, angles = unloaded_points(prepared, s)
        guess = np.stack([*points.T / length, angles, 0.0 * s])
        found = solve_bvp(slopes, ends, s / length, guess, angles[-1:], tol=tolerance)
        if not found.success:
            raise ArithmeticError(found.message)
        end = found.p[0]
        return length * found.y[:2, -1] + rotated(np.array([0.0, load.offset]), end)

    return contact_point
