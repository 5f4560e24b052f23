"""A rigid profile in an input deck: a strip of elements along it, all of whose nodes are moved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.contact import Contact, ContactState
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.rigid_profile import RigidProfile, project
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


MARGIN = 4
"""The strip is so many edges longer, at both ends, than what is touched."""


def rigid_strip(contact: Contact, states: Sequence[ContactState]) -> RigidStrip:
    """The strip and the edges of the part that touch each other in one of the states, or nearly.

    CalculiX takes its time with many edges. The elements are as long as the edges; their depth is
    less than the profile's radius of curvature, so that none is turned inside out. What is touched
    must not reach across the seam of a closed profile.

    Raises:
        ValueError: nothing is touched.
    """
    touching = [state.pressure > 0.0 for state in states]
    edges = np.flatnonzero(np.any(touching, axis=(0, 2)))
    if not len(edges):
        raise ValueError("the profile is not touched in any of the states")
    near = contact.edges[max(edges[0] - MARGIN, 0) : edges[-1] + 1 + MARGIN]
    places = np.concatenate(
        [state.near.place[on] for state, on in zip(states, touching, strict=True)]
    )
    chords = contact.reference[edges, 2] - contact.reference[edges, 0]
    length = float(np.mean(np.hypot(*chords.T)))
    start = max(float(places.min()) - MARGIN * length, 0.0)
    end = min(float(places.max()) + MARGIN * length, float(contact.profile.places[-1]))
    count = int(np.ceil((end - start) / length))
    along = contact.profile.curve(np.linspace(start, end, 4 * count))
    sharpest = float(np.max(project(contact.profile, along).curvature))
    depth = 1.0 / max(2.0 * sharpest, 1.0 / (MARGIN * length))
    strip = _strip_mesh(contact.profile, start, end, count, depth)
    return RigidStrip(strip, near, contact.penalty, contact.friction)


def _strip_mesh(profile: RigidProfile, start: float, end: float, count: int, depth: float) -> Mesh:
    """``count`` elements from one place to another; their edge set "face" lies on the profile."""
    outside = profile.curve(np.linspace(start, end, 2 * count + 1))
    inside = outside - depth * project(profile, outside).normal
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
    return Mesh(nodes[used], number[elements], {}, {"face": number[face]})


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


def contact_prints(strip: RigidStrip) -> list[str]:
    """Requests for the motion and reactions of the profile and for the total force of contact.

    CalculiX prints the moment about the origin with the force; in Abaqus it is CMN and CMS.
    """
    return [
        "*NODE PRINT, NSET=PROFILE",
        "U, RF",
        "*CONTACT PRINT, SLAVE=PARTFACE, MASTER=PROFILEFACE",
        "CFN, CFS" if strip.friction else "CFN",
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
