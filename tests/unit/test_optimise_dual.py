"""Arrays that carry gradients: every rule against central differences."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from springcad.optimise import dual
from springcad.optimise.dual import Dual

POINT = np.array([0.7, -0.4, 1.3])
MATRIX = np.array([[1.0, 2.0, -1.0], [0.5, 0.1, 0.3], [2.0, -1.0, 0.4], [0.2, 0.9, 1.1]])

FORMULAS: dict[str, Callable[[np.ndarray], Dual]] = {
    "sum": lambda v: lines(v) + scalar(v) + 2.0,
    "difference": lambda v: 1.0 - lines(v) - (scalar(v) - 0.5),
    "product": lambda v: lines(v) * lines(v) * scalar(v) * np.arange(1.0, 5.0),
    "trigonometric": lambda v: dual.sin(lines(v)) * dual.cos(2.0 * lines(v)),
    "power": lambda v: dual.power(lines(v) * lines(v) + 1.0, -1.5),
    "absolute": lambda v: dual.absolute(lines(v)),
    "mapped": lambda v: (lines(v) * lines(v)).mapped(MATRIX.T),
    "stacked rows": lambda v: dual.stacked([lines(v)[np.array([2, 0])], -scalar(v)]),
}


def lines(variables: np.ndarray) -> Dual:
    return dual.linear(MATRIX, variables, slice(0, 3))


def scalar(variables: np.ndarray) -> Dual:
    return dual.variable(variables, -1)


@pytest.mark.parametrize("name", FORMULAS)
def test_gradient_is_the_derivative_of_the_value(name: str) -> None:
    formula, step = FORMULAS[name], 1e-6
    columns = [
        (formula(POINT + change).value - formula(POINT - change).value) / (2.0 * step)
        for change in step * np.eye(3)
    ]
    np.testing.assert_allclose(formula(POINT).gradient, np.transpose(columns), atol=2e-9)
