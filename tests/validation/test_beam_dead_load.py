"""A force of fixed direction: always the state that is reached by raising it from zero."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from springcad.mechanics.beam import BeamStates, PreparedBeam, RibbonBeam, follower_load, prepare
from springcad.mechanics.dead_load import dead_load

E_MODULUS, SHEAR_MODULUS, THICKNESS = 200e9, 77e9, 4.5e-3


def uniform(length: float, half_thickness: float) -> PreparedBeam:
    return prepare(
        RibbonBeam(
            np.linspace(0.0, length, 9),
            np.zeros_like,
            lambda s: np.full_like(s, half_thickness),
            root_angle=0.0,
            thickness=THICKNESS,
            elastic_modulus=E_MODULUS,
            shear_modulus=SHEAR_MODULUS,
        )
    )


def bending_stiffness(half_thickness: float) -> float:
    return E_MODULUS * 2 * THICKNESS * half_thickness**3 / 3


LENGTH, ROOT_ANGLE, ROOT_COMPLIANCE = 25e-3, 0.1, 0.2


def curvature(s: np.ndarray) -> np.ndarray:
    return 100.0 * np.sin(400.0 * s)


def half_thickness(s: np.ndarray) -> np.ndarray:
    return 3e-4 - 1e-4 * (s / LENGTH) ** 2


def curved() -> PreparedBeam:
    """A wavy tapered ribbon on a root spring."""
    return prepare(
        RibbonBeam(
            np.linspace(0.0, LENGTH, 13),
            curvature,
            half_thickness,
            root_angle=ROOT_ANGLE,
            thickness=THICKNESS,
            elastic_modulus=E_MODULUS,
            shear_modulus=SHEAR_MODULUS,
            root_compliance=ROOT_COMPLIANCE,
            nodes_per_panel=8,
        )
    )


def by_collocation(force: np.ndarray, steps: int = 16) -> np.ndarray:
    """End (x, y, ψ) of the curved ribbon from scipy's solve_bvp, the load raised in steps."""

    def slopes(s: np.ndarray, state: np.ndarray, part: float) -> np.ndarray:
        cos, sin = np.cos(state[2]), np.sin(state[2])
        lam, (fx, fy) = half_thickness(s), part * force
        area = 2 * lam * THICKNESS
        stretch = 1 + (fx * cos + fy * sin) / (E_MODULUS * area)
        slide = (fy * cos - fx * sin) / (5 / 6 * SHEAR_MODULUS * area)
        x_slope, y_slope = stretch * cos - slide * sin, stretch * sin + slide * cos
        bend = curvature(s) + state[3] / (E_MODULUS * 2 / 3 * THICKNESS * lam**3)
        return np.stack([x_slope, y_slope, bend, y_slope * fx - x_slope * fy])

    def ends(root: np.ndarray, tip: np.ndarray) -> np.ndarray:
        turned = root[2] - ROOT_ANGLE - ROOT_COMPLIANCE * root[3]
        return np.array([root[0], root[1], turned, tip[3]])

    s = np.linspace(0.0, LENGTH, 61)
    state = np.stack([s, 0.0 * s, ROOT_ANGLE + 0.0 * s, 0.0 * s])
    for part in np.linspace(0.0, 1.0, steps + 1):
        solved = solve_bvp(lambda s, y, p=part: slopes(s, y, p), ends, s, state, tol=1e-6)
        assert solved.success
        s, state = solved.x, solved.y
    return state[:3, -1]


def test_random_loads_agree_with_collocation() -> None:
    """Up to ten times EI/L² in all directions: the end turns by up to 96°."""
    random = np.random.default_rng(3)
    size, direction = random.uniform(20.0, 150.0, 8), random.uniform(-np.pi, np.pi, 8)
    forces = size[:, None] * np.stack([np.cos(direction), np.sin(direction)], axis=-1)
    states = dead_load(curved(), LENGTH, forces)
    rest = dead_load(curved(), LENGTH, [[0.0, 0.0]])
    np.testing.assert_allclose(states.force, forces, atol=1e-7)
    expected = np.array([by_collocation(force) for force in forces])
    deflection = np.hypot(*(states.end_position - rest.end_position).T)
    miss = np.hypot(*(states.end_position - expected[:, :2]).T)
    assert np.max(miss / deflection) < 1e-7
    np.testing.assert_allclose(states.end_rotation, expected[:, 2], atol=1e-7)
    assert np.max(np.abs(states.end_rotation)) > 1.6


def test_a_strong_load_does_not_jump_to_a_loop() -> None:
    """38 EI/L² along the diagonal of a ribbon of 50 x 0.5 mm; two other states bear it as well."""
    length, half = 50e-3, 2.5e-4
    beam, force = uniform(length, half), np.array([100.0, 100.0])
    state = dead_load(beam, length, force)
    assert 0.0 < state.end_rotation[0] < np.pi / 4

    size, direction = np.hypot(*force), np.arctan2(force[1], force[0])
    angles = np.concatenate([np.linspace(-np.pi, -0.2, 300), np.linspace(-0.2, 0.2, 801)])
    tried = follower_load(beam, length, size * np.cos(angles), size * np.sin(angles))
    # The angle between the force that each one bears and the one wanted, between -π and π.
    off = np.angle(np.exp(1j * (angles + tried.end_rotation - direction)))
    balanced = (off[1:] * off[:-1] < 0.0) & (np.abs(np.diff(off)) < 1.0)
    assert np.count_nonzero(balanced) == 3

    rising = dead_load(beam, length, np.linspace(0.0, 1.0, 33)[:, None] * force)
    assert rising.end_rotation[-1] == pytest.approx(state.end_rotation[0], abs=1e-9)
    turns = np.diff(rising.end_rotation)
    assert np.all(turns > 0.0)
    assert np.all(np.diff(turns) < 0.0), "the end turns less and less as the ribbon lines up"


def test_a_compressed_column_bears_no_more_than_eulers_load() -> None:
    """Short of π² EI/4L² it stays straight; beyond, no stable state follows from rest."""
    length, half = 50e-3, 1e-4
    euler = np.pi**2 * bending_stiffness(half) / (4.0 * length**2)
    column = uniform(length, half)
    states = dead_load(column, length, [[-0.999 * euler, 0.0]])
    assert abs(states.end_position[0, 1]) < 1e-9 * length
    with pytest.raises(ArithmeticError, match="buckles or snaps"):
        dead_load(column, length, [[-1.001 * euler, 0.0]])
    with pytest.raises(ArithmeticError, match=r"beyond 6\.2\d+% of the dead load"):
        dead_load(column, length, [[-16.0 * euler, 0.0]])


TIMOSHENKO = {
    1.015: (20.0, 0.970, 0.220),
    1.063: (40.0, 0.881, 0.422),
    1.152: (60.0, 0.741, 0.593),
    1.293: (80.0, 0.560, 0.719),
    1.518: (100.0, 0.349, 0.792),
    1.884: (120.0, 0.123, 0.803),
}
"""P over Euler's load: end rotation in degrees, x/L, y/L (Timoshenko and Gere, Theory of Elastic
Stability, 2nd ed., table 2-4)."""


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_column_pushed_slightly_aside_follows_its_own_buckled_shape(side: float) -> None:
    length, half = 50e-3, 2e-5
    euler = np.pi**2 * bending_stiffness(half) / (4.0 * length**2)
    forces = euler * np.array([[-part, 1e-6 * side] for part in TIMOSHENKO])
    states = dead_load(uniform(length, half), length, forces)
    degrees, x, y = np.array(list(TIMOSHENKO.values())).T
    # The load is given to 5e-4: near the branching that is 0.4° and 0.003 of y.
    np.testing.assert_allclose(side * np.degrees(states.end_rotation), degrees, atol=0.4)
    np.testing.assert_allclose(states.end_position[:, 0] / length, x, atol=2e-3)
    np.testing.assert_allclose(side * states.end_position[:, 1] / length, y, atol=4e-3)


def test_the_work_of_a_dead_load_is_the_energy_stored() -> None:
    works = []
    for steps in (100, 200):
        forces = np.linspace(0.0, 1.0, steps + 1)[:, None] * np.array([-30.0, 60.0])
        states: BeamStates = dead_load(curved(), LENGTH, forces)
        mean = 0.5 * (forces[1:] + forces[:-1])
        works.append(float(np.sum(mean * np.diff(states.end_position, axis=0))))
    extrapolated = works[1] + (works[1] - works[0]) / 3
    assert extrapolated == pytest.approx(states.energy[-1], rel=1e-6)
