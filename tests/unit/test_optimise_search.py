"""The multi-start search: known optima, the same answer every time, starts that are independent."""

from __future__ import annotations

import numpy as np
import pytest

from springcad.optimise.random import uniform
from springcad.optimise.sqp import Evaluation, Solution, best, solve, solve_from_many

BOUNDS = (np.ones(4), np.full(4, 5.0))


def hock_schittkowski_71(v: np.ndarray) -> Evaluation:
    """Hock and Schittkowski (1981), problem 71: optimum 17.0140173 with one constraint of each."""
    a, b, c, d = v
    return Evaluation(
        objective=a * d * (a + b + c) + c,
        gradient=np.array([d * (2 * a + b + c), a * d, a * d + 1.0, a * (a + b + c)]),
        equalities=np.array([v @ v - 40.0]),
        equality_jacobian=2.0 * v[None, :],
        inequalities=np.array([a * b * c * d - 25.0]),
        inequality_jacobian=np.array([[b * c * d, a * c * d, a * b * d, a * b * c]]),
    )


def test_a_published_problem_is_solved() -> None:
    found = solve(hock_schittkowski_71, np.array([1.0, 5.0, 5.0, 1.0]), BOUNDS, tolerance=1e-10)
    assert found.objective == pytest.approx(17.0140173, abs=1e-7)
    np.testing.assert_allclose(found.variables, [1.0, 4.7429994, 3.8211503, 1.3794082], atol=1e-6)
    assert found.violation < 1e-9


def test_each_point_is_evaluated_once() -> None:
    """Values and gradients come together; only the end is looked at again."""
    points: list[tuple[float, ...]] = []

    def counted(v: np.ndarray) -> Evaluation:
        points.append(tuple(v))
        return hock_schittkowski_71(v)

    solve(counted, np.array([1.0, 5.0, 5.0, 1.0]), BOUNDS)
    assert len(points) > 5
    assert len(set(points)) >= len(points) - 1


def test_the_violation_is_the_largest_broken_constraint() -> None:
    at = hock_schittkowski_71(np.array([1.0, 2.0, 3.0, 4.0]))
    assert at.violation == pytest.approx(10.0)  # 30 - 40; and 24 - 25 for the other one


def test_searches_do_not_depend_on_each_other() -> None:
    starts = [1.0 + 4.0 * uniform(3, index, 4) for index in range(4)]
    together = solve_from_many(hock_schittkowski_71, starts, BOUNDS)
    alone = solve_from_many(hock_schittkowski_71, starts[2:3], BOUNDS)
    np.testing.assert_array_equal(together[2].variables, alone[0].variables)


def test_the_winner_is_feasible_and_the_first_of_equals() -> None:
    def solution(start: int, objective: float, violation: float) -> Solution:
        return Solution(start, np.zeros(1), objective, violation, 1)

    tried = [
        solution(0, -9.0, 1e-2),
        solution(1, -1.0, 0.0),
        solution(2, -1.0 - 1e-9, 0.0),
        solution(3, 0.0, 0.0),
    ]
    winner = best(tried, feasible_below=1e-6)
    assert winner is not None
    assert winner.start == 1
    assert best(tried[:1], feasible_below=1e-6) is None


def test_random_numbers_are_the_same_for_ever() -> None:
    """The raw stream of PCG64 seeded with (1, 2) is numpy's promise; the mapping is ours."""
    raw = np.random.PCG64(np.random.SeedSequence([1, 2])).random_raw(1000)
    expected = (np.asarray(raw, dtype=np.uint64) // 2048).astype(float) / 2.0**53
    drawn = uniform(1, 2, 1000)
    np.testing.assert_array_equal(drawn, expected)
    assert drawn.min() >= 0.0
    assert drawn.max() < 1.0
    assert abs(drawn.mean() - 0.5) < 0.03
    np.testing.assert_array_equal(uniform(1, 2, 10), drawn[:10])
    assert not np.array_equal(uniform(1, 3, 10), drawn[:10])
