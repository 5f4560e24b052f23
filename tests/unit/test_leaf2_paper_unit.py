"""Paper 003's formulas for one leaf and its roller: with each other, and with calculus."""

from __future__ import annotations

import numpy as np
import pytest
from leaf2_cases import DEGREE, MM, PAPER_LEAF, PAPER_LEVER, YIELD
from scipy.integrate import quad

from springcad.kinds.leaf_2dof import paper_unit as paper

ANGLES = np.array([-0.3, -0.1, 0.05, 0.2, 0.5])
LENGTH = 30 * MM


def test_the_section_has_the_bending_stiffness_of_the_paper() -> None:
    """I = 0.18 mm⁴, EI = 37 440 N mm²."""
    assert PAPER_LEAF.bending_stiffness == pytest.approx(37440e-6, rel=1e-12)


def test_stiffness_is_the_slope_of_the_torque_on_both_sides() -> None:
    """Eq. 16 follows from Eq. 14 with |φ|; as printed it is wrong for negative angles."""
    h = 1e-5
    ahead, behind = (
        paper.torque(PAPER_LEAF, PAPER_LEVER, LENGTH, ANGLES + step) for step in (h, -h)
    )
    slope = (ahead - behind) / (2 * h)
    found = paper.stiffness(PAPER_LEAF, PAPER_LEVER, LENGTH, ANGLES)
    np.testing.assert_allclose(found, slope, rtol=1e-8)


def test_energy_is_the_work_of_the_torque() -> None:
    for angle in ANGLES:
        work, _ = quad(lambda x: float(paper.torque(PAPER_LEAF, PAPER_LEVER, LENGTH, x)), 0, angle)
        found = float(paper.energy(PAPER_LEAF, PAPER_LEVER, LENGTH, angle))
        assert found == pytest.approx(work, rel=1e-10)


def test_limits_are_where_bend_angle_and_stress_reach_them() -> None:
    lengths = np.array([10, 25, 45]) * MM
    bend = 8.0 * DEGREE
    at_bend = paper.deflection_at_bend(PAPER_LEVER, lengths, bend)
    np.testing.assert_allclose(paper.bend_angle(PAPER_LEVER, lengths, at_bend), bend, rtol=1e-12)
    at_stress = paper.deflection_at_stress(PAPER_LEAF, PAPER_LEVER, lengths, YIELD)
    stress = paper.stress(PAPER_LEAF, PAPER_LEVER, lengths, at_stress)
    np.testing.assert_allclose(stress, YIELD, rtol=1e-12)


def test_the_least_length_for_a_bend_angle_is_where_bend_and_stress_bind_together() -> None:
    bend = 10.0 * DEGREE
    least = paper.least_length(PAPER_LEAF, bend, YIELD)
    by_bend = paper.deflection_at_bend(PAPER_LEVER, least, bend)
    by_stress = paper.deflection_at_stress(PAPER_LEAF, PAPER_LEVER, least, YIELD)
    assert float(by_bend) == pytest.approx(float(by_stress), rel=1e-12)


def test_what_no_angle_reaches_is_told_as_a_quarter_turn() -> None:
    long = 400 * MM
    assert paper.deflection_at_bend(PAPER_LEVER, long, 0.2) == np.pi / 2
    assert paper.deflection_at_stress(PAPER_LEAF, PAPER_LEVER, long, YIELD) == np.pi / 2


def test_torque_peaks_at_39_degrees_whatever_the_length() -> None:
    peak = 0.5 * np.arctan2(PAPER_LEVER.radius, PAPER_LEVER.roller_radius)
    assert peak / DEGREE == pytest.approx(39.35, abs=0.005)
    stiffness = paper.stiffness(PAPER_LEAF, PAPER_LEVER, np.array([10, 45]) * MM, peak)
    np.testing.assert_allclose(stiffness, 0.0, atol=1e-12)
