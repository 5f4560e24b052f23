"""The iteration of paper 001, as printed and in a sound form, against the energy balance."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from roller_cases import DEGREE, EXPONENTIAL, FULL, PAPER, power

from springcad.kinds.roller_cam.curve import curve_through
from springcad.kinds.roller_cam.forward import forward
from springcad.kinds.roller_cam.part import exact_part, linear_part, printed_part
from springcad.kinds.roller_cam.stepwise import EQUATIONS, Chord, Steps, distance, march, printed
from springcad.kinds.roller_cam.synthesis import synthesise
from springcad.kinds.roller_cam.tip import linear_carried, linear_tip
from springcad.kinds.target_law import Law

EXACT_END = 38.356100
"""Contact angle at 1.9 deg (oracle row A10, deg)."""
PRINTED_END = 37.51600
"""The same by the printed equations, with infinitely many steps (oracle row A15, deg)."""


@cache
def marched(count: int, chord: Chord) -> Steps:
    return march(linear_part(PAPER), EXPONENTIAL, count, chord)


def end(steps: Steps) -> float:
    return float(np.degrees(steps.gamma[-1]))


def torque_error(steps: Steps) -> float:
    """Largest share, from 0.02 deg on, with the profile of the steps."""
    angle = np.linspace(0.02, 1.9, 189) * DEGREE
    curve, _ = curve_through(steps.points)
    stroke = forward(PAPER, curve, angle, beam=linear_carried)
    return float(np.abs(stroke.torque / EXPONENTIAL.torque(angle) - 1.0).max())


def order(coarse: float, fine: float) -> float:
    """Of convergence, from errors with one and two times as many steps."""
    return float(np.log2(abs(coarse / fine)))


def test_backward_difference_with_190_steps() -> None:
    """Oracle row A12."""
    steps = marched(190, "backward")
    assert end(steps) - EXACT_END == pytest.approx(-1.147, rel=0.02)
    assert torque_error(steps) == pytest.approx(0.0753, rel=0.02)


def test_trapezoid_with_190_steps() -> None:
    """Oracle row A13."""
    steps = marched(190, "trapezoid")
    assert end(steps) - EXACT_END == pytest.approx(-7.72e-4, rel=0.05)
    assert torque_error(steps) == pytest.approx(2.85e-5, rel=0.05)


def test_backward_difference_is_of_first_order() -> None:
    errors = [end(marched(count, "backward")) - EXACT_END for count in (380, 760)]
    assert order(*errors) == pytest.approx(0.97, abs=0.05)
    errors = [end(printed(PAPER, EXPONENTIAL, count)) - PRINTED_END for count in (760, 1520)]
    assert order(*errors) == pytest.approx(0.97, abs=0.05)


def test_trapezoid_is_of_second_order() -> None:
    errors = [end(marched(count, "trapezoid")) - EXACT_END for count in (95, 190)]
    assert order(*errors) == pytest.approx(2.0, abs=0.1)


def test_the_printed_equations_have_another_limit() -> None:
    """Oracle row A15: y for y − v and F_y R for the torque make 0.84 deg at the end."""
    steps = march(printed_part(PAPER), EXPONENTIAL, 760)
    assert end(steps) == pytest.approx(PRINTED_END, rel=1e-5)
    np.testing.assert_allclose(1e3 * steps.points[-1], [3.044166, 5.595082], rtol=1e-5)


@pytest.mark.parametrize("law", [EXPONENTIAL, power(1.0, 8.0), power(1.0, 8.0, 0.4 * DEGREE)])
def test_eight_unknowns_are_one(law: Law) -> None:
    """``fsolve`` on the printed equations and one bracketed unknown give the same contacts."""
    eight, one = printed(PAPER, law, 95), march(printed_part(PAPER), law, 95, "backward")
    assert not eight.failures
    np.testing.assert_allclose(eight.points, one.points, atol=1e-9)
    np.testing.assert_allclose(eight.gamma, one.gamma, rtol=1e-6)


def test_where_the_printed_iteration_fails_it_says_so() -> None:
    """A quadratic law begins beside the roller, where Eqs 5 and 6 are infinite."""
    law = power(2.0, 11.76)
    steps = printed(PAPER, law, 190)
    first = steps.failures[0]
    assert (first.step, first.angle) == (1, pytest.approx(FULL / 190))
    assert first.equation in EQUATIONS
    assert abs(first.residual) > 1e-7
    assert "not making good progress" in first.reason
    assert len(steps.points) == 191 - len(steps.failures)
    sound = march(linear_part(PAPER), law, 190)
    assert distance(sound, synthesise(PAPER, law, beam=linear_tip).curve) < 0.02e-6


@pytest.mark.parametrize(
    "law", [EXPONENTIAL, power(1.0, 8.0), power(3.0, 11.76), power(1.0, 8.0, 0.4 * DEGREE)]
)
def test_the_sound_form_converges_to_the_energy_s_profile(law: Law) -> None:
    """With the exact beam too; the distance is measured across the profile."""
    steps = march(exact_part(PAPER), law, 60)
    assert distance(steps, synthesise(PAPER, law).curve) < 0.05e-6


def test_distance_is_normal_to_the_profile() -> None:
    curve = synthesise(PAPER, EXPONENTIAL).curve
    place = np.linspace(0.1, 0.9, 20) * curve.length
    beside = curve.points(place) + 1e-6 * curve.normals(place)
    assert distance(Steps(place, place, beside), curve) == pytest.approx(1e-6, rel=1e-4)
