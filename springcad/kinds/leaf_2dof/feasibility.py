"""Can the leaves do it? Closed forms only, before the exact unit is looked at."""

from __future__ import annotations

import math
from dataclasses import replace

from springcad.kinds.feasible import advised, require_all
from springcad.kinds.knobs import Knob, far_remedies, remedies
from springcad.kinds.leaf_2dof import estimate, paper_unit
from springcad.kinds.leaf_2dof.case import END_MARGIN, Case, Setup, in_mm
from springcad.kinds.leaf_2dof.sizing import approach, closed_form_setup
from springcad.kinds.leaf_2dof.spec import MOST_LEAVES
from springcad.kinds.leaf_2dof.unit import rest_stiffness
from springcad.result import Check, check

STIFFNESS_TOLERANCE = 0.01
"""By which the stiffness may miss the end of the wanted range."""
STOUTEST = 0.2
"""Thickness over effective length up to which a leaf bends as a beam within 1 %."""


_EVERY = (
    "design stress against yield",
    "least stiffness at rest",
    "greatest stiffness at rest",
    "stress at the clamp (estimate)",
    "bend angle (estimate)",
    "stiffness at the deflection (estimate)",
    "thickness over effective length",
    "gap between roller and guide",
    "length of the whole leaf",
)
"""What fails of a case that no spec may state."""


def setup_of(case: Case) -> Setup:
    """The unit by closed forms; of a free number of leaves the fewest that no check refuses."""
    if case.leaves is not None:
        return closed_form_setup(case, case.leaves)
    for leaves in range(1, MOST_LEAVES + 1):
        setup = closed_form_setup(case, leaves)
        if not any(claim.status == "fail" for claim in _checks(case, setup)):
            break
    return setup


def leaf_length(case: Case, longest: float) -> float:
    """Of the whole leaf, from mount to contact end (m); the contact's travel is an estimate."""
    rise = case.arm_radius * math.sin(case.deflection)
    travel = 0.6 * rise**2 / longest
    if case.clamp == "outboard":
        travel += case.arm_radius * (1.0 - math.cos(case.deflection))
    return case.mount_length + case.guide_length + longest + travel + END_MARGIN + case.end_radius


def feasibility_checks(case: Case) -> tuple[Check, ...]:
    """All closed-form checks; those that fail carry remedies that make every one of them pass."""
    return advised(_checks(case, setup_of(case)), lambda: case_remedies(case))


def require_feasible(case: Case) -> tuple[Check, ...]:
    """The checks of a feasible case; InfeasibleError with the first failing one otherwise."""
    return require_all(
        _checks(case, setup_of(case)),
        lambda: case_remedies(case),
        lambda claim: f"{claim.name} ({claim.source})",
    )


def failures(case: Case) -> tuple[str, ...]:
    """Names of the checks that fail, without the numbers in them; for use in searches."""
    if not _is_spec(case):
        return _EVERY
    claims = _checks(case, setup_of(case))
    return tuple(claim.name.partition(",")[0] for claim in claims if claim.status == "fail")


def _is_spec(case: Case) -> bool:
    """Whether a spec may say so: a number must not be turned beyond another one."""
    pairs = (
        (case.shortest, case.longest),
        (case.least_stiffness, case.greatest_stiffness),
        (case.least_width, case.width),
        (case.least_thickness, case.thickness),
        (case.roller_radius, case.arm_radius),
        (case.thickness, case.least_width or case.width),
        (1, case.leaves),
        (case.leaves, MOST_LEAVES),
        (2.0 * case.end_radius, case.least_width or case.width),
    )
    return all(low is None or high is None or low <= high for low, high in pairs)


def case_remedies(case: Case) -> tuple[str, ...]:
    """Changes of the spec after which every check passes, each one recomputed.

    An estimate that fails must then keep its limit by its error, so that the exact unit does too;
    one that is within it of a limit to begin with need not.
    """
    close = set(failures(_cautious(case))).difference(failures(case))

    def left(tried: Case) -> tuple[str, ...]:
        unsure = failures(_cautious(tried))
        still = failures(tried) if close.intersection(unsure) else ()
        return tuple(name for name in unsure if name not in close or name in still)

    knobs = knobs_of(case)
    return remedies(case, knobs, left) or far_remedies(case, knobs, left)


def _cautious(case: Case) -> Case:
    """The case with its estimates taken to be wrong by their error, to the bad side."""
    margin = 1.0 + estimate.ESTIMATE_ERROR
    return replace(
        case,
        stress_factor=max(case.stress_factor, margin),
        slope_factor=max(case.slope_factor, margin),
        stroke_factor=1.0 / (1.0 + estimate.STROKE_ERROR),
    )


def _checks(case: Case, setup: Setup) -> tuple[Check, ...]:
    """Every claim, without remedies; in this order the first failing one is reported."""
    return (*exact_checks(case, setup), *_bending(case, setup), *_room(case, setup))


def exact_checks(case: Case, setup: Setup) -> tuple[Check, ...]:
    """The claims that no finer model repeats."""
    return (
        check("design stress against yield", case.design_stress, "<=", case.yield_strength, "Pa",
              source="material data"),
        *_stiffness(case, setup),
    )  # fmt: skip


def _stiffness(case: Case, setup: Setup) -> tuple[Check, ...]:
    if case.least_stiffness is None or case.greatest_stiffness is None:
        return ()
    most, least = (
        setup.leaves * float(rest_stiffness(setup.leaf, setup.lever, length))
        for length in (setup.shortest, setup.longest)
    )
    source = f"003, Eq. 16, with shear, {setup.leaves} leaves; within {STIFFNESS_TOLERANCE:.0%}"
    return (
        check(f"least stiffness at rest, length {in_mm(setup.longest)}", least, "<=",
              (1.0 + STIFFNESS_TOLERANCE) * case.least_stiffness, "N*m/rad", source=source),
        check(f"greatest stiffness at rest, length {in_mm(setup.shortest)}", most, ">=",
              (1.0 - STIFFNESS_TOLERANCE) * case.greatest_stiffness, "N*m/rad", source=source),
    )  # fmt: skip


def _bending(case: Case, setup: Setup) -> tuple[Check, ...]:
    """Stress and slope at the deflection; where the estimate cannot tell it is a warning."""
    length, angle = setup.longest, case.deflection
    bent = estimate.bend(setup.leaf, setup.lever, length, angle)
    stress = case.stress_factor * estimate.stress(setup.leaf, setup.lever, length, angle)
    slope = math.inf if bent is None else case.slope_factor * bent.slope
    where = f"at {math.degrees(angle):.4g} deg and length {in_mm(length)}"

    def estimated(name: str, value: float, limit: float, unit: str, factor: float) -> Check:
        error = estimate.ESTIMATE_ERROR if factor == 1.0 else 0.0
        near = value <= (1.0 + error) * limit
        return check(
            f"{name} (estimate), {where}", value, "<=", limit, unit,
            otherwise="warn" if near else "fail",
            source="003, Eqs 3, 6 and 10, with the contact's travel and large slopes; "
            + (f"within {error:.0%}" if error else "scaled to the exact unit"),
        )  # fmt: skip

    claims: tuple[Check, ...] = (
        estimated("stress at the clamp", stress, case.design_stress, "Pa", case.stress_factor),
    )
    if math.isfinite(case.max_bend_angle):
        claims += (estimated("bend angle", slope, case.max_bend_angle, "rad", case.slope_factor),)
    return (*claims, _rising(case, setup, where))


def _rising(case: Case, setup: Setup, where: str) -> Check:
    """Whether the torque still rises there; where the estimate cannot tell it is a warning."""
    at = setup.leaf, setup.lever, setup.longest
    angle = case.deflection / case.stroke_factor
    nearer = estimate.stiffness(*at, angle / (1.0 + estimate.STROKE_ERROR))
    return check(
        f"stiffness at the deflection (estimate), {where}",
        setup.leaves * estimate.stiffness(*at, angle), ">=", 0.0, "N*m/rad",
        otherwise="warn" if case.stroke_factor == 1.0 and nearer >= 0.0 else "fail",
        source=f"beyond its peak the lever runs away; angle within {estimate.STROKE_ERROR:.1%}",
    )  # fmt: skip


def _room(case: Case, setup: Setup) -> tuple[Check, ...]:
    """The leaf at its shortest, roller and guide, and the whole leaf."""
    reached = float(
        paper_unit.deflection_at_stress(
            setup.leaf, setup.lever, setup.shortest, case.design_stress / case.stress_factor
        )
    )
    turned = approach(case, min(reached, case.deflection))
    claims: tuple[Check, ...] = (
        check(f"gap between roller and guide, length {in_mm(setup.shortest)}",
              setup.shortest - case.roller_radius - turned, ">=", case.clearance, "m",
              source="L - r, less the roller's approach; a guide as high as the roller; smallest "
              "gap of the process"),
        check(f"thickness over effective length, length {in_mm(setup.shortest)}",
              setup.leaf.thickness / setup.shortest, "<=", STOUTEST, "1",
              source="a beam is slender: finite elements then agree within 1 %"),
    )  # fmt: skip
    if math.isfinite(case.leaf_room):
        claims += (
            check("length of the whole leaf, contact end included",
                  leaf_length(case, setup.longest), "<=", case.leaf_room, "m",
                  source="mount, guide, longest effective length, travel of the contact, end"),
        )  # fmt: skip
    return claims


_ALWAYS = (
    Knob("target.deflection", "deg", math.pi / 180.0, "deflection", upwards=False),
    Knob("unit.arm_radius", "mm", 1e-3, "arm_radius"),
    Knob("unit.roller_radius", "mm", 1e-3, "roller_radius", upwards=False),
    Knob("material.design_stress", "MPa", 1e6, "design_stress", upwards=False),
)
"""What a user may change in any case, most telling first. Raising a stress is not a cure."""


def knobs_of(case: Case) -> tuple[Knob, ...]:
    """What may be changed in this case."""
    knobs = list(_ALWAYS)
    if case.least_stiffness is not None:
        knobs += [
            Knob("the least target.stiffness", "N*m/rad", 1.0, "least_stiffness"),
            Knob("the greatest target.stiffness", "N*m/rad", 1.0, "greatest_stiffness"),
        ]
    if case.leaves is not None:
        knobs.append(Knob("unit.leaves_per_axis", "", 1.0, "leaves"))
    if case.longest is not None:
        knobs += [
            Knob("the longest leaf.effective_length", "mm", 1e-3, "longest"),
            Knob("the shortest leaf.effective_length", "mm", 1e-3, "shortest"),
        ]
    for name, low in (("width", case.least_width), ("thickness", case.least_thickness)):
        bound = "" if low is None else "the upper bound of "
        knobs.append(Knob(f"{bound}leaf.{name}", "mm", 1e-3, name))
    if math.isfinite(case.leaf_room):
        knobs.append(Knob("envelope.leaf_length", "mm", 1e-3, "leaf_room"))
    if math.isfinite(case.max_bend_angle):
        knobs.append(Knob("leaf.max_bend_angle", "deg", math.pi / 180.0, "max_bend_angle"))
    return tuple(knobs)
