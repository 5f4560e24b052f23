"""Stress and life of a finished design: what its load is, and what its material bears."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.miner import Damage, damage
from springcad.materials.fatigue_strength import FatigueStrength
from springcad.mechanics.fatigue import power
from springcad.spec.material import LifeSpec, MaterialSpec

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Loading:
    """Stress of a finished design over its stroke, as one cycle loads it.

    Attributes:
        name: of the stress that the design stress bounds.
        share: of the full deflection, ascending to 1 (K,).
        stress: largest in the part there (K,) [Pa].
        section: sides of the largest section in bending [m], where one is known.
        torque: of the whole element at these shares (K,) [N m]; None where it has no single one.
        local: name → stress of another place at the full deflection [Pa].
        keys: name → key of the spec that bounds the stress of that other place.
        load_ratio: of the stress in a joint that turns as far both ways.
    """

    name: str
    share: Floats
    stress: Floats
    section: tuple[float, float] | None = None
    torque: Floats | None = None
    local: Mapping[str, float] = field(default_factory=dict)
    keys: Mapping[str, str] = field(default_factory=dict)
    load_ratio: float = -1.0

    @property
    def peak(self) -> float:
        """Largest stress of the stroke, Pa."""
        return float(np.max(self.stress))

    @property
    def higher(self) -> Mapping[str, float]:
        """The other places where the stress is higher than the peak."""
        return {name: stress for name, stress in self.local.items() if stress > self.peak}


@dataclass(frozen=True)
class Lasting:
    """A material's strength and a design's loading; the life of the spec is ``wanted``, if any."""

    material: MaterialSpec
    strength: FatigueStrength
    loading: Loading

    @property
    def wanted(self) -> LifeSpec | None:
        return self.material.life

    @cached_property
    def damage(self) -> Damage | None:
        """Of the histogram: its torques, or shares, against the curve of the stress."""
        if self.wanted is None or self.wanted.histogram is None:
            return None
        in_shares = self.wanted.histogram[0][0].unit == "1"
        over = self.loading.share if in_shares else self.loading.torque
        assert over is not None, "a kind without a single torque has the rule shares_only"
        return damage(self.strength, self.wanted.histogram, over, self.loading.stress)

    def life(self, peak: float) -> tuple[float, str]:
        """Cycles at a peak stress, not a number where unknown, and what there is to say of them."""
        points = self.strength.line.points
        try:
            cycles = self.strength.life(peak)
        except ValueError:
            few = f"fewer than {power(points[0][0])}" if len(points) > 1 else "unknown"
            return math.nan, f"beyond the S-N line: {few}"
        if math.isinf(cycles):
            return cycles, f"below the endurance limit, {points[-1][1] / 1e6:.4g} MPa"
        if self.strength.reversed_amplitude(peak) < points[-1][1]:
            return cycles, "at least: the stress is below the last S-N point"
        basis = "S-N line estimated from S_ut" if self.strength.estimated else self.strength.basis
        return cycles, basis
