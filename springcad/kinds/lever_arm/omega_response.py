"""An omega leaf over its stroke on the nonlinear beam: force, stress, shape and gaps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.omega import OmegaCase, OmegaLeaf, OmegaResponse
from springcad.kinds.lever_arm.omega_form import (
    Half,
    angle_spline,
    basis,
    half_of,
    thickness_spline,
    variables_of,
)
from springcad.kinds.lever_arm.omega_gaps import corridor_gap, self_gap, wall_gap
from springcad.kinds.lever_arm.omega_states import (
    Guess,
    energy_of,
    equilibrium,
    rest_guess,
    state_of,
)
from springcad.mechanics.section import curved_beam_factor

Floats = NDArray[np.float64]

STATIONS = 361
"""Stations at which the half is told."""
LONGEST_STEP = 0.25
"""Largest step of the displacement, over the stroke."""


@dataclass(frozen=True)
class _Side:
    """The right half at one displacement, SI and per width."""

    line: Floats
    stress: Floats
    energy: float


def response(
    leaf: OmegaLeaf, case: OmegaCase, width: float, displacements: Floats
) -> OmegaResponse:
    """See ``omega.omega_response``."""
    half = half_of(case, variables_of(case, leaf)).bare
    share = np.linspace(0.0, 1.0, STATIONS)
    stations, thickness = share * leaf.length, thickness_spline(leaf.thickness_coefficients)(share)
    curvature = angle_spline(leaf.angle_coefficients).derivative()(share) / leaf.length
    factor = curved_beam_factor(0.5 * thickness * np.abs(curvature))
    slope = thickness_spline(leaf.thickness_coefficients).derivative()(share) / leaf.length
    edges = 1.0 + 0.25 * slope**2
    reached = _reached(case, half, np.abs(displacements) / case.stroke)

    rows = []
    for u, guess in zip(displacements, reached, strict=True):
        order = (0, 1) if u >= 0.0 else (1, 0)
        sides = [_side(case, half, guess, k, abs(u), thickness, (factor, edges)) for k in order]
        right, left = sides[0], _Side(sides[1].line * [-1.0, 1.0], sides[1].stress, sides[1].energy)
        loads = guess.loads[list(order)]
        rows.append(
            (
                (loads[0, 0] - loads[1, 0]),
                (loads[0, 1] + loads[1, 1]),
                _turn(half, guess, order[0]),
                right.energy + left.energy,
                right,
                left,
                _gaps(leaf, case, u, right.line, left.line, stations, thickness),
            )
        )
    force, side_force, turn, energy, rights, lefts, gaps = zip(*rows, strict=True)
    scale = width * case.elastic_modulus * case.enclosure_radius
    smallest = np.array(gaps)
    return OmegaResponse(
        displacement=np.asarray(displacements, dtype=np.float64),
        force=scale * np.array(force),
        side_force=scale * np.array(side_force),
        rotation=np.array(turn),
        energy=scale * case.enclosure_radius * np.array(energy),
        stations=stations,
        thickness=thickness,
        right=np.stack([side.line for side in rights]),
        left=np.stack([side.line for side in lefts]),
        right_stress=np.stack([side.stress for side in rights]),
        left_stress=np.stack([side.stress for side in lefts]),
        self_gap=smallest[:, 0],
        wall_gap=smallest[:, 1],
        corridor_gap=smallest[:, 2],
    )


def _reached(case: OmegaCase, half: Half, shares: Floats) -> list[Guess]:
    """Equilibrium at each share of the stroke, each followed from rest upwards."""
    found = {0.0: rest_guess(half)}
    at, guess = 0.0, found[0.0]
    for share in sorted({round(float(share), 12) for share in shares} - {0.0}):
        steps = int(np.ceil((share - at) / LONGEST_STEP))
        for step in np.linspace(at, share, steps + 1)[1:]:
            guess = equilibrium(case, half, guess, float(step))
        at, found[share] = share, guess
    return [found[round(float(share), 12)] for share in shares]


def _side(
    case: OmegaCase,
    half: Half,
    guess: Guess,
    k: int,
    displacement: float,
    thickness: Floats,
    factors: tuple[Floats, Floats],
) -> _Side:
    """The right half in state ``k`` (0 at +u, 1 at -u); stress as of any width."""
    u = displacement / case.enclosure_radius * (1.0, -1.0)[k]
    state = state_of(case, half, guess, k, u)
    maps = basis().grid.interpolation(np.linspace(0.0, 1.0, STATIONS))
    unit = case.enclosure_radius
    line = unit * np.column_stack([maps @ state.x.value, maps @ state.y.value])
    moment = maps @ state.moment.value * case.elastic_modulus * unit**2
    tension = maps @ state.tension.value * case.elastic_modulus * unit
    bent, along = factors
    stress = along * (6.0 * np.abs(moment) / thickness**2 * bent + np.abs(tension) / thickness)
    force = guess.loads[k]
    shear = force[0] * np.sin(guess.angles[k]) - force[1] * np.cos(guess.angles[k])
    return _Side(line, stress, energy_of(case, half, state, shear))


def _turn(half: Half, guess: Guess, k: int) -> float:
    """Rotation of the hub."""
    start = basis().at_points[0]
    return float(start @ guess.angles[k] - half.start_angle.value[0])


def _gaps(
    leaf: OmegaLeaf,
    case: OmegaCase,
    u: float,
    right: Floats,
    left: Floats,
    stations: Floats,
    thickness: Floats,
) -> tuple[float, float, float]:
    """Smallest gap to the leaf itself, to the wall and to the corridor, of both halves."""
    mirrored = left * [-1.0, 1.0]
    return (
        min(
            self_gap(right, left, thickness, stations, case),
            self_gap(mirrored, right * [-1.0, 1.0], thickness, stations, case),
        ),
        min(wall_gap(half, thickness, stations, case) for half in (right, mirrored)),
        min(
            corridor_gap(right, thickness, u, leaf.middle, case),
            corridor_gap(mirrored, thickness, -u, leaf.middle, case),
        ),
    )
