"""Leaves and rollers rebuilt from a report and its drawing, without solving anything again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.polyline import BulgePolyline
from springcad.kinds.judging import drawn_outline
from springcad.kinds.leaf_2dof.leaf import Clamp, Leaf, Lever
from springcad.written import IncompleteDesignError, WrittenDesign

Floats = NDArray[np.float64]

_CLAMPS: dict[str, Clamp] = {"outboard": "outboard", "inboard": "inboard"}


@dataclass(frozen=True)
class WrittenStroke:
    """What the report says of one effective length, SI; arrays (A,) over the angle.

    Attributes:
        length: effective length.
        torque: of one axis.
        force, stress, station: of one leaf.
    """

    length: float
    angle: Floats
    torque: Floats
    force: Floats
    stress: Floats
    station: Floats


@dataclass(frozen=True)
class WrittenLeaf:
    """What a judge needs to know, SI.

    Attributes:
        leaves: that bear together about one axis.
        end: of the leaf, from the guide at the longest effective length.
        end_radius: of its corners.
        whole: length of the leaf with guide and mount.
        strokes: from the shortest effective length to the longest.
        outline: of the leaf, as drawn.
    """

    leaf: Leaf
    lever: Lever
    leaves: int
    end: float
    end_radius: float
    whole: float
    strokes: tuple[WrittenStroke, ...]
    outline: BulgePolyline


def written_leaf(written: WrittenDesign) -> WrittenLeaf:
    """Raises IncompleteDesignError where a number or the contour is missing."""
    number = written.number
    outline = drawn_outline(written, "leaf")
    clamp = written.text("design.clamp")
    if clamp not in _CLAMPS:
        raise IncompleteDesignError(f"design.clamp {clamp!r} is not known")
    return WrittenLeaf(
        leaf=Leaf(
            width=number("design.leaf_width_m"),
            thickness=number("design.leaf_thickness_m"),
            elastic_modulus=number("design.elastic_modulus_Pa"),
            poisson_ratio=number("design.poisson_ratio"),
        ),
        lever=Lever(
            radius=number("design.arm_radius_m"),
            roller_radius=number("design.roller_radius_m"),
            clamp=_CLAMPS[clamp],
        ),
        leaves=int(number("design.leaves_per_axis")),
        end=number("design.longest_length_m") + number("design.leaf.overhang_m"),
        end_radius=number("design.leaf.end_radius_m"),
        whole=number("design.leaf.length_m"),
        strokes=tuple(
            _stroke(written, index + 1) for index in range(int(number("design.stroke_count")))
        ),
        outline=outline,
    )


def _stroke(written: WrittenDesign, index: int) -> WrittenStroke:
    key = f"response.strokes.{index}"
    columns = [
        written.array(f"{key}.{name}")
        for name in (
            "angle_rad", "torque_Nm", "roller_force_N", "nominal_stress_Pa", "contact_station_m"
        )
    ]  # fmt: skip
    if len({len(column) for column in columns}) > 1:
        raise IncompleteDesignError(f"the arrays of {key} do not fit together")
    return WrittenStroke(written.number(f"{key}.effective_length_m"), *columns)
