"""The foot of a half of an omega leaf: a sector of a ring outside the enclosure's wall.

Where an edge of the leaf ends at the wall it meets the foot there. An edge that comes to the wall
at a small angle is left free up to its end, where a side of the foot begins. Where an edge ends
before the wall, because
the leaf is thick or comes at an angle, a step of the foot stands in the enclosure: its face
begins where the analysed leaf is clamped, and its side goes out to the wall.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from springcad.geometry.outline import Arc, Circle, Piece
from springcad.geometry.outline_ops import piece_end
from springcad.geometry.transform import backwards
from springcad.kinds.lever_arm.curved_half import LEFT, RIGHT, Half, arc_between, line_between
from springcad.kinds.lever_arm.straight import Fittings

Floats = NDArray[np.float64]

_SHOULDER = 1.5
"""Length of the step's face beside its fillet, over the fillet's radius."""
_LEAST_SHOULDER = 0.1
_NEAR = 3.0
"""Radii of its fillet by which an edge may meet the wall before or, straight on, behind its end."""
_MARGIN = 0.05
"""Of a foot beside the leaf, over the fillet's radius."""


@dataclass(frozen=True)
class Room:
    """Where the feet may be: radius of the enclosure, and half the width kept free at x = 0 [m]."""

    wall: float
    aside: float


@dataclass(frozen=True)
class Join:
    """The end of an edge and what follows from there to the wall, or to a side of the foot.

    Attributes:
        station: of the end [m].
        pieces: from there on.
        angle: where they meet the wall, or of the side that they run into [rad].
        is_side: which of both.
    """

    station: float
    pieces: tuple[Piece, ...]
    angle: float
    is_side: bool = False


@dataclass(frozen=True)
class Foot:
    """A sector of a ring about ``center``, from the radius ``wall`` to ``outer`` [m].

    Attributes:
        low, high: angles of its sides [rad].
        right, left: where the leaf's edges end in it.
    """

    center: Floats
    wall: float
    outer: float
    low: float
    high: float
    right: Join
    left: Join

    def pieces(self) -> tuple[Piece, ...]:
        """From the end of the right edge round the foot to the end of the left one."""
        return (
            *self._outwards(self.right, self.low),
            self._arc(self.outer, self.low, self.high),
            *backwards(self._outwards(self.left, self.high)),
        )

    def holes(self, fittings: Fittings) -> tuple[Circle, ...]:
        """Evenly along its middle."""
        pitch = (self.high - self.low) / max(fittings.hole_count, 1)
        radius = 0.5 * (self.wall + self.outer)
        centers = (
            self._point(radius, self.low + (i + 0.5) * pitch) for i in range(fittings.hole_count)
        )
        return tuple(Circle((float(x), float(y)), 0.5 * fittings.hole_diameter) for x, y in centers)

    def _outwards(self, join: Join, side: float) -> tuple[Piece, ...]:
        """From the end of an edge to the outer end of a side."""
        if join.is_side:
            end = piece_end(join.pieces[-1], 1.0)[0]
            return (*join.pieces, line_between(end, self._point(self.outer, side)))
        return (
            *join.pieces,
            self._arc(self.wall, join.angle, side),
            line_between(self._point(self.wall, side), self._point(self.outer, side)),
        )

    def _point(self, radius: float, angle: float) -> Floats:
        return np.asarray(self.center + radius * np.array([math.cos(angle), math.sin(angle)]))

    def _arc(self, radius: float, start: float, end: float) -> Arc:
        return Arc((float(self.center[0]), float(self.center[1])), radius, start, end - start)


def foot_of(half: Half, fittings: Fittings, room: Room) -> Foot:
    """Round the leaf's end, wide enough for its holes, aside from the lever."""
    free = _placed(half, fittings, room, leave_free=True)
    limit = math.acos(room.aside / room.wall)
    if -limit <= free.low and free.high <= limit:
        return free
    return _placed(half, fittings, room, leave_free=False)


def _placed(half: Half, fittings: Fittings, room: Room, *, leave_free: bool) -> Foot:
    """``leave_free``: an edge at a small angle to the wall up to its end."""
    center, radius = np.array([0.0, -half.middle]), fittings.root_fillet
    joins = [_join(half, center, room, radius, side) for side in (RIGHT, LEFT)]
    if leave_free:
        joins = [
            _side(half, center, radius, side)
            if join.station < half.ribbon.length - _NEAR * radius
            else join
            for join, side in zip(joins, (RIGHT, LEFT), strict=True)
        ]
    right, left = joins
    margin = _MARGIN * radius / room.wall
    holes = fittings.hole_count * (fittings.hole_diameter + 2.0 * fittings.eye_wall)
    width = holes / (room.wall + 0.5 * fittings.block_length)
    span = max(left.angle - right.angle + 2.0 * margin, width)
    limit = math.acos(room.aside / room.wall)
    low = min(max(0.5 * (right.angle + left.angle - span), -limit), limit - span)
    low = min(low, right.angle - margin)
    high = max(low + span, left.angle + margin)
    if left.is_side:
        low, high = min(left.angle - span, right.angle - margin), left.angle
    if right.is_side:
        low, high = right.angle, max(right.angle + span, left.angle + margin)
    return Foot(
        center=center,
        wall=room.wall,
        outer=room.wall + fittings.block_length,
        low=low,
        high=high,
        right=right,
        left=left,
    )


def _join(half: Half, middle: Floats, room: Room, radius: float, side: float) -> Join:
    """Of one edge: to the wall at once if that is near, else by a step."""
    length, wall = half.ribbon.length, room.wall

    def inside(stations: float | Floats) -> Floats:
        centers = half.beyond(stations, side, radius)[1] - middle
        return np.asarray(wall - radius - np.hypot(centers[..., 0], centers[..., 1]))

    # From outside in: farther back the leaf may be near the wall again.
    stations = np.linspace(length + 3.0 * wall, 0.5 * length, 2000)
    last = int(np.argmax(inside(stations) > 0.0))
    station = float(
        brentq(lambda s: float(inside(s)), stations[last], stations[last - 1], xtol=1e-15)
    )
    if station > length + _NEAR * radius:
        return _step(half, middle, room, radius, side)
    point, center = half.beyond(station, side, radius)
    on = (line_between(half.edge(length, side)[0], point),) if station > length else ()
    touch, angle = _at_wall(center, middle, wall)
    return Join(station, (*on, arc_between(center, radius, point, touch, side)), angle)


def _side(half: Half, middle: Floats, radius: float, side: float) -> Join:
    """Fillet from the edge's end into a side of the foot."""
    length = half.ribbon.length
    point, center = half.beyond(length, side, radius)
    away = center - middle
    distance = float(np.hypot(*away))
    angle = math.atan2(away[1], away[0]) - side * math.asin(radius / distance)
    along = np.array([math.cos(angle), math.sin(angle)])
    end = middle + math.sqrt(distance**2 - radius**2) * along
    return Join(length, (arc_between(center, radius, point, end, side),), angle, is_side=True)


def _step(half: Half, middle: Floats, room: Room, radius: float, side: float) -> Join:
    """Fillet at the leaf's end, face, corner, straight out to the wall, and fillet there."""
    length, wall = half.ribbon.length, room.wall
    at = half.ribbon.at(np.array([length]))
    along = np.array([math.cos(at.angle[0]), math.sin(at.angle[0])])
    point, center = half.beyond(length, side, radius)
    around = side * _left(center - middle) / np.hypot(*(center - middle))
    # Along the wall, if that makes the corner blunter than a face square to the leaf.
    aside = around if around @ along > 0.0 else side * _left(along)
    touch = center - side * radius * _left(aside)
    corner = touch + _shoulder(touch, aside, room, radius) * aside
    outwards = math.atan2(*(corner - middle)[::-1])
    inner = outwards + side * math.asin(radius / (wall - radius))

    def at_polar(distance: float, angle: float) -> Floats:
        return np.asarray(middle + distance * np.array([math.cos(angle), math.sin(angle)]))

    heel = at_polar(math.sqrt((wall - radius) ** 2 - radius**2), outwards)
    pieces = (
        arc_between(center, radius, point, touch, side),
        line_between(touch, corner),
        line_between(corner, heel),
        arc_between(at_polar(wall - radius, inner), radius, heel, at_polar(wall, inner), side),
    )
    return Join(length, pieces, inner)


def _shoulder(touch: Floats, aside: Floats, room: Room, radius: float) -> float:
    """Length of the step's face beside its fillet: as wanted, or what the lever leaves [m]."""
    wanted = _SHOULDER * radius
    if aside[0] * touch[0] >= 0.0:
        return wanted
    free = (abs(float(touch[0])) - room.aside) / abs(float(aside[0]))
    return max(min(wanted, free), _LEAST_SHOULDER * radius)


def _left(vector: Floats) -> Floats:
    return np.array([-vector[1], vector[0]])


def _at_wall(center: Floats, middle: Floats, wall: float) -> tuple[Floats, float]:
    """Where a circle about ``center`` touches the wall from inside, and the angle there."""
    away = center - middle
    return middle + away * (wall / np.hypot(*away)), math.atan2(away[1], away[0])
