"""The cantilever with its profile, pressed by the roller, as an elastic part.

The tip of the cantilever carries the profile, so places and directions are in the frame of the
deflected tip. The mate is the roller, and the station is ln γ with γ the angle round the roller
from beside it (0, no stiffness) to under it (π/2, all the stiffness of the cantilever).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.roller_cam.joint import Joint, Roller
from springcad.kinds.roller_cam.tip import TipModel, TipState, exact_tip, linear_tip, printed_tip
from springcad.mechanics.elastic_part import ContactState, ElasticPart
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]

ContactCompliance = Callable[[Floats], Floats]
"""Of the contact part against the tip (A, 2, 2) [m/N], in the frame of the tip, where the roller
touches it at the angles (A,) [rad]."""

STATION_LIMITS = (float(np.log(1e-9)), float(np.log(0.5 * np.pi)))
"""Of ln γ, in the order in which contacts are searched: beside the roller first."""


@dataclass(frozen=True)
class RollerContact:
    """Where the roller touches, in the frame of the clamp; arrays over A.

    Attributes:
        point: of contact (A, 2) [m].
        normal: of the roller, outward: the direction of its force (A, 2).
        tangent: of the roller towards its underside (A, 2).
        reach: way of the roller's point of contact down, per angle (A,) [m].
    """

    point: Floats
    normal: Floats
    tangent: Floats
    reach: Floats


def roller_contact(roller: Roller, angle: Floats, gamma: Floats) -> RollerContact:
    """The point of the tilted roller at γ (001, Eqs 4, 6, 7, 8)."""
    tilted = roller.radius * np.cos(angle)
    x = roller.start + roller.radius * np.cos(gamma)
    y = roller.offset - roller.drum_radius * np.sin(angle) - tilted * np.sin(gamma)
    slope = np.arctan2(np.cos(angle) * np.cos(gamma), np.sin(gamma))
    reach = roller.drum_radius * np.cos(angle) - roller.radius * np.sin(angle) * np.sin(gamma)
    return RollerContact(
        point=np.stack([x, y], axis=-1),
        normal=np.stack([np.sin(slope), -np.cos(slope)], axis=-1),
        tangent=np.stack([-np.cos(slope), -np.sin(slope)], axis=-1),
        reach=reach,
    )


def roller_curvature(roller: Roller, angle: Floats, gamma: Floats) -> Floats:
    """Of the ellipse with the half axes r and r cos β at γ (1/m)."""
    tilted = roller.radius * np.cos(angle)
    width = np.hypot(roller.radius * np.sin(gamma), tilted * np.cos(gamma))
    return np.asarray(roller.radius * tilted / width**3)


def linear_part(
    joint: Joint, *, friction: float = 0.0, compliance: ContactCompliance | None = None
) -> ElasticPart:
    """With small rotations and bending alone (``linear_tip``); see ``part_with``."""
    return part_with(joint, linear_tip(joint.cantilever), friction=friction, compliance=compliance)


def exact_part(
    joint: Joint, *, friction: float = 0.0, compliance: ContactCompliance | None = None
) -> ElasticPart:
    """With the geometrically exact beam (``exact_tip``); see ``part_with``."""
    return part_with(joint, exact_tip(joint.cantilever), friction=friction, compliance=compliance)


def part_with(
    joint: Joint,
    tip: TipModel,
    *,
    friction: float = 0.0,
    compliance: ContactCompliance | None = None,
) -> ElasticPart:
    """The part with any model of its cantilever.

    Args:
        friction: tangential over normal force on the roller, positive towards its underside.
        compliance: C of the contact part. With the force F in the frame of the tip it adds
            Fᵀ C F/2 to the energy and takes C F off the point of the unloaded profile.
    """
    roller = joint.roller

    def part(angle: Floats, force: Floats, station: Floats) -> ContactState:
        gamma = np.exp(station)
        touch = roller_contact(roller, angle, gamma)
        on_profile = force[:, None] * (touch.normal - friction * touch.tangent)
        state = tip(touch.point, on_profile)
        point, energy = in_tip_frame(touch.point, state), state.energy
        if compliance is not None:
            carried = rotated(on_profile, -state.rotation)
            yielding = np.einsum("aij,aj->ai", compliance(angle), carried)
            point = point - yielding
            energy = energy + 0.5 * np.einsum("ai,ai->a", carried, yielding)
        return ContactState(
            arm=-touch.reach * (touch.normal - friction * touch.tangent)[:, 1],
            reach=touch.reach,
            energy=energy,
            point=point,
            normal=rotated(touch.normal, -state.rotation),
            tangent=rotated(touch.tangent, -state.rotation),
            arc=roller.radius * gamma,
            mate_curvature=roller_curvature(roller, angle, gamma),
        )

    return part


def printed_part(joint: Joint) -> ElasticPart:
    """The statics as paper 001 prints them: Eq. 1 with y, and Eq. 9, τ = F_y R."""
    part = part_with(joint, printed_tip(joint.cantilever))

    def printed(angle: Floats, force: Floats, station: Floats) -> ContactState:
        state = part(angle, force, station)
        cosine = state.arm / state.reach
        reach = np.full_like(angle, joint.roller.drum_radius)
        return replace(state, arm=reach * cosine, reach=reach)

    return printed


def in_tip_frame(points: Floats, state: TipState) -> Floats:
    """Points (A, 2) of space seen from the deflected tip."""
    return rotated(points - state.displacement, -state.rotation)
