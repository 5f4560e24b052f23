"""Finite elements of a straight leaf in its plane of bending, from the pin to the clamp.

One block of elements between the leaf's two sides. The eye is filled and ends at the pin, where no
moment acts. At the clamp the fillet's last 25 deg, a sliver along the face, is left out. A leaf
that bends in its sheet is drawn as it is; of a triangular leaf this is the side view, a strip as
thick as the sheet whose elements are as wide as the triangle is there.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.straight import StraightLeaf, half_seen, joints
from springcad.kinds.lever_arm.straight_beam import Elastic
from springcad.mechanics.fem.assembly import Sheet, Solid, prepare_solid
from springcad.mechanics.fem.blocks import (
    Side,
    join,
    spaced,
    straight,
    transfinite,
    with_middles,
)
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.element import gauss_points, shape_functions
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, Model, State, prepare_model
from springcad.mechanics.fem.newton import solve_path
from springcad.mechanics.fem.recovery import edge_stress

Floats = NDArray[np.float64]

ACROSS = 6
"""Elements over the thickness; even, so that a node lies at the pin."""
EDGE_SETS: dict[str, tuple[tuple[str, Side], ...]] = {
    "lower": (("leaf", "south"),),
    "clamp": (("leaf", "east"),),
    "upper": (("leaf", "north"),),
    "pin": (("leaf", "west"),),
}
"""``lower`` runs from the pin to the clamp, ``upper`` back."""
_LAST = math.radians(65.0)
"""Angle to which the fillet at the clamp is meshed."""
_PER_FILLET = 6
_GROWTH = 0.4
_LONGEST = 0.5
"""Length of an element over half of the leaf's thickness there."""


@dataclass(frozen=True)
class LeafModel:
    """The leaf held at its clamp; made by ``leaf_model``.

    Attributes:
        leaf: one leaf.
        model: its elements.
        pin: number of the node that the lever moves.
        shares: width of the elements over that at the clamp (E,), of a triangle; else None.
    """

    leaf: StraightLeaf
    model: Model
    pin: int
    shares: Floats | None


@dataclass(frozen=True)
class Push:
    """The leaf with its pin moved across by ``deflection`` [m] by ``force`` [N]."""

    deflection: float
    force: float
    state: State


def leaf_mesh(leaf: StraightLeaf) -> Mesh:
    """Mesh with the edge sets, and node sets of the same names, of ``EDGE_SETS``.

    Raises:
        ValueError: an element would be turned inside out.
    """
    x, half = _side(leaf) if leaf.bends_in_sheet else _strip(leaf)
    upper, lower = np.column_stack([x, half]), np.column_stack([x, -half])
    across = with_middles(np.linspace(0.0, 1.0, ACROSS + 1))
    ends = [straight(lower[i], upper[i], across) for i in (0, -1)]
    block = transfinite(lower, upper, *ends)
    return join({"leaf": block}, EDGE_SETS)


def _side(leaf: StraightLeaf) -> tuple[Floats, Floats]:
    """Half thickness over x of a leaf that bends in its sheet, at the nodes of its side."""
    size, plan = leaf.fittings, leaf.plan
    radius, (cx, cy) = size.root_fillet, plan.root_center
    last = cx + radius * math.sin(_LAST)
    dense = np.linspace(0.0, last, 4000)
    fine = 0.25 * math.pi / _PER_FILLET
    eye, end = joints(leaf)[1], plan.end
    sizes = np.minimum.reduce(
        [
            _LONGEST * half_seen(leaf, dense),
            fine * radius + _GROWTH * np.maximum(end - dense, 0.0),
            2.0 * fine * size.eye_fillet + _GROWTH * np.maximum(dense - plan.start, eye - dense),
        ]
    )
    x = with_middles(spaced(dense, np.maximum(sizes, 1e-2 * radius)))
    root = cy - np.sqrt(np.maximum(radius**2 - (x - cx) ** 2, 0.0))
    half = np.where(x < cx, half_seen(leaf, x), root)
    to_face = 0.5 * (leaf.length - last) * np.array([1.0, 2.0])
    return np.append(x, last + to_face), np.append(half, [half[-1]] * 2)


def _strip(leaf: StraightLeaf) -> tuple[Floats, Floats]:
    """Half of the sheet's thickness over x."""
    count = math.ceil(leaf.length / (_LONGEST * leaf.thickness))
    x = with_middles(np.linspace(0.0, leaf.length, count + 1))
    return x, np.full_like(x, 0.5 * leaf.thickness)


def leaf_model(leaf: StraightLeaf, material: Elastic) -> LeafModel:
    """Clamped at its face; the pin's node is led across and free along the leaf."""
    mesh = leaf_mesh(leaf)
    sheet = Sheet(material.elastic_modulus, material.poisson_ratio, leaf.width)
    solid = prepare_solid(mesh, sheet)
    shares = None
    if not leaf.bends_in_sheet:
        plain, solid = solid, _as_wide_as(solid, leaf)
        shares = solid.weights.sum(axis=1) / plain.weights.sum(axis=1)
    pin = mesh.node_sets["pin"][ACROSS]
    held = solve_constraints(
        mesh.unknowns,
        prescribe(mesh.node_sets["clamp"]),
        prescribe(pin, components=(1,)),
    )
    return LeafModel(leaf, prepare_model(solid, held), int(pin), shares)


def _as_wide_as(solid: Solid, leaf: StraightLeaf) -> Solid:
    """Elements of a strip as wide as the triangle is drawn, in place of its width at the clamp."""
    places = solid.mesh.nodes[solid.mesh.elements, 0] @ shape_functions(gauss_points()[0])[0].T
    width = 2.0 * half_seen(leaf, places)
    return replace(solid, weights=solid.weights * width / leaf.width)


def push_through(model: LeafModel, deflections: Sequence[float]) -> list[Push]:
    """The pin at each of the deflections in turn, from rest.

    Raises:
        NoEquilibriumError: the elements find none.
    """
    unknowns, component = model.model.solid.mesh.unknowns, 2 * model.pin + 1
    loads = []
    for deflection in deflections:
        prescribed = np.zeros(unknowns)
        prescribed[component] = deflection
        loads.append(Load(np.zeros(unknowns), prescribed))
    states = solve_path(model.model, loads)
    return [
        Push(deflection, float(state.reaction[component]), state)
        for deflection, state in zip(deflections, states, strict=True)
    ]


def side_stress(model: LeafModel, push: Push) -> tuple[Floats, Floats]:
    """Bending stress at the sides: places from the pin, ascending (K,) [m], and (K,) [Pa].

    The mean of both sides' magnitudes. Where strains are some per cent, as in polymers, the
    tensile side's true stress is above that of the beam by 1.5 times the strain and more, and the
    other side's as much below.
    """
    mesh = model.model.solid.mesh
    lower, upper = _both_sides(model, push)
    place = mesh.nodes[mesh.edge_sets["lower"][:, 1], 0]
    return place, 0.5 * (lower + upper)


def peak_stress(model: LeafModel, push: Push) -> float:
    """Largest on either side, the notch of the root fillet included [Pa]."""
    return float(np.max(_both_sides(model, push)))


def _both_sides(model: LeafModel, push: Push) -> tuple[Floats, Floats]:
    """Magnitudes at the edges of the elements, from the pin to the clamp (K,) each."""
    lower, upper = (
        np.abs(edge_stress(model.model.solid, push.state.displacement, side)).mean(axis=1)
        for side in ("lower", "upper")
    )
    return lower, upper[::-1]
