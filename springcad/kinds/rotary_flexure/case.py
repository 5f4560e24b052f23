"""One sheet of a joint as the closed forms judge it, and the style that its flexures will have."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from springcad.kinds.rotary_flexure.law import DesignLaw, LawInputs
from springcad.kinds.rotary_flexure.loaded_contact import loaded_shift
from springcad.kinds.rotary_flexure.stack import SINGLE, Stack

Style = Literal["auto", "straight", "serpentine"]

STRAIGHT_TOLERANCE = 0.0075
"""A straight flexure counts as right within this share of f_s: half a per cent of stress, since
stress goes as f_s^(2/3). Table I of 004 needs it: it prints 12.6 deg for 12.56 deg (f_s 1.005)."""


@dataclass(frozen=True)
class LawDemand:
    """What a torque law that is not linear asks of the ring.

    Attributes:
        torque: at full load, N m.
        stiffness_at_rest: slope of the law at rest, N m/rad.
    """

    torque: float
    stiffness_at_rest: float


@dataclass(frozen=True)
class Case:
    """One sheet to be judged, SI: the law's inputs and what surrounds the flexures.

    Attributes:
        inputs: of the design law.
        style: of the flexures; ``auto`` lets the serpentine factor decide.
        outer_radius: of the ring.
        yield_strength: of the material; the camshaft is taken to be of the same.
        min_web: thinnest web that the process cuts.
        min_gap: smallest gap wanted between neighbouring flexures, unloaded.
        dowel_radius: of the semicircular cut-outs in the rim, 0 without dowels.
        camshaft_bore_radius: 0 for a solid camshaft.
        backlash: tangential play of a tip in its slot of the camshaft.
        min_slot: narrowest slot with a round bottom that the process cuts.
        least_gap: narrowest gap that the process cuts; ``min_gap`` may not be below it.
        min_tooth: least width of a tooth of the camshaft between two tips at rest; at least
            ``min_web``, which is all that the drawn tooth, thinner towards its tip, must keep.
        law: what a torque law asks for that is not linear.
        stack: the sheets of the joint, all alike; those on one camshaft twist it together.
    """

    inputs: LawInputs
    style: Style
    outer_radius: float
    yield_strength: float
    min_web: float
    min_gap: float
    dowel_radius: float = 0.0
    camshaft_bore_radius: float = 0.0
    backlash: float = 0.0
    min_slot: float = 0.0
    least_gap: float = 0.0
    min_tooth: float = 0.0
    law: LawDemand | None = None
    stack: Stack = SINGLE

    @property
    def shifted(self) -> Case:
        """The case with the contact where it is at full load."""
        inputs = self.inputs
        if self.law is None or self.law.stiffness_at_rest <= 0.0:
            return self
        shift = loaded_shift(
            inputs.stiffness / self.law.stiffness_at_rest,
            self.law.torque,
            span=inputs.root_radius - inputs.contact_radius,
            contact_radius=inputs.contact_radius,
            count=inputs.count,
            thickness=inputs.thickness,
            design_stress=inputs.design_stress,
            tip_half_thickness=inputs.tip_half_thickness,
        )
        return replace(self, inputs=replace(inputs, shift=shift))


def resolved_style(law: DesignLaw, style: Style) -> Literal["straight", "serpentine"]:
    """The style a design will have: ``auto`` becomes straight within STRAIGHT_TOLERANCE."""
    if style == "auto":
        excess = law.serpentine_factor / law.straight_factor - 1.0
        return "straight" if excess <= STRAIGHT_TOLERANCE else "serpentine"
    return style
