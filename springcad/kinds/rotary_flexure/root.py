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
BLEND_OVER_SMALLEST = 1.5
"""Radius between taper and pad, over the smallest inside radius of the process."""
_SECANTS = 12


@dataclass(frozen=True)
class Root:
    """A root as it is cut.

    Attributes:
        fillet: root fillet radius, m.
        blend: radius between taper and pad, m.
        model: what the root adds to a clamped beam.
    """

    fillet: float
    blend: float
    model: RootModel


def root_with(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, fillet: float) -> Root:
    """The root with the given fillet, or the largest below it that fits between neighbours.

    Raises:
        InfeasibleError: not even the smallest of the process fits.
    """
    fits = largest_fillet(
        ribbon,
        case.inputs.root_radius,
        case.inputs.count,
        spec.process.rules.min_inside_radius,
        fillet,
    )
    model = _calibrated(spec, case, ribbon, _model(spec, case, ribbon, fits))
    return Root(fits, blend_radius(spec), model)


def chosen_root(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, earlier: float | None) -> Root:
    """The root with the fillet asked for, or the largest that leaves it no stiffer than a clamp.

    A larger one would lower the stress in the fillet, but take bending out of the flexure, which
    must then be longer: it costs gap. ``earlier`` is the choice for a shape much like this one.
    A fillet that is asked for and does not fit gives way to the largest that does.
    """
    asked = spec.flexures.root_fillet
    if not isinstance(asked, str):
        return root_with(spec, case, ribbon, asked)
    inputs, smallest = case.inputs, spec.process.rules.min_inside_radius
    thickness = 2.0 * float(ribbon.at(np.zeros(1)).half_thickness[0])
    wanted = max(math.floor(LARGEST_FILLET * thickness / FILLET_STEP) * FILLET_STEP, smallest)
    fits = largest_fillet(ribbon, inputs.root_radius, inputs.count, smallest, wanted)
    balanced = _zero(
        lambda radius: _model(spec, case, ribbon, radius).compliance,
        min(fits, fits if earlier is None else earlier),
        (smallest, fits),
    )
    steps = round(balanced / FILLET_STEP) * FILLET_STEP
    return root_with(spec, case, ribbon, min(fits, max(smallest, steps)))


def _zero(falling: Callable[[float], float], start: float, within: tuple[float, float]) -> float:
    """Where a falling function is zero, to half a step of the fillet, by secants from ``start``.

    The nearer end where it is zero nowhere within.
    """
    low, high = within
    before, here = start, max(low, 0.85 * start)
    value_before, value = falling(before), falling(here)
    for _ in range(_SECANTS):
        if value == value_before:
            return here
        there = here - value * (here - before) / (value - value_before)
        there = min(max(there, low), high)
        if abs(there - here) < 0.5 * FILLET_STEP:
            return there
        before, value_before = here, value
        here, value = there, falling(there)
    return here


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
    thickness = 2.0 * float(ribbon.at(np.zeros(1)).half_thickness[0])
    unit = root_unit(case.inputs.elastic_modulus, case.inputs.thickness, thickness)
    return replace(model, compliance=model.compliance + root_coefficient(spec) * unit)


def mounting_of(spec: RotaryFlexureSpec) -> Mounting:
    """How the housing holds the rim."""
    return "bore" if spec.mounting.dowels is None else "dowels"


def blend_radius(spec: RotaryFlexureSpec) -> float:
    """Radius in the hollow corner between taper and pad, m."""
    return BLEND_OVER_SMALLEST * spec.process.rules.min_inside_radius
