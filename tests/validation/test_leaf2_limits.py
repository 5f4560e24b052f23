"""How far the paper's unit may be bent: exact unit against stress, bend angle and torque peak."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from leaf2_cases import DEGREE, INBOARD, LEAVES, MM, PAPER_BEND, PAPER_LEAF, PAPER_LEVER, YIELD

from springcad.kinds.leaf_2dof import paper_unit as paper
from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.kinds.leaf_2dof.limits import reach, useful_stroke
from springcad.kinds.leaf_2dof.unit import curvature_parameter, stroke

LENGTHS = np.array([5, 10, 20, 35, 45, 50]) * MM


def test_the_deflection_at_a_limit_reaches_it() -> None:
    lengths = LENGTHS[:5]
    found = reach(PAPER_LEAF, PAPER_LEVER, lengths, YIELD, PAPER_BEND)
    at_stress = stroke(PAPER_LEAF, PAPER_LEVER, lengths, found.by_stress)
    np.testing.assert_allclose(at_stress.stress, YIELD, rtol=1e-9)
    at_bend = stroke(PAPER_LEAF, PAPER_LEVER, lengths, found.by_bend)
    np.testing.assert_allclose(at_bend.bend_angle, PAPER_BEND, rtol=1e-9)


def test_stress_binds_short_leaves_and_the_bend_angle_long_ones() -> None:
    """The paper lets all lengths bend by 12.04 deg; below about 37 mm the sheet yields before."""
    found = reach(PAPER_LEAF, PAPER_LEVER, LENGTHS, YIELD, PAPER_BEND)
    assert found.binding == ("stress",) * 4 + ("bend angle",) * 2
    np.testing.assert_allclose(
        found.unit.angle / DEGREE, [0.22, 0.86, 3.46, 11.04, 14.89, 16.64], atol=5e-3
    )


def test_what_yield_allows_of_the_sixty_newton_metres() -> None:
    """4.49 N m at 5 mm and 2.24 N m at 10 mm, 3 % above the linear beam: the contact comes nearer
    to the clamp."""
    found = reach(PAPER_LEAF, PAPER_LEVER, np.array([5, 10]) * MM, YIELD)
    np.testing.assert_allclose(LEAVES * found.unit.torque, [4.485, 2.236], atol=5e-4)
    by_yield = paper.deflection_at_stress(PAPER_LEAF, PAPER_LEVER, 5 * MM, YIELD)
    linear = LEAVES * float(paper.torque(PAPER_LEAF, PAPER_LEVER, 5 * MM, by_yield))
    assert LEAVES * float(found.unit.torque[0]) / linear == pytest.approx(1.03, abs=0.001)


@pytest.mark.parametrize("lever", [PAPER_LEVER, INBOARD], ids=lambda lever: lever.clamp)
def test_elastic_energy_is_a_ninth_of_what_the_sheet_could_bear(lever: Lever) -> None:
    """U = σ²/2E · V/9 of the part up to the contact, for a linear beam; shear (short leaves) and
    large deflection (long ones) add 1 %. So 4.4 J would need over a hundred leaves."""
    unit = reach(PAPER_LEAF, lever, LENGTHS, YIELD).unit
    volume = PAPER_LEAF.width * PAPER_LEAF.thickness * unit.station
    share = unit.energy / (unit.stress**2 / (2 * PAPER_LEAF.elastic_modulus) * volume)
    np.testing.assert_allclose(9 * share, 1.0, atol=0.012)
    assert np.all(100 * unit.energy < 4.4)


def test_small_limits_are_those_of_the_linear_beam() -> None:
    at = 30 * MM
    (exact,) = reach(PAPER_LEAF, PAPER_LEVER, at, 1e6).by_stress
    linear = paper.deflection_at_stress(PAPER_LEAF, PAPER_LEVER, at, 1e6)
    assert float(exact) == pytest.approx(float(linear), rel=2e-3)


def test_the_torque_peaks_where_stiffness_vanishes() -> None:
    """At 23.9 deg for the longest leaf held outboard; Eq. 14 has 39.35 deg for all lengths."""
    end = useful_stroke(PAPER_LEAF, PAPER_LEVER, LENGTHS[4:])
    rest = stroke(PAPER_LEAF, PAPER_LEVER, LENGTHS[4:], 0.0).stiffness
    found = stroke(PAPER_LEAF, PAPER_LEVER, LENGTHS[4:], end)
    np.testing.assert_allclose(found.stiffness / rest, 0.0, atol=1e-7)
    assert end[0] / DEGREE == pytest.approx(23.88, abs=0.01)


def test_held_inboard_the_torque_goes_on_rising() -> None:
    end = useful_stroke(PAPER_LEAF, INBOARD, 45 * MM)
    assert float(end) == pytest.approx(60 * DEGREE)
    assert float(stroke(PAPER_LEAF, INBOARD, 45 * MM, end).stiffness) > 0.0


def test_limits_that_are_not_reached_are_infinite_and_geometry_binds() -> None:
    found = reach(PAPER_LEAF, PAPER_LEVER, 120 * MM, YIELD)
    assert found.by_stress == np.inf
    assert found.by_bend == np.inf
    assert found.binding == ("geometry",)
    np.testing.assert_array_equal(found.unit.angle, found.by_geometry)


@pytest.mark.parametrize("clamp", ["outboard", "inboard"])
@pytest.mark.parametrize("radius", [5 * MM, 100 * MM])
@pytest.mark.parametrize("roller", [0.5 * MM, 20 * MM])
def test_a_limit_is_found_for_leaves_and_rollers_of_any_proportion(
    clamp: str, radius: float, roller: float
) -> None:
    leaf = Leaf(10 * MM, 1 * MM, 2.6e9, 0.35)
    lever = Lever(radius, roller, "outboard" if clamp == "outboard" else "inboard")
    found = reach(leaf, lever, np.array([1.5, 20, 200]) * MM, 90e6)
    assert np.all(found.unit.angle > 0.0)
    assert np.all(found.unit.torque > 0.0)
    assert np.all(found.unit.stress <= 90e6 * (1 + 1e-9))


def test_how_much_of_a_plate_the_paper_s_leaf_is() -> None:
    """a²κ/b = 2 a²σ/(E b²): 1.9 at 726 MPa, so it is nearer to a beam than to a plate."""
    assert float(curvature_parameter(PAPER_LEAF, YIELD)) == pytest.approx(1.939, abs=5e-4)
    wider = replace(PAPER_LEAF, width=2 * PAPER_LEAF.width)
    assert float(curvature_parameter(wider, YIELD)) == pytest.approx(4 * 1.939, rel=1e-3)
