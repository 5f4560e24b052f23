"""A rigid profile in an input deck: a strip of elements along it, all of whose nodes are moved."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.contact import Contact
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.rigid_profile import project
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class RigidStrip:
    """Elements along a part of a rigid profile, and the edges of the part that may touch it."""

    mesh: Mesh
    edges: Indices
    penalty: float
    friction: float


def rigid_strip(contact: Contact, start: float, end: float, count: int, depth: float) -> RigidStrip:
    """A strip of ``count`` elements of ``depth`` [m] from one place on the profile to another.

    The depth must be less than the convex radius of curvature. Only edges of the part that come
    near need be in the contact; CalculiX takes its time with many.
    """
    outside = contact.profile.curve(np.linspace(start, end, 2 * count + 1))
    inside = outside - depth * project(contact.profile, outside).normal
    nodes = np.concatenate([inside, 0.5 * (inside + outside), outside])
    low, high = 2 * np.arange(count), 2 * (2 * count + 1) + 2 * np.arange(count)
    middle = 2 * count + 1 + 2 * np.arange(count)
    # Along the profile with the body on the left: outer edge first, then back on the inner one.
    elements = np.stack(
        [high, high + 2, low + 2, low, high + 1, middle + 2, low + 1, middle], axis=1
    )
    face = np.stack([high, high + 1, high + 2], axis=1)
    used = np.unique(elements)
    number = np.full(len(nodes), -1)
    number[used] = np.arange(len(used))
    strip = Mesh(nodes[used], number[elements], {}, {"face": number[face]})
    return RigidStrip(strip, contact.edges, contact.penalty, contact.friction)


def node_lines(mesh: Mesh, first: int) -> list[str]:
    """Data lines of *NODE, numbered from ``first`` + 1."""
    return [f"{first + i + 1}, {x:.12g}, {y:.12g}, 0" for i, (x, y) in enumerate(mesh.nodes)]


def element_lines(mesh: Mesh, first_node: int, first: int) -> list[str]:
    """Data lines of *ELEMENT, numbered from ``first`` + 1, for nodes numbered likewise."""
    numbers = mesh.elements + first_node + 1
    return [", ".join(map(str, [first + i + 1, *row])) for i, row in enumerate(numbers)]


def contact_lines(mesh: Mesh, strip: RigidStrip) -> list[str]:
    """Strip, surfaces and contact pair, for a deck in which the mesh of the part comes first."""
    nodes, elements = len(mesh.nodes), len(mesh.elements)
    slip = ["*FRICTION", f"{strip.friction:.12g}, {strip.penalty:.12g}"]
    return [
        "*NODE, NSET=PROFILE",
        *node_lines(strip.mesh, nodes),
        "*ELEMENT, TYPE=CPS8, ELSET=SHEET",
        *element_lines(strip.mesh, nodes, elements),
        "*SURFACE, NAME=PARTFACE, TYPE=ELEMENT",
        *_face_lines(mesh, strip.edges, 0),
        "*SURFACE, NAME=PROFILEFACE, TYPE=ELEMENT",
        *_face_lines(strip.mesh, strip.mesh.edge_sets["face"], elements),
        "*SURFACE INTERACTION, NAME=TOUCH",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
        f"{strip.penalty:.12g}",
        *(slip if strip.friction else []),
        "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE",
        "PARTFACE, PROFILEFACE",
    ]


def strip_motion(strip: RigidStrip, first_node: int, rotation: float) -> list[str]:
    """Data lines of *BOUNDARY that put the strip to an angle of the profile."""
    moved = rotated(strip.mesh.nodes, np.asarray(rotation)) - strip.mesh.nodes
    return [
        f"{first_node + i + 1}, {j + 1}, {j + 1}, {moved[i, j]:.12g}"
        for i in range(len(moved))
        for j in range(2)
    ]


def _face_lines(mesh: Mesh, edges: Indices, first: int) -> list[str]:
    """Data lines of *SURFACE: the element and its side on which each edge lies."""
    middles = {
        int(node): (element, side)
        for element, row in enumerate(mesh.elements)
        for side, node in enumerate(row[4:])
        if node in edges[:, 1]
    }
    sides = (middles[int(edge[1])] for edge in edges)
    return [f"{first + element + 1}, S{side + 1}" for element, side in sides]
