"""The finished spring in the calculation sheet: flexure, full load, camshaft, mass."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from springcad.geometry.outline_ops import profile_area
from springcad.kinds.rotary_flexure.checks import root_fillet_stress
from springcad.kinds.rotary_flexure.response import Stroke
from springcad.kinds.rotary_flexure.root_compliance import root_unit
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.strength_sheet import life_steps
from springcad.mechanics.contact import contact_modulus
from springcad.result import Result
from springcad.sheet import Section, Step, derived, found, given, suffixed

_PAGE = "theory/rotary-flexure.md"
_BEAM = "nonlinear beam on the camshaft as drawn"


def flexure_section(spring: Spring) -> Section:
    """The shape that was found and corrected."""
    return Section(
        f"The {spring.found.style} flexure as found", tuple(_flexure(spring)),
        "The law's shape, corrected on the beam with large deflections and the root's compliance "
        "until stiffness and stress are those wanted.",
    )  # fmt: skip


def load_sections(spring: Spring, result: Result) -> tuple[Section, ...]:
    """Both directions at the design deflection."""
    names = {1: ("counter-clockwise", "ccw"), -1: ("clockwise", "cw")}
    both = [
        Section(f"Full load {words}", suffixed(_loaded(spring, stroke), suffix))
        for stroke in spring.strokes
        for words, suffix in (names[stroke.direction],)
    ]
    return *both, Section("Both directions", tuple(_worse(spring, result)))


def camshaft_section(spring: Spring) -> Section:
    """What the camshaft bears."""
    return Section(
        "The camshaft", tuple(_camshaft(spring)),
        "Each direction has the flank that gives the torque law exactly; the loads are those at "
        "the end of the flanks, a little beyond the design deflection.",
    )  # fmt: skip


def mass_section(spring: Spring, result: Result) -> Section:
    """Mass and energy."""
    energy = float(spring.strokes[0].energy[-1])
    steps = [
        found("A_p", "area of the ring as cut", profile_area(spring.ring), "m^2", "outline"),
        derived("m", "mass of the ring", "rho*A_p*t", spring.mass, "kg", "volume"),
        derived("w_m", "energy per mass of the ring", "W_ccw/m", energy / spring.mass, "J/kg",
                "004, Table I"),
    ]  # fmt: skip
    share = result.response.get("hysteresis_share")
    if isinstance(share, float):
        steps += [
            given("mu", "friction of tips and camshaft", spring.spec.camshaft.friction, "1"),
            found("u_mu", "share of the work of loading that a cycle loses", share, "1",
                  f"both flanks with friction, {_PAGE}, 11"),
        ]  # fmt: skip
    return Section("Mass and energy", tuple(steps))


def _flexure(spring: Spring) -> Iterator[Step]:
    law, shape, sized = spring.law, spring.found, spring.sized
    inputs, ribbon = law.inputs, shape.ribbon
    root = 2.0 * float(ribbon.at(np.zeros(1)).half_thickness[0])
    if shape.starts:
        yield found("N_s", "searches", shape.starts, "1", f"{_PAGE}, 6",
                    f"{shape.feasible} met every limit; the widest gap wins")  # fmt: skip
    yield found("N_p", "corrections for full load", sized.passes, "1", f"{_PAGE}, 9")
    yield found("S", "length along the flexure", ribbon.length, "m", "shape")
    yield derived("u_S", "over the lever", "S/L", ribbon.length / law.lever, "1", "comparison")
    yield found("h_r", "thickness at the root", root, "m", f"{_PAGE}, 9")
    yield derived("u_h", "over that of the law", "h_r/(2*lamda_r)",
                  root / (2.0 * law.root_half_thickness), "1", "comparison")  # fmt: skip
    yield found("L_q", "length of the pad", ribbon.length - float(ribbon.edges[-2]), "m",
                f"{_PAGE}, 9")  # fmt: skip
    yield given("z_max", "largest half thickness times curvature allowed",
                spring.spec.flexures.bend_limit, "1")  # fmt: skip
    yield found("z", "largest half thickness times curvature", ribbon.largest_bend, "1", "shape")
    yield derived("u_z", "share of the bend limit", "z/z_max",
                  ribbon.largest_bend / spring.spec.flexures.bend_limit, "1",
                  "comparison")  # fmt: skip
    yield found("g", "smallest gap between neighbours at rest", shape.gap, "m", "polygons")
    yield found("r_f", "radius of the root fillets", spring.fillet, "m", f"{_PAGE}, 8")
    yield derived("C_1", "unit of the root's compliance", "1/(E*t*h_r**2)",
                  root_unit(inputs.elastic_modulus, inputs.thickness, root), "rad/(N*m)",
                  f"{_PAGE}, 8")  # fmt: skip
    yield found("C_r", "compliance of the root", sized.root.compliance, "rad/(N*m)",
                f"finite elements of a sector, {_PAGE}, 8",
                "below 0 the fillets stiffen more than the rim softens")  # fmt: skip
    yield found("K_f", "stress of the fillets over the beam's at the root",
                sized.root.fillet_stress_factor, "1",
                f"finite elements of a sector, {_PAGE}, 8")  # fmt: skip
    yield found("K_0", "stiffness of the ring at rest", sized.stiffness_at_rest, "N*m/rad",
                f"beam on the root's spring, {_PAGE}, 9")  # fmt: skip
    wanted = float(spring.target.stiffness(np.zeros(1))[0])
    yield derived("u_K", "over the wanted one", "K_0/k_0" if spring.case.law else "K_0/k",
                  sized.stiffness_at_rest / wanted, "1", "comparison")  # fmt: skip


def _loaded(spring: Spring, stroke: Stroke) -> Iterator[Step]:
    angle, torque = float(stroke.angle[-1]), float(stroke.torque[-1])
    wanted, full = ("theta_w", "T_w") if spring.case.law else ("theta", "T")
    yield found("phi", "angle", angle, "rad", "last angle of the stroke")
    yield derived("u_phi", "over the wanted one", f"phi/{wanted}",
                  angle / spring.target.deflection, "1", "comparison")  # fmt: skip
    yield found("F", "force on a tip, normal to the flank", float(stroke.force[-1]), "N", _BEAM)
    yield found("c", "contact, along the flexure from the root", float(stroke.station[-1]), "m",
                _BEAM)  # fmt: skip
    yield found("T_f", "torque", torque, "N*m", _BEAM)
    yield derived("p", "arm of the force about the axis", "T_f/(n*F)",
                  torque / (spring.law.inputs.count * float(stroke.force[-1])), "m",
                  "virtual work", "that of the law is r")  # fmt: skip
    yield derived("u_T", "torque over the wanted one", f"T_f/{full}", torque / spring.law.torque,
                  "1", "comparison")  # fmt: skip
    yield derived("K", "secant stiffness", "T_f/phi", torque / angle, "N*m/rad", "definition")
    yield found("W", "energy", float(stroke.energy[-1]), "J", _BEAM)
    yield found("sigma", "largest nominal stress, bending and axial",
                float(stroke.nominal_stress.max()), "Pa", _BEAM)  # fmt: skip
    yield found("sigma_i", "largest stress on an inner fibre", float(stroke.local_stress.max()),
                "Pa", f"{_BEAM}; Winkler's curved bar")  # fmt: skip
    yield found("sigma_r", "nominal stress at the root",
                float(stroke.full.nominal_stress[0, 0]), "Pa", _BEAM)  # fmt: skip
    yield found("p_H", "largest pressure on the flank", float(stroke.pressure.max()), "Pa",
                "strip of contact, theory/camshaft.md, 4")  # fmt: skip
    yield found("g", "smallest gap between deformed neighbours", float(stroke.gap.min()), "m",
                "polygons")  # fmt: skip


def _worse(spring: Spring, result: Result) -> Iterator[Step]:
    """What the parts must bear, and the mean stiffness."""
    nominal, local = (
        max(float(getattr(stroke, field).max()) for stroke in spring.strokes)
        for field in ("nominal_stress", "local_stress")
    )
    secant = 0.5 * sum(float(stroke.torque[-1] / stroke.angle[-1]) for stroke in spring.strokes)
    yield derived("K", "secant stiffness, mean", "(K_ccw + K_cw)/2", secant, "N*m/rad",
                  "definition")  # fmt: skip
    yield derived("sigma", "largest nominal stress", "max(sigma_ccw, sigma_cw)",
                  nominal, "Pa", "the worse")  # fmt: skip
    yield derived("sigma_i", "largest stress on an inner fibre", "max(sigma_i_ccw, sigma_i_cw)",
                  local, "Pa", "the worse")  # fmt: skip
    yield derived("sigma_f", "largest stress in the root fillets",
                  "K_f*max(sigma_r_ccw, sigma_r_cw)", root_fillet_stress(spring), "Pa",
                  f"{_PAGE}, 8")  # fmt: skip
    bounded, value = ("sigma", nominal) if spring.spec.stress == "nominal" else ("sigma_i", local)
    yield derived("u_sigma", "bounded stress over the design stress", f"{bounded}/sigma_d",
                  value / spring.law.inputs.design_stress, "1", "comparison")  # fmt: skip
    yield from life_steps(result, bounded)


def _camshaft(spring: Spring) -> Iterator[Step]:
    camshaft, inputs = spring.camshaft, spring.law.inputs
    slot, bore = camshaft.slot, spring.camshaft_inputs.bore_radius
    modulus = contact_modulus(*(inputs.elastic_modulus, spring.camshaft_inputs.poisson_ratio) * 2)
    force = max(float(side.force.max()) for side in camshaft.flanks)
    torque = float(spring.target.torque(camshaft.flanks[0].angle[-1:])[0])
    lever = slot.tip_radius - slot.foot_radius
    bending = 6.0 * force * lever / (inputs.thickness * camshaft.tooth_thickness**2)
    yield derived("E_c", "modulus of the contact", "E/(2*(1 - nu**2))", modulus, "Pa",
                  "Johnson, Eq. 4.6", "ring and camshaft of one material")  # fmt: skip
    yield found("F_e", "largest force of a tip, to the end of the flanks", force, "N",
                "theory/conjugate-profiles.md")  # fmt: skip
    yield found("T_e", "torque there, of all sheets on a camshaft", spring.stack.parallel * torque,
                "N*m", "target")  # fmt: skip
    yield found("b_c", "thinnest place of a tooth", camshaft.tooth_thickness, "m", "outline")
    yield found("r_t", "radius of the teeth's tips", slot.tip_radius, "m", "outline")
    yield found("r_c", "radius of the centre of a slot's bottom", slot.foot_radius, "m", "outline")
    yield derived("l_t", "lever of the tooth", "r_t - r_c", lever, "m", "outline")
    yield derived("sigma_b", "bending of a tooth, estimate", "6*F_e*l_t/(t*b_c**2)", bending, "Pa",
                  "cantilever, no notch")  # fmt: skip
    yield found("sigma_t", "stress at the root of a tooth", camshaft.tooth_stress, "Pa",
                "finite elements; theory/camshaft.md, 2")  # fmt: skip
    yield found("r_s", "radius of the slots' bottom", slot.bottom_radius, "m", "outline")
    inner = "r_s**4 - r_b**4" if bore else "r_s**4"
    yield derived("tau", "torsion of the core", f"2*T_e*r_s/(pi*({inner}))", camshaft.hub_stress,
                  "Pa", f"{_PAGE}, 5", "round, no notch")  # fmt: skip
    yield found("phi_0", "free play each way", slot.free_play, "rad", "outline")
