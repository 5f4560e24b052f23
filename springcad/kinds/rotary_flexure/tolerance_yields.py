"""What a report says of the share of parts that come out as wanted."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from springcad.kinds.rotary_flexure.checks import DEFORMED_GAP, STRESS_TOLERANCE
from springcad.kinds.rotary_flexure.response_surface import ResponseSurface
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.tolerance import (
    SIGMAS,
    Parts,
    Share,
    dominant,
    drawn_parts,
    share_of,
    variance_shares,
)
from springcad.kinds.rotary_flexure.tolerance_spec import Tolerance
from springcad.result import Outcome, Plot, Result, Series, Value

NAMES = {
    "sheet_thickness": "thickness of the sheet",
    "edge_offset": "offset of the cut edges",
    "contact_radius": "radius of the camshaft's flanks",
    "modulus": "elastic modulus",
}
"""Deviations in words."""
QUANTILES = (0.01, 0.5, 0.99)
"""Shares of the parts that lie below the values of a figure that are told."""
_UNITS = {
    "stiffness_at_rest": "Nm_per_rad",
    "stiffness": "Nm_per_rad",
    "stress": "Pa",
    "root_fillet_stress": "Pa",
    "gap": "m",
    "backlash": "m",
}


@dataclass(frozen=True)
class _Yields:
    """Shares of the parts that are right in one respect, and in all."""

    stiffness: Share
    stress: Share
    gap: Share
    backlash: Share
    all: Share


def _yields(spring: Spring, parts: Parts, tolerance: Tolerance) -> _Yields:
    found = parts.figures
    wanted = spring.law.torque / spring.target.deflection
    allowed = (1.0 + STRESS_TOLERANCE) * spring.law.inputs.design_stress
    each = (
        np.abs(found.stiffness / wanted - 1.0) <= tolerance.stiffness,
        found.stress <= allowed,
        found.gap >= DEFORMED_GAP,
        found.backlash >= 0.0,
    )
    return _Yields(*(share_of(holds) for holds in (*each, np.logical_and.reduce(each))))


def with_parts(result: Result, surface: ResponseSurface, tolerance: Tolerance) -> Result:
    """``result`` with what parts drawn at random within the tolerance do."""
    spring, parts = surface.spring, drawn_parts(surface, tolerance)
    yields = _yields(spring, parts, tolerance)
    return replace(
        result,
        response={**result.response, "tolerance": _numbers(parts, yields)},
        outcomes=(*result.outcomes, *_outcomes(parts, yields, tolerance)),
        plots=(*result.plots, _distribution(parts)),
        assumptions=(*result.assumptions, *_assumptions(parts, tolerance)),
        advice=(*result.advice, *_advice(spring, parts, yields, tolerance)),
    )


def _numbers(parts: Parts, yields: _Yields) -> dict[str, Value]:
    """For programs."""
    shares = {figure: variance_shares(parts, figure) for figure in _UNITS}
    return {
        **{
            f"share_{name}": {"value": share.value, "standard_error": share.error}
            for name, share in vars(yields).items()
        },
        "quantiles": np.array(QUANTILES),
        **{
            f"{figure}_{unit}": np.quantile(getattr(parts.figures, figure), QUANTILES)
            for figure, unit in _UNITS.items()
        },
        "variance_share": {figure: dict(of_each) for figure, of_each in shares.items()},
        "dominant": {figure: dominant(of_each) for figure, of_each in shares.items()},
        "surface_error": parts.surface_error,
    }


def _outcomes(parts: Parts, yields: _Yields, tolerance: Tolerance) -> Iterator[Outcome]:
    """The shares, and the stress that nearly all parts stay below."""
    for label, share in (
        (f"parts within {100.0 * tolerance.stiffness:g} % of the stiffness", yields.stiffness),
        ("parts within the design stress", yields.stress),
        ("parts whose deformed flexures stay apart", yields.gap),
        ("parts that fit without force", yields.backlash),
        ("parts right in all of this", yields.all),
    ):
        note = f"of {tolerance.samples}, standard error {share.error:.2%}"
        yield Outcome(label, share.value, "1", None, note)
    stress = float(np.quantile(parts.figures.stress, QUANTILES[-1]))
    yield Outcome("stress that 99 % of the parts stay below", stress, "Pa")


def _distribution(parts: Parts) -> Plot:
    shares = np.linspace(0.005, 0.995, 100)
    return Plot("Secant stiffness of the parts", "stiffness", "N*m/rad", "share of parts below",
                "1", (Series("parts", np.quantile(parts.figures.stiffness, shares), shares),),
                )  # fmt: skip


def _assumptions(parts: Parts, tolerance: Tolerance) -> Iterator[str]:
    how = (
        f"normal distribution, {SIGMAS:g} standard deviations at each bound"
        if tolerance.distribution == "normal"
        else "even distribution between the bounds"
    )
    yield (
        f"Tolerances: {how}, each deviation independent of the others, the same offset at every "
        "edge of ring and camshaft (cut in one go), all flexures of a ring alike."
    )
    if math.isnan(parts.surface_error):
        yield (
            "At the corners of the tolerances flexures leave the flanks of the camshaft or a "
            "fillet is gone: what is told of such parts is extrapolated."
        )
    else:
        yield (
            f"At the corners of the tolerances the response surface is within "
            f"{parts.surface_error:.2%} of the forward analysis."
        )


def _advice(spring: Spring, parts: Parts, yields: _Yields, tolerance: Tolerance) -> Iterator[str]:
    for figure in ("stiffness", "stress", "gap"):
        shares = variance_shares(parts, figure)
        name = dominant(shares)
        if name is not None:
            yield f"Dominant for the {figure}: {NAMES[name]}, {shares[name]:.0%} of its variance."
    backlash = math.ceil(4e5 * tolerance.edge_offset - 1e-6) / 1e2
    if yields.backlash.value < 1.0 and 1e-3 * backlash > spring.camshaft_inputs.backlash:
        yield (
            f"{1.0 - yields.backlash.value:.1%} of the parts are tighter than their slots: with "
            f"camshaft.backlash: {backlash:g} mm every one within tolerance.edge_offset fits."
        )
    stress = float(np.quantile(parts.figures.stress, QUANTILES[-1]))
    more = stress / spring.law.inputs.design_stress - 1.0
    if more > STRESS_TOLERANCE:
        yield (
            f"99 % of the parts stay within {more:+.1%} of material.design_stress. Where it must "
            "hold for them too, give one that is lower by as much."
        )
