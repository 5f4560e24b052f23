"""Gaps between parts of an omega leaf, as rows of a search: within a half and between both.

Lengths are in units of R_c. From each point of a line the distance is taken to the chords on both
sides of the nearest point of the other line, so the points may lie much farther apart than the gap
is wide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.neighbours import Indices, zone_minimum
from springcad.kinds.lever_arm.omega import OmegaCase
from springcad.kinds.lever_arm.omega_form import POINTS, Half, basis
from springcad.kinds.lever_arm.omega_rows import ZONES, Track, wanted_gap, zones
from springcad.optimise.dual import Dual

Floats = NDArray[np.float64]

NOWHERE = 1.0
"""The margin of a zone where nothing can touch."""


def self_rows(case: OmegaCase, half: Half, tracks: Sequence[Track]) -> list[Dual]:
    """Gap of the half to itself, less the wanted one, in each of the states."""
    gap = wanted_gap(case)
    pairs = _along(half, tracks[0].half.value, gap)
    return [_gaps(track, track, pairs) - gap for track in tracks]


def halves_rows(case: OmegaCase, half: Half, states: Sequence[tuple[Track, Track]]) -> list[Dual]:
    """Gap of the right half to the left one, the mirror image of the second of a pair."""
    gap, pairs = wanted_gap(case), _across(case, half, states[0][0].half.value)
    lefts = [Track(-track.x, track.y, track.half) for _, track in states]
    return [_gaps(right, left, pairs) - gap for (right, _), left in zip(states, lefts, strict=True)]


@dataclass(frozen=True)
class _Pairs:
    """Which points (P,) of a line may touch which of another.

    Attributes:
        bar: 0 where they may, else infinite (P, P).
        alone: those of the first line that may touch none (P,).
    """

    bar: Floats
    alone: NDArray[np.bool_]


def _pairs(counts: NDArray[np.bool_]) -> _Pairs:
    return _Pairs(np.where(counts, 0.0, np.inf), ~np.any(counts, axis=1))


def _along(half: Half, thick: Floats, gap: float) -> _Pairs:
    """Two points of a half count from the shortest arc that a bend can turn round a gap.

    That is half a circle about the gap through both centre lines.
    """
    stations = float(half.length.value[0]) * basis().points
    between = np.abs(stations[:, None] - stations)
    return _pairs(between > 0.5 * np.pi * (thick[:, None] + thick + gap))


def _across(case: OmegaCase, half: Half, thick: Floats) -> _Pairs:
    """Next to the hub the halves meet; from a thickness and a gap along they count."""
    unit = case.enclosure_radius
    stations = case.hub_radius / unit + float(half.length.value[0]) * basis().points
    near = case.min_gap / unit + 2.0 * float(thick[0])
    return _pairs(stations[:, None] + stations > 2.0 * near)


def _gaps(first: Track, second: Track, pairs: _Pairs) -> Dual:
    """Distance of the tubes, smallest of each zone of ``first``, among the pairs that count."""
    # In place: this is what a search spends most of its time on.
    distance = first.x.value[:, None] - second.x.value
    distance *= distance
    across = first.y.value[:, None] - second.y.value
    across *= across
    distance += across
    np.sqrt(distance, out=distance)
    distance -= second.half.value
    distance += pairs.bar
    foot = _foot(first, second, distance.argmin(axis=1), pairs.bar)
    gap = foot.span - first.half.value - foot.mix(second.half.value)
    gap = np.where(pairs.alone, NOWHERE, gap)
    i = zone_minimum(gap, zones(POINTS, ZONES))
    if not first.x.gradient.shape[1]:
        return Dual(gap[i], first.x.gradient[i])
    near = _Foot(*(part[i] for part in vars(foot).values()))
    gradient = (
        near.ux[:, None] * (first.x.gradient[i] - near.mix(second.x.gradient))
        + near.uy[:, None] * (first.y.gradient[i] - near.mix(second.y.gradient))
        - first.half.gradient[i]
        - near.mix(second.half.gradient)
    )
    return Dual(gap[i], np.where(pairs.alone[i, None], 0.0, gradient))


@dataclass(frozen=True)
class _Foot:
    """Nearest place of a line to each point: between its points ``start`` and ``end``.

    ``share`` is the share of the way from one to the other, (ux, uy) the unit vector from the
    foot to the point and ``span`` their distance.
    """

    start: Indices
    end: Indices
    share: Floats
    ux: Floats
    uy: Floats
    span: Floats

    def mix(self, values: Floats) -> Floats:
        """Values (P,) or gradients (P, V) of the line at the feet."""
        share = self.share if values.ndim == 1 else self.share[:, None]
        return np.asarray(values[self.start] + share * (values[self.end] - values[self.start]))


def _foot(first: Track, second: Track, j: Indices, bar: Floats) -> _Foot:
    """The nearer foot on the chords behind and before the points ``j`` of the second line.

    Chords that lead to a point that does not count are left out.
    """
    x, y, every = second.x.value, second.y.value, np.arange(POINTS)
    ends = np.stack([np.maximum(j - 1, 0), np.minimum(j + 1, POINTS - 1)])
    tx, ty = x[ends] - x[j], y[ends] - y[j]
    dx, dy = first.x.value - x[j], first.y.value - y[j]
    square = np.maximum(tx * tx + ty * ty, 1e-24)
    share = np.clip((dx * tx + dy * ty) / square, 0.0, 1.0) * (bar[every, ends] == 0.0)
    dx, dy = dx - share * tx, dy - share * ty
    span = np.maximum(np.hypot(dx, dy), 1e-12)
    nearer = (span[1] < span[0]).astype(np.intp), every
    span = span[nearer]
    return _Foot(j, ends[nearer], share[nearer], dx[nearer] / span, dy[nearer] / span, span)
