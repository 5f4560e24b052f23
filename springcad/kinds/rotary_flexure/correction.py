"""The design law corrected for what the flexure bears at full load.

The law of paper 004 is one of small deflections, shear and axial force left out, the contact fixed.
A section that bears the stress sigma in place of the allowed one gets sqrt(sigma/allowed) times its
half thickness, the larger stress of both directions counting; repeated, this is the stress-ratio
method of fully stressed design. It converges fast, since the moments hardly depend on thickness.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import LSQUnivariateSpline

from springcad.errors import InfeasibleError
from springcad.geometry.neighbours import neighbour_gaps, zone_index, zone_minimum
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.problem import Correction, FlexureProblem
from springcad.kinds.rotary_flexure.shape import law_half_thickness, straight_ribbon
from springcad.mechanics.beam import BeamStates, PreparedBeam
from springcad.mechanics.centre_line import deformed_points

Floats = NDArray[np.float64]

PAD_STATIONS = 9
APART = 0.01
"""The last place before the pad at which the factor follows the stress is so far from it, as a
share of the length: there it must meet the tip's thickness."""
CONTACT_ON_PAD = 2.0 / 7.0
"""The contact stays so far within the pad, over the tip's half thickness."""
EVERY = 2
"""Every so many of the beam's nodes there is a knot of the factor over the length."""
TENTHS = 10
GAP_POINTS = 121
_MADE = 2
"""Times that the level of straight flexures is corrected on the flexure that is made."""
_DIGITS = 8
"""Corrections are rounded far below any tolerance: another machine's last digits do not show."""


@dataclass(frozen=True)
class Loading:
    """What a flexure bears at full load, and how stiff it is, against what is wanted.

    Attributes:
        stations: from the root to the tip, m (K,).
        ratio: there, the larger stress of both directions over the allowed one (K,).
        lever: x of the contact under the load that stresses the start of the pad most, m.
        innermost: x of the contact nearest to the root, m.
        stiffness_ratio: stiffness at rest over the wanted one.
    """

    stations: Floats
    ratio: Floats
    lever: float
    innermost: float
    stiffness_ratio: float

    def unevenness(self, ribbon: Ribbon, level: float) -> float:
        """Largest deviation of the ratio from ``level`` before the pad, as a share."""
        before = self.stations <= ribbon.edges[-2]
        return float(np.max(np.abs(self.ratio[before] / level - 1.0)))


def loading(
    ribbon: Ribbon,
    states: Sequence[BeamStates],
    span: float,
    allowed: Floats,
    stiffness_ratio: float,
    *,
    local: bool,
) -> Loading:
    """How a flexure is used.

    Args:
        states: in both directions, L loads each; the last is full load.
        span: x of the end of the pad, m.
        allowed: stress at ``stations_of(ribbon, states)``, Pa (K,).
        local: whether the inner-fibre stress counts, not the nominal one.
    """
    stations = stations_of(ribbon, states)
    stress = np.array(
        [
            np.interp(stations, *load)
            for s in states
            for load in zip(s.stations, s.local_stress if local else s.nominal_stress, strict=True)
        ]
    )
    x = span - ribbon.length + np.concatenate([state.end_station for state in states])
    governing = int(stress[:, -PAD_STATIONS].argmax())
    return Loading(
        stations, stress.max(axis=0) / allowed, float(x[governing]), float(x.min()), stiffness_ratio
    )


def stations_of(ribbon: Ribbon, states: Sequence[BeamStates]) -> Floats:
    """The beam's nodes before the pad, and stations on the pad, where stress is linear."""
    nodes, start = states[0].stations[0], ribbon.edges[-2]
    pad = np.linspace(start, ribbon.length, PAD_STATIONS)
    return np.concatenate([np.unique(nodes[nodes < start]), pad])


def straight_level(problem: FlexureProblem, ribbon: Ribbon, load: Loading) -> float:
    """Stress ratio that a straight flexure has everywhere when it is as stiff as wanted.

    With the half thickness times sqrt(ratio/level) before the pad its compliance is level^1.5 times
    the integral of (lever - x)^2/(lambda^3 ratio^1.5), and that of the pad, which stays. The same
    of the flexure that is made, with a smooth factor and a pad that moves, corrects it: otherwise
    passes would settle beside the wanted stiffness, by 1 % under a law that stiffens tenfold.
    """
    ratio = np.interp(ribbon.grid.nodes, load.stations, load.ratio)
    now, evened, pad = (
        _compliance(problem, ribbon, load.lever, weight)
        for weight in (np.ones_like(ratio), ratio**-1.5, np.zeros_like(ratio))
    )
    wanted = now * load.stiffness_ratio
    level = ((wanted - pad) / (evened - pad)) ** (2.0 / 3.0)
    for _ in range(_MADE):
        made = corrected(problem, ribbon, load, level)
        there = straight_ribbon(made)
        compliance = _compliance(made, there, load.lever, np.ones_like(there.curvature))
        level *= ((wanted - pad) / (compliance - pad)) ** (2.0 / 3.0)
    return float(level)


def corrected(
    problem: FlexureProblem, ribbon: Ribbon, load: Loading, level: float
) -> FlexureProblem:
    """The problem whose flexure has the stress ratio ``level`` and the wanted stiffness.

    Args:
        problem: of which ``ribbon`` is a solution.
    """
    at = ribbon.at(load.stations)
    wanted = at.half_thickness * np.sqrt(load.ratio / level)
    lever = round(load.lever, _DIGITS)
    thin = ribbon.length - _reaches(load.stations, wanted, problem.tip_half_thickness)
    within = CONTACT_ON_PAD * problem.tip_half_thickness
    pad_length = round(max(thin, problem.span - load.innermost + within), _DIGITS)
    pad_start = ribbon.length - pad_length
    before = load.stations < (1.0 - APART) * pad_start
    # The law knows the correction by its lever alone.
    plain = replace(problem, correction=Correction(lever, pad_length, np.zeros(0), np.zeros(0)))
    law = law_half_thickness(plain, at.x[before], at.curvature[before])
    end = law_half_thickness(plain, np.array([problem.span - pad_length]), np.zeros(1))
    factor = np.append(wanted[before] / law, problem.tip_half_thickness / end)
    share = np.append(load.stations[before] / pad_start, 1.0)
    straight = 2.0 / 3.0 * lever**3 / problem.root_half_thickness**3
    compliance = _compliance(problem, ribbon, lever, np.ones_like(ribbon.curvature))
    return replace(
        problem,
        serpentine_factor=round(compliance / straight * load.stiffness_ratio, _DIGITS),
        correction=Correction(lever, pad_length, *_smooth(share, factor)),
    )


def _smooth(share: Floats, factor: Floats) -> tuple[Floats, Floats]:
    """Knots and, there, the cubic spline with these knots that is nearest to the factor.

    Where the direction that stresses the flexure more changes, or the curvature's sign, the factor
    has a kink; the thickness is to have none. The last value, the tip's thickness, is met.
    """
    knots = np.unique(np.append(share[:-EVERY:EVERY], [0.0, 1.0]))
    weight = np.append(np.ones(len(share) - 1), 100.0)
    spline = LSQUnivariateSpline(share, factor, knots[1:-1], weight)
    values = np.append(spline(knots[:-1]), factor[-1])
    return knots, np.asarray(np.round(values, _DIGITS))


def _compliance(problem: FlexureProblem, ribbon: Ribbon, lever: float, weight: Floats) -> float:
    """Integral of weight (lever - x)^2/lambda^3 ds, with weight (N,) at the ribbon's nodes.

    The pad counts in closed form, without the weight.
    """
    pad_start = ribbon.edges[-2]
    before = ribbon.grid.nodes < pad_start
    x = ribbon.at(ribbon.grid.nodes).x
    density = weight * np.maximum(lever - x, 0.0) ** 2 / ribbon.half_thickness**3
    loaded = lever - (problem.span - (ribbon.length - pad_start))
    pad = loaded**3 / (3.0 * problem.tip_half_thickness**3)
    return float(ribbon.grid.weights[before] @ density[before] + pad)


def _reaches(stations: Floats, half_thickness: Floats, tip: float) -> float:
    """Station beyond which the wanted half thickness is below that of the tip.

    Its square is linear there.

    Raises:
        InfeasibleError: it is so from the root on.
    """
    thick = np.flatnonzero(half_thickness > tip)
    if not len(thick):
        claim = "greatest thickness that stress and stiffness at full load ask for"
        there = 2.0 * float(half_thickness.max())
        remedy = "lower flexures.tip_thickness (not tried)"
        raise InfeasibleError(claim, there, 2.0 * tip, "m", (remedy,))
    last = int(thick[-1])
    if last == len(stations) - 1:
        return float(stations[-1])
    inner, outer = half_thickness[last] ** 2, half_thickness[last + 1] ** 2
    way = (inner - tip**2) / (inner - outer)
    return float(stations[last] + way * (stations[last + 1] - stations[last]))


def gap_allowance(
    ribbon: Ribbon, beam: PreparedBeam, states: Sequence[BeamStates], root_radius: float, count: int
) -> Floats:
    """By how much more neighbours come close at full load than at rest, per tenth of the length.

    Zero where they do not; the nearer of both directions (TENTHS,) [m].
    """
    stations = np.linspace(0.0, ribbon.edges[-2], GAP_POINTS)
    half, zones = ribbon.at(stations).half_thickness, zone_index(GAP_POINTS, TENTHS)

    def smallest(line: Floats) -> Floats:
        gap = neighbour_gaps(line[:, 0], line[:, 1], half, root_radius, count).gap
        smallest_of_each: Floats = gap[zone_minimum(gap, zones)]
        return smallest_of_each

    at_rest = ribbon.at(stations)
    bent = [smallest(deformed_points(beam, state, stations)[0][-1]) for state in states]
    rest = smallest(np.column_stack([at_rest.x, at_rest.y]))
    closer = np.maximum(rest - np.min(bent, axis=0), 0.0)
    return np.asarray(np.round(closer, _DIGITS))
