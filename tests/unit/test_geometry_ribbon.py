"""Panels and ribbons: spectral accuracy, and the area that bending does not change."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from scipy.special import fresnel

from springcad.geometry.panels import panel_grid
from springcad.geometry.ribbon import ORDER, Ribbon

EDGES = np.linspace(0.0, 1.5, 11)


def ribbon(curvature: object, half_thickness: object, edges: np.ndarray = EDGES) -> Ribbon:
    nodes = panel_grid(edges, ORDER).nodes
    return Ribbon(edges, np.vectorize(curvature)(nodes), np.vectorize(half_thickness)(nodes), 0.0)


def test_panels_integrate_and_differentiate_polynomials_exactly() -> None:
    grid = panel_grid(EDGES, 5)
    s = grid.nodes
    assert grid.weights @ s**9 == pytest.approx(1.5**10 / 10.0, rel=1e-13)
    np.testing.assert_allclose(grid.cumulative @ s**4, s**5 / 5.0, atol=1e-14)
    np.testing.assert_allclose(grid.derivative @ s**4, 4.0 * s**3, atol=1e-12)
    at = np.linspace(0.0, 1.5, 41)
    np.testing.assert_allclose(grid.interpolation(at) @ s**4, at**4, atol=1e-13)


@pytest.mark.parametrize("order", [3, 5])
def test_running_integrals_converge_with_the_order_of_the_panels(order: int) -> None:
    errors = []
    for panels in (4, 8):
        grid = panel_grid(np.linspace(0.0, 1.0, panels + 1), order)
        exact = (np.exp(2.0 * grid.nodes) - 1.0) / 2.0
        errors.append(np.max(np.abs(grid.cumulative @ np.exp(2.0 * grid.nodes) - exact)))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order + 1, abs=0.4)


def test_a_clothoid_follows_the_fresnel_integrals() -> None:
    shape = ribbon(lambda s: np.pi * s, lambda s: 0.05)
    s = np.linspace(0.0, 1.5, 31)
    sine, cosine = fresnel(s)
    points = shape.at(s)
    np.testing.assert_allclose(points.x, cosine, atol=1e-9)
    np.testing.assert_allclose(points.y, sine, atol=1e-9)


def test_bending_leaves_the_area_of_a_ribbon_as_it_is() -> None:
    """The strip between the edges has the area of integral 2 lambda ds while lambda kappa < 1."""

    def half_thickness(s: float) -> float:
        return 0.06 - 0.02 * s

    shape = ribbon(lambda s: 6.0 * np.cos(4.0 * s), half_thickness)
    left, right = shape.boundary(shape.dense_stations(3000))
    area = shapely.Polygon(np.concatenate([left.points, right.points[::-1]])).area
    assert area == pytest.approx(2.0 * (0.06 * 1.5 - 0.01 * 1.5**2), rel=1e-6)


def test_edges_have_their_own_tangents() -> None:
    shape = ribbon(lambda s: 5.0 * np.sin(3.0 * s), lambda s: 0.05 + 0.02 * np.sin(2.0 * s))
    stations = np.linspace(0.01, 1.49, 4001)
    for edge in shape.boundary(stations):
        chord = np.gradient(edge.points, axis=0)
        chord /= np.hypot(*chord.T)[:, None]
        np.testing.assert_allclose(chord[1:-1], edge.tangents[1:-1], atol=2e-6)


def test_a_ribbon_that_folds_over_is_refused() -> None:
    with pytest.raises(ValueError, match="folds over"):
        ribbon(lambda s: 25.0, lambda s: 0.05).boundary(np.linspace(0.0, 1.5, 50))


def test_dense_stations_keep_every_panel_boundary() -> None:
    shape = ribbon(lambda s: 0.0, lambda s: 0.05)
    stations = shape.dense_stations(200)
    assert np.all(np.diff(stations) > 0.0)
    assert np.diff(stations).max() <= 1.5 / 200 + 1e-12
    assert set(EDGES) <= set(stations)
