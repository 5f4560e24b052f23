"""The finite elements against closed solutions, published numbers and scikit-fem."""

from __future__ import annotations

import numpy as np
import pytest
import skfem
from fem_cases import STEEL, arch, cantilever, clamped, distorted_square, grid
from scipy.spatial import KDTree
from skfem.helpers import ddot, dot, sym_grad, trace

from springcad.mechanics.beam import RibbonBeam, prepare
from springcad.mechanics.dead_load import dead_load
from springcad.mechanics.fem.assembly import Sheet, edge_load, prepare_solid
from springcad.mechanics.fem.constraints import prescribe, solve_constraints, tie
from springcad.mechanics.fem.element import edge_shape_functions
from springcad.mechanics.fem.model import Load, no_load, prepare_model
from springcad.mechanics.fem.newton import linear_solution, solve_path
from springcad.mechanics.fem.recovery import nodal_stress


def force_only(force):
    return Load(force, np.zeros_like(force))


def test_cook_membrane():
    """Cook 1974: E = 1, ν = 1/3, unit shear force; converged 23.96 at the middle of the end."""
    mesh = grid(lambda u, v: (48.0 * u, 44.0 * u + v * (44.0 - 28.0 * u)), 16, 16)
    model = clamped(mesh, Sheet(1.0, 1.0 / 3.0, 1.0))
    state = linear_solution(model, force_only(edge_load(mesh, "east", np.array([0.0, 1.0]))))
    middle = KDTree(mesh.nodes).query([48.0, 52.0])[1]
    assert state.displacement[2 * middle + 1] == pytest.approx(23.96, rel=2e-3)


class QuarterRing:
    """Timoshenko and Goodier, Theory of Elasticity, art. 33: radial end load P on a quarter ring.

    Inner radius a, outer b, unit thickness, load at θ = 0 towards the centre.
    """

    a, b, force, e = 0.02, 0.03, 10.0, 200e9

    def __init__(self):
        a, b = self.a, self.b
        n = a**2 - b**2 + (a**2 + b**2) * np.log(b / a)
        self.coefficients = (
            self.force / (2 * n),
            -self.force * a**2 * b**2 / (2 * n),
            -self.force * (a**2 + b**2) / n,
        )
        self.deflection = np.pi * self.force * (a**2 + b**2) / (self.e * n)

    def shear(self, r):
        """τ_rθ at θ = 0."""
        p, q, d = self.coefficients
        return -(2 * p * r - 2 * q / r**3 + d / r)

    def hoop_stress(self, r):
        """σ_θ at θ = π/2."""
        p, q, d = self.coefficients
        return 6 * p * r + 2 * q / r**3 + d / r


def test_curved_beam_with_end_load():
    """The deflection of the loaded end and the stress of the held one."""
    ring = QuarterRing()
    sheet = Sheet(ring.e, 0.3, 1.0)
    mesh = arch(ring.a, ring.b, 0.5 * np.pi, 16, 6)
    loaded, held = mesh.node_sets["west"], mesh.node_sets["east"]
    x, w = np.polynomial.legendre.leggauss(4)
    value, slope = edge_shape_functions(x)
    force = np.zeros_like(mesh.nodes)
    for edge in mesh.edge_sets["west"]:
        radius = value @ mesh.nodes[edge, 0]
        length = np.abs(slope @ mesh.nodes[edge, 0]) * w
        force[edge, 0] += value.T @ (length * ring.shear(radius))
    force *= -np.sign(force[:, 0].sum())
    assert force.sum() == pytest.approx(-ring.force, rel=1e-5)

    middle = held[len(held) // 2]
    fixed = solve_constraints(
        mesh.unknowns, prescribe(held, components=(0,)), prescribe(middle, components=(1,))
    )
    model = prepare_model(prepare_solid(mesh, sheet), fixed)
    state = linear_solution(model, force_only(force.ravel()))
    u = state.displacement.reshape(-1, 2)
    assert u[loaded, 0].mean() == pytest.approx(-abs(ring.deflection), rel=1e-3)

    inner = held[np.argmin(mesh.nodes[held, 1])]
    outer = held[np.argmax(mesh.nodes[held, 1])]
    found = nodal_stress(model.solid, state.displacement)[0]
    assert found[inner] == pytest.approx(ring.hoop_stress(ring.a), rel=5e-3)
    assert found[outer] == pytest.approx(ring.hoop_stress(ring.b), rel=5e-3)


def test_linear_solution_of_scikit_fem():
    """The same element on the same distorted mesh, all nodal displacements."""
    mesh = distorted_square(0.01)
    model = clamped(mesh)
    force = edge_load(mesh, "east", np.array([700.0, -200.0]))
    ours = linear_solution(model, force_only(force)).displacement

    corners = np.unique(mesh.elements[:, :4])
    number = np.full(len(mesh.nodes), -1)
    number[corners] = np.arange(len(corners))
    other = skfem.MeshQuad(mesh.nodes[corners].T.copy(), number[mesh.elements[:, :4]].T.copy())
    basis = skfem.Basis(other, skfem.ElementVector(skfem.ElementQuadS2()), intorder=5)
    lam, mu = STEEL.lame

    @skfem.BilinearForm
    def stiffness(u, v, _):
        strain = sym_grad(u)
        return lam * trace(strain) * trace(sym_grad(v)) + 2 * mu * ddot(strain, sym_grad(v))

    place = KDTree(mesh.nodes).query(basis.doflocs.T)[1]
    component = np.empty(basis.N, dtype=int)
    for j in range(2):
        component[np.concatenate([basis.nodal_dofs[j], basis.facet_dofs[j]])] = j
    ours_there, force_there = ours[2 * place + component], force[2 * place + component]
    held = np.flatnonzero(np.isin(place, mesh.node_sets["west"]))
    matrix = STEEL.thickness * stiffness.assemble(basis)
    theirs = skfem.solve(*skfem.condense(matrix, force_there, D=held))
    assert np.abs(theirs - ours_there).max() < 1e-9 * np.abs(ours).max()
    assert dot(theirs, force_there) == pytest.approx(ours @ force, rel=1e-9)


@pytest.mark.parametrize("load", [(0.0, 60.0), (-8.0, 10.0), (100.0, 100.0)])
def test_elastica_with_the_beam(load):
    """A slender cantilever bent far: finite elements and the geometrically exact beam."""
    length, half = 0.05, 2.5e-4
    mesh = cantilever(length, half, half, columns=150, rows=2)
    model = clamped(mesh)
    steps = [force_only(s * edge_load(mesh, "east", np.array(load))) for s in (0.25, 0.5, 0.75, 1)]
    state = solve_path(model, steps)[-1]
    tip = mesh.node_sets["east"][len(mesh.node_sets["east"]) // 2]
    ours = mesh.nodes[tip] + state.displacement.reshape(-1, 2)[tip]

    beam = RibbonBeam(
        panel_edges=np.linspace(0.0, length, 5),
        curvature=np.zeros_like,
        half_thickness=lambda s: np.full_like(s, half),
        root_angle=0.0,
        thickness=STEEL.thickness,
        elastic_modulus=STEEL.elastic_modulus,
        shear_modulus=STEEL.lame[1],
    )
    states = dead_load(prepare(beam), length, load)
    deflection = np.hypot(*(states.end_position[0] - [length, 0.0]))
    assert deflection > 0.2 * length
    assert np.hypot(*(ours - states.end_position[0])) < 2e-4 * deflection
    assert state.energy == pytest.approx(states.energy[0], rel=5e-4)
    assert state.reaction.reshape(-1, 2).sum(axis=0) == pytest.approx(-np.array(load), abs=1e-6)


def turned_inside(angle, columns):
    """A ring segment with its outer edge held, its inner one turned by 0.15, its sides tied."""
    mesh = arch(0.02, 0.03, angle, columns, 4)
    sides = [mesh.node_sets[name] for name in ("east", "west")]
    pairs = [side[np.argsort(np.hypot(*mesh.nodes[side].T))] for side in sides]
    inner = np.setdiff1d(mesh.node_sets["north"], pairs[0])
    outer = np.setdiff1d(mesh.node_sets["south"], pairs[0])
    c, s = np.cos(0.15) - 1.0, np.sin(0.15)
    moved = mesh.nodes[inner] @ np.array([[c, s], [-s, c]])
    constraints = solve_constraints(
        mesh.unknowns, prescribe(inner, moved), prescribe(outer), tie(*pairs, angle)
    )
    model = prepare_model(prepare_solid(mesh, STEEL), constraints)
    return mesh, solve_path(model, [no_load(model)])[-1]


def test_two_sectors_with_ties_are_twice_one_sector():
    """Large cyclic deformation: the same displacements, twice the energy."""
    sixth, one = turned_inside(np.pi / 3, 4)
    third, two = turned_inside(2 * np.pi / 3, 8)
    assert one.energy > 0.0
    assert two.energy == pytest.approx(2.0 * one.energy, rel=1e-9)
    where = KDTree(third.nodes).query(sixth.nodes)[1]
    difference = two.displacement.reshape(-1, 2)[where] - one.displacement.reshape(-1, 2)
    assert np.abs(difference).max() < 1e-9 * np.abs(one.displacement).max()
