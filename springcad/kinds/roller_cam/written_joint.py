"""A roller cam rebuilt from its report and drawing, without solving anything again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from springcad.geometry.polyline import BulgePolyline
from springcad.kinds.judging import drawn_outline
from springcad.kinds.roller_cam.element import ElementDimensions, ElementGeometry, Mount, Mounting
from springcad.kinds.roller_cam.joint import Cantilever, Roller
from springcad.written import IncompleteDesignError, WrittenDesign

_MOUNTINGS: dict[str, Mounting] = {"plates": "plates", "pocket": "pocket"}


@dataclass(frozen=True)
class WrittenJoint:
    """What a judge needs to know of a finished joint, SI.

    Attributes:
        geometry: of the element.
        roller: that presses it.
        dead_zone, deflection: first and last angle of the law.
        outline: of the element, as drawn.
    """

    geometry: ElementGeometry
    roller: Roller
    dead_zone: float
    deflection: float
    outline: BulgePolyline


def written_joint(written: WrittenDesign) -> WrittenJoint:
    """Raises IncompleteDesignError where a number or a contour is missing."""
    number = written.number
    outline = drawn_outline(written, "element")
    return WrittenJoint(
        geometry=_geometry(written),
        roller=Roller(
            radius=number("design.roller_radius_m"),
            drum_radius=number("design.drum_radius_m"),
            offset=number("design.roller_offset_m"),
        ),
        dead_zone=number("design.dead_zone_rad"),
        deflection=float(np.max(written.array("response.angle_rad"))),
        outline=outline,
    )


def _geometry(written: WrittenDesign) -> ElementGeometry:
    number = written.number
    x, y, along_x, along_y = (
        written.array(f"design.profile.{key}") for key in ("x_m", "y_m", "tangent_x", "tangent_y")
    )
    if len({len(x), len(y), len(along_x), len(along_y)}) > 1:
        raise IncompleteDesignError("the arrays of design.profile do not fit together")
    held, fillet = written.text("design.mount.held"), number("design.root_fillet_radius_m")
    if held not in _MOUNTINGS:
        raise IncompleteDesignError(f"design.mount.held {held!r} is not known")
    return ElementGeometry(
        cantilever=Cantilever(
            length=number("design.cantilever_length_m"),
            height=number("design.cantilever_height_m"),
            width=number("design.thickness_m"),
            elastic_modulus=number("design.elastic_modulus_Pa"),
            poisson_ratio=number("design.poisson_ratio"),
            pocket_fillet=fillet if held == "pocket" else None,
        ),
        points=np.column_stack([x, y]),
        tangents=np.column_stack([along_x, along_y]),
        dimensions=ElementDimensions(
            thickness=number("design.contact_part.thickness_m"),
            root_fillet=fillet,
            foot_fillet=number("design.contact_part.foot_fillet_radius_m"),
            rounding=number("design.contact_part.rounding_radius_m"),
            gap=number("design.contact_part.gap_to_mirrored_m"),
            mount=Mount(
                length=number("design.mount.length_m"),
                height=number("design.mount.height_m"),
                hole_diameter=number("design.mount.hole_diameter_m"),
                hole_count=int(number("design.mount.hole_count")),
                mounting=_MOUNTINGS[held],
            ),
        ),
    )
