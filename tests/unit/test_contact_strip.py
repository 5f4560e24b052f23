"""Strips of contact on edges whose curvature changes: Hertz, closed forms, finite elements."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from springcad.mechanics.contact import half_width, peak_pressure
from springcad.mechanics.contact_strip import Strips, contact_strips
from springcad.mechanics.fem.assembly import Sheet
from springcad.mechanics.fem.pad import pad_pressure
from springcad.mechanics.fem.rigid_profile import rigid_profile

WIDTH, MODULUS = 3.4e-3, 112e9
FORCE = np.array([5.0, 60.0, 350.0])
KAPPA = np.full(3, 3.0)
Slope = Callable[[np.ndarray], np.ndarray]


def strips(slope: Slope, bend: Slope) -> Strips:
    return contact_strips(lambda x: (slope(x), bend(x)), FORCE, WIDTH, KAPPA, MODULUS)


def test_one_curvature_is_hertz() -> None:
    found = strips(lambda x: 3.0 * x, lambda x: np.full_like(x, 3.0))
    of_hertz = (FORCE, WIDTH, KAPPA, MODULUS)
    np.testing.assert_allclose(found.middle, 0.0, atol=1e-15)
    np.testing.assert_allclose(found.half_width, half_width(*of_hertz), rtol=1e-12)
    # the top of the ellipse lies between two of the 63 places that are looked at, or on one
    np.testing.assert_allclose(found.peak_pressure, peak_pressure(*of_hertz), rtol=4e-4)


def test_a_gap_of_the_fourth_power_presses_hardest_beside_the_middle() -> None:
    """Gap A x⁴: load 3 π E* A b⁴/4; p = E* A b³ (3 sin φ + sin 3φ)/2.

    Most at φ = 45°, √2 E* A b³, and √2 times less in the middle."""
    rate = 2e6
    found = strips(lambda x: 4.0 * rate * x**3, lambda x: 12.0 * rate * x**2 + 1e-9)
    half = (4.0 * FORCE / (3.0 * np.pi * MODULUS * rate * WIDTH)) ** 0.25
    np.testing.assert_allclose(found.half_width, half, rtol=1e-8)
    expected = np.sqrt(2.0) * MODULUS * rate * half**3
    np.testing.assert_allclose(found.peak_pressure, expected, rtol=1e-3)


def test_the_strip_moves_to_where_the_edges_part_more_slowly() -> None:
    """Gap slope κ (x + c x²/2): no pull at the ends asks m + c (m² + b²/2)/2 = 0."""
    growth = 300.0
    found = strips(lambda x: 3.0 * (x + 0.5 * growth * x**2), lambda x: 3.0 * (1.0 + growth * x))
    m, b = found.middle, found.half_width
    np.testing.assert_allclose(m, -0.5 * growth * (m**2 + 0.5 * b**2), rtol=1e-8)
    assert np.all(m < 0.0)


def test_edges_that_cut_into_each_other_have_no_strip() -> None:
    with pytest.raises(ArithmeticError, match="no strip of contact"):
        strips(lambda x: -3.0 * x, lambda x: np.full_like(x, -3.0))


@pytest.mark.parametrize("growth", [0.0, 600.0, 1500.0])
def test_finite_elements_of_a_deep_block_press_as_hard(growth: float) -> None:
    """A curvature that grows from 20 per metre by half and more of itself on the strip.

    The held far side of the block raises the peak by 0.7 % (half width over depth 0.14)."""
    kappa, force = 20.0, 250.0
    x = np.linspace(-2e-3, 2e-3, 8001)
    slope = kappa * np.where(x > 0.0, x + 0.5 * growth * x**2, x)
    gap = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(x))])
    gap -= gap[np.argmin(np.abs(x))]
    profile = rigid_profile(np.column_stack([x, -gap])[::-1])
    block = pad_pressure(
        profile, np.zeros(2), force, half_thickness=1e-3, sheet=Sheet(MODULUS, 0.3, WIDTH)
    )

    def opening(place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        ahead = np.maximum(place, 0.0)
        return kappa * (place + 0.5 * growth * ahead**2), kappa * (1.0 + growth * ahead)

    found = contact_strips(opening, np.array([force]), WIDTH, np.array([kappa]), MODULUS)
    hertz = peak_pressure(force, WIDTH, kappa, MODULUS)
    assert block.peak_pressure == pytest.approx(found.peak_pressure[0], rel=0.015)
    assert found.peak_pressure[0] / hertz > 1.0 + growth * 1e-5 - 1e-3
