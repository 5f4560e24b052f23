"""The beam against closed forms: cantilevers, the elastica, and bending into a circle.

Elastica: Mattiasson, Numerical results from large deflection beam and frame problems analysed by
means of elliptic integrals, Int. J. Numer. Methods Eng. 17 (1981) 145-153.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipk, ellipkinc

from springcad.mechanics.beam import (
    PreparedBeam,
    RibbonBeam,
    contact_load,
    follower_load,
    prepare,
)
from springcad.mechanics.dead_load import dead_load

E_MODULUS, POISSON, THICKNESS, LENGTH = 200e9, 0.3, 4.5e-3, 25e-3
SHEAR_MODULUS = E_MODULUS / (2 * (1 + POISSON))


def straight(half_thickness: float, panels: int = 8, nodes: int = 6) -> PreparedBeam:
    return prepare(
        RibbonBeam(
            np.linspace(0.0, LENGTH, panels + 1),
            np.zeros_like,
            lambda s: np.full_like(s, half_thickness),
            root_angle=0.0,
            thickness=THICKNESS,
            elastic_modulus=E_MODULUS,
            shear_modulus=SHEAR_MODULUS,
            nodes_per_panel=nodes,
        )
    )


def bending_stiffness(half_thickness: float) -> float:
    return E_MODULUS * 2 * THICKNESS * half_thickness**3 / 3


def test_small_load_on_a_uniform_cantilever_with_shear() -> None:
    lam, force = 0.7e-3, 1e-3
    states = dead_load(straight(lam), LENGTH, [[0.0, force]])
    shear = force * LENGTH / (5 / 6 * SHEAR_MODULUS * 2 * lam * THICKNESS)
    expected = force * LENGTH**3 / (3 * bending_stiffness(lam)) + shear
    assert states.end_position[0, 1] == pytest.approx(expected, rel=1e-9)


def test_small_load_on_the_cantilever_of_uniform_strength() -> None:
    """λ = λ_r √q (paper 004): δ = 2 F L³/(3 E I_r), twice the uniform beam; the tip is cut off
    at q = 1e-4, where the rest adds less than 1e-5 of it."""
    lam, force = 1.4e-3, 1e-6
    edges = LENGTH * (1.0 - np.geomspace(1.0, 1e-4, 19))
    edges[0] = 0.0
    beam = RibbonBeam(
        edges,
        np.zeros_like,
        lambda s: lam * np.sqrt(1.0 - s / LENGTH),
        root_angle=0.0,
        thickness=THICKNESS,
        elastic_modulus=E_MODULUS,
        shear_modulus=1e6 * E_MODULUS,
    )
    end = edges[-1]
    # The moment of a force at x = L, carried to the end of the centre line.
    states = follower_load(prepare(beam), end, 0.0, force, force * (LENGTH - end))
    energy = force**2 * LENGTH**3 / (3 * bending_stiffness(lam))
    assert states.energy[0] == pytest.approx(energy, rel=2e-6)


def test_small_load_on_a_stepped_cantilever() -> None:
    """Half thickness and so stiffness jump at a panel edge; Castigliano's integral in two parts."""
    thick, thin, force, step = 0.9e-3, 0.6e-3, 1e-3, 0.4 * LENGTH
    beam = RibbonBeam(
        np.array([0.0, step, LENGTH]),
        np.zeros_like,
        lambda s: np.where(s < step, thick, thin),
        root_angle=0.0,
        thickness=THICKNESS,
        elastic_modulus=E_MODULUS,
        shear_modulus=1e9 * E_MODULUS,
    )
    rest = LENGTH - step
    states = follower_load(prepare(beam), LENGTH, 0.0, force)
    energy = force**2 / 6 * (LENGTH**3 - rest**3) / bending_stiffness(thick)
    energy += force**2 / 6 * rest**3 / bending_stiffness(thin)
    assert states.energy[0] == pytest.approx(energy, rel=1e-9)


def elastica(load: float) -> tuple[float, float, float]:
    """(δv/L, δh/L, θ) of a cantilever under a transverse dead load P L²/EI, elliptic integrals.

    With k² = (1 + sin θ)/2 and sin φ₀ = 1/(k √2): √load = K(k) − F(φ₀, k).
    """

    def excess(theta: float) -> float:
        m = 0.5 * (1 + np.sin(theta))
        phi = np.arcsin(1 / np.sqrt(2 * m))
        return float(ellipk(m) - ellipkinc(phi, m) - np.sqrt(load))

    theta = brentq(excess, 1e-9, np.pi / 2 - 1e-9, xtol=1e-15)
    horizontal = np.sqrt(2 * np.sin(theta) / load)
    # Substitution ψ = θ(1 − u²) removes the root singularity at the free end.
    nodes, weights = np.polynomial.legendre.leggauss(60)
    u = 0.5 * (1 + nodes)
    angles = theta * (1 - u**2)
    slope = np.sqrt(2 * load * (np.sin(theta) - np.sin(angles)))
    vertical = np.sum(0.5 * weights * np.sin(angles) / slope * 2 * theta * u)
    return float(vertical), float(1 - horizontal), float(theta)


MATTIASSON = {
    1.0: (0.30172, 0.05643, 0.46135),
    2.0: (0.49346, 0.16064, 0.78175),
    10.0: (0.81061, 0.55500, 1.43029),
}


@pytest.mark.parametrize("load", MATTIASSON)
def test_elastica_table_beam_and_elliptic_integrals_agree(load: float) -> None:
    lam = 0.02e-3  # so slender that stretch and shear are below 1e-5
    force = load * bending_stiffness(lam) / LENGTH**2
    states = dead_load(straight(lam), LENGTH, [[0.0, force]])
    x, y = states.end_position[0]
    computed = (y / LENGTH, 1 - x / LENGTH, states.end_rotation[0])
    np.testing.assert_allclose(elastica(load), MATTIASSON[load], atol=6e-6)
    np.testing.assert_allclose(computed, MATTIASSON[load], atol=2e-5)
    np.testing.assert_allclose(computed, elastica(load), rtol=1e-4)


def test_an_end_moment_rolls_the_beam_into_a_full_circle() -> None:
    lam = 0.1e-3
    moment = 2 * np.pi * bending_stiffness(lam) / LENGTH
    states = follower_load(straight(lam), LENGTH, 0.0, 0.0, moment)
    assert np.hypot(*states.end_position[0]) < 1e-6 * LENGTH
    assert states.end_rotation[0] == pytest.approx(2 * np.pi, rel=1e-12)


def test_a_contact_on_the_other_side_gives_the_mirror_image() -> None:
    states = contact_load(straight(0.5e-3), 0.9 * LENGTH, 60.0, [1.0, -1.0], friction=0.2)
    mirror = np.array([1.0, -1.0])
    np.testing.assert_allclose(states.point[0], states.point[1] * mirror, atol=1e-15)
    np.testing.assert_allclose(states.positions[0], states.positions[1] * mirror, atol=1e-15)
    assert states.point[0, 1] < 0.0, "a contact on side +1 pushes the tip towards -y"
