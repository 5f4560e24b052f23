"""The calculation sheet of a rotary flexure spring: design law, flexure, full load, camshaft."""

from __future__ import annotations

from collections.abc import Iterator

from springcad.errors import InfeasibleError
from springcad.kinds.law_sheet import law_steps
from springcad.kinds.rotary_flexure.aim import Aim, is_open
from springcad.kinds.rotary_flexure.candidates import range_checks
from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.decision import decide
from springcad.kinds.rotary_flexure.feasibility import feasibility_checks
from springcad.kinds.rotary_flexure.inputs import case_of, joint_target_of, number, rotary_spec
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.sheet_law import law_section, room_section
from springcad.kinds.rotary_flexure.sheet_spring import (
    camshaft_section,
    flexure_section,
    load_sections,
    mass_section,
)
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.summary import summarise
from springcad.kinds.strength_sheet import material_section
from springcad.result import Progress
from springcad.sheet import Section, Sheet, Step, derived, found, given
from springcad.spec.source import Spec


def explain_spring(spec: Spec, progress: Progress) -> Sheet:
    """The sheet of the design; of a refused one as far as closed forms go, with the refusal."""
    model = rotary_spec(spec.model)
    try:
        spring, _ = decide(spec, progress)
    except InfeasibleError as refusal:
        if is_open(model):
            material = material_section(model.material)
            return Sheet(spec.kind, spec.name, (material,), range_checks(Aim.of(model)), refusal)
        case = case_of(model)
        sections = _closed(model, case.shifted)
        return Sheet(spec.kind, spec.name, sections, feasibility_checks(case), refusal)
    result = summarise(spec, spring)
    sections = (
        *_closed(model, spring.case),
        flexure_section(spring),
        *load_sections(spring, result),
        camshaft_section(spring),
        mass_section(spring, result),
    )
    return Sheet(spec.kind, spec.name, sections, result.checks)


def _closed(spec: RotaryFlexureSpec, case: Case) -> tuple[Section, ...]:
    """What is known before any search."""
    head = Section("Given", tuple(_given(spec, case))), material_section(spec.material)
    inputs = case.inputs
    if not 0.0 < inputs.contact_radius < inputs.root_radius or inputs.shift != inputs.shift:
        return head
    law = design_law(inputs)
    density = spec.material.values.density.value
    return *head, law_section(case, law), room_section(case, law, density)


def _given(spec: RotaryFlexureSpec, case: Case) -> Iterator[Step]:
    inputs, target, stack = case.inputs, spec.target, case.stack
    page = "theory/rotary-flexure.md, 12"
    if stack.sheets > 1:
        yield given("p_s", "sheets side by side on one camshaft", stack.parallel, "1")
        yield given("m_s", "springs one behind the other", stack.series, "1")
    if target.stiffness is not None and stack.sheets > 1:
        yield given("k_j", "stiffness of the whole joint", target.stiffness, "N*m/rad")
        yield _told(target.deflection, "theta_j", "deflection of the joint, each way",
                    inputs.deflection * stack.series, "rad")  # fmt: skip
        yield derived("k", "stiffness of one sheet", "k_j*m_s/p_s", inputs.stiffness, "N*m/rad",
                      page)  # fmt: skip
        yield derived("theta", "deflection of one sheet, each way", "theta_j/m_s",
                      inputs.deflection, "rad", page)  # fmt: skip
    elif target.stiffness is not None:
        yield given("k", "stiffness of the spring", inputs.stiffness, "N*m/rad")
        yield _told(target.deflection, "theta", "deflection, each way", inputs.deflection, "rad")
    else:
        yield from _law(spec, case)
    envelope = spec.envelope
    yield _told(envelope.root_radius, "R", "radius at which the flexures leave the rim",
                inputs.root_radius, "m")  # fmt: skip
    yield _told(envelope.contact_radius, "r_0", "radius of the contact at rest",
                inputs.contact_radius, "m")  # fmt: skip
    yield _told(envelope.outer_radius, "R_o", "outer radius of the ring", case.outer_radius, "m")
    yield _told(spec.flexures.count, "n", "flexures", inputs.count, "1")
    yield given("t", "thickness of the sheet", inputs.thickness, "m")
    yield given("h_t", "thickness at the tip", 2.0 * inputs.tip_half_thickness, "m")
    yield given("g_min", "smallest gap between neighbours", case.min_gap, "m",
                "flexures.min_gap, or the process")  # fmt: skip
    if case.camshaft_bore_radius:
        yield given("r_b", "radius of the camshaft's bore", case.camshaft_bore_radius, "m")
    if inputs.shift:
        yield found("s_c", "way of the contact towards the root at full load", inputs.shift, "m",
                    "theory/rotary-flexure.md, 10")  # fmt: skip


def _told(typed: float | str, symbol: str, meaning: str, value: float, unit: str) -> Step:
    """A number of the spec, or the one chosen where the spec leaves it open."""
    if isinstance(typed, str):
        return found(symbol, meaning, value, unit, "theory/choose-for-me.md", "chosen")
    return given(symbol, meaning, value, unit)


def _law(spec: RotaryFlexureSpec, case: Case) -> Iterator[Step]:
    """The linear spring with torque and energy of the law at full load."""
    page, law = "theory/rotary-flexure.md, 10", spec.target.law
    assert law is not None, "a valid spec has a stiffness or a law"
    yield given("theta_w", "deflection, each way", number(spec.target.deflection), "rad")
    yield from law_steps(law, joint_target_of(spec), "theta_w")
    stack = case.stack
    share, turn = ("*m_s/p_s", "/m_s") if stack.sheets > 1 else ("", "")
    yield derived("k", "stiffness of the linear spring with both", f"T_w**2/(2*W_w){share}",
                  case.inputs.stiffness, "N*m/rad", page)  # fmt: skip
    yield derived("theta", "deflection of that spring", f"2*W_w/T_w{turn}",
                  case.inputs.deflection, "rad", page)  # fmt: skip
