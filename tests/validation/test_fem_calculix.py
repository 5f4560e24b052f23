"""CalculiX repeats our analyses from the decks that we write."""

from __future__ import annotations

import numpy as np
import pytest
from fem_cases import STEEL, arch, cantilever, circle, clamped, run_calculix

from springcad.mechanics.fem.assembly import edge_load, prepare_solid
from springcad.mechanics.fem.constraints import prescribe, solve_constraints, tie
from springcad.mechanics.fem.contact import prepare_contact
from springcad.mechanics.fem.deck import SLICE, slice_deck
from springcad.mechanics.fem.deck_contact import rigid_strip
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, prepare_model
from springcad.mechanics.fem.newton import linear_solution, solve_path
from springcad.mechanics.fem.rigid_profile import rigid_profile


@pytest.mark.parametrize("nonlinear", [False, True], ids=["linear", "nonlinear"])
def test_tapered_cantilever(require_tool, tmp_path, nonlinear):
    """All displacements within 1e-4 of the largest, at a deflection of a tenth of the length."""
    mesh = cantilever(0.02, 9e-4, 2.5e-4, columns=30, rows=4)
    model = clamped(mesh)
    load = Load(edge_load(mesh, "east", np.array([-30.0, 140.0])), np.zeros(mesh.unknowns))
    state = solve_path(model, [load])[-1] if nonlinear else linear_solution(model, load)
    deck = slice_deck(mesh, STEEL, model.constraints, [load], nonlinear=nonlinear)
    theirs = run_calculix(require_tool("ccx"), deck, tmp_path, len(mesh.nodes))[0]
    ours = state.displacement.reshape(-1, 2)
    assert np.abs(ours).max() > 2e-3 if nonlinear else True
    assert np.abs(theirs - ours).max() < 1e-4 * np.abs(ours).max()


def test_sector_with_ties(require_tool, tmp_path):
    """A ring sector, rim held, inner edge turned by 5°, sides tied by *EQUATION."""
    mesh = arch(0.02, 0.03, np.pi / 3, 8, 4)
    east, west = mesh.node_sets["east"], mesh.node_sets["west"]
    pairs = [side[np.argsort(np.hypot(*mesh.nodes[side].T))] for side in (east, west)]
    inner = np.setdiff1d(mesh.node_sets["north"], east)
    outer = np.setdiff1d(mesh.node_sets["south"], east)
    c, s = np.cos(np.radians(5.0)) - 1.0, np.sin(np.radians(5.0))
    moved = mesh.nodes[inner] @ np.array([[c, s], [-s, c]])
    constraints = solve_constraints(
        mesh.unknowns, prescribe(inner, moved), prescribe(outer), tie(*pairs, np.pi / 3)
    )
    model = prepare_model(prepare_solid(mesh, STEEL), constraints)
    load = Load(np.zeros(mesh.unknowns), constraints.constants)
    ours = solve_path(model, [load])[-1].displacement.reshape(-1, 2)
    deck = slice_deck(mesh, STEEL, constraints, [load])
    theirs = run_calculix(require_tool("ccx"), deck, tmp_path, len(mesh.nodes))[0]
    assert np.abs(theirs - ours).max() < 1e-4 * np.abs(ours).max()


@pytest.mark.slow
def test_frictionless_contact(require_tool, tmp_path):
    """A short cantilever pushed aside by a turning pin: contact force within 0.5 %."""
    tip_half, pin = 2.5e-4, 2e-3
    center = (-6.5e-3, -tip_half - pin - 5e-6)
    mesh = cantilever(0.008, 5e-4, tip_half, columns=50, rows=3, origin=(-0.014, 0.0))
    edges = {"contact": mesh.edge_sets["south"][25:]}
    mesh = Mesh(mesh.nodes, mesh.elements, mesh.node_sets, edges)
    solid = prepare_solid(mesh, STEEL)
    profile = rigid_profile(circle(pin, center))
    contact = prepare_contact(solid, "contact", profile, 1e14, points_per_edge=8)
    held = solve_constraints(mesh.unknowns, prescribe(mesh.node_sets["west"]))
    model = prepare_model(solid, held, contact)
    zero = np.zeros(mesh.unknowns)
    loads = [Load(zero, zero, -np.radians(angle)) for angle in (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)]
    states = solve_path(model, loads)
    state = states[-1]
    strip = rigid_strip(contact, [state.contact for state in states])
    deck = slice_deck(mesh, STEEL, held, loads, strip=strip)
    moved, reaction = run_calculix(require_tool("ccx"), deck, tmp_path, len(mesh.nodes))
    theirs = -reaction[mesh.node_sets["west"]].sum(axis=0) * STEEL.thickness / SLICE
    ours = state.contact.force
    assert np.hypot(*(theirs - ours)) < 5e-3 * np.hypot(*ours)
    ours_moved = state.displacement.reshape(-1, 2)
    assert np.abs(moved - ours_moved).max() < 2e-3 * np.abs(ours_moved).max()


def test_a_deck_holds_no_second_line_in_its_title():
    mesh = cantilever(0.02, 9e-4, 2.5e-4, columns=2, rows=1)
    model = clamped(mesh)
    load = Load(np.zeros(mesh.unknowns), np.zeros(mesh.unknowns))
    with pytest.raises(ValueError, match="one line"):
        slice_deck(mesh, STEEL, model.constraints, [load], title="a\n*INCLUDE, INPUT=b")
