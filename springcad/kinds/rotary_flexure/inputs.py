"""From the validated spec to what the closed forms start from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from springcad.kinds.rotary_flexure.calibrated import calibrated
from springcad.kinds.rotary_flexure.case import Case, LawDemand
from springcad.kinds.rotary_flexure.law import LawInputs
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.stack import law_of_sheet, stack_of
from springcad.spec.common import CommonSpec

if TYPE_CHECKING:
    from springcad.kinds.target_law import Law


def rotary_spec(model: CommonSpec) -> RotaryFlexureSpec:
    """The model as this kind's own, its calibration in place; TypeError for another kind's."""
    if not isinstance(model, RotaryFlexureSpec):
        raise TypeError(f"not a rotary-flexure spec: {type(model).__name__}")
    return calibrated(model)


def number(value: float | str) -> float:
    """A number of the spec that may also be left open; ValueError while it is."""
    if isinstance(value, str):
        raise ValueError(f"not chosen yet: {value}")
    return value


def case_of(model: CommonSpec) -> Case:
    """The case that the closed forms judge, of one sheet of the joint, SI.

    ValueError while something is to be chosen.
    """
    spec = rotary_spec(model)
    material, rules = spec.material.values, spec.process.rules
    dowels, target = spec.mounting.dowels, spec.target
    law, stack = None, stack_of(spec)
    if target.stiffness is not None:
        stiffness = target.stiffness * stack.stiffness_share
        deflection = number(target.deflection) / stack.series
    else:
        torque, energy, at_rest = full_load_of(spec)
        stiffness, deflection = torque**2 / (2.0 * energy), 2.0 * energy / torque
        law = LawDemand(torque, at_rest)
    return Case(
        inputs=LawInputs(
            stiffness=stiffness,
            deflection=deflection,
            root_radius=number(spec.envelope.root_radius),
            contact_radius=number(spec.envelope.contact_radius),
            count=int(number(spec.flexures.count)),
            thickness=stack.sheet,
            elastic_modulus=material.elastic_modulus.value,
            design_stress=spec.material.design_stress,
            tip_half_thickness=0.5 * spec.flexures.tip_thickness,
        ),
        style=spec.flexures.style,
        outer_radius=number(spec.envelope.outer_radius),
        yield_strength=material.yield_strength.value,
        min_web=rules.min_web,
        min_gap=spec.flexures.min_gap if spec.flexures.min_gap is not None else rules.min_gap,
        dowel_radius=dowels.radius if dowels else 0.0,
        camshaft_bore_radius=spec.camshaft.bore_radius or 0.0,
        backlash=spec.camshaft.backlash,
        least_gap=rules.min_gap,
        min_tooth=spec.camshaft.min_tooth or rules.min_web,
        min_slot=max(rules.min_gap, 2.0 * rules.min_inside_radius),
        law=law,
        stack=stack,
    )


def full_load_of(spec: RotaryFlexureSpec) -> tuple[float, float, float]:
    """Torque and energy of a sheet's law at its largest angle, and its stiffness at rest."""
    law = target_of(spec)
    end = np.array([law.deflection])
    torque, energy = float(law.torque(end)[0]), float(law.energy(end)[0])
    return torque, energy, float(law.stiffness(np.zeros(1))[0])


def target_of(spec: RotaryFlexureSpec) -> Law:
    """The torque law of one sheet of the joint."""
    return law_of_sheet(joint_target_of(spec), stack_of(spec))


def joint_target_of(spec: RotaryFlexureSpec) -> Law:
    """The torque law of the whole joint; one of a constant stiffness where that is given."""
    # What these load is not needed to check a spec of a constant stiffness.
    from springcad.kinds.given_law import rise_of
    from springcad.kinds.target_law import law_of, polynomial

    target, deflection = spec.target, number(spec.target.deflection)
    if target.law is not None:
        return law_of(rise_of(target.law, deflection), deflection)
    if target.stiffness is not None:
        return law_of(polynomial((target.stiffness,), deflection), deflection)
    raise ValueError("a valid spec has a stiffness or a law")
