"""Omega leaves against closed forms, the beam of fixed loads, energy, and finite elements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from lever_cases import POM, POM_LEAF, STEEL, STEEL_LEAF
from scipy.interpolate import CubicSpline

from springcad.kinds.lever_arm import omega_search
from springcad.kinds.lever_arm.leaf_mesh import judge_leaf_at, leaf_elements
from springcad.kinds.lever_arm.omega import (
    OmegaCase,
    OmegaLeaf,
    find_omega,
    half_ribbon,
    omega_response,
)
from springcad.kinds.lever_arm.omega_exact import equilibrium, rest_guess
from springcad.kinds.lever_arm.omega_form import half_of, variables_of
from springcad.kinds.lever_arm.omega_problem import linear_problem
from springcad.mechanics.beam import RibbonBeam, follower_load, prepare

STEEL_LINEAR = OmegaLeaf(
    np.array([0.832259, 2.591919, 0.924964, -1.446718, -3.767101, 3.632756, -3.314810, -2.611296,
              0.529043, 1.998781, -0.341453]),
    1e-3 * np.array([1.822755, 3.048579, 5.262347, 3.147363, 0.731693, 4.497652, 0.424868,
                     4.488140, 2.934942, 0.533927]),
    245.067829e-3, 0.000000e-3, 5e-3,
)  # fmt: skip
POM_LINEAR = OmegaLeaf(
    np.array([0.118626, -0.185638, -0.604556, -0.858330, -0.752471, -1.577974, -2.176725, -2.156756,
              -2.164388, -2.148893, -2.148909]),
    1e-3 * np.array([6.797566, 9.178031, 8.669682, 7.120611, 5.099516, 9.659480, 12.994245,
                     16.134376, 18.954425, 20.000000]),
    99.479911e-3, 37.363078e-3, 6e-3,
)  # fmt: skip
WIDTH = 15e-3


@pytest.mark.parametrize(
    ("case", "leaf", "wanted"), [(STEEL, STEEL_LINEAR, 6.3), (POM, POM_LINEAR, 5.2)]
)
def test_leaves_twice_as_stiff_as_asked_keep_every_limit(
    case: OmegaCase, leaf: OmegaLeaf, wanted: float
) -> None:
    """Even one half alone is stiffer than wanted; k/b is of both, before the correction."""
    found = linear_problem(case, variables_of(case, leaf))
    assert np.exp(-found.objective) > 2.0 * wanted
    assert found.violation < 3e-4


@pytest.mark.parametrize(("case", "leaf"), [(STEEL, STEEL_LEAF), (POM, POM_LEAF)])
def test_finite_elements_confirm_force_and_stress(case: OmegaCase, leaf: OmegaLeaf) -> None:
    """Force within 2 %, stress within 5 % away from the clamp's corners; both halves."""
    beam = omega_response(leaf, case, WIDTH, np.array([0.0, case.stroke]))
    judged = judge_leaf_at(leaf_elements(leaf, case, WIDTH), case.stroke)
    assert judged.force == pytest.approx(beam.force[1], rel=0.02)
    assert judged.rotation == pytest.approx(beam.rotation[1], rel=0.05)
    thickness = np.interp(judged.stations, beam.stations, beam.thickness)
    ends = 0.5 * thickness
    inside = (judged.stations > ends) & (judged.stations < leaf.length - ends)
    for elements, model in (
        (judged.right_stress, beam.right_stress[1]),
        (judged.left_stress, beam.left_stress[1]),
    ):
        assert elements[inside].max() == pytest.approx(model.max(), rel=0.05)


def test_a_straight_leaf_has_the_stiffness_of_a_cantilever() -> None:
    """Paper 000, Eq. 11, for each half, with the shear of a rectangular section."""
    height, length = 1e-3, 40e-3
    case, u = replace(STEEL, hub_radius=0.0, stroke=1e-7), 1e-7
    leaf = OmegaLeaf(np.full(11, -0.5 * np.pi), np.full(10, height), length, 0.0, 0.0)
    force = omega_response(leaf, case, WIDTH, np.array([u])).force[0]
    inertia = WIDTH * height**3 / 12.0
    bending = length**3 / (3.0 * case.elastic_modulus * inertia)
    shear = length / (5.0 / 6.0 * case.shear_modulus * WIDTH * height)
    assert force / u == pytest.approx(2.0 / (bending + shear), rel=1e-6)


def test_small_displacements_are_those_of_the_linear_theory() -> None:
    case = replace(STEEL, stroke=1e-6)
    linear = np.exp(-linear_problem(case, variables_of(case, STEEL_LEAF)).objective) * 1e6
    force = omega_response(STEEL_LEAF, case, 1.0, np.array([1e-6])).force[0]
    # One integrates the flexibility, the other the equations: 5e-6 apart on the same grid.
    assert force / 1e-6 == pytest.approx(linear, rel=1e-5)


def test_the_force_is_the_derivative_of_the_energy() -> None:
    u = np.linspace(0.0, 10e-3, 21)
    states = omega_response(STEEL_LEAF, STEEL, WIDTH, u)
    slope = CubicSpline(u, states.energy, bc_type=((1, 0.0), (1, states.force[-1])))(u, 1)
    np.testing.assert_allclose(slope[1:], states.force[1:], rtol=1e-5)


def test_a_thin_leaf_bends_as_the_beam_of_given_loads() -> None:
    """The half fixed at the wall and loaded at the hub: the other solver puts the hub there too.

    The leaf is so thin that the curved bar is the plain beam.
    """
    thin = replace(STEEL_LEAF, thickness_coefficients=0.02 * STEEL_LEAF.thickness_coefficients)
    half = half_of(STEEL, variables_of(STEEL, thin)).bare
    found = rest_guess(half)
    for share in (0.25, 0.5, 0.75, 1.0):
        found = equilibrium(STEEL, half, found, share)
    unit = STEEL.enclosure_radius
    force = found.loads[0, :2] * STEEL.elastic_modulus * unit * WIDTH
    moment = found.loads[0, 2] * STEEL.elastic_modulus * unit**2 * WIDTH

    ribbon = half_ribbon(thin)
    length = ribbon.length

    def from_wall(values: str) -> Callable[[np.ndarray], np.ndarray]:
        def at(stations: np.ndarray) -> np.ndarray:
            return np.asarray(
                getattr(ribbon.at((length - stations).ravel()), values).reshape(stations.shape)
            )

        return at

    # Run through from the wall, the tangent is turned round and the curvature changes sign.
    curvature = from_wall("curvature")
    beam = prepare(
        RibbonBeam(
            panel_edges=np.linspace(0.0, length, 33),
            curvature=lambda stations: -curvature(stations),
            half_thickness=from_wall("half_thickness"),
            root_angle=float(thin.angle_coefficients[-1]) + np.pi,
            thickness=WIDTH,
            elastic_modulus=STEEL.elastic_modulus,
            shear_modulus=STEEL.shear_modulus,
        )
    )
    states = omega_response(thin, STEEL, WIDTH, np.array([STEEL.stroke]))
    line = states.right[0]
    arm = np.array([STEEL.stroke, thin.middle]) - line[0]
    moment += arm[0] * force[1] - arm[1] * force[0]
    angle = float(thin.angle_coefficients[0]) + states.rotation[0] + np.pi
    along = force @ [np.cos(angle), np.sin(angle)]
    across = force @ [-np.sin(angle), np.cos(angle)]
    loaded = follower_load(beam, length, along, across, moment)
    assert loaded.end_rotation[0] == pytest.approx(angle, abs=1e-4)
    np.testing.assert_allclose(loaded.end_position[0], line[0] - line[-1], atol=2e-6)


def test_a_search_ends_at_the_allowable_stress_and_with_its_gaps(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without restarts, and with the best leaf alone finished and corrected."""
    monkeypatch.setattr(omega_search, "RESTARTED", 0)
    monkeypatch.setattr(omega_search, "FINISHED", 1)
    case = replace(POM, topology="omega")
    found = find_omega(case, starts=2, seed=1)
    states = omega_response(found.leaf, case, WIDTH, np.linspace(-10e-3, 10e-3, 5))
    assert states.peak_stress.max() == pytest.approx(case.allowable_stress, rel=1e-3)
    for gap in (states.self_gap, states.wall_gap, states.corridor_gap):
        assert gap.min() >= case.min_gap
    assert states.force[-1] / (case.stroke * WIDTH) == pytest.approx(found.stiffness, rel=1e-6)
    assert found.stiffness > 5.2e6
    assert np.all(np.diff(found.spread.stiffness) <= 0.0)
