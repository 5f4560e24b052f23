"""Where a path of loads leads next, from the equilibria that it has passed: the start of Newton's
method.

Displacements are analytic in the load while the contact slides on, so a parabola through the last
three states is nearer to the next one than the tangent at the last, and needs no stiffness matrix.
Strains are extrapolated themselves, not taken from the displacements: they would be false by the
square of every rotation that the parabola misses.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import deformation
from springcad.mechanics.fem.model import Load, Model, State
from springcad.mechanics.fem.step import Expected

Floats = NDArray[np.float64]

_STRAIGHT = 1e-9
"""Loads lie on one line within this share of the next step."""


def foresee(model: Model, last: State, target: Load) -> Expected | None:
    """What is to be expected at ``target``; None where the path tells nothing about it.

    Its loads must lie on one line, one after the other.
    """
    states = [*last.path, last]
    places = [_place(state.load, last.load, target) for state in states]
    if len(states) < 2 or not np.all(np.diff(places) > 0.0):  # false where one is not a number
        return None
    shares = _lagrange(np.array(places))
    pressure = np.zeros(0)
    if last.contact is not None:
        contacts = [state.contact for state in states if state.contact is not None]
        if len(contacts) < len(states):
            return None
        pressure = _weighted_sum(shares, [contact.pressure for contact in contacts])
    return Expected(
        _weighted_sum(shares, [state.displacement for state in states]),
        _weighted_sum(shares, [deformation(model.solid, s.displacement).strain for s in states]),
        np.maximum(pressure, 0.0),
    )


def _place(load: Load, last: Load, target: Load) -> float:
    """Where a load is on the line from the last (0) to the target (1); nan if it is not on it."""
    away, ahead = _difference(load, last), _difference(target, last)
    sizes = [float(part @ part) for part in ahead]
    along = [float(a @ b) / size for a, b, size in zip(away, ahead, sizes, strict=True) if size]
    place = along[0] if along else np.nan
    on_line = all(
        np.max(np.abs(a - place * b)) <= _STRAIGHT * np.sqrt(size)
        for a, b, size in zip(away, ahead, sizes, strict=True)
    )
    return place if on_line else np.nan


def _difference(load: Load, last: Load) -> tuple[Floats, Floats, Floats]:
    turn = np.array([load.rotation - last.rotation])
    return load.force - last.force, load.prescribed - last.prescribed, turn


def _lagrange(places: Floats) -> Floats:
    """Shares of the values at the places in the polynomial's value at 1."""
    others = ~np.eye(len(places), dtype=np.bool_)
    gaps = places[:, None] - places + np.eye(len(places))
    return np.asarray(np.prod(np.where(others, (1.0 - places) / gaps, 1.0), axis=1))


def _weighted_sum(shares: Floats, values: list[Floats]) -> Floats:
    return np.asarray(np.tensordot(shares, np.stack(values), 1))
