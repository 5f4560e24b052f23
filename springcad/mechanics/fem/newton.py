"""Equilibrium along a path of loads by Newton's method."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import (
    Deformation,
    internal_force,
    linear_strain,
    strain_energy,
)
from springcad.mechanics.fem.contact import ContactState, History, first_history
from springcad.mechanics.fem.contact_tangent import turning_force
from springcad.mechanics.fem.foresight import foresee
from springcad.mechanics.fem.model import Load, Model, State, at_edge_nodes, free_part
from springcad.mechanics.fem.step import Expected, Trial, after, as_is, newton_step, try_at

Floats = NDArray[np.float64]

_MAX_ITERATIONS = 25
_MAX_CUTS = 6
_PATIENCE = 8  # iterations before steps are shortened; a false axial stress needs a few
_LINE_SEARCH_STEPS = 12


class NoEquilibriumError(ArithmeticError):
    """Newton's method did not converge; ``step`` counts the loads of the path from 0."""

    def __init__(self, step: int, reason: str) -> None:
        super().__init__(f"no equilibrium found at load step {step}: {reason}")
        self.step = step


def linear_solution(model: Model, load: Load) -> State:
    """Small-displacement solution without contact: one Newton step from rest."""
    bare, zero = replace(model, contact=None), np.zeros(model.solid.mesh.unknowns)
    trial = try_at(bare, zero, 0.0, zero, None)
    displacement = newton_step(bare, trial, as_is(trial), load.force, load.prescribed)
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
    foreseen = foresee(model, last, target)
    if foreseen is not None:
        try:
            return _solve_from(model, last, target, foreseen, tolerance)
        except _StepError:
            pass  # the path bends: contact is made or lost, or begins to stick
    return _solve_from(model, last, target, _predict(model, last, target), tolerance)


def _solve_from(
    model: Model, last: State, target: Load, expected: Expected, tolerance: float
) -> State:
    """The load step from what is expected at its end."""
    history, iterations = _history(model, last), 0
    for _ in range(1 + (model.contact.augmentations if model.contact else 0)):
        trial, used = _iterate(model, target, history, expected, tolerance)
        iterations, expected = iterations + used, as_is(trial)
        if trial.contact is not None and history is not None:
            history = replace(history, multiplier=trial.contact.history.multiplier)
    energy = strain_energy(model.solid, trial.state)
    path = (*last.path, replace(last, path=()))[-2:]
    return State(target, trial.displacement, -trial.force, energy, trial.contact, iterations, path)


def _predict(model: Model, last: State, target: Load) -> Expected:
    """The target linearised at the last state.

    Supports and profile are moved through the tangent, not suddenly: contact is neither lost nor
    are the elements at a moved support crushed.
    """
    history = _history(model, last)
    trial = try_at(model, last.load.force, last.load.rotation, last.displacement, history)
    force, turn = target.force - last.load.force, target.rotation - last.load.rotation
    if model.contact is not None and trial.contact is not None:
        pushed = turn * turning_force(model.contact, trial.contact)
        force = force + at_edge_nodes(model.contact, pushed, len(force))
    missing = target.prescribed - last.load.prescribed
    change = newton_step(model, trial, as_is(trial), force, missing)
    return after(model, trial, change, turn)


def _iterate(
    model: Model,
    load: Load,
    history: History | None,
    expected: Expected,
    tolerance: float,
) -> tuple[Trial, int]:
    """Newton's method from the displacement that is expected."""
    smallest = 1e-13 * float(np.max(np.ptp(model.solid.mesh.nodes, axis=0)))
    none = np.zeros_like(expected.displacement)
    moved, size = np.inf, np.inf
    for iteration in range(_MAX_ITERATIONS):
        trial = try_at(model, load.force, load.rotation, expected.displacement, history)
        size = float(np.linalg.norm(free_part(model, trial.force)))
        if not np.isfinite(size):
            raise _StepError("the displacements are not finite")
        if _is_beyond(trial.contact):
            raise _StepError("the part is pushed too deep into the profile")
        if size <= tolerance * trial.scale or moved <= smallest:
            if _is_inverted(trial.state):
                raise _StepError("an element is turned inside out")
            return trial, iteration
        change = newton_step(model, trial, expected, trial.force, none)
        if iteration >= _PATIENCE:
            change = _line_search(model, load, history, trial, change) * change
        moved = float(np.max(np.abs(change)))
        expected = after(model, trial, change)
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
    model: Model, load: Load, history: History | None, trial: Trial, change: Floats
) -> float:
    """Part of a change at which the imbalance along it is small; 1 unless it turns round before.

    It ends cycles between two directions of sliding, when the solution sticks.
    """

    def along(part: float) -> float:
        displacement = trial.displacement + part * change
        tried = try_at(model, load.force, load.rotation, displacement, history)
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


def _history(model: Model, last: State) -> History | None:
    """What the contact remembers of a converged state."""
    if model.contact is None:
        return None
    if last.contact is None:
        return first_history(model.contact, last.displacement, last.load.rotation)
    return last.contact.history
