"""Where the roller rests on a given profile, and how hard.

A place u on the profile and a normal force F there say, in the frame of the tip, where and how the
cantilever is loaded; it is integrated from the tip to the clamp. Then the roller must touch the
profile at that place:

    X(u, F) = E(β, N(u, F)),

with X the place in space, N its normal and E the point of the tilted roller that has this normal.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.kinds.roller_cam.curve import ProfileCurve
from springcad.kinds.roller_cam.joint import Joint, Roller
from springcad.kinds.roller_cam.tip import TipModel, TipState
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]
PlaceCompliance = Callable[[Floats], Floats]
"""Of the contact part against the tip (A, 2, 2) [m/N] over the place on the profile (A,) [m]."""

_ENDS = 0.075
"""Length of the profile's straight ends that is looked at, over the radius of the roller."""
_SCAN = (8, 48, 9)
"""Places that are looked at on the upper end, the curve and the lower end."""
_TOLERANCE = 1e-11
"""Of an iteration's change, over the scales of the unknowns."""
_TOUCH = 1e-12
"""Gap (m) after which one more step is the last: profiles may have kinks in their curvature."""
_MAX_ITERATIONS = 30
_LONGEST = 0.3
"""Longest change of an iteration, over the scales of the unknowns."""
_DIFFERENCES = (1e-9, 1e-6)
"""Least and largest step of a difference, over the scales."""
_TURNS = 4
_STEP = 1e-4
"""Share of the profile over which the compliance is differentiated."""
_NO_FORCE = 1e-9
"""Share of the scan's largest force below which a contact is none."""


@dataclass(frozen=True)
class Contacts:
    """Loaded places in space, each (L,) or (L, 2)."""

    point: Floats
    normal: Floats
    force: Floats
    energy: Floats
    tip: TipState


Loading = Callable[[Floats, Floats], Contacts]


def seat_roller(
    joint: Joint, curve: ProfileCurve, loaded: Loading, angle: Floats
) -> tuple[NDArray[np.bool_], Floats, Contacts]:
    """Whether the roller rests on the profile at angles (A,), and there the places and contacts.

    All along the profile the force and the angle at which the roller touches are found first, from
    nothing; they are where Newton's method begins at the wanted angles.

    Raises:
        InfeasibleError: the roller leaves the end of the profile before the last angle, or no
            single place is found where it touches.
    """
    place, force, reached = _scan(joint, curve, loaded)
    if angle.max() > reached[-1]:
        claim = "angle up to which the roller rests on the profile"
        raise InfeasibleError(claim, float(reached[-1]), float(angle.max()), "rad")
    clear = _last_clear(reached, force)
    at = np.maximum(angle, clear)
    start = np.stack([np.interp(at, reached, place), np.interp(at, reached, force)])

    def gap(unknown: Floats, rows: NDArray[np.intp]) -> Floats:
        return _gap(joint.roller, at[rows], loaded(*unknown))

    found, done = _newton(gap, start, np.array([[curve.length], [force[-1]]]))
    if not done.all():
        lost = float(at[~done][0])
        claim = (
            f"contact of the roller found at {np.degrees(lost):.4g} deg; profile and roller are "
            "nearly as round as each other"
        )
        raise InfeasibleError(claim, 0.0, 1.0, "1", ("raise joint.drum_radius",))
    return np.asarray((found[1] > 0.0) & (angle > clear)), found[0], loaded(*found)


def loading(
    curve: ProfileCurve,
    tip: TipModel,
    friction: float,
    compliance: PlaceCompliance | None,
    offset: float,
) -> Loading:
    """The profile in space, loaded by normal forces (L,) at places (L,)."""

    def loaded(place: Floats, force: Floats) -> Contacts:
        normal, turn = curve.normals(place), np.zeros_like(place)
        point = curve.points(place) - offset * normal
        if compliance is not None:
            step = _STEP * curve.length
            growth = (compliance(place + step) - compliance(place - step)) / (2.0 * step)
            turn = _surface_turn(force, normal, growth)
        normal = rotated(normal, turn)
        tangent = np.stack([normal[:, 1], -normal[:, 0]], axis=-1)
        pressed = force[:, None] * (normal - friction * tangent)
        yielding = np.zeros_like(pressed)
        if compliance is not None:
            yielding = np.einsum("aij,aj->ai", compliance(place), pressed)
        state = tip(point + yielding, pressed)
        return Contacts(
            point=rotated(point + yielding, state.rotation) + state.displacement,
            normal=rotated(normal, state.rotation),
            force=rotated(pressed, state.rotation),
            energy=state.energy + 0.5 * np.einsum("ai,ai->a", pressed, yielding),
            tip=state,
        )

    return loaded


def _surface_turn(force: Floats, normal: Floats, growth: Floats) -> Floats:
    """Rotation (L,) of the surface under its own load.

    The load sits where the compliance C grows by C′ per place; by Maxwell's reciprocity the slope
    of its own field of displacement is half of that: sin turn = F nᵀ C′ n/2, n the turned normal.
    """
    turn = np.zeros_like(force)
    for _ in range(_TURNS):
        turned = rotated(normal, turn)
        sine = 0.5 * force * np.einsum("ai,aij,aj->a", turned, growth, turned)
        turn = np.arcsin(np.clip(sine, -1.0, 1.0))
    return turn


def _gap(roller: Roller, angle: Floats, contacts: Contacts) -> Floats:
    """From the roller's point with the contact's normal to the contact (2, L)."""
    half = roller.radius * np.stack([np.ones_like(angle), np.cos(angle)])
    normal = contacts.normal.T
    support = half**2 * normal / np.hypot(*(half * normal))
    sunk = roller.offset - roller.drum_radius * np.sin(angle)
    centre = np.stack([np.full_like(angle, roller.start), sunk])
    return np.asarray(contacts.point.T - centre - support)


def _scan(joint: Joint, curve: ProfileCurve, loaded: Loading) -> Floats:
    """Places along the profile, the force and the angle with which the roller touches them (3, S).

    By angle, ascending. A place above the first contact is touched only by a pull: its force is
    negative. Places even along the profile lead to places even over the angle.
    """
    upper, middle, lower = _SCAN
    ends = _ENDS * joint.roller.radius
    place = np.concatenate(
        [
            np.linspace(-ends, 0.0, upper, endpoint=False),
            np.linspace(0.0, curve.length, middle, endpoint=False),
            np.linspace(curve.length, curve.length + ends, lower),
        ]
    )
    free = loaded(place, np.zeros_like(place))
    radius, drum = joint.roller.radius, joint.roller.drum_radius
    sunk = joint.roller.offset - free.point[:, 1] + radius * free.normal[:, 1]
    first = _touched(joint, loaded, np.stack([place, np.zeros_like(place), sunk / drum]))
    angle = np.linspace(first[2, 0], first[2, -1], sum(_SCAN))
    even = [np.interp(angle, first[2], row) for row in first[:2]]
    return _touched(joint, loaded, np.stack([*even, angle]))


def _touched(joint: Joint, loaded: Loading, start: Floats) -> Floats:
    """Places, forces and angles (3, S) that belong together, from guesses of forces and angles."""
    place = start[0]
    scale = np.array([[joint.cantilever.tip_stiffness * joint.roller.radius], [0.1]])

    def gap(unknown: Floats, rows: NDArray[np.intp]) -> Floats:
        return _gap(joint.roller, unknown[1], loaded(place[rows], unknown[0]))

    found, done = _newton(gap, start[1:], scale)
    if not done.any():
        raise ArithmeticError("the roller rests nowhere on the profile")
    whole = np.stack([place, *found])[:, done]
    return np.asarray(whole[:, np.argsort(whole[2])])


def _last_clear(angle: Floats, force: Floats) -> float:
    """The last angle of a scan before the force begins; minus infinity if it presses all along."""
    first = int(np.argmax(force > _NO_FORCE * force.max()))
    return float(angle[first - 1]) if first else -np.inf


Gap = Callable[[Floats, NDArray[np.intp]], Floats]


def _newton(gap: Gap, start: Floats, scale: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """Zeros (2, L) of gaps (2, L) that depend on two unknowns each; and which were found.

    ``gap`` takes unknowns (2, K) and their rows among the L.
    """
    unknown, found = start.copy(), np.zeros(start.shape[1], dtype=np.bool_)
    rows, change = np.arange(start.shape[1]), np.ones_like(start)
    last = np.full(start.shape[1], np.inf)
    for _ in range(_MAX_ITERATIONS):
        here = unknown[:, rows]
        value = gap(here, rows)
        size = np.hypot(*value)
        # Differences look ahead, ever less far: where the profile's curvature jumps the slopes do.
        steps = np.clip(np.abs(change), *_DIFFERENCES) * np.where(change < 0.0, -1.0, 1.0)
        slopes = []
        for i in range(2):
            beside = here.copy()
            beside[i] += steps[i] * scale[i]
            slopes.append((gap(beside, rows) - value) / steps[i])
        change = np.linalg.solve(np.stack(slopes, axis=-1).transpose(1, 0, 2), -value.T[..., None])
        change = np.clip(change[..., 0].T, -_LONGEST, _LONGEST)
        # Where the curvature jumps, whole steps may go to and fro across the jump.
        change = np.where(size > last, 0.5, 1.0) * change
        unknown[:, rows] += change * scale
        close = (np.abs(change).max(axis=0) < _TOLERANCE) | (size < _TOUCH)
        found[rows[close]] = True
        rows, change, last = rows[~close], change[:, ~close], size[~close]
        if not len(rows):
            break
    return unknown, found
