"""Rules of a spec of which something is to be chosen: what belongs together, what is silly."""

from __future__ import annotations

from typing import TYPE_CHECKING

from springcad.spec.rules import rule

if TYPE_CHECKING:
    from springcad.kinds.rotary_flexure.spec_sections import Target

AUTO = "auto"
MAX = "max"


@rule("target.deflection", "target")
def _max_of_a_stiffness(deflection: float | str, target: Target) -> str | None:
    if deflection != MAX or target.law is None:
        return None
    return "max needs target.stiffness: a law is given up to an angle"


@rule("target.deflection", "objective")
def _max_is_an_objective(deflection: float | str, objective: str | None) -> str | None:
    if deflection != MAX or objective in (None, "deflection"):
        return None
    return f"max is for objective: deflection; objective: {objective} needs an angle"


@rule("objective", "target.deflection")
def _largest_deflection(objective: str | None, deflection: float | str) -> str | None:
    if objective != "deflection" or deflection == MAX:
        return None
    return "deflection needs target.deflection: max"


@rule("objective", "envelope.root_radius")
def _least_diameter(objective: str | None, root: float | str) -> str | None:
    if objective != "diameter" or root == AUTO:
        return None
    return "diameter needs envelope.root_radius: auto and envelope.outer_radius: auto"


@rule("envelope.root_radius", "envelope.outer_radius", "objective")
def _free_root(root: float | str, outer: float | str, objective: str | None) -> str | None:
    if root != AUTO:
        return None
    if objective != "diameter":
        return "auto needs objective: diameter; for any other the largest that fits is the best"
    return None if outer == AUTO else "auto needs envelope.outer_radius: auto as well"


@rule(
    "objective",
    "target.deflection",
    "flexures.count",
    "envelope.contact_radius",
    "envelope.outer_radius",
)
def _something_to_choose(objective: str | None, *values: float | str) -> str | None:
    if objective is None or any(isinstance(value, str) for value in values):
        return None
    keys = "flexures.count, envelope.contact_radius or envelope.outer_radius"
    return f"nothing is left to choose: set {keys} to auto"


@rule(
    "optimiser.form",
    "target.deflection",
    "flexures.count",
    "envelope.contact_radius",
    "envelope.outer_radius",
)
def _form(form: str, *values: float | str) -> str | None:
    if form == "curvature" or not any(isinstance(value, str) for value in values):
        return None
    return "auto and max need form: curvature, which is fast enough to choose with"


OBJECTIVE_RULES = (
    _max_of_a_stiffness,
    _max_is_an_objective,
    _largest_deflection,
    _least_diameter,
    _free_root,
    _something_to_choose,
    _form,
)
"""All of them."""
