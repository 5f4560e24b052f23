"""The profile of paper 001 step by step, as printed and in a sound form.

Each step finds the contact from the last one: the chord between them has the slope of the contact
(001, Eq. 5). As printed that is a backward difference, an error of first order that adds up from
step to step. With the mean of the tangents at both ends it is of second order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, fsolve

from springcad.kinds.roller_cam.curve import ProfileCurve
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.roller_cam.part import STATION_LIMITS, printed_part
from springcad.kinds.roller_cam.synthesis import rises_at_once
from springcad.kinds.target_law import Law, sampled
from springcad.mechanics.conjugate import conjugate_flank
from springcad.mechanics.elastic_part import ContactState, ElasticPart
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]
Chord = Literal["backward", "trapezoid"]

EQUATIONS = (
    "Eq. 2, rotation",
    "Eq. 2, deflection",
    "Eq. 3, x",
    "Eq. 3, y",
    "Eq. 4, x",
    "Eq. 4, y",
    "Eq. 5, slope of the profile",
    "Eq. 6, slope of the roller",
)
"""The eight equations of a printed step, in the order of its residuals."""
_MET = 1e-7
_NEAR_REST = 1e-3
"""Share of the stroke on which the limit at rest is taken."""
_FIRST_STATION = -4.0
"""Where the search begins after a contact beside the roller."""
_REACHES = 0.02 * 2.0 ** np.arange(10)
"""Of ln γ, searched for the next contact on both sides of the last."""


@dataclass(frozen=True)
class Failure:
    """A step that ``fsolve`` did not solve, or solved on the wrong side of the roller.

    Attributes:
        step: its number, from 1.
        angle: [rad].
        equation: the one farthest from being met, of ``EQUATIONS``.
        residual: of that equation, lengths over the roller's radius.
        reason: why the step was given up.
    """

    step: int
    angle: float
    equation: str
    residual: float
    reason: str


@dataclass(frozen=True)
class Steps:
    """Contacts found one after the other, the first at rest; A of them, SI.

    Attributes:
        angle: (A,).
        gamma: contact angle round the roller (A,).
        points: of the profile (A, 2).
        failures: steps left out.
    """

    angle: Floats
    gamma: Floats
    points: Floats
    failures: tuple[Failure, ...] = ()


def march(part: ElasticPart, law: Law, count: int, chord: Chord = "trapezoid") -> Steps:
    """``count`` equal steps with one unknown each, the station, from the true contact at rest.

    Args:
        chord: its direction is that of the new tangent, or of the mean of both.

    Raises:
        ArithmeticError: a step finds no contact.
        InfeasibleError: the law's slope at rest is out of the part's range.
    """
    angle = np.linspace(law.dead_zone, law.deflection, count + 1)
    torque = law.torque(angle)
    stations = [_station_at_rest(part, law)]
    contacts = [part(angle[:1], np.zeros(1), np.array(stations))]
    for step in range(1, count + 1):
        contact = partial(_contact, part, angle[step], torque[step])
        found = _nearest_root(partial(_off_course, contact, contacts[-1], chord), stations[-1])
        if found is None:
            raise ArithmeticError(f"step {step} to {np.degrees(angle[step]):.4g} deg: no contact")
        stations.append(found)
        contacts.append(contact(found))
    points = np.concatenate([contact.point for contact in contacts])
    return Steps(angle, np.exp(stations), points)


def printed(joint: Joint, law: Law, count: int) -> Steps:
    """The iteration of paper 001, section 3.2, as printed, with α for the ``a`` of its Eq. 5.

    Eight unknowns a step, solved by ``fsolve`` from the last contact plus the last change (from the
    last contact itself, the natural guess, Eq. 5 is 0/0). Eq. 1 takes the moment about the tip at
    rest and Eq. 9 is τ = F_y R, so its limit for many steps is not quite the profile either. The
    first contact, which the paper does not give, is the true one. A step that fails is left out.

    Raises:
        InfeasibleError: the law's slope at rest is out of the cantilever's range.
    """
    angle = np.linspace(law.dead_zone, law.deflection, count + 1)
    torque = law.torque(angle)
    part = printed_part(joint)
    station = np.array([_station_at_rest(part, law)])
    rest = part(angle[:1], np.zeros(1), station)
    gamma, point = float(np.exp(station[0])), rest.point[0]
    direction = float(np.arctan2(*-rest.tangent[0, ::-1]))
    last = np.array([*point, *point, 0.0, 0.0, gamma, direction])
    way = joint.roller.drum_radius * (angle[1] - angle[0])
    turn = way / joint.roller.radius
    along = way * rotated(rest.tangent[0], np.array(-turn))
    change = np.array([*along, *along, 0.0, 0.0, turn, -turn])
    rows, found, failures = [0], [last], []
    for step in range(1, count + 1):
        residuals = partial(_printed_residuals, joint, angle[step], torque[step], last[:2])
        result, failure = _solved(residuals, last + change, joint.roller.radius)
        if failure is None:
            change, last = result - last, result
            rows.append(step)
            found.append(result)
        else:
            failures.append(Failure(step, float(angle[step]), *failure))
    table = np.stack(found)
    return Steps(angle[rows], table[:, 6], table[:, :2], tuple(failures))


def distance(steps: Steps, curve: ProfileCurve) -> float:
    """Largest normal distance of the steps' points from a profile [m]."""
    dense = np.linspace(0.0, curve.length, 4000)
    away = np.hypot(*(steps.points[:, None] - curve.points(dense)).transpose(2, 0, 1))
    place = dense[away.argmin(axis=1)]
    for _ in range(2):
        gap = steps.points - curve.points(place)
        place = place + np.einsum("ai,ai->a", gap, curve.tangents(place))
    gap = steps.points - curve.points(place)
    return float(np.abs(np.einsum("ai,ai->a", gap, curve.normals(place))).max())


def _station_at_rest(part: ElasticPart, law: Law) -> float:
    """Of the first contact; where the law begins without a slope that is beside the roller."""
    if not rises_at_once(law):
        return -np.inf
    end = law.dead_zone + _NEAR_REST * (law.deflection - law.dead_zone)
    near = np.linspace(law.dead_zone, end, 4)
    flank = conjugate_flank(
        part, sampled(law, near), count=1, direction=1, station_limits=STATION_LIMITS
    )
    return float(flank.station[0])


def _contact(part: ElasticPart, angle: float, torque: float, station: float) -> ContactState:
    """The part giving the torque; without friction its arm does not depend on the force."""
    at, place = np.array([angle]), np.array([station])
    return part(at, torque / part(at, np.zeros(1), place).arm, place)


def _off_course(
    contact: Callable[[float], ContactState], last: ContactState, chord: Chord, station: float
) -> float:
    """How far the new contact lies off the chord from the last [m]."""
    new = contact(station)
    slope = new.tangent if chord == "backward" else new.tangent + last.tangent
    way = new.point - last.point
    cross = way[0, 0] * slope[0, 1] - way[0, 1] * slope[0, 0]
    return float(cross / np.hypot(*slope[0]))


def _nearest_root(error: Callable[[float], float], start: float) -> float | None:
    """The zero nearest to ``start``, if there is one."""
    start = max(start, _FIRST_STATION) if np.isinf(start) else start
    here = error(start)
    for reach in _REACHES:
        for end in (min(start + reach, STATION_LIMITS[1]), max(start - reach, STATION_LIMITS[0])):
            if here * error(end) <= 0.0:
                return float(brentq(error, start, end, xtol=1e-14, rtol=1e-14))
    return None


def _printed_residuals(
    joint: Joint, angle: float, torque: float, last: Floats, unknown: Floats
) -> Floats:
    """Of Eqs 1 to 9 in m, n, x, y, v, θ, γ, α; lengths over r."""
    m, n, x, y, v, theta, gamma, alpha = unknown
    roller, span = joint.roller, joint.cantilever.length
    bending = joint.cantilever.bending_stiffness
    push = torque / roller.drum_radius
    moment = push * x + y * push * np.tan(alpha)
    tilted = roller.radius * np.cos(angle)
    sunk = roller.offset - roller.drum_radius * np.sin(angle)
    lengths = np.array(
        [
            v + (moment * span**2 / 2.0 + push * span**3 / 3.0) / bending,
            x - (m * np.cos(theta) - n * np.sin(theta)),
            y - (m * np.sin(theta) + n * np.cos(theta) + v),
            x - roller.start - roller.radius * np.cos(gamma),
            sunk - y - tilted * np.sin(gamma),
        ]
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        profile = np.divide(last[1] - n, last[0] - m) - np.tan(alpha - theta)
        round_roller = np.divide(tilted / roller.radius, np.tan(gamma)) - np.tan(alpha)
    rotation = theta + (moment * span + push * span**2 / 2.0) / bending
    return np.array([rotation, *(lengths / roller.radius), profile, round_roller])


def _solved(
    residuals: Callable[[Floats], Floats], guess: Floats, radius: float
) -> tuple[Floats, tuple[str, float, str] | None]:
    """What ``fsolve`` gives, and equation, residual and reason if that is no contact."""
    scale: Floats = np.array([radius] * 5 + [1.0] * 3)

    def scaled_residuals(scaled: Floats) -> Floats:
        return residuals(scaled * scale)

    scaled, _, code, message = fsolve(scaled_residuals, guess / scale, full_output=True, xtol=1e-12)
    found = scaled * scale
    left = residuals(found)
    worst = int(np.argmax(np.where(np.isfinite(left), np.abs(left), np.inf)))
    if not abs(left[worst]) < _MET:
        reason = "not solved" if code == 1 else " ".join(message.split())
        return found, (EQUATIONS[worst], float(left[worst]), reason)
    if not 0.0 < found[6] < 0.5 * np.pi:
        reason = f"contact at gamma = {np.degrees(found[6]):.4g} deg, not between 0 and 90"
        return found, (EQUATIONS[7], float(left[7]), reason)
    return found, None
