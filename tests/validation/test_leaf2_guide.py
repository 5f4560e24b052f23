"""How firmly a guide holds a leaf: linear finite elements of the leaf between its two faces.

By how much the leaf seems longer than it is, found from leaves of two lengths so that what happens
at the loaded end drops out.
"""

from __future__ import annotations

import numpy as np
import pytest
from leaf2_cases import MM, PAPER_LEAF, PAPER_LEVER
from scipy.optimize import brentq

from springcad.kinds.leaf_2dof.unit import SMOOTH_GUIDE, rest_stiffness, rest_stiffness_range
from springcad.mechanics.fem.assembly import Sheet, prepare_solid
from springcad.mechanics.fem.blocks import (
    graded,
    join,
    spaced,
    straight,
    transfinite,
    with_middles,
)
from springcad.mechanics.fem.constraints import Equations, prescribe, solve_constraints
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, prepare_model
from springcad.mechanics.fem.newton import linear_solution

POISSON, GUIDE = 0.3, 4.0  # thickness and E are 1; the guide is four thicknesses long


def strip(length: float) -> Mesh:
    """The guide ends at x = 0, where one line of nodes lies."""
    inside = -spaced(np.linspace(0, GUIDE, 999), np.linspace(0.05, 0.5, 999))[::-1]
    sizes = np.minimum(0.5, 0.05 + 0.3 * np.linspace(0, length, 999))
    outside = spaced(np.linspace(0, length, 999), sizes)
    x = with_middles(np.concatenate([inside, outside[1:]]))
    low, high = (np.column_stack([x, np.full_like(x, y)]) for y in (0.0, 1.0))
    across = graded(8)
    ends = (straight(low[i], high[i], across) for i in (0, -1))
    return join(
        {"strip": transfinite(low, high, *ends)},
        {name: [("strip", name)] for name in ("south", "north", "east", "west")},
    )


def compliance(length: float, can_slide: bool) -> float:
    mesh = strip(length)
    faces = np.concatenate([mesh.node_sets["south"], mesh.node_sets["north"]])
    faces = faces[mesh.nodes[faces, 0] < 1e-9]
    held: list[Equations] = [prescribe(faces, components=(1,) if can_slide else (0, 1))]
    if can_slide:
        held.append(prescribe(mesh.node_sets["west"], components=(0,)))
    model = prepare_model(
        prepare_solid(mesh, Sheet(1.0, POISSON, 1.0)), solve_constraints(mesh.unknowns, *held)
    )
    force = np.zeros(mesh.unknowns)
    end = mesh.node_sets["east"]
    force[2 * end[len(end) // 2] + 1] = 1.0
    return 2.0 * linear_solution(model, Load(force, model.constraints.constants)).energy


def beam(length: float) -> float:
    """Clamped cantilever with I = 1/12 and shear."""
    return 4.0 * length**3 + length * 2.0 * (1.0 + POISSON) * 6.0 / 5.0


@pytest.mark.parametrize(("can_slide", "longer"), [(True, SMOOTH_GUIDE), (False, 0.13)])
def test_by_how_much_a_leaf_in_a_guide_seems_longer(can_slide: bool, longer: float) -> None:
    short, long = 10.0, 20.0
    more = compliance(long, can_slide) - compliance(short, can_slide)
    found = brentq(lambda c: beam(long + c) - beam(short + c) - more, -0.5, 1.0)
    assert found == pytest.approx(longer, abs=0.01)


def test_what_the_guide_and_a_wide_leaf_make_of_the_stiffness() -> None:
    """At 10 mm the paper's unit lies between -10 % and +10 %, at 45 mm between -2 % and +10 %."""
    lengths = np.array([10, 45]) * MM
    rest = rest_stiffness(PAPER_LEAF, PAPER_LEVER, lengths)
    least, greatest = rest_stiffness_range(PAPER_LEAF, PAPER_LEVER, lengths)
    np.testing.assert_allclose(least / rest - 1, [-0.0958, -0.0225], atol=1e-4)
    np.testing.assert_allclose(greatest / rest - 1, 0.0989, atol=1e-4)
