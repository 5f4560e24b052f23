"""The centre line as a curvature spline: the default form of the shape optimisation.

kappa(s) is a clamped cubic B-spline over the curved part of the flexure, followed by a straight
radial pad of the tip's thickness. The tangent angle is then linear in the coefficients, long even
bends are cheap to describe, and nothing needs ordering. Unknown are the coefficients, the length S
of the curved part, the root angle and the smallest gap d; the search maximises d under

* effective serpentine factor (energy stored at the design stress; 004, Eqs 9, 10),
* cross compliance integral y M/(E I) ds = 0, so that both directions are equally stiff (the exact
  form of the lateral balance 004, Eq. 14),
* the curved part ends on the axis, at the pad, along the radius,
* in every zone: gap to the neighbour >= d, half thickness x curvature <= the bend limit.

The smallest gap of each zone is a row of its own, so the search never meets the kink of a global
minimum. Inside this module lengths are in units of the root half thickness.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from springcad.geometry.neighbours import zone_index
from springcad.geometry.panels import PanelGrid, panel_grid
from springcad.kinds.rotary_flexure.problem import FlexureProblem, bend_thickening, pad_energy
from springcad.kinds.rotary_flexure.zone_rows import bend_rows, gap_rows
from springcad.optimise import dual
from springcad.optimise.dual import Dual
from springcad.optimise.random import uniform
from springcad.optimise.sqp import Evaluation, Solution, best, solve_from_many

Floats = NDArray[np.float64]

COEFFICIENTS = 13
"""Free coefficients of the curvature spline where the caller wants no other number."""
DEGREE = 3
NODES_PER_PANEL = 6
POINTS = 121
"""Points along the curved part at which gap and bend are held to their limits."""
BEND_MARGIN = 0.99
"""The bend is held this far within its limit, for what lies between the points."""
ZONES = 10
SMOOTHNESS = 0.02
"""Weight of integral (lambda kappa)^2 ds against the smallest gap."""
SMALLEST_TAPER = 1e-3
"""The law's sqrt(1 - x/L) is held above this while a search strays beyond the tip."""


def curvature_knots(coefficients: int) -> Floats:
    """Clamped uniform knots on [0, 1] of a curvature spline with so many free coefficients.

    A last coefficient is zero, where the straight pad begins.
    """
    inner = np.linspace(0.0, 1.0, coefficients + 2 - DEGREE)
    return np.concatenate([np.zeros(DEGREE), inner, np.ones(DEGREE)])


@dataclass(frozen=True)
class _Basis:
    """Everything that depends on the parametrisation alone; see ``PanelGrid``."""

    grid: PanelGrid
    curvature: Floats
    angle: Floats
    end_angle: Floats
    at_points: Floats
    curvature_at_points: Floats


@cache
def _basis(coefficients: int) -> _Basis:
    spline = BSpline(curvature_knots(coefficients), np.eye(coefficients + 1), DEGREE)
    grid = panel_grid(np.linspace(0.0, 1.0, coefficients + 2 - DEGREE), NODES_PER_PANEL)
    angle = spline.antiderivative()
    points = np.linspace(0.0, 1.0, POINTS)
    return _Basis(
        grid=grid,
        curvature=spline(grid.nodes)[:, :-1],
        angle=angle(grid.nodes)[:, :-1],
        end_angle=angle(np.array([1.0]))[:, :-1],
        at_points=grid.interpolation(points),
        curvature_at_points=spline(points)[:, :-1],
    )


@dataclass(frozen=True)
class _Line:
    """The centre line at the nodes, with gradients; ``bend`` is its curvature."""

    length: Dual
    bend: Dual
    angle: Dual
    end_angle: Dual
    x: Dual
    y: Dual


@dataclass(frozen=True)
class _Section:
    """Half thickness lambda along the centre line, with gradients.

    ``taper`` is the law's lambda0 = sqrt(1 - x/lever); the factors on it are ``factor``, that of
    the correction (N,), and ``thickening``, that of the bends.
    """

    taper: Dual
    factor: Floats
    thickening: Dual | None

    @property
    def half_thickness(self) -> Dual:
        corrected = self.taper * self.factor
        return corrected if self.thickening is None else corrected * self.thickening

    @property
    def energy(self) -> Dual:
        """Energy per length, as lambda0^4 / lambda^3."""
        return self._relieved(self.taper)

    @property
    def cross_compliance(self) -> Dual:
        """Cross compliance per length and y, as lambda0^2 / lambda^3."""
        return self._relieved(dual.power(self.taper, -1.0))

    def _relieved(self, lawful: Dual) -> Dual:
        corrected = lawful * self.factor**-3.0
        if self.thickening is None:
            return corrected
        return corrected * dual.power(self.thickening, -3.0)


class CurvatureProblem:
    """The optimisation problem; variables are (coefficients x lambda_r, S / L, root angle, d).

    Calling it gives objective, constraints and exact gradients.
    """

    def __init__(
        self,
        flexure: FlexureProblem,
        nearest: Floats | None = None,
        coefficients: int = COEFFICIENTS,
    ) -> None:
        self.nearest = nearest
        self.basis = _basis(coefficients)
        self.coefficients = slice(0, coefficients)
        unit = flexure.root_half_thickness
        self.flexure = flexure
        self.span = flexure.span / unit
        self.lever = flexure.lever / unit
        self.pad = flexure.pad_length / unit
        self.root_radius = flexure.root_radius / unit
        self.pad_energy = pad_energy(flexure) / unit
        self.energy = flexure.serpentine_factor * 2.0 / 3.0 * self.lever
        self.zones = zone_index(POINTS, ZONES)
        self.factor = flexure.factor(self.basis.grid.nodes)
        self.factor_at_points = flexure.factor(np.linspace(0.0, 1.0, POINTS))
        self.allowance = flexure.allowance((np.arange(ZONES) + 0.5) / ZONES) / unit

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Lower and upper bounds of the variables."""
        upper = np.full(self.coefficients.stop + 3, 8.0 * self.flexure.bend_limit)
        lower = -upper
        lower[-3:] = 0.9, -self.flexure.max_root_angle, -2.0
        upper[-3:] = 4.0, self.flexure.max_root_angle, self.root_radius
        return lower, upper

    def __call__(self, variables: Floats) -> Evaluation:
        """Values and gradients at ``variables`` (V,)."""
        line = self._line(variables)
        basis, gap = self.basis, dual.variable(variables, -1)
        section = self._section(line.x, line.bend, self.factor)
        z = section.half_thickness * line.bend
        smooth = line.length * (z * z).mapped(basis.grid.weights[None, :])
        objective = SMOOTHNESS * smooth - gap
        if self.nearest is not None:
            objective = dual.distance(variables, self.nearest, slice(0, -1))
        equalities = self._equalities(line, section)

        x, y = line.x.mapped(basis.at_points), line.y.mapped(basis.at_points)
        bend = dual.linear(basis.curvature_at_points, variables, self.coefficients)
        half = self._section(x, bend, self.factor_at_points).half_thickness
        gaps = gap_rows(x, y, half, self.root_radius, self.flexure.count, self.zones)
        bends = bend_rows(half * bend, BEND_MARGIN * self.flexure.bend_limit, self.zones)
        inequalities = dual.stacked([gaps - gap - self.allowance, bends])
        return Evaluation(
            float(objective.value[0]),
            objective.gradient[0],
            equalities.value,
            equalities.gradient,
            inequalities.value,
            inequalities.gradient,
        )

    def _line(self, variables: Floats) -> _Line:
        basis, coefficients = self.basis, self.coefficients
        length = self.span * dual.variable(variables, -3)
        root_angle = dual.variable(variables, -2)
        angle = root_angle + length * dual.linear(basis.angle, variables, coefficients)
        return _Line(
            length=length,
            bend=dual.linear(basis.curvature, variables, coefficients),
            angle=angle,
            end_angle=root_angle + length * dual.linear(basis.end_angle, variables, coefficients),
            x=length * dual.cos(angle).mapped(basis.grid.cumulative),
            y=length * dual.sin(angle).mapped(basis.grid.cumulative),
        )

    def _section(self, x: Dual, bend: Dual, factor: Floats) -> _Section:
        tapered = 1.0 - x * (1.0 / self.lever)
        inside = tapered.value > SMALLEST_TAPER**2
        root = np.where(inside, np.sqrt(np.abs(tapered.value)), SMALLEST_TAPER)
        taper = tapered.through(root, np.where(inside, 0.5 / root, 0.0))
        if not self.flexure.local_stress:
            return _Section(taper, factor, None)
        law_bend = taper * bend
        return _Section(taper, factor, law_bend.through(*bend_thickening(law_bend.value)))

    def _equalities(self, line: _Line, section: _Section) -> Dual:
        """Stored energy, cross compliance and closure onto the pad, each of order one."""
        weights = self.basis.grid.weights[None, :]
        energy = line.length * section.energy.mapped(weights) + (self.pad_energy - self.energy)
        balance = line.length * (line.y * section.cross_compliance).mapped(weights)
        end_x = line.length * dual.cos(line.angle).mapped(weights) - (self.span - self.pad)
        end_y = line.length * dual.sin(line.angle).mapped(weights)
        scale = 1.0 / self.span
        return dual.stacked([energy * scale, balance * scale, end_x * scale, end_y, line.end_angle])


def start_point(problem: CurvatureProblem, seed: int, index: int) -> Floats:
    """A random wave that already has the wanted serpentine factor.

    The tangent angle is a sine of two to four half waves, a weaker one of one half wave more and a
    slope at the root, all with random strength; bisection on the amplitude puts the search on the
    energy constraint from the beginning.
    """
    basis, draw = problem.basis, uniform(seed, index, 4)
    sigma, weights = basis.grid.nodes, basis.grid.weights
    half_waves = 2.0 + np.floor(3.0 * draw[0])
    shape = np.sin(np.pi * half_waves * sigma) * (1.0 if draw[1] < 0.5 else -1.0)
    shape += (draw[2] - 0.5) * np.sin(np.pi * (half_waves + 1.0) * sigma)
    shape += (draw[3] - 0.5) * np.cos(0.5 * np.pi * sigma)
    shape /= np.max(np.abs(shape))

    def at_amplitude(amplitude: float) -> tuple[float, float]:
        """Length of the curved part and energy, both as in the constraints."""
        along = np.cos(amplitude * shape)
        length = (problem.span - problem.pad) / float(weights @ along)
        taper = np.sqrt(
            np.maximum(1.0 - length * (basis.grid.cumulative @ along) / problem.lever, 0)
        )
        stored = float(weights @ (taper * problem.factor**-3.0))
        return length, length * stored + problem.pad_energy

    low, high = 0.0, 1.4
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if at_amplitude(middle)[1] < problem.energy else (low, middle)
    length, _ = at_amplitude(low)
    # Least squares for coefficients and root angle: angle = psi0 + S * (angle basis) c.
    columns = np.column_stack([length * basis.angle, np.ones(len(shape))])
    fitted = np.linalg.lstsq(columns, low * shape, rcond=None)[0]
    return np.concatenate([fitted[:-1], [length / problem.span, fitted[-1], 0.0]])


FEASIBLE = 1e-6
"""Constraints are of order one; a search that ends within this of them has met them."""


@dataclass(frozen=True)
class CurvatureOptimum:
    """The best centre line found, SI, and how the search went.

    Attributes:
        coefficients: of kappa(s), 1/m, the last one zero (see ``curvature_knots``).
        length: of the curved part, m.
        root_angle: rad.
        gap: smallest clearance to the neighbour along the curved part, m.
        starts, feasible: how many searches were made, and how many of them met every constraint
            and left a gap.
        spread: gap of every feasible search, m, best first.
    """

    coefficients: Floats
    length: float
    root_angle: float
    gap: float
    starts: int
    feasible: int
    spread: Floats


def optimise(
    flexure: FlexureProblem,
    *,
    starts: int,
    seed: int,
    coefficients: int = COEFFICIENTS,
    progress: Callable[[str], None] = lambda _: None,
) -> CurvatureOptimum | None:
    """Search from ``starts`` random waves; None when no search met the constraints.

    Variables are snapped to a grid far below any tolerance, so that the last digits of the linear
    algebra of another machine do not show.
    """
    problem = CurvatureProblem(flexure, coefficients=coefficients)
    solutions = solve_from_many(
        problem,
        [start_point(problem, seed, index) for index in range(starts)],
        problem.bounds,
        progress=progress,
    )
    # A search may end with neighbours that overlap: all rows hold, with a negative gap.
    sound = [s for s in solutions if s.violation <= FEASIBLE and s.variables[-1] > 0.0]
    winner = best(sound, feasible_below=FEASIBLE)
    if winner is None:
        return None
    spread = np.sort([s.variables[-1] * flexure.root_half_thickness for s in sound])[::-1]
    return replace(_optimum(flexure, winner), starts=starts, feasible=len(sound), spread=spread)


def reoptimise(
    flexure: FlexureProblem, earlier: CurvatureOptimum, *, freeze: bool
) -> CurvatureOptimum | None:
    """The optimum near that of a problem not much different; None where none is found.

    With ``freeze`` it is the nearest shape that meets the constraints, whatever its gap. A search
    that stops before it meets them goes on once from there: its estimate of the curvature of the
    objective may be what stopped it.
    """
    unit = flexure.root_half_thickness
    start = np.concatenate(
        [
            earlier.coefficients[:-1] * unit,
            [earlier.length / flexure.span, earlier.root_angle, earlier.gap / unit],
        ]
    )
    problem = CurvatureProblem(flexure, start if freeze else None, len(start) - 3)
    (solution,) = solve_from_many(problem, [start], problem.bounds)
    if solution.violation > FEASIBLE:
        (solution,) = solve_from_many(problem, [solution.variables], problem.bounds)
    if solution.violation > FEASIBLE or solution.variables[-1] <= 0.0:
        return None
    near = _optimum(flexure, solution)
    return replace(near, starts=earlier.starts, feasible=earlier.feasible, spread=earlier.spread)


def _optimum(flexure: FlexureProblem, solution: Solution) -> CurvatureOptimum:
    unit, variables = flexure.root_half_thickness, solution.variables
    # A shape and its mirror image are equally good; rounding must not choose between them.
    mirror = 1.0 if variables[0] >= 0.0 else -1.0
    free = np.round(mirror * variables[:-3] / unit, 6)
    return CurvatureOptimum(
        coefficients=np.append(free, 0.0),
        length=round(float(variables[-3]) * flexure.span, 9),
        root_angle=round(mirror * float(variables[-2]), 9),
        gap=float(variables[-1]) * unit,
        starts=1,
        feasible=1,
        spread=variables[-1:] * unit,
    )
