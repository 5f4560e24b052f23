"""A straight leaf rebuilt from its report, without solving anything again."""

from __future__ import annotations

from springcad.kinds.lever_arm.straight import Fittings, StraightLeaf, StraightShape
from springcad.kinds.lever_arm.straight_beam import Elastic
from springcad.written import IncompleteDesignError, WrittenDesign

_SHAPES: dict[str, StraightShape] = {
    "constant": "constant",
    "triangular": "triangular",
    "parabolic": "parabolic",
}


def written_elastic(written: WrittenDesign) -> Elastic:
    """The material; raises IncompleteDesignError where a number is missing."""
    number = written.number
    return Elastic(number("design.elastic_modulus_Pa"), number("design.poisson_ratio"))


def written_leaf(written: WrittenDesign) -> StraightLeaf:
    """One leaf; raises IncompleteDesignError where a number is missing or cannot be."""
    shape = written.text("design.shape")
    if shape not in _SHAPES:
        raise IncompleteDesignError(f"design.shape {shape!r} is not known")

    def number(key: str) -> float:
        return written.number(f"design.leaf.{key}")

    return StraightLeaf(
        shape=_SHAPES[shape],
        length=number("length_m"),
        thickness=number("thickness_m"),
        width=number("width_m"),
        fittings=Fittings(
            pin_diameter=number("pin_diameter_m"),
            eye_wall=number("eye_wall_m"),
            eye_fillet=number("eye_fillet_radius_m"),
            root_fillet=number("root_fillet_radius_m"),
            min_web=number("min_web_m"),
            block_length=number("block_length_m"),
            block_height=number("block_height_m"),
            hole_count=int(number("hole_count")),
            hole_diameter=number("hole_diameter_m"),
        ),
    )
