"""The centre line as a curvature spline: the problem of its shape.

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

from dataclasses import dataclass
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
from springcad.optimise.sqp import Evaluation

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

    Calling it gives objective, constraints and exact gradients. With ``nearest`` the objective is
    not the gap but the distance from there; ``weight`` is that of the gap.
    """

    def __init__(
        self,
        flexure: FlexureProblem,
        nearest: Floats | None = None,
        coefficients: int = COEFFICIENTS,
        weight: float = 1.0,
    ) -> None:
        self.nearest = nearest
        self.weight = weight
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

    def __call__(self, variables: Floats, *, slopes: bool = True) -> Evaluation:
        """Values at ``variables`` (V,), with gradients or, in two thirds of the time, without."""
        at = dual.variables(variables) if slopes else dual.variables(variables).bare
        line = self._line(at)
        basis, gap = self.basis, at[-1:]
        section = self._section(line.x, line.bend, self.factor)
        z = section.half_thickness * line.bend
        smooth = line.length * (z * z).mapped(basis.grid.weights[None, :])
        objective = self.weight * (SMOOTHNESS * smooth - gap)
        if self.nearest is not None:
            objective = dual.distance(variables, self.nearest, slice(0, -1))
        equalities = self._equalities(line, section)

        x, y = line.x.mapped(basis.at_points), line.y.mapped(basis.at_points)
        bend = at[self.coefficients].mapped(basis.curvature_at_points)
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

    def _line(self, variables: Dual) -> _Line:
        basis, coefficients = self.basis, variables[self.coefficients]
        length, root_angle = self.span * variables[-3:-2], variables[-2:-1]
        angle = root_angle + length * coefficients.mapped(basis.angle)
        return _Line(
            length=length,
            bend=coefficients.mapped(basis.curvature),
            angle=angle,
            end_angle=root_angle + length * coefficients.mapped(basis.end_angle),
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
