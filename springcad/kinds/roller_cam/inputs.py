"""From the validated spec to what the design starts from."""

from __future__ import annotations

from dataclasses import replace

from springcad.kinds.given_law import rise_of
from springcad.kinds.roller_cam.case import Case
from springcad.kinds.roller_cam.joint import Cantilever, Joint, Roller
from springcad.kinds.roller_cam.spec import RollerCamSpec
from springcad.kinds.target_law import Law, law_of
from springcad.spec.common import CommonSpec

FOOT_FILLET = 0.25
"""Radius between cantilever and contact part over that of the roller; at least the smallest of the
process."""


def roller_spec(model: CommonSpec) -> RollerCamSpec:
    """The model as this kind's own; TypeError for another kind's."""
    if not isinstance(model, RollerCamSpec):
        raise TypeError(f"not a roller-cam spec: {type(model).__name__}")
    return model


def group_law(spec: RollerCamSpec) -> Law:
    """The law of one group."""
    target = spec.target
    rise = rise_of(target.law, target.deflection - target.dead_zone)
    if target.per == "group" or spec.groups == 1:
        return law_of(rise, target.deflection, dead_zone=target.dead_zone)
    rise = replace(rise, words=f"{rise.words}, shared by {spec.groups} groups")
    share = 1.0 / spec.groups
    return law_of(rise, target.deflection, dead_zone=target.dead_zone, share=share)


def joint_of(spec: RollerCamSpec) -> Joint:
    """Cantilever and roller; the stiffest cantilever within the bounds where it is to be sized."""
    material = spec.material.values
    cantilever = Cantilever(
        length=spec.cantilever.length[0],
        height=spec.cantilever.height[1],
        width=spec.envelope.thickness[1],
        elastic_modulus=material.elastic_modulus.value,
        poisson_ratio=material.poisson_ratio.value,
        pocket_fillet=spec.cantilever.root_fillet if spec.mount.held == "pocket" else None,
    )
    roller = Roller(
        radius=spec.joint.roller_radius,
        drum_radius=spec.joint.drum_radius,
        offset=spec.joint.roller_offset,
    )
    return Joint(cantilever, roller)


def foot_fillet(spec: RollerCamSpec) -> float:
    """Radius between cantilever and contact part (m)."""
    return max(FOOT_FILLET * spec.joint.roller_radius, spec.process.rules.min_inside_radius)


def case_of(model: CommonSpec) -> Case:
    """The case that the closed forms judge, SI."""
    spec = roller_spec(model)
    law = group_law(spec)
    return Case(
        law=law,
        deflection=law.deflection,
        joint=joint_of(spec),
        is_sized=spec.cantilever.objective is not None,
        least_height=spec.cantilever.height[0],
        design_stress=spec.material.design_stress,
        yield_strength=spec.material.values.yield_strength.value,
        clearance=spec.process.rules.min_gap,
        foot_fillet=foot_fillet(spec),
    )
