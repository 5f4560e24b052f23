"""Supports, ties and multi-point constraints: what is asked for is what is found."""

from __future__ import annotations

import numpy as np
import pytest

from springcad.mechanics.fem.constraints import (
    Equations,
    combine,
    prescribe,
    solve_constraints,
    tie,
)


def test_every_equation_holds_for_any_free_unknowns():
    """Also for the node 1, tied to 2 by a quarter turn, which is tied to 3, which is held in y."""
    equations = combine(
        tie([1], [2], 0.5 * np.pi), tie([2], [3], 0.1), prescribe([3], 2e-3, components=(1,))
    )
    constraints = solve_constraints(10, equations)
    free = np.random.default_rng(3).standard_normal(constraints.transform.shape[1])
    u = constraints.transform @ free + constraints.lift @ constraints.constants
    masters = np.zeros(len(equations.slaves))
    np.add.at(masters, equations.rows, equations.factors * u[equations.masters])
    assert u[equations.slaves] == pytest.approx(masters + equations.constants, abs=1e-15)
    assert u[7] == 2e-3
    assert u[2:4] == pytest.approx([-u[5], u[4]], abs=1e-15)
    assert len(free) == 10 - 5


def test_a_component_constrained_twice_is_named():
    with pytest.raises(ValueError, match="component 1 of node 4 is constrained twice"):
        solve_constraints(12, prescribe([4]), prescribe([4, 5], components=(1,)))


def test_a_circle_of_ties_is_refused():
    with pytest.raises(ValueError, match="circle"):
        solve_constraints(8, tie([1], [2]), tie([2], [1]))


def test_ties_need_pairs():
    with pytest.raises(ValueError, match="as many slave nodes"):
        tie([1, 2], [3])


def test_a_multi_point_constraint_takes_any_factors():
    """A node that stays at the middle of two others, 1 mm above."""
    middle = Equations(
        np.array([1]), np.array([1e-3]), np.array([0, 0]), np.array([3, 5]), np.array([0.5, 0.5])
    )
    constraints = solve_constraints(6, middle)
    u = constraints.transform @ np.arange(5.0) + constraints.lift @ constraints.constants
    assert u[1] == pytest.approx(0.5 * (u[3] + u[5]) + 1e-3)
