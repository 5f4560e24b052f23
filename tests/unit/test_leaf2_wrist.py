"""The spherical wrist of paper 003: rod, torque and stiffness against geometry and the energy."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from leaf2_cases import DEGREE, MM, PAPER_LEAF, PAPER_LEVER, PAPER_TURN

from springcad.kinds.leaf_2dof import paper_unit as paper
from springcad.kinds.leaf_2dof import wrist

CORNER = (PAPER_TURN, PAPER_TURN)
PLACES = [(0.2, 0.3), (-0.1, 0.25), (0.3, -0.4), (-0.2, -0.15)]
SOFT, STIFF = 45 * MM, 20 * MM  # leaves of axis x and of axis y


def axes(place: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Torque and stiffness of axes with leaves of different lengths."""
    lengths, angles = np.array([SOFT, STIFF]), np.array(place)
    return (
        paper.torque(PAPER_LEAF, PAPER_LEVER, lengths, angles),
        paper.stiffness(PAPER_LEAF, PAPER_LEVER, lengths, angles),
    )


def energy(place: np.ndarray) -> float:
    lengths = np.array([SOFT, STIFF])
    return float(paper.energy(PAPER_LEAF, PAPER_LEVER, lengths, place).sum())


def hessian(f: Callable[[np.ndarray], float], at: np.ndarray, h: float = 1e-3) -> np.ndarray:
    """By differences alone; relative error about h²."""
    e = np.eye(2) * h
    return np.array(
        [
            [
                (f(at + a + b) - f(at + a - b) - f(at - a + b) + f(at - a - b)) / (4 * h * h)
                for b in e
            ]
            for a in e
        ]
    )


def differences(
    f: Callable[[float, float], np.ndarray], at: np.ndarray, h: float = 1e-4
) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivatives of two coordinates, [k, i] and [k, i, j]."""
    slopes = [(f(*(at + e)) - f(*(at - e))) / (2 * h) for e in np.eye(2) * h]
    second = [hessian(lambda q, k=k: f(*q)[k], at, h) for k in range(2)]
    return np.transpose(slopes), np.array(second)


def test_the_rod_is_a_unit_vector_square_to_the_hinges_of_both_links() -> None:
    """With the k component of Eq. 17 as printed, its length at the corner would be 0.43."""
    for x, y in [*PLACES, (0.0, 0.0)]:
        rod = wrist.rod_direction(x, y)
        hinges = np.array([[0, np.cos(x), np.sin(x)], [np.cos(y), 0, -np.sin(y)]])
        np.testing.assert_allclose(hinges @ rod, 0.0, atol=1e-15)
        assert np.linalg.norm(rod) == pytest.approx(1.0, rel=1e-14)
        printed = np.array(
            [np.cos(x) * np.sin(y), -np.sin(x) * np.cos(y), np.cos(x) * np.cos(y)]
        ) / np.sqrt(1 - np.sin(x) ** 2 * np.sin(y) ** 2)
        np.testing.assert_allclose(rod, printed, atol=1e-15)
    sine, cosine = np.sin(PAPER_TURN), np.cos(PAPER_TURN)
    as_printed = sine * cosine * np.sqrt(3) / np.sqrt(1 - sine**4)
    assert as_printed == pytest.approx(0.43, abs=0.005)


def test_the_corner_of_the_workspace() -> None:
    """50 mm rod, both axes at 14.83 deg."""
    tip = 50 * wrist.rod_direction(*CORNER)
    np.testing.assert_allclose(tip, [12.39794, -12.39794, 46.82502], atol=1e-5)
    edge = 50 * wrist.rod_direction(PAPER_TURN, 0.0)
    np.testing.assert_allclose(edge, [0.0, -12.798, 48.334], atol=5e-4)
    assert wrist.spherical(*CORNER).tilt / DEGREE == pytest.approx(20.52809, abs=1e-5)
    assert wrist.spherical_small(*CORNER).tilt / DEGREE == pytest.approx(20.973, abs=5e-4)


def test_spherical_coordinates_are_those_of_the_rod() -> None:
    for place in PLACES:
        azimuth, tilt = wrist.spherical(*place)
        rod = [np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), np.cos(tilt)]
        np.testing.assert_allclose(wrist.rod_direction(*place), rod, atol=1e-15)


def test_eq_18_is_the_small_angle_limit_with_the_azimuth_the_other_way() -> None:
    small, exact = wrist.spherical_small(1e-4, 2e-4), wrist.spherical(1e-4, 2e-4)
    assert small.tilt == pytest.approx(exact.tilt, rel=1e-7)
    assert small.azimuth == pytest.approx(-exact.azimuth, rel=1e-7)


def test_eq_20_is_the_jacobian_of_eq_18() -> None:
    x, y = PLACES[0]
    delta = np.hypot(x, y)
    printed = [[y / delta**2, -x / delta**2], [x / delta, y / delta]]
    found = wrist.spherical_derivatives_small(x, y).first
    np.testing.assert_allclose(found, printed, rtol=1e-14)


@pytest.mark.parametrize("place", PLACES)
def test_derivatives_are_those_of_the_coordinates(place: tuple[float, float]) -> None:
    basis = wrist.tangent_basis(*place)
    cases = [
        (wrist.spherical_derivatives, lambda x, y: np.array(wrist.spherical(x, y))),
        (wrist.spherical_derivatives_small, lambda x, y: np.array(wrist.spherical_small(x, y))),
        # Geodesic coordinates and the projection on the tangent plane agree to second order.
        (wrist.tangent_derivatives, lambda x, y: basis @ wrist.rod_direction(x, y)),
    ]
    at = np.array(place)
    for derivatives, coordinates in cases:
        found = derivatives(*place)
        first, second = differences(coordinates, at)
        np.testing.assert_allclose(found.first, first, atol=1e-6)
        np.testing.assert_allclose(found.second, second, atol=1e-5)


@pytest.mark.parametrize("place", PLACES)
def test_output_torque_keeps_the_power(place: tuple[float, float]) -> None:
    """M_o = J⁻ᵀ M; Eq. 21 as printed, Jᵀ M, is something else."""
    torque, _ = axes(place)
    jacobian = wrist.spherical_derivatives(*place).first
    rate = np.array([0.3, -0.7])
    found = wrist.output_torque(jacobian, torque)
    assert found @ (jacobian @ rate) == pytest.approx(torque @ rate, rel=1e-13)
    assert not np.allclose(jacobian.T @ torque, found, rtol=0.1)


@pytest.mark.parametrize("place", PLACES)
def test_stiffness_in_spherical_coordinates_is_the_hessian_of_the_energy(
    place: tuple[float, float],
) -> None:
    """The energy as a function of azimuth and tilt, by solving for the axes, and differences."""

    def of(output: np.ndarray) -> float:
        azimuth, tilt = output
        return energy(np.arctan([-np.tan(tilt) * np.sin(azimuth), np.tan(tilt) * np.cos(azimuth)]))

    found = wrist.output_stiffness(wrist.spherical_derivatives(*place), *axes(place))
    expected = hessian(of, np.array(wrist.spherical(*place)))
    np.testing.assert_allclose(found, expected, atol=2e-6 * np.abs(expected).max())


@pytest.mark.parametrize("place", [*PLACES, (0.0, 0.0)])
def test_stiffness_of_the_rod_is_the_hessian_along_great_circles(
    place: tuple[float, float],
) -> None:
    rod, basis = wrist.rod_direction(*place), wrist.tangent_basis(*place)

    def of(turn: np.ndarray) -> float:
        size = np.linalg.norm(turn)
        moved = np.cos(size) * rod + np.sinc(size / np.pi) * (turn @ basis)
        return energy(np.arctan([-moved[1] / moved[2], moved[0] / moved[2]]))

    found = wrist.output_stiffness(wrist.tangent_derivatives(*place), *axes(place))
    # At rest the torque has a kink in its slope (Eq. 16 with |φ|), which differences feel.
    tolerance = 2e-6 if any(place) else 1e-3
    expected = hessian(of, np.zeros(2))
    np.testing.assert_allclose(found, expected, atol=tolerance * np.abs(expected).max())


def test_eq_22_invents_a_stiffness_against_circling() -> None:
    """Equal springs have energy k δ²/2: the rod circles freely. Eq. 22 has k δ² = 0.206 N m/rad."""
    k = np.array([1.54, 1.54])
    small = wrist.spherical_derivatives_small(*CORNER)
    without = wrist.transformed_stiffness(small.first, k)
    np.testing.assert_allclose(without, np.diag([0.20634, 1.54]), atol=1e-5)
    full = wrist.output_stiffness(small, k * CORNER, k)
    np.testing.assert_allclose(full, np.diag([0.0, 1.54]), atol=1e-12)


def test_eq_22_holds_where_nothing_is_loaded() -> None:
    place, k = PLACES[0], np.array([1.0, 3.0])
    derivatives = wrist.spherical_derivatives(*place)
    found = wrist.output_stiffness(derivatives, np.zeros(2), k)
    expected = wrist.transformed_stiffness(derivatives.first, k)
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_at_rest_the_rod_has_the_stiffness_of_the_axes() -> None:
    """Turning the rod towards x is turning axis y, and the other way round."""
    found = wrist.output_stiffness(wrist.tangent_derivatives(0.0, 0.0), np.zeros(2), [1.0, 3.0])
    np.testing.assert_allclose(found, np.diag([3.0, 1.0]), atol=1e-15)


def test_the_solid_angle_of_the_workspace() -> None:
    found = wrist.solid_angle(*CORNER)
    assert found == pytest.approx(0.26223, abs=5e-6)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    x, y = np.meshgrid(PAPER_TURN * nodes, PAPER_TURN * nodes)
    area = np.linalg.det(wrist.tangent_derivatives(x, y).first)
    summed = PAPER_TURN**2 * weights @ np.abs(area) @ weights
    assert found == pytest.approx(summed, rel=1e-12)


def test_the_boundary_of_the_workspace_is_closed_and_on_its_limits() -> None:
    tip = wrist.workspace_boundary(0.2, 0.3, 50 * MM, count=8)
    assert tip.shape == (33, 3)
    np.testing.assert_array_equal(tip[0], tip[-1])
    np.testing.assert_allclose(np.linalg.norm(tip, axis=1), 50 * MM, rtol=1e-14)
    x, y = np.abs(np.arctan([-tip[:, 1] / tip[:, 2], tip[:, 0] / tip[:, 2]]))
    on_edge = np.isclose(x, 0.2, atol=1e-12) | np.isclose(y, 0.3, atol=1e-12)
    assert np.all(on_edge)
    assert np.all((x <= 0.2 + 1e-12) & (y <= 0.3 + 1e-12))


def test_arrays_of_places_lead_the_results() -> None:
    x, y = np.array([[0.1], [0.2], [0.3]]), np.array([0.1, 0.4])
    torque, stiffness = np.ones((3, 2, 2)), np.ones((3, 2, 2))
    found = wrist.output_stiffness(wrist.spherical_derivatives(x, y), torque, stiffness)
    single = wrist.output_stiffness(wrist.spherical_derivatives(0.3, 0.4), torque[2, 1], [1, 1])
    np.testing.assert_allclose(found[2, 1], single, rtol=1e-12)
