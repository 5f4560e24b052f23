"""How contact forces change with the displacements and with the rotation of the profile."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.contact import Contact, ContactState
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ContactTangent:
    """Negative derivatives of the nodal forces of each edge (K, 6, 6) [N/m], in two parts.

    Component 2 a + i is direction i of edge node a. ``symmetric`` is that of normal contact and
    of sticking; ``remainder`` comes with sliding and friction on curved profiles.
    """

    symmetric: Floats
    remainder: Floats


def contact_tangent(contact: Contact, state: ContactState, pressure: Floats) -> ContactTangent:
    """Tangent at a state; its own ``pressure`` (K, G) gives the exact derivative.

    The pressure only enters the term of the profile's curvature. There the one predicted by the
    last Newton step is the better one: a first overlap of the undeformed part would give a
    pressure so large that the tangent is not even stable.
    """
    near, weights = state.near, contact.weights
    touching = state.pressure > 0.0
    # A step along the profile's tangent moves the nearest point 1/(1 + κ g) times as far.
    follow = 1.0 / (1.0 + near.curvature * np.where(touching, near.gap, 0.0))
    # −∂(p n + τ t)/∂x with dp = −ε n·dx, dn = κ t ds, dt = −κ n ds, ds = follow t·dx.
    turn = touching * near.curvature * follow
    stuck = touching & ~state.sliding
    along = contact.penalty * stuck * follow / near.speed - pressure * turn
    slide = contact.friction * contact.penalty * state.sliding * np.sign(state.traction)
    n, t = near.normal, near.tangent
    normal = _outer(weights * contact.penalty * touching, n, n) + _outer(weights * along, t, t)
    friction = _outer(weights * slide, t, n) + _outer(weights * state.traction * turn, n, t)
    return ContactTangent(_at_nodes(contact, normal), _at_nodes(contact, friction))


def predicted_pressure(
    contact: Contact, state: ContactState, change: Floats, rotation: float
) -> Floats:
    """Pressure (K, G), to first order, after changes of displacements (2 N,) and rotation."""
    moved = np.einsum("ga,kai->kgi", contact.shape, change.reshape(-1, 2)[contact.edges])
    turned = rotation * rotated(state.positions, np.asarray(0.5 * np.pi))
    closing = np.sum(state.near.normal * (turned - moved), axis=-1)
    pressure = state.pressure + contact.penalty * closing
    return np.where(state.pressure > 0.0, np.maximum(pressure, 0.0), 0.0)


def turning_force(contact: Contact, state: ContactState) -> Floats:
    """Change of the nodal forces (K, 3, 2) per rotation of the profile [N/rad].

    Turning the profile is turning everything, less turning the part back.
    """
    tangent = contact_tangent(contact, state, state.pressure)
    quarter = np.asarray(0.5 * np.pi)
    back = rotated(state.edge_positions, quarter).reshape(-1, 6, 1)
    change = ((tangent.symmetric + tangent.remainder) @ back).reshape(-1, 3, 2)
    return np.asarray(rotated(state.nodal, quarter) + change)


def _outer(size: Floats, left: Floats, right: Floats) -> Floats:
    """size · left ⊗ right at every point (K, G, 2, 2)."""
    return np.asarray(size[..., None, None] * left[..., :, None] * right[..., None, :])


def _at_nodes(contact: Contact, local: Floats) -> Floats:
    """Matrices of the points (K, G, 2, 2) gathered to those of the edges (K, 6, 6)."""
    pairs = np.einsum("ga,gb->gab", contact.shape, contact.shape)
    return np.asarray(np.einsum("gab,kgij->kaibj", pairs, local).reshape(-1, 6, 6))
