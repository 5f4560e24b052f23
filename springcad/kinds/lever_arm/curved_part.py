"""The outline of an omega leaf: hub, both halves and the feet in which they end, in one piece.

Frame: the lever's pin, the middle of the hub, is the origin; the lever comes from -y.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Arc, Circle, Curve, Outline, Piece, Profile
from springcad.geometry.outline_ops import profile_faults
from springcad.geometry.transform import backwards, mirror
from springcad.kinds.lever_arm.curved_foot import Room, foot_of
from springcad.kinds.lever_arm.curved_half import LEFT, RIGHT, Half, arc_between
from springcad.kinds.lever_arm.omega import OmegaLeaf, half_ribbon, half_start
from springcad.kinds.lever_arm.straight import Fittings

Floats = NDArray[np.float64]

_POINTS = 1200
_COVERS = 1.02
"""The hub reaches this much beyond the corners where the halves begin."""


def curved_profile(leaf: OmegaLeaf, fittings: Fittings, room: Room) -> Profile:
    """The whole part, counter-clockwise.

    Raises:
        InfeasibleError: the halves leave no room on the hub, or the outline is not valid.
    """
    half = _half(leaf, fittings)
    lower, upper = (_leave_hub(half, fittings.eye_fillet, side) for side in (RIGHT, LEFT))
    low, high = (math.atan2(center[1], center[0]) for center, _ in (lower, upper))
    between = min(math.pi - 2.0 * high, math.pi + 2.0 * low)
    if between <= 0.0:
        raise InfeasibleError(
            "angle that the halves of the leaf leave between them on the hub", between, 0.0, "rad",
            ("raise connection.eye_wall",),
        )  # fmt: skip
    foot = foot_of(half, fittings, room)
    right = (
        *_from_hub(half, lower, RIGHT, fittings.eye_fillet, foot.right.station),
        *foot.pieces(),
        *backwards(_from_hub(half, upper, LEFT, fittings.eye_fillet, foot.left.station)),
    )
    left = backwards(tuple(mirror(piece, 0.5 * math.pi) for piece in right))
    top = Arc((0.0, 0.0), half.hub, high, math.pi - 2.0 * high)
    bottom = Arc((0.0, 0.0), half.hub, math.pi - low, math.pi + 2.0 * low)
    holes = foot.holes(fittings)
    others = tuple(mirror(hole, 0.5 * math.pi) for hole in holes)
    pin = Circle((0.0, 0.0), 0.5 * fittings.pin_diameter)
    profile = Profile(Outline((*right, top, *left, bottom)), (pin, *holes, *others))
    faults = profile_faults(profile)
    if faults:
        claim = f"faults in the outline of the leaf ({'; '.join(faults)})"
        raise InfeasibleError(
            claim, len(faults), 0.0, "1", ("raise optimiser.starts", "change optimiser.seed")
        )
    return profile


def clamp_shift(leaf: OmegaLeaf, fittings: Fittings, room: Room) -> float:
    """How far the foot as drawn begins behind (> 0) or before the analysed clamp [m].

    Mean of both edges of the leaf; the fillets themselves are not counted.
    """
    foot = foot_of(_half(leaf, fittings), fittings, room)
    return 0.5 * (foot.right.station + foot.left.station) - leaf.length


def hub_radius(leaf: OmegaLeaf, fittings: Fittings) -> float:
    """Of the disc that is drawn: wall round the pin, and what the halves grow from [m]."""
    thick = 0.5 * float(leaf.thickness_coefficients[0])
    eye = 0.5 * fittings.pin_diameter + fittings.eye_wall
    return max(eye, _COVERS * math.hypot(leaf.hub_radius, thick))


def _half(leaf: OmegaLeaf, fittings: Fittings) -> Half:
    start = half_start(leaf) - np.array([0.0, leaf.middle])
    return Half(half_ribbon(leaf), start, hub_radius(leaf, fittings), leaf.middle)


def _leave_hub(half: Half, radius: float, side: float) -> tuple[Floats, float]:
    """Centre of the fillet between hub and an edge, and the station where it meets the edge."""

    def outside(stations: float | Floats) -> Floats:
        centers = half.beyond(stations, side, radius)[1]
        return np.asarray(np.hypot(centers[..., 0], centers[..., 1]) - (half.hub + radius))

    # The first station beside the hub: farther on the half may come near it again.
    stations = np.linspace(0.0, 0.5 * half.ribbon.length, 400)
    beyond = float(stations[np.argmax(outside(stations) > 0.0)])
    if beyond == 0.0:
        raise InfeasibleError(
            "radius of the hub, for the fillets beside it", half.hub, 0.0, "m",
            ("raise connection.eye_wall",),
        )  # fmt: skip
    station = float(brentq(lambda s: float(outside(s)), 0.0, beyond, xtol=1e-15))
    return half.beyond(station, side, radius)[1], station


def _from_hub(
    half: Half, fillet: tuple[Floats, float], side: float, radius: float, end: float
) -> tuple[Piece, ...]:
    """Fillet and edge, from the hub outwards to the station ``end`` or the leaf's end."""
    center, start = fillet
    end = min(end, half.ribbon.length)
    dense = half.ribbon.dense_stations(_POINTS)
    stations = np.concatenate([[start], dense[(dense > start) & (dense < end)], [end]])
    curves = half.ribbon.boundary(stations)
    edge = curves[0] if side == LEFT else curves[1]
    points = edge.points + half.start
    on_hub = center * (half.hub / np.hypot(*center))
    return (
        arc_between(center, radius, on_hub, points[0], side),
        Curve(points, edge.tangents),
    )
