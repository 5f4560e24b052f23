"""The calculation sheet of leaves in a wrist: closed forms, the exact unit, both axes together."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.errors import InfeasibleError
from springcad.kinds.leaf_2dof.case import Case
from springcad.kinds.leaf_2dof.design import make_leaves
from springcad.kinds.leaf_2dof.feasibility import feasibility_checks, setup_of
from springcad.kinds.leaf_2dof.inputs import case_of, leaf_spec
from springcad.kinds.leaf_2dof.seating import away
from springcad.kinds.leaf_2dof.sheet_leaf import estimate_section, leaf_section, paper_section
from springcad.kinds.leaf_2dof.sheet_unit import exact_section, part_section
from springcad.kinds.leaf_2dof.sheet_wrist import wrist_section
from springcad.kinds.leaf_2dof.summary import summarise
from springcad.kinds.strength_sheet import material_section
from springcad.result import Progress
from springcad.sheet import Section, Sheet, Step, given
from springcad.spec.source import Spec


def explain_leaves(spec: Spec, progress: Progress) -> Sheet:
    """The sheet of the design; of a refused one as far as closed forms go, with the refusal."""
    model = leaf_spec(spec.model)
    case = case_of(model)
    head = given_section(case), material_section(model.material)
    try:
        made = make_leaves(model, progress)
    except InfeasibleError as refusal:
        setup = setup_of(case)
        early = leaf_section(case, setup), *paper_section(case, setup)
        return Sheet(spec.kind, spec.name, head + early, feasibility_checks(case), refusal)
    result = summarise(spec, made)
    setup = made.setup
    sections = (
        leaf_section(case, setup),
        *paper_section(case, setup),
        *estimate_section(case, setup),
        *exact_section(made, result),
        wrist_section(made),
        part_section(made),
    )
    return Sheet(spec.kind, spec.name, head + sections, result.checks)


def given_section(case: Case) -> Section:
    """What the spec says of the unit."""
    return Section("Given", tuple(_given(case)))


def _given(case: Case) -> Iterator[Step]:
    yield given("phi_max", "deflection of an axis, longest length", case.deflection, "rad")
    if case.least_stiffness is not None and case.greatest_stiffness is not None:
        yield given("K_min", "least stiffness wanted", case.least_stiffness, "N*m/rad")
        yield given("K_max", "greatest stiffness wanted", case.greatest_stiffness, "N*m/rad")
    yield given("R", "arm of the roller about the pivot", case.arm_radius, "m")
    yield given("r", "radius of the roller", case.roller_radius, "m")
    yield given("d", f"side of the clamp ({case.clamp})", away(case.lever), "1",
                "theory/leaf-2dof.md, 1", "1 outboard, −1 inboard")  # fmt: skip
    if math.isfinite(case.max_bend_angle):
        yield given("theta_max", "largest bend angle of a leaf", case.max_bend_angle, "rad")
    if math.isfinite(case.leaf_room):
        yield given("L_room", "room for the whole leaf", case.leaf_room, "m")
