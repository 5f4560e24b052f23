"""Allowable stress from life: the S-N line estimated from the ultimate strength of a steel.

The estimate is that of mechanical-design textbooks (Shigley's Mechanical Engineering Design,
chapter on fatigue): a straight line in log-log through (1e3, f S_ut) and (1e6, S_e), fully
reversed, smooth specimen, half of the specimens surviving. Paper 004 takes its design stress from
it. A life from S_ut alone is right to a factor of about 10. Stresses are amplitudes in Pa.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

LOW_CYCLES = 1e3
HIGH_CYCLES = 1e6

SURFACES: Mapping[str, tuple[float, float]] = {
    "ground": (1.58, -0.085),
    "machined": (4.51, -0.265),
    "hot-rolled": (57.7, -0.718),
    "forged": (272.0, -0.995),
}
"""a and b of the surface factor a S_ut^b, S_ut in MPa (Shigley). None is published for wire EDM,
laser or waterjet, whose recast layer and heat-affected zone lower the strength."""

RELIABILITY_FACTORS: Mapping[float, float] = {
    0.5: 1.0,
    0.9: 0.897,
    0.95: 0.868,
    0.99: 0.814,
    0.999: 0.753,
}
"""Share that survives → factor on the endurance limit (Shigley: 8 % standard deviation)."""


@dataclass(frozen=True)
class SNLine:
    """Stress amplitude ``low`` at 1e3 cycles, ``high`` at 1e6, straight in log-log between."""

    low: float
    high: float

    def __post_init__(self) -> None:
        if not 0.0 < self.high < self.low:
            raise ValueError("the S-N line must fall from a positive stress to a positive stress")

    @property
    def exponent(self) -> float:
        """b of sigma = a N^b; negative."""
        return math.log(self.high / self.low) / math.log(HIGH_CYCLES / LOW_CYCLES)


def estimated_line(
    ultimate_strength: float, endurance_factor: float = 1.0, fraction: float = 0.9
) -> SNLine:
    """The S-N line of a steel of ``ultimate_strength`` (Pa).

    ``endurance_factor`` is the product of the Marin factors, ``fraction`` the share f of the
    ultimate strength at 1e3 cycles. Paper 004 has 1 and 0.9.
    """
    high = endurance_factor * endurance_limit_estimate(ultimate_strength)
    return SNLine(fraction * ultimate_strength, high)


def endurance_limit_estimate(ultimate_strength: float) -> float:
    """S_e' of a smooth steel specimen: S_ut/2, at most 700 MPa (Shigley). Steels only."""
    return min(0.5 * ultimate_strength, 700e6)


def stress_at_life(line: SNLine, cycles: float) -> float:
    """Stress amplitude that ``cycles`` (1e3 to 1e6) allow; ValueError outside of the line."""
    if not LOW_CYCLES <= cycles <= HIGH_CYCLES:
        raise ValueError(f"the S-N line holds from 1e3 to 1e6 cycles, not at {cycles:g}")
    return float(line.low * (cycles / LOW_CYCLES) ** line.exponent)


def life_at_stress(line: SNLine, amplitude: float) -> float:
    """Cycles at the stress ``amplitude``; infinite below ``line.high``, ValueError above ``low``.

    The infinite life holds for steels; other metals and polymers have no endurance limit.
    """
    if amplitude > line.low:
        raise ValueError("the stress is beyond the S-N line: fewer than 1e3 cycles")
    if amplitude < line.high:
        return math.inf
    return float(LOW_CYCLES * (amplitude / line.low) ** (1.0 / line.exponent))


def surface_factor(surface: str, ultimate_strength: float) -> float:
    """Marin's k_a of a surface in ``SURFACES``, at most 1; KeyError for another surface."""
    a, b = SURFACES[surface]
    return float(min(1.0, a * (ultimate_strength / 1e6) ** b))


def size_factor(diameter: float) -> float:
    """Marin's k_b = 1.24 d^-0.107 (d in mm), 1 below 2.79 mm; ValueError above 51 mm.

    For a section in bending that is not round, ``diameter`` is the equivalent one.
    """
    if diameter > 51e-3:
        raise ValueError("the size factor holds up to 51 mm")
    if diameter < 2.79e-3:
        return 1.0
    return float(1.24 * (diameter * 1e3) ** -0.107)


def goodman(amplitude: float, mean: float, ultimate_strength: float) -> float:
    """Fully reversed amplitude as damaging as ``amplitude`` about ``mean`` (straight line to S_ut).

    A mean stress below zero counts as zero in all three corrections; ValueError at or beyond the
    strength.
    """
    return amplitude / (1.0 - _share(mean, ultimate_strength))


def gerber(amplitude: float, mean: float, ultimate_strength: float) -> float:
    """As ``goodman``, with a parabola to the ultimate strength: less severe, for ductile metals."""
    return amplitude / (1.0 - _share(mean, ultimate_strength) ** 2)


def soderberg(amplitude: float, mean: float, yield_strength: float) -> float:
    """As ``goodman``, with a straight line to the yield strength: the most severe."""
    return amplitude / (1.0 - _share(mean, yield_strength))


def amplitude_and_mean(peak: float, load_ratio: float) -> tuple[float, float]:
    """Amplitude and mean of a stress between ``load_ratio * peak`` and ``peak``.

    A load ratio of -1 is fully reversed (series elastic), 0 is one-way; -1 <= R < 1.
    """
    if not -1.0 <= load_ratio < 1.0:
        raise ValueError("the load ratio must be from -1 to less than 1")
    return peak * (1.0 - load_ratio) / 2.0, peak * (1.0 + load_ratio) / 2.0


def _share(mean: float, strength: float) -> float:
    share = max(mean, 0.0) / strength
    if share >= 1.0:
        raise ValueError("the mean stress reaches the strength")
    return share
