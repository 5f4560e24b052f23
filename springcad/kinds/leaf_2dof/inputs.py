"""From the validated spec to what the design starts from."""

from __future__ import annotations

import math

from springcad.kinds.leaf_2dof.case import Case
from springcad.kinds.leaf_2dof.spec import Leaf2dofSpec
from springcad.spec.common import CommonSpec


def leaf_spec(model: CommonSpec) -> Leaf2dofSpec:
    """The model as this kind's own; TypeError for another kind's."""
    if not isinstance(model, Leaf2dofSpec):
        raise TypeError(f"not a leaf-2dof spec: {type(model).__name__}")
    return model


def case_of(model: CommonSpec) -> Case:
    """The case that the closed forms judge, SI."""
    spec = leaf_spec(model)
    leaf, material, unit = spec.leaf, spec.material.values, spec.unit
    length, room = leaf.effective_length, spec.envelope.leaf_length
    stiffness = spec.target.stiffness
    return Case(
        deflection=spec.target.deflection,
        least_stiffness=None if stiffness is None else stiffness[0],
        greatest_stiffness=None if stiffness is None else stiffness[1],
        arm_radius=unit.arm_radius,
        roller_radius=unit.roller_radius,
        clamp=unit.clamp,
        leaves=None if isinstance(unit.leaves_per_axis, str) else unit.leaves_per_axis,
        width=leaf.width[1],
        least_width=None if leaf.width[0] == leaf.width[1] else leaf.width[0],
        thickness=leaf.thickness[1],
        least_thickness=None if leaf.thickness[0] == leaf.thickness[1] else leaf.thickness[0],
        shortest=None if isinstance(length, str) else length[0],
        longest=None if isinstance(length, str) else length[1],
        max_bend_angle=math.inf if leaf.max_bend_angle is None else leaf.max_bend_angle,
        end_radius=leaf.end_radius,
        guide_length=spec.guide.length,
        mount_length=spec.mount.length,
        leaf_room=math.inf if room is None else room,
        design_stress=spec.material.design_stress,
        yield_strength=material.yield_strength.value,
        elastic_modulus=material.elastic_modulus.value,
        poisson_ratio=material.poisson_ratio.value,
        clearance=spec.process.rules.min_gap,
    )
