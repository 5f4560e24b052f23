"""A serpentine flexure: against an adaptive integrator, and work put in against energy stored."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from springcad.mechanics.beam import BeamStates, PreparedBeam, RibbonBeam, contact_load, prepare
from springcad.mechanics.centre_line import deformed_points, unloaded_points

E_MODULUS, SHEAR_MODULUS, THICKNESS = 200e9, 77e9, 4.5e-3
LENGTH, PAD = 24e-3, 0.5e-3
STATION = LENGTH - 0.1e-3


def curvature(s: np.ndarray) -> np.ndarray:
    """Two bends of opposite sign, fading into a straight pad."""
    sigma = np.clip(s / (LENGTH - PAD), 0.0, 1.0)
    return 260.0 * np.sin(3 * np.pi * sigma) * (1.0 - sigma) ** 2


def half_thickness(s: np.ndarray) -> np.ndarray:
    """The law λ_r √q up to the pad, where it has reached 0.2 mm."""
    return 1.35e-3 * np.sqrt(np.maximum(1.0 - s / LENGTH, (0.2 / 1.35) ** 2))


def serpentine(nodes: int = 6, panels: int = 11, root_compliance: float = 0.0) -> PreparedBeam:
    law_end = LENGTH * (1.0 - (0.2 / 1.35) ** 2)
    u = np.linspace(0.0, 1.0, panels + 1)
    graded = law_end * (1.0 - (1.0 - u) ** 1.6)
    edges = np.unique(np.concatenate([graded, [LENGTH - PAD, LENGTH + 0.3e-3]]))
    return prepare(
        RibbonBeam(
            edges,
            curvature,
            half_thickness,
            root_angle=0.3,
            thickness=THICKNESS,
            elastic_modulus=E_MODULUS,
            shear_modulus=SHEAR_MODULUS,
            root_compliance=root_compliance,
            nodes_per_panel=nodes,
        )
    )


def by_adaptive_integration(force: float, friction: float) -> np.ndarray:
    """Contact point of the same problem from scipy's DOP853 at a relative tolerance of 1e-12."""
    lam_end = float(half_thickness(np.array(STATION)))
    # The force is normal to the mean of the surface before and beyond the contact (shear).
    tilt = -0.5 * force / (5 / 6 * SHEAR_MODULUS * 2 * lam_end * THICKNESS)
    axial = force * (friction * np.cos(tilt) + np.sin(tilt))
    transverse = force * (friction * np.sin(tilt) - np.cos(tilt))

    def slope(s: float, state: np.ndarray) -> list[float]:
        x, y, psi = state
        cos, sin = np.cos(psi), np.sin(psi)
        lam = float(half_thickness(np.array(s)))
        tension, shear = axial * cos + transverse * sin, transverse * cos - axial * sin
        moment = (0.0 - x) * transverse - (lam_end - y) * axial
        stretch = 1 + tension / (E_MODULUS * 2 * lam * THICKNESS)
        slide = shear / (5 / 6 * SHEAR_MODULUS * 2 * lam * THICKNESS)
        bending = E_MODULUS * 2 / 3 * THICKNESS * lam**3
        return [
            stretch * cos - slide * sin,
            stretch * sin + slide * cos,
            float(curvature(np.array(s))) + moment / bending,
        ]

    state = np.zeros(3)
    kinks = [STATION, LENGTH - PAD, LENGTH * (1.0 - (0.2 / 1.35) ** 2), 0.0]
    for start, end in pairwise(kinks):
        if end < start:
            path = solve_ivp(slope, (start, end), state, "DOP853", rtol=1e-12, atol=1e-15)
            state = path.y[:, -1]
    turn = 0.3 - state[2]
    relative = np.array([0.0, lam_end]) - state[:2]
    cos, sin = np.cos(turn), np.sin(turn)
    return np.array([cos * relative[0] - sin * relative[1], sin * relative[0] + cos * relative[1]])


def error_over_deflection(nodes: int, panels: int = 11) -> float:
    beam = serpentine(nodes, panels)
    states = contact_load(beam, STATION, [0.0, 215.0], 1.0, friction=0.15)
    deflection = np.hypot(*(states.point[1] - states.point[0]))
    return float(np.hypot(*(states.point[1] - by_adaptive_integration(215.0, 0.15))) / deflection)


def test_contact_point_agrees_with_an_adaptive_integrator() -> None:
    assert error_over_deflection(nodes=5) < 1e-4
    assert error_over_deflection(nodes=6) < 1e-5


def test_no_load_leaves_the_reference_shape() -> None:
    beam = serpentine()
    states = contact_load(beam, STATION, 0.0, 1.0)
    s = np.linspace(0.0, LENGTH + 0.3e-3, 300)
    points, rotation = deformed_points(beam, states, s)
    unloaded, unloaded_rotation = unloaded_points(beam, s)
    np.testing.assert_allclose(points[0], unloaded, atol=1e-9)
    np.testing.assert_allclose(rotation[0], unloaded_rotation, atol=1e-6)


def work_done(states: BeamStates) -> float:
    """∫ f · dr of a frictionless contact, by the trapezoid rule in steps.

    The force is normal to the surface along which the contact may move, so only the motion of the
    surface counts.
    """
    step = np.diff(states.point, axis=0)
    mean = 0.5 * (states.force[1:] + states.force[:-1])
    return float(np.sum(mean * step))


@pytest.mark.parametrize("slide", [0.0, -0.2e-3], ids=["fixed", "sliding"])
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("root_compliance", [0.0, 2e-4])
def test_work_put_in_is_the_energy_stored(
    side: float, root_compliance: float, slide: float
) -> None:
    beam = serpentine(nodes=8, root_compliance=root_compliance)
    works = []
    for steps in (200, 400):
        part = np.linspace(0.0, 1.0, steps + 1)
        states = contact_load(beam, STATION + slide * part, 215.0 * part, side)
        works.append(work_done(states))
    extrapolated = works[1] + (works[1] - works[0]) / 3
    assert extrapolated == pytest.approx(states.energy[-1], rel=1e-6)
    assert states.energy[0] == 0.0


def test_friction_takes_its_share_of_the_work() -> None:
    """A contact dragged along the pad: the force's work is the energy stored and what is rubbed."""
    part, friction = np.linspace(0.0, 1.0, 401), 0.2
    beam = serpentine(nodes=8)
    stations = STATION - 0.2e-3 * part
    states = contact_load(beam, stations, 215.0 * part, 1.0, friction)
    # The load goes towards the root; the surface stretches, so rubbing is taken at the surface.
    rubbed = states.energy[-1] - work_done(states)
    assert rubbed == pytest.approx(friction * 0.5 * 215.0 * 0.2e-3, rel=3e-4)


def test_all_loads_of_both_directions_in_one_call_are_those_of_single_calls() -> None:
    beam = serpentine(root_compliance=2e-4)
    force, side = np.tile(np.linspace(20.0, 215.0, 8), 2), np.repeat([1.0, -1.0], 8)
    station = STATION - 1e-6 * force
    together = contact_load(beam, station, force, side, 0.1)
    for i in range(16):
        alone = contact_load(beam, station[i], force[i], side[i], 0.1)
        np.testing.assert_allclose(together.point[i], alone.point[0], atol=1e-13)
        np.testing.assert_allclose(together.energy[i], alone.energy[0], rtol=1e-9)
        np.testing.assert_allclose(together.nominal_stress[i], alone.nominal_stress[0], rtol=1e-9)


def test_a_root_spring_turns_the_whole_ribbon_by_its_moment() -> None:
    """Seen from the contact nothing else changes: the force is known there."""
    root_compliance = 2e-3
    held, sprung = serpentine(), serpentine(root_compliance=root_compliance)
    first, second = (contact_load(beam, STATION, 215.0, 1.0) for beam in (held, sprung))
    turn = root_compliance * first.root_moment[0]
    cos, sin = np.cos(turn), np.sin(turn)
    np.testing.assert_allclose(
        second.positions, first.positions @ np.array([[cos, sin], [-sin, cos]]), atol=1e-15
    )
    stored = first.energy[0] + 0.5 * root_compliance * first.root_moment[0] ** 2
    assert second.energy[0] == pytest.approx(stored, rel=1e-12)
