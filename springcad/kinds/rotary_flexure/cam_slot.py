"""The tooth space of the camshaft: two conjugate flanks, walls and a round bottom.

All in the camshaft's frame, the axis of the slot at angle 0. Every joint is smooth (G1). Where a
conjugate flank would be sharper than the smallest radius wanted (near rest a flat pad asks for a
radius of −λ_t, which no rigid body has) an arc of that radius takes over up to rest; it stands
proud of the pad by less than a micrometre, ``Slot.preload``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Arc, Curve, Line, Piece
from springcad.geometry.outline_ops import piece_end
from springcad.geometry.polyline import rotate_vectors
from springcad.geometry.transform import backwards, rotate
from springcad.mechanics.conjugate import Flank, between
from springcad.mechanics.flank_faults import require_no_undercut

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Rest:
    """The unloaded tip, about the ring's centre: where its nose begins and which way it points."""

    nose_center: Floats
    inward: Floats
    half_thickness: float


@dataclass(frozen=True)
class Slot:
    """One tooth space as a chain of pieces from the tip circle in and out again.

    The first half is the flank of direction +1 (on the side of negative y), the second that of
    direction −1.

    Attributes:
        pieces: the chain; it ends on the tip circle at both ends.
        tip_radius: of the camshaft.
        bottom_radius: where the bottom is deepest.
        foot_radius: of the bottom arc's centre, where its walls begin.
        opening: polar angles of its two ends (rad).
        preload: how far the arcs stand into the unloaded tip, the deeper of the two (m).
        exact_from: angle from which each flank is exactly conjugate (rad), directions +1, −1.
        free_play: angle by which the camshaft turns from rest before it touches the tips (rad).
    """

    pieces: tuple[Piece, ...]
    tip_radius: float
    bottom_radius: float
    foot_radius: float
    opening: tuple[float, float]
    preload: float
    exact_from: tuple[float, float]
    free_play: float


@dataclass(frozen=True)
class _Side:
    """One side of the slot from its top to where it is parallel to the unloaded tip.

    ``top_center`` is the centre of curvature at the top.
    """

    pieces: tuple[Piece, ...]
    normal: Floats
    preload: float
    exact_from: float
    top_center: Floats

    @property
    def top(self) -> Floats:
        return piece_end(self.pieces[0], 0.0)[0]

    @property
    def foot(self) -> Floats:
        return piece_end(self.pieces[-1], 1.0)[0]


def tooth_space(
    flanks: tuple[Flank, Flank],
    rest: Rest,
    *,
    smallest_radius: float,
    backlash: float,
    bottom_clearance: float,
    land: float,
) -> Slot:
    """Build the slot from the flanks of directions +1 and −1.

    Args:
        flanks: ``require_round``; their largest angle gives the height of the teeth.
        rest: the unloaded tip.
        smallest_radius: of curvature of a flank (m).
        backlash: play of the unloaded tip, both sides together, at the contact radius (m).
        bottom_clearance: between the nose at rest and the bottom, at least (m).
        land: by how much a flank goes on beyond its last contact, with the curvature that it has
            there, at least, so that the contact strip does not reach the tooth's corner (m). On a
            straight end the pad would lie flat.

    Raises:
        InfeasibleError: a flank bends back below the tip circle.
    """
    turn = 0.5 * backlash / float(np.hypot(*rest.nose_center))
    sides = [_side(flank, rest, smallest_radius, -flank.direction * turn) for flank in flanks]
    tip_radius = max(float(np.hypot(*side.top)) for side in sides) + land
    lower, upper = (_reaching(side, tip_radius) for side in sides)
    center, radius = _bottom(lower, upper, rest, bottom_clearance)
    feet = [center + radius * side.normal for side in (lower, upper)]
    start, end = _polar(lower.normal), _polar(upper.normal)
    pieces = (
        *lower.pieces,
        Line(_pair(lower.foot), _pair(feet[0])),
        Arc(_pair(center), radius, start, -((start - end) % (2.0 * np.pi))),
        Line(_pair(feet[1]), _pair(upper.foot)),
        *backwards(upper.pieces),
    )
    return Slot(
        pieces=pieces,
        tip_radius=tip_radius,
        bottom_radius=float(np.hypot(*center)) - radius,
        foot_radius=float(np.hypot(*center)),
        opening=(_polar(lower.top), _polar(upper.top)),
        preload=max(lower.preload, upper.preload),
        exact_from=(lower.exact_from, upper.exact_from),
        free_play=turn,
    )


def require_round(flank: Flank, smallest_radius: float) -> None:
    """Refuse a flank that no arc near rest can stand in for.

    Raises:
        InfeasibleError: it is hollow or sharper than ``smallest_radius`` beyond half of its stroke.
    """
    middle = float(flank.angle[len(flank.angle) // 2])
    require_no_undercut(between(flank, middle, float(flank.angle[-1])), smallest_radius)


def flank_points(slot: Slot, direction: int) -> Floats:
    """Dense points (M, 2) of one side from its top, as solved; its arc goes on by half.

    That a little more than the drawn flank is there helps a search for the contact near rest.
    """
    chain = slot.pieces if direction > 0 else backwards(slot.pieces)
    first = next(i for i, piece in enumerate(chain) if isinstance(piece, Curve))
    curve, arc = chain[first : first + 2]
    assert isinstance(curve, Curve)
    assert isinstance(arc, Arc)
    angle = arc.start_angle + arc.sweep * np.linspace(0.0, 1.5, 31)[1:]
    beyond = np.array(arc.center) + arc.radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return np.concatenate([curve.points, beyond])


def _side(flank: Flank, rest: Rest, smallest_radius: float, turn: float) -> _Side:
    """The exact flank down to the smallest radius, then an arc until parallel to the tip."""
    sharp = np.flatnonzero(flank.radius < smallest_radius)
    first = int(sharp[-1]) + 1 if len(sharp) else 0
    curve = Curve(flank.points[first:][::-1], flank.tangents[first:][::-1])
    radius, normal = float(flank.radius[first]), flank.normals[first]
    wall = flank.direction * np.array([-rest.inward[1], rest.inward[0]])
    center = flank.points[first] + radius * normal
    arc = Arc(_pair(center), radius, _polar(-normal), _turn_between(normal, wall))
    top_center = flank.points[-1] + float(flank.radius[-1]) * flank.normals[-1]
    proud = rest.half_thickness - float((center - radius * wall - rest.nose_center) @ wall)
    return _Side(
        pieces=(rotate(curve, turn), rotate(arc, turn)),
        normal=rotate_vectors(wall[None], np.array([turn]))[0],
        preload=proud,
        exact_from=float(flank.angle[first]),
        top_center=rotate_vectors(top_center[None], np.array([turn]))[0],
    )


def _reaching(side: _Side, tip_radius: float) -> _Side:
    """The side with an arc of its last curvature up to the tip circle where it ends below it."""
    if tip_radius - np.hypot(*side.top) < 1e-9:
        return side
    spoke = side.top - side.top_center
    radius, height = float(np.hypot(*spoke)), float(np.hypot(*side.top_center))
    crest = (tip_radius**2 - height**2 - radius**2) / (2.0 * height * radius)
    if crest > 1.0:
        raise InfeasibleError(
            "a flank bends back below the tip circle, radius reached",
            height + radius, tip_radius, "m",
        )  # fmt: skip
    outwards = _polar(side.top_center)
    lean = _turn_between(side.top_center, spoke)
    start = outwards + float(np.copysign(np.arccos(crest), lean))
    arc = Arc(_pair(side.top_center), radius, start, outwards + lean - start)
    return replace(side, pieces=(arc, *side.pieces))


def _bottom(lower: _Side, upper: _Side, rest: Rest, clearance: float) -> tuple[Floats, float]:
    """Centre and radius of the arc tangent to both walls, its centre below the nose's."""
    across = np.array([-rest.inward[1], rest.inward[0]])
    below = rest.nose_center + clearance * rest.inward
    rows = np.array([[1.0, float(side.normal @ across)] for side in (lower, upper)])
    gaps = np.array([float(side.normal @ (side.foot - below)) for side in (lower, upper)])
    radius, shift = np.linalg.solve(rows, gaps)
    return below + shift * across, float(radius)


def _turn_between(start: Floats, end: Floats) -> float:
    """Signed angle in (−π, π] from one direction to another."""
    cross = start[0] * end[1] - start[1] * end[0]
    return float(np.arctan2(cross, start @ end))


def _polar(point: Floats) -> float:
    return float(np.arctan2(point[1], point[0]))


def _pair(point: Floats) -> tuple[float, float]:
    return float(point[0]), float(point[1])
