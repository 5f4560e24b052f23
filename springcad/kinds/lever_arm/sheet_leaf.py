"""The leaf in the calculation sheet: by closed forms, then as it was found on the beam."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import cast

from springcad.geometry.outline_ops import profile_area
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.estimate import full_thickness, sheet_for
from springcad.kinds.lever_arm.made import MadeJoint
from springcad.kinds.strength_sheet import life_steps
from springcad.mechanics.leaf import (
    SHAPES,
    greatest_energy,
    greatest_stiffness,
    stiffness,
)
from springcad.result import Result, Value
from springcad.sheet import Section, Step, derived, found, given

_LEAF = "theory/leaf-springs.md"
_BEAM = "theory/lever-arm.md, 3"
_OMEGA = "theory/omega-leaf.md"


def closed_section(case: Case) -> Section:
    """What closed forms say before any leaf is bent."""
    if case.shape == "omega":
        return Section(
            "Bound for any spring in the enclosure", tuple(_bound(case)),
            "No closed form gives the stiffness of an omega leaf. What bending can store in the "
            "enclosure's volume bounds it; leaves reach 5 to 20 % of that.",
        )  # fmt: skip
    return Section(
        f"The {case.shape} leaf by closed forms", tuple(_closed(case)),
        "Width and thickness go with (x/L) to the powers a_b and a_h from the pin to the clamp; "
        "Euler and Bernoulli's beam, small deflections.",
    )  # fmt: skip


def spring_section(made: MadeJoint, result: Result) -> Section:
    """The leaf of the design."""
    omega = made.case.shape == "omega"
    steps = _omega(made) if omega else _straight(made)
    text = (
        "The best leaf of many seeded searches, with large deflections, shear and the stress of "
        "curved bars."
        if omega
        else "Sized on the beam with large deflection, shear, eye, fillets and least web."
    )
    return Section("The leaf as found", (*steps, *_spring(made, result)), text)


def _closed(case: Case) -> Iterator[Step]:
    shape = SHAPES[case.shape]
    material = case.elastic_modulus, case.length, case.design_stress, case.deflection
    E, L, sigma, s = material
    yield given("a_b", "exponent of the width", shape.width_exponent, "1", _LEAF)
    yield given("a_h", "exponent of the thickness", shape.thickness_exponent, "1", _LEAF)
    yield derived("c", "factor of the shape", "1/(3 - a_b - 3*a_h)", shape.compliance_factor, "1",
                  _LEAF)  # fmt: skip
    yield derived("eta_A", "share of the leaf's volume that works", "c*(1 + a_b + a_h)/3",
                  shape.volume_utilisation, "1", "000, Eq. 15",
                  "1/3 is the most that bending allows")  # fmt: skip
    yield derived("h_cf", "thickness at the clamp that the stress allows",
                  "2*c*L**2*sigma_d/(E*s_max)", full_thickness(case), "m", "000, Eq. 17",
                  "the thickest leaf that may be bent so far, hence the stiffest")  # fmt: skip
    width = "b_w" if case.shape == "triangular" and case.width else "t"
    b = case.width if width == "b_w" else case.sheet
    if not b:
        return
    yield derived(
        "k_cf", "stiffness of it, " + ("of this width" if width == "b_w" else "one layer"),
        f"2*c**2/3*{width}*L**3*sigma_d**3/(E**2*s_max**3)",
        float(greatest_stiffness(shape, E, b, L, sigma, s)), "N/m", "000, Eq. 19",
    )  # fmt: skip
    yield derived(
        "W_cf", "energy in it at the deflection", "k_cf*s_max**2/2",
        float(greatest_energy(shape, E, b, L, sigma, s)), "J", "000, Eq. 18",
        "section II-D of 000 lacks the 1/2",
    )  # fmt: skip
    sheet = case.sheet or sheet_for(full_thickness(case))
    if width == "b_w" and sheet:
        symbol = "t" if case.sheet else "t_cf"
        if not case.sheet:
            yield found(symbol, "the thickest customary sheet below h_cf", sheet, "m", _BEAM)
        yield derived(
            "k_t", "stiffness of one leaf of this sheet", f"E*b_w*{symbol}**3/(12*c*L**3)",
            float(stiffness(shape, E, b, L, sheet)), "N/m", "000, Eq. 11",
        )  # fmt: skip


def _bound(case: Case) -> Iterator[Step]:
    density = case.design_stress**2 / (2.0 * case.elastic_modulus)
    yield derived("w_d", "energy density at the stress", "sigma_d**2/(2*E)", density, "Pa",
                  "000, III-B")  # fmt: skip
    area = math.pi * case.radius**2
    yield derived("A_c", "area of the enclosure", "pi*R_c**2", area, "m^2", "circle")
    yield derived(
        "k_bound", "stiffness per width that no spring exceeds", "2*w_d*A_c/(3*s_max**2)",
        2.0 * density * area / (3.0 * case.deflection**2), "Pa", "000, III-B",
        "bending uses at most a third of a volume; N/mm per mm is MPa",
    )  # fmt: skip


def _straight(made: MadeJoint) -> Iterator[Step]:
    case, spring = made.case, made.spring
    design = spring.design
    thick, full = (_number(design, key) for key in ("closed_form_thickness_m", "full_thickness_m"))
    yield found("h_full", "thickness at the clamp that the stress allows", full, "m",
                f"nonlinear beam, {_BEAM}")  # fmt: skip
    yield derived("u_h", "against the closed form", "h_full/h_cf", full / thick, "1", "comparison")
    most = _number(design, "full_stiffness_N_per_m")
    if case.shape == "triangular":
        yield found("K_full", "stiffness of all leaves of that thickness", most, "N/m",
                    f"nonlinear beam, {_BEAM}")  # fmt: skip
        if not case.width:
            yield found("b_w", "width at the clamp", spring.width, "m", _BEAM,
                        "the stiffness is as the width")  # fmt: skip
        if not case.sheet:
            yield found("t", "the thickest customary sheet below h_full", spring.sheet, "m", _BEAM)
        yield derived("u_t", "share of the thickness that the sheet has", "t/h_full",
                      spring.sheet / full, "1", "comparison")  # fmt: skip
        return
    yield found("k_1", "stiffness of one layer at full stress", most / case.count / spring.layers,
                "N/m", f"nonlinear beam, {_BEAM}")  # fmt: skip
    yield from _stacked(made)
    yield derived("K_full", "stiffness of all leaves at full stress", "n*N_l*k_1", most, "N/m",
                  "layers and leaves side by side")  # fmt: skip
    h = _number(cast("Mapping[str, Value]", design["leaf"]), "thickness_m")
    if case.stiffness:
        yield found("h", "thickness at the clamp", h, "m", f"nonlinear beam, {_BEAM}",
                    "thinner, about with the cube root, until the stiffness is the wanted one",
                    )  # fmt: skip
    else:
        yield derived("h", "thickness at the clamp", "h_full", h, "m", "no stiffness is wanted")


def _stacked(made: MadeJoint) -> Iterator[Step]:
    """Layers ``N_l`` of a leaf and its width, from the stiffness of one layer, ``k_1``."""
    case, spring = made.case, made.spring
    if case.layers:
        yield derived("N_l", "layers of a leaf", "N_w", spring.layers, "1", "spec")
    else:
        wanted = "ceil((1 - 1e-6)*k_w/(n*k_1))" if case.stiffness else "1"
        yield derived("N_l", "layers of a leaf", wanted, spring.layers, "1", _BEAM,
                      "the fewest that reach the wanted stiffness")  # fmt: skip
    yield derived("b", "width of a leaf", "N_l*t", spring.width, "m", "stack of sheet")


def _omega(made: MadeJoint) -> Iterator[Step]:
    case, spring = made.case, made.spring
    design, response = spring.design, spring.response
    leaf, search = (cast("Mapping[str, Value]", design[key]) for key in ("leaf", "search"))
    yield found("N_s", "searches", _number(search, "searches"), "1", f"{_OMEGA}, search",
                f"{_number(search, 'feasible'):g} met every limit, from "
                f"{_number(search, 'starts'):g} starts with the seed "
                f"{_number(search, 'seed'):g}")  # fmt: skip
    yield found("k_lin", "best stiffness per width, linear beam",
                _number(search, "linear_stiffness_per_width_N_per_m2"), "Pa", _OMEGA,
                "both halves together")  # fmt: skip
    per_width = _number(design, "full_stiffness_per_width_N_per_m2")
    yield found("k_nl", "the same at full stress on the nonlinear beam", per_width, "Pa", _OMEGA)
    yield derived("u_nl", "what large deflections leave of it", "k_nl/k_lin",
                  per_width / _number(search, "linear_stiffness_per_width_N_per_m2"), "1",
                  "comparison")  # fmt: skip
    yield derived("u_b", "share of the bound", "k_nl/k_bound",
                  per_width * 3.0 * case.deflection**2 * case.elastic_modulus
                  / (case.design_stress**2 * math.pi * case.radius**2), "1",
                  "comparison")  # fmt: skip
    yield derived("k_1", "stiffness of one layer at full stress", "k_nl*t",
                  per_width * case.sheet, "N/m", "stack of sheet")  # fmt: skip
    yield from _stacked(made)
    yield given("w_min", "smallest web of the process", case.min_web, "m")
    yield given("g_min", "smallest gap of the process", case.min_gap, "m")
    thickness = response["leaf_thickness_m"]
    for symbol, meaning, value in (
        ("L_h", "length of a half", _number(leaf, "half_length_m")),
        ("y_A", "height of the hub above the enclosure's middle", _number(leaf, "middle_m")),
        ("h_min", "thinnest place", float(min(cast("list[float]", thickness)))),
        ("h_max", "thickest place", float(max(cast("list[float]", thickness)))),
        ("g_self", "gap of the leaf to itself, least of the stroke", _least(response, "self")),
        ("g_wall", "gap to the wall", _least(response, "wall")),
        ("g_lever", "gap to the lever's corridor", _least(response, "corridor")),
    ):
        yield found(symbol, meaning, value, "m", f"nonlinear beam, {_OMEGA}")


def _spring(made: MadeJoint, result: Result) -> Iterator[Step]:
    """What the leaves do together, whatever their shape."""
    spring, stress = made.spring, float(max(made.spring.stress))
    beam = "nonlinear beam at the deflection"
    yield found("k", "stiffness of the spring, force over deflection", spring.stiffness, "N/m",
                f"{beam}, mean of both directions")  # fmt: skip
    yield found("k_0", "stiffness of the spring at rest",
                float(result.response["spring_stiffness_at_rest_N_per_m"]),  # type: ignore[arg-type]
                "N/m", "slope of the curve through the beam's states")  # fmt: skip
    yield derived("F_max", "force of the spring, mean of both directions", "k*s_max",
                  0.5 * float(spring.force[-1] - spring.force[0]), "N", "000, Eq. 2")  # fmt: skip
    yield found("W", "energy of the spring", float(spring.energy[-1]), "J", beam)
    yield derived("u_W", "against k·s²/2", "W/(k*s_max**2/2)",
                  float(spring.energy[-1]) / (0.5 * spring.stiffness * made.case.deflection**2),
                  "1", "comparison")  # fmt: skip
    yield found("sigma_max", "largest stress", stress, "Pa", f"{beam}, no notch")
    yield derived("u_sigma", "stress over the design stress", "sigma_max/sigma_d",
                  stress / made.case.design_stress, "1", "comparison")  # fmt: skip
    yield from life_steps(result, "sigma_max")
    if made.case.shape == "triangular":
        yield derived("N_l", "layers of a leaf", "1", spring.layers, "1", _BEAM)
    yield found("A_p", "area of the part as cut", profile_area(spring.profile), "m^2", "outline",
                "with eye and block")  # fmt: skip
    yield derived("m", "mass of all leaves", "rho*A_p*t*n*N_l", spring.mass, "kg", "volume")
    yield derived("w_m", "energy per mass", "W/m", float(spring.energy[-1]) / spring.mass, "J/kg",
                  "000, III-B")  # fmt: skip


def _least(response: Mapping[str, Value], what: str) -> float:
    return float(min(cast("list[float]", response[f"{what}_gap_m"])))


def _number(mapping: Mapping[str, Value], key: str) -> float:
    return float(cast(float, mapping[key]))
