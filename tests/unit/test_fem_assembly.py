"""Forces and stiffness of the finite elements are derivatives of their energy."""

from __future__ import annotations

import numpy as np
import pytest
from fem_cases import STEEL, cantilever, distorted_square, grid

from springcad.mechanics.fem.assembly import (
    block_product,
    deformation,
    edge_load,
    internal_force,
    prepare_solid,
    stiffness_blocks,
    strain_energy,
    stress,
)
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.recovery import gauss_stress, nodal_stress, von_mises


@pytest.fixture(scope="module")
def solid():
    return prepare_solid(distorted_square(0.02), STEEL)


@pytest.fixture(scope="module")
def displacement(solid):
    return 2e-4 * np.random.default_rng(1).standard_normal(solid.mesh.unknowns)


@pytest.fixture(scope="module")
def direction(solid):
    return np.random.default_rng(2).standard_normal(solid.mesh.unknowns)


def turned(mesh, angle):
    c, s = np.cos(angle), np.sin(angle)
    return (mesh.nodes @ np.array([[c, s], [-s, c]]) - mesh.nodes).ravel()


def test_the_forces_are_the_slope_of_the_energy(solid, displacement, direction):
    step = 1e-9

    def energy(way):
        return strain_energy(solid, deformation(solid, displacement + way * direction))

    slope = (energy(step) - energy(-step)) / (2.0 * step)
    force = internal_force(solid, deformation(solid, displacement))
    assert direction @ force == pytest.approx(slope, rel=1e-6)


def test_the_stiffness_is_the_slope_of_the_forces(solid, displacement, direction):
    step = 1e-9

    def force(way):
        return internal_force(solid, deformation(solid, displacement + way * direction))

    slope = (force(step) - force(-step)) / (2.0 * step)
    state = deformation(solid, displacement)
    blocks = stiffness_blocks(solid, state, stress(STEEL, state.strain))
    tangent = block_product(solid, blocks, direction)
    assert np.abs(tangent - slope).max() < 1e-7 * np.abs(slope).max()


@pytest.mark.parametrize("angle", [0.1, 1.0, np.pi])
def test_a_rigid_rotation_costs_nothing(solid, angle):
    state = deformation(solid, turned(solid.mesh, angle))
    yardstick = STEEL.elastic_modulus * STEEL.thickness * 0.02
    assert strain_energy(solid, state) < 1e-25 * yardstick
    assert np.abs(internal_force(solid, state)).max() < 1e-14 * yardstick


def test_stresses_turn_with_the_part(solid, displacement):
    """The Cauchy stress is objective: a rotation on top of a deformation turns its axes only."""
    angle = 0.7
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    small = 0.01 * displacement
    after = (solid.mesh.nodes + small.reshape(-1, 2)) @ turn.T - solid.mesh.nodes
    xx, yy, xy = gauss_stress(solid, small)
    axes = np.einsum("ai,ij...,bj->ab...", turn, np.array([[xx, xy], [xy, yy]]), turn)
    found = gauss_stress(solid, after.ravel())
    expected = np.stack([axes[0, 0], axes[1, 1], axes[0, 1]])
    assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max()
    assert von_mises(found) == pytest.approx(von_mises(gauss_stress(solid, small)), rel=1e-8)


def test_bending_stress_is_recovered_at_the_nodes():
    """A linear stress field is recovered exactly, up to the surface."""
    mesh = cantilever(0.02, 5e-4, 5e-4, columns=10, rows=1)
    x, y = mesh.nodes.T
    curvature, nu = 1e-6, STEEL.poisson_ratio  # so small that the ends hardly turn
    bent = np.stack([-curvature * x * y, 0.5 * curvature * (x**2 + nu * y**2)], axis=1)
    solid = prepare_solid(mesh, STEEL)
    found = nodal_stress(solid, bent.ravel())
    expected = -STEEL.elastic_modulus * curvature * y
    assert np.abs(found[0] - expected).max() < 1e-6 * np.abs(expected).max()
    assert np.abs(found[1:]).max() < 1e-6 * np.abs(expected).max()


def test_an_edge_load_keeps_its_resultant_and_its_line_of_action():
    mesh = cantilever(0.02, 9e-4, 3e-4, columns=5, rows=3)
    nodal = edge_load(mesh, "east", np.array([-30.0, 120.0])).reshape(-1, 2)
    assert nodal.sum(axis=0) == pytest.approx([-30.0, 120.0], rel=1e-12)
    moment = np.sum(mesh.nodes[:, 0] * nodal[:, 1] - mesh.nodes[:, 1] * nodal[:, 0])
    assert moment == pytest.approx(0.02 * 120.0, rel=1e-12)


def test_an_element_inside_out_is_refused():
    mesh = grid(lambda u, v: (u, v), 2, 2)
    nodes = mesh.nodes.copy()
    nodes[:, 0] *= -1.0
    with pytest.raises(ValueError, match="element 0 has no positive area"):
        prepare_solid(Mesh(nodes, mesh.elements), STEEL)
