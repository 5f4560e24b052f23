"""Stress along a free edge of a sheet, from the stretch of its surface."""

from __future__ import annotations

import numpy as np
import pytest
from fem_cases import STEEL, cantilever

from springcad.mechanics.fem.assembly import prepare_solid
from springcad.mechanics.fem.recovery import edge_stress, gauss_stress

LENGTH, HALF = 0.02, 5e-4
EDGES = ("north", "south")


def stresses(move) -> tuple[np.ndarray, np.ndarray]:
    """Edge stresses and the largest stress inside of a strip whose nodes are moved."""
    mesh = cantilever(LENGTH, HALF, HALF, columns=8, rows=2)
    solid = prepare_solid(mesh, STEEL)
    displacement = (move(mesh.nodes) - mesh.nodes).ravel()
    along = np.concatenate([edge_stress(solid, displacement, edges) for edges in EDGES])
    return along, gauss_stress(solid, displacement)[0]


@pytest.mark.parametrize("stretch", [-0.02, 1e-4, 0.02])
def test_in_tension_it_is_the_stress_of_the_sheet(stretch: float) -> None:
    """The sides draw in until the stress across vanishes: E_yy = -nu E_xx in the elastic law."""
    strain = 0.5 * ((1.0 + stretch) ** 2 - 1.0)
    across = np.sqrt(1.0 - 2.0 * STEEL.poisson_ratio * strain)
    along, inside = stresses(lambda nodes: nodes * [1.0 + stretch, across])
    assert along == pytest.approx(np.full_like(along, inside.max()), rel=1e-9)
    assert along == pytest.approx(
        np.full_like(along, STEEL.elastic_modulus * stretch), rel=2.2 * abs(stretch)
    )


def test_turning_a_sheet_does_not_stress_its_edge() -> None:
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    along, _ = stresses(lambda nodes: nodes @ turn.T)
    assert np.abs(along).max() < 1e-9 * STEEL.elastic_modulus


def test_bent_to_an_arc_the_edges_bear_what_their_length_says() -> None:
    """A strip wound on a cylinder: the strain of its edges is half thickness over radius."""
    radius = 0.05

    def wound(nodes: np.ndarray) -> np.ndarray:
        angle, out = nodes[:, 0] / radius, radius - nodes[:, 1]
        return np.column_stack([out * np.sin(angle), radius - out * np.cos(angle)])

    along, _ = stresses(wound)
    strain = HALF / radius
    expected = STEEL.elastic_modulus * strain
    assert np.abs(along) == pytest.approx(np.full_like(along, expected), rel=2.2 * strain)
