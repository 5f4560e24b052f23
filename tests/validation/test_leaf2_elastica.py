"""The exact unit against the elastica, against its own energy, and against published figures.

A cantilever under a force square to its end: with v the angle left to the end,
EI/2 (dv/ds)² = F sin v, so length and place of the end are integrals over v alone. With the place
of the roller that is one equation for the bend angle; nothing is shared with the beam's solver.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from leaf2_cases import DEGREE, INBOARD, LEAVES, MM, PAPER_LEAF, PAPER_LEVER, PAPER_TURN
from scipy.optimize import brentq

from springcad.kinds.leaf_2dof import paper_unit as paper
from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.kinds.leaf_2dof.unit import bent_line, rest_stiffness, stroke

BOTH = pytest.mark.parametrize("lever", [PAPER_LEVER, INBOARD], ids=lambda lever: lever.clamp)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def elastica_end(bend: float) -> np.ndarray:
    """Length, x and y of the end, times √(2F/EI); v = q² takes the root out of the integrals."""
    q = 0.5 * np.sqrt(bend) * (NODES + 1.0)
    weight = WEIGHTS * np.sqrt(bend) * q / np.sqrt(np.sin(q**2))
    return np.array([weight.sum(), weight @ np.cos(bend - q**2), weight @ np.sin(bend - q**2)])


def elastica(
    leaf: Leaf, lever: Lever, length: float, turn: float, offset: float
) -> dict[str, float]:
    """One leaf whose centre line is ``offset`` from the centre of the roller."""
    side = 1.0 if lever.clamp == "outboard" else -1.0
    R = lever.radius

    def contact(bend: float) -> tuple[float, float]:
        x = length + side * R * (1 - np.cos(turn)) - offset * np.sin(bend)
        return x, R * np.sin(turn) + offset * (np.cos(bend) - 1)

    def miss(bend: float) -> float:
        (x, y), (_, end_x, end_y) = contact(bend), elastica_end(bend)
        return y * end_x - x * end_y

    bend = brentq(miss, 1e-6, 1.4, xtol=1e-14)
    arc, end_x, _ = elastica_end(bend)
    scale = end_x / contact(bend)[0]
    force = 0.5 * leaf.bending_stiffness * scale**2
    moment = leaf.bending_stiffness * scale * np.sqrt(np.sin(bend))
    return {
        "torque": force * R * np.cos(turn + side * bend),
        "bend_angle": bend,
        "station": arc / scale,
        "bending_stress": 6 * moment / (leaf.width * leaf.thickness**2),
    }


def test_the_torque_of_the_paper_s_longest_leaf() -> None:
    """0.34095 N m by the elastica with the centre line at r: 5.6 % below Eq. 14."""
    found = LEAVES * elastica(PAPER_LEAF, PAPER_LEVER, 45 * MM, 14.8295 * DEGREE, 5 * MM)["torque"]
    assert found == pytest.approx(0.34095, rel=2e-5)
    linear = LEAVES * paper.torque(PAPER_LEAF, PAPER_LEVER, 45 * MM, 14.8295 * DEGREE)
    assert found / float(linear) - 1 == pytest.approx(-0.056, abs=5e-4)
    # The unit has its centre line at r + b/2; with a roller less by b/2 it is the same.
    lever = replace(PAPER_LEVER, roller_radius=4.7 * MM)
    unit = stroke(PAPER_LEAF, lever, 45 * MM, 14.8295 * DEGREE)
    assert LEAVES * float(unit.torque) == pytest.approx(0.34095, rel=2e-4)


@BOTH
@pytest.mark.parametrize(("length", "degrees"), [(10, 3.0), (20, 8.0), (45, 14.83), (45, 25.0)])
def test_a_thin_leaf_is_an_elastica(lever: Lever, length: float, degrees: float) -> None:
    """Shear and stretch go with (b/L)²: for b = L/1000 they are below 1e-5."""
    leaf = replace(PAPER_LEAF, thickness=length * MM / 1000)
    offset = lever.roller_radius + 0.5 * leaf.thickness
    found = stroke(leaf, lever, length * MM, degrees * DEGREE)
    expected = elastica(leaf, lever, length * MM, degrees * DEGREE, offset)
    assert float(found.torque) == pytest.approx(expected["torque"], rel=1e-5)
    assert float(found.bend_angle) == pytest.approx(expected["bend_angle"], rel=1e-5)
    assert float(found.station) == pytest.approx(expected["station"], rel=1e-5)
    # The stress of the unit contains the pull along the leaf, about b/6L of the bending.
    assert float(found.stress) == pytest.approx(expected["bending_stress"], rel=2e-4)


@pytest.mark.parametrize(
    ("lever", "length", "turns", "per_cent", "rounding"),
    [
        (PAPER_LEVER, 45, (3.71, 7.415, 14.83), (1.6, 1.2, -5.6), 0.05),
        (PAPER_LEVER, 35, (2.87, 5.74, 11.48), (1.9, 2.0, -2.9), 0.05),
        (PAPER_LEVER, 10, (0.815, 1.63, 3.26), (6, 12, 21), 0.5),
        (INBOARD, 45, (3.71, 7.415, 14.83), (3.1, 7.1, 18.4), 0.06),
    ],
)
def test_how_far_the_paper_s_torque_is_off(
    lever: Lever,
    length: float,
    turns: tuple[float, ...],
    per_cent: tuple[float, ...],
    rounding: float,
) -> None:
    """As another implementation of the elastica found with the centre line at r.

    The ratio does not depend on the thickness: a thin leaf keeps shear out of it.
    """
    leaf = replace(PAPER_LEAF, thickness=length * MM / 1000)
    thinner = replace(lever, roller_radius=lever.roller_radius - 0.5 * leaf.thickness)
    angles = np.array(turns) * DEGREE
    exact = stroke(leaf, thinner, length * MM, angles).torque
    linear = paper.torque(leaf, lever, length * MM, angles)
    np.testing.assert_allclose(100 * (exact / linear - 1), per_cent, atol=rounding, rtol=0)


@BOTH
def test_energy_is_the_work_of_the_torque(lever: Lever) -> None:
    """The torque is found from forces, the energy from the strains of the leaf."""
    lengths, ends = np.array([10, 25, 45]) * MM, np.array([4.0, 12.0, 20.0]) * DEGREE
    nodes, weights = np.polynomial.legendre.leggauss(16)
    angles = 0.5 * ends[:, None] * (nodes + 1)
    work = stroke(PAPER_LEAF, lever, lengths[:, None], angles).torque @ weights * 0.5 * ends
    energy = stroke(PAPER_LEAF, lever, lengths, ends).energy
    np.testing.assert_allclose(energy, work, rtol=1e-11)


@BOTH
def test_stiffness_is_the_slope_of_the_torque(lever: Lever) -> None:
    lengths, angles, h = np.array([10, 25, 45]) * MM, np.array([3.0, 8.0, 14.0]) * DEGREE, 1e-3
    steps = angles + h * np.array([[-2], [-1], [1], [2]])
    torque = stroke(PAPER_LEAF, lever, lengths, steps).torque
    slope = (torque[0] - 8 * torque[1] + 8 * torque[2] - torque[3]) / (12 * h)
    found = stroke(PAPER_LEAF, lever, lengths, angles).stiffness
    np.testing.assert_allclose(found, slope, rtol=1e-7)


@BOTH
def test_stiffness_at_rest_is_that_of_a_short_cantilever(lever: Lever) -> None:
    """The migration of the contact and the clamp's side do not matter yet; shear does, 0.3 % at
    10 mm."""
    lengths = np.array([5, 10, 45]) * MM
    found = stroke(PAPER_LEAF, lever, lengths, 0.0)
    np.testing.assert_allclose(
        found.stiffness, rest_stiffness(PAPER_LEAF, lever, lengths), rtol=1e-8
    )
    np.testing.assert_allclose(found.station, lengths, rtol=1e-12)
    bending = paper.stiffness(PAPER_LEAF, lever, lengths, 0.0)
    shear = bending / found.stiffness - 1
    np.testing.assert_allclose(shear, 0.78 * (0.6 * MM / lengths) ** 2, atol=1e-8)


@BOTH
def test_both_directions_are_alike(lever: Lever) -> None:
    ahead, back = (stroke(PAPER_LEAF, lever, 30 * MM, sign * 0.15) for sign in (1, -1))
    assert float(back.torque) == -float(ahead.torque)
    assert float(back.stiffness) == float(ahead.stiffness)
    assert float(back.energy) == float(ahead.energy)


def test_scaling_the_unit_scales_its_torque_by_the_cube() -> None:
    """Same material and angles, all lengths twice: same stress, eight times the torque."""
    larger = replace(PAPER_LEAF, width=20 * MM, thickness=1.2 * MM)
    lever = Lever(50 * MM, 10 * MM, "outboard")
    small = stroke(PAPER_LEAF, PAPER_LEVER, 20 * MM, 0.1)
    large = stroke(larger, lever, 40 * MM, 0.1)
    assert float(large.torque) == pytest.approx(8 * float(small.torque), rel=1e-11)
    assert float(large.stress) == pytest.approx(float(small.stress), rel=1e-11)


@BOTH
@pytest.mark.parametrize("angle", [PAPER_TURN, -PAPER_TURN])
def test_the_bent_leaf_is_held_at_its_clamp_and_touches_the_roller(
    lever: Lever, angle: float
) -> None:
    length, offset = 45 * MM, 5.3 * MM
    line = bent_line(PAPER_LEAF, lever, length, angle, np.linspace(0, 60 * MM, 6001))
    clamp = 25 * MM + (length if lever.clamp == "outboard" else -length)
    np.testing.assert_allclose(line[0], [clamp, np.sign(angle) * offset], atol=1e-12)
    centre = 25 * MM * np.array([np.cos(angle), np.sin(angle)])
    distance = np.hypot(*(line - centre).T)
    assert distance.min() == pytest.approx(offset, rel=1e-5)
    station = float(stroke(PAPER_LEAF, lever, length, angle).station)
    assert np.argmin(distance) * 0.01 * MM == pytest.approx(station, abs=0.1 * MM)


def test_a_leaf_bent_beyond_reason_is_refused() -> None:
    with pytest.raises(ArithmeticError):
        stroke(PAPER_LEAF, INBOARD, 5 * MM, 40 * DEGREE)
