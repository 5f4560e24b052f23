"""What the shape of a serpentine flexure must meet, however its centre line is described."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.mechanics.section import curved_beam_factor

Floats = NDArray[np.float64]


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

    @property
    def pitch(self) -> float:
        """Angle between neighbours, rad."""
        return 2.0 * math.pi / self.count

    @property
    def pad_length(self) -> float:
        """Length of the straight tip where the law is thinner than the tip may be."""
        return self.span * (self.tip_half_thickness / self.root_half_thickness) ** 2


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
