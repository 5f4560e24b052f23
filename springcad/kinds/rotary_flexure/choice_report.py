"""What a report says of a choice: the winner, its limit, the bound, and what else was looked at."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from springcad.kinds.rotary_flexure.aim import Pair
from springcad.kinds.rotary_flexure.candidates import rounded_up
from springcad.kinds.rotary_flexure.choosing import Choice, Design, Stop
from springcad.kinds.rotary_flexure.feasibility import failures
from springcad.kinds.rotary_flexure.numbers import bound_of
from springcad.kinds.rotary_flexure.rim import rim_check
from springcad.result import Result, Value

NEXT = 1.02
"""Contact radii and counts next to the chosen ones, of which it is said what forbids them."""
_UNITS = {"deflection": "rad", "margin": "1", "diameter": "m", "mass": "1"}
_SHOWN = {"m": (1e3, "mm"), "Pa": (1e-6, "MPa"), "rad": (180.0 / math.pi, "deg")}


def with_choice(result: Result, choice: Choice) -> Result:
    """The report of the chosen spring with what was chosen, and why."""
    checks = result.checks
    if isinstance(choice.aim.spec.envelope.outer_radius, str):
        checks = (*checks, rim_check(choice.spring))
    return replace(
        result,
        design={**result.design, "choice": choice_numbers(choice)},
        checks=checks,
        advice=(*_words(choice), *result.advice),
    )


def choice_numbers(choice: Choice) -> Mapping[str, Value]:
    """The section ``design.choice`` of the report, SI."""
    aim = choice.aim
    counts, radii = (
        [float(c.pair.count) for c in choice.allowed],
        [c.pair.contact_radius for c in choice.allowed],
    )
    return {
        "objective": aim.objective,
        "unit": _UNITS[aim.objective],
        "value": aim.value(choice.level),
        "closed_form_bound": aim.value(choice.bound),
        "stopped_by": None if choice.stop is None else _stop_numbers(choice.stop),
        "next_rings_forbidden_by": list(_fences(choice)),
        "allowed": {
            "rings": len(choice.allowed),
            "flexure_count": np.array([min(counts), max(counts)]),
            "contact_radius_m": np.array([min(radii), max(radii)]),
        },
        "considered": {
            "flexure_count": np.array([float(s.pair.count) for s in choice.considered]),
            "contact_radius_m": np.array([s.pair.contact_radius for s in choice.considered]),
            "law_value": np.array([_between(choice, s.level) for s in choice.considered]),
        },
        "designs": [_design_numbers(choice, design) for design in choice.designs],
    }


def _between(choice: Choice, level: float) -> float:
    low = math.floor(level)
    return float(np.interp(level, [low, low + 1], [choice.aim.value(n) for n in (low, low + 1)]))


def _design_numbers(choice: Choice, design: Design) -> Mapping[str, Value]:
    return {
        "flexure_count": design.pair.count,
        "contact_radius_m": design.pair.contact_radius,
        "value": choice.aim.value(design.level),
        "stopped_by": None if design.stop is None else _stop_numbers(design.stop),
    }


def _stop_numbers(stop: Stop) -> Mapping[str, Value]:
    return {"claim": stop.claim, "value": stop.value, "limit": stop.limit, "unit": stop.unit}


def _fences(choice: Choice) -> Iterator[str]:
    """What closed forms say of a smaller contact radius and of one flexure more."""
    spec, pair = choice.aim.spec, choice.pair
    if isinstance(spec.envelope.contact_radius, str):
        smaller = Pair(pair.count, rounded_up(pair.contact_radius / NEXT))
        yield from _fence(choice, smaller, "a smaller contact radius")
    if isinstance(spec.flexures.count, str):
        yield from _fence(choice, Pair(pair.count + 1, pair.contact_radius), "one flexure more")


def _fence(choice: Choice, pair: Pair, words: str) -> Iterator[str]:
    if failed := failures(choice.aim.at(pair, choice.level).case):
        yield f"{words}: {failed[0]}"


def _words(choice: Choice) -> Iterator[str]:
    aim, case = choice.aim, choice.spring.case
    yield (
        f"Chosen for {_goal(choice)}: {choice.pair}, outer radius {case.outer_radius * 1e3:.4g} mm,"
        f" {choice.spring.found.style} flexures; of {len(choice.allowed)} rings within the closed "
        f"forms, {len(choice.considered)} searched for shapes, {len(choice.designs)} designed."
    )
    if aim.objective == "margin":
        yield (
            f"The limits in the checks are tightened by the margin of {aim.value(choice.level):.0%}: "
            "stresses and yield divided, gaps and the tooth multiplied by it."
        )
    if choice.stop is not None:
        yield f"{_next(choice)} it is stopped by: {_stop_words(choice.stop)}."
    fences = list(_fences(choice))
    if fences:
        yield f"What forbids the rings next to it: {'; '.join(fences)}."
    share = choice.spring.law.inputs.deflection / bound_of(choice.spring)
    if aim.objective == "deflection":
        yield f"Closed forms would allow this ring {_shown(aim.value(choice.bound), 'rad')} ({share:.0%} of a full disk is reached)."


def _goal(choice: Choice) -> str:
    aim, value = choice.aim, choice.aim.value(choice.level)
    if aim.objective == "deflection":
        return f"the largest deflection, {_shown(value, 'rad')}"
    if aim.objective == "diameter":
        return f"the least diameter, root radius {_shown(value, 'm')}"
    if aim.objective == "margin":
        return f"the largest margin, {value:.0%} to every limit that the choice can move"
    return f"the least mass, ring {choice.spring.mass * 1e3:.4g} g"


def _next(choice: Choice) -> str:
    above = min(
        d.level for d in choice.designs if d.pair == choice.pair and d.level > choice.level
    )
    value = choice.aim.value(above)
    shown = f"{value:.0%}" if choice.aim.objective == "margin" else None
    return f"At {shown or _shown(value, _UNITS[choice.aim.objective])}"


def _stop_words(stop: Stop) -> str:
    value, limit = _shown(stop.value, stop.unit), _shown(stop.limit, stop.unit)
    return f"{stop.claim} ({value}; limit {limit})"


def _shown(value: float, unit: str) -> str:
    scale, name = _SHOWN.get(unit, (1.0, "" if unit == "1" else unit))
    return f"{value * scale:.4g} {name}".rstrip()
