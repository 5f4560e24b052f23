"""Miner's sum of a load histogram on a finished design."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.materials.fatigue_strength import FatigueStrength
from springcad.mechanics.fatigue import miners_sum
from springcad.spec.pairs import Load

Floats = NDArray[np.float64]

_LEAST_SCALE = 1e-3


@dataclass(frozen=True)
class Damage:
    """What a histogram does.

    Attributes:
        total: Miner's sum; not a number beyond the full load or the S-N line.
        largest: load over that at the full deflection.
        words: what there is to say.
        remedy: what brings the sum to 1.
    """

    total: float
    largest: float
    words: str
    remedy: str


def damage(
    strength: FatigueStrength,
    histogram: Sequence[tuple[Load, float]],
    over: Floats,
    stress: Floats,
) -> Damage:
    """Miner's sum of (load, cycles), with ``stress`` (K,) at the loads ``over`` (K,), ascending.

    Between rest and the first of them the stress is linear.
    """
    loads = np.array([load.value for load, _ in histogram])
    cycles = [number for _, number in histogram]
    largest = float(loads.max() / over[-1])
    # A load typed as the full one must not fail by round-off.
    if largest > 1.0 + 1e-9:
        return Damage(math.nan, largest, "a load is beyond the full deflection", "")
    peaks = np.interp(loads, np.append(0.0, over), np.append(0.0, stress))
    total = _sum(strength, peaks, cycles, 1.0)
    if math.isnan(total):
        words = "a stress is beyond the S-N line"
    elif total == 0.0:
        words = "every stress is below the endurance limit"
    else:
        words = f"the histogram can be borne {1.0 / total:.3g} times"
    # A design may stay below its design stress, or exceed it: the lower one must fall.
    held = min(strength.stress, float(stress.max()))
    remedy = "" if total <= 1.0 else _remedy(strength, peaks, cycles, held)
    return Damage(total, min(largest, 1.0), words, remedy)


def _sum(strength: FatigueStrength, peaks: Floats, cycles: Sequence[float], scale: float) -> float:
    """Miner's sum with all stresses scaled; not a number beyond the line."""
    try:
        amplitudes = [strength.reversed_amplitude(scale * float(peak)) for peak in peaks]
        return miners_sum(strength.line, tuple(zip(amplitudes, cycles, strict=True)))
    except ValueError:
        return math.nan


def _remedy(strength: FatigueStrength, peaks: Floats, cycles: Sequence[float], held: float) -> str:
    """By how much the stresses must fall, and the life that asks for less than the ``held`` one."""
    low, high = _LEAST_SCALE, 1.0
    for _ in range(40):
        middle = 0.5 * (low + high)
        bears = _sum(strength, peaks, cycles, middle) <= 1.0
        low, high = (middle, high) if bears else (low, middle)
    life = strength.life(low * held)
    less = f"stresses lower by {1.0 - low:.1%} bear it"
    if math.isinf(life):
        return f"{less}: below the endurance limit"
    return f"{less}: raise material.life.cycles to {1.01 * life:.3g}"
