"""Paper 004: "Using S-N curve estimation ... we determined the design stress (912 MPa) that
achieves 100,000 cycles with our material (SS 420)." The paper gives no steps; these are Shigley's.
"""

from __future__ import annotations

import math

import pytest

from springcad.materials.data import material
from springcad.mechanics.fatigue import (
    RELIABILITY_FACTORS,
    SNLine,
    amplitude_and_mean,
    endurance_limit_estimate,
    estimated_line,
    gerber,
    goodman,
    life_at_stress,
    size_factor,
    soderberg,
    stress_at_life,
    surface_factor,
)

ULTIMATE = 1720e6


def test_the_912_mpa_of_paper_004_are_the_estimate_at_1e5_cycles() -> None:
    assert stress_at_life(estimated_line(ULTIMATE), 1e5) == pytest.approx(912.0e6, abs=0.05e6)


def test_the_number_follows_from_the_formula_as_textbooks_print_it() -> None:
    low, high = 0.9 * ULTIMATE, 700e6
    a = low**2 / high
    b = -math.log10(low / high) / 3.0
    assert a * (1e5) ** b == pytest.approx(stress_at_life(estimated_line(ULTIMATE), 1e5), rel=1e-12)


def test_the_ultimate_strength_of_the_table_gives_it_too() -> None:
    ultimate = material("aisi-420").ultimate_strength
    assert ultimate is not None
    assert ultimate.value == ULTIMATE


@pytest.mark.parametrize("surface", [0.6, surface_factor("machined", ULTIMATE)])
def test_machined_surface_and_99_percent_reliability_leave_550_to_620_mpa(surface: float) -> None:
    nominal = stress_at_life(estimated_line(ULTIMATE), 1e5)
    line = estimated_line(ULTIMATE, endurance_factor=surface * RELIABILITY_FACTORS[0.99])
    derated = stress_at_life(line, 1e5)
    assert 550e6 <= derated <= 620e6
    assert 0.37 <= (derated / nominal) ** 2 <= 0.47


def test_life_and_stress_are_inverse_on_the_whole_line() -> None:
    line = estimated_line(ULTIMATE)
    assert (stress_at_life(line, 1e3), stress_at_life(line, 1e6)) == pytest.approx((1548e6, 700e6))
    for cycles in (1e3, 2e3, 1e4, 1e5, 9.9e5):
        assert life_at_stress(line, stress_at_life(line, cycles)) == pytest.approx(cycles, rel=1e-9)
    assert life_at_stress(line, 699e6) == math.inf


def test_nothing_is_extrapolated_beyond_the_line() -> None:
    line = estimated_line(ULTIMATE)
    for cycles in (999.0, 1.001e6):
        with pytest.raises(ValueError, match="1e3 to 1e6 cycles"):
            stress_at_life(line, cycles)
    with pytest.raises(ValueError, match="fewer than 1e3 cycles"):
        life_at_stress(line, 1549e6)
    with pytest.raises(ValueError, match="must fall"):
        SNLine(((1e3, 500e6), (1e6, 600e6)))


def test_the_endurance_limit_is_half_the_strength_up_to_700_mpa() -> None:
    assert endurance_limit_estimate(1000e6) == 500e6
    assert endurance_limit_estimate(1400e6) == endurance_limit_estimate(2000e6) == 700e6


def test_marin_factors_have_the_textbook_values() -> None:
    # Shigley, examples: machined S_ut = 400 MPa and cold-drawn bar of 32 mm
    assert surface_factor("machined", 400e6) == pytest.approx(4.51 * 400**-0.265, rel=1e-12)
    assert surface_factor("ground", 200e6) == 1.0
    # the book prints the coefficient 7.62^0.107 to three digits, 1.24
    assert size_factor(32e-3) == pytest.approx((32 / 7.62) ** -0.107, rel=0.005 / 1.24)
    assert size_factor(2e-3) == 1.0
    with pytest.raises(ValueError, match="51 mm"):
        size_factor(60e-3)
    # k_e = 1 - 0.08 z with z of the normal distribution
    for reliability, z in ((0.5, 0.0), (0.9, 1.288), (0.95, 1.645), (0.99, 2.326), (0.999, 3.091)):
        assert RELIABILITY_FACTORS[reliability] == pytest.approx(1 - 0.08 * z, abs=6e-4)


def test_mean_stress_corrections_agree_where_they_must_and_are_ordered() -> None:
    amplitude, mean = amplitude_and_mean(800e6, load_ratio=0.0)
    assert (amplitude, mean) == (400e6, 400e6)
    by_gerber = gerber(amplitude, mean, ULTIMATE)
    by_goodman = goodman(amplitude, mean, ULTIMATE)
    by_soderberg = soderberg(amplitude, mean, 1310e6)
    assert amplitude < by_gerber < by_goodman < by_soderberg
    assert goodman(amplitude, 0.5 * ULTIMATE, ULTIMATE) == pytest.approx(2 * amplitude)
    assert gerber(amplitude, 0.5 * ULTIMATE, ULTIMATE) == pytest.approx(amplitude / 0.75)
    for correct in (gerber, goodman, soderberg):
        reversed_amplitude, zero = amplitude_and_mean(800e6, load_ratio=-1.0)
        assert correct(reversed_amplitude, zero, ULTIMATE) == 800e6
        assert correct(amplitude, -mean, ULTIMATE) == amplitude
        with pytest.raises(ValueError, match="reaches the strength"):
            correct(amplitude, ULTIMATE, ULTIMATE)
    with pytest.raises(ValueError, match="load ratio"):
        amplitude_and_mean(800e6, load_ratio=1.0)
