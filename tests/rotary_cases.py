"""The springs of paper 004, Table I: as problems for the shape search, and as whole designs."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from springcad.export.dxf import part_to_dxf
from springcad.kinds.rotary_flexure.checks import spring_checks
from springcad.kinds.rotary_flexure.design import Spring, build_spring
from springcad.kinds.rotary_flexure.inputs import rotary_spec
from springcad.kinds.rotary_flexure.law import DesignLaw, LawInputs, design_law
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.summary import summarise
from springcad.spec.source import read_spec
from springcad.verify.drawing import read_drawing
from springcad.written import WrittenDesign

TABLE_I = {
    "S1": (31e-3, 6.0e-3, 24, 12.56),
    "S2": (31e-3, 6.0e-3, 24, 14.50),
    "S3": (26e-3, 6.0e-3, 24, 12.09),
    "S4": (26e-3, 5.1e-3, 31, 13.40),
}
"""Root radius, contact radius, number of flexures, deflection in degrees."""


def law_of(name: str) -> DesignLaw:
    """The design law of one of the springs: 150 N*m/rad, 4.5 mm, 200 GPa, 912 MPa."""
    root, contact, count, degrees = TABLE_I[name]
    return design_law(
        LawInputs(
            stiffness=150.0,
            deflection=math.radians(degrees),
            root_radius=root,
            contact_radius=contact,
            count=count,
            thickness=4.5e-3,
            elastic_modulus=200e9,
            design_stress=912e6,
            tip_half_thickness=0.175e-3,
        )
    )


def problem_for(name: str, bend_limit: float, **changes: object) -> FlexureProblem:
    """The shape problem of one of the springs."""
    law = law_of(name)
    problem = FlexureProblem(
        span=law.span,
        root_radius=law.inputs.root_radius,
        count=law.inputs.count,
        root_half_thickness=law.root_half_thickness,
        tip_half_thickness=law.inputs.tip_half_thickness,
        serpentine_factor=law.serpentine_factor,
        bend_limit=bend_limit,
    )
    return replace(problem, **changes)  # type: ignore[arg-type]


SPECS = Path(__file__).parents[1] / "specs"


@cache
def rotary_model(name: str, *overrides: str) -> RotaryFlexureSpec:
    """A shipped spec with overrides as after ``--set``."""
    return rotary_spec(read_spec(SPECS / f"{name}.yaml", overrides).model)


@cache
def spring_of(name: str, *overrides: str) -> Spring:
    """The spring of a shipped spec, designed once for all tests of a run."""
    return build_spring(rotary_model(name, *overrides), lambda _: None)


@cache
def written_of(name: str, *overrides: str) -> WrittenDesign:
    """The same spring as its report and drawings hold it, these read back from files."""
    spec = read_spec(SPECS / f"{name}.yaml", overrides)
    result = summarise(spec, spring_of(name, *overrides))
    contours = {}
    with TemporaryDirectory() as folder:
        for part in result.parts:
            path = Path(folder, f"{part.role}.dxf")
            path.write_text(part_to_dxf(part), encoding="utf-8")
            contours[part.suffix] = read_drawing(path).polylines
    return WrittenDesign(result.kind, result.name, result.design, result.response, contours)


def statuses(name: str, *overrides: str) -> dict[str, str]:
    """Name and status of every check of the spring."""
    return {claim.name: claim.status for claim in spring_checks(spring_of(name, *overrides))}
