"""The unit seen along its axis, at rest and bent, and the rod's tip seen from above.

Frame of the unit: origin at the pivot, the lever at rest along x, as in ``leaf``. The roller lies
between two leaves, one for each direction; the guide takes both and fills the room between them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Arc, Circle, Line, Outline
from springcad.kinds.leaf_2dof.made import MadeLeaves, at_length
from springcad.kinds.leaf_2dof.parts import rounded_rectangle
from springcad.kinds.leaf_2dof.unit import bent_line
from springcad.kinds.leaf_2dof.wrist import workspace_boundary
from springcad.mechanics.plane import rotated
from springcad.result import Dimension, Shape, View

Floats = NDArray[np.float64]

_STATIONS = 160
_LEVER = 0.4
"""Half the width of the lever as shown, over the radius of the roller."""
_BEYOND = 3e-3
"""By which axes stand out (m)."""


def leaf_views(made: MadeLeaves) -> tuple[View, ...]:
    """At true size: the unit at its longest and its shortest length, and the workspace."""
    return (
        _unit(made, -1, "longest effective length"),
        _unit(made, 0, "shortest effective length"),
        _workspace(made),
    )


def _unit(made: MadeLeaves, index: int, words: str) -> View:
    stroke = at_length(made.strokes, index)
    length, angle = float(stroke.length[-1]), float(stroke.angle[-1])
    lever, leaf, plan = made.setup.lever, made.setup.leaf, made.planform
    R, r, b = lever.radius, lever.roller_radius, leaf.thickness
    here, far = _along(made, length), _along(made, length + plan.guide)
    at_mount, end = (
        _along(made, plan.guide + plan.longest),
        _along(made, plan.length - plan.overhang),
    )
    blocks = [
        _block((x0, x1), (y0, y1))
        for x0, x1 in ((here, far), (at_mount, end))
        for y0, y1 in ((-r, r), (r + b, 2.0 * r + b), (-2.0 * r - b, -r - b))
    ]
    rest = [_straight(made, side) for side in (1.0, -1.0)]
    turned = f"{math.degrees(angle):.4g} deg"
    return View(
        title=f"unit at its {words}, at rest and turned by {turned}",
        shapes=(
            Shape(np.array([[-_BEYOND - r, 0.0], [max(here, R) + _BEYOND, 0.0]]), "axis"),
            Shape(np.array([[0.0, -_BEYOND - r], [0.0, r + _BEYOND]]), "axis"),
            *(Shape(block, "mate") for block in blocks),
            *(Shape(outline, "part") for outline in rest),
            *(Shape(outline, "mate") for outline in _lever(made, 0.0)),
            Shape(_bent(made, length, angle), "moved"),
            *(Shape(outline, "moved") for outline in _lever(made, angle)),
        ),
        dimensions=(
            Dimension("arm of the lever", "linear", (0.0, 0.0), (R, 0.0)),
            Dimension("roller", "diameter", (R, 0.0), (R, -r)),
            Dimension("effective length", "linear", (R, r), (here, r)),
            Dimension("guide", "linear", (here, 2.0 * r + b), (far, 2.0 * r + b)),
            Dimension("between the leaves", "linear", (here, -r), (here, r)),
            *_travel(made, length),
        ),
    )


def _travel(made: MadeLeaves, length: float) -> Iterator[Dimension]:
    """Of the guide to the mount, which it touches at the longest effective length."""
    plan = made.planform
    reached, most = (_along(made, at + plan.guide) for at in (length, plan.longest))
    if reached != most:
        y = -2.0 * made.setup.lever.roller_radius - made.setup.leaf.thickness
        yield Dimension("travel of the guide", "linear", (reached, y), (most, y))


def _along(made: MadeLeaves, distance: float) -> float:
    """x of the place at a distance from the roller at rest, towards the mount."""
    lever = made.setup.lever
    return lever.radius + (distance if lever.clamp == "outboard" else -distance)


def _block(x: tuple[float, float], y: tuple[float, float]) -> Outline:
    return rounded_rectangle(min(x), y[0], max(x), y[1], 0.0)


def _straight(made: MadeLeaves, side: float) -> Outline:
    """A leaf at rest, above (1) or below (-1) the roller."""
    plan, b = made.planform, made.setup.leaf.thickness
    middle = side * (made.setup.lever.roller_radius + 0.5 * b)
    x = _along(made, -plan.overhang), _along(made, plan.length - plan.overhang)
    return _block(x, (middle - 0.5 * b, middle + 0.5 * b))


def _bent(made: MadeLeaves, length: float, angle: float) -> Floats:
    """Closed path round the bent leaf (M, 2)."""
    plan, leaf, lever = made.planform, made.setup.leaf, made.setup.lever
    stations = np.linspace(0.0, length + plan.overhang, _STATIONS)
    line = bent_line(leaf, lever, length, angle, stations)
    held = [[_along(made, plan.length - plan.overhang), line[0, 1]]]
    line = np.concatenate([held, line])
    along = np.gradient(line, axis=0)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    half = 0.5 * leaf.thickness * across / np.hypot(*across.T)[:, None]
    path = np.concatenate([line + half, (line - half)[::-1]])
    return np.concatenate([path, path[:1]])


def _lever(made: MadeLeaves, angle: float) -> tuple[Outline | Circle, ...]:
    """Lever and roller, turned about the pivot."""
    lever = made.setup.lever
    r = lever.roller_radius
    half = _LEVER * r
    center = rotated(np.array([[lever.radius, 0.0]]), np.array([angle]))[0]
    corners = np.array([[0.0, -half], [lever.radius, -half], [lever.radius, half], [0.0, half]])
    a, b, c, d = ((float(x), float(y)) for x, y in rotated(corners, np.full(len(corners), angle)))
    at = (float(center[0]), float(center[1]))
    arm = Outline(
        (
            Line(a, b),
            Arc(at, half, angle - 0.5 * math.pi, math.pi),
            Line(c, d),
            Arc((0.0, 0.0), half, angle + 0.5 * math.pi, math.pi),
        )
    )
    return arm, Circle(at, r)


def _workspace(made: MadeLeaves) -> View:
    """The rod's tip seen along the rod at rest, at the strokes' lengths."""
    rod = made.spec.wrist.rod_length
    limits = made.strokes.angle[:, -1]
    edges = [workspace_boundary(angle, angle, rod)[:, :2] for angle in limits]
    most = float(np.max(edges[-1]))
    cross = most + _BEYOND
    return View(
        title="reach of the rod's tip, seen along the rod, at lengths from shortest to longest",
        shapes=(
            Shape(np.array([[-cross, 0.0], [cross, 0.0]]), "axis"),
            Shape(np.array([[0.0, -cross], [0.0, cross]]), "axis"),
            *(Shape(edge, "moved") for edge in edges[:-1]),
            Shape(edges[-1], "limit"),
        ),
        dimensions=(
            Dimension("one axis turned", "linear", (0.0, 0.0), (rod * math.sin(limits[-1]), 0.0)),
        ),
    )
