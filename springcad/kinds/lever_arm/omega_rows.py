"""What an omega leaf must keep to, as rows that must not be negative, with gradients.

A minimum over the whole half has kinks that stop a quasi-Newton search, so each claim is one row
for each zone of the half: its smallest margin there. Lengths are in units of R_c.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import NDArray

from springcad.geometry.neighbours import Indices, zone_index, zone_minimum
from springcad.kinds.lever_arm.omega import OmegaCase
from springcad.kinds.lever_arm.omega_form import POINTS, STRESS_POINTS, Half, basis
from springcad.kinds.lever_arm.omega_states import HalfState, States
from springcad.mechanics.section import curved_beam_factor
from springcad.optimise import dual
from springcad.optimise.dual import Dual

Floats = NDArray[np.float64]

ZONES = 20
STRESS_ZONES = 20
STRESS_ROWS = 4 * STRESS_ZONES
"""Rows of one state."""
CLOSING = 0.3
"""Towards the clamp the gap to the wall may close no slower than this share of the way left."""
MEETING = 0.5
"""Least cosine between the leaf's end and the radius: it meets the wall at 30 deg or more, so that
a foot can grow from its end."""
LARGEST_RATIO = 0.45
"""Curvature x half thickness up to which the curved-beam factor is followed while searching."""
BETWEEN = 1.5e-3
"""Added to the wanted gap, in R_c, for what lies between the points."""


@dataclass(frozen=True)
class Track:
    """The half in one state at the points; ``half`` is half the thickness."""

    x: Dual
    y: Dual
    half: Dual


@cache
def zones(points: int, count: int) -> Indices:
    """Points of each of ``count`` zones."""
    return zone_index(points, count)


def wanted_gap(case: OmegaCase) -> float:
    """At the points, so that it is kept between them too; in R_c."""
    return BETWEEN + case.min_gap / case.enclosure_radius


def at_points(part: Dual) -> Dual:
    """From the nodes to the points."""
    return part.mapped(basis().at_points)


def tracks(half: Half, states: States) -> tuple[Track, Track, Track]:
    """The half at rest, at +u and at -u."""
    thick = 0.5 * at_points(half.thickness)
    pairs = ((half.x, half.y), (states.plus.x, states.plus.y), (states.minus.x, states.minus.y))
    rest, plus, minus = (Track(at_points(x), at_points(y), thick) for x, y in pairs)
    return rest, plus, minus


def smallest(margin: Dual) -> Dual:
    """The smallest margin of each zone."""
    return margin[zone_minimum(margin.value, zones(POINTS, ZONES))]


@cache
def _factor() -> tuple[Chebyshev, Chebyshev]:
    domain = [-LARGEST_RATIO, LARGEST_RATIO]
    fit = Chebyshev.interpolate(curved_beam_factor, 20, domain=domain)
    return fit, fit.deriv()


def bend_factor(ratio: Dual) -> Dual:
    """The curved-beam factor K of half thickness x curvature.

    The formula of the inner edge holds with a negative ratio for the outer one.
    """
    value, slope = _factor()
    inside = np.clip(ratio.value, -LARGEST_RATIO, LARGEST_RATIO)
    if not ratio.gradient.shape[1]:
        return Dual(value(inside), ratio.gradient)
    return ratio.through(value(inside), np.where(inside == ratio.value, slope(inside), 0.0))


def stress_rows(case: OmegaCase, half: Half, states: list[HalfState]) -> Dual:
    """1 - stress / allowable of each state, smallest of each zone.

    At both edges and with both signs of the axial force: the largest of the four would have kinks
    where the leaf is straight or carries no axial force, and the best leaves are so for its sake.
    """
    index = zones(STRESS_POINTS, STRESS_ZONES)
    rows: list[Dual] = []
    for state in states:
        every = _stress_margins(case, half.bare, state.bare, slice(None))
        where = np.concatenate([zone_minimum(margin.value, index) for margin in every])
        count = len(where) // len(every)
        chosen = _stress_margins(case, half, state, where)
        rows.extend(margin[slice(k * count, (k + 1) * count)] for k, margin in enumerate(chosen))
    return dual.stacked(rows)


def _stress_margins(
    case: OmegaCase, half: Half, state: HalfState, where: Indices | slice
) -> tuple[Dual, ...]:
    """1 - stress / allowable at some of the stress points, for each edge and sign of the force.

    The edges of a tapered leaf lie at the angle h'/2 to its line, and the stress along them is
    larger by 1/cos^2 of it.
    """
    maps = basis().at_stress_points[where]
    slope = 0.5 * half.stress_taper[where]
    along = (case.elastic_modulus / case.allowable_stress) * (1.0 + slope * slope)
    thick = half.thickness.mapped(maps)
    ratio = 0.5 * (thick * half.stress_bend[where])
    bending = 6.0 * along * dual.absolute(state.moment.mapped(maps)) * dual.power(thick, -2.0)
    direct = along * state.tension.mapped(maps) * dual.power(thick, -1.0)
    edges = [1.0 - bending * bend_factor(side) for side in (ratio, -ratio)]
    return tuple(edge - part for edge in edges for part in (direct, -direct))


def bend_rows(case: OmegaCase, half: Half) -> Dual:
    """Bend limit less |curvature| x thickness."""
    return smallest(case.bend_limit - dual.absolute(half.bend * at_points(half.thickness)))


def taper_rows(case: OmegaCase, half: Half) -> Dual:
    """Taper limit less |dh/ds|."""
    return dual.stacked([case.taper_limit - half.taper, case.taper_limit + half.taper])


def one_sided_rows(half: Half) -> Dual:
    """The angle falls from coefficient to coefficient, and so everywhere: a convex half."""
    return -half.turns


def foot_row(half: Half) -> Dual:
    """Cosine of the angle at which the leaf meets the wall, from the radius, less the least one."""
    along = half.end_x * dual.cos(half.end_angle) + half.end_y * dual.sin(half.end_angle)
    radius = dual.power(half.end_x * half.end_x + half.end_y * half.end_y, -0.5)
    return along * radius - MEETING


def wall_rows(case: OmegaCase, half: Half, track: Track) -> Dual:
    """Gap to the wall less the wanted one, which closes towards the clamp."""
    gap = wanted_gap(case)
    left = half.length * (CLOSING * (1.0 - basis().points))
    closing = left.value < gap
    wanted = left.through(np.where(closing, left.value, gap), np.where(closing, 1.0, 0.0))
    radius = dual.power(track.x * track.x + track.y * track.y, 0.5)
    return smallest(1.0 - radius - track.half - wanted)


def corridor_rows(case: OmegaCase, half: Half, track: Track, side: float) -> Dual:
    """Gap to the lever's corridor less the wanted one, at the hub's displacement ``side`` u.

    The right half sees the corridor's right edge where the lever of one of the two arms brings it
    farthest to the right; beside the round end the distance is that to the circle.
    """
    unit = case.enclosure_radius
    gap, width = wanted_gap(case), case.corridor / unit
    arm = (case.arms[1] if side > 0.0 else case.arms[0]) / unit
    depth = half.middle - track.y
    reach = side * case.stroke / unit * (1.0 - depth * (1.0 / arm))
    beside = track.x - _where(reach.value * side > 0.0, reach)
    above = _where(depth.value < width, width - depth)
    round_ = dual.power(beside * beside + above * above, 0.5)
    inside = beside.value < 0.0
    distance = Dual(
        np.where(inside, beside.value + above.value, round_.value),
        np.where(inside[:, None], beside.gradient + above.gradient, round_.gradient),
    )
    return smallest(distance - track.half - (0.5 * width + gap))


def _where(holds: NDArray[np.bool_], part: Dual) -> Dual:
    """The part where it holds, else 0."""
    return part.through(np.where(holds, part.value, 0.0), np.where(holds, 1.0, 0.0))
