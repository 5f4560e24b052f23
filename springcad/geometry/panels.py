"""Integration and interpolation along a curve, panel by panel, to spectral accuracy.

An interval is cut into panels where the integrand may have kinks (spline knots, the end of a
taper); inside each panel functions are represented by their values at Gauss-Legendre nodes.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PanelGrid:
    """Nodes of all panels and the linear maps on values given there.

    Attributes:
        edges: panel boundaries (P+1,), increasing.
        nodes: all nodes (N,), increasing.
        weights: quadrature over the whole interval (N,).
        cumulative: row i integrates from ``edges[0]`` to ``nodes[i]`` (N, N).
        derivative: row i differentiates at ``nodes[i]`` (N, N).
        order: nodes per panel; exact for polynomials of degree 2*order - 1 in the quadrature.
    """

    edges: Floats
    nodes: Floats
    weights: Floats
    cumulative: Floats
    derivative: Floats
    order: int

    def interpolation(self, points: Floats) -> Floats:
        """Matrix (M, N) that takes values at the nodes to values at ``points`` (M,).

        Points outside the interval are extrapolated by the first or last panel's polynomial.
        """
        last = len(self.edges) - 2
        panel = np.searchsorted(self.edges, points, side="right") - 1
        panel = np.minimum(np.maximum(panel, 0), last)
        left, right = self.edges[panel], self.edges[panel + 1]
        local = (2.0 * points - left - right) / (right - left)
        legendre = np.polynomial.legendre.legvander(local, self.order - 1) @ _to_legendre(
            self.order
        )
        matrix = np.zeros((len(points), len(self.nodes)))
        columns = panel[:, None] * self.order + np.arange(self.order)
        matrix[np.arange(len(points))[:, None], columns] = legendre
        return matrix


@cache
def _to_legendre(order: int) -> Floats:
    """Matrix from values at the Gauss nodes to Legendre coefficients."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    degree = np.arange(order)
    vander = np.polynomial.legendre.legvander(nodes, order - 1)
    return np.asarray((vander * weights[:, None]).T * (degree[:, None] + 0.5))


def panel_grid(edges: Floats, order: int) -> PanelGrid:
    """Gauss-Legendre nodes, weights and the cumulative integral on panels between ``edges``.

    The running integral inside a panel integrates the interpolating polynomial exactly.
    """
    local, local_weights = np.polynomial.legendre.leggauss(order)
    half = 0.5 * np.diff(edges)
    middle = 0.5 * (edges[1:] + edges[:-1])
    nodes = (middle[:, None] + half[:, None] * local).ravel()
    weights = (half[:, None] * local_weights).ravel()
    antiderivative = np.polynomial.legendre.legint(np.eye(order), lbnd=-1.0, axis=0)
    running = np.polynomial.legendre.legvander(local, order) @ antiderivative @ _to_legendre(order)
    panels = len(half)
    slope = (
        np.polynomial.legendre.legvander(local, order - 2)
        @ np.polynomial.legendre.legder(np.eye(order), axis=0)
        @ _to_legendre(order)
    )
    cumulative = np.zeros((panels * order, panels * order))
    derivative = np.zeros_like(cumulative)
    for panel in range(panels):
        rows = slice(panel * order, (panel + 1) * order)
        cumulative[rows, : panel * order] = weights[: panel * order]
        cumulative[rows, rows] = half[panel] * running
        derivative[rows, rows] = slope / half[panel]
    return PanelGrid(edges, nodes, weights, cumulative, derivative, order)
