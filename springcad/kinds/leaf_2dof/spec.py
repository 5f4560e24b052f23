"""The spec of a wrist with two axes, each held by leaf springs of adjustable effective length.

The symbols of paper 003: arm R of the lever, roller radius r, leaf width a and thickness b,
effective length L, deflection φ. All values are SI.
"""

from __future__ import annotations

from importlib.resources import files
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from springcad.spec.common import (
    CommonSpec,
    Count,
    Length,
    ProcessEntry,
    ProcessSpec,
    Quantity,
    angle,
    below_process,
    default,
)
from springcad.spec.lists import Bounds, Range
from springcad.spec.material import MaterialSpec, shares_only
from springcad.spec.rules import Rule, Section, rule
from springcad.spec.units import LENGTH, STIFFNESS, show

TEMPLATE = files(__package__).joinpath("template.yaml").read_text(encoding="utf-8")

MOST_LEAVES = 8
"""That bear together about one axis in one direction."""

_SECTION = Bounds(Quantity(LENGTH, "0.01 mm", "1 m"))


class Target(Section):
    """What each of the two axes is to do, in both directions alike."""

    deflection: Annotated[float, angle("0.1 deg", "30 deg")]
    """Largest deflection about one axis, one way from rest, at the longest length, in deg."""
    stiffness: (
        Annotated[tuple[float, float], Range(Quantity(STIFFNESS, "0.0001 N*m/rad", "1e6 N*m/rad"))]
        | None
    ) = None
    """Stiffness at rest about one axis, [least, greatest], over which it can be set, in N*m/rad."""


class Unit(Section):
    """The lever of one axis with its rollers, and the leaves that they press."""

    arm_radius: Length
    """From the axis to the centre of a roller, in mm."""
    roller_radius: Length
    """Radius of a roller, in mm."""
    clamp: Literal["outboard", "inboard"] = "outboard"
    """Side of the roller on which the leaf is held: away from the axis, or towards it."""
    leaves_per_axis: Annotated[int | Literal["auto"], Count(1, MOST_LEAVES, words=("auto",))] = 2
    """Leaves that bear together about one axis in one direction; auto: the fewest that will do."""


class LeafSpec(Section):
    """The leaf: given, or sized between bounds."""

    width: Annotated[tuple[float, float], _SECTION]
    """Across the leaf, along the roller, in mm, or bounds [low, high] for sizing."""
    thickness: Annotated[tuple[float, float], _SECTION]
    """Of the sheet, in mm, or bounds [low, high] for sizing."""
    effective_length: Annotated[
        tuple[float, float] | Literal["auto"],
        Range(Quantity(LENGTH, "0.1 mm", "1 m", words=("auto",))),
    ]
    """From guide to roller, [shortest, longest], in mm; auto: as target.stiffness needs."""
    max_bend_angle: Annotated[float, angle("0.1 deg", "45 deg")] | None = None
    """Largest slope of the leaf where the roller touches it, in deg; no limit if not given."""
    end_radius: Length = default("2 mm")
    """Radius of the corners at both ends of the leaf, in mm."""


class Guide(Section):
    """The slider that holds the leaf; its position sets the effective length."""

    length: Length = default("8 mm")
    """Of the leaf that it grips, in mm."""


class Mount(Section):
    """The end by which the leaf is screwed to the base, beyond the guide."""

    length: Length = default("14 mm")
    """Of the leaf that it takes, in mm."""
    holes: Annotated[int, Field(ge=0, le=10)] = 2
    """Number of holes in a row along the leaf."""
    hole_diameter: Length = default("3.2 mm")
    """Diameter of the holes, in mm."""


class Wrist(Section):
    """The spherical parallel mechanism that joins both axes to the output rod."""

    rod_length: Length = default("50 mm")
    """From the point where the axes cross to the tip of the rod, in mm."""


class Envelope(Section):
    """The space that a leaf may take."""

    leaf_length: Length | None = None
    """Room along the leaf, from the mount to the contact end, in mm; no limit if not given."""


@rule("leaf", "target.stiffness")
def _sizing(leaf: LeafSpec, stiffness: tuple[float, float] | None) -> str | None:
    is_free = leaf.width[0] < leaf.width[1] or leaf.thickness[0] < leaf.thickness[1]
    if is_free and leaf.effective_length != "auto":
        return "bounds of width or thickness need effective_length: auto"
    if leaf.effective_length == "auto" and stiffness is None:
        return "effective_length: auto needs target.stiffness, the range that it is to give"
    return None


@rule("unit.leaves_per_axis", "leaf.effective_length")
def _count(leaves: int | str, length: tuple[float, float] | str) -> str | None:
    if leaves == "auto" and length != "auto":
        return "auto needs leaf.effective_length: auto"
    return None


@rule("unit.roller_radius", "unit.arm_radius")
def _roller(roller: float, arm: float) -> str | None:
    return None if roller < arm else f"must be less than arm_radius, {show(arm, LENGTH)}"


@rule("leaf.thickness", "leaf.width")
def _leaf_is_flat(thickness: tuple[float, float], width: tuple[float, float]) -> str | None:
    if thickness[1] <= width[0]:
        return None
    return f"must not be more than the width, {show(width[0], LENGTH)}: a leaf lies flat"


@rule("leaf.end_radius", "leaf.width")
def _end(radius: float, width: tuple[float, float]) -> str | None:
    if radius <= 0.5 * width[0]:
        return None
    return f"must be at most half the width, {show(0.5 * width[0], LENGTH)}"


@rule("leaf.width", "process")
def _width(width: tuple[float, float], process: ProcessSpec) -> str | None:
    return below_process("a web", width[0], process.rules.min_web, process)


@rule("mount.hole_diameter", "mount.holes", "mount.length", "leaf.width", "process")
def _holes(
    diameter: float, count: int, length: float, width: tuple[float, float], process: ProcessSpec
) -> str | None:
    if not count:
        return None
    rules = process.rules
    if 0.5 * diameter < rules.min_inside_radius * (1.0 - 1e-9):
        return below_process("a radius", 0.5 * diameter, rules.min_inside_radius, process)
    web = min(0.5 * (width[0] - diameter), (length - count * diameter) / (2.0 * count))
    return below_process("a web beside the holes", web, rules.min_web, process)


class Leaf2dofSpec(CommonSpec):
    """A wrist with two axes, held by leaf springs of adjustable effective length (paper 003)."""

    RULES: ClassVar[tuple[Rule, ...]] = (
        _sizing,
        _count,
        _roller,
        _leaf_is_flat,
        _end,
        _width,
        _holes,
        shares_only,
    )

    kind: Literal["leaf-2dof"]
    """Kind of element to design."""
    target: Target
    """What each of the two axes is to do, in both directions alike."""
    unit: Unit
    """The lever of one axis with its rollers, and the leaves that they press."""
    leaf: LeafSpec
    """The leaf: given, or sized between bounds."""
    guide: Guide = Field(default_factory=Guide)
    """The slider that holds the leaf; its position sets the effective length."""
    mount: Mount = Field(default_factory=Mount)
    """The end by which the leaf is screwed to the base, beyond the guide."""
    wrist: Wrist = Field(default_factory=Wrist)
    """The spherical parallel mechanism that joins both axes to the output rod."""
    envelope: Envelope = Field(default_factory=Envelope)
    """The space that a leaf may take."""
    material: MaterialSpec
    """What the leaf is made of, and the stress it is designed for."""
    process: ProcessEntry
    """Cutting process: its name, or a section with name and shop rules of your own."""


SPEC_MODEL = Leaf2dofSpec
