"""What is asked of a lever arm's leaf, SI."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from springcad.kinds.lever_arm.mechanism import Lever

Shape = Literal["constant", "triangular", "parabolic", "omega"]


@dataclass(frozen=True)
class Case:
    """What is asked for, SI; 0 stands for a length or a number that is not given.

    Attributes:
        lever: the mechanism.
        pivot_low, pivot_high: its pivot's range.
        shape: of the leaf.
        deflection: s_max.
        stiffness: of all leaves at s_max, wanted; 0 if layers or width decide.
        count: leaves side by side.
        length: of a straight leaf.
        sheet: thickness of the sheet.
        layers: of a stack.
        width: of a triangular leaf.
        height: room along the axis for all leaves.
        radius, corridor: of the enclosure of an omega leaf.
        max_pivot_force: 0 if not limited.
        elastic_modulus, poisson_ratio, design_stress, yield_strength: of the material.
        min_web, min_gap: of the process.
    """

    lever: Lever
    pivot_low: float
    pivot_high: float
    shape: Shape
    deflection: float
    stiffness: float
    count: int
    length: float
    sheet: float
    layers: int
    width: float
    height: float
    radius: float
    corridor: float
    max_pivot_force: float
    elastic_modulus: float
    poisson_ratio: float
    design_stress: float
    yield_strength: float
    min_web: float
    min_gap: float

    @property
    def room(self) -> float:
        """Largest width of one leaf: its layers, else what the height leaves; inf without both."""
        if self.layers:
            return self.layers * self.sheet
        if not self.height:
            return math.inf
        share = self.height / self.count
        if self.shape == "triangular":
            return share
        return math.floor(share / self.sheet * (1.0 + 1e-9)) * self.sheet


def pivots(case: Case, count: int) -> np.ndarray:
    """Pivot positions over the range, evenly (P,) [m]; one if the range is none."""
    if case.pivot_low == case.pivot_high:
        return np.array([case.pivot_low])
    return np.linspace(case.pivot_low, case.pivot_high, count)
