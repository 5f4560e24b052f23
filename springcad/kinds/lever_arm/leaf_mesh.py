"""Finite elements of an omega leaf: each half for itself, between its clamp and the rigid hub.

The section at the hub is moved as a rigid body, by u and a turn about the hub's moved middle; the
section at the wall is held. The left half is the right one moved to -u and turned the other way.
The turn is that at which the moments of both halves on the hub cancel.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.omega import OmegaCase, OmegaLeaf, half_ribbon, half_start
from springcad.mechanics.fem.assembly import Sheet, prepare_solid
from springcad.mechanics.fem.blocks import Side, join, spaced, with_middles
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.element import edge_shape_functions
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, Model, State, prepare_model
from springcad.mechanics.fem.newton import solve_path

Floats = NDArray[np.float64]

ACROSS = 4
"""Elements over the thickness."""
LONGEST = 1.0
"""Length of an element over the thickness there."""
LONGEST_SHARE = 1.0 / 40.0
"""Longest element over the length of the half."""
STEPS = 4
TURNS = 3
"""Turns of the hub at which a half is solved; the moments are nearly linear in it."""
_FIRST_TURN = 0.02  # rad, between the first two of them
EDGE_SETS: dict[str, tuple[tuple[str, Side], ...]] = {
    "right": (("half", "south"),),
    "clamp": (("half", "east"),),
    "left": (("half", "north"),),
    "hub": (("half", "west"),),
}
"""``right`` runs from the hub to the clamp, ``left`` back."""


@dataclass(frozen=True)
class LeafElements:
    """One half in its place; ``stations`` (K,) are those of the nodes along its sides, m."""

    model: Model
    stations: Floats
    middle: Floats


@dataclass(frozen=True)
class LeafJudgement:
    """The whole spring with the hub at ``displacement``, by finite elements.

    Attributes:
        displacement: m.
        force: that the lever exerts along x, N.
        rotation: of the hub, rad.
        stations: of the places where stresses are told, on either side of a half (M,), m.
        right_stress, left_stress: of the right and of the left half, the larger of both sides'
            magnitudes (M,), Pa.
    """

    displacement: float
    force: float
    rotation: float
    stations: Floats
    right_stress: Floats
    left_stress: Floats


def half_mesh(leaf: OmegaLeaf, across: int = ACROSS) -> tuple[Mesh, Floats]:
    """Mesh of the right half in the enclosure's frame, and the stations of its nodes' rows."""
    ribbon = half_ribbon(leaf)
    dense = np.linspace(0.0, leaf.length, 2000)
    thickness = 2.0 * ribbon.at(dense).half_thickness
    sizes = np.minimum(LONGEST * thickness, LONGEST_SHARE * leaf.length)
    stations = with_middles(spaced(dense, sizes))
    at = ribbon.at(stations)
    centre = np.column_stack([at.x, at.y]) + half_start(leaf)
    normal = np.column_stack([-np.sin(at.angle), np.cos(at.angle)])
    offset = np.linspace(-1.0, 1.0, 2 * across + 1)
    away = (at.half_thickness[:, None] * offset)[..., None]
    block = centre[:, None] + away * normal[:, None]
    return join({"half": block}, EDGE_SETS), stations


def leaf_elements(
    leaf: OmegaLeaf, case: OmegaCase, width: float, across: int = ACROSS
) -> LeafElements:
    """The right half of the given width, its clamp held and its hub section moved."""
    mesh, stations = half_mesh(leaf, across)
    sheet = Sheet(case.elastic_modulus, case.poisson_ratio, width)
    held = [prescribe(mesh.node_sets[name]) for name in ("clamp", "hub")]
    constraints = solve_constraints(mesh.unknowns, *held)
    model = prepare_model(prepare_solid(mesh, sheet), constraints)
    return LeafElements(model, stations, np.array([0.0, leaf.middle]))


def judge_leaf_at(elements: LeafElements, displacement: float) -> LeafJudgement:
    """Force, turn of the hub and stress at a displacement of the hub.

    Raises:
        NoEquilibriumError: the elements find no equilibrium.
    """
    turn, earlier = 0.0, None
    states = _path(elements, displacement, turn, None)
    for count in range(1, TURNS):
        excess = _excess(elements, states, displacement)
        if count == 1 or earlier is None:
            step = _FIRST_TURN
        else:
            step = -excess * (turn - earlier[0]) / (excess - earlier[1])
        earlier, turn = (turn, excess), turn + step
        states = _path(elements, displacement, turn, states)
    right, left = states
    force = _hub_force(elements, right)[0] - _hub_force(elements, left)[0]
    stations, right_stress = _stress(elements, right)
    return LeafJudgement(
        displacement, force, turn, stations, right_stress, _stress(elements, left)[1]
    )


def _path(
    elements: LeafElements, u: float, turn: float, start: tuple[State, State] | None
) -> tuple[State, State]:
    """The right half at (u, turn) and at (-u, -turn)."""
    shares = np.arange(1, STEPS + 1) / STEPS if start is None else [1.0]
    found = []
    for k, side in enumerate((1.0, -1.0)):
        loads = [_load(elements, side * share * u, side * share * turn) for share in shares]
        begin = None if start is None else start[k]
        found.append(solve_path(elements.model, loads, start=begin)[-1])
    return found[0], found[1]


def _load(elements: LeafElements, u: float, turn: float) -> Load:
    """The hub's section moved rigidly."""
    mesh = elements.model.solid.mesh
    nodes = mesh.node_sets["hub"]
    arm = mesh.nodes[nodes] - elements.middle
    cos, sin = np.cos(turn), np.sin(turn)
    moved = arm @ np.array([[cos, sin], [-sin, cos]]) - arm + [u, 0.0]
    prescribed = np.zeros((len(mesh.nodes), 2))
    prescribed[nodes] = moved
    return Load(np.zeros(mesh.unknowns), prescribed.ravel())


def _hub_force(elements: LeafElements, state: State) -> Floats:
    """Force of the hub on the half (2,), N."""
    nodes = elements.model.solid.mesh.node_sets["hub"]
    return np.asarray(state.reaction.reshape(-1, 2)[nodes].sum(axis=0))


def _excess(elements: LeafElements, states: tuple[State, State], u: float) -> float:
    """Moment of the hub on the right half less that on the left one's mirror image, N m."""
    mesh = elements.model.solid.mesh
    nodes = mesh.node_sets["hub"]
    moments = []
    for side, state in zip((1.0, -1.0), states, strict=True):
        force = state.reaction.reshape(-1, 2)[nodes]
        place = mesh.nodes[nodes] + state.displacement.reshape(-1, 2)[nodes]
        arm = place - elements.middle - [side * u, 0.0]
        moments.append(float(np.sum(arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0])))
    return moments[0] - moments[1]


def _stress(elements: LeafElements, state: State) -> tuple[Floats, Floats]:
    """Stations and the larger stress of both sides there, m and Pa.

    E times the elongation of the side, the law of the beam. The Cauchy stress of the elements'
    law lies above it on the side in tension and below on the other by twice the strain, which in
    a polymer is several per cent.
    """
    right = _elongation(elements, state, "right")
    left = _elongation(elements, state, "left")[::-1]
    begin, end = elements.stations[:-1:2], elements.stations[2::2]
    share = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)
    stations = (begin[:, None] + (end - begin)[:, None] * share).ravel()
    modulus = elements.model.solid.sheet.elastic_modulus
    return stations, modulus * np.maximum(np.abs(right), np.abs(left))


def _elongation(elements: LeafElements, state: State, side: str) -> Floats:
    """At two points of each element's edge, where its slope is most accurate."""
    mesh = elements.model.solid.mesh
    numbers = mesh.edge_sets[side]
    slope = edge_shape_functions(np.array([-1.0, 1.0]) / np.sqrt(3.0))[1]
    before = slope @ mesh.nodes[numbers]
    after = before + slope @ state.displacement.reshape(-1, 2)[numbers]
    lengths = [np.hypot(*np.moveaxis(part, -1, 0)) for part in (before, after)]
    return np.asarray(lengths[1] / lengths[0] - 1.0).ravel()
