"""What the shape of a serpentine flexure must meet, however its centre line is described."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.mechanics.section import curved_beam_factor

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Correction:
    """What the spring at full load asks of the law's taper, which is one of small deflections.

    Attributes:
        lever: x of the contact at full load, m; the law's taper ends there.
        pad_length: of the straight tip, m; before it the corrected law is thicker than the tip.
        share: arc length over that of the curved part, ascending from 0 to 1 (K,).
        factor: on the law's half thickness there (K,).
    """

    lever: float
    pad_length: float
    share: Floats
    factor: Floats

    @cached_property
    def at(self) -> CubicSpline:
        """The factor over the share of the arc length."""
        return CubicSpline(self.share, self.factor)


@dataclass(frozen=True)
class FlexureProblem:
    """Requirements on one flexure between its neighbours, SI.

    Attributes:
        span: radial length L from root to contact, R - r.
        root_radius: R, where the flexures leave the rim.
        count: number of flexures n in the ring.
        root_half_thickness: half thickness lambda_r of the design law at the root (004, Eq. 2).
        tip_half_thickness: smallest half thickness; the law is cut off there.
        serpentine_factor: effective f_s to reach, integral of lambda0^4/lambda^3 over that of the
            straight law.
        bend_limit: largest half thickness x curvature z; below 1 the edges cannot fold over.
        max_root_angle: largest angle between the centre line and the radius at the root, rad.
        local_stress: thicken the bends so that the inner-fibre stress, not the nominal one, equals
            the design stress.
        correction: of the law's taper; None for the law itself, with the contact at the span.
        gap_allowance: by how much more than the smallest gap the neighbours must be apart at rest,
            in each tenth of the arc length, m (10,); none where None.
    """

    span: float
    root_radius: float
    count: int
    root_half_thickness: float
    tip_half_thickness: float
    serpentine_factor: float
    bend_limit: float
    max_root_angle: float = 0.5
    local_stress: bool = False
    correction: Correction | None = None
    gap_allowance: Floats | None = None

    @property
    def pitch(self) -> float:
        """Angle between neighbours, rad."""
        return 2.0 * math.pi / self.count

    @property
    def lever(self) -> float:
        """Distance x from the root to the contact at full load, where the taper ends."""
        return self.span if self.correction is None else self.correction.lever

    @property
    def pad_length(self) -> float:
        """Length of the straight tip where the law is thinner than the tip may be."""
        if self.correction is None:
            return self.span * (self.tip_half_thickness / self.root_half_thickness) ** 2
        return self.correction.pad_length

    def factor(self, share: Floats) -> Floats:
        """Factor on the law's half thickness at shares of the curved arc length."""
        if self.correction is None:
            return np.ones_like(share)
        return np.asarray(self.correction.at(share))

    def allowance(self, share: Floats) -> Floats:
        """Gap allowance at shares of the curved arc length, m."""
        if self.gap_allowance is None:
            return np.zeros_like(share)
        tenth = (np.arange(len(self.gap_allowance)) + 0.5) / len(self.gap_allowance)
        return np.interp(share, tenth, self.gap_allowance)


def pad_energy(flexure: FlexureProblem) -> float:
    """The straight pad's share of integral lambda0^4/lambda^3 ds over lambda_r, m."""
    loaded = flexure.lever - flexure.span + flexure.pad_length
    if loaded == 0.0:
        return 0.0
    tip = flexure.tip_half_thickness / flexure.root_half_thickness
    return loaded**3 / (3.0 * flexure.lever**2 * tip**3)


def thickened(flexure: FlexureProblem, factor: float, shift: float = 0.0) -> FlexureProblem:
    """The problem with the law's half thickness times ``factor`` everywhere.

    ``shift`` is by how much the taper ends before the span.
    """
    tip = flexure.tip_half_thickness / (factor * flexure.root_half_thickness)
    ends, lever = np.array([0.0, 1.0]), flexure.span - shift
    uniform = Correction(lever, shift + lever * tip**2, ends, np.full(2, factor))
    return replace(flexure, correction=uniform)


LARGEST_LOCAL_BEND = 0.6
"""Bends are thickened for their inner fibre up to this half thickness x curvature."""


@cache
def _thickening() -> CubicSpline:
    z = np.linspace(0.0, LARGEST_LOCAL_BEND, 121)
    factor = np.sqrt(curved_beam_factor(z))
    return CubicSpline(z / factor, factor)


SOFT_BEND = 0.03
"""Bends count as at least this sharp, smoothly: the thickness has no kink where the curvature
changes sign, at the price of 2 % less stress there."""


def bend_thickening(law_bend: Floats) -> tuple[Floats, Floats]:
    """Factor w on the law's half thickness that brings the inner fibre down to the design stress.

    With z0 = lambda0 kappa (``law_bend``, of either sign) the inner-fibre stress of a bend w times
    as thick is K(w |z0|) / w^2 of the design stress, so w^2 = K(w |z0|). Interpolated to 1e-7 up to
    ``LARGEST_LOCAL_BEND``; held constant beyond it, where a bend limit must keep designs away.

    Returns:
        w and dw/dz0, each of the shape of ``law_bend``.
    """
    spline = _thickening()
    end = float(spline.x[-1])
    soft = np.sqrt(law_bend**2 + SOFT_BEND**2)
    clipped = np.minimum(soft, end)
    return spline(clipped), np.where(soft < end, spline(clipped, 1), 0.0) * law_bend / soft
