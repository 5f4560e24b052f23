"""Can any ring of flexures meet the spec? Closed forms only, before any optimisation.

Each limit is necessary: a case that fails one has no design. A case that passes all may still turn
out to have none, because the shape of a serpentine flexure is only found by optimisation.
"""

from __future__ import annotations

import math
from dataclasses import replace

from springcad.kinds.feasible import advised, require_all
from springcad.kinds.knobs import Knob, remedies
from springcad.kinds.rotary_flexure.case import STRAIGHT_TOLERANCE, Case, resolved_style
from springcad.kinds.rotary_flexure.law import DesignLaw, design_law
from springcad.kinds.rotary_flexure.loaded_contact import FARTHEST, stiffening_by
from springcad.kinds.rotary_flexure.room import (
    deflection_bound,
    hub_shear_stress,
    neighbour_gap,
    packing_bound,
)
from springcad.kinds.rotary_flexure.stack import knobs_of_joint
from springcad.result import Check, check

STRAIGHT_ROOM = 0.15
"""Share of f_s by which a straight flexure may exceed the closed form before it is refused without
a look at the exact beam, whose limit is 2.4 % higher for S1 of 004 (``straight_limit``)."""
DENSE = 0.80
"""Density factor above which a solution is doubtful: 004 had difficulty above 0.55, our search
above 0.75 to 0.83 depending on the bends allowed."""

SLOT_ALLOWANCE = 2e-6
"""By so much the arcs near rest may make a slot narrower than its tip, m."""
DENSITY_CLAIM = "density factor within experience"
LAW_CLAIM = "stiffness of the law"

ROUND_OFF = 12
"""Decimals of a metre to which differences of typed lengths are rounded before a comparison."""


SOFTENING = 0.9
"""Least secant stiffness at full load over that at rest that is tried: to soften, the contact
would have to move beyond the flexures' noses."""


def feasibility_checks(case: Case) -> tuple[Check, ...]:
    """All closed-form checks; those that fail carry remedies that make every one of them pass."""
    return advised(closed_forms(case), lambda: case_remedies(case))


def require_feasible(case: Case) -> tuple[Check, ...]:
    """The checks of a feasible case; InfeasibleError with the first failing one otherwise."""
    return require_all(closed_forms(case), lambda: case_remedies(case), _words)


def _words(claim: Check) -> str:
    """What is impossible; of a law, which is not a matter of more or less, also why."""
    return f"{claim.name} ({claim.source})" if LAW_CLAIM in claim.name else claim.name


def closed_forms(case: Case, straight_room: float = STRAIGHT_ROOM) -> tuple[Check, ...]:
    """Every claim, without remedies; in this order the first failing one is reported."""
    inputs = case.inputs
    if not 0.0 < inputs.contact_radius < inputs.root_radius:
        return (
            check("contact radius within the root radius", inputs.contact_radius, "<=",
                  inputs.root_radius, "m", source="the flexures span from one to the other"),
        )  # fmt: skip
    stiffens = _stiffening(case)
    if any(claim.status == "fail" for claim in stiffens):
        return stiffens
    case = case.shifted
    law = design_law(case.inputs)
    return (
        *stiffens,
        *_material_and_process(case, law),
        *_serpentine_factor(case, law, straight_room),
        *_density(case, law),
        *_neighbours(case, law),
        *_camshaft(case, law),
    )


def _stiffening(case: Case) -> tuple[Check, ...]:
    """A law may stiffen by as much as moving the contact along a pad of any length can give."""
    if case.law is None:
        return ()
    inputs, name = case.inputs, f"secant {LAW_CLAIM} at full load over that at rest"
    source = "torque^2 / (2 energy) over the law's slope at rest"
    span = inputs.root_radius - inputs.contact_radius
    most = stiffening_by(FARTHEST * span, span, inputs.contact_radius, 1.0)
    if case.law.stiffness_at_rest <= 0.0:
        return (
            check(f"{LAW_CLAIM} at rest", case.law.stiffness_at_rest, ">=",
                  inputs.stiffness / most, "N*m/rad",
                  source="a flexure has a stiffness of its own wherever it is touched"),
        )  # fmt: skip
    stiffening = inputs.stiffness / case.law.stiffness_at_rest
    if math.isnan(case.shifted.inputs.shift):
        return (
            check(name, stiffening, "<=", most, "1",
                  source=f"{source}; contact moved by half of the flexures' length"),
        )  # fmt: skip
    return (
        check(name, stiffening, ">=", SOFTENING, "1",
              source="to soften, the contact would have to leave the tips"),
    )  # fmt: skip


def _material_and_process(case: Case, law: DesignLaw) -> tuple[Check, ...]:
    inputs, web = case.inputs, case.min_web
    rim = round(case.outer_radius - inputs.root_radius - case.dowel_radius, ROUND_OFF)
    return (
        check("design stress against yield", inputs.design_stress, "<=", case.yield_strength,
              "Pa", source="material data"),
        check("tip thickness", 2.0 * inputs.tip_half_thickness, ">=", web, "m",
              source="thinnest web of the process"),
        check("tip thickness against the root's", 2.0 * inputs.tip_half_thickness, "<=",
              2.0 * law.root_half_thickness, "m", source="taper, 004 Eq. 2"),
        check("gap wanted between flexures", round(case.min_gap, ROUND_OFF), ">=",
              round(case.least_gap, ROUND_OFF), "m", source="smallest gap of the process"),
        check("rim between root and dowels" if case.dowel_radius else "rim", rim, ">=", web, "m",
              source="outer radius - root radius - dowel radius; thinnest web of the process"),
    )  # fmt: skip


def _serpentine_factor(case: Case, law: DesignLaw, straight_room: float) -> tuple[Check, ...]:
    """Straight flexures may be too strong but not too weak; waves cannot be shorter than straight.

    By the law of small deflections a straight flexure has (f_s / straight)^(2/3) times the design
    stress, and what it has is known once it is sized; a softer one is made thicker and bears less.
    ``auto`` takes the style that will do.
    """
    straight = law.straight_factor
    source = f"004, section II-B, with the tip thickness; a straight flexure has {straight:.4f}"
    if resolved_style(law, case.style) == "straight":
        return (
            check("serpentine factor of a straight flexure", law.serpentine_factor, "<=",
                  straight * (1.0 + straight_room), "1", source=source),
        )  # fmt: skip
    return (
        check("serpentine factor (below it a straight flexure is already too soft)",
              law.serpentine_factor, ">=", straight, "1", source=source),
    )  # fmt: skip


def _density(case: Case, law: DesignLaw) -> tuple[Check, ...]:
    """Flexures and gaps must fit into the annulus; for straight ones the pinch says it exactly."""
    if resolved_style(law, case.style) == "straight":
        return ()
    inputs = case.inputs
    root, contact = inputs.root_radius, inputs.contact_radius
    densest = float(packing_bound(root, contact, inputs.count, case.min_gap))
    bound = deflection_bound(
        inputs.stiffness, root, contact, inputs.thickness, inputs.design_stress,
        inputs.elastic_modulus,
    )  # fmt: skip
    return (
        check("deflection against a full disk", inputs.deflection, "<=", float(bound), "rad",
              source="004, Eq. 10 with a density factor of 1"),
        check("density factor", law.density_factor, "<=", densest, "1",
              source="flexures and the smallest gaps between them fill the annulus"),
        check(DENSITY_CLAIM, law.density_factor, "<=", DENSE, "1",
              source="solved examples reach 0.75 to 0.83; 004 reports difficulty above 0.55",
              otherwise="warn"),
    )  # fmt: skip


def straight_gap(law: DesignLaw) -> float:
    """Gap at the pinch between straight flexures that are as thick as the stiffness asks, m."""
    inputs = law.inputs
    thick = law.straight_thickness_factor * law.root_half_thickness
    return float(
        neighbour_gap(
            law.lever, inputs.loaded_radius, inputs.count, thick, inputs.tip_half_thickness
        )
    )


def _neighbours(case: Case, law: DesignLaw) -> tuple[Check, ...]:
    straight = resolved_style(law, case.style) == "straight"
    known = math.isfinite(law.straight_thickness_factor)
    gap = straight_gap(law) if straight and known else law.pinch_gap
    return (
        check("cam tooth between two tips", law.tooth_width, ">=",
              max(case.min_tooth, case.min_web), "m",
              source="2 pi r / n - tip thickness; least tooth wanted, thinnest web"),
        check("gap between neighbours near the tips", gap, ">=", case.min_gap, "m",
              source="pinch between tapered neighbours; the smallest gap wanted"),
    )  # fmt: skip


def _camshaft(case: Case, law: DesignLaw) -> tuple[Check, ...]:
    """The cam's core ends where the noses of the tips begin; its teeth add nothing in torsion."""
    core = law.inputs.contact_radius - law.inputs.tip_half_thickness
    bore = case.camshaft_bore_radius
    slot = check("camshaft slot", 2.0 * law.inputs.tip_half_thickness + case.backlash, ">=",
                 case.min_slot + SLOT_ALLOWANCE, "m",
                 source="tip thickness + backlash; smallest gap and twice the smallest inside "
                 "radius of the process, 0.002 mm for the flanks' arcs")  # fmt: skip
    wall = check("camshaft wall around its bore", round(core - bore, ROUND_OFF), ">=",
                 case.min_web, "m",
                 source="contact radius - tip nose - bore radius; thinnest web")  # fmt: skip
    if core <= bore:
        return (slot, wall)
    shear = float(hub_shear_stress(case.stack.parallel * law.torque, core, bore))
    torsion = "torsion of the core within the tips, without notches; von Mises"
    return (
        slot,
        *((wall,) if bore > 0.0 else ()),
        check("camshaft torsion against yield", shear, "<=",
              case.yield_strength / math.sqrt(3.0), "Pa", source=torsion),
        check("camshaft torsion against the design stress", shear, "<=",
              law.inputs.design_stress / math.sqrt(3.0), "Pa", source=torsion, otherwise="warn"),
    )  # fmt: skip


KNOBS = (
    Knob("target.deflection", "deg", math.pi / 180.0, "inputs.deflection"),
    Knob("envelope.root_radius", "mm", 1e-3, "inputs.root_radius"),
    Knob("envelope.contact_radius", "mm", 1e-3, "inputs.contact_radius"),
    Knob("flexures.count", "", 1.0, "inputs.count"),
    Knob("envelope.thickness", "mm", 1e-3, "inputs.thickness"),
    Knob("envelope.outer_radius", "mm", 1e-3, "outer_radius"),
    Knob("flexures.tip_thickness", "mm", 0.5e-3, "inputs.tip_half_thickness"),
    Knob("target.stiffness", "N*m/rad", 1.0, "inputs.stiffness"),
    Knob("material.design_stress", "MPa", 1e6, "inputs.design_stress", upwards=False),
    Knob("flexures.min_gap", "mm", 1e-3, "min_gap", upwards=False),
    Knob("mounting.dowels.radius", "mm", 1e-3, "dowel_radius", upwards=False),
    Knob("camshaft.backlash", "mm", 1e-3, "backlash"),
    Knob("camshaft.bore_radius", "mm", 1e-3, "camshaft_bore_radius", upwards=False),
)
"""What a user may change, most telling first. Design stress, gap and bores may only be lowered:
raising a stress is not a cure."""


def case_remedies(case: Case) -> tuple[str, ...]:
    """Changes of the spec after which every closed-form check passes, each one recomputed."""
    # A law says torque and deflection in ways of its own.
    knobs = knobs_of_joint(KNOBS, case.stack)
    own = knobs if case.law is None else [k for k in knobs if not k.key.startswith("target.")]
    doubts = _doubts(case)

    def left(tried: Case) -> tuple[str, ...]:
        return _doubts(tried) if _is_spec(tried) else (*doubts, "rules of the spec")

    found = remedies(case, own, left)
    for style in ("straight", "auto"):
        if style != case.style and not failures(replace(case, style=style), STRAIGHT_TOLERANCE):
            return (f"set flexures.style to {style}", *found)
    return found


def failures(case: Case, straight_room: float = STRAIGHT_ROOM) -> tuple[str, ...]:
    """Names of the checks that fail, without remedies: microseconds, for use in searches."""
    return tuple(
        claim.name for claim in closed_forms(case, straight_room) if claim.status == "fail"
    )


def follows_law(case: Case) -> bool:
    """Whether the contact can move as the torque law asks; without that there is no design law."""
    return all(claim.status != "fail" for claim in _stiffening(case))


def _is_spec(case: Case) -> bool:
    """Whether a spec may say so; of a case that none may, few claims are looked at."""
    return case.inputs.contact_radius < case.inputs.root_radius < case.outer_radius


def _doubts(case: Case) -> tuple[str, ...]:
    """Claims that fail, and a density of which a search would hardly make anything."""
    return tuple(
        claim.name
        for claim in closed_forms(case, STRAIGHT_TOLERANCE)
        if claim.status == "fail" or (claim.status == "warn" and claim.name == DENSITY_CLAIM)
    )
