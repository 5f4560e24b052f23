"""The omega leaf's half as splines, with gradients: centre line and thickness.

The tangent angle theta is a clamped uniform cubic B-spline over the half's length and the
thickness h a quadratic one with the same spans. Unlike control points of the centre line, which
let a search hide cusps between them, every such line is smooth. Variables of a search are

    (theta coefficients, h coefficients / h_ref, L / R_c, y_A / R_c),

with h_ref = sigma R_c^2 / (E s) of a straight leaf (paper 000, Eq. 17). Inside the searching
modules lengths are in units of R_c and forces per width in units of E R_c.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from springcad.geometry.panels import PanelGrid, panel_grid
from springcad.geometry.ribbon import ORDER, Ribbon
from springcad.kinds.lever_arm.omega import OmegaCase, OmegaLeaf
from springcad.optimise import dual
from springcad.optimise.dual import Dual

Floats = NDArray[np.float64]

SPANS = 8
ANGLES = SPANS + 3
THICKNESSES = SPANS + 2
ANGLE_RANGE = slice(0, ANGLES)
THICKNESS_RANGE = slice(ANGLES, ANGLES + THICKNESSES)
LENGTH, MIDDLE = ANGLES + THICKNESSES, ANGLES + THICKNESSES + 1
VARIABLES = MIDDLE + 1
NODES_PER_SPAN = 9
POINTS = 121
"""Points along the half, both ends included, at which gaps and bends are held to their limits."""
STRESS_POINTS = 721
"""Points at which the stress is."""


def knots(degree: int) -> Floats:
    """Clamped uniform knots on [0, 1]."""
    inner = np.linspace(0.0, 1.0, SPANS + 1)
    return np.concatenate([np.zeros(degree), inner, np.ones(degree)])


def angle_spline(coefficients: Floats) -> BSpline:
    """theta over the share of the length."""
    return BSpline(knots(3), coefficients, 3)


def thickness_spline(coefficients: Floats) -> BSpline:
    """h over the share of the length."""
    return BSpline(knots(2), coefficients, 2)


@dataclass(frozen=True)
class Basis:
    """Linear maps from coefficients to values; ``grid`` covers the share of the length [0, 1].

    ``to_end`` integrates from each node to the clamp.
    """

    grid: PanelGrid
    to_end: Floats
    angle: Floats
    thickness: Floats
    points: Floats
    at_points: Floats
    bend_at_points: Floats
    bend_at_nodes: Floats
    at_stress_points: Floats
    bend_at_stress_points: Floats
    taper: Floats
    taper_at_stress_points: Floats


@cache
def basis() -> Basis:
    """The maps for the search's grid."""
    grid = panel_grid(np.linspace(0.0, 1.0, SPANS + 1), NODES_PER_SPAN)
    points, stressed = np.linspace(0.0, 1.0, POINTS), np.linspace(0.0, 1.0, STRESS_POINTS)
    angle, thickness = angle_spline(np.eye(ANGLES)), thickness_spline(np.eye(THICKNESSES))
    return Basis(
        grid=grid,
        to_end=grid.weights - grid.cumulative,
        angle=angle(grid.nodes),
        thickness=thickness(grid.nodes),
        points=points,
        at_points=grid.interpolation(points),
        bend_at_points=angle.derivative()(points),
        bend_at_nodes=angle.derivative()(grid.nodes),
        at_stress_points=grid.interpolation(stressed),
        bend_at_stress_points=angle.derivative()(stressed),
        taper=thickness.derivative()(np.linspace(0.0, 1.0, SPANS + 1)),
        taper_at_stress_points=thickness.derivative()(stressed),
    )


@dataclass(frozen=True)
class Half:
    """The half at the nodes, with gradients, in units of R_c.

    Attributes:
        start_angle, end_angle: theta(0) and theta(L).
        x, y: in the enclosure's frame.
        end_x, end_y: of the clamp.
        node_bend, bend, stress_bend: curvature at the nodes, the points and the stress points.
        taper, stress_taper: dh/ds at the knots, where it is largest, and at the stress points.
        turns: differences of the angle's coefficients.
    """

    length: Dual
    middle: Dual
    angle: Dual
    start_angle: Dual
    end_angle: Dual
    thickness: Dual
    x: Dual
    y: Dual
    end_x: Dual
    end_y: Dual
    node_bend: Dual
    bend: Dual
    stress_bend: Dual
    taper: Dual
    stress_taper: Dual
    turns: Dual

    @property
    def bare(self) -> Half:
        """The values alone."""
        return Half(**{name: part.bare for name, part in vars(self).items()})


def reference_thickness(case: OmegaCase) -> float:
    """h_ref, m."""
    strain = case.allowable_stress / case.elastic_modulus
    return strain * case.enclosure_radius**2 / case.stroke


def half_of(case: OmegaCase, variables: Floats, *, slopes: bool = True) -> Half:
    """The half that the variables describe; without ``slopes`` its values alone."""
    maps, design = basis(), dual.variables(variables)
    design = design if slopes else design.bare
    ratio = reference_thickness(case) / case.enclosure_radius
    length, middle = design[[LENGTH]], design[[MIDDLE]]
    coefficients = design[ANGLE_RANGE]
    angle, start = coefficients.mapped(maps.angle), coefficients[[0]]
    hub = case.hub_radius / case.enclosure_radius
    start_x, start_y = hub * dual.cos(start), middle + hub * dual.sin(start)
    along_x, along_y = length * dual.cos(angle), length * dual.sin(angle)
    weights = maps.grid.weights[None, :]
    thickness = ratio * design[THICKNESS_RANGE]
    per_length = dual.power(length, -1.0)
    return Half(
        length=length,
        middle=middle,
        angle=angle,
        start_angle=start,
        end_angle=coefficients[[ANGLES - 1]],
        thickness=thickness.mapped(maps.thickness),
        x=start_x + along_x.mapped(maps.grid.cumulative),
        y=start_y + along_y.mapped(maps.grid.cumulative),
        end_x=start_x + along_x.mapped(weights),
        end_y=start_y + along_y.mapped(weights),
        node_bend=coefficients.mapped(maps.bend_at_nodes) * per_length,
        bend=coefficients.mapped(maps.bend_at_points) * per_length,
        stress_bend=coefficients.mapped(maps.bend_at_stress_points) * per_length,
        taper=thickness.mapped(maps.taper) * per_length,
        stress_taper=thickness.mapped(maps.taper_at_stress_points) * per_length,
        turns=coefficients.mapped(np.diff(np.eye(ANGLES), axis=0)),
    )


def leaf_of(case: OmegaCase, variables: Floats) -> OmegaLeaf:
    """The leaf, snapped to grids far below any tolerance (1e-9 rad, 1e-12 m).

    The last digits of another machine's linear algebra then do not show.
    """
    return OmegaLeaf(
        angle_coefficients=np.round(variables[ANGLE_RANGE], 9),
        thickness_coefficients=np.round(variables[THICKNESS_RANGE] * reference_thickness(case), 12),
        length=round(float(variables[LENGTH]) * case.enclosure_radius, 12),
        middle=round(float(variables[MIDDLE]) * case.enclosure_radius, 12),
        hub_radius=case.hub_radius,
    )


def variables_of(case: OmegaCase, leaf: OmegaLeaf) -> Floats:
    """The variables that describe a leaf."""
    scaled = np.array([leaf.length, leaf.middle]) / case.enclosure_radius
    thickness = leaf.thickness_coefficients / reference_thickness(case)
    return np.concatenate([leaf.angle_coefficients, thickness, scaled])


def ribbon(leaf: OmegaLeaf) -> Ribbon:
    """The half as a ribbon from the hub's edge; see ``omega.half_ribbon``."""
    angle, thickness = (
        angle_spline(leaf.angle_coefficients),
        thickness_spline(leaf.thickness_coefficients),
    )
    # Two panels a span: a span may turn by more than a right angle, and its ends are extrapolated.
    edges = np.linspace(0.0, leaf.length, 2 * SPANS + 1)
    share = panel_grid(edges, ORDER).nodes / leaf.length
    return Ribbon(
        edges=edges,
        curvature=np.asarray(angle.derivative()(share)) / leaf.length,
        half_thickness=0.5 * np.asarray(thickness(share)),
        root_angle=float(leaf.angle_coefficients[0]),
    )
