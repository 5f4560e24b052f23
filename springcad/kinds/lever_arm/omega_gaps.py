"""Gaps of a deformed omega leaf, on dense points: to itself, to the wall, to the lever."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.omega import OmegaCase
from springcad.kinds.lever_arm.omega_rows import CLOSING

Floats = NDArray[np.float64]

FACING = 0.5 * np.pi
"""Half a circle over its diameter."""


def self_gap(
    right: Floats, left: Floats, thickness: Floats, stations: Floats, case: OmegaCase
) -> float:
    """Smallest gap, m, within the right half and between both halves; (S, 2) each.

    Two places of one half face each other if the way between them is at least half a circle about
    a gap of the wanted width. The halves meet at the hub; from a thickness and a gap away from its
    middle they count. The points' spacing does not: distances are taken to the tangents.
    """
    half = 0.5 * thickness
    apart = np.abs(stations[:, None] - stations)
    own = _distances(right, right) - half[:, None] - half
    reach = FACING * (half[:, None] + half + case.min_gap) + stations[1]
    own[apart < reach] = np.inf
    other = _distances(right, left) - half[:, None] - half
    from_hub = case.hub_radius + stations
    other[from_hub[:, None] + from_hub < 2.0 * (thickness[0] + case.min_gap)] = np.inf
    return float(min(own.min(), other.min()))


def _distances(points: Floats, line: Floats) -> Floats:
    """From each point (P, 2) to the line (S, 2) near each of its points (P, S)."""
    tx, ty = np.gradient(line, axis=0).T
    spacing = np.hypot(tx, ty)
    tx, ty = tx / spacing, ty / spacing
    dx, dy = (np.subtract.outer(points[:, k], line[:, k]) for k in (0, 1))
    along = np.clip(dx * tx + dy * ty, -0.5 * spacing, 0.5 * spacing)
    return np.asarray(np.hypot(dx - along * tx, dy - along * ty))


def wall_gap(half: Floats, thickness: Floats, stations: Floats, case: OmegaCase) -> float:
    """Smallest gap to the wall, m, where the way left to the clamp leaves room for it."""
    left = CLOSING * (stations[-1] - stations)
    gap = case.enclosure_radius - np.hypot(*half.T) - 0.5 * thickness
    return float(np.min(gap[left >= case.min_gap]))


def corridor_gap(
    right: Floats, thickness: Floats, displacement: float, middle: float, case: OmegaCase
) -> float:
    """Smallest gap of the right half to the corridor, m, for the worse of the two arms."""
    depth = middle - right[:, 1]
    arm = case.arms[1] if displacement > 0.0 else case.arms[0]
    reach = displacement * np.maximum(1.0 - depth / arm, 0.0)
    beside, above = right[:, 0] - reach, np.maximum(case.corridor - depth, 0.0)
    distance = np.where(beside < 0.0, beside + above, np.hypot(beside, above))
    return float(np.min(distance - 0.5 * thickness)) - 0.5 * case.corridor
