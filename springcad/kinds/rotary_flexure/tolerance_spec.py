"""What a shop holds, and what of the spring is to come out of it.

tolerance: {sheet_thickness: 0.02 mm, edge_offset: 0.01 mm, stiffness: 0.05}
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from springcad.kinds.rotary_flexure.stack_spec import StackSection
from springcad.spec.common import Count, Length, LengthOrZero, Quantity, default
from springcad.spec.rules import Section, rule
from springcad.spec.units import LENGTH, show

EDGE_SHARE = 0.2
"""Of the tip's thickness that an edge may be off: beyond it the response surface is not tested."""


class Tolerance(Section):
    """Bounds within which parts come out of the shop; those not given are 0."""

    sheet_thickness: LengthOrZero = default("0 mm")
    """Plus or minus, of the sheet, in mm."""
    edge_offset: LengthOrZero = default("0 mm")
    """Plus or minus, normal to every cut edge of ring and camshaft alike (kerf, wire), in mm."""
    contact_radius: Annotated[float, Quantity(LENGTH, "0 mm", "0.1 mm")] = default("0 mm")
    """Plus or minus, of the radius at which the flanks of the camshaft lie, in mm."""
    modulus: Annotated[float, Field(ge=0.0, le=0.3)] = 0.0
    """Plus or minus, of the elastic modulus, as a share."""
    distribution: Literal["normal", "uniform"] = "normal"
    """Within the bounds: normal with three standard deviations at each bound, or uniform."""
    stiffness: Annotated[float, Field(gt=0.0, le=1.0)] = 0.05
    """Wanted, plus or minus, of the secant stiffness at the design deflection, as a share."""
    samples: Annotated[int, Count(100, 20000)] = 2000
    """Number of parts that are drawn."""
    seed: Annotated[int, Field(ge=0, le=2**32 - 1)] = 1
    """Seed of the parts."""


@rule("tolerance")
def something_varies(tolerance: Tolerance | None) -> str | None:
    """Rule: a tolerance says what varies."""
    if tolerance is None or any(
        (
            tolerance.sheet_thickness,
            tolerance.edge_offset,
            tolerance.contact_radius,
            tolerance.modulus,
        )
    ):
        return None
    return "give at least one of sheet_thickness, edge_offset, contact_radius, modulus above 0"


@rule("tolerance.sheet_thickness", "envelope.thickness", "stack")
def sheet_within(bound: float, thickness: float | None, stack: StackSection) -> str | None:
    """Rule: a sheet is left."""
    key, sheet = "stack.sheet", stack.sheet
    if sheet is None and isinstance(stack.parallel, int) and thickness is not None:
        sheet = thickness / stack.parallel
        key = "envelope.thickness" if stack.parallel == 1 else "a sheet's thickness"
    if sheet is None or bound <= 0.2 * sheet:
        return None
    return f"must be at most a fifth of {key}, {show(0.2 * sheet, LENGTH)}"


@rule("tolerance.edge_offset", "flexures.tip_thickness")
def edges_within(bound: float, tip: Length) -> str | None:
    """Rule: the tips are left."""
    if bound <= EDGE_SHARE * tip:
        return None
    most = show(EDGE_SHARE * tip, LENGTH)
    return f"must be at most {EDGE_SHARE:g} of flexures.tip_thickness, {most}"


TOLERANCE_RULES = (something_varies, sheet_within, edges_within)
