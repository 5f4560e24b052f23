"""The calculation sheet of a roller cam: law, cantilever, contact at full stroke, joint."""

from __future__ import annotations

from collections.abc import Iterator

from springcad.errors import InfeasibleError
from springcad.kinds.law_sheet import law_steps
from springcad.kinds.roller_cam.design import make_joint
from springcad.kinds.roller_cam.feasibility import feasibility_checks
from springcad.kinds.roller_cam.inputs import case_of, group_law, roller_spec
from springcad.kinds.roller_cam.joint import Roller
from springcad.kinds.roller_cam.sheet_cantilever import cantilever_section, limits_section
from springcad.kinds.roller_cam.sheet_contact import (
    contact_section,
    joint_section,
    profile_section,
)
from springcad.kinds.roller_cam.spec import RollerCamSpec
from springcad.kinds.roller_cam.summary import summarise
from springcad.kinds.strength_sheet import material_section
from springcad.result import Progress
from springcad.sheet import Section, Sheet, Step, given
from springcad.spec.source import Spec


def explain_joint(spec: Spec, progress: Progress) -> Sheet:
    """The sheet of the design; of a refused one as far as closed forms go, with the refusal."""
    model = roller_spec(spec.model)
    case = case_of(model)
    head = (
        given_section(model, case.joint.roller),
        law_section(model),
        material_section(model.material),
    )
    try:
        made = make_joint(model, progress)
    except InfeasibleError as refusal:
        early = cantilever_section(model, case.joint), limits_section(case, case.joint)
        return Sheet(spec.kind, spec.name, head + early, feasibility_checks(case), refusal)
    result = summarise(spec, made)
    sections = (
        cantilever_section(model, made.joint),
        limits_section(case, made.joint),
        profile_section(made),
        contact_section(made),
        joint_section(made, result),
    )
    return Sheet(spec.kind, spec.name, head + sections, result.checks)


def given_section(spec: RollerCamSpec, roller: Roller) -> Section:
    """Drum, roller and groups."""
    return Section("Given", tuple(_given(spec, roller)))


def law_section(spec: RollerCamSpec) -> Section:
    """The law of one group at the full deflection."""
    law, target = group_law(spec), spec.target
    shared = "N_g" if target.per == "joint" and spec.groups > 1 else ""
    angle = "beta_w - beta_0" if target.dead_zone else "beta_w"
    return Section(
        "The torque law of one group", tuple(law_steps(target.law, law, angle, shared)),
        f"{law.words}.",
    )  # fmt: skip


def _given(spec: RollerCamSpec, roller: Roller) -> Iterator[Step]:
    yield given("beta_w", "deflection, each way", spec.target.deflection, "rad")
    if spec.target.dead_zone:
        yield given("beta_0", "dead zone, each way", spec.target.dead_zone, "rad")
    yield given("N_g", "groups", spec.groups, "1")
    yield given("R", "radius of the drum, to the roller's centre", roller.drum_radius, "m")
    yield given("r", "radius of the roller", roller.radius, "m")
    yield given("y_0", "offset of the roller over the cantilever", roller.offset, "m")
    yield given("x_c", "roller's centre from the tip, along the cantilever", roller.start, "m",
                "theory/roller-cam.md, 1")  # fmt: skip
    yield given("r_f", "radius of the root fillets", spec.cantilever.root_fillet, "m")
    yield given("d_c", "thickness of the contact part", spec.contact_part.thickness, "m")
