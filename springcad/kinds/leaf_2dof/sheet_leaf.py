"""The leaf in the calculation sheet: its section, paper 003's closed forms, and the estimate."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.kinds.leaf_2dof import estimate, paper_unit
from springcad.kinds.leaf_2dof.case import Case, Setup
from springcad.kinds.leaf_2dof.seating import shear_modulus
from springcad.kinds.leaf_2dof.unit import rest_stiffness, rest_stiffness_range
from springcad.kinds.sheet_words import chosen_within
from springcad.mechanics.section import SHEAR_CORRECTION, area, second_moment_of_area
from springcad.sheet import Section, Step, derived, found, given, suffixed

_PAGE = "theory/leaf-2dof.md"
_SIZING = "theory/leaf-2dof-sizing.md"


def leaf_section(case: Case, setup: Setup) -> Section:
    """How many leaves of which section, at which lengths."""
    return Section(
        "The leaf", tuple(_leaf(case, setup)),
        "What the spec leaves open is the shortest leaf that bears the deflection, the lightest of "
        "several; L = b·(n·a·E·R²/(4·K))^(1/3) but for shear (003, Eq. 16).",
    )  # fmt: skip


def paper_section(case: Case, setup: Setup) -> tuple[Section, ...]:
    """Stiffness and limits at both ends of the range of lengths, by closed forms."""
    ends = {"long": ("longest", setup.longest), "short": ("shortest", setup.shortest)}
    return tuple(
        Section(
            f"Closed forms at the {words} length",
            suffixed(_paper(case, setup, length), end),
            "A linear leaf loaded where the roller rests (paper 003), n leaves bearing together.",
        )
        for end, (words, length) in ends.items()
    )


def estimate_section(case: Case, setup: Setup) -> tuple[Section, ...]:
    """The formula by which the leaf is sized; nothing where it knows no bend."""
    bent = estimate.bend(setup.leaf, setup.lever, setup.longest, case.deflection)
    if bent is None:
        return ()
    return (
        Section(
            "Estimate with a moving contact, longest length", tuple(_estimate(case, setup, bent)),
            "The contact moves along the leaf, and the force turns with it: what sizing uses.",
        ),
    )  # fmt: skip


def _leaf(case: Case, setup: Setup) -> Iterator[Step]:
    leaf = setup.leaf
    if case.leaves is None:
        yield found("n", "leaves that bear together about an axis", setup.leaves, "1", _SIZING,
                    "the fewest that pass every check")  # fmt: skip
    else:
        yield given("n", "leaves that bear together about an axis", setup.leaves, "1")
    for symbol, meaning, value, low, high in (
        ("a", "width of the leaf", leaf.width, case.least_width, case.width),
        ("b", "thickness of the leaf", leaf.thickness, case.least_thickness, case.thickness),
    ):
        if low is None:
            yield given(symbol, meaning, value, "m")
        else:
            yield found(symbol, meaning, value, "m", _SIZING, chosen_within(value, low, high))
    for symbol, meaning, value, known in (
        ("L_max", "longest effective length", setup.longest, case.longest),
        ("L_min", "shortest effective length", setup.shortest, case.shortest),
    ):
        if known is None:
            yield found(symbol, meaning, value, "m", _SIZING, "for the wanted stiffness at rest")
        else:
            yield given(symbol, meaning, value, "m")
    inertia = float(second_moment_of_area(leaf.width, 0.5 * leaf.thickness))
    yield derived("I", "second moment of area", "a*b**3/12", inertia, "m^4", "003, Eq. 7")
    yield derived("B", "bending stiffness", "E*I", leaf.bending_stiffness, "N*m^2", "003, Eq. 7")
    yield derived("G", "shear modulus", "E/(2*(1 + nu))", shear_modulus(leaf), "Pa", "isotropic")
    shearing = SHEAR_CORRECTION * shear_modulus(leaf) * area(leaf.width, 0.5 * leaf.thickness)
    yield derived("S", "shear stiffness", "5/6*G*a*b", float(shearing), "N", "Timoshenko")


def _paper(case: Case, setup: Setup, length: float) -> Iterator[Step]:
    n, leaf, lever = setup.leaves, setup.leaf, setup.lever
    at = leaf, lever, length
    symbol = "L_max" if length == setup.longest else "L_min"
    yield derived("L", "effective length", symbol, length, "m", "the leaf")
    yield derived("K_0", "stiffness at rest, with shear", "n*R**2/(L**3/(3*B) + L/S)",
                  n * float(rest_stiffness(*at)), "N*m/rad", f"{_PAGE}, 1",
                  "exact for a leaf just touched")  # fmt: skip
    yield derived("K_16", "the same without shear", "3*n*B*R**2/L**3",
                  n * float(paper_unit.stiffness(*at, 0.0)), "N*m/rad",
                  "003, Eq. 16, of n leaves")  # fmt: skip
    softest, plate = (n * float(end) for end in rest_stiffness_range(*at))
    yield derived("K_soft", "least of a real leaf: it slides in its guide",
                  "n*R**2/((L + 0.57*b)**3/(3*B) + (L + 0.57*b)/S)", softest, "N*m/rad",
                  f"{_PAGE}, 2")  # fmt: skip
    yield derived("K_plate", "greatest: it bends as a plate", "K_0/(1 - nu**2)", plate, "N*m/rad",
                  f"{_PAGE}, 2")  # fmt: skip
    allowed = float(paper_unit.deflection_at_stress(*at, case.design_stress))
    yield derived("phi_sigma", "deflection at the design stress",
                  "asin(min(1, 2*L**2*sigma_d/(3*E*b*R)))", allowed, "rad",
                  "003, Eqs 6, 10")  # fmt: skip
    if math.isfinite(case.max_bend_angle):
        bent = float(paper_unit.deflection_at_bend(lever, length, case.max_bend_angle))
        yield derived("phi_theta", "deflection at the bend angle allowed",
                      "asin(min(1, 2*L*tan(theta_max)/(3*R)))", bent, "rad",
                      "003, Eq. 8")  # fmt: skip
    phi = min(case.deflection, allowed)
    yield derived("phi", "deflection looked at", "min(phi_max, phi_sigma)", phi, "rad",
                  "the smaller")  # fmt: skip
    yield derived("F", "force of a roller", "3*B*R*sin(phi)/L**3",
                  float(paper_unit.force(*at, phi)), "N", "003, Eq. 6")  # fmt: skip
    yield derived("theta", "bend angle of the leaf at the roller", "atan(3*R*sin(phi)/(2*L))",
                  float(paper_unit.bend_angle(lever, length, phi)), "rad", "003, Eq. 8",
                  "Eq. 3 of 003 has the angle, Eq. 8 its tangent")  # fmt: skip
    yield derived("sigma", "stress at the clamp", "6*F*L/(a*b**2)",
                  float(paper_unit.stress(*at, phi)), "Pa", "003, Eq. 10")  # fmt: skip
    yield derived(
        "M",
        "torque of an axis",
        "n*F*(R*cos(phi) - r*sin(phi))",
        n * float(paper_unit.torque(*at, phi)),
        "N*m",
        "003, Eqs 13, 14, of n leaves",
        "the arm is that of a force that stays upright; the exact unit has a roller's",
    )
    yield derived("K", "stiffness of an axis there",
                  "3*n*B*(R**2*cos(2*phi) - R*r*sin(2*phi))/L**3",
                  n * float(paper_unit.stiffness(*at, phi)), "N*m/rad",
                  "003, Eq. 16, of n leaves")  # fmt: skip
    yield derived("U", "energy of an axis",
                  "3*n*B*R*(R*sin(phi)**2/2 - r*(phi/2 - sin(2*phi)/4))/L**3",
                  n * float(paper_unit.energy(*at, phi)), "J", "integral of Eq. 14")  # fmt: skip


def _estimate(case: Case, setup: Setup, bent: estimate.Bend) -> Iterator[Step]:
    at = setup.leaf, setup.lever, setup.longest, case.deflection
    yield found("theta_e", "bend angle at the roller", bent.slope, "rad", _SIZING,
                "repeated until the last step of this section gives it again")  # fmt: skip
    yield derived("rho_c", "centre of the roller to the leaf's centre line", "r + b/2",
                  setup.lever.roller_radius + 0.5 * setup.leaf.thickness, "m",
                  f"{_PAGE}, 1")  # fmt: skip
    yield derived("xi_e", "contact from the clamp, along the unbent leaf",
                  "L_long + d*R*(1 - cos(phi_max)) - rho_c*sin(theta_e)", bent.reach, "m",
                  f"{_PAGE}, 1")  # fmt: skip
    yield derived("w_e", "deflection of the leaf there",
                  "R*sin(phi_max) - rho_c*(1 - cos(theta_e))", bent.deflection, "m",
                  f"{_PAGE}, 1")  # fmt: skip
    q = bent.deflection / bent.reach
    yield derived("q_e", "their ratio", "w_e/xi_e", q, "1", _SIZING)
    yield derived("sigma_e", "stress at the clamp, estimate",
                  "3*E*b*w_e/(2*xi_e**2*(1 + 15*q_e**2/14))", estimate.stress(*at), "Pa", _SIZING,
                  "within 0.6 % up to q = 0.5")  # fmt: skip
    yield derived("theta_f", "bend angle again", "3*q_e/(2*(1 + 9*q_e**2/28))", bent.slope, "rad",
                  _SIZING)  # fmt: skip
