"""A solid, how it is held and what it touches, ready to be solved; what acts on it, and states."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import Solid
from springcad.mechanics.fem.band import (
    Pattern,
    Scatter,
    components_of,
    number_unknowns,
    scatter,
    scatter_untouched,
    together,
)
from springcad.mechanics.fem.constraints import Constraints
from springcad.mechanics.fem.contact import Contact, ContactState

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Load:
    """What acts at one point of the path.

    Attributes:
        force: dead nodal forces (2 N,) [N].
        prescribed: constants of the constraint equations, at their slaves (2 N,) [m].
        rotation: angle of the rigid profile [rad], counter-clockwise.
    """

    force: Floats
    prescribed: Floats
    rotation: float = 0.0


@dataclass(frozen=True)
class State:
    """Equilibrium under one load.

    Attributes:
        displacement: of the nodes (2 N,) [m].
        reaction: forces of supports and ties on the nodes (2 N,) [N].
        energy: strain energy [J].
        contact: contact forces, pressure and gap; None without contact.
        iterations: Newton iterations spent on this load, on its last part if it was cut.
        path: the states before it on the same path, the last two at most, without theirs.
    """

    load: Load
    displacement: Floats
    reaction: Floats
    energy: float
    contact: ContactState | None
    iterations: int
    path: tuple[State, ...] = ()


@dataclass(frozen=True)
class Model:
    """A solid, how it is held, what it touches, and its band; made by ``prepare_model``."""

    solid: Solid
    constraints: Constraints
    contact: Contact | None
    pattern: Pattern
    element_scatter: Scatter
    contact_scatter: Scatter | None


def prepare_model(solid: Solid, constraints: Constraints, contact: Contact | None = None) -> Model:
    """Number the unknowns and find where element and contact matrices go."""
    elements = solid.mesh.elements
    pattern = number_unknowns(constraints, elements)
    where = _element_scatter(pattern, elements)
    bare = Model(solid, constraints, None, pattern, where, None)
    return bare if contact is None else with_contact(bare, contact)


def with_contact(model: Model, contact: Contact) -> Model:
    """A model, numbered already, that touches something else; ``contact`` is of the same solid."""
    numbers = edge_components(contact)
    rows, columns = np.repeat(numbers, 6, axis=1).ravel(), np.tile(numbers, (1, 6)).ravel()
    where = scatter(model.pattern, rows, columns, np.arange(rows.size))
    return replace(model, contact=contact, contact_scatter=where)


def _element_scatter(pattern: Pattern, elements: Indices) -> Scatter:
    """Where ``stiffness_blocks`` (E, 8, 3, 8) go.

    Few elements have a component that an equation names: the others take the short way.
    """
    components = components_of(elements)
    plain = np.all(pattern.untouched[components] >= 0, axis=1)

    short, long = np.flatnonzero(plain), np.flatnonzero(~plain)
    simple = scatter_untouched(
        pattern, components[short], 192 * short[:, None] + _BLOCK_ENTRY[np.tril_indices(16)]
    )
    row, column = np.indices((16, 16)).reshape(2, -1)
    rows, columns = components[long][:, row], components[long][:, column]
    source = 192 * long[:, None] + _BLOCK_ENTRY[row, column]
    tied = scatter(pattern, rows.ravel(), columns.ravel(), source.ravel())
    return together(simple, tied)


def _block_entries() -> Indices:
    """Where an element's blocks (8, 3, 8) hold the entry of two of its components (16, 16)."""
    xx, xy, yy = np.arange(192).reshape(8, 3, 8).transpose(1, 0, 2)
    return np.array([[xx, xy], [xy.T, yy]]).transpose(2, 0, 3, 1).reshape(16, 16)


_BLOCK_ENTRY = _block_entries()


def no_load(model: Model) -> Load:
    """No forces, the constants of the constraints as they were given, the profile at 0."""
    unknowns = model.solid.mesh.unknowns
    return Load(np.zeros(unknowns), model.constraints.constants)


def edge_components(contact: Contact) -> Indices:
    """Displacement components of the nodes of the contact edges (K, 6)."""
    return components_of(contact.edges)


def at_edge_nodes(contact: Contact, nodal: Floats, unknowns: int) -> Floats:
    """Forces on the edge nodes (K, 3, 2) added up to (2 N,)."""
    total = np.bincount(edge_components(contact).ravel(), nodal.ravel(), minlength=unknowns)
    return np.asarray(total, dtype=np.float64)


def free_part(model: Model, force: Floats) -> Floats:
    """Nodal forces (2 N,) as they act on the free unknowns."""
    return np.asarray(model.constraints.transform.T @ force)
