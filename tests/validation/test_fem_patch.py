"""Patch tests: a constant state of stress is represented exactly by badly shaped elements."""

from __future__ import annotations

import numpy as np
import pytest
from fem_cases import STEEL, distorted_square

from springcad.mechanics.fem.assembly import prepare_solid
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.model import no_load, prepare_model
from springcad.mechanics.fem.newton import linear_solution, solve_path
from springcad.mechanics.fem.recovery import gauss_stress, nodal_stress

MESH = distorted_square(0.01)
BOUNDARY = np.unique(np.concatenate(list(MESH.node_sets.values())))


def pulled(gradient):
    """Model with its boundary displaced by a constant displacement gradient; that field."""
    field = MESH.nodes @ np.asarray(gradient).T
    held = solve_constraints(MESH.unknowns, prescribe(BOUNDARY, field[BOUNDARY]))
    return prepare_model(prepare_solid(MESH, STEEL), held), field.ravel()


@pytest.mark.parametrize(
    "gradient", [[[1e-3, 0], [0, 0]], [[0, 0], [0, 1e-3]], [[0, 2e-3], [-1e-3, 0]]]
)
def test_linear_patch(gradient):
    model, field = pulled(gradient)
    state = linear_solution(model, no_load(model))
    assert np.abs(state.displacement - field).max() < 1e-10 * np.abs(field).max()


def test_patch_with_large_strain_and_rotation():
    """Homogeneous F: uniform Cauchy stress F S Fᵀ/J everywhere, also recovered at the nodes."""
    gradient = np.array([[-0.3, -0.6], [0.7, -0.2]])
    model, field = pulled(gradient)
    state = solve_path(model, [no_load(model)])[-1]
    assert np.abs(state.displacement - field).max() < 1e-10 * np.abs(field).max()

    f = np.eye(2) + gradient
    strain = 0.5 * (f.T @ f - np.eye(2))
    nu, e = STEEL.poisson_ratio, STEEL.elastic_modulus
    second = e / (1 - nu**2) * ((1 - nu) * strain + nu * np.trace(strain) * np.eye(2))
    thickness_stretch = np.sqrt(1 - 2 * nu / (1 - nu) * np.trace(strain))
    cauchy = f @ second @ f.T / (np.linalg.det(f) * thickness_stretch)
    expected = np.array([cauchy[0, 0], cauchy[1, 1], cauchy[0, 1]])
    size = np.abs(expected).max()
    found = gauss_stress(model.solid, state.displacement)
    assert np.abs(found - expected[:, None, None]).max() < 1e-10 * size
    at_nodes = nodal_stress(model.solid, state.displacement)
    assert np.abs(at_nodes - expected[:, None]).max() < 1e-10 * size

    volume = STEEL.thickness * 0.01**2
    assert state.energy == pytest.approx(0.5 * np.sum(second * strain) * volume, rel=1e-10)
