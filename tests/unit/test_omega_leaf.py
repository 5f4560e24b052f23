"""The omega leaf's search: exact gradients, states in balance, starts that depend on the seed."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from lever_cases import STEEL

from springcad.kinds.lever_arm.omega import (
    OmegaLeaf,
    half_ribbon,
    half_start,
    omega_response,
)
from springcad.kinds.lever_arm.omega_form import VARIABLES, leaf_of, variables_of
from springcad.kinds.lever_arm.omega_problem import ExactProblem, linear_problem
from springcad.kinds.lever_arm.omega_starts import start_point
from springcad.optimise.sqp import Evaluation, Problem

CASE = replace(STEEL, topology="omega")


def together(at: Evaluation) -> np.ndarray:
    return np.concatenate([[at.objective], at.equalities, at.inequalities])


def jacobian(at: Evaluation) -> np.ndarray:
    return np.vstack([at.gradient, at.equality_jacobian, at.inequality_jacobian])


@pytest.mark.parametrize("problem", [partial(linear_problem, CASE), ExactProblem(CASE)])
def test_gradients_are_those_of_the_values(problem: Problem) -> None:
    # An even thickness would have equal stresses and gaps, between which the smallest has a kink.
    variables, step = start_point(CASE, 1, 3) + 0.01 * np.sin(np.arange(VARIABLES)), 1e-6
    exact = jacobian(problem(variables))
    differences = np.empty_like(exact)
    for index in range(VARIABLES):
        change = np.zeros(VARIABLES)
        change[index] = step
        above, below = together(problem(variables + change)), together(problem(variables - change))
        differences[:, index] = (above - below) / (2.0 * step)
    scale = 1.0 + np.abs(differences).max(axis=1, keepdims=True)
    np.testing.assert_allclose(exact / scale, differences / scale, atol=1e-6)


@pytest.mark.parametrize("problem", [partial(linear_problem, CASE), ExactProblem(CASE)])
def test_values_alone_are_the_same_values(problem: Problem) -> None:
    variables = start_point(CASE, 1, 3)
    full, bare = problem(variables), problem(variables, slopes=False)  # type: ignore[call-arg]
    np.testing.assert_allclose(together(bare), together(full), rtol=1e-9, atol=1e-9)
    assert bare.gradient.size == 0


def test_a_start_depends_on_its_seed_and_number_alone() -> None:
    np.testing.assert_array_equal(start_point(CASE, 1, 2), start_point(CASE, 1, 2))
    assert not np.allclose(start_point(CASE, 1, 2), start_point(CASE, 2, 2))


def test_a_start_of_an_omega_bends_one_way_and_ends_at_the_wall() -> None:
    leaf = leaf_of(CASE, start_point(CASE, 1, 3))
    ribbon = half_ribbon(leaf)
    points = ribbon.at(np.linspace(0.0, leaf.length, 200))
    assert np.all(points.curvature < 1e-6 / leaf.length)
    end = half_start(leaf) + np.array([points.x[-1], points.y[-1]])
    assert np.hypot(*end) == pytest.approx(CASE.enclosure_radius, abs=CASE.hub_radius)


def test_a_leaf_and_its_variables_are_the_same() -> None:
    variables = start_point(CASE, 1, 3)
    np.testing.assert_allclose(variables_of(CASE, leaf_of(CASE, variables)), variables, atol=1e-8)


def test_the_spring_is_odd_in_its_displacement() -> None:
    leaf = leaf_of(CASE, start_point(CASE, 1, 3))
    states = omega_response(leaf, CASE, 3e-3, np.array([-4e-3, 0.0, 4e-3]))
    np.testing.assert_allclose(states.force, -states.force[::-1], atol=1e-9)
    np.testing.assert_array_equal(states.right_stress[0], states.left_stress[2])
    np.testing.assert_allclose(states.right[0] * [-1.0, 1.0], states.left[2])


def test_gaps_of_a_straight_leaf_are_seen() -> None:
    """Straight out from the hub, 6 mm thick, 30 mm above the enclosure's middle."""
    leaf = OmegaLeaf(np.zeros(11), np.full(10, 6e-3), 20e-3, 30e-3, 5e-3)
    rest = omega_response(leaf, CASE, 3e-3, np.zeros(1))
    assert rest.corridor_gap[0] == pytest.approx(np.hypot(5.0, 12.0) * 1e-3 - 9e-3)
    # The last millimetre is that in which the gap closes towards the clamp.
    assert rest.wall_gap[0] == pytest.approx(47e-3 - np.hypot(24e-3, 30e-3), abs=5e-5)
