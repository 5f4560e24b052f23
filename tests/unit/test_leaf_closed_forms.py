"""Leaf springs in closed form: paper 000, Eqs 10 to 19, and the same for triangle and parabola.

Each is held against the formula that is printed, or against a quadrature of M^2/(EI) that shares
nothing with it.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

from springcad.mechanics import leaf
from springcad.mechanics.leaf import SHAPES, LeafShape

STEEL = {"modulus": 210e9, "length": 50e-3, "stress": 950e6, "deflection": 10e-3}
POM = {"modulus": 2.6e9, "length": 50e-3, "stress": 90e6, "deflection": 10e-3}
WIDTH = 15e-3
shapes = pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)


@pytest.mark.parametrize(
    ("name", "energy", "stiffness", "utilisation", "thickness"),
    [
        ("constant", 1 / 27, 2 / 27, 1 / 9, 2 / 3),
        ("triangular", 1 / 12, 1 / 6, 1 / 3, 1.0),
        ("parabolic", 4 / 27, 8 / 27, 1 / 3, 4 / 3),
    ],
)
def test_factors_at_given_width_length_stress_and_deflection(
    name: str, energy: float, stiffness: float, utilisation: float, thickness: float
) -> None:
    shape, ones = SHAPES[name], (1.0, 1.0, 1.0, 1.0, 1.0)
    assert leaf.greatest_energy(shape, *ones) == pytest.approx(energy, rel=1e-15)
    assert leaf.greatest_stiffness(shape, *ones) == pytest.approx(stiffness, rel=1e-15)
    assert leaf.thickness_for(shape, 1.0, 1.0, 1.0, 1.0) == pytest.approx(thickness, rel=1e-15)
    assert shape.volume_utilisation == pytest.approx(utilisation, rel=1e-15)


def test_the_steel_leaf_of_constant_section_has_its_known_numbers() -> None:
    shape = SHAPES["constant"]
    thickness = leaf.thickness_for(shape, **STEEL)
    assert thickness == pytest.approx(0.753968e-3, abs=5e-10)
    assert leaf.greatest_stiffness(shape, width=WIDTH, **STEEL) == pytest.approx(
        2.700224e3, abs=5e-4
    )
    assert leaf.greatest_energy(shape, width=WIDTH, **STEEL) == pytest.approx(135.0112e-3, abs=5e-8)


@pytest.mark.parametrize(
    ("material", "constant", "triangular", "parabolic"),
    [(STEEL, 2.700, 6.076, 10.80), (POM, 14.98, 33.70, 59.91)],
    ids=["steel", "POM"],
)
def test_stiffness_of_the_three_shapes(
    material: dict[str, float], constant: float, triangular: float, parabolic: float
) -> None:
    for name, expected in zip(SHAPES, (constant, triangular, parabolic), strict=True):
        computed = leaf.greatest_stiffness(SHAPES[name], width=WIDTH, **material) / 1e3
        assert float(f"{computed:.4g}") == expected


def test_constant_section_is_what_paper_000_prints() -> None:
    E, b, L, h, F = 206e9, 12e-3, 60e-3, 0.9e-3, 7.0
    shape, inertia = SHAPES["constant"], b * h**3 / 12
    s = F * L**3 / (3 * E * inertia)  # Eq. 10
    stress = 6 * F * L / (b * h**2)  # Eq. 12
    assert leaf.stiffness(shape, E, b, L, h) == pytest.approx(3 * E * inertia / L**3)  # Eq. 11
    assert leaf.clamp_stress(F, b, L, h) == pytest.approx(stress)
    assert leaf.deflection_at_stress(shape, E, L, h, stress) == pytest.approx(s)  # Eq. 14
    assert leaf.stress_at_deflection(shape, E, L, h, s) == pytest.approx(stress)
    assert leaf.thickness_for(shape, E, L, stress, s) == pytest.approx(h)  # Eq. 17
    by_volume = stress**2 / (2 * E) * leaf.volume(shape, b, L, h) / 9  # Eq. 15
    assert by_volume == pytest.approx(F * s / 2)
    assert leaf.greatest_energy(shape, E, b, L, stress, s) == pytest.approx(by_volume)  # Eq. 18
    assert leaf.greatest_stiffness(shape, E, b, L, stress, s) == pytest.approx(F / s)  # Eq. 19


def integral(shape: LeafShape, power: float, x_power: float) -> float:
    """Of x^x_power b(x) h(x)^power over a leaf of unit size; x = u^2 tames the end."""

    def integrand(u: float) -> float:
        x = u * u
        b, h = leaf.width_at(shape, x, 1.0, 1.0), leaf.thickness_at(shape, x, 1.0, 1.0)
        return float(x**x_power * b ** np.sign(power) * h**power * 2 * u)

    return quad(integrand, 0.0, 1.0, epsabs=1e-13, epsrel=1e-13)[0]


@shapes
def test_deflection_volume_and_energy_by_quadrature(shape: LeafShape) -> None:
    E, b, L, h, F = 110e9, 20e-3, 80e-3, 1.5e-3, 11.0
    # Castigliano: s = (d/dF) of the integral of (F x)^2/(2 E I), I = b(x) h(x)^3/12
    s = 12 * F * L**3 / (E * b * h**3) * integral(shape, -3.0, 2.0)
    assert F / leaf.stiffness(shape, E, b, L, h) == pytest.approx(s, rel=1e-9)
    volume = b * L * h * integral(shape, 1.0, 0.0)
    assert leaf.volume(shape, b, L, h) == pytest.approx(volume, rel=1e-9)
    assert leaf.mass(shape, 7850.0, b, L, h) == pytest.approx(7850.0 * volume, rel=1e-9)
    stress = leaf.clamp_stress(F, b, L, h)
    used = (F * s / 2) / (volume * stress**2 / (2 * E))
    assert shape.volume_utilisation == pytest.approx(used, rel=1e-9)


@shapes
def test_closed_forms_agree_with_each_other(shape: LeafShape) -> None:
    E, L, stress, s = STEEL["modulus"], STEEL["length"], STEEL["stress"], STEEL["deflection"]
    h = leaf.thickness_for(shape, **STEEL)
    k = leaf.stiffness(shape, E, WIDTH, L, h)
    assert leaf.greatest_stiffness(shape, width=WIDTH, **STEEL) == pytest.approx(k)
    assert leaf.clamp_stress(k * s, WIDTH, L, h) == pytest.approx(stress)
    assert leaf.stress_at_deflection(shape, E, L, h, s) == pytest.approx(stress)
    assert leaf.deflection_at_stress(shape, E, L, h, stress) == pytest.approx(s)
    stored = shape.volume_utilisation * stress**2 / (2 * E) * leaf.volume(shape, WIDTH, L, h)
    assert leaf.greatest_energy(shape, width=WIDTH, **STEEL) == pytest.approx(stored)


def test_stress_rises_to_the_clamp_or_is_the_same_everywhere() -> None:
    x = np.linspace(1e-3, 50e-3, 9)

    def along(name: str) -> NDArray[np.float64]:
        return leaf.edge_stress(SHAPES[name], 10.0, WIDTH, 50e-3, 1e-3, x)

    clamp = leaf.clamp_stress(10.0, WIDTH, 50e-3, 1e-3)
    assert along("constant") == pytest.approx(clamp * x / 50e-3)
    assert along("triangular") == pytest.approx(clamp)
    assert along("parabolic") == pytest.approx(clamp)


def test_no_power_law_within_width_and_stress_is_stiffer_than_the_parabola() -> None:
    """b(x) <= b and stress <= sigma everywhere need p >= 0 and p + 2q <= 1."""
    best = leaf.greatest_stiffness(SHAPES["parabolic"], width=WIDTH, **STEEL)
    for p in (0.0, 0.25, 0.5, 1.0):
        for q in (-0.2, 0.0, 0.25, 0.5):
            if p + 2 * q <= 1.0 and (p, q) != (0.0, 0.5):
                assert leaf.greatest_stiffness(LeafShape(p, q), width=WIDTH, **STEEL) < best


def test_arguments_may_be_arrays() -> None:
    lengths, widths = np.array([40e-3, 50e-3, 60e-3]), np.array([[10e-3], [15e-3]])
    k = leaf.stiffness(SHAPES["parabolic"], 210e9, widths, lengths, 1e-3)
    assert k.shape == (2, 3)
    assert k[1, 2] == leaf.stiffness(SHAPES["parabolic"], 210e9, 15e-3, 60e-3, 1e-3)


@pytest.mark.parametrize(
    ("name", "stiffer"), [("constant", 1.0104), ("triangular", 1.0135), ("parabolic", 1.0183)]
)
def test_the_elastica_is_stiffer_by_what_the_module_says(name: str, stiffer: float) -> None:
    """Shooting from the free end: theta'' of the leaf whose load keeps its direction."""
    from scipy.integrate import solve_ivp
    from scipy.optimize import brentq

    shape = SHAPES[name]
    taper = shape.width_exponent + 3 * shape.thickness_exponent

    def end(load: float, tip_angle: float) -> tuple[float, float]:
        """Angle at the clamp, and deflection, of a leaf of unit length; M = load * (x - x_tip)."""

        def slopes(u: float, state: NDArray[np.float64]) -> list[float]:
            angle, reach, _ = state  # arc length from the free end is u^2
            curvature = load * reach / u ** (2 * taper) if u > 0 else 0.0
            turn = 2 * u
            return [-curvature * turn, math.cos(angle) * turn, math.sin(angle) * turn]

        final = solve_ivp(slopes, (0, 1), [tip_angle, 0, 0], rtol=1e-9, atol=1e-11).y[:, -1]
        return float(final[0]), float(final[2])

    def deflection(load: float) -> float:
        angle = brentq(lambda a: end(load, a)[0], 0.0, 0.6, xtol=1e-10)
        return end(load, angle)[1]

    linear = 0.1 / shape.compliance_factor
    load = brentq(lambda f: deflection(f) - 0.1, linear, 1.05 * linear, xtol=1e-6)
    assert load / linear == pytest.approx(stiffer, abs=1e-4)
