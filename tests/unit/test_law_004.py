"""Equations 1 to 11 of paper 004, each against the page typed anew or against quadrature."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from springcad.kinds.rotary_flexure import law, room

EXACT = 1e-12
QUADRATURE = 1e-9

S4 = law.LawInputs(
    stiffness=150.0,
    deflection=math.radians(13.4),
    root_radius=26e-3,
    contact_radius=5.1e-3,
    count=31,
    thickness=4.5e-3,
    elastic_modulus=200e9,
    design_stress=912e6,
    tip_half_thickness=0.2e-3,
)
F, L, t, sd, E = 221.9, 20.9e-3, 4.5e-3, 912e6, 200e9
k, theta, r, n = 150.0, 0.2339, 5.1e-3, 31


def taper(x: float) -> float:
    """004, Eq. 2 as printed."""
    return math.sqrt(3 * F * (L - x) / (2 * t * sd))


def integral(function, upper: float = L) -> float:
    """From the root to the contact, with u = sqrt(L - x) so that the tip is no singularity."""
    value, _ = quad(
        lambda u: function(L - u * u) * 2 * u, 0, math.sqrt(upper), epsabs=0, epsrel=1e-12
    )
    return value


def test_eq_1_is_the_bending_stress_of_a_rectangle():
    half, x = 1.1e-3, 7e-3
    moment, second_moment = F * (L - x), t * (2 * half) ** 3 / 12
    assert law.bending_stress(F, L - x, half, t) == pytest.approx(
        moment * half / second_moment, rel=EXACT
    )


@pytest.mark.parametrize("share", [0.0, 0.3, 0.9, 0.999])
def test_eq_2_puts_every_section_at_the_design_stress(share):
    x = share * L
    half = law.tapered_half_thickness(F, L - x, t, sd)
    assert half == pytest.approx(taper(x), rel=EXACT)
    assert law.bending_stress(F, L - x, half, t) == pytest.approx(sd, rel=EXACT)


def test_the_taper_stops_at_the_tip_thickness_where_the_pad_begins():
    tip, root = 0.2e-3, taper(0)
    pad = law.tip_pad_length(L, root, tip)
    lever = np.array([0.0, 0.5 * pad, pad, 1.1 * pad])
    half = law.tapered_half_thickness(F, lever, t, sd, tip)
    np.testing.assert_allclose(half[:3], tip, rtol=EXACT)
    assert half[3] == pytest.approx(taper(L - 1.1 * pad), rel=EXACT)


def test_eq_3_to_7_and_9_are_one_energy():
    by_eq_3 = integral(lambda x: (F * (L - x)) ** 2 / (2 * E * (2 * t * taper(x) ** 3 / 3)))
    by_eq_5 = sd**2 * t / (3 * E) * integral(taper)
    ours_by_length = integral(lambda x: law.strain_energy_per_length(F, L - x, taper(x), t, E))
    by_eq_6 = math.sqrt(2 * t * F * L**3 * sd**3 / (27 * E**2))
    assert by_eq_3 == pytest.approx(by_eq_5, rel=QUADRATURE)
    assert ours_by_length == pytest.approx(by_eq_3, rel=QUADRATURE)
    assert by_eq_6 == pytest.approx(by_eq_3, rel=QUADRATURE)
    assert law.straight_energy(F, L, t, sd, E) == pytest.approx(by_eq_6, rel=EXACT)
    area = law.straight_area(L, taper(0))
    assert area == pytest.approx(2 * integral(taper), rel=QUADRATURE)
    assert law.energy_of_area(area, t, sd, E) == pytest.approx(by_eq_6, rel=EXACT)


def test_eq_4_holds_with_the_cube_of_the_taper():
    """Only 1/lambda^3 under the integral leads from Eq. 3 to Eq. 5."""
    cubed = integral(lambda x: 3 * F**2 * (L - x) ** 2 / (4 * E * t * taper(x) ** 3))
    assert cubed == pytest.approx(law.straight_energy(F, L, t, sd, E), rel=QUADRATURE)


def test_eq_7_is_eq_6_at_the_force_of_k_theta():
    by_eq_7 = math.sqrt(2 * t * k * theta * L**3 * sd**3 / (27 * E**2 * r * n))
    assert law.straight_energy_at(k, theta, r, n, L, t, sd, E) == pytest.approx(by_eq_7, rel=EXACT)
    assert law.tip_force(k, theta, r, n) * r * n == pytest.approx(k * theta, rel=EXACT)


def test_eq_10_stores_the_energy_of_one_flexure():
    area = law.required_area(k, theta, n, t, sd, E)
    assert area == pytest.approx(3 * k * theta**2 * E / (n * sd**2 * t), rel=EXACT)
    assert law.energy_of_area(area, t, sd, E) == pytest.approx(k * theta**2 / (2 * n), rel=EXACT)


def test_eq_11_is_where_eq_7_meets_the_wanted_energy():
    straight = law.straight_deflection(k, L, r, n, t, sd, E)
    printed = (8 * t * n * L**3 * sd**3 / (27 * E**2 * k * r)) ** (1 / 3)
    assert straight == pytest.approx(printed, rel=EXACT)
    energy = law.straight_energy_at(k, straight, r, n, L, t, sd, E)
    assert energy == pytest.approx(k * straight**2 / (2 * n), rel=EXACT)


def test_deflection_goes_as_the_serpentine_factor_to_two_thirds():
    solved = law.design_law(S4)
    assert solved.straight_deflection * solved.serpentine_factor ** (2 / 3) == pytest.approx(
        S4.deflection, rel=EXACT
    )


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.154, 0.5, 0.9, 1.0, 1.3, 2.0])
def test_the_effective_factor_of_a_straight_flexure_with_a_tip(ratio):
    """1 - rho^3/2 (1/(2 rho^3) for a plain bar) against the integral of 2 lambda0^4/lambda^3."""
    tip = ratio * taper(0)
    kink = min(ratio**2, 1.0) * L
    parts = [
        quad(
            lambda u: law.effective_width(taper(L - u * u), max(taper(L - u * u), tip)) * 2 * u,
            math.sqrt(low),
            math.sqrt(high),
            epsabs=0,
            epsrel=1e-12,
        )[0]
        for low, high in ((1e-12 * L, kink), (kink, L))
        if high > low
    ]
    effective = sum(parts) / law.straight_area(L, taper(0))
    assert law.straight_serpentine_factor(ratio) == pytest.approx(effective, rel=QUADRATURE)


@pytest.mark.parametrize(("factor", "ratio"), [(0.3, 0.15), (0.9, 0.15), (0.998, 0.15), (0.7, 0.6)])
def test_a_straight_flexure_of_the_thickness_factor_has_the_wanted_stiffness(factor, ratio):
    """Compliance by quadrature of M^2/(E I) against that of the required area."""
    thick, tip = law.straight_thickness_factor(factor, ratio), ratio * taper(0)

    def energy(x: float) -> float:
        return law.strain_energy_per_length(F, L - x, max(thick * taper(x), tip), t, E)

    kink = (ratio / thick) ** 2 * L
    inner, _ = quad(lambda z: energy(L - z), 0, kink, epsabs=0, epsrel=1e-12)
    outer, _ = quad(
        lambda u: energy(L - u * u) * 2 * u, math.sqrt(kink), math.sqrt(L), epsabs=0, epsrel=1e-12
    )
    wanted = factor * law.straight_energy(F, L, t, sd, E)
    assert inner + outer == pytest.approx(wanted, rel=QUADRATURE)
    stress = law.bending_stress(F, L, thick * taper(0), t)
    assert stress == pytest.approx(sd / thick**2, rel=EXACT)


def test_a_tip_too_thick_for_the_stiffness_has_no_straight_flexure():
    assert math.isnan(law.straight_thickness_factor(1.2, 0.9))


def test_the_true_area_exceeds_the_effective_one_by_the_pad():
    """Straight: taper 1 - rho^3, pad 3 rho^3 / 2 of A_nom, so effective + rho^3 A_nom."""
    straight = law.design_law(S4).straight_deflection
    tip_ratio = 0.154
    deflection = straight * law.straight_serpentine_factor(tip_ratio) ** (2 / 3)
    force = law.tip_force(k, deflection, 5.1e-3, 31)
    root = law.tapered_half_thickness(force, 20.9e-3, t, sd)
    solved = law.design_law(
        replace(S4, deflection=float(deflection), tip_half_thickness=float(tip_ratio * root))
    )
    pad = solved.tip_pad_length
    taper_area = 4 / 3 * solved.root_half_thickness * solved.span * (1 - tip_ratio**3)
    assert solved.flexure_area == pytest.approx(taper_area + 2 * tip_ratio * root * pad, rel=EXACT)


def test_the_cross_compliance_weights_the_tip():
    """On the taper M/(E I) goes as (1 - x/L)^(-1/2): mean(y) = 0 is not enough."""
    q = np.array([1.0, 0.5, 0.1])
    added = law.bending_curvature(F, q * L, taper(0) * np.sqrt(q), t, E)
    np.testing.assert_allclose(added / added[0], q**-0.5, rtol=EXACT)


def test_density_factor_is_one_for_a_full_disk_at_the_bound():
    bound = room.deflection_bound(k, 26e-3, r, t, sd, E)
    area = n * law.required_area(k, bound, n, t, sd, E)
    assert area == pytest.approx(room.annulus_area(26e-3, r), rel=EXACT)
    assert math.degrees(bound) == pytest.approx(16.7, abs=0.05)
    share = room.deflection_bound(k, 26e-3, r, t, sd, E, density_factor=0.64)
    assert share == pytest.approx(0.8 * bound, rel=EXACT)


def test_packing_bound_leaves_the_gaps_as_strips_from_tip_to_root():
    annulus = room.annulus_area(26e-3, 5.1e-3)
    strips = 31 * 0.3e-3 * (26e-3 - 5.1e-3)
    assert room.packing_bound(26e-3, 5.1e-3, 31, 0.3e-3) == pytest.approx(
        1 - strips / annulus, rel=EXACT
    )


@pytest.mark.parametrize(
    ("deflection", "root_radius", "contact_radius", "count", "gap"),
    [(12.56, 31, 6.0, 24, 1.25), (14.5, 31, 6.0, 24, 1.20), (12.09, 26, 6.0, 24, 1.26),
     (13.4, 26, 5.1, 31, 0.63)],
    ids=["S1", "S2", "S3", "S4"],
)  # fmt: skip
def test_the_pinch_between_straight_neighbours(deflection, root_radius, contact_radius, count, gap):
    """Closed form against the smallest distance between the two edges, sampled densely."""
    solved = law.design_law(
        replace(
            S4,
            deflection=math.radians(deflection),
            root_radius=root_radius * 1e-3,
            contact_radius=contact_radius * 1e-3,
            count=count,
        )
    )
    q = np.linspace((0.2e-3 / solved.root_half_thickness) ** 2, 1.0, 4001)
    radius = contact_radius * 1e-3 + solved.span * q
    half = solved.root_half_thickness * np.sqrt(q)
    edge = np.stack([radius, half], axis=1)
    pitch = 2 * math.pi / count
    turn = np.array([[math.cos(pitch), math.sin(pitch)], [-math.sin(pitch), math.cos(pitch)]])
    other = np.stack([radius, -half], axis=1) @ turn
    sampled = min(np.hypot(*(other - point).T).min() for point in edge[:1200:4])
    assert solved.pinch_gap == pytest.approx(sampled, abs=1e-8)
    assert solved.pinch_gap * 1e3 == pytest.approx(gap, abs=0.006)


def test_hub_shear_is_that_of_a_round_bar_and_tube():
    torque, core = 35.08, 4.9e-3
    assert room.hub_shear_stress(torque, core) == pytest.approx(
        16 * torque / (math.pi * (2 * core) ** 3), rel=EXACT
    )
    assert room.hub_shear_stress(torque, core, 0.5 * core) == pytest.approx(
        room.hub_shear_stress(torque, core) / (1 - 0.5**4), rel=EXACT
    )


def test_ring_mass_adds_flexures_and_rim():
    rim = math.pi * (28.5e-3**2 - 26e-3**2)
    assert law.ring_mass(42e-6, 31, 26e-3, 28.5e-3, t, 7700.0) == pytest.approx(
        7700 * t * (31 * 42e-6 + rim), rel=EXACT
    )


def test_a_contact_outside_the_root_is_refused():
    with pytest.raises(ValueError, match="contact radius"):
        law.design_law(replace(S4, contact_radius=26e-3))
