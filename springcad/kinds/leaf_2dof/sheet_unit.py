"""The exact unit and the part in the calculation sheet of leaves."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from springcad.geometry.outline_ops import profile_area
from springcad.kinds.leaf_2dof import estimate
from springcad.kinds.leaf_2dof.made import MadeLeaves, at_length
from springcad.kinds.leaf_2dof.unit import UnitStroke, contact_pressure, curvature_parameter
from springcad.kinds.strength_sheet import life_steps
from springcad.mechanics.contact import contact_modulus
from springcad.result import Result
from springcad.sheet import Section, Step, derived, found, given, suffixed

_PAGE = "theory/leaf-2dof.md, 1"
_BEAM = f"nonlinear beam, {_PAGE}"


def exact_section(made: MadeLeaves, result: Result) -> tuple[Section, ...]:
    """At both ends of the range of lengths, as far as asked and allowed."""
    leaf = made.setup.leaf
    modulus = contact_modulus(*(leaf.elastic_modulus, leaf.poisson_ratio) * 2)
    common = derived(
        "E_c", "modulus of the contact of roller and leaf", "E/(2*(1 - nu**2))", modulus, "Pa",
        "Johnson, Contact Mechanics, Eq. 4.6", "both of the leaf's material",
    )  # fmt: skip
    text = "Large deflection with shear and stretch, and a contact that moves along the leaf."
    long, short = (at_length(made.strokes, index) for index in (-1, 0))
    return (
        Section(
            "Exact unit at the longest length",
            (
                common,
                *suffixed(_exact(made, long, modulus, _end_of_long(made)), "l"),
                *_compared(made, result),
            ),
            text,
        ),
        Section(
            "Exact unit at the shortest length",
            suffixed(_exact(made, short, modulus, _end_of_short(made)), "s"),
            text,
        ),
    )


def part_section(made: MadeLeaves) -> Section:
    """The leaf as cut."""
    plan = made.planform
    steps = (
        given("L_m", "length of the mount", plan.mount, "m"),
        given("L_g", "length of the guide", plan.guide, "m"),
        found("L_o", "overhang beyond the roller at rest", plan.overhang, "m", _PAGE,
              "to the furthest contact, 0.5 mm more, and the corners"),
        derived("L_all", "length of the leaf", "L_m + L_g + L_max + L_o", plan.length, "m",
                "as drawn"),
        found("A_p", "area of the leaf as cut", profile_area(made.profile), "m^2", "outline"),
        derived("m", "mass of a leaf", "rho*A_p*b", made.mass, "kg", "volume"),
        derived("m_4", "mass of all leaves of the wrist", "4*n*m",
                4.0 * made.setup.leaves * made.mass, "kg", "two axes, two directions"),
        derived("w_m", "energy of an axis over the mass of its bent leaves", "U_l/(n*m)",
                float(made.full.energy[-1]) / made.mass, "J/kg", "longest length"),
    )  # fmt: skip
    return Section("The part", steps)


def _end_of_long(made: MadeLeaves) -> Step:
    angle = float(made.full.angle[-1])
    if angle == made.case.deflection:
        return derived("phi", "deflection", "phi_max", angle, "rad", "spec")
    return found("phi", "deflection", angle, "rad", _BEAM, "the torque falls beyond")


def _end_of_short(made: MadeLeaves) -> Step:
    angle = float(at_length(made.strokes, 0).angle[-1])
    if angle == made.case.deflection:
        return derived("phi", "deflection", "phi_max", angle, "rad", "spec")
    return found("phi", "deflection", angle, "rad", _BEAM,
                 f"the largest allowed: {made.reach.binding[0]} ends it")  # fmt: skip


def _exact(made: MadeLeaves, at: UnitStroke, modulus: float, angle: Step) -> Iterator[Step]:
    """At the end of a stroke (A,) of one leaf."""
    setup = made.setup
    n, leaf, lever = setup.leaves, setup.leaf, setup.lever
    force, stress = float(at.force[-1]), float(at.stress[-1])
    yield angle
    yield found("F", "force of a roller, normal to the leaf", force, "N", _BEAM)
    yield found("theta", "bend angle of the leaf at the roller", float(at.bend_angle[-1]), "rad",
                _BEAM)  # fmt: skip
    yield found("c", "contact from the clamp, along the leaf", float(at.station[-1]), "m", _BEAM)
    yield derived("M", "torque of an axis", "n*F*R*cos(phi + d*theta)",
                  n * float(at.torque[-1]), "N*m", _PAGE, "in place of 003, Eq. 14")  # fmt: skip
    yield found("K", "stiffness of an axis there", n * float(at.stiffness[-1]), "N*m/rad", _BEAM)
    yield found("U", "energy of an axis", n * float(at.energy[-1]), "J", _BEAM)
    yield found("sigma", "stress at the clamp", stress, "Pa", _BEAM, "no notch")
    yield derived("f_y", "safety factor against yield", "sigma_y/sigma",
                  made.case.yield_strength / stress, "1", "definition")  # fmt: skip
    yield derived("p", "pressure of the roller on the leaf", "sqrt(F*E_c/(pi*a*r))",
                  float(contact_pressure(leaf, lever, np.array(force), modulus)), "Pa",
                  "Johnson, Eq. 4.45", "a cylinder on a plane")  # fmt: skip


def _compared(made: MadeLeaves, result: Result) -> Iterator[Step]:
    """What the closed forms had said, and what the linear beam leaves out."""
    setup, full = made.setup, made.full
    stress, length = float(full.stress[-1]), setup.longest
    yield derived("K_sec", "stiffness of an axis, torque over deflection", "M_l/phi_l",
                  setup.leaves * float(full.torque[-1] / full.angle[-1]), "N*m/rad",
                  "secant")  # fmt: skip
    bent = estimate.bend(setup.leaf, setup.lever, length, made.case.deflection)
    if bent is not None and full.angle[-1] == made.case.deflection:
        expected = estimate.stress(setup.leaf, setup.lever, length, made.case.deflection)
        yield derived("u_e", "stress over the estimate", "sigma_l/sigma_e", stress / expected, "1",
                      "comparison")  # fmt: skip
    yield derived("u_d", "stress over the design stress", "sigma_l/sigma_d",
                  stress / made.case.design_stress, "1", "comparison")  # fmt: skip
    yield derived("s_w", "Searle's parameter at the clamp", "2*a**2*sigma_l/(E*b**2)",
                  float(curvature_parameter(setup.leaf, stress)), "1", "theory/leaf-2dof.md, 2",
                  "below 1 a beam, far above 10 a plate")  # fmt: skip
    yield from life_steps(result, "sigma_l")
