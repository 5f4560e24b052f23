"""The centre line through control points: the form and the cost of paper 004, section III.

y(x) is a cubic spline with zero end slopes through m control points in order of x, with ordinates
that alternate in sign within [0, L/2]. It ends where the law reaches the tip's half thickness; from
there a straight pad runs on to the contact (a tip of no thickness has no pad: the paper's form).
The search minimises

    w1 sum(kappa^2) + w2 / d_min                                  (004, Eqs 15, 16)

with the required serpentine factor (Eq. 13) and mean(y) = 0 (Eq. 14), both as equations, and with
what the paper lacks: half thickness x curvature within the bend limit, since from 1 on the edge
folds over. The weights are not in the paper; see ``WEIGHTS``.

The problem is the paper's, its form is chosen for the search: spacings between the knots as a
softmax keep their order without constraints, d is a variable below the smallest gap of each zone,
the points move with the knots so that everything is smooth, and all gradients are exact. The
variables are (m logits of spacings, m ordinates, d). Inside this module lengths are in units of
the root half thickness.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.clamped_spline import (
    ClampedSpline,
    clamped_spline,
    knot_derivatives,
    piecewise_cubic,
)
from springcad.geometry.neighbours import zone_index
from springcad.kinds.rotary_flexure.problem import FlexureProblem, pad_energy
from springcad.kinds.rotary_flexure.zone_rows import bend_rows, gap_rows
from springcad.optimise import dual
from springcad.optimise.dual import Dual
from springcad.optimise.sqp import Evaluation

Floats = NDArray[np.float64]
Weighting = Literal["gap", "sharpness"]

WEIGHTS: dict[Weighting, tuple[float, float]] = {"gap": (0.05e-6, 1e-3), "sharpness": (1e-6, 1e-3)}
"""(w1, w2) in (m², m), dimensionless costs. The paper does not give them.

``gap``: 0.05 mm² and 1 mm, so that distance decides. ``sharpness``: 1 mm² and 1 mm; curvature is
then 71 to 81 % of the cost at the optima of the paper's S2, S3 and S4 with two control points.
"""
CURVATURE_POINTS = 100
"""Number of points, even in x, over which Eq. 15 sums."""
SMALLEST_SPACING = 0.04
"""Smallest distance between knots in x, as a share of L."""
POINTS = 320
"""Intervals of the grid, about; each spacing between knots gets the same even number. So many
because curvature peaks sharply where the slope is steep."""
GAP_STRIDE = 3
"""Every so many points of the grid, gaps are measured."""
ZONES = 10


@dataclass(frozen=True)
class _Line:
    """The spline at the grid (N,), with gradients; ``weights`` integrate over x.

    ``taper`` is the law's lambda0 = sqrt(1 - x/lever), ``factor`` the correction of it.
    """

    x: Dual
    y: Dual
    slope: Dual
    second: Dual
    taper: Dual
    factor: Floats
    weights: Dual

    @property
    def half_thickness(self) -> Dual:
        return self.taper * self.factor

    @property
    def stretch(self) -> Dual:
        """Arc length per x."""
        return dual.power(1.0 + self.slope * self.slope, 0.5)

    @property
    def share(self) -> Floats:
        """Arc length over that of the whole line."""
        steps = np.hypot(np.diff(self.x.value), np.diff(self.y.value))
        along = np.concatenate(([0.0], np.cumsum(steps)))
        return np.asarray(along / along[-1])


class ControlPointProblem:
    """The optimisation problem. Calling it gives objective, constraints and exact gradients.

    A correction of the law stays with the points of the grid at which it is ``near`` that shape.
    """

    def __init__(
        self,
        flexure: FlexureProblem,
        control_points: int = 2,
        weighting: Weighting = "gap",
        near: Floats | None = None,
        *,
        freeze: bool = False,
    ) -> None:
        self.nearest = near if freeze else None
        unit = flexure.root_half_thickness
        self.flexure = flexure
        self.m = control_points
        self.span = flexure.span / unit
        self.lever = flexure.lever / unit
        self.end = self.span - flexure.pad_length / unit
        self.end_taper = float(np.sqrt(1.0 - self.end / self.lever))
        self.pad_energy = pad_energy(flexure) / unit
        self.root_radius = flexure.root_radius / unit
        sharpness, nearness = WEIGHTS[weighting]
        self.sharpness = sharpness * CURVATURE_POINTS / unit**2 / self.span
        self.nearness = nearness / unit
        self.positions, self.quadrature = _grid(control_points)
        self.bend_zones = zone_index(len(self.positions), ZONES)
        self.gap_zones = zone_index(len(self.positions[::GAP_STRIDE]), ZONES)
        self.factor = np.ones(len(self.positions))
        self.allowance = np.zeros(ZONES)
        if near is not None:
            share = self.line(near).share
            self.factor = flexure.factor(share)
            zones = share[::GAP_STRIDE][self.gap_zones]
            self.allowance = flexure.allowance(zones.mean(axis=1)) / unit

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Lower and upper bounds of the variables: the first control point lies below the axis."""
        m = self.m
        lower, upper = np.full(2 * m + 1, -4.0), np.full(2 * m + 1, 4.0)
        signs = np.where(np.arange(m) % 2, 1.0, -1.0)
        lower[m:-1] = np.minimum(0.5 * self.span * signs, 0.0)
        upper[m:-1] = np.maximum(0.5 * self.span * signs, 0.0)
        lower[-1], upper[-1] = 0.01, self.root_radius
        return lower, upper

    def knots(self, variables: Floats) -> tuple[Dual, Dual]:
        """Abscissae and ordinates of the m control points."""
        m = self.m
        logits = dual.linear(np.eye(m + 1, m), variables, slice(0, m))
        logits = logits.through(np.exp(logits.value), np.exp(logits.value))
        share = logits * dual.power(logits.mapped(np.ones((1, m + 1))), -1.0)
        spacing = SMALLEST_SPACING + (1.0 - (m + 1) * SMALLEST_SPACING) * share
        x = self.end * spacing.mapped(np.tri(m, m + 1))
        return x, dual.linear(np.eye(m), variables, slice(m, 2 * m))

    def __call__(self, variables: Floats) -> Evaluation:
        """Values and gradients at ``variables`` (V,)."""
        line = self.line(variables)
        stretch = 1.0 + line.slope * line.slope
        curvature = line.second * dual.power(stretch, -1.5)
        gap = dual.variable(variables, -1)
        objective = self.sharpness * _total(line.weights * curvature * curvature)
        objective += self.nearness * dual.power(gap, -1.0)
        if self.nearest is not None:
            objective = dual.distance(variables, self.nearest, slice(0, -1))
        equalities = dual.stacked(
            [
                self.serpentine_factor(line) - self.flexure.serpentine_factor,
                _total(line.weights * line.y) * (1.0 / self.span),
            ]
        )
        x, y, half = (a[::GAP_STRIDE] for a in (line.x, line.y, line.half_thickness))
        gaps = gap_rows(x, y, half, self.root_radius, self.flexure.count, self.gap_zones)
        rows = [gaps - gap - self.allowance]
        if np.isfinite(self.flexure.bend_limit):
            bend = line.half_thickness * curvature
            rows.append(bend_rows(bend, self.flexure.bend_limit, self.bend_zones))
        inequalities = dual.stacked(rows)
        return Evaluation(
            float(objective.value[0]),
            objective.gradient[0],
            equalities.value,
            equalities.gradient,
            inequalities.value,
            inequalities.gradient,
        )

    def serpentine_factor(self, line: _Line) -> Dual:
        """Effective f_s: integral of lambda0^4/lambda^3 ds over 2/3 lever lambda_r."""
        stored = line.weights * line.taper * line.factor**-3.0
        return (_total(stored * line.stretch) + self.pad_energy) * (1.5 / self.lever)

    def line(self, variables: Floats) -> _Line:
        """The spline at the grid."""
        x_knots, y_knots = self.knots(variables)
        # Between knots the grid is even in the law, which falls from 1 to the tip's thickness.
        law_at_knots = dual.power(1.0 - x_knots * (1.0 / self.lever), 0.5)
        law, shares = (
            law_at_knots.mapped(matrix[:, 1:-1]) + (matrix[:, 0] + self.end_taper * matrix[:, -1])
            for matrix in (self.positions, self.quadrature)
        )
        x = self.lever * (1.0 - law * law)
        spline = spline_through(x_knots.value, y_knots.value, self.end)
        knots = np.vstack((x_knots.gradient, y_knots.gradient))
        along = spline(x.value)
        moved = piecewise_cubic(spline.x, knot_derivatives(spline), x.value)
        y, slope, second = (
            Dual(along[k], along[k + 1][:, None] * x.gradient + moved[k].T @ knots)
            for k in range(3)
        )
        return _Line(x, y, slope, second, law, self.factor, 2.0 * self.lever * (shares * law))


def spline_through(x: Floats, y: Floats, end: float) -> ClampedSpline:
    """The spline from (0, 0) through control points (m,) to (end, 0)."""
    return clamped_spline(np.concatenate(([0.0], x, [end])), np.pad(y, 1))


def _total(terms: Dual) -> Dual:
    """Sum over the grid, as a dual of length 1."""
    return terms.mapped(np.ones((1, terms.value.size)))


def _grid(m: int) -> tuple[Floats, Floats]:
    """Maps from the law at the knots (m + 2,) to the grid (N,): the law, and Simpson's weights.

    The weights are for an integral over the law, downwards.
    """
    intervals = 2 * max(2, round(POINTS / 2 / (m + 1)))
    simpson = np.ones(intervals + 1)
    simpson[1:-1:2], simpson[2:-1:2] = 4.0, 2.0
    simpson /= 3.0 * intervals
    tau = np.linspace(0.0, 1.0, intervals + 1)
    positions = np.zeros(((m + 1) * intervals + 1, m + 2))
    quadrature = np.zeros_like(positions)
    for i in range(m + 1):
        rows = slice(i * intervals, (i + 1) * intervals + 1)
        positions[rows, i], positions[rows, i + 1] = 1.0 - tau, tau
        quadrature[rows, i] += simpson
        quadrature[rows, i + 1] -= simpson
    # A knot between two intervals is the end of one and the start of the next.
    joints = intervals * np.arange(1, m + 1)
    positions[joints] = np.eye(m, m + 2, 1)
    return positions, quadrature
