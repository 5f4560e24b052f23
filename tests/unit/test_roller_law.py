"""Laws of a roller cam: torque, energy and stiffness belong together, and none of them falls."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from springcad.kinds.interpolation import rising_curve
from springcad.kinds.target_law import (
    OVERRUN,
    Law,
    Rise,
    exponential,
    law_of,
    polynomial,
    sampled,
    stiffness_polynomial,
    stiffness_table,
    table,
)

Floats = NDArray[np.float64]
DEGREE = np.pi / 180.0
FULL = 1.9 * DEGREE
PAPER = exponential(0.15, DEGREE)
"""tau = 3/20 (10^beta - 1) N*m with beta in degrees, paper 001, section 4.3."""


def points_of(law: Rise, count: int) -> Floats:
    """Points of a law, as a table would have them."""
    x = np.linspace(0.0, FULL, count)
    return np.column_stack([x, law.torque(x)])


PLATEAU = np.array([[0.0, 0.0], [0.5, 1.0], [1.0, 1.02], [1.5, 1.04], [1.9, 4.0]]) * [DEGREE, 1.0]
LAWS = {
    "exponential": PAPER,
    "linear": polynomial((350.0,), FULL),
    "quadratic": polynomial((0.0, 1e4), FULL),
    "softening": polynomial((400.0, -3e3), FULL),
    "table, cubic": table(points_of(PAPER, 11)),
    "table, quintic": table(PLATEAU),
    "table of two": table(np.array([[0.0, 0.0], [FULL, 8.0]])),
    "stiffness polynomial": stiffness_polynomial((100.0, 2e3, 5e4), FULL),
    "stiffness table": stiffness_table(PLATEAU * [1.0, 100.0] + [0.0, 50.0]),
    "stiffness of two": stiffness_table(np.array([[0.0, 100.0], [FULL, 20.0]])),
}


def test_oracle_a03_of_paper_001() -> None:
    """11.765 N*m and 84.2 N*mm at 1.9 deg; the paper says 12 N*m, which is 1.9085 deg."""
    at = np.array([0.0, FULL])
    assert PAPER.torque(at)[1] == pytest.approx(11.76492, rel=1e-6)
    assert PAPER.energy(at)[1] == pytest.approx(84.20239e-3, rel=1e-6)
    assert PAPER.stiffness(at) * DEGREE == pytest.approx([0.345388, 27.43513], rel=1e-6)
    assert PAPER.torque(np.array([1.9085 * DEGREE]))[0] == pytest.approx(12.0, rel=1e-4)


@pytest.mark.parametrize("name", LAWS)
def test_torque_is_the_slope_of_energy_and_stiffness_that_of_torque(name: str) -> None:
    """Simpson's rule over short steps, beyond the end of the law too."""
    law = LAWS[name]
    x = np.linspace(0.0, (1.0 + OVERRUN) * FULL, 4001)
    middle = 0.5 * (x[1:] + x[:-1])
    for whole, slope in ((law.energy, law.torque), (law.torque, law.stiffness)):
        steps = np.diff(x) / 6.0 * (slope(x[1:]) + 4.0 * slope(middle) + slope(x[:-1]))
        assert np.cumsum(steps) == pytest.approx(whole(x[1:]), rel=1e-6, abs=1e-10 * whole(x)[-1])


@pytest.mark.parametrize("name", LAWS)
def test_a_law_begins_at_nothing_and_goes_on_rising_beyond_its_end(name: str) -> None:
    law = LAWS[name]
    x = np.linspace(0.0, (1.0 + OVERRUN) * FULL, 2001)
    assert law.torque(x)[0] == law.energy(x)[0] == 0.0
    assert np.diff(law.torque(x)).min() > 0.0
    assert np.isfinite(law.torque(x)).all()


@pytest.mark.parametrize("name", LAWS)
def test_the_stiffness_has_no_jump(name: str) -> None:
    """Steps of the stiffness vanish with the step of the angle: the torque is C1, here even C2."""
    law = LAWS[name]
    jumps = [
        np.abs(np.diff(law.stiffness(np.linspace(0.0, (1.0 + OVERRUN) * FULL, count)))).max()
        for count in (2001, 20001)
    ]
    assert jumps[1] < 0.15 * jumps[0] or jumps[0] < 1e-9 * law.stiffness(np.zeros(1))[0]


def test_a_table_is_met_at_its_points() -> None:
    for points in (points_of(PAPER, 11), PLATEAU):
        law = table(points)
        assert law.torque(points[:, 0]) == pytest.approx(points[:, 1], rel=1e-12, abs=1e-12)
        assert law.points is points


def test_the_user_is_told_how_points_are_joined() -> None:
    assert "not-a-knot cubic spline (C2)" in table(points_of(PAPER, 11)).words
    assert "monotone quintic (C2)" in table(PLATEAU).words
    assert "torque C2" in LAWS["stiffness table"].words


def test_eleven_points_of_the_paper_s_law_store_its_energy() -> None:
    """Notes of the trial: energy + 0.01 %, initial stiffness + 2 % with the cubic spline."""
    law, end = table(points_of(PAPER, 11)), np.array([FULL])
    assert law.energy(end)[0] == pytest.approx(PAPER.energy(end)[0], rel=2e-4)
    assert law.stiffness(np.zeros(1))[0] == pytest.approx(PAPER.stiffness(np.zeros(1))[0], rel=0.03)


def test_the_cubic_spline_converges_with_order_four() -> None:
    x = np.linspace(0.0, FULL, 1001)
    errors = [
        np.abs(table(points_of(PAPER, count)).torque(x) - PAPER.torque(x)).max()
        for count in (21, 41, 81)
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.3)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(4.0, abs=0.2)


steps = st.lists(
    st.tuples(st.floats(1e-3, 1.0), st.one_of(st.just(0.0), st.floats(1e-4, 1.0))),
    min_size=2,
    max_size=12,
)


@given(steps)
def test_no_curve_through_rising_points_falls(given_steps: list[tuple[float, float]]) -> None:
    """Whatever the points: met, nowhere falling, and with a continuous second derivative."""
    x, y = np.concatenate([np.zeros((1, 2)), np.cumsum(given_steps, axis=0)]).T
    curve, _ = rising_curve(x, y)
    mean = max(y[-1], 1e-300) / x[-1]
    dense = np.concatenate([np.linspace(a, b, 50) for a, b in pairwise(x)])
    assert curve(x) == pytest.approx(y, abs=1e-12 * max(y[-1], 1.0))
    assert curve(dense, 1).min() >= -1e-8 * mean
    inner = x[1:-1]
    steepest = np.abs(curve(dense, 2)).max()
    width = 1e-9 * np.diff(x).min()
    jump = np.abs(curve(inner + width, 2) - curve(inner - width, 2))
    assert jump.max() <= 1e-5 * steepest + 1e-9


@given(st.floats(0.0, 0.9), st.integers(1, 5), st.sampled_from(sorted(LAWS)))
def test_dead_zone_and_share(dead: float, groups: int, name: str) -> None:
    """No torque up to the end of the dead zone, then the law, moved and shared."""
    rise, rest = LAWS[name], dead * DEGREE
    law = law_of(rise, FULL + rest, dead_zone=rest, share=1.0 / groups)
    angle = np.linspace(0.0, FULL + rest, 101)
    x = np.maximum(angle - rest, 0.0)
    assert groups * law.torque(angle) == pytest.approx(rise.torque(x), rel=1e-12, abs=1e-15)
    assert groups * law.energy(angle) == pytest.approx(rise.energy(x), rel=1e-12, abs=1e-15)
    assert (law.torque(angle[angle <= rest]) == 0.0).all()
    assert law.stiffness(np.array([rest]))[0] * groups == pytest.approx(
        rise.stiffness(np.zeros(1))[0]
    )


def test_points_of_a_law_are_over_the_angle_from_rest() -> None:
    law: Law = law_of(table(PLATEAU), 2.2 * DEGREE, dead_zone=0.3 * DEGREE, share=0.5)
    assert law.points[0] == pytest.approx([0.3 * DEGREE, 0.0])
    assert law.torque(law.points[:, 0]) == pytest.approx(law.points[:, 1], abs=1e-12)


def test_the_solver_s_form_of_a_law_begins_at_rest() -> None:
    law = law_of(PAPER, FULL + 0.1, dead_zone=0.1)
    wanted = sampled(law, 0.1 + np.linspace(0.0, FULL, 11))
    assert wanted.begins_at_rest
    assert wanted.stiffness_at_rest == pytest.approx(0.15 * np.log(10.0) / DEGREE)
    assert wanted.energy[-1] == pytest.approx(84.20239e-3, rel=1e-6)


def test_a_polynomial_stiffness_is_integrated_exactly() -> None:
    law, x = LAWS["stiffness polynomial"], np.linspace(0.0, FULL, 7)
    assert law.stiffness(x) == pytest.approx(100.0 + 2e3 * x + 5e4 * x**2, rel=1e-12)
    assert law.torque(x) == pytest.approx(100.0 * x + 1e3 * x**2 + 5e4 / 3.0 * x**3, rel=1e-12)
    assert law.energy(x) == pytest.approx(
        50.0 * x**2 + 1e3 / 3.0 * x**3 + 5e4 / 12.0 * x**4, rel=1e-12
    )
