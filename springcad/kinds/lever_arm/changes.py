"""What a user may change of a lever-arm spec, and the smallest change after which a claim holds."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from springcad.kinds.knobs import Knob, remedies
from springcad.kinds.lever_arm.case import Case

KNOBS = (
    Knob("target.spring_deflection", "mm", 1e-3, "deflection"),
    Knob("target.spring_stiffness", "N/mm", 1e3, "stiffness", upwards=False),
    Knob("leaf.length", "mm", 1e-3, "length"),
    Knob("leaf.sheet_thickness", "mm", 1e-3, "sheet"),
    Knob("leaf.layers", "", 1.0, "layers"),
    Knob("leaf.width", "mm", 1e-3, "width"),
    Knob("leaf.count", "", 1.0, "count"),
    Knob("envelope.height", "mm", 1e-3, "height"),
    Knob("envelope.radius", "mm", 1e-3, "radius"),
    Knob("the low end of mechanism.pivot", "mm", 1e-3, "pivot_low"),
    Knob("mechanism.max_pivot_force", "N", 1.0, "max_pivot_force"),
    Knob("material.design_stress", "MPa", 1e6, "design_stress", upwards=False),
)
"""What a user may change, most telling first. Raising a stress is not a cure."""


HIGH_END = Knob("the high end of mechanism.pivot", "mm", 1e-3, "pivot_high", upwards=False)
LOW_END = next(knob for knob in KNOBS if knob.target == "pivot_low")
LARGEST_STRAIN = 0.01
"""At an edge, up to which linear elasticity of small strains is believed."""
FAULT = "this is a fault of springcad; report it"
"""Said of claims that the design has made sure of."""
SEARCH_DECIDES = "(the search then decides)"
"""Said of changes for an omega leaf that closed forms alone have judged."""


def is_spec(case: Case, tried: Case) -> bool:
    """Whether a spec may say what a turned knob makes of the case."""
    return (
        tried.count > 0
        and bool(tried.layers) == bool(case.layers)
        and tried.pivot_low <= tried.pivot_high
        and not (tried.length and tried.deflection > 0.5 * tried.length)
    )


def turned(case: Case, knobs: tuple[Knob, ...], works: Callable[[Case], bool], hint: str) -> str:
    """The smallest change of one of the knobs after which ``works``; a hint if none was found."""

    def fails(tried: Case) -> tuple[str, ...]:
        return () if is_spec(case, tried) and works(tried) else ("claim",)

    return "; or ".join(remedies(case, knobs, fails)) or hint


def less_strain(case: Case, largest: float, works: Callable[[Case], bool]) -> str:
    """The design stress at which no edge is strained by more than ``largest``, three digits."""
    stress = largest * case.elastic_modulus
    rounded = 10.0 ** (math.floor(math.log10(stress)) - 2)
    lower = math.floor(stress / rounded * (1.0 + 1e-9)) * rounded
    if not works(replace(case, design_stress=lower)):
        return "no lower material.design_stress leaves the rest feasible: measure the material"
    change = f"lower material.design_stress from {1e-6 * case.design_stress:.4g}"
    return f"{change} to {1e-6 * lower:.4g} MPa, or measure the material's own curve"
