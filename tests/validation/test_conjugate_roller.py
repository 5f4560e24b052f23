"""The profile of a roller on a cantilever (paper 001), by the solver that makes camshafts.

Expected positions were computed independently with the same linear cantilever: R = 40 mm,
r = 4 mm, y0 = 8.95 mm (the paper gives none of the three), l, w, h and the law as in the paper.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from roller_cases import (
    CANTILEVER,
    DEGREE,
    EXPONENTIAL,
    FULL,
    PAPER,
    paper_joint,
    power,
    sampled_law,
)

from springcad.errors import InfeasibleError
from springcad.kinds.roller_cam.part import STATION_LIMITS, linear_part
from springcad.kinds.roller_cam.tip import linear_tip
from springcad.kinds.target_law import sampled
from springcad.mechanics.cam_contact import seat
from springcad.mechanics.conjugate import Flank, between, conjugate_flank
from springcad.mechanics.elastic_part import ElasticPart
from springcad.mechanics.flank_faults import require_no_fold, require_no_undercut
from springcad.mechanics.friction import friction_loop
from springcad.mechanics.torque_law import TorqueLaw

ANGLE = np.linspace(0.0, 1.9, 381) * DEGREE
ROWS = {0.0: 0, 0.1: 20, 0.5: 100, 1.0: 200, 1.5: 300, 1.9: 380}
"""Row of an angle in degrees."""
INNER = slice(1, -1)


def profile(law: TorqueLaw, part: ElasticPart | None = None) -> Flank:
    return conjugate_flank(
        part or linear_part(PAPER), law, count=1, direction=1, station_limits=STATION_LIMITS
    )


@cache
def exponential() -> Flank:
    return profile(sampled(EXPONENTIAL, ANGLE))


@pytest.mark.parametrize(
    ("degrees", "gamma", "m", "n"),
    [
        (0.0, 3.697924, 3.991672, 8.692015),
        (0.1, 3.998868, 3.986124, 8.609193),
        (0.5, 5.686609, 3.956805, 8.252130),
        (1.0, 9.723020, 3.886377, 7.700177),
        (1.5, 19.108334, 3.680499, 6.845753),
        (1.9, 38.356100, 3.008042, 5.551144),
    ],
)
def test_contact_and_profile(degrees: float, gamma: float, m: float, n: float) -> None:
    """At rest too, where neither force nor energy say where the contact is, but their limit."""
    flank, row = exponential(), ROWS[degrees]
    assert np.degrees(np.exp(flank.station[row])) == pytest.approx(gamma, rel=1e-6)
    np.testing.assert_allclose(1e3 * flank.points[row], [m, n], atol=1e-6)


def test_forces_and_deflection_at_full_deflection() -> None:
    flank = exponential()
    alpha = flank.pressure_angle[-1]
    pull, push = flank.force[-1] * np.sin(alpha), flank.force[-1] * np.cos(alpha)
    assert push == pytest.approx(294.8919, rel=1e-6)
    assert pull == pytest.approx(372.4423, rel=1e-6)
    gamma = np.exp(flank.station[-1])
    x = 4e-3 * np.cos(gamma)
    y = 8.95e-3 - 40e-3 * np.sin(FULL) - 4e-3 * np.cos(FULL) * np.sin(gamma)
    tip = linear_tip(CANTILEVER)(np.array([[x, y]]), np.array([[pull, -push]]))
    assert 1e3 * tip.displacement[0, 1] == pytest.approx(-0.336518, rel=1e-5)
    assert np.degrees(tip.rotation[0]) == pytest.approx(-1.336263, rel=1e-6)
    assert 1e-6 * tip.stress[0] == pytest.approx(769.187, rel=1e-6)


def test_the_pressure_angle_is_the_inclination_of_the_contact() -> None:
    found = np.degrees(exponential().pressure_angle[[0, -1]])
    np.testing.assert_allclose(found, [86.302076, 51.628566], rtol=1e-7)


def test_the_profile_is_hollow_but_less_than_the_roller_is_round() -> None:
    flank = exponential()
    ratio = -flank.curvature / flank.mate_curvature
    assert np.all((ratio > 0.2) & (ratio < 0.95))
    require_no_fold(flank)
    require_no_undercut(flank)


LAWS = {
    "exponential": sampled(EXPONENTIAL, ANGLE),
    "linear": sampled(power(1.0, 8.0), ANGLE),
    "quadratic": sampled(power(2.0, 11.76), ANGLE[1:]),
    "dead zone": sampled(power(1.0, 8.0, ANGLE[100]), ANGLE[100:]),
    "stiffening at once": sampled_law(
        lambda t: np.where(t < 0.5 * FULL, 2.0 * t / FULL, 1.0 + 8.0 * (t / FULL - 0.5)), ANGLE
    ),
}
JUMP = {"stiffening at once": 0.5 * FULL}


@pytest.mark.parametrize("name", LAWS)
def test_law_to_profile_to_law(name: str) -> None:
    """The forward problem knows neither law nor energy; it begins away from the solution."""
    law = LAWS[name]
    flank = profile(law)
    found = seat(
        linear_part(PAPER),
        flank.points,
        law.angle[INNER],
        count=1,
        force=0.9 * flank.force[INNER],
        station=flank.station[INNER] + 0.1,
        station_limits=STATION_LIMITS,
    )
    np.testing.assert_array_equal(found.angle, law.angle[INNER])
    # Where the slope of the law jumps the profile's curvature does; no spline follows that.
    smooth = np.abs(found.angle - JUMP.get(name, -1.0)) > 0.06 * DEGREE
    error = np.abs(found.torque - law.torque[INNER]) / law.torque[-1]
    assert error[smooth].max() < 1e-6


def test_a_linear_law_needs_an_almost_straight_ramp() -> None:
    flank = profile(sampled(power(1.0, 11.765), ANGLE))
    gamma = np.degrees(np.exp(flank.station))
    np.testing.assert_allclose(gamma[[0, -1]], [21.5, 19.7], atol=0.05)
    turn, turn_exponential = (
        float(np.ptp(np.arctan2(*profile.tangents.T))) for profile in (flank, exponential())
    )
    assert turn < 4.0 * DEGREE < 30.0 * DEGREE < turn_exponential


def test_many_angles_make_no_difference_to_one() -> None:
    """No error is carried from angle to angle, for each is solved by itself."""
    few = profile(sampled(EXPONENTIAL, ANGLE[::95]))
    np.testing.assert_allclose(few.points, exponential().points[::95], atol=1e-13)


def least_drum(angle: np.ndarray) -> np.ndarray:
    """Smallest drum radius (m) for the exponential law: contact under the roller, no pull.

    There the energy is least, F² l³/(6 E I), and the torque F (R cos θ − r sin θ).
    """
    law = sampled(EXPONENTIAL, angle)
    push = np.sqrt(2.0 * CANTILEVER.tip_stiffness * law.energy[1:])
    return (law.torque[1:] / push + 4e-3 * np.sin(angle[1:])) / np.cos(angle[1:])


def test_the_smallest_drum_is_where_the_energy_runs_out() -> None:
    least = float(least_drum(ANGLE).max())
    assert least == pytest.approx(24.19e-3, abs=0.05e-3)
    flank = profile(sampled(EXPONENTIAL, ANGLE), linear_part(paper_joint(1.0001 * least)))
    assert np.degrees(np.exp(flank.station[-1])) == pytest.approx(90.0, abs=1.5)
    with pytest.raises(InfeasibleError, match="too soft"):
        profile(sampled(EXPONENTIAL, ANGLE), linear_part(paper_joint(0.9999 * least)))


@pytest.mark.parametrize("drum", [24.0e-3, 23.0e-3, 21.0e-3])
def test_a_drum_too_small_is_refused_at_the_first_angle_with_what_is_missing(drum: float) -> None:
    first = 1 + int(np.argmax(least_drum(ANGLE) > drum))
    law = sampled(EXPONENTIAL, ANGLE)
    with pytest.raises(InfeasibleError) as caught:
        profile(law, linear_part(paper_joint(drum)))
    error = caught.value
    assert f"stores up to {np.degrees(ANGLE[first]):.4g} deg" in error.claim
    assert (error.value, error.unit) == (law.energy[first], "J")
    assert error.limit > error.value
    # The energy at a torque goes with 1/stiffness and with 1/arm².
    arm = drum * np.cos(ANGLE[1:]) - 4e-3 * np.sin(ANGLE[1:])
    held = (law.torque[1:] / arm) ** 2 / (2.0 * CANTILEVER.tip_stiffness)
    assert f"by a factor of {np.max(held / law.energy[1:]):.4f} in stiffness" in error.claim


def test_an_infinite_slope_at_rest_is_refused_there() -> None:
    with pytest.raises(InfeasibleError, match=r"slope of the law at rest.* to 2269 N\*m/rad") as at:
        profile(sampled(power(0.5, 11.76), ANGLE))
    assert at.value.value == np.inf
    assert at.value.limit == pytest.approx(1418.094e3 * 40e-3**2, rel=1e-5)
    with pytest.raises(InfeasibleError, match=r"up to 0\.005 deg.*too soft"):
        profile(sampled(power(0.5, 11.76), ANGLE[1:]))


FOLDS = {
    "plateau": (lambda t: 8.0 * np.minimum(2.5 * t / FULL, 1.0), 0.4),
    "stiffness falls to a quarter": (
        lambda t: np.where(t < 0.5 * FULL, 8.0 * t / FULL, 4.0 + 2.0 * (t / FULL - 0.5)),
        0.5,
    ),
}


@pytest.mark.parametrize("name", FOLDS)
def test_a_law_that_softens_abruptly_folds_the_profile_there(name: str) -> None:
    torque, where = FOLDS[name]
    flank = profile(sampled_law(torque, ANGLE))
    with pytest.raises(InfeasibleError, match="folds back between") as caught:
        require_no_fold(flank)
    said = float(caught.value.claim.split("between ")[1].split(" ")[0])
    assert said == pytest.approx(np.degrees(where * FULL), abs=0.01)
    with pytest.raises(InfeasibleError, match=r"hollow .* round with one of [34]"):
        require_no_undercut(flank)
    require_no_fold(between(flank, 0.0, 0.99 * where * FULL))
    require_no_undercut(between(flank, 0.0, 0.99 * where * FULL))


def test_friction_of_a_roller_that_does_not_turn_dissipates_the_sliding_work() -> None:
    flank, mu = exponential(), 0.1
    ahead, behind = (
        seat(
            linear_part(PAPER, friction=sign * mu),
            flank.points,
            flank.angle[INNER],
            count=1,
            force=flank.force[INNER],
            station=flank.station[INNER],
            station_limits=STATION_LIMITS,
        )
        for sign in (1.0, -1.0)
    )
    loop = friction_loop(between(flank, ANGLE[1], ANGLE[-2]), ahead, behind, mu, count=1)
    assert loop.loss == pytest.approx(loop.sliding_work, rel=0.1)
    assert loop.loss > 0.02
