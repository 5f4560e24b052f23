"""Profile, contact at full stroke and the whole joint in the calculation sheet of a roller cam."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from springcad.kinds.roller_cam.checks import first_contact, torque_errors
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.kinds.roller_cam.part import roller_contact, roller_curvature
from springcad.kinds.strength_sheet import life_steps
from springcad.mechanics.contact import contact_modulus
from springcad.result import Result
from springcad.sheet import Section, Step, derived, found, given

_PAGE = "theory/roller-cam.md"
_FORWARD = f"forward analysis of the drawn profile, {_PAGE}, 5"


def profile_section(made: MadeJoint) -> Section:
    """How the profile was found."""
    return Section(
        "The profile", tuple(_profile(made)),
        "Each contact follows from torque and energy of the law (001 steps along the profile); "
        "the contact part's compliance is made up for.",
    )  # fmt: skip


def contact_section(made: MadeJoint) -> Section:
    """Geometry and statics with the roller at the full deflection."""
    return Section(
        "Roller and cantilever at the full deflection", tuple(_contact(made)),
        "Where the roller rests on the profile as drawn, with large deflections and an elastic "
        "contact part; the statics of 001, Eqs 4 to 9, corrected.",
    )  # fmt: skip


def joint_section(made: MadeJoint, result: Result) -> Section:
    """All groups together."""
    return Section("The whole joint", tuple(_joint(made, result)))


def _profile(made: MadeJoint) -> Iterator[Step]:
    compensated, profile = made.compensated, made.compensated.profile
    yield found("gamma_0", "contact angle round the roller, first contact",
                float(profile.gamma[0]), "rad", f"energy balance, {_PAGE}, 3")  # fmt: skip
    yield found("beta_1", "angle from which on it touches", first_contact(made), "rad",
                f"energy balance, {_PAGE}, 3")  # fmt: skip
    yield found("e_0", "torque error for a rigid contact part", compensated.errors[0], "1",
                f"{_PAGE}, 4", "relative, from 2.6 % of the stroke on")  # fmt: skip
    yield found("e_n", "torque error with compensation", compensated.error, "1", f"{_PAGE}, 4",
                f"{made.spec.compensation}, updates: {len(compensated.errors) - 1}")  # fmt: skip
    yield found("e_d", "torque that the arcs of the drawing change, over the full torque",
                made.drawn.torque_change, "1", _FORWARD,
                f"arcs within {1e6 * made.drawn.tolerance:.3g} um")  # fmt: skip
    yield found("S_o", "torque per outward offset of the profile, largest",
                float(np.max(made.sensitivity)), "N", f"{_PAGE}, 5", "N*m per m")  # fmt: skip
    if made.stepwise_distance is not None:
        yield found("d_s", "distance of the profile that 001's steps give",
                    made.stepwise_distance, "m", f"001, section 3.2; {_PAGE}, 6")  # fmt: skip


def _contact(made: MadeJoint) -> Iterator[Step]:
    stroke, joint = made.stroke, made.joint
    beam, roller = joint.cantilever, joint.roller
    beta, gamma = stroke.angle[-1:], stroke.gamma[-1:]
    touch = roller_contact(roller, beta, gamma)
    pull, push = float(stroke.force[-1, 0]), -float(stroke.force[-1, 1])
    force = float(stroke.normal_force[-1])
    yield found("beta", "angle", float(beta[0]), "rad", "last angle of the stroke")
    yield found("gamma", "contact angle round the roller", float(gamma[0]), "rad", _FORWARD,
                "0 beside it, 90 deg under it")  # fmt: skip
    yield derived("alpha", "angle of the force", "atan(cos(beta)/tan(gamma))",
                  math.atan2(float(touch.normal[0, 0]), -float(touch.normal[0, 1])), "rad",
                  "001, Eq. 8", "to the normal of the cantilever")  # fmt: skip
    yield derived("x", "contact along the cantilever, from the tip", "x_c + r*cos(gamma)",
                  float(touch.point[0, 0]), "m", "001, Eqs 4, 6")  # fmt: skip
    yield derived("y", "contact across it", "y_0 - R*sin(beta) - r*cos(beta)*sin(gamma)",
                  float(touch.point[0, 1]), "m", "001, Eqs 4, 7")  # fmt: skip
    yield found("F", "force of the roller", force, "N", _FORWARD)
    yield derived("F_x", "along the cantilever", "F*sin(alpha)", pull, "N", f"{_PAGE}, 1")
    yield derived("F_y", "across the cantilever", "F*cos(alpha)", push, "N", f"{_PAGE}, 1")
    yield derived("p", "arm of the force about the drum", "R*cos(beta) - r*sin(beta)*sin(gamma)",
                  float(touch.reach[0]), "m", f"{_PAGE}, 1")  # fmt: skip
    yield derived("T", "torque of a group", "F_y*p", float(stroke.torque[-1]), "N*m",
                  "001, Eq. 9, corrected", "001 takes the drum's radius for the arm")  # fmt: skip
    yield from _clamp(made, pull)
    tip = stroke.tip
    yield found("v", "deflection of the tip", -float(tip.displacement[-1, 1]), "m", _FORWARD)
    yield found("theta", "rotation of the tip", -float(tip.rotation[-1]), "rad", _FORWARD)
    yield found("W", "energy of a group", float(stroke.energy[-1]), "J", _FORWARD)
    yield found("W_c", "the cantilever's part of it", float(tip.energy[-1]), "J", _FORWARD)
    yield derived("u_W", "share of the contact part", "1 - W_c/W",
                  1.0 - float(tip.energy[-1] / stroke.energy[-1]), "1", "comparison")  # fmt: skip
    modulus = contact_modulus(*(beam.elastic_modulus, beam.poisson_ratio) * 2)
    yield derived("E_c", "modulus of the contact", "E/(2*(1 - nu**2))", modulus, "Pa",
                  "Johnson, Contact Mechanics, Eq. 4.6", "roller of the same material")  # fmt: skip
    yield derived(
        "kappa_r", "curvature of the tilted roller",
        "r**2*cos(beta)/sqrt((r*sin(gamma))**2 + (r*cos(beta)*cos(gamma))**2)**3",
        float(roller_curvature(roller, beta, gamma)[0]), "1/m", "ellipse",
    )  # fmt: skip
    yield found("kappa", "curvature of roller and profile together", float(stroke.curvature[-1]),
                "1/m", _FORWARD)  # fmt: skip
    yield derived("p_H", "pressure on the profile", "sqrt(F*E_c*kappa/(pi*w))",
                  float(stroke.pressure(beam.width, modulus)[-1]), "Pa",
                  "Johnson, Eq. 4.45")  # fmt: skip


def _clamp(made: MadeJoint, pull: float) -> Iterator[Step]:
    """Moment and stress at the clamp, whose section stands still between plates."""
    beam, stress = made.joint.cantilever, float(made.stroke.tip.stress[-1])
    if beam.pocket_fillet is not None:
        yield found("sigma", "stress at the clamp", stress, "Pa", _FORWARD, "no notch")
        return
    axial = abs(pull) / (beam.width * beam.height)
    moment = (stress - axial) * beam.width * beam.height**2 / 6.0
    yield derived("M", "moment at the clamp", "F_y*(l + x) + F_x*y", moment, "N*m",
                  f"001, Eq. 1; {_PAGE}, 1",
                  "about the clamp, where the contact is then")  # fmt: skip
    yield derived("sigma", "stress at the clamp", "6*M/(w*h**2) + F_x/(w*h)", stress, "Pa",
                  f"{_PAGE}, 2", "bending and axial, no notch")  # fmt: skip


def _joint(made: MadeJoint, result: Result) -> Iterator[Step]:
    stroke, groups = made.stroke, made.spec.groups
    torque, energy = float(stroke.torque[-1]), float(stroke.energy[-1])
    relative, absolute = torque_errors(made)
    yield derived("T_all", "torque of all groups", "N_g*T", groups * torque, "N*m", "sum")
    yield derived("K", "secant stiffness", "T_all/beta", groups * torque / float(stroke.angle[-1]),
                  "N*m/rad", "definition")  # fmt: skip
    yield derived("W_all", "energy of all groups", "N_g*W", groups * energy, "J", "sum")
    yield derived("u_T", "torque over that of the law", "T/T_w",
                  torque / float(made.followed.torque(stroke.angle[-1:])[0]), "1",
                  "comparison")  # fmt: skip
    yield found("e_T", "largest torque error over the stroke, over the full torque", absolute, "1",
                _FORWARD)  # fmt: skip
    yield found("e_r", "the same, relative", relative, "1", _FORWARD,
                "from 2.6 % of the stroke on")  # fmt: skip
    peak = float(np.max(stroke.tip.stress))
    yield found("sigma_max", "largest stress at the clamp over the stroke", peak, "Pa", _FORWARD)
    yield derived("u_sigma", "over the design stress", "sigma_max/sigma_d",
                  peak / made.spec.material.design_stress, "1", "comparison")  # fmt: skip
    yield from life_steps(result, "sigma_max")
    yield found("g", "smallest gap of roller and profile beside the contact",
                float(np.min(made.gap)), "m", f"rigid contact part, {_PAGE}, 5",
                "below 0 the roller cuts in")  # fmt: skip
    yield found("m", "mass of an element", made.mass, "kg", "outline",
                "density times area times sheet")  # fmt: skip
    yield derived("w_m", "energy of a group over the mass of its element", "W/m",
                  energy / made.mass, "J/kg", "definition")  # fmt: skip
    if made.friction is not None:
        yield given("mu", "friction of the roller", made.spec.friction, "1")
        yield found("u_mu", "share of the work of loading that a cycle loses",
                    made.friction.loss_share, "1", f"{_PAGE}, 5")  # fmt: skip
