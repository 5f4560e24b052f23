"""Clearance to the neighbouring flexure: known distances, sign through a crossing, derivatives."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from springcad.geometry.neighbours import neighbour_gaps, zone_gaps, zone_index, zone_minimum

RADIUS, COUNT = 31e-3, 24
X = 25e-3 * (1.0 - np.linspace(1.0, 0.0, 81) ** 2)
HALF = np.maximum(1.55e-3 * np.sqrt(1.0 - X / 25e-3), 0.2e-3)


def wave(amplitude):
    return amplitude * np.sin(3.0 * math.pi * X / 25e-3) ** 2


def test_straight_tips_are_a_chord_apart():
    gaps = neighbour_gaps(X, np.zeros_like(X), HALF, RADIUS, COUNT)
    chord = 2.0 * 6e-3 * math.sin(math.pi / COUNT)
    assert gaps.gap[-1] == pytest.approx(chord - 0.4e-3, abs=5e-6)
    assert gaps.gap.min() == gaps.gap[-1]


def test_thickness_is_taken_from_both_sides():
    y = wave(1e-3)
    thin, thick = (neighbour_gaps(X, y, half, RADIUS, COUNT) for half in (0 * X, 0 * X + 1e-4))
    np.testing.assert_allclose(thick.gap, thin.gap - 2e-4, atol=1e-18)


def test_gap_falls_without_end_while_flexures_are_pushed_through_each_other():
    smallest = [
        neighbour_gaps(X, wave(a), HALF, RADIUS, COUNT).gap.min() for a in np.linspace(0, 8e-3, 33)
    ]
    assert np.all(np.diff(smallest[2:]) < 0.0)
    assert smallest[0] > 1e-3
    assert smallest[-1] < -1e-3


def test_both_neighbours_are_the_same_distance_away():
    """Mirroring a flexure exchanges its neighbours."""
    one, other = (
        neighbour_gaps(X, y, HALF, RADIUS, COUNT).gap.min() for y in (wave(2e-3), -wave(2e-3))
    )
    assert other == pytest.approx(one, abs=1e-15)


@settings(max_examples=30, deadline=None)
@given(st.floats(-5e-3, 5e-3), st.floats(-3e-3, 3e-3))
def test_no_pair_is_closer_than_the_smallest_gap(first, second):
    y = first * np.sin(5.0 * X / 25e-3) + wave(second)
    gaps = neighbour_gaps(X, y, HALF, RADIUS, COUNT)
    turn, hub = np.exp(2j * math.pi / COUNT), RADIUS
    centre = X + 1j * y
    pairs = np.abs(centre[:, None] - ((centre - hub) * turn + hub)) - HALF[:, None] - HALF
    unsigned = gaps.gap > -HALF - HALF[gaps.partner]
    np.testing.assert_allclose(gaps.gap[unsigned], pairs.min(axis=1)[unsigned], atol=1e-15)
    assert np.all(gaps.gap <= pairs.min(axis=1) + 1e-15)


@pytest.mark.parametrize("amplitude", [1e-3, 3e-3, 6e-3])
def test_derivatives_of_the_zone_minima(amplitude):
    """At 6 mm the flexures cross: the derivative still points the way out."""
    y, zones, step = wave(amplitude), zone_index(X.size, 10), 1e-9
    smallest = zone_gaps(neighbour_gaps(X, y, HALF, RADIUS, COUNT), zones)
    for i, j, own, other in zip(
        smallest.point, smallest.partner, smallest.own, smallest.other, strict=True
    ):
        for axis, unit in enumerate(np.eye(2)):
            moved = []
            for side in (step, -step):
                points = np.column_stack((X, y))
                points[i] += side * unit
                moved.append(neighbour_gaps(*points.T, HALF, RADIUS, COUNT).gap[i])
            expected = own[axis] + (other[axis] if i == j else 0.0)
            assert (moved[0] - moved[1]) / (2 * step) == pytest.approx(expected, abs=1e-6)
            if i == j:
                continue
            moved = []
            for side in (step, -step):
                points = np.column_stack((X, y))
                points[j] += side * unit
                moved.append(neighbour_gaps(*points.T, HALF, RADIUS, COUNT).gap[i])
            assert (moved[0] - moved[1]) / (2 * step) == pytest.approx(other[axis], abs=1e-6)


@pytest.mark.parametrize(("points", "zones"), [(81, 10), (121, 10), (12, 12), (7, 3)])
def test_zones_cover_every_point_once_in_order(points, zones):
    index = zone_index(points, zones)
    runs = [np.unique(row) for row in index]
    assert np.concatenate(runs).tolist() == list(range(points))
    assert max(map(len, runs)) - min(map(len, runs)) <= 1


def test_zone_minimum_is_the_smallest_of_its_zone():
    values = np.array([3.0, 1.0, 2.0, 5.0, 4.0, 6.0, 0.0])
    assert zone_minimum(values, zone_index(7, 3)).tolist() == [1, 2, 6]
