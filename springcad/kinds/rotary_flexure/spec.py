"""The spec of a rotary flexure spring: a ring of tapered flexures round a toothed camshaft.

The symbols of paper 004: outer and root radius, contact radius r, thickness t, number of flexures
n, stiffness k, design deflection theta. All values are SI.
"""

from __future__ import annotations

import math
from importlib.resources import files
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field

from springcad.kinds.law_spec import LAW_RULES, reaches
from springcad.kinds.rotary_flexure.calibration_spec import (
    CalibrationEntry,
    one_friction,
    same_material,
)
from springcad.kinds.rotary_flexure.objective_rules import OBJECTIVE_RULES
from springcad.kinds.rotary_flexure.spec_sections import (
    Camshaft,
    Envelope,
    Flexures,
    Mounting,
    Optimiser,
    Target,
)
from springcad.kinds.rotary_flexure.stack_spec import STACK_RULES, StackSection
from springcad.kinds.rotary_flexure.tolerance_spec import TOLERANCE_RULES, Tolerance
from springcad.spec.common import (
    CommonSpec,
    ProcessEntry,
    ProcessSpec,
    below_process,
    default,
)
from springcad.spec.material import MaterialSpec
from springcad.spec.points import Points
from springcad.spec.rules import Rule, rule
from springcad.spec.units import LENGTH, show

TEMPLATE = files(__package__).joinpath("template.yaml").read_text(encoding="utf-8")


Objective = Literal["deflection", "mass", "diameter", "margin"]


def _mounting(value: object) -> object:
    if value == "bore":
        return {"dowels": None}
    if not isinstance(value, dict):
        raise ValueError("must be bore, or dowels with their count and radius")
    return value


@rule("target")
def _stiffness_or_law(target: Target) -> str | None:
    if (target.stiffness is None) != (target.law is None):
        return None
    return f"give one of stiffness, law; {'none' if target.law is None else 'both'} given"


@rule("target.law.table", "target.deflection")
def _torque_table_reaches(points: Points | None, deflection: float | str) -> str | None:
    return None if isinstance(deflection, str) else reaches(points, deflection)


@rule("target.law.stiffness.table", "target.deflection")
def _stiffness_table_reaches(points: Points | None, deflection: float | str) -> str | None:
    return None if isinstance(deflection, str) else reaches(points, deflection)


@rule("envelope.root_radius", "envelope.outer_radius", "process")
def _rim(root: float | str, outer: float | str, process: ProcessSpec) -> str | None:
    if isinstance(root, str) or isinstance(outer, str):
        return None
    if root >= outer:
        return f"must be less than outer_radius, {show(outer, LENGTH)}"
    return below_process(
        "a rim (outer less root radius)", outer - root, process.rules.min_web, process
    )


@rule("envelope.contact_radius", "envelope.root_radius")
def _flexure_length(contact: float | str, root: float | str) -> str | None:
    if isinstance(contact, str) or isinstance(root, str):
        return None
    return None if contact < root else f"must be less than root_radius, {show(root, LENGTH)}"


@rule("camshaft.bore_radius", "envelope.contact_radius")
def _bore(bore: float | None, contact: float | str) -> str | None:
    if bore is None or isinstance(contact, str) or bore < contact:
        return None
    return f"must be less than contact_radius, {show(contact, LENGTH)}"


@rule("flexures.tip_thickness", "process")
def _tip(tip: float, process: ProcessSpec) -> str | None:
    return below_process("a web", tip, process.rules.min_web, process)


@rule("flexures.min_gap", "process")
def _gap(gap: float | None, process: ProcessSpec) -> str | None:
    return None if gap is None else below_process("a gap", gap, process.rules.min_gap, process)


@rule("flexures.root_fillet", "process")
def _fillet(fillet: float | str, process: ProcessSpec) -> str | None:
    if isinstance(fillet, str):
        return None
    return below_process("an inside radius", fillet, process.rules.min_inside_radius, process)


@rule("mounting.dowels.radius", "envelope.root_radius", "envelope.outer_radius", "process")
def _dowel_depth(
    radius: float, root: float | str, outer: float | str, process: ProcessSpec
) -> str | None:
    if isinstance(root, str) or isinstance(outer, str) or root >= outer:
        return None
    web = outer - root - radius
    return below_process("a web between dowel and root radius", web, process.rules.min_web, process)


@rule("mounting.dowels.count", "mounting.dowels.radius", "envelope.outer_radius")
def _dowel_pitch(count: int, radius: float, outer: float | str) -> str | None:
    if isinstance(outer, str) or radius < outer * math.sin(math.pi / count):
        return None
    return f"{count} dowels of radius {show(radius, LENGTH)} overlap on the outer edge"


@rule("camshaft.min_tooth", "process")
def _tooth(tooth: float | None, process: ProcessSpec) -> str | None:
    return None if tooth is None else below_process("a web", tooth, process.rules.min_web, process)


@rule("stress", "optimiser")
def _local_stress(stress: str, optimiser: Optimiser) -> str | None:
    if stress == "nominal" or optimiser.form == "curvature":
        return None
    return "local needs optimiser.form: curvature; the form of paper 004 knows nominal stress only"


@rule("optimiser.control_points", "optimiser")
def _control_points(_: int, optimiser: Optimiser) -> str | None:
    return _only_control_points("control_points", optimiser)


@rule("optimiser.weighting", "optimiser")
def _weighting(_: str, optimiser: Optimiser) -> str | None:
    return _only_control_points("weighting", optimiser)


@rule("optimiser.coefficients", "optimiser")
def _coefficients(_: int, optimiser: Optimiser) -> str | None:
    if optimiser.form == "curvature" or "coefficients" not in optimiser.model_fields_set:
        return None
    return "has a meaning with form: curvature only"


def _only_control_points(key: str, optimiser: Optimiser) -> str | None:
    if optimiser.form == "control-points" or key not in optimiser.model_fields_set:
        return None
    return "has a meaning with form: control-points only"


class RotaryFlexureSpec(CommonSpec):
    """A rotary flexure spring (paper 004)."""

    RULES: ClassVar[tuple[Rule, ...]] = (
        _stiffness_or_law,
        *LAW_RULES,
        _torque_table_reaches,
        _stiffness_table_reaches,
        _rim,
        _flexure_length,
        _bore,
        _tip,
        _gap,
        _fillet,
        _dowel_depth,
        _dowel_pitch,
        _local_stress,
        _control_points,
        _weighting,
        _coefficients,
        _tooth,
        *OBJECTIVE_RULES,
        same_material,
        one_friction,
        *STACK_RULES,
        *TOLERANCE_RULES,
    )

    kind: Literal["rotary-flexure"]
    """Kind of element to design."""
    target: Target
    """What the spring is to do."""
    envelope: Envelope
    """The space that the spring may take."""
    flexures: Flexures
    """The flexures between rim and camshaft."""
    material: MaterialSpec
    """What the part is made of, and the stress it is designed for."""
    stress: Literal["nominal", "local"] = "nominal"
    """What design_stress bounds: the bending stress of the taper law, or that of inner fibres."""
    process: ProcessEntry
    """Cutting process: its name, or a section with name and shop rules of your own."""
    mounting: Annotated[
        Mounting,
        BeforeValidator(_mounting, json_schema_input_type=Literal["bore"] | Mounting),
    ] = default("bore")
    """How the rim is held: bore (pressed in), or dowels with count and radius."""
    camshaft: Camshaft = Field(default_factory=Camshaft)
    """The toothed shaft inside the flexures."""
    optimiser: Optimiser = Field(default_factory=Optimiser)
    """How the serpentine centre line is searched for."""
    stack: StackSection = Field(default_factory=StackSection)
    """Sheets in parallel and springs in series, as one joint."""
    objective: Objective | None = None
    """What auto values are chosen for: the largest deflection (with target.deflection: max), the
    least mass or diameter, or the largest margin to all limits; if not given, deflection where that
    is max, else margin where count or contact radius is auto, else mass."""
    calibration: CalibrationEntry = None
    """What a bench test of an earlier design has told: a file of springcad calibrate."""
    tolerance: Tolerance | None = None
    """What the shop holds: the share of parts that come out as wanted is then reported."""


SPEC_MODEL = RotaryFlexureSpec
