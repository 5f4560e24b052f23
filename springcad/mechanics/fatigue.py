"""Allowable stress from life: the S-N line estimated from the ultimate strength of a steel.

The estimate is that of mechanical-design textbooks (Shigley's Mechanical Engineering Design,
chapter on fatigue): a straight line in log-log through (1e3, f S_ut) and (1e6, S_e), fully
reversed, smooth specimen, half of the specimens surviving. Paper 004 takes its design stress from
it. A life from S_ut alone is right to a factor of about 10. Stresses are amplitudes in Pa.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from itertools import pairwise

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
    """Fully reversed stress over life, straight in log-log between ``points``.

    Attributes:
        points: (cycles, stress amplitude), the cycles ascending and the stresses falling.
        endures: whether a stress below the last point does no damage, as it is taken for steels.
    """

    points: tuple[tuple[float, float], ...]
    endures: bool = False

    def __post_init__(self) -> None:
        falls = all(n1 < n2 and s1 > s2 for (n1, s1), (n2, s2) in pairwise(self.points))
        if not self.points or not falls or self.points[0][0] <= 0.0 or self.points[-1][1] <= 0.0:
            raise ValueError("the S-N line must fall from a positive stress to a positive stress")

    def scaled(self, factor: float) -> SNLine:
        """The line with all of its stresses multiplied by ``factor``."""
        return SNLine(tuple((n, factor * stress) for n, stress in self.points), self.endures)


def estimated_line(
    ultimate_strength: float, endurance_factor: float = 1.0, fraction: float = 0.9
) -> SNLine:
    """The S-N line of a steel of ``ultimate_strength`` (Pa).

    ``endurance_factor`` is the product of the Marin factors, ``fraction`` the share f of the
    ultimate strength at 1e3 cycles. Paper 004 has 1 and 0.9.
    """
    high = endurance_factor * endurance_limit_estimate(ultimate_strength)
    points = ((LOW_CYCLES, fraction * ultimate_strength), (HIGH_CYCLES, high))
    return SNLine(points, endures=True)


def endurance_limit_estimate(ultimate_strength: float) -> float:
    """S_e' of a smooth steel specimen: S_ut/2, at most 700 MPa (Shigley). Steels only."""
    return min(0.5 * ultimate_strength, 700e6)


def stress_at_life(line: SNLine, cycles: float) -> float:
    """Stress amplitude that ``cycles`` allow; ValueError outside of the line's points."""
    (first, _), (last, _) = line.points[0], line.points[-1]
    if not first <= cycles <= last:
        raise ValueError(
            f"the S-N line holds from {power(first)} to {power(last)} cycles, not at {cycles:g}"
        )
    for (n1, s1), (n2, s2) in pairwise(line.points):
        if cycles <= n2:
            return float(s1 * (cycles / n1) ** (math.log(s2 / s1) / math.log(n2 / n1)))
    return line.points[-1][1]


def life_at_stress(line: SNLine, amplitude: float) -> float:
    """Cycles at the stress ``amplitude``; ValueError above the first point of the line.

    Below the last point they are infinite if the line endures, which holds for steels; else they
    are those of the last point, a lower bound.
    """
    if amplitude > line.points[0][1]:
        raise ValueError(
            f"the stress is beyond the S-N line: fewer than {power(line.points[0][0])} cycles"
        )
    if amplitude < line.points[-1][1]:
        return math.inf if line.endures else line.points[-1][0]
    for (n1, s1), (n2, s2) in pairwise(line.points):
        if amplitude >= s2:
            return float(n1 * (amplitude / s1) ** (math.log(n2 / n1) / math.log(s2 / s1)))
    return line.points[-1][0]


def miners_sum(line: SNLine, levels: Collection[tuple[float, float]]) -> float:
    """Sum of n/N over ``levels`` of (stress amplitude, cycles n): 1 is the life of half the parts.

    As long as every level is below the endurance limit it is 0; once one is above, the others
    count with the line continued at its last slope (elementary Miner, on the safe side).
    ValueError for a level above the line.
    """
    lives = [(n, life_at_stress(line, amplitude), amplitude) for amplitude, n in levels]
    if all(math.isinf(life) for _, life, _ in lives):
        return 0.0
    return sum(n / _continued(line, amplitude, life) for n, life, amplitude in lives)


def _continued(line: SNLine, amplitude: float, life: float) -> float:
    """``life``, where it is infinite that of the line's last slope."""
    if math.isfinite(life) or amplitude <= 0.0 or len(line.points) < 2:
        return life
    (n1, s1), (n2, s2) = line.points[-2:]
    return float(n2 * (amplitude / s2) ** (math.log(n2 / n1) / math.log(s2 / s1)))


def power(cycles: float) -> str:
    """Cycles as people write them: ``1e5``, ``2.5e5``; up to four digits."""
    mantissa, exponent = f"{cycles:.3e}".split("e")
    return f"{float(mantissa):g}e{int(exponent)}"


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


MEAN_STRESS: Mapping[str, Callable[[float, float, float], float]] = {
    "goodman": goodman,
    "gerber": gerber,
    "soderberg": soderberg,
}
"""Corrections by name; the third argument is the yield strength for Soderberg, else the ultimate
strength."""


def peak_for_reversed(amplitude: float, load_ratio: float, correction: str, limit: float) -> float:
    """Peak of a stress from R peak to peak that is as damaging as the reversed ``amplitude``.

    ``correction`` is a name in ``MEAN_STRESS``, ``limit`` its strength (Pa). Inverse of that
    correction: with a = (1 - R)/2 and m = (1 + R)/2, Goodman and Soderberg give
    S/(a + m S/limit), Gerber the positive root of a p = S (1 - (m p/limit)^2).
    """
    a, m = amplitude_and_mean(1.0, load_ratio)
    slope = amplitude * m / limit
    if correction == "gerber":
        return 2.0 * amplitude / (a + math.hypot(a, 2.0 * slope))
    return amplitude / (a + slope)


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
