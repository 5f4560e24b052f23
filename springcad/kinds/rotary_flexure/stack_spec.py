"""Springs stacked to one joint, in a spec: sheets in parallel on one camshaft, springs in series.

stack: {sheet: 1.5 mm, parallel: 3, series: 2}
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from springcad.spec.common import Count, Length, LengthOrZero, default
from springcad.spec.rules import Rule, Section, rule
from springcad.spec.units import LENGTH, show

if TYPE_CHECKING:
    from springcad.kinds.rotary_flexure.spec_sections import Envelope

MOST = 200
"""Sheets, or springs, at most."""
ROUND_OFF = 1e-9
"""Share of a sheet by which the thickness allowed may miss a whole number of them."""


class StackSection(Section):
    """Sheets side by side on one camshaft, and springs one behind the other, as one joint."""

    sheet: Length | None = None
    """Thickness of the sheets that are available, in mm; envelope.thickness over parallel if not
    given."""
    parallel: Annotated[int | Literal["auto"], Count(1, MOST, words=("auto",))] = 1
    """Sheets side by side on one camshaft; auto: as many as envelope.thickness has room for."""
    series: Annotated[int, Field(ge=1, le=MOST)] = 1
    """Springs one behind the other, the camshaft of each joined to the rim of the next."""
    gap: LengthOrZero = default("0 mm")
    """Height between two springs in series, for what joins them, in mm."""


@rule("envelope", "stack")
def _one_thickness(envelope: Envelope, stack: StackSection) -> str | None:
    if envelope.thickness is None and stack.sheet is None:
        return "thickness is missing: give it, or stack.sheet with stack.parallel"
    return None


@rule("stack.parallel", "stack.sheet", "envelope.thickness")
def _known_count(parallel: int | str, sheet: float | None, thickness: float | None) -> str | None:
    if parallel == "auto":
        if sheet is None:
            return "auto needs stack.sheet, the thickness of the sheets that are available"
        if thickness is None:
            return "auto needs envelope.thickness, the thickness that the sheets may take together"
        return None
    if sheet is None or thickness is None:
        return None
    together = show(int(parallel) * sheet, LENGTH)
    return (
        f"{parallel} sheets of {show(sheet, LENGTH)} are {together} thick: leave "
        "envelope.thickness out, or let parallel: auto fill it"
    )


@rule("stack.sheet", "stack.parallel", "envelope.thickness")
def _fits(sheet: float | None, parallel: int | str, thickness: float | None) -> str | None:
    if sheet is None or thickness is None or parallel != "auto":
        return None
    if sheets_in(thickness, sheet) > 0:
        return None
    return f"is thicker than envelope.thickness, {show(thickness, LENGTH)}: not one sheet fits"


@rule("stack.gap", "stack.series")
def _between(gap: float, series: int) -> str | None:
    if gap == 0.0 or series > 1:
        return None
    return "has a meaning between springs in series only: series is 1"


STACK_RULES: tuple[Rule, ...] = (_one_thickness, _known_count, _fits, _between)
"""Rules on ``stack`` and ``envelope.thickness``: the thickness of a sheet follows in one way."""


def sheets_in(thickness: float, sheet: float) -> int:
    """How many sheets fit into a thickness."""
    return int(thickness / sheet + ROUND_OFF)
