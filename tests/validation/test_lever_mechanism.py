"""The lever mechanism of paper 000: its equations and figures, and what is exact beyond them.

Oracle rows B01 to B05. l = 50 mm is not in the paper, R = 50 mm stands under its Fig. 4. The spring
of 85 and 150 N/mm is its "0.085 and 0.15 N/mm" read in N/um: only then can the measured stiffness
approach 5000 N m/rad below q = 15 mm (Fig. 11).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from springcad.kinds.lever_arm.mechanism import (
    Lever,
    boundary,
    crank_angle,
    dead_angle,
    loads,
    pivot_load_ratio,
    required_pivot,
    response,
    stroke,
    transmission,
)
from springcad.kinds.lever_arm.spring_law import linear_law, spring_law

DEGREE = np.pi / 180.0
PAPER = Lever(length=50e-3, crank_radius=50e-3)
STEEL, POM = linear_law(85e3, 10e-3), linear_law(150e3, 10e-3)
OUTPUTS = ("yoke", "crank-behind", "crank-ahead")
HARDENING = spring_law(
    np.linspace(-10e-3, 10e-3, 21),
    85e3 * np.linspace(-10e-3, 10e-3, 21) * (1.0 + 2e3 * np.linspace(-10e-3, 10e-3, 21) ** 2),
)


def test_b01_stiffness_at_rest_over_the_pivot_position():
    """000, Eq. 5."""
    q = np.array([10e-3, 15e-3, 25e-3, 35e-3])
    stiffness = response(PAPER, STEEL, q, 0.0).stiffness
    assert stiffness == pytest.approx([3400.0, 1156.944, 212.5, 39.03061], rel=1e-6)


@pytest.mark.parametrize(
    ("deflection", "degrees", "ratio"),
    [
        (10e-3, 5.0, 1.436), (10e-3, 10.0, 1.868), (10e-3, 20.0, 2.710), (10e-3, 30.0, 3.5),
        (10e-3, 45.0, 4.536), (2e-3, 30.0, 13.5), (20e-3, 30.0, 2.25),
    ],
)  # fmt: skip
@pytest.mark.parametrize("output", OUTPUTS)
def test_b02_b03_pivot_load_ratio_of_figure_4(output, deflection, degrees, ratio):
    """000, Eqs 8 and 9; the ratio is the same for every arrangement, the pivot position is not."""
    lever = replace(PAPER, output=output)
    q = required_pivot(lever, degrees * DEGREE, deflection)
    assert transmission(lever, q, degrees * DEGREE).deflection == pytest.approx(deflection)
    assert pivot_load_ratio(lever, q, degrees * DEGREE) == pytest.approx(ratio, abs=5e-4)
    force = loads(lever, q, degrees * DEGREE, 850.0)
    assert force.pivot / force.output == pytest.approx(ratio, abs=5e-4)


def test_b04_b05_energy_and_workspace_boundary():
    """W is 4.25 and 7.5 J; 2 W cot φ where the paper's Eq. 4 gives 2 W/sin φ, whatever l and R."""
    for lever in (PAPER, Lever(40e-3, 30e-3)):
        q = required_pivot(lever, 10.0 * DEGREE, 10e-3)
        for law, energy in ((STEEL, 4.25), (POM, 7.5)):
            end = boundary(lever, law, q)
            assert end.energy == pytest.approx(energy, rel=1e-12)
            assert end.angle == pytest.approx(10.0 * DEGREE)
            assert end.torque == pytest.approx(2.0 * energy / np.tan(10.0 * DEGREE), rel=1e-12)
        torque = boundary(lever, STEEL, q).torque
        assert torque == pytest.approx(48.206, rel=1e-4)
        assert torque / np.cos(10.0 * DEGREE) == pytest.approx(48.950, rel=1e-4)


def test_figure_11_with_the_parasitic_stiffness_in_series():
    """ "Only below 15 mm the parasitic compliance becomes apparent ... approaches 5000 Nm/rad"."""
    q = np.array([5e-3, 10e-3, 15e-3, 20e-3])
    lever = replace(PAPER, series_stiffness=5000.0)
    assert response(lever, STEEL, q, 0.0).stiffness == pytest.approx(
        [3874.508, 2023.810, 939.5443, 436.395], rel=1e-6
    )
    assert response(lever, POM, q, 0.0).stiffness == pytest.approx(
        [4293.286, 2727.273, 1449.704, 721.925], rel=1e-6
    )
    plain = response(PAPER, POM, q, 0.0).stiffness
    assert plain == pytest.approx([30375.0, 6000.0, 2041.67, 843.75], rel=1e-5)


def test_a_yoke_with_a_linear_spring_is_the_paper_with_its_missing_factors():
    """τ = K₀ sin φ cos φ and dτ/dφ = K₀ cos 2φ; 000, Eq. 4 prints K₀ without φ."""
    phi, q = np.linspace(-0.7, 0.7, 29), 30e-3
    k0 = ((50e-3 - q) / q * 50e-3) ** 2 * 85e3
    made = response(PAPER, STEEL, q, phi)
    assert made.deflection == pytest.approx(
        (50e-3 - q) / q * np.sin(phi) * 50e-3, rel=1e-14, abs=1e-18
    )
    assert made.torque == pytest.approx(0.5 * k0 * np.sin(2.0 * phi), rel=1e-12, abs=1e-12)
    assert made.stiffness == pytest.approx(k0 * np.cos(2.0 * phi), rel=1e-12)


@pytest.mark.parametrize("output", OUTPUTS)
@pytest.mark.parametrize("law", [STEEL, HARDENING], ids=["linear", "hardening"])
@pytest.mark.parametrize("series", [np.inf, 300.0])
def test_work_at_the_output_is_the_energy_stored(output, law, series):
    """000, Eq. 6, which holds only with the cosine in τ; series stiffness and any law included."""
    lever = replace(PAPER, output=output, series_stiffness=series)
    for q in (8e-3, 20e-3, 30e-3):
        end = float(stroke(lever, q, law.deflection))

        def power(phi: float, q: float = q) -> float:
            at = response(lever, law, q, phi)
            return float(at.torque * (1.0 + at.crank_stiffness / series))

        work = quad(power, 0.0, end, epsabs=1e-12, epsrel=1e-11)[0]
        assert work == pytest.approx(float(response(lever, law, q, end).energy), rel=1e-10)


@pytest.mark.parametrize("output", OUTPUTS)
def test_stiffness_is_the_slope_of_the_torque_over_the_output_angle(output):
    lever = replace(PAPER, output=output, series_stiffness=400.0)
    q, step = np.array([8e-3, 20e-3, 30e-3]), 1e-5
    end = stroke(lever, q, 10e-3)
    for share in (-0.9, 0.05, 0.6):
        low, mid, high = (
            response(lever, HARDENING, q, share * end + d) for d in (-step, 0.0, step)
        )
        slope = (high.torque - low.torque) / (high.angle - low.angle)
        assert mid.stiffness == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("output", OUTPUTS)
def test_torque_by_virtual_work_is_that_of_the_forces_on_the_crank(output):
    """The pin presses normal to the tilted bar; a yoke's slide hands on the part across only."""
    lever, q = replace(PAPER, output=output), np.array([10e-3, 25e-3, 33e-3])
    phi = 0.8 * stroke(lever, q, 10e-3)
    at = response(lever, STEEL, q, phi)
    force = loads(lever, q, phi, STEEL.force(at.deflection))
    turn = {"yoke": 0.0, "crank-behind": 1.0, "crank-ahead": -1.0}[output] * force.tilt
    share = np.cos(force.tilt) * np.cos(phi) if output == "yoke" else np.cos(phi + turn)
    assert at.torque == pytest.approx(force.output * lever.crank_radius * share, rel=1e-12)
    # The three forces on the bar are in balance, and so are their moments about the pivot.
    assert np.tan(force.tilt) == pytest.approx(at.deflection / (lever.length - q), rel=1e-12)
    assert force.pivot == pytest.approx(force.output + force.spring / np.cos(force.tilt))


@pytest.mark.parametrize("output", ["crank-behind", "crank-ahead"])
def test_a_pinned_crank_differs_from_equation_1_by_the_third_order(output):
    phi, q = np.array([0.02, 0.04, 0.08]), 25e-3
    exact = transmission(replace(PAPER, output=output), q, phi).deflection
    error = np.abs(exact - transmission(PAPER, q, phi).deflection)
    orders = np.log2(error[1:] / error[:-1])
    assert orders == pytest.approx(3.0, abs=0.02)


@pytest.mark.parametrize(("output", "side"), [("crank-behind", 1.0), ("crank-ahead", -1.0)])
def test_the_pins_and_the_pivot_lie_on_one_line(output, side):
    """Drawn with compass and ruler: the crank's pin on its circle, the spring's on its guide."""
    q, s = np.array([5e-3, 25e-3, 33e-3]), 10e-3
    phi = crank_angle(replace(PAPER, output=output), q, s)
    axis = np.array([0.0, -side * 50e-3])
    pin = axis + 50e-3 * np.stack([-np.sin(phi), side * np.cos(phi)], axis=-1)
    pivot = np.stack([np.zeros(3), q], axis=-1)
    spring = np.array([s, 50e-3])
    first, second = pivot - pin, spring - pivot
    across = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    assert across == pytest.approx(0.0, abs=1e-17)
    # Eq. 7 of the paper says 11.537 deg for the second of the three.
    assert phi[1] / DEGREE == pytest.approx(11.537 + side * 0.48, abs=0.05)


@pytest.mark.parametrize("output", OUTPUTS)
def test_crank_angle_inverts_the_deflection_up_to_the_dead_angle(output):
    lever, q = replace(PAPER, output=output), np.linspace(2e-3, 48e-3, 24)
    end = 0.999 * dead_angle(lever, q)
    for share in (-1.0, -0.3, 0.01, 0.5, 1.0):
        s = transmission(lever, q, share * end).deflection
        assert crank_angle(lever, q, s) == pytest.approx(share * end, rel=1e-6)


def test_beyond_the_reach_of_the_crank_the_stroke_is_the_dead_angle():
    """000, Eq. 7 has an arcsin above 1 for q > l R/(R + s_max): the spring is not used fully."""
    assert np.isnan(crank_angle(PAPER, 45e-3, 10e-3))
    assert stroke(PAPER, 45e-3, 10e-3) == pytest.approx(0.5 * np.pi)
    assert boundary(PAPER, STEEL, np.array([45e-3])).energy < 4.25


def test_a_law_through_points_of_a_spring_is_one_curve():
    s = np.linspace(-10e-3, 10e-3, 101)
    step = 1e-7
    slope = (HARDENING.force(s + step) - HARDENING.force(s - step)) / (2.0 * step)
    assert HARDENING.stiffness(s) == pytest.approx(slope, rel=1e-6)
    for end in (-10e-3, 4e-3):
        work = quad(lambda x: float(HARDENING.force(np.array(x))), 0.0, end, epsrel=1e-12)[0]
        assert float(HARDENING.energy(np.array(end))) == pytest.approx(work, rel=1e-10)
    assert HARDENING.secant_stiffness == pytest.approx(85e3 * 1.2, rel=1e-12)
