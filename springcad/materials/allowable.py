"""The stress that a leaf of a material may reach in bending: once, or for a given number of cycles.

Once, it is the yield strength. For a life it is the amplitude of a fully reversed stress that half
of smooth specimens survive, and never more than the yield strength: a comparison of materials, not
the design stress of a part, which its surface and the wanted reliability lower further.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from springcad.materials.data import Material, Value
from springcad.mechanics.fatigue import (
    HIGH_CYCLES,
    LOW_CYCLES,
    estimated_line,
    stress_at_life,
)


@dataclass(frozen=True)
class Allowable:
    """An allowable ``stress`` [Pa] with its source, and what it is."""

    stress: Value
    basis: str


class NoFatigueDataError(ValueError):
    """Nothing is known of a material at the life asked for; the message says what is missing."""


def allowable_stress(material: Material, cycles: float | None) -> Allowable:
    """Yield strength in bending, or for a number of ``cycles`` the fatigue stress up to it.

    Raises:
        NoFatigueDataError: no source speaks of that life, and no estimate holds for the material.
        ValueError: below 1e3 cycles, where plastic strain decides and not stress.
    """
    once = bending_strength(material)
    if cycles is None:
        return once
    repeated = fatigue_stress(material, cycles)
    return once if once.stress.value < repeated.stress.value else repeated


def bending_strength(material: Material) -> Allowable:
    """The flexural strength where there is one, else the yield strength in tension."""
    if material.flexural_strength is not None:
        return Allowable(material.flexural_strength, "flexural yield")
    return Allowable(material.yield_strength, "yield")


def fatigue_stress(material: Material, cycles: float) -> Allowable:
    """Fully reversed stress amplitude at ``cycles``, by the first of these that speaks of it.

    1. Steels up to 1e6 cycles: the S-N line estimated from the ultimate strength.
    2. A fatigue strength known at this life or a longer one: at least so much is allowed. That of
       a steel is taken for its endurance limit.
    3. Steels beyond 1e6 cycles: the estimated endurance limit.

    No other metal and no polymer has an endurance limit, and nothing is extrapolated.
    """
    if fatigue_basis(material, cycles) == "known" and material.fatigue_strength is not None:
        return Allowable(material.fatigue_strength, "fatigue strength")
    assert material.ultimate_strength is not None
    estimate = _estimate(material.ultimate_strength, min(cycles, HIGH_CYCLES))
    return Allowable(estimate, "fatigue, estimated")


def fatigue_basis(material: Material, cycles: float) -> Literal["estimate", "known"]:
    """Which of the two speaks of ``cycles``, as ``fatigue_stress`` has it; raises as that does."""
    if not cycles >= LOW_CYCLES:
        raise ValueError(f"the S-N line begins at 1e3 cycles, asked for {cycles:g}")
    is_steel = material.family == "steel"
    is_estimated = is_steel and material.ultimate_strength is not None
    known, known_cycles = material.fatigue_strength, material.fatigue_cycles
    if is_estimated and cycles <= HIGH_CYCLES:
        return "estimate"
    if known is not None and (is_steel or (known_cycles is not None and cycles <= known_cycles)):
        return "known"
    if is_estimated:
        return "estimate"
    raise NoFatigueDataError(_what_is_missing(material))


def _estimate(ultimate: Value, cycles: float) -> Value:
    """The stress of the estimated S-N line at ``cycles``, for the whole range of the strength."""

    def stress(strength: float) -> float:
        return stress_at_life(estimated_line(strength), cycles)

    return replace(
        ultimate,
        value=stress(ultimate.value),
        low=None if ultimate.low is None else stress(ultimate.low),
        high=None if ultimate.high is None else stress(ultimate.high),
        source=f"S-N line from S_ut = {ultimate.value / 1e6:g} MPa ({ultimate.source})",
    )


def _what_is_missing(material: Material) -> str:
    known, cycles = material.fatigue_strength, material.fatigue_cycles
    if known is not None and cycles is not None:
        return f"its fatigue strength is known up to {cycles / 1e6:g} million cycles only"
    if known is not None:
        return f"the life of its fatigue strength, {known.value / 1e6:g} MPa, is not stated"
    if material.family == "steel":
        return "no fatigue strength, and no ultimate strength to estimate one from"
    return "no fatigue strength, and none can be estimated but for steels"
