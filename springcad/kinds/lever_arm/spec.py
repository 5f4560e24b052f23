"""The spec of a lever arm: leaf springs behind a lever whose pivot moves (paper 000).

The symbols of paper 000: length l of the lever, crank radius R, pivot position q, spring
deflection s, spring stiffness k_s. All values are SI.
"""

from __future__ import annotations

from importlib.resources import files
from typing import Annotated, ClassVar, Literal, TypeAlias

from pydantic import Field

from springcad.spec.common import (
    AutoLength,
    CommonSpec,
    Length,
    ProcessEntry,
    ProcessSpec,
    Quantity,
    TorsionalStiffness,
    below_process,
    default,
)
from springcad.spec.lists import Bounds
from springcad.spec.material import MaterialSpec, shares_only
from springcad.spec.rules import Rule, Section, rule
from springcad.spec.units import FORCE, LENGTH, LINEAR_STIFFNESS, show

TEMPLATE = files(__package__).joinpath("template.yaml").read_text(encoding="utf-8")

LengthBounds: TypeAlias = Annotated[
    tuple[float, float], Bounds(Quantity(LENGTH, "0.01 mm", "10 m"))
]


class Target(Section):
    """What the spring at the lever's end is to do, to both sides alike."""

    spring_deflection: Length
    """Largest deflection of the lever's end, one way from rest (s_max of paper 000), in mm."""
    spring_stiffness: Annotated[float, Quantity(LINEAR_STIFFNESS, "0.1 N/m", "1000000 N/mm")] | (
        None
    ) = None
    """Force over deflection there, of all leaves together, in N/mm; else layers or width decide."""


class Mechanism(Section):
    """The lever, its pivot and what is behind it."""

    lever_length: Length
    """From the crank's pin to the spring's pin, in mm."""
    crank_radius: Length
    """Radius on which the output turns the lever's end, in mm."""
    pivot: LengthBounds
    """Range [low, high] of the pivot's distance from the crank's pin, in mm."""
    output: Literal["yoke", "crank-behind", "crank-ahead"] = "yoke"
    """Lever's end guided across (the equations of paper 000), or pinned to a crank whose axis is
    behind it or ahead, on the side of the pivot."""
    series_stiffness: TorsionalStiffness | None = None
    """Of all that yields between spring and output, in N*m/rad; rigid if not given."""
    max_pivot_force: Annotated[float, Quantity(FORCE, "0.001 N", "100000 kN")] | None = None
    """What the pivot's bearing may carry, in N; not checked if not given."""


class LeafSpec(Section):
    """The leaf, or several equal ones side by side that act together in both directions."""

    shape: Literal["constant", "triangular", "parabolic", "omega"]
    """Constant section, triangle in plan view, parabola in side view, or curved in an enclosure."""
    length: Length | None = None
    """From the clamp to the pin at the lever, in mm; not for omega."""
    sheet_thickness: Length | None = None
    """Of the sheet, in mm: of one layer; of a triangular leaf as a whole (default: the largest of
    the preferred numbers that the stress allows)."""
    layers: Annotated[int, Field(ge=1, le=1000)] | None = None
    """Layers in the stack; default: the fewest that reach the stiffness. Not for triangular."""
    width: Length | None = None
    """Of a triangular leaf at the clamp, in mm; default: what the stiffness needs."""
    count: Annotated[int, Field(ge=1, le=20)] = 1
    """Number of leaves side by side at the lever's end."""
    topology: Literal["omega", "free"] = "free"
    """Of an omega leaf: bent to one side only along each half, or free to fold."""


class Envelope(Section):
    """The space that the spring may take."""

    radius: Length | None = None
    """Inside radius of the cylindrical enclosure, in mm; for omega only."""
    lever_corridor: Length = default("12 mm")
    """Width of the lever with the room that it needs, in mm; for omega only."""
    height: Length | None = None
    """Room for all leaves along the axis of the joint, in mm; not checked if not given."""


class Connection(Section):
    """How the lever holds the leaf."""

    pin_diameter: Length = default("4 mm")
    """Of the hole in the leaf's eye, in mm."""
    eye_wall: Length = default("2 mm")
    """Least material round the hole, in mm."""


class Mount(Section):
    """The block by which the leaf is held."""

    length: Length = default("12 mm")
    """Beyond the clamp, in mm."""
    height: AutoLength = default("auto")
    """Across the leaf, in mm; auto: 20 mm, or more if leaf, fillets and holes need it. Not for
    omega."""
    holes: Annotated[int, Field(ge=0, le=20)] = 2
    """Number of holes in a row across."""
    hole_diameter: Length = default("4 mm")
    """Diameter of the holes, in mm."""
    root_fillet: Length = default("1 mm")
    """Radius between block and leaf, in mm."""


class Optimiser(Section):
    """How an omega leaf is searched for."""

    starts: Annotated[int, Field(ge=1, le=1000)] = 40
    """Number of starting points."""
    seed: Annotated[int, Field(ge=0, le=2**32 - 1)] = 1
    """Seed of the starting points."""


@rule("mechanism.pivot", "mechanism.lever_length")
def _pivot(pivot: tuple[float, float], length: float) -> str | None:
    if pivot[1] < length:
        return None
    return f"must stay below lever_length, {show(length, LENGTH)}: the spring is there"


@rule("leaf.length", "leaf.shape", "target.spring_deflection")
def _length(length: float | None, shape: str, deflection: float) -> str | None:
    if shape == "omega":
        return None if length is None else "has no meaning with shape: omega, which finds it"
    if length is None:
        return f"missing: shape {shape} needs it"
    if deflection <= 0.5 * length:
        return None
    return f"must be at least twice the spring_deflection, {show(2.0 * deflection, LENGTH)}"


@rule("leaf.sheet_thickness", "leaf.shape")
def _sheet(sheet: float | None, shape: str) -> str | None:
    if sheet is not None or shape == "triangular":
        return None
    return f"missing: a leaf of shape {shape} is a stack of layers of sheet"


@rule("leaf.layers", "leaf.shape", "target")
def _layers(layers: int | None, shape: str, target: Target) -> str | None:
    if shape == "triangular":
        return None if layers is None else "has no meaning with shape: triangular; use count"
    if layers is None and target.spring_stiffness is None:
        return "give layers, or target.spring_stiffness to find them from"
    return None


@rule("leaf.width", "leaf.shape", "target")
def _width(width: float | None, shape: str, target: Target) -> str | None:
    if shape != "triangular":
        return None if width is None else f"has no meaning with shape: {shape}; use layers"
    if (width is None) == (target.spring_stiffness is None):
        return "give one of leaf.width and target.spring_stiffness; the other follows"
    return None


@rule("leaf.topology", "leaf")
def _topology(_: str, leaf: LeafSpec) -> str | None:
    return None if leaf.shape == "omega" else _only_omega(leaf, "topology")


@rule("envelope.radius", "leaf.shape")
def _radius(radius: float | None, shape: str) -> str | None:
    if (radius is None) == (shape != "omega"):
        return None
    return "missing: shape omega needs it" if radius is None else "has a meaning with omega only"


@rule("envelope.lever_corridor", "envelope", "leaf.shape")
def _corridor(corridor: float, envelope: Envelope, shape: str) -> str | None:
    if shape != "omega":
        return _only_omega(envelope, "lever_corridor")
    if envelope.radius is None or corridor < envelope.radius:
        return None
    return f"must be less than the radius, {show(envelope.radius, LENGTH)}"


@rule("optimiser", "leaf.shape")
def _optimiser(optimiser: Optimiser, shape: str) -> str | None:
    if shape == "omega" or not optimiser.model_fields_set:
        return None
    return "has a meaning with shape: omega only; the other shapes follow from closed forms"


def _only_omega(section: Section, key: str) -> str | None:
    return "has a meaning with shape: omega only" if key in section.model_fields_set else None


@rule("connection.pin_diameter", "process")
def _pin(diameter: float, process: ProcessSpec) -> str | None:
    least = process.rules.min_inside_radius
    return below_process("a radius", 0.5 * diameter, least, process)


@rule("connection.eye_wall", "process")
def _eye(wall: float, process: ProcessSpec) -> str | None:
    return below_process("a web", wall, process.rules.min_web, process)


@rule("mount.root_fillet", "process")
def _fillet(fillet: float, process: ProcessSpec) -> str | None:
    return below_process("an inside radius", fillet, process.rules.min_inside_radius, process)


@rule("mount.height", "leaf.shape")
def _height(height: float | str, shape: str) -> str | None:
    if shape != "omega" or isinstance(height, str):
        return None
    return "has no meaning with shape: omega, whose feet follow the wall"


@rule("mount.hole_diameter", "mount.holes", "mount.length", "mount.height", "process")
def _holes(
    diameter: float, count: int, length: float, height: float | str, process: ProcessSpec
) -> str | None:
    if not count:
        return None
    rules = process.rules
    if 0.5 * diameter < rules.min_inside_radius * (1.0 - 1e-9):
        return below_process("a radius", 0.5 * diameter, rules.min_inside_radius, process)
    web = 0.5 * (length - diameter)
    if not isinstance(height, str):
        web = min(web, (height - count * diameter) / (2.0 * count))
    return below_process("a web beside the holes", web, rules.min_web, process)


class LeverArmSpec(CommonSpec):
    """A lever arm: leaf springs behind a lever whose pivot moves (paper 000)."""

    RULES: ClassVar[tuple[Rule, ...]] = (
        _pivot,
        _length,
        _sheet,
        _layers,
        _width,
        _topology,
        _radius,
        _corridor,
        _optimiser,
        _pin,
        _eye,
        _fillet,
        _height,
        _holes,
        shares_only,
    )

    kind: Literal["lever-arm"]
    """Kind of element to design."""
    target: Target
    """What the spring at the lever's end is to do, to both sides alike."""
    mechanism: Mechanism
    """The lever, its pivot and what is behind it."""
    leaf: LeafSpec
    """The leaf, or several equal ones side by side that act together in both directions."""
    envelope: Envelope = Field(default_factory=Envelope)
    """The space that the spring may take."""
    connection: Connection = Field(default_factory=Connection)
    """How the lever holds the leaf."""
    mount: Mount = Field(default_factory=Mount)
    """The block by which the leaf is held."""
    optimiser: Optimiser = Field(default_factory=Optimiser)
    """How an omega leaf is searched for."""
    material: MaterialSpec
    """What the leaf is made of, and the stress it is designed for."""
    process: ProcessEntry
    """Cutting process: its name, or a section with name and shop rules of your own."""


SPEC_MODEL = LeverArmSpec
