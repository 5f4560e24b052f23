"""The optimiser of paper 004, section III, as the paper describes it; the benchmark's reference.

Unknown are the control points (x_i, y_i). Costs and constraints are Eqs 12 to 16 and nothing else:
edges of the neighbours compared point by point over all pairs, one min() over them, curvature
summed over 100 points, ordering of x as linear constraints, gradients by finite differences, local
searches from random points until the time is up, the lowest cost wins.

Choices where the paper is silent or its tools are not at hand, all in its favour or neutral:
SLSQP (scipy) stands in for MATLAB's fmincon; the comparison of all pairs is vectorised; the random
ordinates lie within 0.2 L (within L/2 fewer searches succeed); knots keep 0.02 L apart; the
minimum tip thickness and the effective area are those of springcad, so that both solve for the same
spring. Eq. 14 is read in millimetres.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize

from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.optimise.random import uniform

Floats = NDArray[np.float64]

POINTS = 100
TOLERANCE = 1e-3
"""Of Eqs 13 and 14."""
CONTROL_POINTS = 2


@dataclass(frozen=True)
class Trial:
    """One local search: where it ended, and after how much time since the first one began (s)."""

    knots: Floats
    cost: float
    feasible: bool
    finished: float


@dataclass(frozen=True)
class PaperMethod:
    """Costs and constraints for the variables (x_1 .. x_m, y_1 .. y_m) in millimetres."""

    flexure: FlexureProblem
    sharpness_weight: float
    nearness_weight: float

    @property
    def span(self) -> float:
        return 1e3 * self.flexure.span

    def knots(self, variables: Floats) -> Floats:
        m = len(variables) // 2
        x = np.concatenate(([0.0], variables[:m], [self.span]))
        return np.column_stack((x, np.pad(variables[m:], 1)))

    def drawn_knots(self, variables: Floats) -> Floats:
        """The knots, pushed apart where SLSQP leaves their order between two iterations."""
        knots, apart = self.knots(variables), 0.01 * self.span
        for i in range(1, len(knots) - 1):
            room = self.span - apart * (len(knots) - 1 - i)
            knots[i, 0] = min(max(knots[i, 0], knots[i - 1, 0] + apart), room)
        return knots

    def curve(self, variables: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """x, y, slope and second derivative at the points."""
        knots = self.drawn_knots(variables)
        spline = CubicSpline(knots[:, 0], knots[:, 1], bc_type="clamped")
        x = np.linspace(0.0, self.span, POINTS)
        return x, spline(x), spline(x, 1), spline(x, 2)

    def half_thickness(self, x: Floats) -> tuple[Floats, Floats]:
        """The law of Eq. 2, and the law held above the tip's half thickness."""
        drawn = 1e3 * self.flexure.root_half_thickness * np.sqrt(np.maximum(1 - x / self.span, 0))
        return drawn, np.maximum(drawn, 1e3 * self.flexure.tip_half_thickness)

    def cost(self, variables: Floats) -> float:
        x, y, slope, second = self.curve(variables)
        curvature = second / (1.0 + slope**2) ** 1.5
        sharpness = float(np.sum(curvature**2))
        return self.sharpness_weight * sharpness + self.nearness_weight / max(
            self.nearest(x, y, slope), 1e-6
        )

    def nearest(self, x: Floats, y: Floats, slope: Floats) -> float:
        """d_min: smallest distance between the edge points of neighbours (Eq. 12)."""
        _, half = self.half_thickness(x)
        offset = np.column_stack((-slope, np.ones_like(x))) * (half / np.hypot(1.0, slope))[:, None]
        centre = np.column_stack((x, y))
        pitch, hub = self.flexure.pitch, np.array([1e3 * self.flexure.root_radius, 0.0])
        turn = np.array([[np.cos(pitch), np.sin(pitch)], [-np.sin(pitch), np.cos(pitch)]])
        neighbour = (centre + offset - hub) @ turn + hub
        pairs = (centre - offset)[:, None, :] - neighbour
        return float(np.sqrt(np.min(np.sum(pairs**2, axis=-1))))

    def serpentine_factor(self, variables: Floats) -> float:
        x, _, slope, _ = self.curve(variables)
        drawn, half = self.half_thickness(x)
        area = np.trapezoid(drawn**4 / half**3 * np.hypot(1.0, slope), x)
        straight = np.trapezoid(drawn, x)
        return float(area / straight)

    def tolerances(self, variables: Floats) -> Floats:
        """Eqs 13 and 14 as inequalities, positive where they hold."""
        factor = self.serpentine_factor(variables) - self.flexure.serpentine_factor
        balance = float(np.sum(self.curve(variables)[1]))
        return TOLERANCE - np.array([factor, -factor, balance, -balance])

    def order(self, variables: Floats) -> Floats:
        """Distances between knots beyond 0.02 L, positive where the order of x holds."""
        return np.diff(self.knots(variables)[:, 0]) - 0.02 * self.span

    def start(self, draw: Floats) -> Floats:
        m = len(draw) // 2
        x = self.span * (0.05 + 0.9 * np.sort(draw[:m]))
        signs = np.where(np.arange(m) % 2, 1.0, -1.0)
        return np.concatenate((x, 0.2 * self.span * signs * draw[m:]))


def search(method: PaperMethod, seconds: float, seed: int = 0) -> list[Trial]:
    """Local searches from random control points until ``seconds`` have passed."""
    m, half_span = CONTROL_POINTS, 0.5 * method.span
    ordinates = [(0.0, half_span) if i % 2 else (-half_span, 0.0) for i in range(m)]
    trials: list[Trial] = []
    began = time.perf_counter()
    while time.perf_counter() - began < seconds:
        found = minimize(
            method.cost,
            method.start(uniform(seed, len(trials), 2 * m)),
            method="SLSQP",
            bounds=[(0.0, method.span)] * m + ordinates,
            constraints=[
                {"type": "ineq", "fun": method.tolerances},
                {"type": "ineq", "fun": method.order},
            ],
        )
        trials.append(_trial(method, found.x, time.perf_counter() - began))
    return trials


def _trial(method: PaperMethod, variables: Floats, finished: float) -> Trial:
    holds = np.concatenate((method.order(variables), method.tolerances(variables))) >= -1e-6
    knots = 1e-3 * method.drawn_knots(variables)
    return Trial(knots, method.cost(variables), bool(np.all(holds)), finished)


def winner(trials: list[Trial]) -> Trial | None:
    """The feasible trial with the lowest cost."""
    return min((t for t in trials if t.feasible), key=lambda t: t.cost, default=None)
