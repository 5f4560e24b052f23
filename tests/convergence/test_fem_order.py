"""How fast the finite elements approach the limit when the mesh is refined."""

from __future__ import annotations

import numpy as np
from fem_cases import STEEL, arch, grid

from springcad.mechanics.fem.assembly import prepare_solid
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.element import gauss_points, shape_functions
from springcad.mechanics.fem.model import no_load, prepare_model
from springcad.mechanics.fem.newton import linear_solution, solve_path
from springcad.mechanics.fem.recovery import gauss_stress, nodal_stress


def harmonic(points):
    """Displacement with no body force: u = grad of Re (x + i y)⁵ + polynomial, equilibrium."""
    z = (points[..., 0] + 1j * points[..., 1]) / 0.01
    d = 5.0 * z**4
    return 1e-6 * np.stack([d.real, -d.imag], axis=-1)


def error_of_displacement(count):
    """L2 error, over the norm of the field, on a curved mesh with the exact boundary values."""
    mesh = grid(
        lambda u, v: (0.01 * (u + 0.15 * np.sin(3 * v)), 0.01 * (v + 0.15 * np.sin(3 * u))),
        count,
        count,
    )
    rim = np.unique(np.concatenate(list(mesh.node_sets.values())))
    exact = harmonic(mesh.nodes)
    held = solve_constraints(mesh.unknowns, prescribe(rim, exact[rim]))
    model = prepare_model(prepare_solid(mesh, STEEL), held)
    found = linear_solution(model, no_load(model)).displacement.reshape(-1, 2)
    value = shape_functions(gauss_points()[0])[0]
    at = np.einsum("ga,eai->egi", value, mesh.nodes[mesh.elements])
    miss = np.einsum("ga,eai->egi", value, found[mesh.elements]) - harmonic(at)
    weights = model.solid.weights[..., None]
    return np.sqrt(np.sum(weights * miss**2) / np.sum(weights * harmonic(at) ** 2))


def test_displacements_converge_with_the_third_order():
    errors = [error_of_displacement(count) for count in (4, 8, 16)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders.min() > 2.9
    assert errors[-1] < 1e-4


def twisted_ring(count):
    """Energy of a ring sector turned by 0.05 rad at its inner edge, sides free."""
    mesh = arch(0.02, 0.03, 1.0, 2 * count, count)
    inner = mesh.node_sets["north"]
    c, s = np.cos(0.05) - 1.0, np.sin(0.05)
    moved = mesh.nodes[inner] @ np.array([[c, s], [-s, c]])
    held = solve_constraints(
        mesh.unknowns, prescribe(inner, moved), prescribe(mesh.node_sets["south"])
    )
    model = prepare_model(prepare_solid(mesh, STEEL), held)
    return solve_path(model, [no_load(model)])[-1].energy


def test_energy_of_a_large_deformation_converges_from_above():
    """Finite elements are too stiff, never too soft; corner singularities limit the order."""
    energies = [twisted_ring(count) for count in (2, 4, 8, 16)]
    falls = -np.diff(energies)
    assert np.all(falls > 0.0)
    assert np.all(falls[:-1] > 1.9 * falls[1:])


def stress_error(count, where):
    """Largest error of the stress at Gauss points or at nodes, over the largest stress."""
    mesh = grid(lambda u, v: (0.01 * u, 0.01 * v), count, count)
    exact = harmonic(mesh.nodes)
    rim = np.unique(np.concatenate(list(mesh.node_sets.values())))
    held = solve_constraints(mesh.unknowns, prescribe(rim, exact[rim]))
    model = prepare_model(prepare_solid(mesh, STEEL), held)
    # So small that the nonlinear stress measure does not matter.
    found = 1e-3 * linear_solution(model, no_load(model)).displacement

    def stress(points):
        z = (points[..., 0] + 1j * points[..., 1]) / 0.01
        second = 1e-9 * 20.0 * z**3 / 0.01
        size = 2.0 * STEEL.lame[1]
        return size * np.stack([second.real, -second.real, -second.imag])

    if where == "nodes":
        points, values = mesh.nodes, nodal_stress(model.solid, found)
    else:
        value = shape_functions(gauss_points()[0])[0]
        points = np.einsum("ga,eai->egi", value, mesh.nodes[mesh.elements])
        values = gauss_stress(model.solid, found)
    exact_stress = stress(points)
    return np.abs(values - exact_stress).max() / np.abs(exact_stress).max()


def test_recovered_stresses_converge_with_the_second_order():
    for where in ("gauss", "nodes"):
        errors = [stress_error(count, where) for count in (4, 8, 16)]
        orders = np.log2(np.array(errors[:-1]) / errors[1:])
        assert orders.min() > 1.8, where
