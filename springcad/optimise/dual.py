"""Arrays that carry their gradient: exact derivatives by forward differentiation.

With a dozen or two of variables and short arrays this costs little more than the values, and the
formulas stay readable.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Dual:
    """Values (N,) and their derivatives with respect to V variables, (N, V)."""

    value: Floats
    gradient: Floats

    def __add__(self, other: Dual | Floats | float) -> Dual:
        if isinstance(other, Dual):
            return Dual(self.value + other.value, self.gradient + other.gradient)
        return Dual(self.value + other, self.gradient)

    __radd__ = __add__

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.gradient)

    def __sub__(self, other: Dual | Floats | float) -> Dual:
        if isinstance(other, Dual):
            return Dual(self.value - other.value, self.gradient - other.gradient)
        return Dual(self.value - other, self.gradient)

    def __rsub__(self, other: Floats | float) -> Dual:
        return Dual(other - self.value, -self.gradient)

    def __mul__(self, other: Dual | Floats | float) -> Dual:
        if isinstance(other, Dual):
            value = self.value * other.value
            if not self.gradient.shape[1]:
                return _bare(value)
            product = self.value[:, None] * other.gradient
            product += other.value[:, None] * self.gradient
            return Dual(value, product)
        factor = np.asarray(other, dtype=np.float64)
        return Dual(self.value * factor, self.gradient * factor[..., None])

    __rmul__ = __mul__

    def __getitem__(self, rows: slice | list[int] | NDArray[np.intp]) -> Dual:
        return Dual(self.value[rows], self.gradient[rows])

    def through(self, value: Floats, slope: Floats) -> Dual:
        """f(self), given the values of f and of its derivative (N,)."""
        return (
            Dual(value, slope[:, None] * self.gradient) if self.gradient.shape[1] else _bare(value)
        )

    @property
    def bare(self) -> Dual:
        """The values alone, as a dual of no variables: arithmetic on it costs little."""
        return _bare(self.value)

    def mapped(self, matrix: Floats) -> Dual:
        """``matrix`` (M, N) applied to the values and to every derivative."""
        value = matrix @ self.value
        return Dual(value, matrix @ self.gradient) if self.gradient.shape[1] else _bare(value)


def _bare(value: Floats) -> Dual:
    """Values (N,) without variables. Operations make it at once: even empty products take time."""
    return Dual(value, np.empty((len(value), 0)))


def variables(values: Floats) -> Dual:
    """All variables (V,) of a problem at once."""
    return Dual(values, np.eye(len(values)))


def linear(matrix: Floats, variables: Floats, at: slice) -> Dual:
    """``matrix`` (N, K) applied to the K variables ``variables[at]``."""
    gradient = np.zeros((len(matrix), len(variables)))
    gradient[:, at] = matrix
    return Dual(matrix @ variables[at], gradient)


def variable(variables: Floats, index: int) -> Dual:
    """One variable as a dual of length 1, which broadcasts against longer ones."""
    gradient = np.zeros((1, len(variables)))
    gradient[0, index] = 1.0
    return Dual(variables[[index]], gradient)


def stacked(parts: Sequence[Dual]) -> Dual:
    """The duals one after the other."""
    return Dual(
        np.concatenate([part.value for part in parts]),
        np.vstack([part.gradient for part in parts]),
    )


def sin(angle: Dual) -> Dual:
    """Sine."""
    return angle.through(np.sin(angle.value), np.cos(angle.value))


def cos(angle: Dual) -> Dual:
    """Cosine."""
    return angle.through(np.cos(angle.value), -np.sin(angle.value))


def power(base: Dual, exponent: float) -> Dual:
    """A positive base to a fixed power."""
    value = base.value**exponent
    return base.through(value, exponent * value / base.value)


def absolute(signed: Dual) -> Dual:
    """Absolute value; the derivative at zero is taken as zero."""
    return signed.through(np.abs(signed.value), np.sign(signed.value))


def distance(variables: Floats, target: Floats, at: slice) -> Dual:
    """Half the square of the distance of some of the variables from ``target`` (V,), length 1."""
    apart = np.zeros_like(variables)
    apart[at] = (variables - target)[at]
    return Dual(np.array([0.5 * apart @ apart]), apart[None, :])
