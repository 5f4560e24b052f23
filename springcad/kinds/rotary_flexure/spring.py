"""A finished rotary flexure spring, before anything is said about it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from springcad.geometry.outline import Profile
from springcad.kinds.rotary_flexure.camshaft import Camshaft, CamshaftInputs
from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.full_load import DIRECTIONS
from springcad.kinds.rotary_flexure.law import DesignLaw
from springcad.kinds.rotary_flexure.overrange import EndOfUse, end_of_use
from springcad.kinds.rotary_flexure.response import Stroke
from springcad.kinds.rotary_flexure.search import Found
from springcad.kinds.rotary_flexure.sizing import Sized
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.stack import Stack
from springcad.kinds.target_law import Law
from springcad.mechanics.beam import PreparedBeam
from springcad.result import Check


@dataclass(frozen=True)
class Spring:
    """Everything that was decided about one sheet of a joint and what it does; SI.

    Attributes:
        spec, case, law, target: what it was designed for; the torque law is the target, the spec
            that of the whole joint.
        feasibility: the closed-form checks that it passed before the search.
        sized: its flexures.
        ring: the flexure ring.
        camshaft_inputs, camshaft: the camshaft.
        strokes: counter-clockwise, clockwise.
        mass: of the ring.
    """

    spec: RotaryFlexureSpec
    case: Case
    law: DesignLaw
    target: Law
    feasibility: tuple[Check, ...]
    sized: Sized
    ring: Profile
    camshaft_inputs: CamshaftInputs
    camshaft: Camshaft
    strokes: tuple[Stroke, Stroke]
    mass: float

    @property
    def stack(self) -> Stack:
        """The sheets of the joint, of which this is one."""
        return self.case.stack

    @cached_property
    def end(self) -> EndOfUse:
        """How far it may be turned whichever way: told of the spring that is kept."""
        parts = (self.found.ribbon, self.beam, self.camshaft, self.camshaft_inputs)
        ends = (end_of_use(*parts, way, self.case.yield_strength) for way in DIRECTIONS)
        return min(ends, key=lambda end: end.angle)

    @property
    def found(self) -> Found:
        """The flexures' shape."""
        return self.sized.found

    @property
    def fillet(self) -> float:
        """Root fillet radius."""
        return self.sized.fillet

    @property
    def beam(self) -> PreparedBeam:
        """One flexure on the spring of its root."""
        return self.sized.beam
