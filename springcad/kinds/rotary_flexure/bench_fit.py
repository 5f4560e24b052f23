"""Least squares of a bench test: estimates, how sure they are, and what the data cannot tell.

Two errors of an estimate are kept apart. The *standard error* comes from the scatter of the points
(with the correlation of one with the next), and goes down as points are added. The *model error*
does not: it is the largest change of the estimate that a torque curve could make which differs
from the model's by ``MODEL_ERROR`` of the peak torque, root mean square, in the worst way.
An estimate counts as known when twice the first and the second are both below a limit. This also
finds what looks alike: two numbers that change the curve in nearly the same way have large model
errors, however little the points scatter.

Friction that is not known well, by noise or because one coefficient does not explain the loop,
stays in the fit wherever the data tell it from the stiffness: left out, the loop would be scatter
of the stiffness, of which the mean of loading and unloading tells.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from springcad.kinds.rotary_flexure.bench_model import Bench, BenchModel

Floats = NDArray[np.float64]

MODEL_ERROR = 0.003
"""Of the peak torque: contact finite elements of S1 to S4 are within 0.4 % of the model."""
LARGEST_CORRELATION = 0.95
"""Of a residual with the next, that is believed."""
BOUNDS = {
    "modulus": (0.3, 3.0),
    "root": (-8.0, 24.0),
    "friction": (-0.1, 0.45),
    "angle": (-0.2, 0.2),
    "torque": (-math.inf, math.inf),
}
"""Within which a number is looked for."""
_LIMITS = {"modulus": 0.03, "root": 2.5, "friction": 0.05}
_OFFSET_LIMIT = 0.02
_OTHERS = (("friction", "angle", "torque"), ("friction", "angle"), ("angle",), ("friction",), ())
ALIKE = 0.9
"""Correlation from which on two numbers are called alike."""
END = 1e-3
_NOTHING = 1e-9


@dataclass(frozen=True)
class Points:
    """What was measured (N,): angle [rad], torque [N m], +1 while the angle was growing or -1."""

    angle: Floats
    torque: Floats
    travel: NDArray[np.intp]


@dataclass(frozen=True)
class Fit:
    """The numbers ``free`` (K of them) fitted, the others as in the start.

    Attributes:
        bench: all numbers.
        free: names of fields of ``Bench``.
        covariance: of the fitted ones (K, K).
        model_errors: of each (K,).
        correlation: of each with each, as the design of the test has it (K, K).
        condition: number of the sensitivities, each over its own length.
        scatter: root mean square of what is left, over the peak torque.
    """

    bench: Bench
    free: tuple[str, ...]
    covariance: Floats
    model_errors: Floats
    correlation: Floats
    condition: float
    scatter: float

    def standard_error(self, name: str) -> float:
        """Of a fitted number."""
        index = self.free.index(name)
        return math.sqrt(self.covariance[index, index])

    def model_error(self, name: str) -> float:
        """Of a fitted number."""
        return float(self.model_errors[self.free.index(name)])

    def partner(self, name: str) -> tuple[str, float]:
        """The other number that is correlated most with this one, and the correlation."""
        row = self.correlation[self.free.index(name)].copy()
        row[self.free.index(name)] = 0.0
        index = int(np.argmax(np.abs(row)))
        return self.free[index], float(row[index])


def limit(model: BenchModel, name: str) -> float:
    """Largest error with which a number counts as known."""
    if name == "angle":
        return _OFFSET_LIMIT * model.reach
    return _OFFSET_LIMIT * model.peak_torque if name == "torque" else _LIMITS[name]


def fit(model: BenchModel, points: Points, start: Bench, free: Sequence[str]) -> Fit:
    """Fit the numbers ``free`` by least squares of the torque, from ``start``."""

    def left(values: Floats) -> Floats:
        return _left(model, points, replace_all(start, free, values))

    bounds = np.array([BOUNDS[name] for name in free]).T
    found = least_squares(
        left,
        np.array([getattr(start, name) for name in free]),
        jac="3-point",
        bounds=(bounds[0], bounds[1]),
        x_scale=np.array([limit(model, name) for name in free]),
        xtol=1e-12,
        ftol=1e-12,
        gtol=1e-12,
    )
    return _judged(replace_all(start, free, found.x), tuple(free), found.fun, np.asarray(found.jac))


def first_known(
    model: BenchModel, points: Points, start: Bench, wanted: Sequence[str]
) -> Fit | None:
    """The fit of ``wanted`` and as many others as can be known with them; None if there is none.

    An offset of the torque is given up first: to a linear spring it is one of the angle. Friction
    may be unknown where it is told from what is wanted; it is then fitted all the same.
    """
    for others in _OTHERS:
        found = fit(model, points, start, (*wanted, *others))
        missing = unknown(model, found)
        if not missing or (missing == ("friction",) and friction_apart(found, wanted)):
            return found
    return None


def friction_apart(found: Fit, wanted: Sequence[str]) -> bool:
    """Whether the test tells friction from ``wanted``: it does with loading and unloading."""
    row = found.correlation[found.free.index("friction")]
    return all(abs(row[found.free.index(name)]) < ALIKE for name in wanted)


def at_end(found: Fit) -> tuple[str, ...]:
    """Fitted numbers at an end of where they are looked for."""
    return tuple(
        name
        for name in found.free
        if np.isclose(getattr(found.bench, name), BOUNDS[name], rtol=0.0, atol=END).any()
    )


def unknown(model: BenchModel, found: Fit) -> tuple[str, ...]:
    """Fitted numbers of which the errors are too large."""
    return tuple(
        name
        for name in found.free
        if max(2.0 * found.standard_error(name), found.model_error(name)) > limit(model, name)
    )


def scatter(model: BenchModel, points: Points, bench: Bench) -> float:
    """Root mean square of what ``bench`` leaves, over the peak torque."""
    return math.sqrt(float(np.mean(_left(model, points, bench) ** 2)))


def _left(model: BenchModel, points: Points, bench: Bench) -> Floats:
    """What the model shows less what was measured, over the peak torque (N,)."""
    shown = model.torque(bench, points.angle, points.travel)
    return np.asarray((shown - points.torque) / model.peak_torque)


def replace_all(bench: Bench, names: Sequence[str], values: Floats) -> Bench:
    """``bench`` with the numbers ``names`` replaced."""
    return replace(bench, **dict(zip(names, values.tolist(), strict=True)))


def _judged(bench: Bench, free: tuple[str, ...], left: Floats, jacobian: Floats) -> Fit:
    """The fit with its errors; what is left and its derivatives are over the peak torque."""
    # A number that the points do not depend on is unknown, and no error.
    length = np.maximum(np.linalg.norm(jacobian, axis=0), _NOTHING)
    _, singular, modes = np.linalg.svd(jacobian / length, full_matrices=False)
    singular = np.maximum(singular, _NOTHING)
    inverse = (modes.T / singular**2) @ modes / np.outer(length, length)
    spread = np.sqrt(np.diag(inverse))
    square = float(left @ left)
    alike = float(left[1:] @ left[:-1]) / square if square > 0.0 else 0.0
    alike = min(max(alike, 0.0), LARGEST_CORRELATION)
    variance = square / (len(left) - len(free)) * (1.0 + alike) / (1.0 - alike)
    return Fit(
        bench=bench,
        free=free,
        covariance=variance * inverse,
        model_errors=MODEL_ERROR * math.sqrt(len(left)) * spread,
        correlation=inverse / np.outer(spread, spread),
        condition=float(singular[0] / singular[-1]),
        scatter=math.sqrt(square / len(left)),
    )
