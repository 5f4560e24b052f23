"""The calculation sheet of a lever arm: what is given, the leaf, the mechanism at both ends."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.errors import InfeasibleError
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.design import make_joint
from springcad.kinds.lever_arm.feasibility import feasibility_checks
from springcad.kinds.lever_arm.inputs import case_of, lever_spec
from springcad.kinds.lever_arm.sheet_leaf import closed_section, spring_section
from springcad.kinds.lever_arm.sheet_mechanism import mechanism_section
from springcad.kinds.lever_arm.summary import summarise
from springcad.kinds.strength_sheet import material_section
from springcad.result import Progress
from springcad.sheet import Section, Sheet, Step, given
from springcad.spec.source import Spec


def explain_joint(spec: Spec, progress: Progress) -> Sheet:
    """The sheet of the design; of a refused one as far as closed forms go, with the refusal."""
    model = lever_spec(spec.model)
    case = case_of(model)
    early = (given_section(case), material_section(model.material), closed_section(case))
    try:
        made = make_joint(model, progress)
    except InfeasibleError as refusal:
        return Sheet(spec.kind, spec.name, early, feasibility_checks(case), refusal)
    result = summarise(spec, made)
    ends = {"near": case.pivot_low, "far": case.pivot_high}
    late = (
        spring_section(made, result),
        *(mechanism_section(made, where, pivot) for where, pivot in ends.items()),
    )
    return Sheet(spec.kind, spec.name, early + late, result.checks)


def given_section(case: Case) -> Section:
    """What the spec says of mechanism and leaf."""
    return Section("Given", tuple(_given(case)))


def _given(case: Case) -> Iterator[Step]:
    lever = case.lever
    yield given("l", "length of the lever", lever.length, "m")
    yield given("R", "radius of the crank", lever.crank_radius, "m")
    yield given(
        "e", f"way of the crank's pin along the lever, over 1 − cos φ ({lever.output})",
        lever.retreat, "m", "theory/lever-arm.md, 1", "ε R; 0 for a yoke: Eq. 1 of 000 is exact",
    )  # fmt: skip
    if math.isfinite(lever.series_stiffness):
        yield given("K_p", "series stiffness", lever.series_stiffness, "N*m/rad")
    yield given("s_max", "deflection of the spring", case.deflection, "m")
    yield given("n", "leaves side by side", case.count, "1")
    if case.stiffness:
        yield given("k_w", "wanted stiffness of all leaves", case.stiffness, "N/m")
    for symbol, meaning, value in (
        ("L", "length of the leaf, pin to clamp", case.length),
        ("t", "thickness of the sheet", case.sheet),
        ("b_w", "width of the leaf at the clamp", case.width),
        ("H", "height of the envelope", case.height),
        ("R_c", "radius of the enclosure", case.radius),
    ):
        if value:
            yield given(symbol, meaning, value, "m")
    if case.layers:
        yield given("N_w", "layers of a leaf", case.layers, "1")
    if case.max_pivot_force:
        yield given("N_max", "largest force on the pivot", case.max_pivot_force, "N")
