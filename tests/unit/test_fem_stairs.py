"""A band of changing width, factorised in stairs, gives what a dense solver gives."""

from __future__ import annotations

import numpy as np
import pytest

from springcad.mechanics.fem.stairs import (
    find_stairs,
    places,
    solve_definite,
    solve_indefinite,
    storage,
)


def stepped(heights, seed=1):
    """A symmetric, positive definite matrix whose column j reaches ``heights[j]`` rows down."""
    random, count = np.random.default_rng(seed), len(heights)
    rows, columns = np.indices((count, count))
    lower = random.normal(size=(count, count)) * (rows >= columns) * (rows - columns <= heights)
    symmetric = lower + lower.T
    return symmetric + np.diag(1.0 + np.abs(symmetric).sum(axis=1))


def solved(matrix, right, solve=solve_definite):
    """By stairs, and how many they were."""
    rows, columns = np.nonzero(matrix)
    stairs = find_stairs(rows, columns, len(matrix))
    lower = rows >= columns
    entries = np.zeros(storage(stairs))
    where = places(stairs, rows[lower], columns[lower])
    entries[where] = matrix[rows[lower], columns[lower]]
    return solve(stairs, entries, right), len(stairs)


WIDTHS = {
    "one width": (np.full(300, 7), 1),
    "wide, then narrow": (np.repeat([150, 10], [400, 1200]), 2),
    "narrow, wide, narrow": (np.repeat([10, 150, 10], [900, 300, 900]), 3),
    "diagonal": (np.zeros(100, dtype=int), 1),
    "one unknown": (np.zeros(1, dtype=int), 1),
}


@pytest.mark.parametrize(("heights", "fewest"), WIDTHS.values(), ids=WIDTHS)
def test_stairs_solve_what_a_dense_solver_solves(heights, fewest):
    matrix = stepped(heights)
    right = np.random.default_rng(2).normal(size=(len(matrix), 2))
    found, count = solved(matrix, right)
    assert count >= fewest
    assert np.abs(matrix @ found - right).max() < 1e-12 * np.abs(right).max()


def test_an_indefinite_matrix_is_solved_too():
    """Beyond a limit point the stiffness has a negative eigenvalue."""
    matrix = stepped(np.repeat([60, 5], [200, 900]))
    matrix -= 0.3 * np.diag(np.diag(matrix))
    matrix[0, 0] *= -1.0
    assert np.linalg.eigvalsh(matrix)[0] < 0.0
    right = np.ones((len(matrix), 1))
    with pytest.raises(np.linalg.LinAlgError):
        solved(matrix, right)
    found, _ = solved(matrix, right, solve_indefinite)
    assert np.abs(matrix @ found - right).max() < 1e-9


def test_a_singular_matrix_is_refused():
    with pytest.raises(ArithmeticError, match="singular"):
        solved(np.diag([1.0, 0.0, 1.0]), np.ones((3, 1)), solve_indefinite)
