"""The ribbon of one flexure: straight, from a curvature spline, or through control points.

Every flexure ends in a straight radial pad of the tip's thickness on which the cam runs, and a
round nose of the same half thickness about the contact point at the end of the pad.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline

from springcad.geometry.panels import panel_grid
from springcad.geometry.ribbon import ORDER, Ribbon
from springcad.kinds.rotary_flexure.curvature_form import CurvatureOptimum
from springcad.kinds.rotary_flexure.curvature_problem import DEGREE, curvature_knots
from springcad.kinds.rotary_flexure.problem import FlexureProblem, bend_thickening

Floats = NDArray[np.float64]


ROOT_PANELS = 4
"""Of a straight flexure's panels the first, half as long as the flexure, is split into so many:
a root that is thickened for its fillets' sake (``relief``) changes over a fifth of the length."""


def graded_towards_tip(pad_start: float, remaining: float) -> list[float]:
    """Panel boundaries from 0 to the pad between which sqrt(1 - x/lever) is smooth.

    The law ends at the contact point at full load, ``remaining`` beyond ``pad_start``; each panel
    is as long as its distance from there, so that polynomials follow the root to 1e-7.
    """
    edges, reach = [pad_start], remaining
    while pad_start - 2.0 * reach + remaining > 0.25 * reach and reach < pad_start:
        edges.append(pad_start - 2.0 * reach + remaining)
        reach *= 2.0
    return [0.0, *sorted(edges)]


def straight_ribbon(flexure: FlexureProblem) -> Ribbon:
    """A straight flexure."""
    start = flexure.span - flexure.pad_length
    graded = graded_towards_tip(start, flexure.lever - start)
    root = np.linspace(0.0, graded[1], ROOT_PANELS + 1)
    edges = np.array([*root, *graded[2:], flexure.span])
    x = panel_grid(edges, ORDER).nodes
    none = np.zeros_like(x)
    half = half_thickness(flexure, x, none, x / start)
    return Ribbon(edges, none, np.where(x > start, flexure.tip_half_thickness, half), 0.0)


def curvature_ribbon(flexure: FlexureProblem, optimum: CurvatureOptimum) -> Ribbon:
    """The flexure of an optimised curvature spline and its pad."""
    clamped = curvature_knots(len(optimum.coefficients) - 1) * optimum.length
    spline = BSpline(clamped, optimum.coefficients, DEGREE)
    knots = np.unique(clamped)
    if flexure.local_stress:  # What a bend is thickened by falls fast where it changes its side.
        knots = np.sort(np.append(knots, 0.5 * (knots[1:] + knots[:-1])))
    tail = graded_towards_tip(optimum.length, flexure.lever - flexure.span + flexure.pad_length)
    apart = [s for s in tail if np.min(np.abs(s - knots)) > 0.05 * knots[1]]
    edges = np.unique([*knots, *apart, optimum.length + flexure.pad_length])
    grid = panel_grid(edges, ORDER)
    curvature = np.where(grid.nodes < optimum.length, spline(grid.nodes), 0.0)
    angle = optimum.root_angle + grid.cumulative @ curvature
    x = grid.cumulative @ np.cos(angle)
    half = half_thickness(flexure, x, curvature, grid.nodes / optimum.length)
    on_pad = grid.nodes > optimum.length
    return Ribbon(
        edges, curvature, np.where(on_pad, flexure.tip_half_thickness, half), optimum.root_angle
    )


def law_half_thickness(flexure: FlexureProblem, x: Floats, curvature: Floats) -> Floats:
    """Half thickness of the design law at ``x`` (004, Eq. 2), thickened in bends where asked."""
    tapered = np.sqrt(np.maximum(1.0 - x / flexure.lever, 0.0))
    taper = np.asarray(flexure.root_half_thickness * tapered)
    return taper * bend_thickening(taper * curvature)[0] if flexure.local_stress else taper


def half_thickness(flexure: FlexureProblem, x: Floats, curvature: Floats, share: Floats) -> Floats:
    """The same, corrected, and nowhere below the tip's; ``share`` of the curved arc length."""
    corrected = flexure.factor(np.minimum(share, 1.0)) * law_half_thickness(flexure, x, curvature)
    return np.asarray(np.maximum(corrected, flexure.tip_half_thickness))
