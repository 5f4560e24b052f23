"""The design law in the calculation sheet of a rotary flexure spring: closed forms only."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.kinds.rotary_flexure.case import Case, resolved_style
from springcad.kinds.rotary_flexure.law import (
    DesignLaw,
    energy_of_area,
    ring_mass,
    straight_energy,
)
from springcad.kinds.rotary_flexure.room import (
    annulus_area,
    deflection_bound,
    hub_shear_stress,
    packing_bound,
)
from springcad.sheet import Section, Step, derived

_PAGE = "theory/rotary-flexure.md"


def law_section(case: Case, law: DesignLaw) -> Section:
    """From torque and stress to the area of a flexure."""
    steps = tuple(_law(law))
    if resolved_style(law, case.style) == "straight":
        steps += tuple(_straight(law))
    return Section(
        "Design law (004, section II)", steps,
        "A straight tapered flexure at the design stress everywhere, small deflections, rim and "
        "root rigid; then the area that the energy takes.",
    )  # fmt: skip


def room_section(case: Case, law: DesignLaw, density: float) -> Section:
    """What the flexures leave of the ring; the ``density`` is the material's."""
    return Section(
        "Room in the ring, by closed forms", tuple(_room(case, law, density)),
        "Necessary limits; whether a wave fits is found by the search alone.",
    )  # fmt: skip


def _law(law: DesignLaw) -> Iterator[Step]:
    inputs = law.inputs
    t, sigma, modulus = inputs.thickness, inputs.design_stress, inputs.elastic_modulus
    ratio = inputs.tip_half_thickness / law.root_half_thickness
    yield derived("T", "torque at full deflection", "k*theta", law.torque, "N*m", "004, II-A")
    yield derived("W", "energy at full deflection", "k*theta**2/2", law.energy, "J", "004, II-B")
    shifted = " + s_c" if inputs.shift else ""
    yield derived("r", "radius of the contact at full load", f"r_0{shifted}", inputs.loaded_radius,
                  "m", f"{_PAGE}, 10")  # fmt: skip
    yield derived("L", "lever: root to the contact at full load", "R - r", law.lever, "m",
                  "004, II-A")  # fmt: skip
    yield derived("F", "force on a tip", "k*theta/(r*n)", law.force, "N", "004, before Eq. 7")
    yield derived("lamda_r", "half thickness at the root", "sqrt(3*F*L/(2*t*sigma_d))",
                  law.root_half_thickness, "m", "004, Eqs 1, 2")  # fmt: skip
    yield derived("lamda_t", "half thickness at the tip", "h_t/2", inputs.tip_half_thickness, "m",
                  "spec")  # fmt: skip
    yield derived("rho_t", "tip over root", "lamda_t/lamda_r", ratio, "1", f"{_PAGE}, 3")
    yield derived("L_p", "length of the pad at the tip", f"L*rho_t**2{shifted}",
                  law.tip_pad_length, "m", f"{_PAGE}, 3")  # fmt: skip
    yield derived("A_nom", "area of a straight flexure", "4*L*lamda_r/3", law.nominal_area, "m^2",
                  "integral of 004, Eq. 2")  # fmt: skip
    yield derived("U_nom", "energy of a straight flexure",
                  "sqrt(2*t*F*L**3*sigma_d**3/27)/E",
                  float(straight_energy(law.force, law.lever, t, sigma, modulus)), "J",
                  "004, Eqs 6, 7")  # fmt: skip
    yield derived("A_serp", "effective area that a flexure needs",
                  "3*k*theta**2*E/(n*sigma_d**2*t)", law.required_area, "m^2",
                  "004, Eq. 10")  # fmt: skip
    yield derived("U", "energy of a flexure of that area", "sigma_d**2*t*A_serp/(6*E)",
                  float(energy_of_area(law.required_area, t, sigma, modulus)), "J",
                  "004, Eq. 9")  # fmt: skip
    yield derived("W_n", "energy of all of them", "n*U", law.energy, "J", "again W")
    yield derived("theta_s", "deflection of straight flexures",
                  "cbrt(8*t*n*L**3*sigma_d**3/(27*E**2*k*r))", law.straight_deflection, "rad",
                  "004, Eq. 11")  # fmt: skip
    yield derived("f_s", "serpentine factor", "A_serp/A_nom", law.serpentine_factor, "1",
                  "004, II-B", "above 1 the flexure must be a wave")  # fmt: skip
    yield derived("f_s2", "the same by the deflections", "(theta/theta_s)**(3/2)",
                  law.serpentine_factor, "1", f"{_PAGE}, 2")  # fmt: skip
    formula = "1 - rho_t**3/2" if ratio <= 1.0 else "1/(2*rho_t**3)"
    yield derived("f_1", "serpentine factor of a straight flexure with this tip", formula,
                  law.straight_factor, "1", f"{_PAGE}, 3")  # fmt: skip
    yield derived("A_f", "area of a flexure, its pad counted", "A_serp + A_nom*rho_t**3",
                  law.flexure_area, "m^2", f"{_PAGE}, 3")  # fmt: skip


def _straight(law: DesignLaw) -> Iterator[Step]:
    """What a straight flexure of this stiffness bears; none where its tip alone is stiffer."""
    factor = law.straight_thickness_factor
    if math.isnan(factor):
        return
    yield derived("m_h", "thickness over that of the law, for the stiffness",
                  "cbrt((1 + sqrt(1 - 2*rho_t**3*f_s))/(2*f_s))", factor, "1",
                  f"{_PAGE}, 3")  # fmt: skip
    yield derived("sigma_s", "stress of straight flexures", "sigma_d/m_h**2",
                  law.inputs.design_stress / factor**2, "Pa", f"{_PAGE}, 3")  # fmt: skip


def _room(case: Case, law: DesignLaw, density: float) -> Iterator[Step]:
    inputs = law.inputs
    R, r, n, t = inputs.root_radius, inputs.contact_radius, inputs.count, inputs.thickness
    sigma, modulus = inputs.design_stress, inputs.elastic_modulus
    yield derived("A_ring", "area between contact and root", "pi*(R**2 - r_0**2)",
                  float(annulus_area(R, r)), "m^2", "004, II-B")  # fmt: skip
    yield derived("f_d", "density factor", "n*A_serp/A_ring", law.density_factor, "1", "004, II-B")
    yield derived("f_pack", "largest that leaves the gaps", "1 - n*g_min/(pi*(R + r_0))",
                  float(packing_bound(R, r, n, case.min_gap)), "1", f"{_PAGE}, 5")  # fmt: skip
    yield derived("theta_ub", "deflection of a solid disk", "sigma_d*sqrt(t*A_ring/(3*E*k))",
                  float(deflection_bound(inputs.stiffness, R, r, t, sigma, modulus)), "rad",
                  f"{_PAGE}, 2", "a bound for any shape and number of flexures")  # fmt: skip
    yield from _pinch(law)
    yield derived("b_t", "width left for a tooth of the camshaft", "2*pi*r_0/n - 2*lamda_t",
                  law.tooth_width, "m", f"{_PAGE}, 5")  # fmt: skip
    core, bore = r - inputs.tip_half_thickness, case.camshaft_bore_radius
    yield derived("c_0", "radius of the camshaft's core", "r_0 - lamda_t", core, "m",
                  f"{_PAGE}, 5")  # fmt: skip
    if core > bore:
        inner = "c_0**4 - r_b**4" if bore else "c_0**4"
        sheets = case.stack.parallel
        twisted = "p_s*T" if case.stack.sheets > 1 else "T"
        yield derived("tau_0", "torsion of the core", f"2*{twisted}*c_0/(pi*({inner}))",
                      float(hub_shear_stress(sheets * law.torque, core, bore)), "Pa",
                      f"{_PAGE}, 5", "round, no notch")  # fmt: skip
    mass = ring_mass(law.flexure_area, n, R, case.outer_radius, t, density)
    yield derived("m_0", "mass of the ring, estimate", "rho*t*(n*A_f + pi*(R_o**2 - R**2))",
                  float(mass), "kg", "004, Table I")  # fmt: skip


def _pinch(law: DesignLaw) -> Iterator[Step]:
    """The gap between straight neighbours; it is smallest a little outside of the contact."""
    inputs = law.inputs
    pitch = math.pi / inputs.count
    thick, tip = law.root_half_thickness, inputs.tip_half_thickness
    place = (thick / (2.0 * law.lever * math.tan(pitch))) ** 2
    at = min(max(place, min((tip / thick) ** 2, 1.0)), 1.0)
    yield derived("q", "place of the smallest gap, share of L from the contact",
                  "min(max((lamda_r/(2*L*tan(pi/n)))**2, min(rho_t**2, 1)), 1)", at, "1",
                  f"{_PAGE}, 5")  # fmt: skip
    yield derived(
        "g_0", "gap between straight neighbours there",
        "2*((r + L*q)*sin(pi/n) - max(lamda_r*sqrt(q), lamda_t)*cos(pi/n))", law.pinch_gap, "m",
        f"{_PAGE}, 5",
    )  # fmt: skip
