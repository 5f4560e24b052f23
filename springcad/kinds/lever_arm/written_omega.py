"""An omega leaf rebuilt from its report, without searching again."""

from __future__ import annotations

from springcad.kinds.lever_arm.omega import OmegaCase, OmegaLeaf
from springcad.written import IncompleteDesignError, WrittenDesign


def written_omega(written: WrittenDesign) -> tuple[OmegaLeaf, OmegaCase]:
    """The leaf and what it was found for; IncompleteDesignError where a number is missing."""
    number, array = written.number, written.array
    arms = array("design.lever_arms_m")
    if len(arms) != 2:
        raise IncompleteDesignError("design.lever_arms_m must be two lengths")
    leaf = OmegaLeaf(
        angle_coefficients=array("design.leaf.angle_coefficients_rad"),
        thickness_coefficients=array("design.leaf.thickness_coefficients_m"),
        length=number("design.leaf.half_length_m"),
        middle=number("design.leaf.middle_m"),
        hub_radius=number("design.leaf.hub_radius_m"),
    )
    case = OmegaCase(
        enclosure_radius=number("design.enclosure_radius_m"),
        stroke=number("design.spring_deflection_m"),
        elastic_modulus=number("design.elastic_modulus_Pa"),
        poisson_ratio=number("design.poisson_ratio"),
        allowable_stress=number("design.design_stress_Pa"),
        min_web=number("design.min_web_m"),
        min_gap=number("design.min_gap_m"),
        corridor=number("design.lever_corridor_m"),
        arms=(float(arms[0]), float(arms[1])),
        hub_radius=leaf.hub_radius,
    )
    return leaf, case
