"""The mechanism at some pivot positions: at rest and at the end of its stroke."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Circle, Contour, Profile
from springcad.geometry.transform import translate
from springcad.kinds.lever_arm.made import MadeJoint
from springcad.kinds.lever_arm.mechanism import Lever, boundary, loads
from springcad.result import Dimension, Shape, View

Floats = NDArray[np.float64]

_PIN = 2e-3
"""Radius of the circles that stand for pins and pivot."""


def mechanism_views(made: MadeJoint, pivots: Floats) -> tuple[View, ...]:
    """One view for each pivot position (P,); the frame is that of ``mechanism``."""
    return tuple(_view(made, float(pivot)) for pivot in pivots)


def _view(made: MadeJoint, pivot: float) -> View:
    lever, law = made.case.lever, made.spring.law
    end = boundary(lever, law, np.array([pivot]))
    angle, deflection = float(end.crank_angle[0]), float(end.deflection[0])
    tilt = float(loads(lever, pivot, angle, 0.0).tilt)
    return View(
        title=f"Pivot at {1e3 * pivot:.4g} mm: at rest, and the output turned by "
        f"{np.degrees(float(end.angle[0])):.4g} deg",
        shapes=(
            *_spring(made, deflection),
            *_linkage(lever, angle, deflection),
            Shape(Circle((0.0, pivot), _PIN), "limit"),
        ),
        dimensions=(
            Dimension("q", "linear", (0.0, 0.0), (0.0, pivot)),
            Dimension("l", "linear", (0.0, 0.0), (0.0, lever.length)),
            Dimension(
                f"spring, lever tilted by {np.degrees(tilt):.4g} deg", "linear",
                (0.0, lever.length), (deflection, lever.length),
            ),
        ),
    )  # fmt: skip


def _spring(made: MadeJoint, deflection: float) -> list[Shape]:
    """The part at rest, if it lies in the plane of the mechanism, and its centre line bent."""
    lever, spring = made.case.lever, made.spring
    at = np.array([0.0, lever.length])
    shapes = []
    if made.case.shape != "triangular":
        shapes.append(Shape(translate(spring.profile, *at), "part"))
        shapes += [Shape(_moved(shape.line, at), shape.role) for shape in spring.surroundings]
    elif spring.shapes:
        shapes += [Shape(line + at, "part") for line in spring.shapes[1]]
    if np.isclose(deflection, spring.deflection[-1]):
        shapes += [Shape(line + at, "moved") for line in spring.shapes[-1]]
    return shapes


def _moved(line: Contour | Profile | Floats, at: Floats) -> Contour | Profile | Floats:
    return line + at if isinstance(line, np.ndarray) else translate(line, *at)


def _linkage(lever: Lever, angle: float, deflection: float) -> list[Shape]:
    """Lever, pins and crank at rest and turned; the guide of the spring's pin."""
    side = {"yoke": -1.0, "crank-behind": -1.0, "crank-ahead": 1.0}[lever.output]
    axis = np.array([0.0, side * lever.crank_radius])
    turned = np.array([-np.sin(angle), -side * np.cos(angle)])
    pin = axis + lever.crank_radius * turned
    held = np.array([pin[0], 0.0]) if lever.output == "yoke" else pin
    reach = 1.2 * abs(deflection)
    guide = np.array([[-reach, lever.length], [reach, lever.length]])
    shapes = [
        Shape(np.array([[0.0, 0.0], [0.0, lever.length]]), "mate"),
        Shape(np.array([held, [deflection, lever.length]]), "moved"),
        Shape(np.array([axis, [0.0, 0.0]]), "mate"),
        Shape(np.array([axis, pin]), "moved"),
        Shape(guide, "axis"),
        Shape(Circle((float(axis[0]), float(axis[1])), _PIN), "mate"),
        Shape(Circle((0.0, 0.0), _PIN), "mate"),
        Shape(Circle((float(held[0]), float(held[1])), _PIN), "moved"),
    ]
    if lever.output == "yoke":
        shapes.append(Shape(np.array([[-reach, 0.0], [reach, 0.0]]), "axis"))
        shapes.append(Shape(np.array([pin, held]), "axis"))
    return shapes
