"""Finite elements of one leaf, in the plane in which it bends, against its roller.

Frame of the lever: the pivot at the origin, x along the lever at rest. The roller is a rigid
profile that turns about the pivot. The leaf is a rectangle of plane stress, its width the
thickness of the sheet; it is held at the face of the guide as a beam is: the section stays plane
and in its place but may grow thinner. Nothing of the beam and its point of contact is in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.leaf_2dof import paper_unit
from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.kinds.leaf_2dof.seating import away
from springcad.mechanics.fem.assembly import Sheet, prepare_solid
from springcad.mechanics.fem.blocks import graded, join, spaced, straight, transfinite, with_middles
from springcad.mechanics.fem.constraints import Constraints, prescribe, solve_constraints
from springcad.mechanics.fem.contact import prepare_contact
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, Model, State, no_load, prepare_model
from springcad.mechanics.fem.newton import NoEquilibriumError, solve_path
from springcad.mechanics.fem.recovery import edge_stress
from springcad.mechanics.fem.rigid_profile import RigidProfile, rigid_profile

Floats = NDArray[np.float64]

_ACROSS = 6  # elements through the thickness, even
_PLAIN, _CLAMP = 1.0, 0.125  # lengths of elements over the thickness
_FINEST, _COARSEST = 0.05, 0.4  # the same at the contact: half of its strip, within these
_GROWTH = 0.4
_MARGIN = 1.5  # of the finely meshed zone beyond the contacts, over the thickness
_SUNK = 5e-4  # how deep the leaf may sink into the roller, over the way of the roller
_CONTACT_POINTS = 6  # per edge
_OUTLINE = 720
_STEPS = 16
"""From rest to the last angle: in each the strip of contact may move by about its own width."""
_SHORTEST = 0.02
"""Step at which the search for an equilibrium is given up, over the first."""


@dataclass(frozen=True)
class LeafContact:
    """A leaf of one effective length and its roller."""

    leaf: Leaf
    lever: Lever
    length: float
    model: Model


@dataclass(frozen=True)
class Press:
    """The leaf with the lever turned to ``angle`` ≥ 0 [rad]."""

    angle: float
    state: State

    @property
    def torque(self) -> float:
        """That holds the lever there [N m]."""
        assert self.state.contact is not None
        return -self.state.contact.torque

    @property
    def force(self) -> float:
        """Between roller and leaf [N]."""
        assert self.state.contact is not None
        return float(np.hypot(*self.state.contact.force))


def leaf_contact(
    leaf: Leaf, lever: Lever, length: float, overhang: float, contacts: Floats, angle: float
) -> LeafContact:
    """Mesh, support and contact.

    Args:
        overhang: of the leaf behind the roller at rest.
        contacts: stations about which the roller is expected; the mesh is fine there.
        angle: the largest, by which the penalty of the contact is chosen.
    """
    sunk = _SUNK * lever.radius * np.sin(angle)
    strip = 2.0 * np.sqrt(2.0 * sunk * lever.roller_radius)
    load = float(paper_unit.force(leaf, lever, length, angle)) / leaf.width
    fine = leaf.thickness * np.clip(0.5 * strip / leaf.thickness, _FINEST, _COARSEST)
    mesh = _mesh(leaf, lever, length, overhang, contacts, fine)
    solid = prepare_solid(mesh, Sheet(leaf.elastic_modulus, leaf.poisson_ratio, leaf.width))
    contact = prepare_contact(
        solid,
        "contact",
        _roller(lever),
        1.5 * load / (sunk * strip),
        points_per_edge=_CONTACT_POINTS,
    )
    return LeafContact(leaf, lever, length, prepare_model(solid, _held(mesh), contact))


def press_through(contact: LeafContact, angles: Sequence[float]) -> list[Press]:
    """Turn the lever to each of ``angles`` (ascending, > 0); as far as it goes.

    The list ends before the first angle for which no equilibrium is found.
    """
    presses: list[Press] = []
    at, state, longest = 0.0, None, angles[-1] / _STEPS
    for angle in angles:
        state = _turn(contact, state, at, angle, longest)
        if state is None:
            break
        presses.append(Press(angle, state))
        at = angle
    return presses


def _turn(
    contact: LeafContact, state: State | None, at: float, angle: float, longest: float
) -> State | None:
    """From a state at one angle to another; None where none is found.

    A leaf that has slipped through the roller is in equilibrium too. It is known by the force,
    which then no longer pushes it the way that the roller goes, and the step is made shorter.
    """
    step = longest
    while at < angle:
        target = min(at + step, angle) if angle - at > 1.01 * step else angle
        try:
            (found,) = solve_path(contact.model, [turned(contact, target)], state)
        except NoEquilibriumError:
            found = None
        if found is not None and found.contact is not None and found.contact.force[1] > 0.0:
            at, state, step = target, found, min(2.0 * step, longest)
        else:
            step *= 0.5
            if step < longest * _SHORTEST:
                return None
    return state


def turned(contact: LeafContact, angle: float) -> Load:
    """The lever at an angle."""
    rest = no_load(contact.model)
    return Load(rest.force, rest.prescribed, angle)


def clamp_stress(contact: LeafContact, press: Press) -> float:
    """Largest stress along a side of the leaf next to the guide, mean of its two sides [Pa].

    At strains of a per cent the law of the elements makes the stretched side stiffer than the
    compressed one, which no small-strain datum of a material tells; the mean is free of it. Sought
    within a quarter of the effective length, so that the pressure of the roller is not in it.
    """
    mesh, largest = contact.model.solid.mesh, []
    for side in ("contact", "back"):
        near = _station(contact.lever, contact.length, mesh.nodes[mesh.edge_sets[side][:, 1], 0])
        stress = edge_stress(contact.model.solid, press.state.displacement, side)
        largest.append(float(np.max(np.abs(stress[near < 0.25 * contact.length]))))
    return 0.5 * sum(largest)


def contact_station(contact: LeafContact, press: Press) -> float:
    """Middle of the contact along the unbent leaf, from the clamp [m]."""
    pair, state = contact.model.contact, press.state.contact
    assert pair is not None
    assert state is not None
    places = np.einsum("ga,ka->kg", pair.shape, pair.reference[..., 0])
    middle = float(np.sum(places * pair.weights * state.pressure))
    middle /= float(np.sum(pair.weights * state.pressure))
    return float(_station(contact.lever, contact.length, np.array(middle)))


def _station(lever: Lever, length: float, x: Floats) -> Floats:
    """Distance from the clamp; the leaf lies along x."""
    return away(lever) * (lever.radius - x) + length


def _mesh(
    leaf: Leaf, lever: Lever, length: float, overhang: float, contacts: Floats, fine: float
) -> Mesh:
    """The leaf with the edge sets ``contact`` and ``back`` and the node set ``clamp``."""
    b, side = leaf.thickness, away(lever)
    dense = np.linspace(0.0, length + overhang, 4000)
    outside = np.maximum(contacts.min() - dense, dense - contacts.max()) - _MARGIN * b
    sizes = np.minimum.reduce(
        [
            np.full_like(dense, _PLAIN * b),
            _CLAMP * b + _GROWTH * dense,
            fine + _GROWTH * np.maximum(outside, 0.0),
        ]
    )
    stations = with_middles(spaced(dense, sizes))
    x = np.sort(lever.radius + side * (length - stations))
    lower, upper = (
        np.column_stack([x, np.full_like(x, y)])
        for y in (lever.roller_radius, lever.roller_radius + b)
    )
    across = graded(_ACROSS)
    block = transfinite(
        lower, upper, straight(lower[0], upper[0], across), straight(lower[-1], upper[-1], across)
    )
    return join(
        {"leaf": block},
        {
            "contact": [("leaf", "south")],
            "back": [("leaf", "north")],
            "clamp": [("leaf", "east" if side > 0.0 else "west")],
        },
    )


def _held(mesh: Mesh) -> Constraints:
    """The clamped section stays plane; its middle stays in place."""
    section = mesh.node_sets["clamp"]
    middle = section[len(section) // 2]
    return solve_constraints(
        mesh.unknowns, prescribe(section, components=(0,)), prescribe(middle, components=(1,))
    )


def _roller(lever: Lever) -> RigidProfile:
    """A circle at the end of the lever, its seam away from the leaf."""
    around = np.linspace(-0.5 * np.pi, 1.5 * np.pi, _OUTLINE + 1)
    out = np.column_stack([np.cos(around), np.sin(around)])
    along = np.column_stack([-np.sin(around), np.cos(around)])
    return rigid_profile(lever.roller_radius * out + np.array([lever.radius, 0.0]), along)
