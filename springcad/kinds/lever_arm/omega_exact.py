"""Both halves of an omega leaf under large displacements, with gradients.

With F and m force and moment about the hub's middle that the hub exerts on a half, r(s) its
deformed line and r_O the moved middle,

    psi = theta - int_s^L M/EJ + kappa e ds,     e = (N + kappa M)/EA,     N = -F.t,  V = -F.n,
    r = B - int_s^L (1 + e) t(psi) + (V/GA_s) n(psi) ds,     M = (r - r_O) x F - m.

This is Winkler's curved bar: fibres on the inside of a bend are shorter, so that
J = int y^2/(1 - kappa y) dA takes the place of I, and bending stretches the middle line. For a
straight bar it is the beam of ``springcad.mechanics.beam``.

At the hub each half must end where the turned hub is; the hub's turn is common (that of the state
at -u is opposite), and so is m, because the moments of both halves on the hub cancel.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.omega import OmegaCase
from springcad.kinds.lever_arm.omega_form import Half, basis
from springcad.kinds.lever_arm.omega_states import (
    HalfState,
    Softness,
    States,
    shear_softness,
    softness,
)
from springcad.optimise import dual
from springcad.optimise.dual import Dual

Floats = NDArray[np.float64]

_TOLERANCE = 1e-7  # of the last step of psi, rad; what is left after it is as its square
_MAX_ITERATIONS = 12
_LARGEST_STEP = 3.0  # of psi, rad
_LOADS = 3  # force along x and y, moment
_SIDES = (1.0, -1.0)


@dataclass
class Guess:
    """Where Newton's method begins, for both states: psi and M (2, N), loads Fx, Fy, m (2, 3)."""

    angles: Floats
    moments: Floats
    loads: Floats


@dataclass(frozen=True)
class _Beam:
    """A half as Newton's method needs it: columns for the loads stand behind those of the design.

    Attributes:
        angle, start_angle, length, middle, end_x, end_y: of the half.
        soft: its softness.
        slide: E A over the shear stiffness.
        hub: radius, over R_c.
        stroke: over R_c.
        design: number of variables of the half.
    """

    angle: Dual
    start_angle: Dual
    length: Dual
    middle: Dual
    end_x: Dual
    end_y: Dual
    soft: Softness
    slide: float
    hub: float
    stroke: float
    design: int

    def loads(self, values: Floats) -> list[Dual]:
        """Loads (3,) as variables of their own."""
        columns = np.hstack([np.zeros((_LOADS, self.design)), np.eye(_LOADS)])
        return [Dual(values[[k]], columns[[k]]) for k in range(_LOADS)]


def _beam(case: OmegaCase, half: Half) -> _Beam:
    soft = softness(half)
    return _Beam(
        angle=_wide(half.angle),
        start_angle=_wide(half.start_angle),
        length=_wide(half.length),
        middle=_wide(half.middle),
        end_x=_wide(half.end_x),
        end_y=_wide(half.end_y),
        soft=Softness(*(_wide(part) for part in vars(soft).values())),
        slide=shear_softness(case),
        hub=case.hub_radius / case.enclosure_radius,
        stroke=case.stroke / case.enclosure_radius,
        design=half.length.gradient.shape[1],
    )


def _wide(part: Dual) -> Dual:
    return Dual(part.value, np.hstack([part.gradient, np.zeros((len(part.value), _LOADS))]))


def rest_guess(half: Half) -> Guess:
    """The undeformed angles and no loads: the first Newton step is the linear solution."""
    angles = np.tile(half.angle.value, (2, 1))
    return Guess(angles, np.zeros_like(angles), np.zeros((2, _LOADS)))


def exact_states(case: OmegaCase, half: Half, guess: Guess, steps: int) -> tuple[States, Guess]:
    """Large displacements, reached in ``steps`` equal steps of the stroke from ``guess``.

    Returns the states, with gradients, and where the next search may begin.

    Raises:
        ArithmeticError: no equilibrium found.
    """
    bare = _beam(case, half.bare)
    for step in range(1, steps + 1):
        guess = _equilibrium(bare, guess, step / steps)
    beam = _beam(case, half)
    loads = [beam.loads(guess.loads[k]) for k in range(2)]
    if not beam.design:
        plus, minus = (
            state_of(case, half, guess, k, side * beam.stroke).bare for k, side in enumerate(_SIDES)
        )
        return States(plus, minus, (loads[0][0] - loads[1][0]).bare), guess
    ends, fields = [], []
    for k, side in enumerate(_SIDES):
        q = guess.angles[k], guess.moments[k]
        angle, moment, _ = _step(beam, q, loads[k], side * beam.stroke)
        fields.append(_field(beam, (angle, moment), loads[k], side * beam.stroke))
        ends.append(_end_gap(beam, fields[k], angle, side * beam.stroke))
    turns = _by_design(ends, beam.design)
    states = [
        HalfState(*(_reduced(part, turns[k]) for part in vars(field).values()))
        for k, field in enumerate(fields)
    ]
    force = _reduced(loads[0][0], turns[0]) - _reduced(loads[1][0], turns[1])
    return States(states[0], states[1], force), guess


def state_of(case: OmegaCase, half: Half, guess: Guess, k: int, u: float) -> HalfState:
    """The right half in state ``k`` of an equilibrium, with the hub at ``u`` (over R_c)."""
    beam = _beam(case, half)
    none = np.zeros((len(guess.angles[k]), _LOADS))
    angle, moment = Dual(guess.angles[k], none), Dual(guess.moments[k], none)
    return _field(beam, (angle, moment), beam.loads(guess.loads[k]), u)


def energy_of(case: OmegaCase, half: Half, state: HalfState, shear: Floats) -> float:
    """Of bending, stretch and shear of a half, over E R_c^2 and width."""
    soft = softness(half)
    direct = soft.direct.value
    stretched = state.tension.value + soft.curvature.value * state.moment.value
    density = (
        soft.bending.value * state.moment.value**2
        + direct * stretched**2
        + shear_softness(case) * direct * shear**2
    )
    return float(0.5 * half.length.value[0] * (basis().grid.weights @ density))


def equilibrium(case: OmegaCase, half: Half, guess: Guess, share: float) -> Guess:
    """Equilibrium of both halves at a share of the stroke; ``half`` without gradient.

    Raises:
        ArithmeticError: no equilibrium found.
    """
    return _equilibrium(_beam(case, half), guess, share)


def _equilibrium(beam: _Beam, guess: Guess, share: float) -> Guess:
    u = share * beam.stroke
    angles, moments, loads = guess.angles.copy(), guess.moments.copy(), guess.loads.copy()
    for _ in range(_MAX_ITERATIONS):
        ends, moved, size = [], [], 0.0
        for k, side in enumerate(_SIDES):
            forces = beam.loads(loads[k])
            angle, moment, step = _step(beam, (angles[k], moments[k]), forces, side * u)
            field = _field(beam, (angle, moment), forces, side * u)
            ends.append(_end_gap(beam, field, angle, side * u))
            moved.append((angle, moment))
            size = max(size, step)
        values, matrix = _joint_system(ends, 0)
        change = np.linalg.solve(matrix, -values)
        for k, part in enumerate((change[[0, 1, 4]], change[[2, 3, 4]])):
            loads[k] += part
            angle, moment = moved[k]
            turn = angle.gradient @ part
            angles[k], moments[k] = angle.value + turn, moment.value + moment.gradient @ part
            size = max(size, float(np.max(np.abs(turn))))
        if not size < _LARGEST_STEP:
            break
        if size < _TOLERANCE:
            return Guess(angles, moments, loads)
    raise ArithmeticError("no equilibrium of the leaf found")


def _field(beam: _Beam, q: tuple[Dual, Dual], loads: list[Dual], u: float) -> HalfState:
    """Positions, moment and tension that follow from psi, M and the loads."""
    to_end, soft, length = basis().to_end, beam.soft, beam.length
    (angle, moment), (force_x, force_y, hub_moment) = q, loads
    cos, sin = dual.cos(angle), dual.sin(angle)
    tension, shear = -(force_x * cos + force_y * sin), force_x * sin - force_y * cos
    stretch = 1.0 + soft.direct * (tension + soft.curvature * moment)
    slide = beam.slide * (soft.direct * shear)
    x = beam.end_x - length * (stretch * cos - slide * sin).mapped(to_end)
    y = beam.end_y - length * (stretch * sin + slide * cos).mapped(to_end)
    follows = (x - u) * force_y - (y - beam.middle) * force_x - hub_moment
    return HalfState(x, y, follows, tension)


def _step(
    beam: _Beam, q: tuple[Floats, Floats], loads: list[Dual], u: float
) -> tuple[Dual, Dual, float]:
    """One Newton step for psi and M at given loads, with gradients, and the step of psi."""
    to_end, soft, count = basis().to_end, beam.soft, len(q[0])
    none = np.zeros((count, loads[0].gradient.shape[1]))
    psi, moment = Dual(q[0], none), Dual(q[1], none)
    field = _field(beam, (psi, moment), loads, u)
    stretch = soft.direct * (field.tension + soft.curvature * moment)
    bent = beam.length * (soft.bending * moment + soft.curvature * stretch).mapped(to_end)
    residual = dual.stacked([psi - beam.angle + bent, moment - field.moment])
    matrix = _tangent(beam, (q[0], stretch.value, field.tension.value), loads)
    right = np.column_stack([residual.value, residual.gradient])
    step: Floats = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    turned = Dual(q[0] - step[:count, 0], -step[:count, 1:])
    bent_by = Dual(q[1] - step[count:, 0], -step[count:, 1:])
    return turned, bent_by, float(np.max(np.abs(step[:count, 0])))


def _tangent(beam: _Beam, fields: tuple[Floats, Floats, Floats], loads: list[Dual]) -> Floats:
    """Derivative of both residuals by psi and M (2 N, 2 N), from psi, stretch and tension."""
    angle, stretch, tension = fields
    force_x, force_y = loads[0].value, loads[1].value
    cos, sin = np.cos(angle), np.sin(angle)
    bending, direct, curvature = (part.value for part in vars(beam.soft).values())
    to_end, slide = beam.length.value * basis().to_end, beam.slide
    shear = force_x * sin - force_y * cos
    along = (1.0 - slide) * direct * shear
    beside = 1.0 + stretch - slide * direct * tension
    lever = (along * cos - beside * sin) * force_y - (along * sin + beside * cos) * force_x
    one, both = np.eye(len(angle)), curvature * direct * shear
    by_moment = to_end * (bending + curvature**2 * direct)
    return np.block([[one + to_end * both, by_moment], [to_end * lever, one - to_end * both]])


def _end_gap(beam: _Beam, field: HalfState, angle: Dual, u: float) -> Dual:
    """Distance of the half's beginning from the turned hub's edge, x and y, and the hub's turn."""
    start = basis().at_points[:1]
    psi = angle.mapped(start)
    return dual.stacked(
        [
            field.x.mapped(start) - u - beam.hub * dual.cos(psi),
            field.y.mapped(start) - beam.middle - beam.hub * dual.sin(psi),
            psi - beam.start_angle,
        ]
    )


def _joint_system(ends: list[Dual], before: int) -> tuple[Floats, Floats]:
    """The five end conditions and their derivatives (5, 5) by F+, F- and the common m."""
    values = np.concatenate([ends[0].value[:2], ends[1].value[:2], ends[0].value[2:]])
    values[4] += ends[1].value[2]
    matrix = np.zeros((5, 5))
    plus, minus = (end.gradient[:, before:] for end in ends)
    matrix[:2, :2], matrix[:2, 4] = plus[:2, :2], plus[:2, 2]
    matrix[2:4, 2:4], matrix[2:4, 4] = minus[:2, :2], minus[:2, 2]
    matrix[4] = np.concatenate([plus[2, :2], minus[2, :2], plus[2, 2:] + minus[2, 2:]])
    return values, matrix


def _by_design(ends: list[Dual], before: int) -> tuple[Floats, Floats]:
    """Derivatives (3, V) of each state's loads by the design, at which the end conditions hold."""
    _, matrix = _joint_system(ends, before)
    plus, minus = (end.gradient[:, :before] for end in ends)
    right = np.vstack([plus[:2], minus[:2], plus[2:] + minus[2:]])
    loads: Floats = np.asarray(np.linalg.solve(matrix, -right), dtype=np.float64)
    return loads[[0, 1, 4]], loads[[2, 3, 4]]


def _reduced(part: Dual, loads: Floats) -> Dual:
    """A dual by design and loads as one by the design alone."""
    before = loads.shape[1]
    return Dual(part.value, part.gradient[:, :before] + part.gradient[:, before:] @ loads)
