"""A joint of several equal springs: sheets in parallel, springs in series.

Sheets on one camshaft turn by the same angle and add their torques; springs of which each hangs on
the one before carry the same torque and add their angles. So each of p sheets of each of m springs
does with the torque T(m θ)/p at the angle θ what the joint is to do, T at its own angle: one sheet
is designed, for that, and all of them are cut from the same drawing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from springcad.errors import InfeasibleError
from springcad.kinds.knobs import Knob
from springcad.kinds.rotary_flexure.stack_spec import sheets_in
from springcad.result import Check

if TYPE_CHECKING:
    from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
    from springcad.kinds.target_law import Law

THICKNESS = "envelope.thickness"


@dataclass(frozen=True)
class Stack:
    """How many equal sheets make the joint, and what their height is; SI.

    Attributes:
        parallel: p, sheets side by side on one camshaft.
        series: m, such springs one behind the other.
        sheet: thickness of one sheet.
        gap: height between two springs in series.
        spare: thickness allowed that the sheets of a spring leave over.
        thickness_key: of the spec, which sets the thickness of the sheet; none where their number
            follows from it.
    """

    parallel: int = 1
    series: int = 1
    sheet: float = 0.0
    gap: float = 0.0
    spare: float = 0.0
    thickness_key: str | None = THICKNESS

    @property
    def sheets(self) -> int:
        """Rings to be cut, p m."""
        return self.parallel * self.series

    @property
    def stiffness_share(self) -> float:
        """Stiffness of one sheet over that of the joint, m/p."""
        return self.series / self.parallel

    @property
    def camshaft_length(self) -> float:
        """Thickness of a spring, all of its sheets (m)."""
        return self.parallel * self.sheet

    @property
    def height(self) -> float:
        """Of the whole joint along its axis (m)."""
        return self.series * self.camshaft_length + (self.series - 1) * self.gap


SINGLE = Stack()
"""One sheet alone."""


def stack_of(spec: RotaryFlexureSpec) -> Stack:
    """The stack of a valid spec; of one sheet where it says nothing of it."""
    section, thickness = spec.stack, spec.envelope.thickness
    if section.sheet is None:
        assert thickness is not None
        assert isinstance(section.parallel, int)
        sheet = thickness / section.parallel
        return Stack(section.parallel, section.series, sheet, section.gap)
    if isinstance(section.parallel, int):
        key = "stack.sheet"
        return Stack(
            section.parallel, section.series, section.sheet, section.gap, thickness_key=key
        )
    assert thickness is not None
    count = sheets_in(thickness, section.sheet)
    spare = max(thickness - count * section.sheet, 0.0)
    return Stack(count, section.series, section.sheet, section.gap, spare, None)


def law_of_sheet(joint: Law, stack: Stack) -> Law:
    """What one sheet must do for the joint to follow its law: T(m θ)/p, with the energy W/(p m)."""
    parallel, series = stack.parallel, stack.series
    if stack.sheets == 1:
        return joint
    return replace(
        joint,
        deflection=joint.deflection / series,
        dead_zone=joint.dead_zone / series,
        torque=lambda angle: joint.torque(series * angle) / parallel,
        energy=lambda angle: joint.energy(series * angle) / (parallel * series),
        stiffness=lambda angle: joint.stiffness(series * angle) * stack.stiffness_share,
        words=f"of the whole joint: {joint.words}",
        points=joint.points / [series, parallel],
    )


def named(checks: Sequence[Check], stack: Stack) -> tuple[Check, ...]:
    """The checks of one sheet, which say so where there are more."""
    if stack.sheets == 1:
        return tuple(checks)
    return tuple(replace(claim, name=f"one sheet: {claim.name}") for claim in checks)


def of_sheet(error: InfeasibleError, stack: Stack) -> InfeasibleError:
    """The refusal of one sheet, which says so where there are more."""
    if stack.sheets == 1:
        return error
    claim = f"of one sheet of the stack: {error.claim}"
    return InfeasibleError(claim, error.value, error.limit, error.unit, error.remedies)


def knobs_of_joint(knobs: Sequence[Knob], stack: Stack) -> list[Knob]:
    """Knobs of a case, which is of one sheet, as they stand in the spec of the whole joint.

    How many sheets fill a thickness changes with it in steps: there is no knob for that.
    """
    of_sheet = stack.thickness_key == "stack.sheet"
    own = {
        "target.deflection": ("target.deflection", 1.0 / stack.series),
        "target.stiffness": ("target.stiffness", stack.stiffness_share),
        THICKNESS: (stack.thickness_key, 1.0 if of_sheet else 1.0 / stack.parallel),
    }
    told = [(knob, *own.get(knob.key, (knob.key, 1.0))) for knob in knobs]
    return [replace(knob, key=key, scale=share * knob.scale) for knob, key, share in told if key]
