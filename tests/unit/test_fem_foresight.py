"""Where the next equilibrium of a path is expected before it is sought."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from fem_cases import STEEL, cantilever

from springcad.mechanics.fem.assembly import prepare_solid
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.foresight import foresee
from springcad.mechanics.fem.model import Load, prepare_model
from springcad.mechanics.fem.newton import solve_path

LENGTH = 0.05
FAR = 0.4 * LENGTH


@pytest.fixture(scope="module")
def leaf():
    """A leaf clamped at its root; the middle of its tip is moved across."""
    mesh = cantilever(LENGTH, 2.5e-4, 2.5e-4)
    tip = mesh.node_sets["east"]
    held = solve_constraints(
        mesh.unknowns,
        prescribe(mesh.node_sets["west"]),
        prescribe(tip[len(tip) // 2], components=(1,)),
    )
    return prepare_model(prepare_solid(mesh, STEEL), held)


def moved(model, way):
    unknowns = model.solid.mesh.unknowns
    prescribed = np.zeros(unknowns)
    prescribed[model.constraints.equations.slaves[-1]] = way
    return Load(np.zeros(unknowns), prescribed)


@pytest.fixture(scope="module")
def states(leaf):
    return solve_path(leaf, [moved(leaf, FAR * share) for share in (0.7, 0.8, 0.9, 1.0)])


def test_the_error_of_the_forecast_is_of_third_order_in_the_step(leaf):
    """A parabola through three states: half the step, an eighth of the error."""
    errors = []
    for step in (0.04, 0.02):
        loads = [moved(leaf, FAR * (0.8 + k * step)) for k in range(4)]
        *_, last, there = solve_path(leaf, loads)
        expected = foresee(leaf, last, loads[-1])
        errors.append(np.abs(expected.displacement - there.displacement).max())
    assert errors[0] / errors[1] == pytest.approx(8.0, rel=0.25)


def test_the_forecast_changes_the_way_to_the_equilibrium_and_not_the_equilibrium(leaf, states):
    *_, last, there = states
    (again,) = solve_path(leaf, [there.load], replace(last, path=()))
    assert again.displacement == pytest.approx(there.displacement, abs=1e-9 * FAR)
    assert again.energy == pytest.approx(there.energy, rel=1e-9)
    assert there.iterations < again.iterations + 1  # and it saves the step along the tangent


def test_nothing_is_foretold_off_the_line_of_the_loads(leaf, states):
    *_, last, there = states
    aside = replace(there.load, rotation=0.1)
    assert foresee(leaf, last, there.load) is not None
    assert foresee(leaf, last, aside) is None
    assert foresee(leaf, last, states[0].load) is None  # back
    assert foresee(leaf, last, last.load) is None  # nowhere
