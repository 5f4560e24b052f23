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
from springcad.mechanics.conjugate import Contact, ElasticPart, Flank, conjugate_flank

DISTANCE, RATIO, COUNT, STIFFNESS = 30e-3, 0.3, 7, 40.0
PITCH_RADIUS = DISTANCE * RATIO / (1.0 + RATIO)
ROLLING = 0.5 * (DISTANCE - PITCH_RADIUS)
SPRING = STIFFNESS / (COUNT * RATIO**2)
ANGLE = np.linspace(0.02, 0.5, 41)


def lever(direction: int, friction: float = 0.0) -> ElasticPart:
    """A straight lever hinged at (DISTANCE, 0), its working edge through the hinge."""

    def part(force: np.ndarray, station: np.ndarray) -> Contact:
        turn = force * station / SPRING
        tangent = np.stack([-np.cos(turn), direction * np.sin(turn)], axis=-1)
        normal = np.stack([-np.sin(turn), -direction * np.cos(turn)], axis=-1)
        point = np.array([DISTANCE, 0.0]) + station[:, None] * tangent
        unit = friction * tangent - normal
        moment = point[:, 0] * unit[:, 1] - point[:, 1] * unit[:, 0]
        return Contact(direction * moment, 0.5 * SPRING * turn**2, point, normal, tangent)

    return part


def flank(direction: int = 1, limits: tuple[float, float] = (10e-3, 30e-3)) -> Flank:
    return conjugate_flank(
        lever(direction),
        ANGLE,
        STIFFNESS * ANGLE,
        0.5 * STIFFNESS * ANGLE**2,
        count=COUNT,
        direction=direction,
        station=22e-3,
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
    contact = lever(1)(found.force, found.station)
    from_pitch = contact.point - np.array([PITCH_RADIUS, 0.0])
    distance = from_pitch[:, 0] * contact.normal[:, 1] - from_pitch[:, 1] * contact.normal[:, 0]
    np.testing.assert_allclose(distance, 0.0, atol=1e-10)


def test_sliding_is_that_of_gears() -> None:
    """Sliding speed of gears: distance from the pitch point times the sum of the speeds."""
    found = flank()
    contact = lever(1)(found.force, found.station)
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
        direction=1,
        force=0.9 * found.force[start],
        station=found.station[start] - 0.2e-3,
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
            direction=1,
            force=found.force[1:-1],
            station=found.station[1:-1],
        )
        work.append(np.trapezoid(seated.torque, seated.angle))
    lost = 2 * mu * COUNT * np.abs(found.force * found.sliding)
    expected = np.trapezoid(lost[1:-1], ANGLE[1:-1])
    assert work[0] - work[1] == pytest.approx(expected, rel=2e-3)


def test_no_solution_names_the_angle_and_the_end_of_the_part() -> None:
    with pytest.raises(InfeasibleError, match=r"torque law at 23\.84 deg.*soft.*before 22\.9"):
        flank(limits=(22.9e-3, 30e-3))
