"""The cantilever under the roller as an elastic part."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from roller_cases import CANTILEVER, DEGREE, PAPER

from springcad.kinds.roller_cam.joint import Cantilever
from springcad.kinds.roller_cam.part import (
    exact_part,
    in_tip_frame,
    linear_part,
    printed_part,
    roller_contact,
    roller_curvature,
)
from springcad.kinds.roller_cam.tip import (
    TipModel,
    carried,
    exact_tip,
    linear_carried,
    linear_tip,
    printed_tip,
)
from springcad.mechanics.elastic_part import ElasticPart
from springcad.mechanics.plane import rotated

IN_A_POCKET = replace(CANTILEVER, pocket_fillet=1e-3)
POINT = np.array([[3.0e-3, 5.3e-3], [3.9e-3, 8.6e-3], [1e-3, 4e-3]])
FORCE = np.array([[370.0, -295.0], [14.0, -1.0], [0.0, -400.0]])
MODELS = {"linear": (linear_tip, linear_carried), "exact": (exact_tip, carried)}


def test_stiffness_of_the_paper_s_cantilever() -> None:
    """Oracle rows A01 and A02; the paper says 1400 N/mm."""
    assert CANTILEVER.tip_stiffness == pytest.approx(1418.094e3, rel=1e-6)
    assert CANTILEVER.bending_stiffness == pytest.approx(6.86678, rel=1e-6)
    at_tip, small = np.zeros((1, 2)), np.array([[0.0, -1e-3]])
    linear = linear_tip(CANTILEVER)(at_tip, small).displacement[0, 1]
    assert small[0, 1] / linear == pytest.approx(CANTILEVER.tip_stiffness, rel=1e-12)
    with_shear = exact_tip(CANTILEVER)(at_tip, small).displacement[0, 1]
    assert small[0, 1] / with_shear == pytest.approx(1375.17e3, rel=1e-5)


@pytest.mark.parametrize("cantilever", [CANTILEVER, IN_A_POCKET], ids=["plates", "pocket"])
@pytest.mark.parametrize("model", MODELS)
def test_a_force_does_the_work_that_is_stored(model: str, cantilever: Cantilever) -> None:
    """Castigliano: the energy grows by the force times the way of its point of action.

    The force is followed in the frame of the tip, where its point of action is one material point.
    """
    tip, step = MODELS[model][1](cantilever), 1e-4

    def state(scale: float) -> tuple[np.ndarray, np.ndarray]:
        found = tip(POINT, scale * FORCE)
        return rotated(POINT, found.rotation) + found.displacement, found.energy

    (before, less), (after, more) = state(1.0 - step), state(1.0 + step)
    force = rotated(FORCE, tip(POINT, FORCE).rotation)
    work = np.einsum("ai,ai->a", force, after - before)
    np.testing.assert_allclose(more - less, work, rtol=1e-7)


@pytest.mark.parametrize("cantilever", [CANTILEVER, IN_A_POCKET], ids=["plates", "pocket"])
@pytest.mark.parametrize("model", MODELS)
def test_integrated_from_the_clamp_or_from_the_tip(model: str, cantilever: Cantilever) -> None:
    in_space, in_tip = (make(cantilever) for make in MODELS[model])
    state = in_space(POINT, FORCE)
    again = in_tip(in_tip_frame(POINT, state), rotated(FORCE, -state.rotation))
    np.testing.assert_allclose(again.displacement, state.displacement, atol=1e-14)
    np.testing.assert_allclose(again.rotation, state.rotation, rtol=1e-10)
    np.testing.assert_allclose(again.energy, state.energy, rtol=1e-10)
    np.testing.assert_allclose(again.stress, state.stress, rtol=1e-10)


@pytest.mark.parametrize("tip", [linear_tip, exact_tip])
def test_in_a_pocket_the_clamp_turns_by_its_moment(tip: Callable[[Cantilever], TipModel]) -> None:
    """Two springs in a row: the clamp adds c l² to the compliance of the tip."""
    at_tip, small = np.zeros((1, 2)), np.array([[0.0, -1e-3]])
    clamped, turning = (tip(c)(at_tip, small) for c in (CANTILEVER, IN_A_POCKET))
    turn = IN_A_POCKET.root_compliance * -1e-3 * CANTILEVER.length
    assert turning.rotation[0] - clamped.rotation[0] == pytest.approx(turn, rel=1e-8)
    sunk = turning.displacement[0, 1] - clamped.displacement[0, 1]
    assert sunk == pytest.approx(turn * CANTILEVER.length, rel=1e-6)
    assert turning.stress[0] == pytest.approx(clamped.stress[0], rel=1e-6)


def test_a_slender_bar_under_a_small_force_is_linear() -> None:
    slender = replace(CANTILEVER, height=0.1e-3)
    point, force = np.array([[3e-3, 5e-3]]), np.array([[1e-7, -1e-7]])
    exact, linear = (tip(slender)(point, force) for tip in (exact_tip, linear_tip))
    np.testing.assert_allclose(exact.rotation, linear.rotation, rtol=2e-5)
    np.testing.assert_allclose(exact.energy, linear.energy, rtol=2e-5)


def test_stress_at_the_clamp_is_that_of_bending_and_tension() -> None:
    """Across the tip: 6 F l/(w h²); along the axis: F/(w h)."""
    c = CANTILEVER
    at_tip, forces = np.zeros((2, 2)), np.array([[0.0, -300.0], [300.0, 0.0]])
    expected = [6.0 * 300.0 * c.length / (c.width * c.height**2), 300.0 / (c.width * c.height)]
    for tip in (linear_tip, printed_tip):
        np.testing.assert_allclose(tip(c)(at_tip, forces).stress, expected, rtol=1e-12)
    np.testing.assert_allclose(exact_tip(c)(at_tip, forces).stress, expected, rtol=1e-3)


def test_a_force_that_no_cantilever_bears_has_no_state() -> None:
    state = exact_tip(CANTILEVER)(POINT, FORCE * np.array([[1e6], [1.0], [1.0]]))
    assert np.isnan([state.energy[0], state.rotation[0], *state.displacement[0]]).all()
    assert np.isfinite(state.energy[1:]).all()


def test_the_roller_is_seen_as_an_ellipse() -> None:
    gamma, angle = np.linspace(0.01, 1.5, 50), np.full(50, 0.3)
    roller = PAPER.roller
    touch = roller_contact(roller, angle, gamma)
    sunk = roller.offset - roller.drum_radius * np.sin(0.3)
    x, y = (touch.point - [0.0, sunk]).T / roller.radius
    np.testing.assert_allclose(x**2 + (y / np.cos(0.3)) ** 2, 1.0, rtol=1e-13)
    gradient = np.stack([x, y / np.cos(0.3) ** 2], axis=-1)
    cross = gradient[:, 0] * touch.normal[:, 1] - gradient[:, 1] * touch.normal[:, 0]
    np.testing.assert_allclose(cross, 0.0, atol=1e-13)
    turn = np.gradient(np.unwrap(np.arctan2(*touch.normal.T[::-1])), gamma)
    way = np.hypot(*np.gradient(touch.point, gamma, axis=0).T)
    curvature = roller_curvature(roller, angle, gamma)
    np.testing.assert_allclose(np.abs(turn / way)[2:-2], curvature[2:-2], rtol=2e-3)


def test_reach_is_the_way_of_the_contact_per_angle() -> None:
    gamma, step = np.array([0.6]), 1e-6
    low, high = (roller_contact(PAPER.roller, np.array([0.2 + s]), gamma) for s in (-step, step))
    way = (low.point - high.point)[0, 1] / (2.0 * step)
    here = roller_contact(PAPER.roller, np.array([0.2]), gamma)
    assert here.reach[0] == pytest.approx(way, rel=1e-9)


def test_statics_as_printed() -> None:
    """Eq. 1 with y, Eq. 9: τ = F_y R; errata: 0.26 % in the arm at 1.9 deg."""
    state = arguments(1.9, 400.0, 38.0)
    right, printed = linear_part(PAPER)(*state), printed_part(PAPER)(*state)
    assert printed.arm[0] / right.arm[0] - 1.0 == pytest.approx(0.0026, abs=1e-4)
    touch = roller_contact(PAPER.roller, state[0], np.exp(state[2]))
    (x, y), (pull, lift) = touch.point[0], 400.0 * touch.normal[0]
    span, bending = CANTILEVER.length, CANTILEVER.bending_stiffness
    turn = -((x * -lift + y * pull) * span - lift * span**2 / 2.0) / bending
    found = printed_tip(CANTILEVER)(touch.point, np.array([[pull, lift]]))
    assert found.rotation[0] == pytest.approx(turn, rel=1e-12)


def arguments(degrees: float, force: float, gamma: float) -> tuple[np.ndarray, ...]:
    return np.array([degrees * DEGREE]), np.array([force]), np.log(np.array([gamma * DEGREE]))


PARTS: dict[str, Callable[..., ElasticPart]] = {"linear": linear_part, "exact": exact_part}


@pytest.mark.parametrize("kind", PARTS)
def test_a_compliant_contact_part_stores_energy_and_yields(kind: str) -> None:
    matrix = np.array([[3e-7, 1e-7], [1e-7, 2e-7]])
    state = arguments(1.0, 300.0, 20.0)
    rigid = PARTS[kind](PAPER)(*state)
    soft = PARTS[kind](PAPER, compliance=lambda a: np.broadcast_to(matrix, (len(a), 2, 2)))(*state)
    force = 300.0 * rigid.normal[0]
    np.testing.assert_allclose(rigid.point[0] - soft.point[0], matrix @ force, rtol=1e-9)
    assert soft.energy[0] - rigid.energy[0] == pytest.approx(0.5 * force @ matrix @ force)
    assert soft.arm == rigid.arm


def test_friction_turns_the_force_towards_the_underside() -> None:
    state = arguments(1.0, 300.0, 20.0)
    free, dragged = linear_part(PAPER)(*state), linear_part(PAPER, friction=0.1)(*state)
    touch = roller_contact(PAPER.roller, state[0], np.exp(state[2]))
    assert dragged.arm[0] - free.arm[0] == pytest.approx(
        0.1 * (touch.reach * touch.tangent[:, 1])[0]
    )
