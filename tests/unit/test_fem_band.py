"""The band of a part with ties and supports solves what the dense matrix solves."""

from __future__ import annotations

import math

import numpy as np
import pytest

from springcad.mechanics.fem.assembly import (
    Sheet,
    block_product,
    deformation,
    prepare_solid,
    stiffness_blocks,
    stress,
)
from springcad.mechanics.fem.band import solve
from springcad.mechanics.fem.blocks import graded, join, straight, transfinite
from springcad.mechanics.fem.constraints import (
    Constraints,
    Equations,
    prescribe,
    solve_constraints,
    tie,
)
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import prepare_model

PITCH = math.radians(30.0)


def ring_piece() -> Mesh:
    """A sector of a ring between radii of 2 and 3, in two blocks, cut at 0 and at 30 degrees."""
    angles = PITCH * graded(3)
    arcs = [r * np.column_stack([np.cos(angles), np.sin(angles)]) for r in (3.0, 2.6, 2.0)]

    def block(outer, inner):
        west, east = (straight(outer[k], inner[k], graded(2)) for k in (0, -1))
        return transfinite(outer, inner, west, east)

    sides = {
        "outer": [("rim", "south")],
        "first": [("core", "west"), ("rim", "west")],
        "last": [("rim", "east"), ("core", "east")],
    }
    return join({"rim": block(*arcs[:2]), "core": block(*arcs[1:])}, sides)


def no_mean(mesh: Mesh) -> Equations:
    """No mean displacement along x of the outer edge: one component follows from all others."""
    components = 2 * mesh.node_sets["outer"][1:-1]
    others = components[1:]
    none = np.zeros(len(others), dtype=np.intp)
    return Equations(components[:1], np.zeros(1), none, others, -np.ones(len(others)))


def constraints_of(mesh: Mesh, held: str) -> Constraints:
    first, last = mesh.node_sets["first"][::-1], mesh.node_sets["last"]
    outer = mesh.node_sets["outer"]
    if held == "outer edge":
        inside = ~np.isin(last, outer)
        return solve_constraints(
            mesh.unknowns, prescribe(outer), tie(last[inside], first[inside], PITCH)
        )
    return solve_constraints(mesh.unknowns, no_mean(mesh), tie(last, first, PITCH))


@pytest.mark.parametrize("held", ["outer edge", "mean of the outer edge"])
def test_a_tied_and_held_part_is_solved_as_by_a_dense_matrix(held: str) -> None:
    mesh = ring_piece()
    constraints = constraints_of(mesh, held)
    model = prepare_model(prepare_solid(mesh, Sheet(200.0, 0.3, 0.5)), constraints)
    rest = deformation(model.solid, np.zeros(mesh.unknowns))
    blocks = stiffness_blocks(model.solid, rest, stress(model.solid.sheet, rest.strain))
    full = np.column_stack([block_product(model.solid, blocks, e) for e in np.eye(mesh.unknowns)])
    transform = constraints.transform.toarray()
    dense = transform.T @ full @ transform
    right = np.random.default_rng(4).normal(size=(len(dense), 2))
    found = solve(model.pattern, [(model.element_scatter, blocks)], right)
    assert found == pytest.approx(np.linalg.solve(dense, right), rel=1e-8, abs=1e-10)
