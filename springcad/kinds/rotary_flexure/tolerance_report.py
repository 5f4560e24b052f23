"""How a report tells what parts do that come out other than drawn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.as_made import Deviation
from springcad.kinds.rotary_flexure.response_surface import (
    STEP,
    Figures,
    ResponseSurface,
    response_surface,
)
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.tolerance_yields import NAMES, with_parts
from springcad.result import Plot, Result, Series, Value

STEPS = Deviation(STEP, STEP, STEP, 0.01)
"""For which the sensitivities are told: three lengths (m) and a share."""
_SHARE_DIGITS, _LENGTH_DIGITS = 7, 11
_LENGTHS = ("gap", "backlash")


def with_tolerance(result: Result, spring: Spring) -> Result:
    """``result`` with its sensitivities, and with the share of good parts where that is asked for.

    A spring whose forward analysis fails a step beside the drawing has none, and says so.
    """
    try:
        surface = response_surface(spring)
    except (ArithmeticError, InfeasibleError, ValueError) as error:
        note = (
            "Sensitivities to tolerances are not known: the forward analysis fails "
            f"{STEP * 1e6:g} um off the drawing ({error})."
        )
        return replace(
            result,
            response={**result.response, "sensitivity": None},
            assumptions=(*result.assumptions, note),
        )
    told = replace(
        result,
        response={**result.response, "sensitivity": _sensitivities(surface)},
        plots=(*result.plots, _spider(surface)),
        advice=(*result.advice, _sensitivity_words(surface)),
    )
    tolerance = spring.spec.tolerance
    return told if tolerance is None else with_parts(told, surface, tolerance)


def _sensitivities(surface: ResponseSurface) -> dict[str, Value]:
    """Changes of each figure for one step down and one step up of each deviation."""
    nominal = surface.at(Deviation())
    told: dict[str, Value] = {}
    for name, step in STEPS._asdict().items():
        down, up = (surface.at(Deviation(**{name: sign * step})) for sign in (-1.0, 1.0))
        told[name] = {
            "step" if name == "modulus" else "step_m": step,
            **{
                f"{figure}_{'m' if figure in _LENGTHS else 'share'}": [
                    _change(figure, getattr(side, figure)[0], getattr(nominal, figure)[0])
                    for side in (down, up)
                ]
                for figure in Figures._fields
            },
        }
    return told


def _change(figure: str, value: float, nominal: float) -> float:
    """Of a length in metres, of anything else as a share; without the digits of round-off."""
    if figure in _LENGTHS:
        return round(float(value - nominal), _LENGTH_DIGITS)
    return round(float(value / nominal - 1.0), _SHARE_DIGITS)


def _sensitivity_words(surface: ResponseSurface) -> str:
    nominal = surface.at(Deviation()).stiffness[0]
    sheet, edges, flanks = (
        surface.at(Deviation(**{name: STEP})).stiffness[0] / nominal - 1.0
        for name in Deviation._fields[:3]
    )
    return (
        f"{STEP * 1e6:g} um more change the secant stiffness by {sheet:+.2%} (sheet), "
        f"{edges:+.2%} (left on at every cut edge of both parts) and {flanks:+.2%} (radius of the "
        "camshaft's flanks); it goes with the modulus."
    )


def _spider(surface: ResponseSurface) -> Plot:
    steps = np.linspace(-STEP, STEP, 21)
    nominal = surface.at(Deviation()).stiffness
    series = tuple(
        Series(NAMES[name], steps, surface.at(Deviation(**{name: steps})).stiffness / nominal)
        for name in Deviation._fields[:3]
    )
    return Plot("Secant stiffness of parts off the drawing", "deviation", "m",
                "stiffness over the nominal", "1", series)  # fmt: skip
