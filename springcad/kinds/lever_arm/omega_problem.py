"""The omega leaf as an optimisation problem: stiffest within everything it must keep to."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.omega import OmegaCase
from springcad.kinds.lever_arm.omega_exact import Guess, exact_states, rest_guess
from springcad.kinds.lever_arm.omega_form import (
    ANGLE_RANGE,
    LENGTH,
    MIDDLE,
    THICKNESS_RANGE,
    VARIABLES,
    Half,
    basis,
    half_of,
    reference_thickness,
)
from springcad.kinds.lever_arm.omega_pairs import halves_rows, self_rows
from springcad.kinds.lever_arm.omega_rows import (
    bend_rows,
    corridor_rows,
    foot_row,
    one_sided_rows,
    stress_rows,
    taper_rows,
    tracks,
    wall_rows,
)
from springcad.kinds.lever_arm.omega_states import States, linear_states
from springcad.optimise import dual
from springcad.optimise.dual import Dual
from springcad.optimise.sqp import Evaluation

Floats = NDArray[np.float64]

STEPS = 4
"""Steps of the stroke in which the nonlinear beam is taken from rest to its end."""
STEEPEST_START = np.radians(60.0)
"""Largest angle of the leaf from x where it leaves the hub."""


def bounds(case: OmegaCase) -> tuple[Floats, Floats]:
    """Lower and upper bounds of the variables."""
    lower, upper = np.empty(VARIABLES), np.empty(VARIABLES)
    lower[ANGLE_RANGE], upper[ANGLE_RANGE] = -9.0, 9.0
    lower[0], upper[0] = -STEEPEST_START, STEEPEST_START
    lower[THICKNESS_RANGE] = case.min_web / reference_thickness(case)
    upper[THICKNESS_RANGE] = 0.4 * case.enclosure_radius / reference_thickness(case)
    lower[LENGTH], upper[LENGTH] = 0.5, 12.0
    lower[MIDDLE], upper[MIDDLE] = np.asarray(case.middle) / case.enclosure_radius
    return lower, upper


def linear_problem(case: OmegaCase, variables: Floats, *, slopes: bool = True) -> Evaluation:
    """Objective and constraints with small displacements; both directions are alike.

    Without ``slopes`` the gradients are left out, which takes half the time.
    """
    half = half_of(case, variables, slopes=slopes)
    return evaluation(case, half, linear_states(case, half), alike=True)


def stiffness_of(case: OmegaCase, force: float) -> float:
    """k/b, N/m per m, from the force of the whole spring at the stroke, over E R_c."""
    return force * case.elastic_modulus * case.enclosure_radius / case.stroke


def evaluation(case: OmegaCase, half: Half, states: States, *, alike: bool) -> Evaluation:
    """Everything of order one. The objective is -log(k/b), k/b in N/mm per mm.

    There are gradients if the half has any. In ``alike`` states, of small displacements, the
    stress is asked for in one of them.
    """
    rest, plus, minus = tracks(half, states)
    loaded = [states.plus] if alike else [states.plus, states.minus]
    rows = [
        stress_rows(case, half, loaded),
        bend_rows(case, half),
        taper_rows(case, half),
        foot_row(half),
        *halves_rows(case, half, [(rest, rest), (plus, minus)]),
        corridor_rows(case, half, plus, 1.0),
        corridor_rows(case, half, minus, -1.0),
        *(wall_rows(case, half, track) for track in (rest, plus, minus)),
        *self_rows(case, half, [rest, plus, minus]),
    ]
    if case.topology == "omega":
        rows.append(one_sided_rows(half))
    inequalities = dual.stacked(rows)
    ending = clamp_row(half)
    unit = stiffness_of(case, 1.0) * 1e-6
    force = states.force
    value = np.maximum(force.value * unit, 1e-9)
    return Evaluation(
        float(-np.log(value[0])),
        -force.gradient[0] * unit / value[0],
        ending.value,
        ending.gradient,
        inequalities.value,
        inequalities.gradient,
    )


def clamp_row(half: Half) -> Dual:
    """|B| + h/2 - R_c of the clamp."""
    last = basis().at_points[-1:]
    radius = dual.power(half.end_x * half.end_x + half.end_y * half.end_y, 0.5)
    return radius + 0.5 * half.thickness.mapped(last) - 1.0


class ExactProblem:
    """The problem on the nonlinear beam, both directions for themselves.

    Newton's method begins where that of the last evaluation ended. Where it finds no equilibrium
    the linear states stand in, at a price that a search does not pay.
    """

    PRICE = 10.0

    def __init__(self, case: OmegaCase) -> None:
        self.case = case
        self._guess: Guess | None = None

    def __call__(self, variables: Floats, *, slopes: bool = True) -> Evaluation:
        """Values and gradients at ``variables`` (V,); without ``slopes`` values alone."""
        half = half_of(self.case, variables, slopes=slopes)
        states = self._states(half)
        if states is not None:
            return evaluation(self.case, half, states, alike=False)
        states = linear_states(self.case, half)
        found = evaluation(self.case, half, states, alike=False)
        return replace(found, objective=found.objective + self.PRICE)

    def _states(self, half: Half) -> States | None:
        for guess, steps in ((self._guess, 1), (rest_guess(half), STEPS)):
            if guess is None:
                continue
            try:
                states, self._guess = exact_states(self.case, half, guess, steps)
            except (ArithmeticError, np.linalg.LinAlgError):
                self._guess = None
            else:
                return states
        return None
