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
from springcad.kinds.rotary_flexure.curvature_form import (
    DEGREE,
    CurvatureOptimum,
    curvature_knots,
)
from springcad.kinds.rotary_flexure.problem import FlexureProblem, bend_thickening

Floats = NDArray[np.float64]


def graded_towards_tip(start: float, pad_start: float, pad_length: float) -> list[float]:
    """Panel boundaries between ``start`` and the pad on which sqrt(1 - x/L) is smooth.

    The law ends at the contact point, one pad length beyond ``pad_start``; each panel is as long
    as its distance from there, so that polynomials follow the root to 1e-7.
    """
    edges, reach = [pad_start], pad_length
    while pad_start - 2.0 * reach + pad_length > start + 0.25 * reach and reach < pad_start:
        edges.append(pad_start - 2.0 * reach + pad_length)
        reach *= 2.0
    return [start, *sorted(edges)]


def straight_ribbon(flexure: FlexureProblem, thickness_factor: float) -> Ribbon:
    """A straight flexure with the law's half thickness times ``thickness_factor``."""
    pad = (
        flexure.span
        * (flexure.tip_half_thickness / (thickness_factor * flexure.root_half_thickness)) ** 2
    )
    edges = np.array([*graded_towards_tip(0.0, flexure.span - pad, pad), flexure.span])
    x = panel_grid(edges, ORDER).nodes
    taper = np.sqrt(1.0 - x / flexure.span)
    half = np.maximum(
        thickness_factor * flexure.root_half_thickness * taper, flexure.tip_half_thickness
    )
    return Ribbon(edges, np.zeros_like(x), half, 0.0)


def curvature_ribbon(flexure: FlexureProblem, optimum: CurvatureOptimum) -> Ribbon:
    """The flexure of an optimised curvature spline and its pad."""
    spline = BSpline(curvature_knots() * optimum.length, optimum.coefficients, DEGREE)
    knots = np.unique(curvature_knots()) * optimum.length
    tail = graded_towards_tip(0.0, optimum.length, flexure.pad_length)
    apart = [s for s in tail if np.min(np.abs(s - knots)) > 0.05 * knots[1]]
    edges = np.unique([*knots, *apart, optimum.length + flexure.pad_length])
    grid = panel_grid(edges, ORDER)
    curvature = np.where(grid.nodes < optimum.length, spline(grid.nodes), 0.0)
    angle = optimum.root_angle + grid.cumulative @ curvature
    x = grid.cumulative @ np.cos(angle)
    half = law_half_thickness(flexure, x, curvature)
    on_pad = grid.nodes > optimum.length
    return Ribbon(
        edges, curvature, np.where(on_pad, flexure.tip_half_thickness, half), optimum.root_angle
    )


def law_half_thickness(flexure: FlexureProblem, x: Floats, curvature: Floats) -> Floats:
    """Half thickness of the design law at ``x`` (004, Eq. 2), thickened in bends where asked."""
    taper = flexure.root_half_thickness * np.sqrt(np.maximum(1.0 - x / flexure.span, 0.0))
    if flexure.local_stress:
        taper = taper * bend_thickening(taper * curvature)[0]
    return np.asarray(np.maximum(taper, flexure.tip_half_thickness))
