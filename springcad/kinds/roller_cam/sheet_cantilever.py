"""The cantilever in the calculation sheet of a roller cam, and what closed forms ask of it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from springcad.kinds.roller_cam.feasibility import (
    Case,
    end_stress,
    lowest_point,
    required_arm,
    tip_stiffness,
)
from springcad.kinds.roller_cam.joint import BLUNTED, POCKET, Joint
from springcad.kinds.roller_cam.spec import RollerCamSpec
from springcad.kinds.sheet_words import chosen_within
from springcad.mechanics.section import second_moment_of_area
from springcad.sheet import Section, Step, derived, found, given

_PAGE = "theory/roller-cam.md"


def cantilever_section(spec: RollerCamSpec, joint: Joint) -> Section:
    """The elastic part: given, or as sized."""
    text = ""
    if spec.cantilever.objective is not None:
        text = (
            f"Sized within the bounds of the spec, objective {spec.cantilever.objective}; of a "
            "refused design the stiffest within them."
        )
    return Section("The cantilever", tuple(_cantilever(spec, joint)), text)


def limits_section(case: Case, joint: Joint) -> Section:
    """What the law asks of the cantilever at the full deflection."""
    return Section(
        "Limits by closed forms, at the full deflection", tuple(_limits(case, joint)),
        "The cantilever must not hold more than the law has stored: it holds least with the "
        "roller right over the tip.",
    )  # fmt: skip


def _cantilever(spec: RollerCamSpec, joint: Joint) -> Iterator[Step]:
    beam = joint.cantilever
    for symbol, meaning, value, bounds in (
        ("l", "length", beam.length, spec.cantilever.length),
        ("h", "height, in the plane of bending", beam.height, spec.cantilever.height),
        ("w", "thickness of the sheet", beam.width, spec.envelope.thickness),
    ):
        if bounds[0] == bounds[1]:
            yield given(symbol, meaning, value, "m")
        else:
            yield found(symbol, meaning, value, "m", f"{_PAGE}, 9",
                        chosen_within(value, *bounds))  # fmt: skip
    inertia = float(second_moment_of_area(beam.width, 0.5 * beam.height))
    yield derived("I", "second moment of area", "w*h**3/12", inertia, "m^4", "001, Table 1")
    yield derived("B", "bending stiffness", "E*I", beam.bending_stiffness, "N*m^2", "001, Eq. 2")
    yield derived("k_b", "stiffness of the tip, bending alone", "3*B/l**3", beam.tip_stiffness,
                  "N/m", "001, Eq. 2")  # fmt: skip
    yield derived("G", "shear modulus", "E/(2*(1 + nu))", beam.shear_modulus, "Pa", "isotropic")
    if beam.pocket_fillet is None:
        turned = ""
    else:
        turned = " + C_r*l**2"
        yield given("c_p", "turning of a root in a pocket, over 1/(E w h²)", POCKET, "1",
                    f"finite elements, {_PAGE}, 4")  # fmt: skip
        yield given("c_f", "how fast fillets lessen it", BLUNTED, "1",
                    f"finite elements, {_PAGE}, 4")  # fmt: skip
        yield derived("C_r", "rotation of the root per moment", "c_p*exp(-c_f*r_f/h)/(E*w*h**2)",
                      beam.root_compliance, "rad/(N*m)", f"{_PAGE}, 4")  # fmt: skip
    yield derived("k_t", "stiffness of the tip, with shear" + (" and root" if turned else ""),
                  f"1/(1/k_b + l/(5/6*G*w*h){turned})", tip_stiffness(beam), "N/m",
                  f"{_PAGE}, 2")  # fmt: skip


def _limits(case: Case, joint: Joint) -> Iterator[Step]:
    wanted, roller, beam = case.wanted, joint.roller, joint.cantilever
    angle = case.deflection
    end = np.array([angle])
    torque, energy = wanted.torque(end), wanted.energy(end)
    stiffness = tip_stiffness(beam)
    arm = float(required_arm(torque, energy, stiffness)[0])
    yield derived("p_1", "least arm that gives the torque holding the energy",
                  "T_w/sqrt(2*k_t*W_w)", arm, "m", f"{_PAGE}, 9")  # fmt: skip
    radius = (arm + roller.radius * math.sin(angle)) / math.cos(angle)
    yield derived("R_1", "least radius of the drum", "(p_1 + r*sin(beta_w))/cos(beta_w)", radius,
                  "m", "001, Eq. 9, corrected", "that of the spec must be larger")  # fmt: skip
    rest = wanted.dead_zone
    reach = roller.drum_radius * math.cos(rest) - roller.radius * math.sin(rest)
    at = "R*cos(beta_0) - r*sin(beta_0)" if rest else "R"
    yield derived("k_1", "greatest stiffness of a group at rest", f"k_t*({at})**2",
                  stiffness * reach**2, "N*m/rad", f"{_PAGE}, 7",
                  "the law's must be lower")  # fmt: skip
    stress = end_stress(joint, angle, float(torque[0]), float(energy[0]))
    if math.isfinite(stress):
        yield found("sigma_1", "bending stress, estimate", stress, "Pa",
                    f"small rotations, rigid contact part, {_PAGE}, 2")  # fmt: skip
    yield derived("g_1", "gap of the roller to the straight cantilever",
                  "y_0 - R*sin(beta_w) - r*cos(beta_w) - h/2",
                  lowest_point(roller, angle) - 0.5 * beam.height, "m", f"{_PAGE}, 1")  # fmt: skip
