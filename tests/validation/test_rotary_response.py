"""What a finished spring does, against integration, statics and published figures."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from rotary_cases import spring_of
from scipy.integrate import simpson, solve_ivp

from springcad.kinds.rotary_flexure.design import Spring
from springcad.kinds.rotary_flexure.full_load import demand_of, loads_of
from springcad.kinds.rotary_flexure.response import Stroke
from springcad.kinds.rotary_flexure.root import flexure_on
from springcad.kinds.rotary_flexure.search import find_shape
from springcad.mechanics.section import curved_beam_factor

SPRINGS = ("S1", "S2", "S3", "S4")
BACKLASH = "camshaft.backlash=0.05 mm"


@pytest.mark.parametrize("name", SPRINGS)
def test_the_camshaft_as_drawn_gives_the_stiffness_asked_for(name: str) -> None:
    """Both ways, from the forward analysis, which does not know the torque law.

    The arcs of the drawing cost up to 0.0082 %.
    """
    for stroke in spring_of(name).strokes:
        assert stroke.angle[-1] == pytest.approx(spring_of(name).law.inputs.deflection, rel=1e-12)
        assert stroke.torque[-1] / stroke.angle[-1] == pytest.approx(150.0, rel=1e-4)


@pytest.mark.parametrize("overrides", [(), (BACKLASH,)], ids=["tight", "backlash"])
@pytest.mark.parametrize("name", ["S1", "S2"])
def test_stored_energy_is_the_work_of_the_torque(name: str, overrides: tuple[str, ...]) -> None:
    for stroke in spring_of(name, *overrides).strokes:
        angle, torque = np.r_[0.0, stroke.angle], np.r_[0.0, stroke.torque]
        assert simpson(torque, x=angle) == pytest.approx(stroke.energy[-1], rel=1e-4)


def test_a_straight_spring_is_the_same_both_ways() -> None:
    forward, backward = spring_of("S1").strokes
    for field in ("torque", "force", "nominal_stress", "station", "gap"):
        np.testing.assert_allclose(getattr(forward, field), getattr(backward, field), rtol=1e-6)


@pytest.mark.parametrize("name", SPRINGS)
def test_the_force_on_a_tip_is_near_that_of_the_design_law(name: str) -> None:
    """k theta / (r n), 004: the lever changes by a few per cent as the contact moves."""
    spring = spring_of(name)
    for stroke in spring.strokes:
        assert stroke.force[-1] == pytest.approx(spring.law.force, rel=0.03)


def test_the_law_s_straight_flexure_is_stressed_as_a_finite_element_model_says() -> None:
    """S1 by the design law, clamped: 910 MPa in bending, 920 MPa with the axial force."""
    spring = spring_of("S1")
    spec, case, law = spring.spec, spring.case, spring.law
    ribbon = find_shape(spec, case, law, lambda _: None).ribbon
    demand = demand_of(spring.target, 31e-3, 6e-3, 24)
    for state in loads_of(ribbon, flexure_on(spec, case, ribbon, 0.0), demand):
        bending = 1.5 * np.abs(state.moment[-1]) / (4.5e-3 * state.half_thickness[-1] ** 2)
        assert bending.max() == pytest.approx(910e6, rel=5e-3)
        assert state.nominal_stress.max() == pytest.approx(920e6, rel=5e-3)


@pytest.mark.parametrize("name", SPRINGS)
def test_the_whole_flexure_bears_the_design_stress_at_full_load(name: str) -> None:
    """The larger stress of both directions, from the root to the pad, within 0.5 %.

    S1 is straight: its length and its stiffness leave it at 0.984 of the design stress, evenly.
    """
    spring = spring_of(name)
    start = float(spring.found.ribbon.edges[-2])
    stations = np.linspace(0.0, start, 400)
    stress = [
        np.interp(stations, s.full.stations[0], s.full.nominal_stress[0]) for s in spring.strokes
    ]
    level = 0.984 if name == "S1" else 1.0
    np.testing.assert_allclose(np.max(stress, axis=0), level * 912e6, rtol=5e-3)


@pytest.mark.parametrize("name", SPRINGS)
def test_the_stiffness_at_rest_is_the_wanted_one_before_any_camshaft(name: str) -> None:
    """On the beam with its root spring, contact at the contact radius."""
    assert spring_of(name).sized.stiffness_at_rest == pytest.approx(150.0, rel=1e-3)


def test_a_corrected_straight_flexure_stores_what_a_fully_stressed_one_can() -> None:
    """sigma^2 t/(6 E) times its area before the pad (004, Eq. 9), sigma that of bending."""
    spring = spring_of("S1")
    full, ribbon = spring.strokes[0].full, spring.found.ribbon
    t, modulus = 4.5e-3, 200e9
    nodes, weights = ribbon.grid.nodes, ribbon.grid.weights
    before = nodes < ribbon.edges[-2]
    moment = np.interp(nodes, full.stations[0], full.moment[0])
    bending = 1.5 * np.abs(moment) / (t * ribbon.half_thickness**2)
    sigma = float(np.median(bending[before]))
    inertia = 2.0 / 3.0 * t * ribbon.half_thickness**3
    stored = float(weights[before] @ (moment**2 / (2.0 * modulus * inertia))[before])
    area = float(weights[before] @ (2.0 * ribbon.half_thickness)[before])
    assert stored == pytest.approx(sigma**2 * t / (6.0 * modulus) * area, rel=5e-3)


def test_the_search_makes_room_for_the_deformed_flexures() -> None:
    """Both directions leave the same gap, wider than what they would leave of the gap at rest."""
    spring = spring_of("S3")
    gaps = [float(stroke.gap.min()) for stroke in spring.strokes]
    assert gaps[0] == pytest.approx(gaps[1], rel=0.05)
    assert min(gaps) > 0.3e-3


@pytest.mark.parametrize("name", ["S2", "S4"])
def test_inner_fibres_carry_the_curved_beam_factor_of_their_own_bend(name: str) -> None:
    """The bending part of the stress is raised by K(lambda kappa) where it is largest."""
    spring = spring_of(name)
    for stroke in spring.strokes:
        full, t = stroke.full, spring.law.inputs.thickness
        at = int(np.argmax(full.local_stress[0]))
        here = spring.found.ribbon.at(full.stations[0, [at]])
        lam = float(here.half_thickness[0])
        factor = float(curved_beam_factor(abs(float(here.curvature[0])) * lam))
        bending = 1.5 * abs(full.moment[0, at]) / (t * lam**2)
        axial = abs(full.axial_force[0, at]) / (2.0 * lam * t)
        assert factor > 1.15
        assert full.local_stress[0, at] == pytest.approx(factor * bending + axial, rel=2e-3)


def tip_by_adaptive_integration(spring: Spring, stroke: Stroke) -> np.ndarray:
    """Contact point of flexure 0 at full load, flexure frame, by scipy's DOP853.

    The ribbon is evaluated from its own polynomials; the section that is loaded is held and the
    root found, then all is moved so that the root is where it belongs.
    """
    ribbon, inputs = spring.found.ribbon, spring.law.inputs
    modulus = inputs.elastic_modulus
    shear_modulus = modulus / (2.0 * (1.0 + spring.spec.material.values.poisson_ratio.value))
    side, force = float(stroke.direction), float(stroke.force[-1])
    station = float(stroke.station[-1])

    def section(s: float) -> tuple[float, float]:
        at = ribbon.at(np.array([s]))
        return float(at.half_thickness[0]), float(at.curvature[0])

    lam_end, _ = section(station)
    area_end = 5.0 / 6.0 * shear_modulus * 2.0 * lam_end * inputs.thickness
    tilt = -side * 0.5 * force / area_end  # normal to the mean of the surface on either side
    axial, transverse = side * force * np.sin(tilt), -side * force * np.cos(tilt)

    def slope(s: float, state: np.ndarray) -> list[float]:
        x, y, psi = state
        cos, sin = math.cos(psi), math.sin(psi)
        lam, curvature = section(s)
        tension, shear = axial * cos + transverse * sin, transverse * cos - axial * sin
        moment = (0.0 - x) * transverse - (side * lam_end - y) * axial
        stretch = 1.0 + tension / (modulus * 2.0 * lam * inputs.thickness)
        slide = shear / (5.0 / 6.0 * shear_modulus * 2.0 * lam * inputs.thickness)
        stiffness = modulus * 2.0 / 3.0 * inputs.thickness * lam**3
        return [
            stretch * cos - slide * sin,
            stretch * sin + slide * cos,
            curvature + moment / stiffness,
        ]

    state = np.zeros(3)
    stops = [station, *(e for e in ribbon.edges[::-1] if e < station)]
    for start, end in pairwise(stops):
        # Just inside each panel: the polynomials of the next one begin at its edge.
        inside = (start - 1e-12 * ribbon.length, end)
        state = solve_ivp(slope, inside, state, "DOP853", rtol=1e-9, atol=1e-12).y[:, -1]
    root_moment = (0.0 - state[0]) * transverse - (side * lam_end - state[1]) * axial
    turn = ribbon.root_angle + spring.sized.root.compliance * root_moment - state[2]
    x, y = np.array([0.0, side * lam_end]) - state[:2]
    cos, sin = math.cos(turn), math.sin(turn)
    return np.array([cos * x - sin * y, sin * x + cos * y])


@pytest.mark.parametrize("index", [0, 1])
def test_the_deformed_tip_agrees_with_an_adaptive_integrator(index: int) -> None:
    """S2 at its design deflection: within a hundredth of a per cent of the way the tip moves."""
    spring = spring_of("S2")
    stroke = spring.strokes[index]
    moved = spring.law.inputs.contact_radius * float(stroke.angle[-1])
    error = stroke.full.point[0] - tip_by_adaptive_integration(spring, stroke)
    assert np.hypot(*error) < 1e-4 * moved


@pytest.mark.parametrize("name", ["S1", "S2", "S4"])
def test_the_torque_is_the_moment_of_the_contact_forces_about_the_axis(name: str) -> None:
    """Statics alone: n (point x force) at full load, in the ring's frame."""
    spring = spring_of(name)
    root, count = spring.law.inputs.root_radius, spring.law.inputs.count
    for stroke in spring.strokes:
        x, y = np.array([root, 0.0]) - stroke.full.point[0]
        fx, fy = -stroke.full.force[0]
        assert stroke.torque[-1] == pytest.approx(
            stroke.direction * count * (x * fy - y * fx), rel=1e-6
        )


@pytest.mark.parametrize("name", ["S2", "S4"])
def test_virtual_work_at_the_cam(name: str) -> None:
    """Without friction a small turn does the work that the flexures store: T = dU/d theta."""
    for stroke in spring_of(name).strokes:
        slope = np.gradient(stroke.energy, stroke.angle, edge_order=2)
        exact = slice(10, -1)  # nearer to rest an arc stands for the flank
        np.testing.assert_allclose(slope[exact], stroke.torque[exact], rtol=3e-4)


def test_backlash_is_free_play_and_does_not_soften_the_spring() -> None:
    """0.05 mm at 6 mm are 0.24 deg each way; beyond it S2 is the same spring.

    Turned flanks get arcs of their own within 18 nm: the point of contact moves, stress by 3e-6.
    """
    tight, loose = spring_of("S2"), spring_of("S2", BACKLASH)
    play = loose.camshaft.slot.free_play
    assert play == pytest.approx(0.025 / 6.0, rel=1e-6)
    assert tight.camshaft.slot.free_play == 0.0
    for one, other in zip(tight.strokes, loose.strokes, strict=True):
        np.testing.assert_allclose(other.angle, one.angle, rtol=1e-9)
        np.testing.assert_allclose(other.torque, one.torque, rtol=1e-6)
        np.testing.assert_allclose(other.nominal_stress, one.nominal_stress, rtol=1e-5)
