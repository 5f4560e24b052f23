"""Where the tip of the cantilever goes under a force at a given point of space.

The contact part is rigid here and moves with the tip. Where the roller presses, and in which
direction, is known in space before the cantilever is: so the bending moment is known at the clamp
too, and even large deflections are an initial value problem from there, without shooting.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.roller_cam.joint import Cantilever
from springcad.mechanics.beam import PreparedBeam, RibbonBeam, follower_load, prepare
from springcad.mechanics.plane import rotated
from springcad.mechanics.section import area, nominal_bending_stress

Floats = NDArray[np.float64]

_NODES = 7
_LARGEST_LOAD = 2.0
"""No state beyond this force, times its distance from the clamp, over E I/l (1)."""
_MAX_ITERATIONS = 100
_TURNED = 1e-15
"""Change of the rotation at which its iteration stops (rad)."""


@dataclass(frozen=True)
class TipState:
    """The cantilever under A forces.

    Attributes:
        displacement: of the tip (A, 2) [m].
        rotation: of the section at the tip (A,) [rad].
        energy: elastic (A,) [J].
        stress: on the edge at the clamp, |M| h/(2 I) + |N|/(w h), without notch (A,) [Pa].
    """

    displacement: Floats
    rotation: Floats
    energy: Floats
    stress: Floats


TipModel = Callable[[Floats, Floats], TipState]
"""The tip under forces (A, 2) [N] at points (A, 2) [m] of space."""


def linear_tip(cantilever: Cantilever) -> TipModel:
    """Bending with small rotations (001, Eqs 1 and 2), but the moment about the deflected tip.

    The clamp turns by its moment times ``root_compliance``.

    Paper 001 takes y for the lever y − v of the axial force. Then the forces have no potential,
    and torque and energy disagree.
    """
    span, bending = cantilever.length, cantilever.bending_stiffness
    root = bending * cantilever.root_compliance

    def tip(point: Floats, force: Floats) -> TipState:
        (x, y), (pull, push) = point.T, (force[:, 0], -force[:, 1])
        by_moment = span**2 / 2.0 + root * span
        v = -(push * (span**3 / 3.0 + root * span**2) + (push * x + pull * y) * by_moment)
        v = v / (bending - pull * by_moment)
        return _linear_state(cantilever, force, push * x + pull * (y - v), v)

    return tip


def printed_tip(cantilever: Cantilever) -> TipModel:
    """The same between plates, the moment about the tip at rest, as paper 001 prints its Eq. 1."""
    cantilever = replace(cantilever, pocket_fillet=None)
    span, bending = cantilever.length, cantilever.bending_stiffness

    def tip(point: Floats, force: Floats) -> TipState:
        (x, y), (pull, push) = point.T, (force[:, 0], -force[:, 1])
        moment = push * x + pull * y
        v = -(push * span**3 / 3.0 + moment * span**2 / 2.0) / bending
        return _linear_state(cantilever, force, moment, v)

    return tip


def _linear_state(cantilever: Cantilever, force: Floats, moment: Floats, v: Floats) -> TipState:
    """The state under the clockwise ``moment`` at the tip, which moves by v."""
    span, bending, push = cantilever.length, cantilever.bending_stiffness, -force[:, 1]
    root, at_clamp = bending * cantilever.root_compliance, push * span + moment
    energy = push**2 * span**3 / 3.0 + push * moment * span**2 + moment**2 * span
    energy = energy + root * at_clamp**2
    return TipState(
        displacement=np.stack([np.zeros_like(v), v], axis=-1),
        rotation=-(push * span**2 / 2.0 + moment * span + root * at_clamp) / bending,
        energy=energy / (2.0 * bending),
        stress=_edge_stress(cantilever, at_clamp, force[:, 0]),
    )


def exact_tip(cantilever: Cantilever) -> TipModel:
    """Geometrically exact beam with bending, stretch and shear (``springcad.mechanics.beam``).

    Seen from the tip, the clamp is the section whose load is known: the reaction of the wall. A
    load too large for any spring gives nan.
    """
    beam = straight_beam(cantilever, root_angle=np.pi)
    clamp = np.array([-cantilever.length, 0.0])
    largest = _LARGEST_LOAD * cantilever.bending_stiffness / cantilever.length

    def tip(point: Floats, force: Floats) -> TipState:
        lever = point - clamp
        within = np.hypot(*force.T) * np.hypot(*lever.T) < largest
        pull, push = np.where(within, force.T, 0.0)
        moment = lever[:, 0] * push - lever[:, 1] * pull
        # The clamp turns as a whole, and the cantilever with it.
        root_turn = cantilever.root_compliance * moment
        axial, transverse = rotated(np.stack([pull, push], axis=-1), -root_turn).T
        states = follower_load(beam, cantilever.length, axial, transverse, -moment)
        rotation = np.where(within, root_turn + np.pi - states.end_rotation, np.nan)
        # In the frame of the tip the clamp lies at ``end_position``.
        return TipState(
            displacement=clamp - rotated(states.end_position, rotation),
            rotation=rotation,
            energy=np.where(within, states.energy + 0.5 * root_turn * moment, np.nan),
            stress=_edge_stress(cantilever, moment, axial),
        )

    return tip


def straight_beam(
    cantilever: Cantilever, *, root_angle: float, root_compliance: float = 0.0
) -> PreparedBeam:
    """The cantilever as a ribbon of one panel; its error is far below that of rounding."""
    return prepare(
        RibbonBeam(
            np.array([0.0, cantilever.length]),
            np.zeros_like,
            lambda s: np.full_like(s, 0.5 * cantilever.height),
            root_angle=root_angle,
            thickness=cantilever.width,
            elastic_modulus=cantilever.elastic_modulus,
            shear_modulus=cantilever.shear_modulus,
            root_compliance=root_compliance,
            nodes_per_panel=_NODES,
        )
    )


def rooted_beam(cantilever: Cantilever) -> PreparedBeam:
    """The cantilever from its clamp, which turns by its compliance, along x."""
    return straight_beam(cantilever, root_angle=0.0, root_compliance=cantilever.root_compliance)


def carried(cantilever: Cantilever) -> TipModel:
    """The exact cantilever where points and forces are given in the frame of its tip.

    Integrated from the tip back to the clamp: all it shares with ``exact_tip`` is the equations.
    """
    beam = rooted_beam(cantilever)
    tip_at_rest = np.array([cantilever.length, 0.0])

    def tip(point: Floats, force: Floats) -> TipState:
        moment = point[:, 0] * force[:, 1] - point[:, 1] * force[:, 0]
        states = follower_load(beam, cantilever.length, force[:, 0], force[:, 1], moment)
        return TipState(
            displacement=states.end_position - tip_at_rest,
            rotation=states.end_rotation,
            energy=states.energy,
            stress=_edge_stress(cantilever, states.root_moment, states.axial_force[:, 0]),
        )

    return tip


def linear_carried(cantilever: Cantilever) -> TipModel:
    """The linear cantilever (``linear_tip``) where all is given in the frame of its tip."""
    in_space = linear_tip(cantilever)

    def tip(point: Floats, force: Floats) -> TipState:
        state = in_space(point, force)
        for _ in range(_MAX_ITERATIONS):
            turn = state.rotation
            at = rotated(point, turn) + state.displacement
            state = in_space(at, rotated(force, turn))
            if np.max(np.abs(state.rotation - turn), initial=0.0) < _TURNED:
                return state
        raise ArithmeticError("the tip did not come to rest: the load is far beyond its strength")

    return tip


def _edge_stress(cantilever: Cantilever, moment: Floats, tension: Floats) -> Floats:
    width, half = cantilever.width, 0.5 * cantilever.height
    return nominal_bending_stress(width, half, moment) + np.abs(tension) / area(width, half)
