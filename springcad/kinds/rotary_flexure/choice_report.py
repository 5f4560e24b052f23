"""What a report says of a choice: the winner, its limit, the bound, and what else was looked at."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from springcad.kinds.rotary_flexure.aim import Pair
from springcad.kinds.rotary_flexure.candidates import forbidden, rounded_up
from springcad.kinds.rotary_flexure.choosing import Choice
from springcad.kinds.rotary_flexure.numbers import bound_of
from springcad.kinds.rotary_flexure.rim import rim_check
from springcad.kinds.rotary_flexure.tried import Design, Stop
from springcad.result import Result, Value

NEXT = 1.02
"""A contact radius so much smaller is said to be forbidden, or not."""
_UNITS = {"deflection": "rad", "margin": "1", "diameter": "m", "mass": "kg"}
_SHOWN = {"m": (1e3, " mm"), "Pa": (1e-6, " MPa"), "rad": (180.0 / math.pi, " deg"), "1": (1.0, "")}


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
    aim, considered = choice.aim, choice.considered
    counts = [float(ring.pair.count) for ring in choice.allowed]
    radii = [ring.pair.contact_radius for ring in choice.allowed]
    is_mass = aim.objective == "mass"
    return {
        "objective": aim.objective,
        "unit": _UNITS[aim.objective],
        "value": choice.spring.mass if is_mass else aim.value(choice.level),
        "closed_form_bound": None if is_mass else aim.value(choice.bound),
        "stopped_by": _stop_numbers(choice.next),
        "next_rings_forbidden_by": list(_fences(choice)),
        "allowed_rings": len(choice.allowed),
        "allowed_flexure_count": np.array([min(counts), max(counts)]),
        "allowed_contact_radius_m": np.array([min(radii), max(radii)]),
        "considered_flexure_count": np.array([float(ring.pair.count) for ring in considered]),
        "considered_contact_radius_m": np.array([ring.pair.contact_radius for ring in considered]),
        "considered_value": np.array([_between(choice, ring.level) for ring in considered]),
        "designs": [
            {
                "flexure_count": design.pair.count,
                "contact_radius_m": design.pair.contact_radius,
                "value": _value(choice, design),
                "stopped_by": _stop_numbers(design),
            }
            for design in choice.designs
        ],
    }


def _between(choice: Choice, level: float) -> float:
    """What a level between two steps stands for; not a number for the mass, which has one level."""
    low = math.floor(level)
    ends = [
        math.nan if choice.aim.objective == "mass" else choice.aim.value(low + n) for n in (0, 1)
    ]
    return float(np.interp(level, [low, low + 1], ends))


def _value(choice: Choice, design: Design) -> float | None:
    if choice.aim.objective != "mass":
        return choice.aim.value(design.level)
    return None if design.spring is None else design.spring.mass


def _stop_numbers(design: Design | None) -> Mapping[str, Value] | None:
    if design is None or design.stop is None:
        return None
    stop = design.stop
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
    if failed := forbidden(choice.aim.at(pair, choice.level)):
        yield f"{words}: {failed[0]}"


def _words(choice: Choice) -> Iterator[str]:
    """Why this ring, in full sentences."""
    aim, spring, above = choice.aim, choice.spring, choice.next
    yield (
        f"Chosen for {_goal(choice)}: {choice.pair}, outer radius "
        f"{_shown(spring.case.outer_radius, 'm')}, {spring.found.style} flexures; of "
        f"{len(choice.allowed)} rings within the closed forms {len(choice.considered)} were "
        f"searched for shapes and {len(choice.designs)} springs designed."
    )
    if aim.objective == "margin":
        yield (
            "The limits in the checks are tightened by the margin of "
            f"{aim.value(choice.level):.0%}: stresses and yield divided by 1 + margin, gaps and "
            "the camshaft's teeth multiplied."
        )
    if above is not None and above.stop is not None:
        level = aim.value(above.level)
        margin = aim.objective == "margin"
        value = f"{level:.0%}" if margin else _shown(level, _UNITS[aim.objective])
        words = _stop_words(above.stop)
        share = above.stop.straight_share
        if share is not None and aim.objective == "deflection":
            end = _shown(share * level, "rad")
            words = f"its straight flexures reach the design stress at {end}"
        yield f"At {value} this ring is stopped by: {words}."
    fences = "; ".join(_fences(choice))
    if fences:
        yield f"The rings next to it are forbidden by closed forms, {fences}."
    if aim.objective == "deflection":
        yield (
            f"Closed forms allow this ring no more than {_shown(aim.value(choice.bound), 'rad')}, "
            f"a full disk {_shown(bound_of(spring), 'rad')}; the search for shapes is local, so "
            "what it finds is what can be reached at least."
        )


def _goal(choice: Choice) -> str:
    value = choice.aim.value(choice.level)
    return {
        "deflection": f"the largest deflection, {_shown(value, 'rad')}",
        "diameter": f"the least diameter, root radius {_shown(value, 'm')}",
        "margin": f"the largest margin, {value:.0%}",
        "mass": f"the least mass of the ring, {choice.spring.mass * 1e3:.4g} g",
    }[choice.aim.objective]


def _stop_words(stop: Stop) -> str:
    return f"{stop.claim} ({_shown(stop.value, stop.unit)}; limit {_shown(stop.limit, stop.unit)})"


def _shown(value: float, unit: str) -> str:
    scale, name = _SHOWN.get(unit, (1.0, f" {unit}"))
    return f"{value * scale:.4g}{name}"
