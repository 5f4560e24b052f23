"""Exact kinetostatics of a lever with a movable pivot between a crank and a spring (paper 000).

Frame: x across the lever at rest, y along it; the pin of the crank is at rest in (0, 0), the pin of
the spring in (0, l) and the pivot stands at (0, q), 0 < q < l. The lever is a straight slotted bar.
It turns and slides on the pivot and on the pin of the spring, which a straight guide along x holds
at y = l and which the spring pushes back along x. The crank of radius R turns by φ and has moved
its pin across by R sin φ. How far the pin has moved *along* the lever meanwhile tells three
arrangements apart (``Output``): ε R (1 − cos φ) away from the pivot, so that the deflection of
the spring is

    s = (l − q) R sin φ / (q + ε R (1 − cos φ)).

With ε = 0 this is 000, Eq. 1, to the last digit; in the others it differs from it by the order φ³.
No friction, no play, rigid parts but for the spring and one series stiffness at the output.
Angles and deflections are arrays of any shape that broadcast; both signs.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.spring_law import SpringLaw

Floats = NDArray[np.float64]

Output = Literal["yoke", "crank-behind", "crank-ahead"]
"""How the lever is joined to the output:

- ``yoke``: the crank's pin runs in a slot of a slide that is guided across the lever (a Scotch
  yoke), so the lever's end stays at y = 0: ε = 0, the equations of paper 000.
- ``crank-behind``: the crank's pin is in the lever, its axis at (0, −R), beyond the lever's end:
  ε = 1.
- ``crank-ahead``: the same with the axis at (0, R), on the side of the pivot: ε = −1.
"""
RETREAT: dict[Output, float] = {"yoke": 0.0, "crank-behind": 1.0, "crank-ahead": -1.0}
"""ε of each arrangement."""


@dataclass(frozen=True)
class Lever:
    """The mechanism but for its spring.

    Attributes:
        length: l, from the crank's pin to the spring's pin [m].
        crank_radius: R [m].
        output: how the lever is joined to the output.
        series_stiffness: of all that yields between spring and output, inf if rigid [N m/rad].
    """

    length: float
    crank_radius: float
    output: Output = "yoke"
    series_stiffness: float = np.inf

    @property
    def retreat(self) -> float:
        """ε R: the crank pin's way along the lever is this times 1 − cos φ [m]."""
        return RETREAT[self.output] * self.crank_radius


class Transmission(NamedTuple):
    """Deflection s [m] of the spring over the crank's angle, with its derivatives."""

    deflection: Floats
    rate: Floats
    second: Floats


class Loads(NamedTuple):
    """Forces of one state [N], signed as the spring's, and the lever's tilt [rad].

    ``spring`` acts along x; ``output`` and ``pivot`` are normal to the lever.
    """

    spring: Floats
    output: Floats
    pivot: Floats
    tilt: Floats


class Response(NamedTuple):
    """States of the joint at one or many pivot positions.

    Attributes:
        crank_angle: φ [rad].
        angle: of the output, with the twist of the series stiffness [rad].
        deflection: of the spring [m].
        torque: [N m].
        crank_stiffness: dτ/dφ [N m/rad].
        stiffness: of the output, series stiffness included [N m/rad].
        energy: in the spring and in the series stiffness [J].
    """

    crank_angle: Floats
    angle: Floats
    deflection: Floats
    torque: Floats
    crank_stiffness: Floats
    stiffness: Floats
    energy: Floats


def transmission(lever: Lever, pivot: Floats | float, angle: Floats | float) -> Transmission:
    """s(φ) and its first two derivatives; for a yoke 000, Eq. 1."""
    q, phi = np.asarray(pivot, dtype=np.float64), np.asarray(angle, dtype=np.float64)
    e = lever.retreat
    sine, cosine = np.sin(phi), np.cos(phi)
    arm, scale = q + e * (1.0 - cosine), (lever.length - q) * lever.crank_radius
    top = cosine * (q + e) - e
    return Transmission(
        deflection=scale * sine / arm,
        rate=scale * top / arm**2,
        second=-scale * sine * ((q + e) / arm**2 + 2.0 * e * top / arm**3),
    )


def dead_angle(lever: Lever, pivot: Floats | float) -> Floats:
    """Crank angle beyond which the spring is not deflected further, at most 90 deg [rad].

    For a yoke 90 deg; for ``crank-behind`` where ds/dφ = 0; for ``crank-ahead`` where the crank's
    pin meets the pivot (the deflection grows without bound before).
    """
    q, radius = np.asarray(pivot, dtype=np.float64), lever.crank_radius
    if lever.output == "crank-behind":
        return np.arccos(radius / (q + radius))
    if lever.output == "crank-ahead":
        return np.arccos(np.maximum(1.0 - q / radius, 0.0))
    return np.full_like(q, 0.5 * np.pi)


def crank_angle(lever: Lever, pivot: Floats | float, deflection: Floats | float) -> Floats:
    """φ that deflects the spring by s, nan where none up to the dead angle does; for a yoke Eq. 7.

    From (l − q) R sin φ + s ε R cos φ = s (q + ε R).
    """
    q, s = np.asarray(pivot, dtype=np.float64), np.asarray(deflection, dtype=np.float64)
    e = lever.retreat
    across, along = (lever.length - q) * lever.crank_radius, s * e
    with np.errstate(invalid="ignore"):
        angle = np.arcsin(s * (q + e) / np.hypot(across, along)) - np.arctan2(along, across)
        return np.where(np.abs(angle) <= dead_angle(lever, q), angle, np.nan)


def stroke(lever: Lever, pivot: Floats | float, deflection: float) -> Floats:
    """Largest crank angle: where the spring is at ``deflection`` > 0, else the dead angle [rad]."""
    angle = crank_angle(lever, pivot, deflection)
    return np.where(np.isnan(angle), dead_angle(lever, pivot), angle)


def required_pivot(lever: Lever, angle: Floats | float, deflection: Floats | float) -> Floats:
    """Pivot position q at which the crank angle φ deflects the spring by s (for a yoke Eq. 8)."""
    phi, s = np.asarray(angle, dtype=np.float64), np.asarray(deflection, dtype=np.float64)
    across = lever.crank_radius * np.sin(phi)
    retreat = lever.retreat * (1.0 - np.cos(phi))
    return np.asarray((lever.length * across - s * retreat) / (s + across))


def loads(
    lever: Lever, pivot: Floats | float, angle: Floats | float, spring_force: Floats | float
) -> Loads:
    """Forces on the lever under the force of the spring (for small angles 000, Eqs 2 and 3).

    The pins press normal to the bar: the moment about the pivot and the sum across the bar vanish.
    """
    q, phi = np.asarray(pivot, dtype=np.float64), np.asarray(angle, dtype=np.float64)
    force = np.asarray(spring_force, dtype=np.float64)
    arm = q + lever.retreat * (1.0 - np.cos(phi))
    tilt = np.arctan2(lever.crank_radius * np.sin(phi), arm)
    at_spring = force / np.cos(tilt)
    output = at_spring * (lever.length - q) / arm
    return Loads(force, output, at_spring + output, tilt)


def pivot_load_ratio(lever: Lever, pivot: Floats | float, angle: Floats | float) -> Floats:
    """Force at the pivot over that at the output, 1 + R sin φ/s (000, Eq. 9)."""
    q, phi = np.asarray(pivot, dtype=np.float64), np.asarray(angle, dtype=np.float64)
    return np.asarray(1.0 + (q + lever.retreat * (1.0 - np.cos(phi))) / (lever.length - q))


def response(
    lever: Lever, law: SpringLaw, pivot: Floats | float, angle: Floats | float
) -> Response:
    """What the joint does at crank angles up to the stroke: all from the energy of the spring.

    τ = F ds/dφ and dτ/dφ = F' (ds/dφ)² + F d²s/dφ²; a series stiffness K_p adds the angle τ/K_p,
    the compliance 1/K_p and the energy τ²/(2 K_p). With a linear spring and a yoke
    τ = K₀ sin φ cos φ and dτ/dφ = K₀ cos 2φ with the K₀ of Eq. 5; Eq. 4 lacks both factors.
    """
    phi = np.asarray(angle, dtype=np.float64)
    motion = transmission(lever, pivot, phi)
    force = law.force(motion.deflection)
    torque = force * motion.rate
    direct = law.stiffness(motion.deflection) * motion.rate**2 + force * motion.second
    series = lever.series_stiffness
    return Response(
        crank_angle=np.broadcast_to(phi, torque.shape),
        angle=phi + torque / series,
        deflection=motion.deflection,
        torque=torque,
        crank_stiffness=direct,
        stiffness=direct / (1.0 + direct / series),
        energy=law.energy(motion.deflection) + 0.5 * torque**2 / series,
    )


def boundary(lever: Lever, law: SpringLaw, pivot: Floats) -> Response:
    """The end of the stroke at every pivot position: the limit of the workspace (000, Fig. 3)."""
    return response(lever, law, pivot, stroke(lever, pivot, law.deflection))
