"""The stress that a part may reach for a wanted life, with every factor that leads to it.

It begins with a line of smooth specimens, half of which survive: S-N points of the user's own, a
fatigue strength that a source states, or for steels the estimate from the ultimate strength.
Marin's factors for surface, size and reliability lower it; those of the estimate act on the
endurance limit at 1e6 cycles and not at 1e3, as in Shigley's book, those of data on the whole line.
A load that is not fully reversed is allowed for by a mean-stress correction, and the peak never
passes yield.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from springcad.materials.allowable import bending_strength, fatigue_basis
from springcad.materials.data import Material
from springcad.mechanics.fatigue import (
    HIGH_CYCLES,
    LOW_CYCLES,
    MEAN_STRESS,
    RELIABILITY_FACTORS,
    SURFACES,
    SNLine,
    amplitude_and_mean,
    estimated_line,
    life_at_stress,
    peak_for_reversed,
    power,
    stress_at_life,
    surface_factor,
)

POLISHED = "polished"


@dataclass(frozen=True)
class Duty:
    """What a part is to bear, and what is known of its material and surface.

    Attributes:
        cycles: wanted life.
        load_ratio: R of a stress from R peak to peak, -1 <= R < 1.
        reliability: share of the parts that survive, a key of ``RELIABILITY_FACTORS``.
        surface: a name in ``SURFACES``, or polished.
        surface_factor: in place of that of ``surface``.
        size_factor: Marin's k_b.
        mean_stress: a name in ``MEAN_STRESS``.
        points: S-N points of the user's own, fully reversed; in place of what the table knows.
    """

    cycles: float
    load_ratio: float = -1.0
    reliability: float = 0.5
    surface: str = POLISHED
    surface_factor: float | None = None
    size_factor: float = 1.0
    mean_stress: str = "goodman"
    points: tuple[tuple[float, float], ...] | None = None


@dataclass(frozen=True)
class Factor:
    """A factor of the design stress.

    Attributes:
        name, words: for people.
        value: as tables give it: on the endurance limit, if the line is estimated.
        effect: on the stress at the wanted life.
    """

    name: str
    words: str
    value: float
    effect: float


@dataclass(frozen=True)
class FatigueStrength:
    """Stress and life of a part.

    Attributes:
        duty: what was asked.
        basis: what the line is, for people.
        estimated: whether it is from the ultimate strength alone.
        smooth: line of smooth specimens, half of which survive.
        line: that of the part, the Marin factors in it.
        start: stress of ``smooth`` at the wanted life.
        factors: their effects times ``start`` are ``stress``.
        mean_limit: strength that the mean-stress correction takes, Pa; infinite if R = -1.
    """

    duty: Duty
    basis: str
    estimated: bool
    smooth: SNLine
    line: SNLine
    start: float
    factors: tuple[Factor, ...]
    mean_limit: float

    @property
    def stress(self) -> float:
        """Peak stress allowed, Pa."""
        return self.start * math.prod(factor.effect for factor in self.factors)

    def reversed_amplitude(self, peak: float) -> float:
        """As damaging as a stress from R peak to peak; ValueError if its mean reaches the limit."""
        amplitude, mean = amplitude_and_mean(peak, self.duty.load_ratio)
        return MEAN_STRESS[self.duty.mean_stress](amplitude, mean, self.mean_limit)

    def life(self, peak: float) -> float:
        """Cycles that a stress from R peak to peak allows; see ``life_at_stress``."""
        return life_at_stress(self.line, self.reversed_amplitude(peak))


class DutyError(ValueError):
    """A duty that cannot be met with what is known; ``key`` is the one of ``Duty`` to look at."""

    def __init__(self, key: str, message: str) -> None:
        super().__init__(message)
        self.key = key


def fatigue_strength(material: Material, duty: Duty) -> FatigueStrength:
    """The stress that ``material`` allows for ``duty``; DutyError where nothing is known of it."""
    smooth, basis, estimated = _smooth_line(material, duty)
    marin = _surface(material, duty), duty.size_factor, RELIABILITY_FACTORS[duty.reliability]
    limit = _mean_limit(material, duty)
    cycles = _read_at(smooth, duty.cycles)
    line, exponent = _derated(smooth, math.prod(marin), cycles, estimated)
    amplitude = stress_at_life(line, cycles)
    peak = peak_for_reversed(amplitude, duty.load_ratio, duty.mean_stress, limit)
    once = bending_strength(material)
    most = f"never above {once.basis}, {once.stress.value / 1e6:.4g} MPa"
    factors = (
        *(
            Factor(name, words, value, value**exponent)
            for (name, words), value in zip(_marin_words(duty).items(), marin, strict=True)
        ),
        _plain_factor("mean stress", _mean_words(duty), peak / amplitude),
        _plain_factor(once.basis, most, min(1.0, once.stress.value / peak)),
    )
    start = stress_at_life(smooth, cycles)
    return FatigueStrength(duty, basis, estimated, smooth, line, start, factors, limit)


def _read_at(smooth: SNLine, cycles: float) -> float:
    """``cycles``, or the end of a line that endures; a single point stands for shorter lives too.

    That a wanted life is on the line of the user's points has been seen to.
    """
    first, last = smooth.points[0][0], smooth.points[-1][0]
    if smooth.endures:
        cycles = min(cycles, last)
    return max(cycles, first) if len(smooth.points) == 1 else cycles


def _derated(smooth: SNLine, factor: float, cycles: float, estimated: bool) -> tuple[SNLine, float]:
    """The line with Marin's factors in it, and the power in which they act at ``cycles``."""
    if not estimated:
        return smooth.scaled(factor), 1.0
    (low, first), (high, last) = smooth.points
    line = SNLine(((low, first), (high, factor * last)), endures=True)
    return line, math.log(cycles / low) / math.log(high / low)


def _smooth_line(material: Material, duty: Duty) -> tuple[SNLine, str, bool]:
    """The line, what it is, and whether it is estimated from the ultimate strength."""
    if duty.points is not None:
        first, last = duty.points[0][0], duty.points[-1][0]
        if not first <= duty.cycles <= last:
            raise DutyError(
                "cycles",
                f"must be within the S-N points, {power(first)} to {power(last)}: nothing is "
                "extrapolated",
            )
        return SNLine(duty.points), "S-N points of the spec", False
    if duty.cycles < LOW_CYCLES:
        raise DutyError(
            "cycles",
            "must be at least 1000: below, plastic strain decides and not stress; "
            "or give S-N points that begin lower",
        )
    try:
        known = fatigue_basis(material, duty.cycles) == "known"
    except ValueError as error:
        raise DutyError("", _what_to_give(material, duty, str(error))) from error
    ultimate, strength = material.ultimate_strength, material.fatigue_strength
    if ultimate is not None and ultimate.value < material.yield_strength.value:
        raise DutyError(
            "",
            f"the ultimate strength, {ultimate.value / 1e6:.4g} MPa, is below the yield strength, "
            f"{material.yield_strength.value / 1e6:.4g} MPa: give both for one temper",
        )
    estimate = estimated_line(ultimate.value) if ultimate and material.family == "steel" else None
    if known and strength is not None:
        words = f"fatigue strength {strength.value / 1e6:.4g} MPa ({strength.source})"
        if estimate is None:
            cycles = material.fatigue_cycles or HIGH_CYCLES
            return SNLine(((cycles, strength.value),), material.family == "steel"), words, False
        # The source's temper may not be the user's: never more than the estimate.
        limit = min(strength.value, estimate.points[-1][1])
        line = SNLine((estimate.points[0], (HIGH_CYCLES, limit)), endures=True)
        return line, f"{words} for the endurance limit", True
    assert estimate is not None
    assert ultimate is not None
    return (
        estimate,
        f"estimate from the ultimate strength {ultimate.value / 1e6:.4g} MPa ({ultimate.source})",
        True,
    )


def _what_to_give(material: Material, duty: Duty, reason: str) -> str:
    steel = material.family == "steel"
    give = "give material.ultimate_strength, or S-N" if steel else "give S-N"
    return (
        f"nothing is known of {material.name} at {power(duty.cycles)} cycles: {reason}; "
        f"{give} points of your own as life.sn: [[1e3, ... MPa], [1e6, ... MPa]]"
    )


def _surface(material: Material, duty: Duty) -> float:
    """Marin's k_a."""
    if duty.surface_factor is not None:
        return duty.surface_factor
    if duty.surface == POLISHED:
        return 1.0
    ultimate = material.ultimate_strength
    if material.family != "steel":
        raise DutyError("surface", "factors of surfaces are known for steels; use surface_factor")
    if ultimate is None:
        raise DutyError("surface", "its factor needs material.ultimate_strength")
    return surface_factor(duty.surface, ultimate.value)


def _marin_words(duty: Duty) -> dict[str, str]:
    """Name → words of the three, in the order of ``_surface``, size and reliability."""
    surface = "of the spec"
    if duty.surface_factor is None:
        surface = duty.surface
        if surface in SURFACES:
            a, b = SURFACES[surface]
            surface = f"{surface}, {a:g} S_ut^{b:g}"
    size = "taken as 1" if duty.size_factor == 1.0 else "of the spec"
    return {
        "surface": surface,
        "size": size,
        "reliability": f"{100 * duty.reliability:.4g} % survive",
    }


def _mean_words(duty: Duty) -> str:
    if duty.load_ratio == -1.0:
        return "R = -1, fully reversed"
    return f"R = {duty.load_ratio:g}, {duty.mean_stress.capitalize()}; from amplitude to peak"


def _plain_factor(name: str, words: str, value: float) -> Factor:
    return Factor(name, words, value, value)


def _mean_limit(material: Material, duty: Duty) -> float:
    """What the correction takes for the mean stress that nothing survives."""
    if duty.load_ratio == -1.0:
        return math.inf
    if duty.mean_stress == "soderberg":
        return material.yield_strength.value
    if material.ultimate_strength is None:
        raise DutyError(
            "load_ratio",
            f"{duty.mean_stress} needs the ultimate strength of {material.name}: give "
            "material.ultimate_strength, or mean_stress: soderberg",
        )
    return material.ultimate_strength.value
