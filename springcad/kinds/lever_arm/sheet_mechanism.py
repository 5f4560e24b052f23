"""The mechanism in the calculation sheet, with its pivot at one end of its range."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.kinds.lever_arm.made import MadeJoint
from springcad.kinds.lever_arm.mechanism import (
    crank_angle,
    loads,
    pivot_load_ratio,
    response,
    stroke,
    transmission,
)
from springcad.sheet import Section, Step, derived, found, given, suffixed

_PAGE = "theory/lever-arm.md, 1"
_WORDS = {"near": "nearest to", "far": "farthest from"}
_DEAD = {
    "yoke": "pi/2",
    "crank-behind": "acos(R/(q + R))",
    "crank-ahead": "acos(max(1 - q/R, 0))",
}
"""Crank angle beyond which the spring is not deflected further."""


def mechanism_section(made: MadeJoint, where: str, pivot: float) -> Section:
    """Stroke, torque, stiffness and forces with the pivot at ``pivot`` (q) [m].

    ``where`` that is, near or far, stands behind the symbols.
    """
    return Section(
        f"The mechanism with its pivot {_WORDS[where]} the crank",
        suffixed(_steps(made, pivot), where),
        "Exact statics of rigid parts without friction, at rest and at the end of the stroke.",
    )


def _steps(made: MadeJoint, q: float) -> Iterator[Step]:
    lever, law = made.case.lever, made.spring.law
    phi = float(stroke(lever, q, made.case.deflection))
    rest = response(lever, law, q, 0.0)
    yield given("q", "position of the pivot", q, "m")
    yield derived("i_0", "ds/dφ at rest", "(l - q)*R/q", float(transmission(lever, q, 0.0).rate),
                  "m/rad", "000, Eq. 1")  # fmt: skip
    yield derived("K_0", "stiffness at rest, without series stiffness", "k_0*i_0**2",
                  float(rest.crank_stiffness), "N*m/rad", "000, Eq. 5")  # fmt: skip
    if math.isfinite(lever.series_stiffness):
        yield derived("K_r", "stiffness of the output at rest", "1/(1/K_0 + 1/K_p)",
                      float(rest.stiffness), "N*m/rad", _PAGE)  # fmt: skip
    yield _end_of_stroke(made, q, phi)
    yield from _torque(made, q, phi)
    yield from _forces(made, q, phi)


def _end_of_stroke(made: MadeJoint, q: float, phi: float) -> Step:
    lever = made.case.lever
    meaning = "crank angle at the end of the stroke"
    if math.isnan(float(crank_angle(lever, q, made.case.deflection))):
        return derived("phi", meaning, _DEAD[lever.output], phi, "rad", _PAGE,
                       "the crank is at its dead angle before the spring is used up")  # fmt: skip
    if lever.output == "yoke":
        return derived("phi", meaning, "asin(q*s_max/((l - q)*R))", phi, "rad", "000, Eq. 7")
    formula = "asin(s_max*(q + e)/sqrt(((l - q)*R)**2 + (s_max*e)**2)) - atan(s_max*e/((l - q)*R))"
    return derived("phi", meaning, formula, phi, "rad", _PAGE)


def _torque(made: MadeJoint, q: float, phi: float) -> Iterator[Step]:
    """From the energy of the spring: no force is needed for it."""
    lever, law = made.case.lever, made.spring.law
    is_yoke = lever.output == "yoke"
    motion, state = transmission(lever, q, phi), response(lever, law, q, phi)
    arm = q + lever.retreat * (1.0 - math.cos(phi))
    yield derived("a", "arm of the output about the pivot, along y",
                  "q" if is_yoke else "q + e*(1 - cos(phi))", arm, "m", _PAGE)  # fmt: skip
    yield derived("s", "deflection of the spring", "(l - q)*R*sin(phi)/a",
                  float(motion.deflection), "m", "000, Eq. 1")  # fmt: skip
    yield found("F", "force of the spring there", float(law.force(motion.deflection)), "N",
                "nonlinear beam, as a curve")  # fmt: skip
    along = "cos(phi)/a" if is_yoke else "(cos(phi)*(q + e) - e)/a**2"
    yield derived("i", "ds/dφ there", f"(l - q)*R*{along}", float(motion.rate), "m/rad", _PAGE)
    yield derived("tau", "torque", "F*i", float(state.torque), "N*m", f"{_PAGE}; 000, Eq. 4",
                  "000 prints the stiffness in place of the torque")  # fmt: skip
    bent = "/q" if is_yoke else "*((q + e)/a**2 + 2*e*(cos(phi)*(q + e) - e)/a**3)"
    yield derived("j", "d²s/dφ² there", f"-(l - q)*R*sin(phi){bent}", float(motion.second),
                  "m/rad^2", _PAGE)  # fmt: skip
    yield found("k_t", "slope of the spring's force there",
                float(law.stiffness(motion.deflection)), "N/m",
                "nonlinear beam, as a curve")  # fmt: skip
    yield derived("K_c", "stiffness there, without series stiffness", "k_t*i**2 + F*j",
                  float(state.crank_stiffness), "N*m/rad", _PAGE,
                  "below 0 the torque falls")  # fmt: skip
    if math.isfinite(lever.series_stiffness):
        yield derived("K_e", "stiffness of the output there", "1/(1/K_c + 1/K_p)",
                      float(state.stiffness), "N*m/rad", _PAGE)  # fmt: skip
        yield derived("theta", "angle of the output there", "phi + tau/K_p", float(state.angle),
                      "rad", _PAGE)  # fmt: skip


def _forces(made: MadeJoint, q: float, phi: float) -> Iterator[Step]:
    """On the lever, normal to it."""
    lever, law = made.case.lever, made.spring.law
    force = float(law.force(transmission(lever, q, phi).deflection))
    load = loads(lever, q, phi, force)
    yield derived("psi", "tilt of the lever", "atan(R*sin(phi)/a)", float(load.tilt), "rad", _PAGE)
    yield derived("N_s", "force of the spring, normal to the lever", "F/cos(psi)",
                  float(load.pivot - load.output), "N", _PAGE)  # fmt: skip
    yield derived("N_o", "force of the output, normal to the lever", "N_s*(l - q)/a",
                  float(load.output), "N", "000, Eq. 2, with the tilt")  # fmt: skip
    yield derived("N_p", "force on the pivot", "N_s + N_o", float(load.pivot), "N",
                  "000, Eq. 3, with the tilt")  # fmt: skip
    yield derived("r_p", "force on the pivot over that of the output", "1 + R*sin(phi)/s",
                  float(pivot_load_ratio(lever, q, phi)), "1", "000, Eq. 9")  # fmt: skip
