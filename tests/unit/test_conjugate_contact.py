"""The search for a contact by energy and torque, on parts whose contacts are known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from springcad.errors import InfeasibleError
from springcad.mechanics.conjugate import conjugate_flank
from springcad.mechanics.conjugate_contact import balance, find_contacts
from springcad.mechanics.elastic_part import ContactState, ElasticPart
from springcad.mechanics.torque_law import TorqueLaw, require_law

ANGLE = np.linspace(0.1, 1.0, 10)
LAW = TorqueLaw(ANGLE, ANGLE, 0.5 * ANGLE**2)
Function = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]


def part_of(energy: Function, arm: Function = lambda a, f, s: np.ones_like(f)) -> ElasticPart:
    """A part of which only arm and energy matter."""

    def part(angle: np.ndarray, force: np.ndarray, station: np.ndarray) -> ContactState:
        zero, pair = np.zeros_like(force), np.zeros((len(force), 2))
        held = energy(angle, force, station)
        arms = arm(angle, force, station)
        return ContactState(arms, np.ones_like(force), held, pair, pair, pair, station, zero)

    return part


def bowl(depth: float) -> ElasticPart:
    """Softest at both ends; at s = 0.3 ± √depth the law's energy, between them less."""
    return part_of(lambda a, f, s: 0.5 * f**2 * (1.0 + (s - 0.3) ** 2 - depth))


@pytest.mark.parametrize("intervals", [1, 2, 8])
def test_two_contacts_between_two_trials_are_found_and_the_first_taken(intervals: int) -> None:
    found = find_contacts(bowl(1e-4), LAW, (0.0, 1.0), intervals)
    assert found.found.all()
    np.testing.assert_allclose(found.contact.station, 0.29, rtol=1e-9)


def test_the_order_of_the_limits_says_which_contact_is_taken() -> None:
    found = find_contacts(bowl(1e-2), LAW, (1.0, 0.0), 8)
    np.testing.assert_allclose(found.contact.station, 0.4, rtol=1e-9)


def test_the_nearest_miss_is_reported_where_there_is_no_contact() -> None:
    found = find_contacts(bowl(-1e-3), LAW, (0.0, 1.0), 8)
    assert not found.found.any()
    np.testing.assert_allclose(np.expm1(found.contact.excess), 1e-3, rtol=1e-4)
    np.testing.assert_allclose(found.contact.station, 0.3, atol=1e-3)
    np.testing.assert_allclose(found.farthest.station, 1.0)


def test_a_jump_of_the_energy_is_not_a_contact() -> None:
    part = part_of(lambda a, f, s: 0.5 * f**2 * np.where(s < 0.37, 2.0, 0.5))
    assert not find_contacts(part, LAW, (0.0, 1.0), 8).found.any()


def test_energies_of_many_magnitudes_are_no_trouble() -> None:
    part = part_of(lambda a, f, s: 0.5 * f**2 * np.exp(-s))
    found = find_contacts(part, LAW, (-40.0, 50.0), 8)
    np.testing.assert_allclose(found.contact.station, 0.0, atol=1e-10)


def test_the_smaller_of_two_forces_with_the_same_torque_is_taken() -> None:
    """F p = F (1 − F/4): the torque cannot exceed 1, at F = 2."""
    part = part_of(lambda a, f, s: 0.5 * f**2, lambda a, f, s: 1.0 - f / 4.0)
    trial = balance(part, LAW, np.zeros(10), np.full(10, np.nan))
    expected = 2.0 * (1.0 - np.sqrt(1.0 - ANGLE[:-1]))
    np.testing.assert_allclose(trial.force[:-1], expected, rtol=1e-10)
    more = balance(part, TorqueLaw(ANGLE, 1.01 + ANGLE, ANGLE), np.zeros(10), np.full(10, np.nan))
    assert np.isnan(more.force).all()


def refused(law: TorqueLaw, part: ElasticPart | None = None) -> InfeasibleError:
    with pytest.raises(InfeasibleError) as caught:
        conjugate_flank(part or bowl(0.0), law, count=1, direction=1, station_limits=(0.0, 1.0))
    return caught.value


def test_a_torque_that_no_force_gives_is_told() -> None:
    """F p = F (1 − F/2.2) is 0.55 at most; up to there the contact is at s = 0.3."""
    weak = part_of(
        lambda a, f, s: 0.5 * (f * (1.0 - f / 2.2)) ** 2 * (0.7 + s),
        lambda a, f, s: 1.0 - f / 2.2,
    )
    error = refused(LAW, weak)
    assert error.claim == "torque at 34.38 deg, which no force on the part gives"
    assert (error.value, error.unit) == (pytest.approx(0.6), "N*m")


def test_a_slope_at_rest_that_the_part_does_not_have() -> None:
    """1/(1 + (s − 0.3)²) N m/rad: 1 at s = 0.3, 0.671 at s = 1."""
    angle = np.linspace(0.0, 1.0, 11)
    for slope, limit in ((1.2, 1.0), (0.5, 1.0 / 1.49)):
        error = refused(TorqueLaw(angle, slope * angle, 0.5 * slope * angle**2, slope))
        assert "stiffness can be 0.6711 N*m/rad (contact 1000.000 mm" in error.claim
        assert error.value == slope
        assert error.limit == pytest.approx(limit, rel=1e-3)


def test_a_soft_part_and_the_first_of_several_angles() -> None:
    """The law stores too little from 0.5 on: first the parts miss little, then more."""
    stored = 0.5 * ANGLE**2 * np.where(ANGLE < 0.45, 1.1, 1.0 - 0.1 * ANGLE)
    error = refused(TorqueLaw(ANGLE, ANGLE, stored))
    assert error.claim.startswith("energy that the law stores up to 28.65 deg; giving its 0.5 N*m")
    assert "too soft, by a factor of 1.1111 in stiffness at 57.3 deg" in error.claim


PRELOAD = TorqueLaw(np.linspace(0, 1, 5), np.linspace(0.5, 1, 5), np.linspace(0, 0.7, 5))
RISE = np.linspace(0.0, 1.0, 5)


@pytest.mark.parametrize(
    ("law", "said", "value"),
    [
        (PRELOAD, "torque of the law at 0 deg, where the unloaded part rests", 0.5),
        (TorqueLaw(RISE, RISE, 1.0 + RISE), "energy of the law at 0 deg", 1.0),
        (
            TorqueLaw(RISE, RISE * (0.6 - RISE), RISE, 0.6),
            "torque of the law at 42.97 deg",
            -0.1125,
        ),
        (TorqueLaw(RISE + 1, RISE - 0.1, RISE + 1), "torque of the law at 57.3 deg", -0.1),
        (TorqueLaw(RISE, np.maximum(RISE - 0.5, 0), RISE, 1.0), "its dead zone ends", 0.0),
        (TorqueLaw(RISE, RISE, -RISE, 1.0), "energy of the law at 14.32 deg", -0.25),
        (TorqueLaw(RISE, np.where(RISE == 1, np.inf, RISE), RISE, 1.0), "at 57.3 deg", np.inf),
        (TorqueLaw(RISE, np.where(RISE == 1, np.nan, RISE), RISE, 1.0), "at 57.3 deg", np.nan),
        (TorqueLaw(RISE, RISE, RISE), "slope of the law at rest", np.nan),
    ],
)
def test_what_is_no_law_of_an_unloaded_part(law: TorqueLaw, said: str, value: float) -> None:
    with pytest.raises(InfeasibleError) as caught:
        require_law(law)
    assert said in caught.value.claim
    np.testing.assert_allclose(caught.value.value, value)
