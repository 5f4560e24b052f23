"""From the validated spec to what the design starts from."""

from __future__ import annotations

import math

from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.mechanism import Lever
from springcad.kinds.lever_arm.spec import LeverArmSpec
from springcad.kinds.lever_arm.straight import Fittings
from springcad.spec.common import CommonSpec

EYE_FILLET = 1e-3
"""Radius between eye and leaf (m), at least the smallest of the process."""
WEB_MARGIN = 1.01
"""Least web of a leaf over that of the process: the arcs of a drawing may lie 2 um inside."""


def lever_spec(model: CommonSpec) -> LeverArmSpec:
    """The model as this kind's own; TypeError for another kind's."""
    if not isinstance(model, LeverArmSpec):
        raise TypeError(f"not a lever-arm spec: {type(model).__name__}")
    return model


def case_of(model: CommonSpec) -> Case:
    """The case that the closed forms judge, SI."""
    spec = lever_spec(model)
    mechanism, leaf, envelope = spec.mechanism, spec.leaf, spec.envelope
    values, rules = spec.material.values, spec.process.rules
    return Case(
        lever=Lever(
            length=mechanism.lever_length,
            crank_radius=mechanism.crank_radius,
            output=mechanism.output,
            series_stiffness=mechanism.series_stiffness or math.inf,
        ),
        pivot_low=mechanism.pivot[0],
        pivot_high=mechanism.pivot[1],
        shape=leaf.shape,
        deflection=spec.target.spring_deflection,
        stiffness=spec.target.spring_stiffness or 0.0,
        count=leaf.count,
        length=leaf.length or 0.0,
        sheet=leaf.sheet_thickness or 0.0,
        layers=leaf.layers or 0,
        width=leaf.width or 0.0,
        height=envelope.height or 0.0,
        radius=envelope.radius or 0.0,
        corridor=envelope.lever_corridor,
        max_pivot_force=mechanism.max_pivot_force or 0.0,
        elastic_modulus=values.elastic_modulus.value,
        poisson_ratio=values.poisson_ratio.value,
        design_stress=spec.material.design_stress,
        yield_strength=values.yield_strength.value,
        min_web=rules.min_web,
        min_gap=rules.min_gap,
    )


def fittings_of(spec: LeverArmSpec) -> Fittings:
    """Eye, fillets and block; a height of 0 stands for auto, which hangs on the leaf."""
    mount, rules = spec.mount, spec.process.rules
    return Fittings(
        pin_diameter=spec.connection.pin_diameter,
        eye_wall=spec.connection.eye_wall,
        eye_fillet=max(EYE_FILLET, rules.min_inside_radius),
        root_fillet=mount.root_fillet,
        min_web=WEB_MARGIN * rules.min_web,
        block_length=mount.length,
        block_height=0.0 if isinstance(mount.height, str) else mount.height,
        hole_count=mount.holes,
        hole_diameter=mount.hole_diameter,
    )
