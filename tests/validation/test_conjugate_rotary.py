"""Springs S1 to S4 of paper 004 on their exact flanks: law to profile, profile to law.

The camshaft as drawn has an arc near rest (see ``test_camshaft``); here the flank is conjugate all
the way down to where it would be too sharp.
"""

from __future__ import annotations

import re

import numpy as np
import pytest
from rotary_cases import spring_of

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.camshaft import flank
from springcad.kinds.rotary_flexure.flexure_contact import NOSE_ALLOWANCE, flexure_part
from springcad.mechanics.cam_contact import Seat, seat
from springcad.mechanics.conjugate import Flank, between
from springcad.mechanics.flank_faults import require_no_fold, require_no_undercut
from springcad.mechanics.friction import friction_loop

SPRINGS = pytest.mark.parametrize("name", ["S1", "S2", "S3", "S4"])
DIRECTIONS = pytest.mark.parametrize("direction", [1, -1])
SMALLEST_RADIUS = 0.15e-3


def regular_flank(name: str, direction: int) -> Flank:
    """The flank from where it is neither folded nor sharper than the smallest radius."""
    spring = spring_of(name)
    whole = flank(spring.sized.beam, spring.camshaft_inputs, direction)
    first = 1 + int(np.flatnonzero(whole.radius < SMALLEST_RADIUS)[-1])
    return between(whole, float(whole.angle[first]), float(whole.angle[-1]))


def seat_on(name: str, side: Flank, friction: float = 0.0) -> Seat:
    """The ring seated on the flank, at the flank's angles but the ends."""
    spring = spring_of(name)
    inputs, tip = spring.camshaft_inputs, spring.law.inputs.tip_half_thickness
    return seat(
        flexure_part(spring.sized.beam, inputs.root_radius, side.direction, friction),
        side.points,
        side.angle[1:-1],
        count=inputs.count,
        force=0.95 * side.force[1:-1],
        station=side.station[1:-1] - 20e-6,
        station_limits=(inputs.pad_start, inputs.nose_station + NOSE_ALLOWANCE * tip),
    )


@SPRINGS
@DIRECTIONS
def test_law_to_profile_to_law(name: str, direction: int) -> None:
    inputs = spring_of(name).camshaft_inputs
    side = regular_flank(name, direction)
    found = seat_on(name, side)
    np.testing.assert_array_equal(found.angle, side.angle[1:-1])
    law, energy = inputs.torque(found.angle), inputs.energy(found.angle)
    np.testing.assert_allclose(found.torque, law, atol=1e-5 * law[-1])
    np.testing.assert_allclose(found.energy, energy, atol=1e-5 * energy[-1])


@SPRINGS
@DIRECTIONS
def test_the_regular_flank_can_be_cut_and_the_rest_cannot(name: str, direction: int) -> None:
    """Near rest the flat pad asks for a radius of −λ_t, beyond a cusp for a small one."""
    spring = spring_of(name)
    side = regular_flank(name, direction)
    assert side.angle[0] < 0.3 * spring.camshaft_inputs.deflection
    require_no_fold(side)
    require_no_undercut(side, SMALLEST_RADIUS)
    whole = flank(spring.sized.beam, spring.camshaft_inputs, direction)
    with pytest.raises(InfeasibleError) as caught:
        require_no_undercut(whole, SMALLEST_RADIUS)
    near_rest, upto = float(np.degrees(whole.angle[0])), float(np.degrees(side.angle[0]))
    between_angles = re.search(r"between ([0-9.]+) and ([0-9.]+)", caught.value.claim)
    assert between_angles is not None
    assert near_rest - 1e-3 < float(between_angles[1]) < float(between_angles[2]) < upto


@SPRINGS
@DIRECTIONS
def test_pressure_angle_grows_to_a_third_of_a_right_angle_at_most(
    name: str, direction: int
) -> None:
    """It is the angle of the pad's normal against the circle through the contact."""
    side = regular_flank(name, direction)
    circle = np.stack([-side.points[:, 1], side.points[:, 0]], axis=-1)
    cosine = np.einsum("ai,ai->a", circle, side.normals) / np.hypot(*side.points.T)
    np.testing.assert_allclose(np.cos(side.pressure_angle), -direction * cosine, rtol=1e-12)
    assert np.all(np.diff(side.pressure_angle) > 0.0)
    assert side.pressure_angle[-1] < np.radians(30.0)


@SPRINGS
@DIRECTIONS
def test_friction_dissipates_the_sliding_work(name: str, direction: int) -> None:
    side = regular_flank(name, direction)
    inputs, mu = spring_of(name).camshaft_inputs, 0.2
    ahead, behind = (seat_on(name, side, sign * mu) for sign in (1.0, -1.0))
    inner = between(side, float(side.angle[1]), float(side.angle[-2]))
    loop = friction_loop(inner, ahead, behind, mu, count=inputs.count)
    assert loop.loss == pytest.approx(loop.sliding_work, rel=0.1)
    assert 0.02 < loop.loss_share < 0.1
