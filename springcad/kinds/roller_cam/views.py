"""The element among its mates: at rest, at full deflection, and along the cantilever.

Frame of ``springcad.kinds.roller_cam.joint``. The drum turns about an axis along x: its circle is
seen only along the cantilever.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Arc, Circle, Contour, Curve, Line, Outline, Piece, Profile
from springcad.geometry.outline_ops import contour_bounds
from springcad.geometry.transform import mirror, translate
from springcad.kinds.roller_cam.joint import Cantilever, Roller
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.kinds.roller_cam.part import roller_contact
from springcad.kinds.roller_cam.tip import rooted_beam
from springcad.mechanics.beam import follower_load
from springcad.mechanics.centre_line import deformed_points
from springcad.mechanics.plane import rotated
from springcad.result import Dimension, Shape, View

Floats = NDArray[np.float64]
Motion = Callable[[Floats], Floats]
"""Where points (N, 2) [m] of the element go."""

_SPACING = 0.25e-3
"""Of the points at which a bent outline is known (m)."""
_STEP = 1e-7
"""For its directions (m)."""
_RADIUS_SHOWN = 30e-3
"""Of the drum no more is shown than this, inwards from the roller (m)."""
_BEYOND = 3e-3
"""By which axes stand out (m)."""


def joint_views(made: MadeJoint) -> tuple[View, ...]:
    """Three views at true size; the mirrored element is shown with the element."""
    return (_at_rest(made), _at_full_stroke(made), _along_the_drum(made))


def _at_rest(made: MadeJoint) -> View:
    roller = made.joint.roller
    return View(
        title="at rest, with the mirrored element",
        shapes=(
            *_axes(made),
            Shape(_mirrored(made), "mate"),
            Shape(made.element, "part"),
            Shape(_roller(roller, 0.0), "mate"),
        ),
        dimensions=(
            Dimension("offset of the roller", "linear", (0.0, 0.0), (0.0, roller.offset)),
            Dimension("roller", "diameter", (0.0, roller.offset), (-roller.radius, roller.offset)),
        ),
    )


def _at_full_stroke(made: MadeJoint) -> View:
    roller, angle = made.joint.roller, float(made.stroke.angle[-1])
    bent = full_deflection(made)
    side, sunk = -roller.radius, _height(roller, angle)
    (tip,) = bent(np.zeros((1, 2)))
    turned = f"{math.degrees(angle):.4g} deg"
    return View(
        title=f"turned by {turned}",
        shapes=(
            *_axes(made),
            Shape(_mirrored(made), "mate"),
            Shape(Profile(_moved(made.element.outer, bent), made.element.inner), "part"),
            Shape(_roller(roller, angle), "mate"),
        ),
        dimensions=(
            Dimension("way of the roller", "linear", (side, sunk), (side, roller.offset)),
            Dimension("way of the tip", "linear", (0.0, float(tip[1])), (0.0, 0.0)),
        ),
    )


def _along_the_drum(made: MadeJoint) -> View:
    """Seen along the cantilever: x outward from the drum, 0 in the middle of the sheet."""
    roller, angle = made.joint.roller, float(made.stroke.angle[-1])
    sheet = made.joint.cantilever.width
    disc = _rectangle(0.5 * sheet, -roller.radius, roller.radius)

    def on_drum(shape: Floats, turned: float) -> Floats:
        """A shape round the roller's centre, where the drum has turned by an angle."""
        outward = shape + np.array([roller.drum_radius, 0.0])
        shift = np.array([-roller.drum_radius, roller.offset])
        return np.asarray(rotated(outward, np.full(len(shape), -turned)) + shift)

    spoke = np.array([[-min(_RADIUS_SHOWN, roller.drum_radius), 0.0], [sheet + _BEYOND, 0.0]])
    wide = math.asin(min(1.0, 2.0 * roller.radius / roller.drum_radius))
    way = np.concatenate(
        [on_drum(np.zeros((1, 2)), turned) for turned in np.linspace(-wide, angle + wide, 100)]
    )
    return View(
        title=f"along the drum, roller on R {1e3 * roller.drum_radius:.6g} mm",
        shapes=(
            Shape(_sheet(sheet, _mirrored(made)), "mate"),
            Shape(_sheet(sheet, made.element), "part"),
            Shape(way, "axis"),
            *(Shape(on_drum(spoke, turned), "axis") for turned in (0.0, angle)),
            *(Shape(on_drum(disc, turned), "moved") for turned in (0.0, angle)),
        ),
        dimensions=(),
    )


def full_deflection(made: MadeJoint) -> Motion:
    """Where the element's points go at full stroke.

    The cantilever bends as a beam, its end takes the contact part along. What the contact part
    itself yields is known where the roller touches it, and falls off as in a cantilever that
    stands on the end: exact at the contact, right for the eye elsewhere.
    """
    stroke, beam = made.stroke, made.joint.cantilever
    roller, angle = made.joint.roller, float(stroke.angle[-1])
    turn, tip = stroke.tip.rotation[-1], stroke.tip.displacement[-1]
    touched = _touched(roller, angle, float(stroke.gamma[-1]))
    force = rotated(stroke.force[-1], -turn)
    cantilever = _bent(beam, force, rotated(touched - tip, -turn))
    (unloaded,) = made.drawn.curve.points(stroke.place[-1:])
    yielding = touched - (rotated(unloaded, turn) + tip)
    foot = 0.5 * beam.height

    def moved(points: Floats) -> Floats:
        height = np.where(points[:, 0] > -foot, points[:, 1] - foot, 0.0)
        share = np.maximum(height, 0.0) / (unloaded[1] - foot)
        return np.asarray(cantilever(points) + share[:, None] ** 2 * yielding)

    return moved


def _bent(beam: Cantilever, force: Floats, point: Floats) -> Motion:
    """By a force at a point, both (2,) in the frame of the deflected tip."""
    prepared = rooted_beam(beam)
    moment = point[0] * force[1] - point[1] * force[0]
    states = follower_load(prepared, beam.length, force[0], force[1], moment)

    def moved(points: Floats) -> Floats:
        station = points[:, 0] + beam.length
        on_beam = np.clip(station, 0.0, beam.length)
        centre, turn = (each[0] for each in deformed_points(prepared, states, on_beam))
        arm = np.column_stack([station - on_beam, points[:, 1]])
        return np.asarray(rotated(arm, turn) + centre - np.array([beam.length, 0.0]))

    return moved


def _touched(roller: Roller, angle: float, gamma: float) -> Floats:
    """Where the roller touches, in space (2,)."""
    contact = roller_contact(roller, np.array([angle]), np.array([gamma]))
    return np.asarray(contact.point[0])


def _moved(contour: Contour, motion: Motion) -> Outline:
    assert isinstance(contour, Outline)
    return Outline(tuple(_moved_piece(piece, motion) for piece in contour.pieces))


def _moved_piece(piece: Piece, motion: Motion) -> Curve:
    points, tangents = _sampled(piece)
    step = _STEP * tangents
    along = motion(points + step) - motion(points - step)
    return Curve(motion(points), along / np.hypot(*along.T)[:, None])


def _sampled(piece: Piece) -> tuple[Floats, Floats]:
    """Dense points and unit tangents (N, 2) of a piece."""
    match piece:
        case Line(start, end):
            way = np.subtract(end, start)
            share = np.linspace(0.0, 1.0, _count(float(np.hypot(*way))))[:, None]
            tangent = way / np.hypot(*way)
            return np.asarray(start) + share * way, np.broadcast_to(tangent, (len(share), 2))
        case Arc(center, radius, start_angle, sweep):
            count = _count(abs(sweep) * radius)
            angle = start_angle + sweep * np.linspace(0.0, 1.0, count)
            outward = np.column_stack([np.cos(angle), np.sin(angle)])
            tangents = math.copysign(1.0, sweep) * np.column_stack([-outward[:, 1], outward[:, 0]])
            return np.asarray(center) + radius * outward, tangents
        case Curve(points, tangents):
            return points, tangents


def _count(length: float) -> int:
    return max(5, math.ceil(length / _SPACING) + 1)


def _roller(roller: Roller, angle: float) -> Circle | Outline:
    """The roller as it is seen when the drum has turned: its disc tilts."""
    centre = (0.0, _height(roller, angle))
    if angle == 0.0:
        return Circle(centre, roller.radius)
    around = np.linspace(0.0, 2.0 * math.pi, 181)
    half = roller.radius * np.array([1.0, math.cos(angle)])
    points = centre + half * np.column_stack([np.cos(around), np.sin(around)])
    along = half * np.column_stack([-np.sin(around), np.cos(around)])
    points[-1] = points[0]
    return Outline((Curve(points, along / np.hypot(*along.T)[:, None]),))


def _height(roller: Roller, angle: float) -> float:
    """Of the roller's centre."""
    return roller.offset - roller.drum_radius * math.sin(angle)


def _mirrored(made: MadeJoint) -> Profile:
    """The element for the other direction, at the other side of the roller."""
    return translate(mirror(made.element, 0.0), 0.0, 2.0 * made.joint.roller.offset)


def _axes(made: MadeJoint) -> tuple[Shape, Shape]:
    """Of the cantilever and of the roller at rest."""
    x0, _, x1, _ = contour_bounds(made.element.outer)
    ends = np.array([x0 - _BEYOND, x1 + _BEYOND])
    heights = (0.0, made.joint.roller.offset)
    cantilever, roller = (np.column_stack([ends, [y, y]]) for y in heights)
    return Shape(cantilever, "axis"), Shape(roller, "axis")


def _sheet(thickness: float, element: Profile) -> Outline:
    """The element seen along the cantilever."""
    _, y0, _, y1 = contour_bounds(element.outer)
    half = 0.5 * thickness
    corners = [(-half, y0), (half, y0), (half, y1), (-half, y1)]
    return Outline(
        tuple(
            Line(start, end) for start, end in zip(corners, [*corners[1:], corners[0]], strict=True)
        )
    )


def _rectangle(half: float, low: float, high: float) -> Floats:
    """Corners (5, 2) of a closed rectangle about x = 0."""
    return np.array([[-half, low], [half, low], [half, high], [-half, high], [-half, low]])
