"""The ribbon of a flexure whose centre line is a spline y(x) with a straight pad behind it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.clamped_spline import ClampedSpline
from springcad.geometry.panels import panel_grid
from springcad.geometry.ribbon import ORDER, Ribbon
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.kinds.rotary_flexure.shape import half_thickness

Floats = NDArray[np.float64]

PANELS_PER_SPACING = 8
"""Panels between two knots: the end of the ribbon then lies within 1e-8 m of the contact point."""


def spline_ribbon(flexure: FlexureProblem, spline: ClampedSpline) -> Ribbon:
    """From y(x), m, on [0, L - pad length] to curvature and half thickness over the arc length."""
    taper = np.sqrt(1.0 - spline.x / flexure.lever)
    share = np.linspace(0.0, 1.0, PANELS_PER_SPACING, endpoint=False)
    # Even in sqrt(1 - x/lever), so that the law is smooth on each panel.
    tapers = (taper[:-1, None] + np.diff(taper)[:, None] * share).ravel()
    along = panel_grid(flexure.lever * (1.0 - np.append(tapers, taper[-1]) ** 2), ORDER)
    stretch = np.sqrt(1.0 + spline(along.nodes)[1] ** 2)
    arc_at_nodes = along.cumulative @ stretch
    arc_at_edges = along.interpolation(along.edges) @ arc_at_nodes
    arc_at_edges[0] = 0.0

    pad = [arc_at_edges[-1] + flexure.pad_length] if flexure.pad_length > 0.0 else []
    edges = np.append(arc_at_edges, pad)
    stations = panel_grid(edges, ORDER).nodes
    curved = stations < arc_at_edges[-1]
    x = np.interp(stations, arc_at_edges, along.edges)
    for _ in range(5):  # Newton for s(x) = s; a panel is short, so the chord is a good start.
        excess = along.interpolation(x) @ arc_at_nodes - stations
        x = np.where(curved, x - excess / np.sqrt(1.0 + spline(x)[1] ** 2), along.edges[-1])
    _, slope, second, _ = spline(x)
    curvature = np.where(curved, second / (1.0 + slope**2) ** 1.5, 0.0)
    half = half_thickness(flexure, x, curvature, stations / arc_at_edges[-1])
    return Ribbon(
        edges=edges,
        curvature=curvature,
        half_thickness=np.where(curved, half, flexure.tip_half_thickness),
        root_angle=0.0,
    )
