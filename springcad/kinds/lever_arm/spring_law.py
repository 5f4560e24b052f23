"""Force over deflection of the spring at the lever's end, as curves that fit together.

The law is that of the whole virtual spring of paper 000 (II-A): all leaves together, in both
directions. Force, stiffness and energy come from one interpolant, so that the energy balance of
the mechanism holds to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Curve = Callable[[Floats], Floats]


@dataclass(frozen=True)
class SpringLaw:
    """Curves over the signed deflection s of arrays of any shape; both directions.

    Attributes:
        deflection: largest magnitude of s for which the law is known [m].
        force: F(s) [N], with the sign of s.
        stiffness: dF/ds [N/m].
        energy: the integral of F from 0 [J].
    """

    deflection: float
    force: Curve
    stiffness: Curve
    energy: Curve

    @property
    def secant_stiffness(self) -> float:
        """Force over deflection at the largest deflection, mean of both directions [N/m]."""
        ends = self.force(np.array([-self.deflection, self.deflection]))
        return float(ends[1] - ends[0]) / (2.0 * self.deflection)


def linear_law(stiffness: float, deflection: float) -> SpringLaw:
    """F = k s, as paper 000 takes it (Eq. 2)."""
    return SpringLaw(
        deflection=deflection,
        force=lambda s: stiffness * s,
        stiffness=lambda s: np.full_like(s, stiffness),
        energy=lambda s: 0.5 * stiffness * s**2,
    )


def spring_law(deflection: Floats, force: Floats) -> SpringLaw:
    """The cubic spline through M >= 4 states, ascending from -s_max to s_max with 0 among them.

    Slopes and energy are those of the spline.
    """
    from scipy.interpolate import CubicSpline  # what a check of a spec does not need

    curve = CubicSpline(deflection, force)
    slope, integral = curve.derivative(), curve.antiderivative()
    at_rest = float(integral(0.0))
    return SpringLaw(
        deflection=float(deflection[-1]),
        force=lambda s: np.asarray(curve(s)),
        stiffness=lambda s: np.asarray(slope(s)),
        energy=lambda s: np.asarray(integral(s)) - at_rest,
    )
