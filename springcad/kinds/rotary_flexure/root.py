"""The root of a flexure as it is cut: its fillet, and what that makes of the beam."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.calibrated import root_coefficient
from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.flexure_contact import flexure_beam
from springcad.kinds.rotary_flexure.ring import FILLET_STEP, largest_fillet
from springcad.kinds.rotary_flexure.root_compliance import (
    Mounting,
    RootModel,
    root_model,
    root_unit,
)
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.mechanics.beam import PreparedBeam

LARGEST_FILLET = 0.5
"""Largest fillet radius over root thickness: beyond it the stress hardly falls any more."""
FIRST_FILLET = 0.25
"""The first one tried at the root of a flexure that leans there, near what is chosen."""
STIFFENING = 50.0
"""By so much a fillet as large as the root is thick lowers the coefficient of the root compliance:
40 to 60 near zero where a flexure leans at its root; 11 where it is straight, but there zero is
beyond ``LARGEST_FILLET``."""
BLEND_OVER_SMALLEST = 1.5
"""Radius between taper and pad, over the smallest inside radius of the process."""


@dataclass(frozen=True)
class Root:
    """A root as it is cut.

    Attributes:
        fillet: root fillet radius, m.
        blend: radius between taper and pad, m.
        model: what the root adds to a clamped beam.
        stiffening: by how much a fillet as large as the root is thick would lower the coefficient
            of the compliance, as far as is known.
    """

    fillet: float
    blend: float
    model: RootModel
    stiffening: float = STIFFENING


def root_with(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, fillet: float) -> Root:
    """The root with the given fillet, or the largest below it that fits between neighbours.

    Raises:
        InfeasibleError: not even the smallest of the process fits.
    """
    return _root(spec, case, ribbon, _fitting(spec, case, ribbon, fillet))


def _root(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, fillet: float) -> Root:
    model = _calibrated(spec, case, ribbon, _model(spec, case, ribbon, fillet))
    return Root(fillet, blend_radius(spec), model)


def _fitting(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, fillet: float) -> float:
    inputs, smallest = case.inputs, spec.process.rules.min_inside_radius
    return largest_fillet(ribbon, inputs.root_radius, inputs.count, smallest, fillet)


def chosen_root(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, earlier: Root | None) -> Root:
    """The root with the fillet asked for, or the largest that leaves it no stiffer than a clamp.

    A larger one would lower the stress in the fillet, but take bending out of the flexure, which
    must then be longer: it costs gap. From ``earlier``, the choice for a shape much like this one,
    one Newton step is enough: what it leaves is less than the next change of shape makes. A fillet
    that is asked for and does not fit gives way to the largest that does.
    """
    asked = spec.flexures.root_fillet
    if not isinstance(asked, str):
        return root_with(spec, case, ribbon, asked)
    inputs, smallest = case.inputs, spec.process.rules.min_inside_radius
    thickness = _root_thickness(ribbon)
    largest = max(_in_steps(math.floor, LARGEST_FILLET * thickness), smallest)
    if earlier is not None:
        first, slope = earlier.fillet, earlier.stiffening
    else:
        leans = ribbon.root_angle != 0.0
        first = _in_steps(round, FIRST_FILLET * thickness) if leans else largest
        slope = STIFFENING

    def within(radius: float) -> float:
        return _fitting(spec, case, ribbon, min(largest, max(smallest, radius)))

    def excess(radius: float) -> float:
        """Coefficient of the root compliance: what the fillet leaves of the rim's softness."""
        unit = root_unit(inputs.elastic_modulus, inputs.thickness, thickness)
        return _model(spec, case, ribbon, radius).compliance / unit

    tried = within(first)
    chosen = within(tried + _in_steps(round, excess(tried) / slope * thickness))
    if chosen != tried:
        fell = (excess(tried) - excess(chosen)) * thickness / (chosen - tried)
        slope = min(max(fell, 0.5 * STIFFENING), 2.0 * STIFFENING)
    return replace(_root(spec, case, ribbon, chosen), stiffening=slope)


def _in_steps(whole: Callable[[float], int], length: float) -> float:
    """A length as a whole number of steps of the fillet, m."""
    return whole(length / FILLET_STEP) * FILLET_STEP


def _root_thickness(ribbon: Ribbon) -> float:
    return 2.0 * float(ribbon.at(np.zeros(1)).half_thickness[0])


def flexure_on(
    spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, root_compliance: float
) -> PreparedBeam:
    """The flexure as a beam on a root spring."""
    return flexure_beam(
        ribbon,
        thickness=case.inputs.thickness,
        elastic_modulus=case.inputs.elastic_modulus,
        poisson_ratio=spec.material.values.poisson_ratio.value,
        root_compliance=root_compliance,
    )


def _model(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, fillet: float) -> RootModel:
    sector = SectorGeometry(
        ribbon,
        case.inputs.root_radius,
        case.outer_radius,
        case.inputs.count,
        fillet,
        blend_radius(spec),
    )
    return root_model(flexure_on(spec, case, ribbon, 0.0), sector, mounting_of(spec))


def _calibrated(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, model: RootModel) -> RootModel:
    """The root with what a bench test has found beyond the finite elements."""
    unit = root_unit(case.inputs.elastic_modulus, case.inputs.thickness, _root_thickness(ribbon))
    return replace(model, compliance=model.compliance + root_coefficient(spec) * unit)


def mounting_of(spec: RotaryFlexureSpec) -> Mounting:
    """How the housing holds the rim."""
    return "bore" if spec.mounting.dowels is None else "dowels"


def blend_radius(spec: RotaryFlexureSpec) -> float:
    """Radius in the hollow corner between taper and pad, m."""
    return BLEND_OVER_SMALLEST * spec.process.rules.min_inside_radius
