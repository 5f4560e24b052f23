"""Equilibrium along a path of loads by Newton's method.

In the geometric stiffness the stress is the one predicted by the last linear step, not the one of
the new displacements ("mixed integration point" iteration, Magisano, Leonetti, Garcea 2017, Comput.
Methods Appl. Mech. Eng. 313). The residual, and so the solution, is not touched; in slender parts
it saves the plain iteration from the false axial stress of every finite rotation, and the load
steps can be several times as long.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import (
    Deformation,
    Solid,
    block_product,
    deformation,
    internal_force,
    linear_strain,
    stiffness_blocks,
    strain_energy,
    stress,
)
from springcad.mechanics.fem.band import (
    Pattern,
    Scatter,
    gather,
    number_unknowns,
    scatter,
    solve,
    solve_corrected,
)
from springcad.mechanics.fem.constraints import Constraints
from springcad.mechanics.fem.contact import (
    Contact,
    ContactState,
    History,
    evaluate_contact,
    first_history,
)
from springcad.mechanics.fem.contact_tangent import (
    contact_tangent,
    predicted_pressure,
    turning_force,
)

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_MAX_ITERATIONS = 25
_MAX_CUTS = 6
_PATIENCE = 8  # iterations before steps are shortened; a false axial stress needs a few
_LINE_SEARCH_STEPS = 12


class NoEquilibriumError(ArithmeticError):
    """Newton's method did not converge; ``step`` counts the loads of the path from 0."""

    def __init__(self, step: int, reason: str) -> None:
        super().__init__(f"no equilibrium found at load step {step}: {reason}")
        self.step = step


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
    """

    load: Load
    displacement: Floats
    reaction: Floats
    energy: float
    contact: ContactState | None
    iterations: int


@dataclass(frozen=True)
class Model:
    """A solid, how it is held, what it touches, and its band; made by ``prepare_model``."""

    solid: Solid
    constraints: Constraints
    contact: Contact | None
    pattern: Pattern
    element_scatter: Scatter
    contact_scatter: Scatter | None


@dataclass(frozen=True)
class _Trial:
    """One displacement within a load step, with the forces that follow from it.

    ``force`` (2 N,) is what nodal forces lack in balance, ``scale`` a norm of all nodal forces.
    """

    displacement: Floats
    state: Deformation
    contact: ContactState | None
    force: Floats
    scale: float


@dataclass(frozen=True)
class _Expected:
    """What the last linear step expects of its end: strain (3, E, G), contact pressure (K, G)."""

    displacement: Floats
    strain: Floats
    pressure: Floats


def prepare_model(solid: Solid, constraints: Constraints, contact: Contact | None = None) -> Model:
    """Number the unknowns and find where element and contact matrices go."""
    elements = solid.mesh.elements
    pattern = number_unknowns(constraints.transform, elements)
    contact_scatter = None
    if contact is not None:
        numbers = _components(contact)
        rows, columns = np.repeat(numbers, 6, axis=1).ravel(), np.tile(numbers, (1, 6)).ravel()
        contact_scatter = scatter(pattern, rows, columns, np.arange(rows.size))
    return Model(
        solid,
        constraints,
        contact,
        pattern,
        scatter(pattern, *_block_entries(elements)),
        contact_scatter,
    )


def _block_entries(elements: Indices) -> tuple[Indices, ...]:
    """Rows, columns and source entries of the blocks (xx, xy, yy), and of xy transposed."""
    row = np.broadcast_to(2 * elements[:, :, None], (len(elements), 8, 8)).ravel()
    column = np.broadcast_to(2 * elements[:, None, :], (len(elements), 8, 8)).ravel()
    entry = np.arange(row.size)
    xx, xy, yy = entry, entry + row.size, entry + 2 * row.size
    rows = np.concatenate([row, row, row + 1, column + 1])
    columns = np.concatenate([column, column + 1, column + 1, row])
    return rows, columns, np.concatenate([xx, xy, yy, xy])


def no_load(model: Model) -> Load:
    """No forces, the constants of the constraints as they were given, the profile at 0."""
    unknowns = model.solid.mesh.unknowns
    return Load(np.zeros(unknowns), model.constraints.constants)


def linear_solution(model: Model, load: Load) -> State:
    """Small-displacement solution without contact: one Newton step from rest."""
    bare, zero = replace(model, contact=None), np.zeros(model.solid.mesh.unknowns)
    trial = _try(bare, zero, 0.0, zero, None)
    displacement = _newton_step(bare, trial, _as_is(trial), load.force, load.prescribed)
    strain = linear_strain(model.solid, trial.state, displacement)
    inside = internal_force(model.solid, Deformation(trial.state.gradient, strain))
    energy = 0.5 * float(displacement @ inside)
    return State(load, displacement, inside - load.force, energy, None, 1)


def solve_path(
    model: Model, loads: Sequence[Load], start: State | None = None, tolerance: float = 1e-8
) -> tuple[State, ...]:
    """Equilibrium under each load in turn, from the undeformed state or from ``start``.

    A load step that does not converge is cut into halves; after eight iterations a step is
    searched for the point where the imbalance along it vanishes. With friction the order matters:
    each state is the history of the next.

    Args:
        tolerance: on the norm of the imbalance of the free unknowns, over the norm of all nodal
            forces.

    Raises:
        NoEquilibriumError: a step did not converge in spite of its cuts.
        ArithmeticError: the part is not held.
    """
    unknowns = model.solid.mesh.unknowns
    if start is None:
        zero = np.zeros(unknowns)
        start = State(Load(zero, zero), zero, zero, 0.0, None, 0)
    states: list[State] = []
    for step, load in enumerate(loads):
        start = _advance(model, step, start, load, tolerance)
        states.append(start)
    return tuple(states)


def _advance(
    model: Model, step: int, last: State, target: Load, tolerance: float, cuts: int = 0
) -> State:
    """The state at ``target``, reached from ``last`` in as many parts as needed."""
    try:
        return _solve_step(model, last, target, tolerance)
    except _StepError as failure:
        if cuts == _MAX_CUTS:
            raise NoEquilibriumError(step, str(failure)) from failure
    middle = Load(
        0.5 * (last.load.force + target.force),
        0.5 * (last.load.prescribed + target.prescribed),
        0.5 * (last.load.rotation + target.rotation),
    )
    last = _advance(model, step, last, middle, tolerance, cuts + 1)
    return _advance(model, step, last, target, tolerance, cuts + 1)


class _StepError(Exception):
    """A load step is too long."""


def _solve_step(model: Model, last: State, target: Load, tolerance: float) -> State:
    """One load step, with as many updates of the contact multipliers as the contact asks for."""
    history = _history(model, last)
    expected, iterations = _predict(model, last, target, history), 1
    for _ in range(1 + (model.contact.augmentations if model.contact else 0)):
        trial, used = _iterate(model, target, history, expected, tolerance)
        iterations, expected = iterations + used, _as_is(trial)
        if trial.contact is not None and history is not None:
            history = replace(history, multiplier=trial.contact.history.multiplier)
    energy = strain_energy(model.solid, trial.state)
    return State(target, trial.displacement, -trial.force, energy, trial.contact, iterations)


def _predict(model: Model, last: State, target: Load, history: History | None) -> _Expected:
    """The target linearised at the last state.

    Supports and profile are moved through the tangent, not suddenly: contact is neither lost nor
    are the elements at a moved support crushed.
    """
    trial = _try(model, last.load.force, last.load.rotation, last.displacement, history)
    force, turn = target.force - last.load.force, target.rotation - last.load.rotation
    if model.contact is not None and trial.contact is not None:
        pushed = turn * turning_force(model.contact, trial.contact)
        force = force + _at_edge_nodes(model.contact, pushed, len(force))
    missing = target.prescribed - last.load.prescribed
    change = _newton_step(model, trial, _as_is(trial), force, missing)
    return _after(model, trial, change, turn)


def _as_is(trial: _Trial) -> _Expected:
    """No more expected than what is."""
    pressure = trial.contact.pressure if trial.contact else np.zeros(0)
    return _Expected(trial.displacement, trial.state.strain, pressure)


def _after(model: Model, trial: _Trial, change: Floats, rotation: float = 0.0) -> _Expected:
    """What changes of displacements (2 N,) and rotation make of a trial, to first order."""
    strain = trial.state.strain + linear_strain(model.solid, trial.state, change)
    pressure = np.zeros(0)
    if model.contact is not None and trial.contact is not None:
        pressure = predicted_pressure(model.contact, trial.contact, change, rotation)
    return _Expected(trial.displacement + change, strain, pressure)


def _iterate(
    model: Model,
    load: Load,
    history: History | None,
    expected: _Expected,
    tolerance: float,
) -> tuple[_Trial, int]:
    """Newton's method from the displacement that is expected."""
    smallest = 1e-13 * float(np.max(np.ptp(model.solid.mesh.nodes, axis=0)))
    none = np.zeros_like(expected.displacement)
    moved, size = np.inf, np.inf
    for iteration in range(_MAX_ITERATIONS):
        trial = _try(model, load.force, load.rotation, expected.displacement, history)
        size = float(np.linalg.norm(_free(model, trial.force)))
        if not np.isfinite(size):
            raise _StepError("the displacements are not finite")
        if _is_beyond(trial.contact):
            raise _StepError("the part is pushed too deep into the profile")
        if size <= tolerance * trial.scale or moved <= smallest:
            if _is_inverted(trial.state):
                raise _StepError("an element is turned inside out")
            return trial, iteration
        change = _newton_step(model, trial, expected, trial.force, none)
        if iteration >= _PATIENCE:
            change = _line_search(model, load, history, trial, change) * change
        moved = float(np.max(np.abs(change)))
        expected = _after(model, trial, change)
    raise _StepError(f"imbalance {size:.1e} N after {_MAX_ITERATIONS} iterations")


def _is_inverted(state: Deformation) -> bool:
    """Whether the sheet is folded through itself anywhere: an equilibrium of the law, not of it."""
    xx, xy, yx, yy = state.gradient
    return bool(np.any(xx * yy <= xy * yx))


def _is_beyond(contact: ContactState | None) -> bool:
    """Whether a point is so deep in a convex profile that it may come out on the other side."""
    if contact is None:
        return False
    inside = contact.near.gap < 0.0
    return bool(np.any(-contact.near.gap[inside] * contact.near.curvature[inside] > 0.5))


def _line_search(
    model: Model, load: Load, history: History | None, trial: _Trial, change: Floats
) -> float:
    """Part of a change at which the imbalance along it is small; 1 unless it turns round before.

    It ends cycles between two directions of sliding, when the solution sticks.
    """

    def along(part: float) -> float:
        displacement = trial.displacement + part * change
        tried = _try(model, load.force, load.rotation, displacement, history)
        return float(change @ tried.force)

    low, high, first, last = 0.0, 1.0, float(change @ trial.force), along(1.0)
    if abs(last) < 0.5 * abs(first) or first * last > 0.0:
        return 1.0
    for _ in range(_LINE_SEARCH_STEPS):
        middle = 0.5 * (low + high)
        value = along(middle)
        if abs(value) < 0.2 * abs(first):
            break
        low, high = (middle, high) if value * first > 0.0 else (low, middle)
    return middle


def _try(
    model: Model,
    dead_force: Floats,
    rotation: float,
    displacement: Floats,
    history: History | None,
) -> _Trial:
    """All forces at a displacement."""
    state = deformation(model.solid, displacement)
    inside, outside, contact = internal_force(model.solid, state), dead_force, None
    if model.contact is not None and history is not None:
        contact = evaluate_contact(model.contact, displacement, rotation, history)
        outside = outside + _at_edge_nodes(model.contact, contact.nodal, len(outside))
    scale = float(np.linalg.norm(inside) + np.linalg.norm(outside))
    return _Trial(displacement, state, contact, outside - inside, scale)


def _newton_step(
    model: Model, trial: _Trial, expected: _Expected, force: Floats, missing: Floats
) -> Floats:
    """Change of all displacements (2 N,) that balances ``force`` and adds ``missing`` constants."""
    blocks = stiffness_blocks(model.solid, trial.state, stress(model.solid.sheet, expected.strain))
    lift = np.asarray(model.constraints.lift @ missing)
    if lift.any():
        force = force - block_product(model.solid, blocks, lift)
    right, parts = _free(model, force), [(model.element_scatter, blocks)]
    if model.contact is None or model.contact_scatter is None or trial.contact is None:
        free = solve(model.pattern, gather(model.pattern, parts), right[:, None])[:, 0]
        return np.asarray(model.constraints.transform @ free + lift)

    tangent = contact_tangent(model.contact, trial.contact, expected.pressure)
    parts.append((model.contact_scatter, tangent.symmetric))
    band = gather(model.pattern, parts)
    components, correction = _assembled(model.contact, tangent.remainder)
    free = solve_corrected(model.pattern, band, right, components, correction)
    return np.asarray(model.constraints.transform @ free + lift)


def _assembled(contact: Contact, matrices: Floats) -> tuple[Indices, Floats]:
    """Edge matrices (K, 6, 6) as one matrix (r, r) of the components where they are not zero."""
    used = np.any(matrices != 0.0, axis=(1, 2))
    numbers = _components(contact)[used]
    components, place = np.unique(numbers, return_inverse=True)
    place = place.reshape(numbers.shape)
    total = np.zeros((len(components), len(components)))
    np.add.at(total, (place[:, :, None], place[:, None, :]), matrices[used])
    return components, total


def _components(contact: Contact) -> Indices:
    """Displacement components of the nodes of the contact edges (K, 6)."""
    return (2 * contact.edges[..., None] + np.arange(2)).reshape(-1, 6)


def _at_edge_nodes(contact: Contact, nodal: Floats, unknowns: int) -> Floats:
    """Forces on the edge nodes (K, 3, 2) added up to (2 N,)."""
    total = np.bincount(_components(contact).ravel(), nodal.ravel(), minlength=unknowns)
    return np.asarray(total, dtype=np.float64)


def _free(model: Model, force: Floats) -> Floats:
    """Nodal forces (2 N,) as they act on the free unknowns."""
    return np.asarray(model.constraints.transform.T @ force)


def _history(model: Model, last: State) -> History | None:
    """What the contact remembers of a converged state."""
    if model.contact is None:
        return None
    if last.contact is None:
        return first_history(model.contact, last.displacement, last.load.rotation)
    return last.contact.history
