"""Sequential quadratic programming on problems that give values and exact gradients together."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import fmin_slsqp
from threadpoolctl import threadpool_limits

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Evaluation:
    """Objective and constraints at one point, with gradients.

    ``equalities`` must vanish and ``inequalities`` must not be negative; shapes (E,) and (I,),
    their Jacobians (E, V) and (I, V). Everything is expected to be scaled to order one.
    """

    objective: float
    gradient: Floats
    equalities: Floats
    equality_jacobian: Floats
    inequalities: Floats
    inequality_jacobian: Floats

    @property
    def violation(self) -> float:
        """Largest constraint violation, 0 for a feasible point."""
        equality = np.max(np.abs(self.equalities), initial=0.0)
        return float(max(equality, np.max(-self.inequalities, initial=0.0)))


Problem = Callable[[Floats], Evaluation]


@dataclass(frozen=True)
class Solution:
    """Where a local search ended, and what holds there."""

    start: int
    variables: Floats
    objective: float
    violation: float
    iterations: int


class _Parts:
    """The parts of a problem one by one, as SLSQP asks for them, from one evaluation a point."""

    def __init__(self, problem: Problem, values: Problem | None) -> None:
        self._problem = problem
        self._values = values
        self._last: tuple[Floats, Evaluation] | None = None
        self._last_values: tuple[Floats, Evaluation] | None = None

    def _at(self, variables: Floats) -> Evaluation:
        if self._last is None or not np.array_equal(variables, self._last[0]):
            self._last = variables.copy(), self._problem(variables)
        return self._last[1]

    def _values_at(self, variables: Floats) -> Evaluation:
        if self._values is None:
            return self._at(variables)
        if self._last is not None and np.array_equal(variables, self._last[0]):
            return self._last[1]
        if self._last_values is None or not np.array_equal(variables, self._last_values[0]):
            self._last_values = variables.copy(), self._values(variables)
        return self._last_values[1]

    def objective(self, variables: Floats) -> float:
        return self._values_at(variables).objective

    def gradient(self, variables: Floats) -> Floats:
        return self._at(variables).gradient

    def equalities(self, variables: Floats) -> Floats:
        return self._values_at(variables).equalities

    def equality_jacobian(self, variables: Floats) -> Floats:
        return self._at(variables).equality_jacobian

    def inequalities(self, variables: Floats) -> Floats:
        return self._values_at(variables).inequalities

    def inequality_jacobian(self, variables: Floats) -> Floats:
        return self._at(variables).inequality_jacobian


def solve(
    problem: Problem,
    start: Floats,
    bounds: tuple[Floats, Floats],
    *,
    values: Problem | None = None,
    index: int = 0,
    max_iterations: int = 200,
    tolerance: float = 1e-6,
) -> Solution:
    """Local minimum near ``start`` by SLSQP (scipy) with the problem's own gradients.

    Args:
        problem: values and gradients at a point (V,).
        start: first point (V,); clipped to the bounds.
        bounds: lower and upper bounds, each (V,).
        values: the problem's values alone (its gradients are not read), where that is cheaper:
            line searches need no more.
        index: number of this start, kept in the solution.
        max_iterations: the search is bounded by this count.
        tolerance: SLSQP's ``ftol`` on the objective.
    """
    lower, upper = bounds
    parts = _Parts(problem, values)
    found, _, iterations, *_ = fmin_slsqp(
        parts.objective,
        np.clip(start, lower, upper).tolist(),
        fprime=parts.gradient,
        f_eqcons=parts.equalities,
        fprime_eqcons=parts.equality_jacobian,
        f_ieqcons=parts.inequalities,
        fprime_ieqcons=parts.inequality_jacobian,
        bounds=list(zip(lower.tolist(), upper.tolist(), strict=True)),
        iter=max_iterations,
        acc=tolerance,
        iprint=0,
        full_output=True,
    )
    variables = np.clip(found, lower, upper)
    end = problem(variables)
    return Solution(index, variables, end.objective, end.violation, int(iterations))


def solve_from_many(
    problem: Problem,
    starts: Iterable[Floats],
    bounds: tuple[Floats, Floats],
    *,
    values: Problem | None = None,
    max_iterations: int = 200,
    tolerance: float = 1e-6,
    progress: Callable[[str], None] = lambda _: None,
) -> list[Solution]:
    """Local minima from every start, in the order of the starts, on one BLAS thread.

    More threads would spin on these small matrices and make the last digits depend on the load.
    """
    solutions = []
    with threadpool_limits(1, user_api="blas"):
        for index, start in enumerate(starts):
            solution = solve(
                problem,
                start,
                bounds,
                values=values,
                index=index,
                max_iterations=max_iterations,
                tolerance=tolerance,
            )
            progress(f"start {index + 1}: objective {solution.objective:.4f}")
            solutions.append(solution)
    return solutions


def best(
    solutions: Iterable[Solution], *, feasible_below: float, as_good: float = 1e-3
) -> Solution | None:
    """The first feasible solution whose objective is within ``as_good`` of the lowest.

    Many starts end in the same optimum, apart from the last digits of the arithmetic; which of
    them is lowest must not decide.
    """
    feasible = [s for s in solutions if s.violation <= feasible_below]
    lowest = min((s.objective for s in feasible), default=0.0)
    return next((s for s in feasible if s.objective <= lowest + as_good), None)
