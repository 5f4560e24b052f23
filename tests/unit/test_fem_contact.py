"""Contact with a rigid profile: distances, consistent derivatives, Coulomb's law."""

from __future__ import annotations

import numpy as np
import pytest
from fem_cases import STEEL, cantilever, circle, grid

from springcad.mechanics.fem.assembly import prepare_solid
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.contact import (
    evaluate_contact,
    first_history,
    prepare_contact,
)
from springcad.mechanics.fem.contact_tangent import contact_tangent, turning_force
from springcad.mechanics.fem.model import Load, prepare_model
from springcad.mechanics.fem.newton import solve_path
from springcad.mechanics.fem.rigid_profile import project, rigid_profile


def test_distance_normal_and_curvature_of_a_circle():
    profile = rigid_profile(circle(0.01, (0.002, 0.003)))
    points = np.array([0.002, 0.003]) + circle(0.0104, count=37)
    near = project(profile, points)
    assert near.gap == pytest.approx(0.0004, rel=1e-6)
    assert near.curvature == pytest.approx(100.0, rel=1e-3)
    assert near.normal == pytest.approx(circle(1.0, count=37), abs=1e-6)
    inside = project(profile, np.array([0.002, 0.003]) + circle(0.0097, count=37))
    assert inside.gap == pytest.approx(-0.0003, rel=1e-6)


def test_a_profile_of_a_line_and_an_arc_keeps_its_tangents():
    """The line stays straight up to its end although the curvature jumps there."""
    angle = np.linspace(-0.5 * np.pi, 0.0, 60)[1:]
    arc = 0.002 * np.stack([np.cos(angle), 1.0 + np.sin(angle)], axis=1)
    line = np.stack([np.linspace(-0.005, 0.0, 20), np.zeros(20)], axis=1)
    tangents = np.stack([np.append(np.ones(20), -np.sin(angle)),
                         np.append(np.zeros(20), np.cos(angle))], axis=1)  # fmt: skip
    profile = rigid_profile(np.concatenate([line, arc]), tangents)
    below = np.stack([np.linspace(-0.0049, -0.0001, 31), np.full(31, -1e-4)], axis=1)
    near = project(profile, below)
    assert near.gap == pytest.approx(1e-4, rel=1e-12)
    assert near.curvature == pytest.approx(0.0, abs=1e-6)
    beside = np.array([[0.0021, 0.00199]])
    assert project(profile, beside).curvature == pytest.approx(500.0, rel=1e-3)


def test_nothing_touches_beyond_the_ends_of_an_open_profile():
    profile = rigid_profile(np.stack([np.linspace(0.01, 0.0, 5), np.zeros(5)], axis=1))
    near = project(profile, np.array([[0.005, -1e-5], [0.011, -1e-5], [-0.001, -1e-5]]))
    assert near.gap == pytest.approx([-1e-5, np.inf, np.inf])


def pressed(friction):
    """A contact with several points in touch, its history, and a displacement."""
    mesh = cantilever(0.004, 5e-4, 5e-4, columns=8, rows=2, origin=(-0.002, 5e-4))
    profile = rigid_profile(circle(0.003, (0.0002, -0.003)))
    contact = prepare_contact(prepare_solid(mesh, STEEL), "south", profile, 1e15, friction)
    rng = np.random.default_rng(5)
    u = 1e-5 * rng.standard_normal(mesh.unknowns) - np.tile([0.0, 3e-5], len(mesh.nodes))
    history = first_history(contact, u + 1e-5 * rng.standard_normal(mesh.unknowns), 0.01)
    return contact, u, history


@pytest.mark.parametrize("friction", [0.0, 0.2], ids=["frictionless", "friction"])
def test_the_contact_stiffness_is_the_slope_of_the_contact_forces(friction):
    """Stick and slip at once, on a curved, turned profile."""
    contact, u, history = pressed(friction)
    rotation = 0.01
    state = evaluate_contact(contact, u, rotation, history)
    if friction:
        touching = state.pressure > 0.0
        assert state.sliding.any()
        assert (touching & ~state.sliding).any()
    direction = np.random.default_rng(6).standard_normal(u.shape)
    step = 1e-12

    def nodal(way):
        return evaluate_contact(contact, u + way * direction, rotation, history).nodal

    slope = (nodal(step) - nodal(-step)) / (2.0 * step)
    moved = direction.reshape(-1, 2)[contact.edges].reshape(-1, 6, 1)
    parts = contact_tangent(contact, state, state.pressure)
    assert np.any(parts.remainder) == (friction > 0.0)
    skew = parts.symmetric - parts.symmetric.transpose(0, 2, 1)
    assert np.abs(skew).max() < 1e-14 * np.abs(parts.symmetric).max()
    tangent = -((parts.symmetric + parts.remainder) @ moved).reshape(slope.shape)
    assert np.abs(tangent - slope).max() < 1e-6 * np.abs(slope).max()


@pytest.mark.parametrize("friction", [0.0, 0.2], ids=["frictionless", "friction"])
def test_turning_the_profile_changes_the_forces_as_predicted(friction):
    contact, u, history = pressed(friction)
    rotation, step = 0.01, 1e-9
    state = evaluate_contact(contact, u, rotation, history)
    ends = [evaluate_contact(contact, u, rotation + s, history).nodal for s in (step, -step)]
    slope = (ends[0] - ends[1]) / (2.0 * step)
    assert np.abs(turning_force(contact, state) - slope).max() < 1e-6 * np.abs(slope).max()


def test_the_torque_on_the_profile_is_the_fall_of_the_contact_energy():
    contact, u, history = pressed(0.0)
    step = 1e-8
    ends = [evaluate_contact(contact, u, s, history).energy for s in (step, -step)]
    torque = evaluate_contact(contact, u, 0.0, history).torque
    assert torque == pytest.approx((ends[1] - ends[0]) / (2.0 * step), rel=1e-6)


def slide_a_block(friction, ways, press=-2e-7):
    """A block of 2 x 1 mm pressed on a plane by its back, then moved along it step by step."""
    mesh = grid(lambda u, v: (0.002 * (u - 0.5), 0.001 * v), 8, 4)
    solid = prepare_solid(mesh, STEEL)
    plane = rigid_profile(np.stack([np.linspace(0.01, -0.01, 41), np.zeros(41)], axis=1))
    contact = prepare_contact(solid, "south", plane, 1e15, friction)
    back = mesh.node_sets["north"]
    held = solve_constraints(mesh.unknowns, prescribe(back))
    model = prepare_model(solid, held, contact)
    loads = []
    for way in ways:
        prescribed = np.zeros((len(mesh.nodes), 2))
        prescribed[back] = way, press
        loads.append(Load(np.zeros(mesh.unknowns), prescribed.ravel()))
    return solve_path(model, loads)


def test_a_dragged_block_sticks_and_then_slides_with_coulomb_friction():
    ways = np.concatenate([np.linspace(0.0, 1e-6, 11), np.linspace(0.8e-6, -1e-6, 10)])
    states = slide_a_block(0.3, ways)
    forces = np.array([state.contact.force for state in states])
    ratio = forces[:, 0] / forces[:, 1]
    assert np.all(forces[:, 1] > 0.0)
    assert np.all(np.abs(ratio) < 0.3 * (1.0 + 1e-9))
    assert ratio[10] == pytest.approx(-0.3, rel=1e-9)
    assert ratio[-1] == pytest.approx(0.3, rel=1e-9)
    assert -0.25 < ratio[1] < 0.0
    # Turned back by one step, the block sticks: the force falls along the elastic line.
    assert ratio[10] < ratio[11] < ratio[12]


def test_friction_dissipates():
    """The work of a closed loop of dragging is positive, and about twice the way times μ N."""
    ways = np.concatenate([np.linspace(0, 4e-6, 21), np.linspace(3.8e-6, 0, 20),
                           np.linspace(0.2e-6, 4e-6, 20)])  # fmt: skip
    states = slide_a_block(0.3, ways)
    force = np.array([state.contact.force for state in states])
    loop = slice(20, 61)
    x, f = ways[loop], -force[loop, 0]
    work = np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(x))
    sliding = 0.3 * force[30, 1] * 2.0 * 4e-6
    assert 0.5 * sliding < work < sliding
