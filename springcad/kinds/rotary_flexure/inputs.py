"""From the validated spec to what the closed forms start from."""

from __future__ import annotations

from springcad.kinds.rotary_flexure.calibrated import calibrated
from springcad.kinds.rotary_flexure.feasibility import Case
from springcad.kinds.rotary_flexure.law import LawInputs
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.spec.common import CommonSpec


def rotary_spec(model: CommonSpec) -> RotaryFlexureSpec:
    """The model as this kind's own, its calibration in place; TypeError for another kind's."""
    if not isinstance(model, RotaryFlexureSpec):
        raise TypeError(f"not a rotary-flexure spec: {type(model).__name__}")
    return calibrated(model)


def case_of(model: CommonSpec) -> Case:
    """The case that the closed forms judge, SI."""
    spec = rotary_spec(model)
    material, rules = spec.material.values, spec.process.rules
    dowels = spec.mounting.dowels
    return Case(
        inputs=LawInputs(
            stiffness=spec.target.stiffness,
            deflection=spec.target.deflection,
            root_radius=spec.envelope.root_radius,
            contact_radius=spec.envelope.contact_radius,
            count=spec.flexures.count,
            thickness=spec.envelope.thickness,
            elastic_modulus=material.elastic_modulus.value,
            design_stress=spec.material.design_stress,
            tip_half_thickness=0.5 * spec.flexures.tip_thickness,
        ),
        style=spec.flexures.style,
        outer_radius=spec.envelope.outer_radius,
        yield_strength=material.yield_strength.value,
        min_web=rules.min_web,
        min_gap=spec.flexures.min_gap if spec.flexures.min_gap is not None else rules.min_gap,
        dowel_radius=dowels.radius if dowels else 0.0,
        camshaft_bore_radius=spec.camshaft.bore_radius or 0.0,
        backlash=spec.camshaft.backlash,
        least_gap=rules.min_gap,
        min_slot=max(rules.min_gap, 2.0 * rules.min_inside_radius),
    )
