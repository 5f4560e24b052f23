"""Contact of a deformable edge with a rigid profile that turns about the origin.

At integration points of the quadratic edges the distance g to the profile gives the pressure
p = max(0, λ − ε g) (penalty ε, multiplier λ of the augmented Lagrangian), and with friction the
traction τ along the profile from the way slid since the last converged step, returned to |τ| ≤ μ p
(Wriggers, Computational Contact Mechanics, 2nd ed., 6.3 and 10.5). For μ = 0 all follows from one
energy, so forces and torque are exact derivatives of it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import Solid
from springcad.mechanics.fem.element import edge_shape_functions
from springcad.mechanics.fem.rigid_profile import Projection, RigidProfile, project
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Contact:
    """A pair of edge set and profile; made by ``prepare_contact``. K edges, G points on each.

    Attributes:
        edges: node numbers (K, 3).
        reference: positions of the undeformed nodes (K, 3, 2) [m].
        shape: shape functions at the points (G, 3).
        weights: area of each point, length times sheet thickness (K, G) [m²].
        profile: the rigid body.
        penalty: ε, pressure per penetration [Pa/m].
        friction: μ.
        augmentations: how often the multipliers are updated within a load step.
    """

    edges: Indices
    reference: Floats
    shape: Floats
    weights: Floats
    profile: RigidProfile
    penalty: float
    friction: float
    augmentations: int


@dataclass(frozen=True)
class History:
    """What a converged step leaves to the next, at the contact points (K, G).

    Attributes:
        multiplier: λ, pressure carried without penetration [Pa].
        anchor: place on the profile from which the elastic slip is measured [m].
    """

    multiplier: Floats
    anchor: Floats


@dataclass(frozen=True)
class ContactState:
    """Contact at one deformation and one angle of the profile; fields at the points (K, G).

    Attributes:
        near: gap [m] (negative where the bodies overlap), normal and more of the nearest points.
        pressure: [Pa]; meaningful where an edge is shorter than the contact strip, elsewhere take
            the force and Hertz's formula.
        traction: friction along the profile, positive in its direction [Pa].
        sliding: whether the point touches and friction is at its limit (0 without friction).
        positions: of the contact points (K, G, 2) [m].
        force: on the deformable part (2,) [N].
        torque: of the deformable part on the profile, about the origin [N m].
        energy: in the penalty springs [J]; small against the strain energy, or ε is too small.
        history: what the next step starts from, if this state is accepted.
        edge_positions: of the nodes of the edges (K, 3, 2) [m].
        nodal: forces on the nodes of the edges (K, 3, 2) [N].
    """

    near: Projection
    pressure: Floats
    traction: Floats
    sliding: NDArray[np.bool_]
    positions: Floats
    force: Floats
    torque: float
    energy: float
    history: History
    edge_positions: Floats
    nodal: Floats


def prepare_contact(
    solid: Solid,
    edges: str,
    profile: RigidProfile,
    penalty: float,
    friction: float = 0.0,
    points_per_edge: int = 4,
    augmentations: int = 0,
) -> Contact:
    """Contact of the edge set ``edges`` of a solid with a profile.

    Args:
        penalty: ε [Pa/m]. E over the edge length is a good start: force and torque are then
            right, and Hertz's peak pressure, where edges resolve it, some per cent low; a few
            augmentations, each two or three iterations, cure that.
        points_per_edge: more than 3 when the contact strip is shorter than an edge. The strip of a
            penetration d under a relative curvature κ is 2 √(2 d/κ) wide; where it holds fewer
            than about four points the contact moves in small jumps.
        augmentations: updates of the multipliers within each step.
    """
    numbers = solid.mesh.edge_sets[edges]
    reference = solid.mesh.nodes[numbers]
    x, w = np.polynomial.legendre.leggauss(points_per_edge)
    value, slope = edge_shape_functions(x)
    length = np.hypot(*np.einsum("ga,kai->ikg", slope, reference))
    weights = w * length * solid.sheet.thickness
    return Contact(numbers, reference, value, weights, profile, penalty, friction, augmentations)


def first_history(contact: Contact, displacement: Floats, rotation: float) -> History:
    """History of a part that has not touched the profile yet."""
    place = _project(contact, displacement, rotation)[2].place
    return History(np.zeros_like(place), place)


def _project(
    contact: Contact, displacement: Floats, rotation: float
) -> tuple[Floats, Floats, Projection]:
    """Deformed edge nodes (K, 3, 2), contact points (K, G, 2), and the nearest profile points.

    Normals and tangents are turned with the profile.
    """
    nodes = contact.reference + displacement.reshape(-1, 2)[contact.edges]
    points = np.einsum("ga,kai->kgi", contact.shape, nodes)
    near = project(contact.profile, rotated(points, np.asarray(-rotation)))
    turn = np.asarray(rotation)
    normal, tangent = rotated(near.normal, turn), rotated(near.tangent, turn)
    return nodes, points, replace(near, normal=normal, tangent=tangent)


def evaluate_contact(
    contact: Contact, displacement: Floats, rotation: float, history: History
) -> ContactState:
    """Forces of the contact; ``rotation`` of the profile [rad], counter-clockwise."""
    nodes, points, near = _project(contact, displacement, rotation)
    pressure = np.maximum(0.0, history.multiplier - contact.penalty * near.gap)
    traction, sliding, anchor = _friction(contact, pressure, near.place, history)
    density = pressure[..., None] * near.normal + traction[..., None] * near.tangent
    force = contact.weights[..., None] * density
    moment = points[..., 0] * force[..., 1] - points[..., 1] * force[..., 0]
    return ContactState(
        near=near,
        pressure=pressure,
        traction=traction,
        sliding=sliding,
        positions=points,
        force=force.sum(axis=(0, 1)),
        torque=-float(moment.sum()),
        energy=float(np.sum(contact.weights * pressure**2)) / (2.0 * contact.penalty),
        history=History(pressure if contact.augmentations else history.multiplier, anchor),
        edge_positions=nodes,
        nodal=np.einsum("ga,kgi->kai", contact.shape, force),
    )


def _friction(
    contact: Contact, pressure: Floats, place: Floats, history: History
) -> tuple[Floats, NDArray[np.bool_], Floats]:
    """Traction, whether it is at its limit, and the anchor left behind (return mapping)."""
    limit = contact.friction * pressure
    slip = place - history.anchor
    if contact.profile.closed:
        length = contact.profile.places[-1]
        slip = slip - length * np.round(slip / length)
    trial = -contact.penalty * slip
    traction = np.clip(trial, -limit, limit)
    # A point left exactly at its limit sticks until it is moved on: rounding must not decide.
    sliding = (pressure > 0.0) & ((np.abs(trial) > limit * (1.0 + 1e-9)) | (limit == 0.0))
    return traction, sliding, place + traction / contact.penalty
