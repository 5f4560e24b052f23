"""The spec of a roller cam: a cantilever whose contact part a roller on a drum presses aside.

The symbols of paper 001: length l, height h and width w of the cantilever, roller radius r, drum
radius R, offset y₀ of the roller, torque τ, deflection β. All values are SI.
"""

from __future__ import annotations

from importlib.resources import files
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from springcad.kinds.law_spec import LAW_RULES, reaches
from springcad.kinds.roller_cam.sections import (
    CantileverSpec,
    ContactPart,
    Drum,
    Envelope,
    Mount,
    Stepwise,
    Target,
)
from springcad.spec.common import CommonSpec, ProcessEntry, ProcessSpec, below_process
from springcad.spec.material import MaterialSpec
from springcad.spec.points import Points
from springcad.spec.rules import Rule, rule
from springcad.spec.units import ANGLE, LENGTH, show

TEMPLATE = files(__package__).joinpath("template.yaml").read_text(encoding="utf-8")


@rule("target.dead_zone", "target.deflection")
def _dead_zone(dead_zone: float, deflection: float) -> str | None:
    return None if dead_zone < deflection else f"must be less than {show(deflection, ANGLE)}"


@rule("target.law.table", "target.deflection", "target.dead_zone")
def _torque_table_reaches(points: Points | None, deflection: float, dead: float) -> str | None:
    return reaches(points, deflection - dead)


@rule("target.law.stiffness.table", "target.deflection", "target.dead_zone")
def _stiffness_table_reaches(points: Points | None, deflection: float, dead: float) -> str | None:
    return reaches(points, deflection - dead)


@rule("joint.roller_radius", "joint.drum_radius")
def _roller(roller: float, drum: float) -> str | None:
    return None if roller < drum else f"must be less than drum_radius, {show(drum, LENGTH)}"


@rule("cantilever", "envelope.thickness")
def _sizing(cantilever: CantileverSpec, thickness: tuple[float, float]) -> str | None:
    bounds = (cantilever.length, cantilever.height, thickness)
    is_free = any(low < high for low, high in bounds)
    if is_free and cantilever.objective is None:
        return "bounds need an objective: what to size the cantilever for"
    if cantilever.objective is not None and not is_free:
        return "objective has nothing to size; give length, height or thickness as [low, high]"
    return None


@rule("cantilever.stiffness", "cantilever.objective")
def _stiffness_sized(stiffness: float | None, objective: str | None) -> str | None:
    if stiffness is None and objective == "target_stiffness":
        return "missing: objective target_stiffness needs it"
    if stiffness is not None and objective not in ("target_stiffness", "min_stress"):
        return "has a meaning with objective target_stiffness or min_stress only"
    return None


@rule("cantilever.height", "process")
def _height(height: tuple[float, float], process: ProcessSpec) -> str | None:
    return below_process("a web", height[0], process.rules.min_web, process)


@rule("contact_part.thickness", "process")
def _contact_part(thickness: float, process: ProcessSpec) -> str | None:
    return below_process("a web", thickness, process.rules.min_web, process)


@rule("cantilever.root_fillet", "process")
def _fillet(fillet: float, process: ProcessSpec) -> str | None:
    return below_process("an inside radius", fillet, process.rules.min_inside_radius, process)


@rule("mount.hole_diameter", "mount.holes", "mount.length", "mount.height", "process")
def _holes(
    diameter: float, count: int, length: float, height: float, process: ProcessSpec
) -> str | None:
    if not count:
        return None
    rules = process.rules
    if 0.5 * diameter < rules.min_inside_radius * (1.0 - 1e-9):
        return below_process("a radius", 0.5 * diameter, rules.min_inside_radius, process)
    web = min(0.5 * (length - diameter), (height - count * diameter) / (2.0 * count))
    return below_process("a web beside the holes", web, rules.min_web, process)


@rule("mount.height", "joint.roller_offset")
def _mount(height: float, offset: float) -> str | None:
    if height <= 2.0 * offset * (1.0 + 1e-9):
        return None
    limit = show(2.0 * offset, LENGTH)
    return f"must be at most {limit}, twice the roller's offset: there the mirrored mount begins"


@rule("stepwise", "method")
def _stepwise(stepwise: Stepwise, method: str) -> str | None:
    if method == "stepwise" or not stepwise.model_fields_set:
        return None
    return "has a meaning with method: stepwise only"


@rule("compensation", "method")
def _stepped_compensation(compensation: str, method: str) -> str | None:
    if method == "stepwise" and compensation == "compliance":
        return "the iteration takes the contact part as rigid; use shift, multiplicative or none"
    return None


class RollerCamSpec(CommonSpec):
    """A roller cam: a cantilever with a contact profile for a given torque law (paper 001)."""

    RULES: ClassVar[tuple[Rule, ...]] = (
        *LAW_RULES,
        _dead_zone,
        _torque_table_reaches,
        _stiffness_table_reaches,
        _roller,
        _sizing,
        _stiffness_sized,
        _height,
        _contact_part,
        _fillet,
        _holes,
        _mount,
        _stepwise,
        _stepped_compensation,
    )

    kind: Literal["roller-cam"]
    """Kind of element to design."""
    target: Target
    """What the joint is to do, in both directions alike."""
    groups: Annotated[int, Field(ge=1, le=100)] = 1
    """Number of groups that share the torque; a group is an element for each direction."""
    joint: Drum
    """The turning drum and the roller on it."""
    envelope: Envelope
    """The space that the element may take."""
    cantilever: CantileverSpec
    """The elastic part: given, or sized between bounds."""
    contact_part: ContactPart = Field(default_factory=ContactPart)
    """What carries the profile at the tip of the cantilever."""
    mount: Mount = Field(default_factory=Mount)
    """The block by which the element is held."""
    material: MaterialSpec
    """What the element is made of, and the stress it is designed for."""
    process: ProcessEntry
    """Cutting process: its name, or a section with name and shop rules of your own."""
    friction: Annotated[float, Field(ge=0.0, le=0.6)] = 0.0
    """Tangential over normal force on the roller, for the hysteresis; a bare number."""
    method: Literal["energy", "stepwise"] = "energy"
    """How the profile is found: from the energy balance, or by the iteration of paper 001."""
    stepwise: Stepwise = Field(default_factory=Stepwise)
    """The iteration of paper 001; for method stepwise only."""
    compensation: Literal["none", "shift", "multiplicative", "compliance"] = "compliance"
    """How the profile allows for the bending of the contact part; shift is that of paper 001."""
    torque_tolerance: Annotated[float, Field(ge=0.0001, le=0.1)] = 0.002
    """Largest share of the full torque by which the drawing's arcs may change the torque."""


SPEC_MODEL = RollerCamSpec
