"""Parts drawn at random within what a shop holds, and the share of them that comes out right.

Every part goes through the response surface; the forward analysis at the corners of the bounds says
how far to trust it. The four deviations are independent of each other.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.as_made import Deviation
from springcad.kinds.rotary_flexure.response_surface import (
    Figures,
    ResponseSurface,
    figures_as_made,
)
from springcad.kinds.rotary_flexure.tolerance_spec import Tolerance
from springcad.optimise.random import uniform

Floats = NDArray[np.float64]

AT_ONCE = 500
"""So many parts are computed at a time, to bound the memory."""
SIGMAS = 3.0
"""Standard deviations of a normal distribution at each bound."""
_DIGITS = 6
_HALF_STEP = 2.0**-54
"""Half the spacing of the uniform numbers: none of them is then at the end of a distribution."""


@dataclass(frozen=True)
class Parts:
    """Parts drawn at random.

    Attributes:
        figures: of each (S,).
        variance: of each figure when one deviation alone varies, for each deviation by its name.
        surface_error: largest difference of the response surface from the forward analysis at the
            corners of the bounds, as a share of the nominal stiffness, stresses or gap; nan where a
            part at a corner cannot be analysed.
    """

    figures: Figures
    variance: Mapping[str, Figures]
    surface_error: float


def bounds(tolerance: Tolerance) -> Deviation:
    """Plus or minus, of each deviation."""
    return Deviation(*(getattr(tolerance, name) for name in Deviation._fields))


def drawn(tolerance: Tolerance) -> Deviation:
    """Deviations of as many parts as wanted, arrays (S,)."""
    columns = []
    for stream, bound in enumerate(bounds(tolerance)):
        share = uniform(tolerance.seed, stream, tolerance.samples) + _HALF_STEP
        unit = ndtri(share) / SIGMAS if tolerance.distribution == "normal" else 2.0 * share - 1.0
        columns.append(bound * unit)
    return Deviation(*columns)


def drawn_parts(surface: ResponseSurface, tolerance: Tolerance) -> Parts:
    """All of them through the response surface."""
    every = drawn(tolerance)
    alone = {name: Deviation(**{name: getattr(every, name)}) for name in Deviation._fields}
    variance = {name: _variances(_through(surface, one)) for name, one in alone.items()}
    return Parts(_through(surface, every), variance, _error(surface, tolerance))


def _variances(figures: Figures) -> Figures:
    return Figures(*(np.asarray(np.var(values)) for values in figures))


def _through(surface: ResponseSurface, deviation: Deviation) -> Figures:
    each = np.broadcast_arrays(*np.atleast_1d(*deviation))
    pieces = [
        surface.at(Deviation(*(column[i : i + AT_ONCE] for column in each)))
        for i in range(0, len(each[0]), AT_ONCE)
    ]
    return Figures(*(np.concatenate(column) for column in zip(*pieces, strict=True)))


def _error(surface: ResponseSurface, tolerance: Tolerance) -> float:
    """See ``Parts.surface_error``. Thickness and modulus are left out: there it is exact."""
    limit = bounds(tolerance)
    offsets, radii = ({-float(b), float(b)} for b in (limit.edge_offset, limit.contact_radius))
    largest, nominal = 0.0, surface.at(Deviation())
    for offset, radius in product(sorted(offsets), sorted(radii)):
        corner = Deviation(edge_offset=offset, contact_radius=radius)
        try:
            exact = figures_as_made(surface.spring, corner)
        except (ArithmeticError, InfeasibleError, ValueError):
            return math.nan
        differences = [
            abs(float(near[0] - there) / float(at_all[0]))
            for near, there, at_all in zip(surface.at(corner), exact, nominal, strict=True)
            if at_all[0] > 0.0
        ]
        largest = max(largest, *differences)
    return largest


@dataclass(frozen=True)
class Share:
    """Of the parts for which something holds, and the standard error of this share."""

    value: float
    error: float


def share_of(holds: NDArray[np.bool_]) -> Share:
    """Binomial; the error is that of one more part of either kind, so that it is never 0."""
    count, yes = len(holds), int(np.count_nonzero(holds))
    likely = (yes + 1) / (count + 2)
    return Share(yes / count, math.sqrt(likely * (1.0 - likely) / count))


def variance_shares(parts: Parts, figure: str) -> dict[str, float]:
    """Of each deviation: the variance that it alone gives the figure, over the sum of all four.

    Zeros where the figure does not vary. For a figure that is linear in the deviations the sum is
    its variance, and these are the first-order indices of Sobol'.
    """
    alone = {name: float(getattr(each, figure)) for name, each in parts.variance.items()}
    total = sum(alone.values())
    return {
        name: round(variance / total, _DIGITS) if total > 0.0 else 0.0
        for name, variance in alone.items()
    }


def dominant(shares: Mapping[str, float]) -> str | None:
    """The deviation with the largest share of the variance; None where nothing varies."""
    largest = max(shares, key=shares.__getitem__)
    return largest if shares[largest] > 0.0 else None
