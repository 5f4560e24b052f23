"""One linear step of Newton's method: the forces at a displacement, and the change they ask for.

In the geometric stiffness the stress is the one predicted by the last linear step, not the one of
the new displacements ("mixed integration point" iteration, Magisano, Leonetti, Garcea 2017, Comput.
Methods Appl. Mech. Eng. 313). The residual, and so the solution, is not touched; in slender parts
it saves the plain iteration from the false axial stress of every finite rotation, and the load
steps can be several times as long.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import (
    Deformation,
    block_product,
    deformation,
    internal_force,
    linear_strain,
    stiffness_blocks,
    stress,
)
from springcad.mechanics.fem.band import solve, solve_corrected
from springcad.mechanics.fem.contact import Contact, ContactState, History, evaluate_contact
from springcad.mechanics.fem.contact_tangent import contact_tangent, predicted_pressure
from springcad.mechanics.fem.model import Model, at_edge_nodes, edge_components, free_part

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Trial:
    """One displacement within a load step, with the forces that follow from it.

    ``force`` (2 N,) is what nodal forces lack in balance, ``scale`` a norm of all nodal forces.
    """

    displacement: Floats
    state: Deformation
    contact: ContactState | None
    force: Floats
    scale: float


@dataclass(frozen=True)
class Expected:
    """What the last linear step expects of its end: strain (3, E, G), contact pressure (K, G)."""

    displacement: Floats
    strain: Floats
    pressure: Floats


def try_at(
    model: Model,
    dead_force: Floats,
    rotation: float,
    displacement: Floats,
    history: History | None,
) -> Trial:
    """All forces at a displacement."""
    state = deformation(model.solid, displacement)
    inside, outside, contact = internal_force(model.solid, state), dead_force, None
    if model.contact is not None and history is not None:
        contact = evaluate_contact(model.contact, displacement, rotation, history)
        outside = outside + at_edge_nodes(model.contact, contact.nodal, len(outside))
    scale = float(np.linalg.norm(inside) + np.linalg.norm(outside))
    return Trial(displacement, state, contact, outside - inside, scale)


def newton_step(
    model: Model, trial: Trial, expected: Expected, force: Floats, missing: Floats
) -> Floats:
    """Change of all displacements (2 N,) that balances ``force`` and adds ``missing`` constants."""
    blocks = stiffness_blocks(model.solid, trial.state, stress(model.solid.sheet, expected.strain))
    lift = np.asarray(model.constraints.lift @ missing)
    if lift.any():
        force = force - block_product(model.solid, blocks, lift)
    right, parts = free_part(model, force), [(model.element_scatter, blocks)]
    if model.contact is None or model.contact_scatter is None or trial.contact is None:
        free = solve(model.pattern, parts, right[:, None])[:, 0]
        return np.asarray(model.constraints.transform @ free + lift)

    tangent = contact_tangent(model.contact, trial.contact, expected.pressure)
    parts.append((model.contact_scatter, tangent.symmetric))
    components, correction = _assembled(model.contact, tangent.remainder)
    free = solve_corrected(model.pattern, parts, right, components, correction)
    return np.asarray(model.constraints.transform @ free + lift)


def as_is(trial: Trial) -> Expected:
    """No more expected than what is."""
    pressure = trial.contact.pressure if trial.contact else np.zeros(0)
    return Expected(trial.displacement, trial.state.strain, pressure)


def after(model: Model, trial: Trial, change: Floats, rotation: float = 0.0) -> Expected:
    """What changes of displacements (2 N,) and rotation make of a trial, to first order."""
    strain = trial.state.strain + linear_strain(model.solid, trial.state, change)
    pressure = np.zeros(0)
    if model.contact is not None and trial.contact is not None:
        pressure = predicted_pressure(model.contact, trial.contact, change, rotation)
    return Expected(trial.displacement + change, strain, pressure)


def _assembled(contact: Contact, matrices: Floats) -> tuple[Indices, Floats]:
    """Edge matrices (K, 6, 6) as one matrix (r, r) of the components where they are not zero."""
    used = np.any(matrices != 0.0, axis=(1, 2))
    numbers = edge_components(contact)[used]
    components, place = np.unique(numbers, return_inverse=True)
    place = place.reshape(numbers.shape)
    total = np.zeros((len(components), len(components)))
    np.add.at(total, (place[:, :, None], place[:, None, :]), matrices[used])
    return components, total
