"""An omega leaf over its stroke on the nonlinear beam: force, stress, shape and gaps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.omega import OmegaCase, OmegaLeaf, OmegaResponse
from springcad.kinds.lever_arm.omega_exact import (
    Guess,
    energy_of,
    equilibrium,
    rest_guess,
    state_of,
)
from springcad.kinds.lever_arm.omega_form import (
    Half,
    angle_spline,
    basis,
    half_of,
    thickness_spline,
    variables_of,
)
from springcad.kinds.lever_arm.omega_gaps import corridor_gap, self_gap, wall_gap
from springcad.mechanics.section import curved_beam_factor

Floats = NDArray[np.float64]

STATIONS = 361
"""Stations at which the half is told."""
MIRROR = np.array([-1.0, 1.0])
"""Takes the right half to the left one."""
LONGEST_STEP = 0.25
"""Largest step of the displacement, over the stroke."""


@dataclass(frozen=True)
class _Side:
    """The right half at one displacement; line and stress in SI, the rest over E, R_c and width."""

    line: Floats
    stress: Floats
    force: Floats
    turn: float
    energy: float


@dataclass(frozen=True)
class _Swing:
    """The right half at +u and at -u, and the smallest gaps to the leaf, the wall, the corridor.

    The left half is the right one in the other state, mirrored, so the gaps at -u are the same.
    """

    sides: tuple[_Side, _Side]
    gaps: tuple[float, float, float]


def response(
    leaf: OmegaLeaf, case: OmegaCase, width: float, displacements: Floats
) -> OmegaResponse:
    """See ``omega.omega_response``."""
    half = half_of(case, variables_of(case, leaf), slopes=False)
    share = np.linspace(0.0, 1.0, STATIONS)
    stations, thickness = share * leaf.length, thickness_spline(leaf.thickness_coefficients)(share)
    curvature = angle_spline(leaf.angle_coefficients).derivative()(share) / leaf.length
    factor = curved_beam_factor(0.5 * thickness * np.abs(curvature))
    slope = thickness_spline(leaf.thickness_coefficients).derivative()(share) / leaf.length
    edges = 1.0 + 0.25 * slope**2

    def swing(share: float, guess: Guess) -> _Swing:
        u = share * case.stroke
        plus, minus = (_side(case, half, guess, k, u, thickness, (factor, edges)) for k in (0, 1))
        return _Swing((plus, minus), _gaps(leaf, case, u, (plus, minus), stations, thickness))

    shares = np.round(np.abs(displacements) / case.stroke, 12)
    swings = {share: swing(share, guess) for share, guess in _reached(case, half, shares)}
    at = [swings[float(share)] for share in shares]
    rights, lefts = zip(
        *(
            swing.sides[:: 1 if u >= 0.0 else -1]
            for u, swing in zip(displacements, at, strict=True)
        ),
        strict=True,
    )
    scale = width * case.elastic_modulus * case.enclosure_radius
    forces = np.stack([right.force for right in rights])
    others = np.stack([left.force * MIRROR for left in lefts])
    force, side_force = scale * (forces + others).T
    self_gap, wall_gap, corridor_gap = np.array([swing.gaps for swing in at]).T
    energy = np.array(
        [right.energy + left.energy for right, left in zip(rights, lefts, strict=True)]
    )
    return OmegaResponse(
        displacement=np.asarray(displacements, dtype=np.float64),
        force=force,
        side_force=side_force,
        rotation=np.array([right.turn for right in rights]),
        energy=scale * case.enclosure_radius * energy,
        stations=stations,
        thickness=thickness,
        right=np.stack([right.line for right in rights]),
        left=np.stack([left.line * MIRROR for left in lefts]),
        right_stress=np.stack([right.stress for right in rights]),
        left_stress=np.stack([left.stress for left in lefts]),
        self_gap=self_gap,
        wall_gap=wall_gap,
        corridor_gap=corridor_gap,
    )


def _reached(case: OmegaCase, half: Half, shares: Floats) -> Iterator[tuple[float, Guess]]:
    """Each share of the stroke once, with its equilibrium, followed from rest upwards."""
    at, guess = 0.0, rest_guess(half)
    for share in np.unique(shares).tolist():
        steps = int(np.ceil((share - at) / LONGEST_STEP))
        for step in np.linspace(at, share, steps + 1)[1:]:
            guess = equilibrium(case, half, guess, float(step))
        at = share
        yield share, guess


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
    turn = float(basis().at_points[0] @ guess.angles[k] - half.start_angle.value[0])
    return _Side(line, stress, force[:2], turn, energy_of(case, half, state, shear))


def _gaps(
    leaf: OmegaLeaf,
    case: OmegaCase,
    u: float,
    sides: tuple[_Side, _Side],
    stations: Floats,
    thickness: Floats,
) -> tuple[float, float, float]:
    """Smallest gap to the leaf itself, to the wall and to the corridor, of both halves."""
    plus, minus = (side.line for side in sides)
    return (
        min(
            self_gap(plus, minus * MIRROR, thickness, stations, case),
            self_gap(minus, plus * MIRROR, thickness, stations, case),
        ),
        min(wall_gap(line, thickness, stations, case) for line in (plus, minus)),
        min(
            corridor_gap(plus, thickness, u, leaf.middle, case),
            corridor_gap(minus, thickness, -u, leaf.middle, case),
        ),
    )
