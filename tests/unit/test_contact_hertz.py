"""Hertz line contact."""

from __future__ import annotations

import numpy as np
import pytest

from springcad.mechanics.contact import contact_modulus, half_width, peak_pressure


def test_equal_steels() -> None:
    assert contact_modulus(200e9, 0.3, 200e9, 0.3) == pytest.approx(200e9 / (2 * 0.91), rel=1e-15)


def test_the_pressure_ellipse_carries_the_force() -> None:
    """F = π b w p₀/2, and b = 4 R p₀ / E* (Johnson, Eqs. 4.43-4.45)."""
    force, width, curvature, modulus = 228.0, 4.5e-3, 1 / 0.85e-3, 110e9
    pressure = peak_pressure(force, width, curvature, modulus)
    half = half_width(force, width, curvature, modulus)
    assert 0.5 * np.pi * half * width * pressure == pytest.approx(force, rel=1e-14)
    assert half == pytest.approx(2 * pressure / (modulus * curvature), rel=1e-14)


def test_a_flat_on_a_flat_has_no_peak() -> None:
    assert peak_pressure(100.0, 4e-3, 0.0, 110e9) == 0.0
