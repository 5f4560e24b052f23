"""The conjugate flank of a rigid lever on a torsion spring is an epicycloid.

With a linear law the lever turns in a fixed ratio to the profile, so both are gears; the mate of
a straight radial flank is the epicycloid rolled by a circle of half the lever's pitch radius
(Litvin & Fuentes, Gear Geometry and Applied Theory, 2nd ed., ch. 6 and 13).
"""

from __future__ import annotations

import numpy as np
import pytest

from springcad.errors import InfeasibleError
from springcad.mechanics.cam_contact import seat
from springcad.mechanics.conjugate import Flank, conjugate_flank, hertz_half_width
from springcad.mechanics.elastic_part import ContactState, ElasticPart
from springcad.mechanics.flank_faults import require_no_fold, require_no_undercut
from springcad.mechanics.plane import rotated
from springcad.mechanics.torque_law import TorqueLaw

DISTANCE, RATIO, COUNT, STIFFNESS = 30e-3, 0.3, 7, 40.0
PITCH_RADIUS = DISTANCE * RATIO / (1.0 + RATIO)
ROLLING = 0.5 * (DISTANCE - PITCH_RADIUS)
SPRING = STIFFNESS / (COUNT * RATIO**2)
ANGLE = np.linspace(0.02, 0.5, 41)
LIMITS = (10e-3, 30e-3)


def lever(direction: int, friction: float = 0.0) -> ElasticPart:
    """A straight lever hinged at (DISTANCE, 0), its working edge through the hinge."""

    def part(angle: np.ndarray, force: np.ndarray, station: np.ndarray) -> ContactState:
        turn = force * station / SPRING
        tangent = np.stack([-np.cos(turn), direction * np.sin(turn)], axis=-1)
        normal = np.stack([-np.sin(turn), -direction * np.cos(turn)], axis=-1)
        point = np.array([DISTANCE, 0.0]) + station[:, None] * tangent
        unit = friction * tangent - normal
        moment = point[:, 0] * unit[:, 1] - point[:, 1] * unit[:, 0]
        return ContactState(
            arm=direction * moment,
            reach=np.hypot(*point.T),
            energy=0.5 * SPRING * turn**2,
            point=rotated(point, -direction * angle),
            normal=rotated(normal, -direction * angle),
            tangent=rotated(tangent, -direction * angle),
            arc=station,
            mate_curvature=np.zeros_like(station),
        )

    return part


def flank(direction: int = 1, limits: tuple[float, float] = LIMITS) -> Flank:
    return conjugate_flank(
        lever(direction),
        TorqueLaw(ANGLE, STIFFNESS * ANGLE, 0.5 * STIFFNESS * ANGLE**2),
        count=COUNT,
        direction=direction,
        station_limits=limits,
    )


@pytest.mark.parametrize("direction", [1, -1])
def test_the_flank_is_the_epicycloid(direction: int) -> None:
    phi = -direction * ANGLE
    center, turns = PITCH_RADIUS + ROLLING, (PITCH_RADIUS + ROLLING) / ROLLING
    expected = np.stack(
        [
            center * np.cos(phi) - ROLLING * np.cos(turns * phi),
            center * np.sin(phi) - ROLLING * np.sin(turns * phi),
        ],
        axis=-1,
    )
    np.testing.assert_allclose(flank(direction).points, expected, atol=1e-10)


def test_its_radius_of_curvature_is_that_of_the_epicycloid() -> None:
    factor = 4 * ROLLING * (PITCH_RADIUS + ROLLING) / (PITCH_RADIUS + 2 * ROLLING)
    expected = factor * np.sin(0.5 * PITCH_RADIUS * ANGLE / ROLLING)
    np.testing.assert_allclose(flank().radius, expected, rtol=2e-4)


def test_the_contact_normal_passes_through_the_pitch_point() -> None:
    found = flank()
    contact = lever(1)(np.zeros_like(ANGLE), found.force, found.station)
    from_pitch = contact.point - np.array([PITCH_RADIUS, 0.0])
    distance = from_pitch[:, 0] * contact.normal[:, 1] - from_pitch[:, 1] * contact.normal[:, 0]
    np.testing.assert_allclose(distance, 0.0, atol=1e-10)


def test_sliding_is_that_of_gears() -> None:
    """Sliding speed of gears: distance from the pitch point times the sum of the speeds."""
    found = flank()
    contact = lever(1)(np.zeros_like(ANGLE), found.force, found.station)
    distance = np.hypot(*(contact.point - np.array([PITCH_RADIUS, 0.0])).T)
    np.testing.assert_allclose(np.abs(found.sliding), distance * (1 + RATIO), rtol=1e-4)


def test_the_envelope_condition_holds() -> None:
    """The flank moves along its own tangent: no speed along the normal (spline derivative)."""
    found = flank()
    slope = np.gradient(found.points, ANGLE, axis=0, edge_order=2)
    across = np.einsum("ai,ai->a", slope, found.normals)
    along = np.abs(np.einsum("ai,ai->a", slope, found.tangents))
    assert np.max(np.abs(across)) < 2e-3 * np.max(along)


def test_the_part_seated_on_its_flank_follows_the_law() -> None:
    found = flank()
    start = slice(5, -2)  # at 0 the epicycloid has a cusp, through which no spline is smooth
    seated = seat(
        lever(1),
        found.points,
        ANGLE[start],
        count=COUNT,
        force=0.9 * found.force[start],
        station=found.station[start] - 0.2e-3,
        station_limits=LIMITS,
    )
    np.testing.assert_allclose(seated.torque, STIFFNESS * seated.angle, rtol=1e-6)
    np.testing.assert_allclose(seated.energy, 0.5 * STIFFNESS * seated.angle**2, rtol=1e-6)
    np.testing.assert_allclose(seated.station, found.station[start], atol=1e-8)


def test_friction_dissipates_the_sliding_work() -> None:
    """Work in the loop between loading and unloading is ∫ 2 μ F |sliding| dθ to first order."""
    found, mu = flank(), 0.01
    work = []
    for growing in (1.0, -1.0):
        friction = -mu * growing * np.sign(found.sliding[0])
        seated = seat(
            lever(1, friction),
            found.points,
            ANGLE[1:-1],
            count=COUNT,
            force=found.force[1:-1],
            station=found.station[1:-1],
            station_limits=LIMITS,
        )
        work.append(np.trapezoid(seated.torque, seated.angle))
    lost = 2 * mu * COUNT * np.abs(found.force * found.sliding)
    expected = np.trapezoid(lost[1:-1], ANGLE[1:-1])
    assert work[0] - work[1] == pytest.approx(expected, rel=2e-3)


def test_too_soft_a_part_is_told_with_angle_energies_and_contacts() -> None:
    """With the contact at 22.9 mm or beyond the lever would have to be stiffer from 23.84 deg."""
    limits = (22.9e-3, 30e-3)
    with pytest.raises(InfeasibleError) as caught:
        flank(limits=limits)
    error, first = caught.value, float(np.degrees(ANGLE[33]))
    assert error.claim.startswith(f"energy that the law stores up to {first:.4g} deg")
    assert "(contact 22.900 mm along the surface) to " in error.claim
    assert "too soft, by a factor of 1.0355 in stiffness at 28.65 deg" in error.claim
    assert error.value == pytest.approx(0.5 * STIFFNESS * ANGLE[33] ** 2)
    assert error.value < error.limit < 1.0355 * error.value


def test_too_stiff_a_part_is_told_so() -> None:
    with pytest.raises(InfeasibleError, match=r"up to 1\.146 deg.*too stiff") as caught:
        flank(limits=(10e-3, 22e-3))
    assert caught.value.value > caught.value.limit


def test_at_rest_the_contact_is_at_the_pitch_point() -> None:
    """There neither force nor energy fixes it, only their limit."""
    angle = np.concatenate([[0.0], ANGLE])
    law = TorqueLaw(angle, STIFFNESS * angle, 0.5 * STIFFNESS * angle**2, STIFFNESS)
    found = conjugate_flank(lever(1), law, count=COUNT, direction=1, station_limits=LIMITS)
    np.testing.assert_allclose(found.points[0], [PITCH_RADIUS, 0.0], atol=1e-9)
    assert found.force[0] == 0.0
    np.testing.assert_allclose(found.points[1:], flank().points, atol=1e-12)


def test_the_limits_may_be_wider_than_where_the_lever_can_work() -> None:
    """Before 10 mm too much force is needed, beyond the hinge distance the arm is negative."""
    found = flank(limits=(1e-3, 60e-3))
    np.testing.assert_allclose(found.points, flank().points, atol=1e-11)


def test_the_pressure_angle_is_that_of_the_normal_against_the_circle() -> None:
    found = flank()
    radius = np.hypot(*found.points.T)
    assert found.pressure_angle == pytest.approx(np.arccos(PITCH_RADIUS / radius * normal_cosine()))


def normal_cosine() -> np.ndarray:
    """Cosine of the lever's turn: the normal passes the pitch point at that angle."""
    return np.cos(RATIO * ANGLE)


def test_pressure_on_the_flank_is_hertz_s() -> None:
    found, width, modulus = flank(), 4.5e-3, 110e9
    expected = np.sqrt(found.force * modulus / (np.pi * width * found.radius))
    half = hertz_half_width(found, width, modulus)
    np.testing.assert_allclose(2.0 * found.force / (np.pi * width * half), expected, rtol=1e-12)


@pytest.mark.parametrize("softening", [2.0, 3.0])
def test_a_law_too_soft_for_a_flat_lever_undercuts_the_flank(softening: float) -> None:
    law = TorqueLaw(
        ANGLE,
        STIFFNESS * (ANGLE - softening * ANGLE**3),
        STIFFNESS * (ANGLE**2 / 2 - softening * ANGLE**4 / 4),
    )
    found = conjugate_flank(lever(1), law, count=COUNT, direction=1, station_limits=LIMITS)
    with pytest.raises(InfeasibleError, match=r"between 1\.146 and 28\.65 deg.*mate is flat") as at:
        require_no_undercut(found)
    assert at.value.value == pytest.approx(float(found.curvature.min()))


def test_a_flank_sharper_than_wanted_is_refused_up_to_where_it_is() -> None:
    found, smallest = flank(), 2e-3
    require_no_undercut(found)
    require_no_fold(found)
    upto = float(np.degrees(np.interp(smallest, found.radius, ANGLE)))
    with pytest.raises(InfeasibleError, match="radius of curvature of the profile") as caught:
        require_no_undercut(found, smallest)
    assert caught.value.value == pytest.approx(float(found.radius[0]))
    assert float(caught.value.claim.split(" and ")[1].split()[0]) == pytest.approx(upto, rel=2e-3)
