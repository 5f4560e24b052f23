"""Whether a conjugate profile can be made: it must not fold back nor be undercut by its mate."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.mechanics.conjugate import Flank

Floats = NDArray[np.float64]


def require_no_fold(flank: Flank) -> None:
    """The contact must run one way along the profile; where it turns round there is a cusp.

    On one side of a cusp the mate undercuts the profile: that side is the fold.

    Raises:
        InfeasibleError: it turns round.
    """
    turns = np.flatnonzero(np.diff(np.sign(flank.speed)))
    if not len(turns):
        return
    beside = turns[0] + np.arange(2)
    folded = beside[np.argmin(flank.relative_curvature[beside])]
    speed = -np.sign(flank.speed[folded]) * flank.speed
    claim = (
        "speed of the contact along the profile, which folds back between "
        f"{_where_negative(flank.angle, speed)}: the law softens too abruptly for this mate"
    )
    raise InfeasibleError(claim, float(speed.min()), 0.0, "m/rad")


def require_no_undercut(flank: Flank, smallest_radius: float = 0.0) -> None:
    """Profile and mate must touch from outside, and the profile must not be too sharp.

    Args:
        smallest_radius: of curvature that a convex profile may have [m].

    Raises:
        InfeasibleError: the profile is hollower than its mate is round, or too sharp.
    """
    between = _where_negative(flank.angle, flank.relative_curvature)
    if between:
        worst = int(np.argmin(flank.relative_curvature))
        mate = flank.mate_curvature[worst]
        other = f"round with one of {1e3 / mate:.4g} mm" if mate > 0.0 else "flat"
        claim = (
            f"curvature of profile and mate together between {between}: the mate undercuts the "
            f"profile, hollow with a radius of {-1e3 * flank.radius[worst]:.4g} mm; the mate is "
            f"{other}"
        )
        raise InfeasibleError(claim, float(flank.relative_curvature[worst]), 0.0, "1/m")
    between = _where_negative(flank.angle, 1.0 - smallest_radius * flank.curvature)
    if between:
        sharpest = 1.0 / float(flank.curvature.max())
        claim = f"radius of curvature of the profile between {between}"
        raise InfeasibleError(claim, sharpest, smallest_radius, "m")


def _where_negative(angle: Floats, values: Floats) -> str:
    """The first interval in which values are <= 0, zeros interpolated; empty if there is none."""
    below = values <= 0.0
    if not below.any():
        return ""
    first = int(np.argmax(below))
    last = first + int(np.argmin(np.append(below[first:], False))) - 1
    ends = [_zero(angle, values, i, j) for i, j in ((first - 1, first), (last, last + 1))]
    return f"{np.degrees(ends[0]):.4g} and {np.degrees(ends[1]):.4g} deg"


def _zero(angle: Floats, values: Floats, i: int, j: int) -> float:
    """Where the values change sign between two rows; the row inside where there is no other."""
    if i < 0:
        return float(angle[j])
    if j == len(angle):
        return float(angle[i])
    return float(angle[i] + (angle[j] - angle[i]) * values[i] / (values[i] - values[j]))
