"""Contact: Hertz's pressure, conservation of energy, hysteresis."""

from __future__ import annotations

import numpy as np
import pytest
from fem_cases import STEEL, cantilever, circle, grid

from springcad.mechanics.contact import half_width, peak_pressure
from springcad.mechanics.fem.assembly import edge_load, prepare_solid
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.contact import prepare_contact
from springcad.mechanics.fem.model import Load, prepare_model
from springcad.mechanics.fem.newton import NoEquilibriumError, solve_path
from springcad.mechanics.fem.rigid_profile import rigid_profile


def test_hertz_pressure_under_a_rigid_cylinder():
    """A block pressed against a rigid cylinder: Johnson, Eq. 4.42-4.45, plane stress (E* = E).

    The augmented Lagrangian removes the penetration, so the pressure is that of hard contact.
    """
    radius, width = 0.01, 0.004

    def shape(u, v):
        s = 2.0 * u - 1.0
        x = np.sign(s) * (0.03 * np.abs(s) + 0.97 * np.abs(s) ** 4)
        return width * x, -width * (0.03 * (1.0 - v) + 0.97 * (1.0 - v) ** 4)

    mesh = grid(shape, 32, 16)
    base = mesh.node_sets["south"]
    solid = prepare_solid(mesh, STEEL)
    cylinder = rigid_profile(circle(radius, (0.0, radius), 2001))
    contact = prepare_contact(solid, "north", cylinder, 5e15, points_per_edge=3, augmentations=4)
    held = solve_constraints(mesh.unknowns, prescribe(base))
    raised = np.zeros((len(mesh.nodes), 2))
    raised[base, 1] = 4e-6
    load = Load(np.zeros(mesh.unknowns), raised.ravel())
    found = solve_path(prepare_model(solid, held, contact), [load])[-1].contact

    force, thickness = -found.force[1], STEEL.thickness
    peak = peak_pressure(force, thickness, 1.0 / radius, STEEL.elastic_modulus)
    strip = half_width(force, thickness, 1.0 / radius, STEEL.elastic_modulus)
    assert found.near.gap[found.pressure > 0.0].min() > -0.02 * strip**2 / radius
    assert found.pressure.max() == pytest.approx(peak, rel=0.03)
    x = found.positions[..., 0] / strip
    ellipse = peak * np.sqrt(np.maximum(0.0, 1.0 - x**2))
    weights = contact.weights
    miss = np.sqrt(np.sum(weights * (found.pressure - ellipse) ** 2) / np.sum(weights * ellipse**2))
    assert miss < 0.05
    assert found.force[0] == pytest.approx(0.0, abs=1e-9 * force)


def pin_on_a_cantilever(friction, clearance=3e-5):
    """A tapered ribbon of 20 mm, its tip pushed aside by a pin of 1 mm turning about the origin."""
    tip_half, pin = 2.5e-4, 1e-3
    mesh = cantilever(0.02, 9e-4, tip_half, columns=120, rows=3, origin=(-0.026, 0.0))
    solid = prepare_solid(mesh, STEEL)
    center = (-6.5e-3, -tip_half - pin - clearance)
    contact = prepare_contact(solid, "south", rigid_profile(circle(pin, center)), 1e15, friction)
    held = solve_constraints(mesh.unknowns, prescribe(mesh.node_sets["west"]))
    return prepare_model(solid, held, contact)


def turned(model, degrees):
    zero = np.zeros(model.solid.mesh.unknowns)
    return [Load(zero, zero, -np.radians(angle)) for angle in degrees]


@pytest.fixture(scope="module")
def frictionless():
    model = pin_on_a_cantilever(0.0)
    return solve_path(model, turned(model, np.linspace(0.0, 12.0, 13)[1:]))


def test_torque_is_the_slope_of_the_stored_energy(frictionless):
    """At 9°, and also: nothing is lost between steps."""
    model = pin_on_a_cantilever(0.0)
    start = frictionless[8]
    ends = [solve_path(model, turned(model, [9.0 + h]), start)[-1] for h in (0.01, -0.01)]
    stored = [end.energy + end.contact.energy for end in ends]
    slope = (stored[0] - stored[1]) / np.radians(0.02)
    assert start.contact.torque == pytest.approx(slope, rel=1e-4)


def test_contact_force_is_what_the_clamp_feels(frictionless):
    for state in frictionless:
        held = state.reaction.reshape(-1, 2)
        size = np.abs(state.contact.force).max()
        assert held.sum(axis=0) == pytest.approx(-state.contact.force, abs=1e-6 * size)


def test_a_load_step_takes_few_iterations(frictionless):
    """Beyond the first steps, in which the contact is found, no more than five."""
    assert max(state.iterations for state in frictionless[2:]) <= 5


def test_a_step_of_any_length_and_direction_gives_the_same_state(frictionless):
    """Without friction the path does not matter: 12° at once, and back from 12° to 6°."""
    model = pin_on_a_cantilever(0.0)
    at_once = solve_path(model, turned(model, [12.0]))[-1]
    assert at_once.contact.torque == pytest.approx(frictionless[-1].contact.torque, rel=1e-6)
    back = solve_path(model, turned(model, [6.0]), at_once)[-1]
    assert back.contact.torque == pytest.approx(frictionless[5].contact.torque, rel=1e-6)


def test_friction_makes_a_loop_that_loses_energy():
    """Loading lies above unloading once the tip slides out along the pin, and work is lost."""
    model = pin_on_a_cantilever(0.2)
    up, down = np.linspace(0.0, 12.0, 13)[1:], np.linspace(12.0, 0.0, 13)[1:]
    loading = solve_path(model, turned(model, up))
    unloading = solve_path(model, turned(model, down), loading[-1])
    rising = np.array([0.0, *(state.contact.torque for state in loading)])
    falling = np.array([rising[-1], *(state.contact.torque for state in unloading)])[::-1]
    angle = np.radians(np.array([0.0, *up]))
    assert falling[0] == pytest.approx(0.0, abs=1e-12)
    assert np.all(rising[6:-1] > 1.02 * falling[6:-1])
    lost = np.sum(0.5 * ((rising - falling)[1:] + (rising - falling)[:-1]) * np.diff(angle))
    assert 0.02 < lost / loading[-1].energy < 0.15
    for state in loading:
        contact = state.contact
        assert np.all(np.abs(contact.traction) <= 0.2 * contact.pressure * (1.0 + 1e-9))


def test_a_path_without_equilibrium_names_its_step():
    """A sheet of this law bears no pressure beyond E/3√3 (a stretch of 1/√3) on its ends."""
    mesh = grid(lambda u, v: (0.001 * u, 0.001 * v), 4, 4)
    held = solve_constraints(
        mesh.unknowns,
        prescribe(mesh.node_sets["west"], components=(0,)),
        prescribe(mesh.node_sets["south"], components=(1,)),
    )
    model = prepare_model(prepare_solid(mesh, STEEL), held)
    push = -STEEL.elastic_modulus * STEEL.thickness * 0.001
    force = edge_load(mesh, "east", np.array([push, 0.0]))
    loads = [Load(part * force, np.zeros(mesh.unknowns)) for part in (0.05, 0.1, 0.25)]
    with pytest.raises(NoEquilibriumError, match="load step 2") as caught:
        solve_path(model, loads)
    assert caught.value.step == 2
    stretch = (
        1.0 + solve_path(model, loads[:2])[-1].displacement[2 * mesh.node_sets["east"][0]] / 0.001
    )
    assert stretch * (1.0 - stretch**2) / 2.0 == pytest.approx(0.1, rel=1e-9)
