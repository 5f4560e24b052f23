"""A planar ribbon: a centre line given by its curvature, and a half thickness along it.

The frame has its origin at the start of the centre line (the root of a flexure); s is the arc
length from there, the angle is that of the tangent from x, n is the normal to the left.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.offset import ribbon_edges
from springcad.geometry.outline import Curve
from springcad.geometry.panels import PanelGrid, panel_grid

Floats = NDArray[np.float64]

ORDER = 8
"""Gauss nodes per panel of a ribbon."""


@dataclass(frozen=True)
class RibbonPoints:
    """A ribbon at M stations, arrays (M,), SI; ``thickness_slope`` is d(half thickness)/ds."""

    stations: Floats
    x: Floats
    y: Floats
    angle: Floats
    curvature: Floats
    half_thickness: Floats
    thickness_slope: Floats


@dataclass(frozen=True)
class Ribbon:
    """Curvature and half thickness as polynomials on panels; enough to rebuild the shape.

    Attributes:
        edges: panel boundaries in s, m (P+1,), the first 0.
        curvature: at the Gauss nodes of the panels, 1/m (8 P,).
        half_thickness: there, m (8 P,).
        root_angle: angle of the tangent at s = 0, rad.
    """

    edges: Floats
    curvature: Floats
    half_thickness: Floats
    root_angle: float

    @cached_property
    def grid(self) -> PanelGrid:
        """The panels' nodes and linear maps."""
        return panel_grid(self.edges, ORDER)

    @property
    def length(self) -> float:
        """Arc length of the centre line, m."""
        return float(self.edges[-1])

    @cached_property
    def _at_nodes(self) -> Floats:
        """Columns x, y, angle, curvature, half thickness and its slope at the nodes (N, 6)."""
        angle = self.root_angle + self.grid.cumulative @ self.curvature
        x, y = self.grid.cumulative @ np.cos(angle), self.grid.cumulative @ np.sin(angle)
        slope = self.grid.derivative @ self.half_thickness
        return np.column_stack([x, y, angle, self.curvature, self.half_thickness, slope])

    def at(self, stations: Floats) -> RibbonPoints:
        """The ribbon at ``stations`` (M,) in m."""
        columns = self.grid.interpolation(stations) @ self._at_nodes
        return RibbonPoints(stations, *columns.T)

    def dense_stations(self, count: int) -> Floats:
        """About ``count`` stations, evenly within each panel, with every panel boundary."""
        spans = np.diff(self.edges)
        per_panel = np.maximum(np.ceil(count * spans / self.length).astype(int), 4)
        pieces = [
            np.linspace(start, start + span, number, endpoint=False)
            for start, span, number in zip(self.edges, spans, per_panel, strict=False)
        ]
        return np.append(np.concatenate(pieces), self.edges[-1])

    def boundary(self, stations: Floats) -> tuple[Curve, Curve]:
        """Left and right edge at ``stations``; ValueError where an edge would fold over."""
        points = self.at(stations)
        sine, cosine = np.sin(points.angle), np.cos(points.angle)
        return ribbon_edges(
            np.column_stack([points.x, points.y]),
            np.column_stack([-sine, cosine]),
            points.curvature,
            points.half_thickness,
            points.thickness_slope,
        )

    @property
    def largest_bend(self) -> float:
        """Largest half thickness x curvature."""
        points = self.at(self.dense_stations(800))
        return float(np.max(np.abs(points.curvature) * points.half_thickness))
