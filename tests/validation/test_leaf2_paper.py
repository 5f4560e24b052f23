"""The numbers of paper 003, those that can be reproduced and those that cannot.

Yang et al., Design and analysis of a 2-DOF actuator with variable stiffness based on leaf springs,
J. Bionic Eng. 19 (2022). Section 10 x 0.6 mm, E 208 GPa, yield 726 MPa, R 25 mm, r 5 mm. The
columns of the table were computed independently; every figure is of two leaves.
"""

from __future__ import annotations

import numpy as np
import pytest
from leaf2_cases import (
    DEGREE,
    LEAVES,
    MM,
    PAPER_BEND,
    PAPER_LEAF,
    PAPER_LEVER,
    PAPER_TURN,
    YIELD,
)
from scipy.optimize import brentq

from springcad.kinds.leaf_2dof import paper_unit as paper

ROWS = np.array(
    [
        # L mm, K0, phi at 12.04 deg, M there, stress MPa there, phi at yield, M at yield
        (5.0, 1123.2, 1.63, 31.75, 5324, 0.22, 4.353),
        (7.5, 332.8, 2.44, 14.06, 3549, 0.50, 2.899),
        (10.0, 140.40, 3.26, 7.882, 2662, 0.89, 2.171),
        (12.5, 71.885, 4.08, 5.025, 2129, 1.39, 1.733),
        (15.0, 41.600, 4.89, 3.476, 1775, 2.00, 1.441),
        (17.5, 26.197, 5.71, 2.543, 1521, 2.72, 1.231),
        (20.0, 17.550, 6.53, 1.938, 1331, 3.56, 1.073),
        (22.5, 12.326, 7.35, 1.524, 1183, 4.50, 0.950),
        (25.0, 8.986, 8.17, 1.228, 1065, 5.56, 0.850),
        (30.0, 5.200, 9.82, 0.844, 887, 8.03, 0.699),
        (35.0, 3.275, 11.48, 0.613, 761, 10.95, 0.587),
        (40.0, 2.194, 13.15, 0.463, 665, 14.37, 0.500),
        (45.0, 1.541, 14.83, 0.361, 592, 18.31, 0.429),
        (50.0, 1.123, 16.52, 0.288, 532, 22.82, 0.368),
    ]
)


def is_rounded(found: np.ndarray, printed: np.ndarray, digit: object) -> bool:
    """Whether ``printed`` is ``found`` to its last digit."""
    return bool(np.all(np.abs(found - printed) <= 0.5001 * np.asarray(digit)))


def torque(length: object, angle: object) -> np.ndarray:
    return LEAVES * paper.torque(PAPER_LEAF, PAPER_LEVER, length, angle)


def energy(length: object, angle: object) -> np.ndarray:
    return LEAVES * paper.energy(PAPER_LEAF, PAPER_LEVER, length, angle)


def stress(length: object, angle: object) -> np.ndarray:
    return paper.stress(PAPER_LEAF, PAPER_LEVER, length, angle)


def test_deflection_limit_at_the_longest_leaf() -> None:
    """14.83 deg in the paper, from 12.04 deg; from the 12 deg that it starts with, 14.778."""
    found = paper.deflection_at_bend(PAPER_LEVER, 45 * MM, np.array([12.04, 12.0]) * DEGREE)
    np.testing.assert_allclose(found / DEGREE, [14.8295, 14.778], atol=5e-4)


def test_stiffness_at_rest_is_of_two_leaves() -> None:
    """Table 1 has 1.54 N m/rad; Eq. 16 gives half of it, for one leaf."""
    lengths = np.array([45, 35, 10, 5]) * MM
    found = LEAVES * paper.stiffness(PAPER_LEAF, PAPER_LEVER, lengths, 0.0)
    np.testing.assert_allclose(found, [1.54074, 3.27464, 140.400, 1123.2], rtol=2e-6)
    assert found[0] == pytest.approx(1.54, rel=5e-4)


def test_torque_and_stiffness_at_the_deflection_limit() -> None:
    assert float(torque(45 * MM, PAPER_TURN)) == pytest.approx(0.36103, rel=1e-5)
    found = LEAVES * float(paper.stiffness(PAPER_LEAF, PAPER_LEVER, 45 * MM, PAPER_TURN))
    assert found == pytest.approx(1.18638, rel=1e-5)


def test_the_whole_table_of_lengths() -> None:
    """Every column to its last digit."""
    lengths, k0, bent, bent_torque, bent_stress, yielded, yielded_torque = ROWS.T
    at = lengths * MM
    rest = LEAVES * paper.stiffness(PAPER_LEAF, PAPER_LEVER, at, 0.0)
    assert is_rounded(rest, k0, [0.1, 0.1, 0.01] + [1e-3] * 11)
    by_bend = paper.deflection_at_bend(PAPER_LEVER, at, PAPER_BEND)
    assert is_rounded(by_bend / DEGREE, bent, 0.01)
    assert is_rounded(torque(at, by_bend), bent_torque, [0.01] * 2 + [1e-3] * 12)
    assert is_rounded(stress(at, by_bend) / 1e6, bent_stress, 1.0)
    by_yield = paper.deflection_at_stress(PAPER_LEAF, PAPER_LEVER, at, YIELD)
    assert is_rounded(by_yield / DEGREE, yielded, 0.01)
    assert is_rounded(torque(at, by_yield), yielded_torque, 1e-3)


def test_energies_to_the_fixed_bend_angle() -> None:
    lengths = np.array([5, 10, 20, 35, 45]) * MM
    turns = paper.deflection_at_bend(PAPER_LEVER, lengths, PAPER_BEND)
    np.testing.assert_allclose(
        energy(lengths, turns), [0.452, 0.225, 0.112, 0.063, 0.049], atol=5e-4
    )


def test_a_fixed_bend_angle_breaks_the_yield_limit_on_short_leaves() -> None:
    """Fig. 7 goes down to 5 mm with 12.04 deg: below 36.7 mm that is beyond yield."""
    assert float(paper.least_length(PAPER_LEAF, PAPER_BEND, YIELD)) == pytest.approx(
        36.66 * MM, abs=0.01 * MM
    )


def test_stress_and_the_safety_factor_that_the_paper_does_not_tell() -> None:
    turn = paper.deflection_at_bend(PAPER_LEVER, 45 * MM, PAPER_BEND)
    found = float(stress(45 * MM, turn))
    assert found == pytest.approx(591.5e6, rel=1e-4)
    assert found * 1.22736 == pytest.approx(YIELD, rel=1e-5)


def test_sixty_newton_metres_are_far_beyond_yield() -> None:
    """They need a leaf of 3.64 mm bent to 12.04 deg, at ten times the yield strength; elastic
    leaves of the paper's range give 2.2 N m."""
    length = brentq(
        lambda at: torque(at, paper.deflection_at_bend(PAPER_LEVER, at, PAPER_BEND)) - 60.0,
        1 * MM,
        10 * MM,
    )
    assert length == pytest.approx(3.64 * MM, abs=0.005 * MM)
    assert stress(length, paper.deflection_at_bend(PAPER_LEVER, length, PAPER_BEND)) > 10 * YIELD
    by_yield = paper.deflection_at_stress(PAPER_LEAF, PAPER_LEVER, 10 * MM, YIELD)
    assert float(torque(10 * MM, by_yield)) == pytest.approx(2.171, abs=5e-4)


def test_the_energy_of_table_1_mixes_the_shortest_leaf_with_the_deflection_of_the_longest() -> None:
    """4.4 J is what 10 mm leaves would store at 14.83 deg, under 11 980 MPa."""
    assert float(energy(45 * MM, PAPER_TURN)) == pytest.approx(0.048711, rel=1e-5)
    assert float(energy(10 * MM, PAPER_TURN)) == pytest.approx(4.43876, rel=1e-5)
    assert float(stress(10 * MM, PAPER_TURN)) == pytest.approx(11980e6, rel=1e-3)


def test_no_cantilever_of_constant_section_stores_more_than_a_ninth() -> None:
    """At yield in the clamp, U = σ²/2E · V/9: 0.038 J per leaf of 45 mm."""
    turn = paper.deflection_at_stress(PAPER_LEAF, PAPER_LEVER, 45 * MM, YIELD)
    force = paper.force(PAPER_LEAF, PAPER_LEVER, 45 * MM, turn)
    bent = force**2 * (45 * MM) ** 3 / (6 * PAPER_LEAF.bending_stiffness)
    volume = PAPER_LEAF.width * PAPER_LEAF.thickness * 45 * MM
    assert float(bent) == pytest.approx(YIELD**2 / (2 * 208e9) * volume / 9, rel=1e-12)
    assert float(bent) == pytest.approx(0.038, abs=5e-5)
