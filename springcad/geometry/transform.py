"""Pieces, outlines and profiles moved in the plane: turned, shifted, mirrored, run backwards."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar, cast

import numpy as np

from springcad.geometry.outline import Arc, Circle, Curve, Floats, Line, Outline, Piece, Profile

Shape = TypeVar("Shape", bound=Piece | Circle | Outline | Profile)


@dataclass(frozen=True)
class _Motion:
    """x -> matrix x + shift; an angle a becomes side * a + angle."""

    matrix: Floats
    shift: Floats
    side: float
    angle: float

    def point(self, point: tuple[float, float]) -> tuple[float, float]:
        x, y = self.matrix @ np.asarray(point) + self.shift
        return float(x), float(y)


def rotate(shape: Shape, angle: float) -> Shape:
    """Turned about the origin by ``angle`` (rad, counter-clockwise)."""
    cos, sin = np.cos(angle), np.sin(angle)
    return _move(shape, _Motion(np.array([[cos, -sin], [sin, cos]]), np.zeros(2), 1.0, angle))


def translate(shape: Shape, x: float, y: float) -> Shape:
    """Shifted by (x, y) in metres."""
    return _move(shape, _Motion(np.eye(2), np.array([x, y]), 1.0, 0.0))


def mirror(shape: Shape, axis_angle: float) -> Shape:
    """Mirrored in the line through the origin at ``axis_angle``.

    The order of an outline is kept, so a counter-clockwise one comes out clockwise.
    """
    cos, sin = np.cos(2.0 * axis_angle), np.sin(2.0 * axis_angle)
    matrix = np.array([[cos, sin], [sin, -cos]])
    return _move(shape, _Motion(matrix, np.zeros(2), -1.0, 2.0 * axis_angle))


def backwards(pieces: tuple[Piece, ...]) -> tuple[Piece, ...]:
    """The same chain run through from its end to its start."""
    return tuple(_backwards(piece) for piece in reversed(pieces))


def _backwards(piece: Piece) -> Piece:
    match piece:
        case Line(start, end):
            return Line(end, start)
        case Arc(center, radius, start_angle, sweep):
            return Arc(center, radius, start_angle + sweep, -sweep)
        case Curve(points, tangents):
            return Curve(points[::-1], -tangents[::-1])


def _move(shape: Shape, motion: _Motion) -> Shape:
    return cast(Shape, _moved(shape, motion))


def _moved(
    shape: Piece | Circle | Outline | Profile, motion: _Motion
) -> Piece | Circle | Outline | Profile:
    match shape:
        case Line(start, end):
            return Line(motion.point(start), motion.point(end))
        case Arc(center, radius, start_angle, sweep):
            begin = motion.side * start_angle + motion.angle
            return Arc(motion.point(center), radius, begin, motion.side * sweep)
        case Curve(points, tangents):
            turned = motion.matrix.T
            return Curve(points @ turned + motion.shift, tangents @ turned)
        case Circle(center, radius):
            return Circle(motion.point(center), radius)
        case Outline(pieces):
            return Outline(tuple(_move(piece, motion) for piece in pieces))
        case Profile(outer, inner):
            return Profile(_move(outer, motion), tuple(_move(c, motion) for c in inner))
