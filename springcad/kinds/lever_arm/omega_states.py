"""Both halves of an omega leaf at full stroke, with gradients: linear and geometrically exact.

The hub moves to (u, y_A). The left half is the mirror image of the right half moved to -u and
turned the other way, so both are told as states of the right half, at +u and at -u. With F and m
force and moment about the hub's middle that the hub exerts on a half, r(s) its deformed line and
r_O the moved middle,

    psi = theta - int_s^L M/EJ + kappa e ds,     e = (N + kappa M)/EA,     N = -F.t,  V = -F.n,
    r = B - int_s^L (1 + e) t(psi) + (V/GA_s) n(psi) ds,     M = (r - r_O) x F - m.

This is Winkler's curved bar: fibres on the inside of a bend are shorter, so that
J = int y^2/(1 - kappa y) dA takes the place of I, and bending stretches the middle line. For a
straight bar it is the beam of ``springcad.mechanics.beam``.

At the hub each half must end where the turned hub is; the hub's turn is common (that of the state
at -u is opposite), and so is m, because the moments of both halves on the hub cancel. In the
linear theory m = 0 follows, and the two states are opposite to each other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.omega import OmegaCase
from springcad.kinds.lever_arm.omega_form import Half, basis
from springcad.mechanics.section import SHEAR_CORRECTION
from springcad.optimise import dual
from springcad.optimise.dual import Dual

Floats = NDArray[np.float64]

_TOLERANCE = 1e-11
_MAX_ITERATIONS = 12
_LARGEST_STEP = 3.0  # of psi, rad
_LOADS = 3  # force along x and y, moment
_CURVED = 3.0 / np.array([5.0, 7.0, 9.0, 11.0, 13.0])  # J/I - 1 as a series in (kappa h/2)^2


@dataclass(frozen=True)
class HalfState:
    """One half at the nodes, with gradients; lengths over R_c, forces per width over E R_c."""

    x: Dual
    y: Dual
    moment: Dual
    tension: Dual

    @property
    def bare(self) -> HalfState:
        """The values alone."""
        return HalfState(self.x.bare, self.y.bare, self.moment.bare, self.tension.bare)


@dataclass(frozen=True)
class States:
    """The right half at +u and at -u; ``force`` is that of the lever on the whole spring."""

    plus: HalfState
    minus: HalfState
    force: Dual


def shear_softness(case: OmegaCase) -> float:
    """E A over the shear stiffness G A_s."""
    return case.elastic_modulus / (SHEAR_CORRECTION * case.shear_modulus)


@dataclass(frozen=True)
class _Softness:
    """12/(h^3 J/I) for bending and 1/h for stretch, and the curvature, at the nodes."""

    bending: Dual
    direct: Dual
    curvature: Dual


def _softness(half: Half) -> _Softness:
    ratio = 0.5 * (half.node_bend * half.thickness)
    square = ratio * ratio
    powers, stiffer = square, 1.0 + _CURVED[0] * square
    for factor in _CURVED[1:].tolist():
        powers = powers * square
        stiffer = stiffer + factor * powers
    bending = 12.0 * (dual.power(half.thickness, -3.0) * dual.power(stiffer, -1.0))
    return _Softness(bending, dual.power(half.thickness, -1.0), half.node_bend)


def linear_states(case: OmegaCase, half: Half) -> States:
    """Small displacements: one 2 x 2 flexibility of the half at the hub's middle."""
    to_end, weights = basis().to_end, basis().grid.weights[None, :]
    x, y, soft = half.x, half.y - half.middle, _softness(half)
    cos, sin = dual.cos(half.angle), dual.sin(half.angle)
    # Stretch under unit forces, with the part that comes from bending.
    by_x, by_y = cos + soft.curvature * y, sin - soft.curvature * x
    slide = shear_softness(case)
    u = case.stroke / case.enclosure_radius

    def integral(density: Dual) -> Dual:
        return half.length * density.mapped(weights)

    xx = integral(soft.bending * y * y + soft.direct * (by_x * by_x + slide * (sin * sin)))
    yy = integral(soft.bending * x * x + soft.direct * (by_y * by_y + slide * (cos * cos)))
    xy = integral(soft.direct * (by_x * by_y - slide * (sin * cos)) - soft.bending * x * y)
    scale = dual.power(xx * yy - xy * xy, -1.0)
    force_x, force_y = u * (yy * scale), -u * (xy * scale)

    moment = x * force_y - y * force_x
    tension, shear = -(force_x * cos + force_y * sin), force_x * sin - force_y * cos
    stretch = soft.direct * (tension + soft.curvature * moment)
    bent = soft.bending * moment + soft.curvature * stretch
    across = slide * (soft.direct * shear) - half.length * bent.mapped(to_end)
    move_x = -(half.length * (stretch * cos - across * sin).mapped(to_end))
    move_y = -(half.length * (stretch * sin + across * cos).mapped(to_end))
    return States(
        HalfState(half.x + move_x, half.y + move_y, moment, tension),
        HalfState(half.x - move_x, half.y - move_y, -moment, -tension),
        2.0 * force_x,
    )


@dataclass
class Guess:
    """Where Newton's method begins, for both states: psi and M (2, N), loads Fx, Fy, m (2, 3)."""

    angles: Floats
    moments: Floats
    loads: Floats


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
    bare = half.bare
    for step in range(1, steps + 1):
        guess = equilibrium(case, bare, guess, step / steps)
    loads = [_load_duals(half, guess.loads[k]) for k in range(2)]
    u = case.stroke / case.enclosure_radius
    ends, fields = [], []
    for k, side in enumerate((1.0, -1.0)):
        q = guess.angles[k], guess.moments[k]
        angle, moment, _ = _step(case, half, q, loads[k], side * u)
        fields.append(_field(case, half, (angle, moment), loads[k], side * u))
        ends.append(_end_gap(case, half, fields[k], angle, side * u))
    turns = _by_design(ends, half.length.gradient.shape[1])
    states = [
        HalfState(*(_reduced(part, turns[k]) for part in (f.x, f.y, f.moment, f.tension)))
        for k, f in enumerate(fields)
    ]
    force = _reduced(loads[0][0], turns[0]) - _reduced(loads[1][0], turns[1])
    return States(states[0], states[1], force), guess


def state_of(case: OmegaCase, half: Half, guess: Guess, k: int, u: float) -> HalfState:
    """The right half in state ``k`` of an equilibrium, with the hub at ``u`` (over R_c)."""
    none = np.zeros((len(guess.angles[k]), _LOADS))
    angle, moment = Dual(guess.angles[k], none), Dual(guess.moments[k], none)
    return _field(case, half, (angle, moment), _load_duals(half, guess.loads[k]), u)


def energy_of(case: OmegaCase, half: Half, state: HalfState, shear: Floats) -> float:
    """Of bending, stretch and shear of a half, over E R_c^2 and width."""
    soft = _softness(half)
    direct = soft.direct.value
    stretched = state.tension.value + soft.curvature.value * state.moment.value
    density = (
        soft.bending.value * state.moment.value**2
        + direct * stretched**2
        + shear_softness(case) * direct * shear**2
    )
    return float(0.5 * half.length.value[0] * (basis().grid.weights @ density))


def _load_duals(half: Half, loads: Floats) -> list[Dual]:
    """Loads as further variables behind those of the half."""
    before = half.length.gradient.shape[1]
    columns = np.hstack([np.zeros((_LOADS, before)), np.eye(_LOADS)])
    return [Dual(loads[[k]], columns[[k]]) for k in range(_LOADS)]


def _wide(part: Dual) -> Dual:
    """With columns for the loads behind those of the design."""
    return Dual(part.value, np.hstack([part.gradient, np.zeros((len(part.value), _LOADS))]))


def _field(
    case: OmegaCase, half: Half, q: tuple[Dual, Dual], loads: list[Dual], u: float
) -> HalfState:
    """Positions, moment and tension that follow from psi, M and the loads."""
    to_end, soft = basis().to_end, _softness(half)
    (angle, moment), (force_x, force_y, hub_moment) = q, loads
    cos, sin = dual.cos(angle), dual.sin(angle)
    tension, shear = -(force_x * cos + force_y * sin), force_x * sin - force_y * cos
    direct, length = _wide(soft.direct), _wide(half.length)
    stretch = 1.0 + direct * (tension + _wide(soft.curvature) * moment)
    slide = shear_softness(case) * (direct * shear)
    x = _wide(half.end_x) - length * (stretch * cos - slide * sin).mapped(to_end)
    y = _wide(half.end_y) - length * (stretch * sin + slide * cos).mapped(to_end)
    follows = (x - u) * force_y - (y - _wide(half.middle)) * force_x - hub_moment
    return HalfState(x, y, follows, tension)


def _step(
    case: OmegaCase, half: Half, q: tuple[Floats, Floats], loads: list[Dual], u: float
) -> tuple[Dual, Dual, float]:
    """One Newton step for psi and M at given loads, with gradients, and the step of psi."""
    to_end, soft, count = basis().to_end, _softness(half), len(q[0])
    none = np.zeros((count, loads[0].gradient.shape[1]))
    psi, moment = Dual(q[0], none), Dual(q[1], none)
    field = _field(case, half, (psi, moment), loads, u)
    bending, direct, curvature = (_wide(part) for part in vars(soft).values())
    stretch = direct * (field.tension + curvature * moment)
    bent = _wide(half.length) * (bending * moment + curvature * stretch).mapped(to_end)
    residual = dual.stacked([psi - _wide(half.angle) + bent, moment - field.moment])
    matrix = _tangent(case, half, soft, (q[0], stretch.value, field.tension.value), loads)
    right = np.column_stack([residual.value, residual.gradient])
    step: Floats = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    turned = Dual(q[0] - step[:count, 0], -step[:count, 1:])
    bent_by = Dual(q[1] - step[count:, 0], -step[count:, 1:])
    return turned, bent_by, float(np.max(np.abs(step[:count, 0])))


def _tangent(
    case: OmegaCase,
    half: Half,
    soft: _Softness,
    fields: tuple[Floats, Floats, Floats],
    loads: list[Dual],
) -> Floats:
    """Derivative of both residuals by psi and M (2 N, 2 N), from psi, stretch and tension."""
    angle, stretch, tension = fields
    force_x, force_y = loads[0].value, loads[1].value
    cos, sin = np.cos(angle), np.sin(angle)
    bending, direct, curvature = (part.value for part in vars(soft).values())
    to_end, slide = half.length.value * basis().to_end, shear_softness(case)
    shear = force_x * sin - force_y * cos
    along = (1.0 - slide) * direct * shear
    beside = 1.0 + stretch - slide * direct * tension
    lever = (along * cos - beside * sin) * force_y - (along * sin + beside * cos) * force_x
    one, both = np.eye(len(angle)), curvature * direct * shear
    by_moment = to_end * (bending + curvature**2 * direct)
    return np.block([[one + to_end * both, by_moment], [to_end * lever, one - to_end * both]])


def _end_gap(case: OmegaCase, half: Half, field: HalfState, angle: Dual, u: float) -> Dual:
    """Distance of the half's beginning from the turned hub's edge, x and y, and the hub's turn."""
    start = _start_values()
    psi, hub = angle.mapped(start), case.hub_radius / case.enclosure_radius
    return dual.stacked(
        [
            field.x.mapped(start) - u - hub * dual.cos(psi),
            field.y.mapped(start) - _wide(half.middle) - hub * dual.sin(psi),
            psi - _wide(half.start_angle),
        ]
    )


def _start_values() -> Floats:
    """Row that takes nodal values to the value at s = 0."""
    return basis().at_points[:1]


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


def equilibrium(case: OmegaCase, half: Half, guess: Guess, share: float) -> Guess:
    """Equilibrium of both halves at a share of the stroke; ``half`` without gradient.

    Raises:
        ArithmeticError: no equilibrium found.
    """
    u = share * case.stroke / case.enclosure_radius
    angles, moments, loads = guess.angles.copy(), guess.moments.copy(), guess.loads.copy()
    for _ in range(_MAX_ITERATIONS):
        ends, moved, size = [], [], 0.0
        for k, side in enumerate((1.0, -1.0)):
            forces = _load_duals(half, loads[k])
            angle, moment, step = _step(case, half, (angles[k], moments[k]), forces, side * u)
            field = _field(case, half, (angle, moment), forces, side * u)
            ends.append(_end_gap(case, half, field, angle, side * u))
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
