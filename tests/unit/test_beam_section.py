"""The rectangular section: Winkler's inner-fibre factor and the nominal stress."""

from __future__ import annotations

from decimal import Decimal, getcontext

import pytest

from springcad.mechanics.section import (
    area,
    curved_beam_factor,
    nominal_bending_stress,
    second_moment_of_area,
)


def winkler_factor(z: float) -> float:
    """σ = M y/(A e (r_n − y)) at the inner fibre over 6M/(t h²), with 40 digits (h = 2, t = 1)."""
    getcontext().prec = 40
    ratio = Decimal(z)
    radius = 1 / ratio
    neutral = 2 / ((radius + 1) / (radius - 1)).ln()
    eccentricity = radius - neutral
    inner = neutral - (radius - 1)
    stress = inner / (2 * eccentricity * (radius - 1))
    return float(stress / Decimal("1.5"))


@pytest.mark.parametrize(
    ("z", "expected"),
    [(0.1, 1.07), (0.2, 1.15), (0.25, 1.20), (0.3, 1.25), (0.4, 1.37), (0.5, 1.52), (0.7, 2.04)],
)
def test_curved_beam_factor_agrees_with_the_table(z: float, expected: float) -> None:
    assert curved_beam_factor(z) == pytest.approx(expected, abs=0.0051)


@pytest.mark.parametrize("z", [1e-6, 1e-3, 0.01, 0.049999, 0.050001, 0.2, 0.6, 0.95])
def test_curved_beam_factor_is_winklers_formula(z: float) -> None:
    assert curved_beam_factor(z) == pytest.approx(winkler_factor(z), rel=1e-12)


def test_a_straight_beam_has_factor_one_and_slope_two_thirds() -> None:
    assert curved_beam_factor(0.0) == 1.0
    step = 1e-6
    slope = (curved_beam_factor(step) - 1.0) / step
    assert slope == pytest.approx(2.0 / 3.0, rel=1e-5)


def test_section_values_are_those_of_a_rectangle() -> None:
    thickness, half = 4.5e-3, 0.7e-3
    width = 2 * half
    assert area(thickness, half) == pytest.approx(thickness * width, rel=1e-15)
    inertia = thickness * width**3 / 12
    assert second_moment_of_area(thickness, half) == pytest.approx(inertia, rel=1e-14)
    assert nominal_bending_stress(thickness, half, -3.0) == pytest.approx(
        3.0 * half / inertia, rel=1e-14
    )
