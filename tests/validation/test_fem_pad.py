"""The resolved contact pressure against Hertz: circles, spirals, joints, depth, edges."""

from __future__ import annotations

import numpy as np
import pytest
from fem_cases import circle

from springcad.mechanics.contact import half_width, peak_pressure
from springcad.mechanics.fem.assembly import Sheet
from springcad.mechanics.fem.pad import PadContact, pad_pressure
from springcad.mechanics.fem.rigid_profile import RigidProfile, rigid_profile

PAD = Sheet(110e9, 0.3, 4.5e-3)
HALF_THICKNESS = 0.175e-3


def hertz(force: float, curvature: float) -> tuple[float, float]:
    """Peak pressure and half width."""
    of_strip = (force, PAD.thickness, curvature, PAD.elastic_modulus)
    return float(peak_pressure(*of_strip)), float(half_width(*of_strip))


def pressed_on_circle(
    radius: float, force: float, *, angle: float = 0.7, depth: float = 0.35e-3, elements: int = 8
) -> PadContact:
    profile = rigid_profile(circle(radius, (1e-3, 0.0), 2001))
    point = np.array([1e-3, 0.0]) + radius * np.array([np.cos(angle), np.sin(angle)])
    return pad_pressure(
        profile, point, force, half_thickness=0.5 * depth, sheet=PAD, elements=elements
    )


def curve(curvature: np.ndarray, step: float) -> tuple[np.ndarray, RigidProfile]:
    """Points of a profile whose curvature is given at equal steps, and the profile."""
    turn = np.concatenate([[0.0], np.cumsum(0.5 * (curvature[1:] + curvature[:-1]) * step)])
    tangents = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    steps = 0.5 * (tangents[1:] + tangents[:-1]) * step
    points = np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
    return points, rigid_profile(points, tangents)


@pytest.mark.parametrize("force", [30.0, 250.0, 320.0])
@pytest.mark.parametrize("radius", [0.2e-3, 0.5e-3, 2e-3])
def test_the_peak_on_a_circle_is_that_of_hertz(radius: float, force: float) -> None:
    found = pressed_on_circle(radius, force)
    peak, strip = hertz(force, 1.0 / radius)
    assert found.peak_pressure == pytest.approx(peak, rel=6e-3)
    assert found.half_width == pytest.approx(strip, abs=strip / 8)
    ellipse = peak * np.sqrt(np.maximum(0.0, 1.0 - (found.places / strip) ** 2))
    inside = np.abs(found.places) < 0.6 * strip
    assert found.pressures[inside] == pytest.approx(ellipse[inside], rel=0.02)


def test_the_peak_converges_to_hertz_with_the_elements() -> None:
    """On a pad much deeper than the strip is wide; the mean of the cases, which share no mesh."""
    cases = [(radius, force) for radius in (0.2e-3, 0.35e-3, 0.5e-3) for force in (20.0, 60.0)]

    def miss(elements: int) -> float:
        found = [pressed_on_circle(*case, elements=elements).peak_pressure for case in cases]
        exact = [hertz(force, 1.0 / radius)[0] for radius, force in cases]
        return float(np.sqrt(np.mean((np.array(found) / exact - 1.0) ** 2)))

    coarse, middle, fine = miss(4), miss(8), miss(24)
    assert middle < 0.2 * coarse
    assert fine < 0.4 * middle
    assert fine < 1e-3


def test_the_pressures_add_up_to_the_force_and_none_of_them_pulls() -> None:
    found = pressed_on_circle(0.5e-3, 250.0)
    force = PAD.thickness * np.trapezoid(found.pressures, found.places)
    assert force == pytest.approx(250.0, rel=1e-12)
    assert found.pressures.min() == 0.0


def test_where_round_the_circle_does_not_matter() -> None:
    peaks = [pressed_on_circle(0.5e-3, 250.0, angle=a).peak_pressure for a in (-2.0, 0.0, 1.3)]
    assert peaks == pytest.approx([peaks[0]] * 3, rel=1e-6)


def test_a_point_off_the_profile_stands_for_the_nearest_one_on_it() -> None:
    profile = rigid_profile(circle(0.5e-3, count=2001))
    on, off = (
        pad_pressure(profile, np.array([x, 0.0]), 200.0, half_thickness=HALF_THICKNESS, sheet=PAD)
        for x in (0.5e-3, 0.503e-3)
    )
    assert off.peak_pressure == pytest.approx(on.peak_pressure, rel=1e-9)


def test_the_held_far_side_raises_the_peak_with_the_square_of_the_width() -> None:
    radius, force = 2e-3, 250.0
    peak, strip = hertz(force, 1.0 / radius)
    ratios = np.array([0.1, 0.2, 0.3])
    rises = np.array(
        [
            pressed_on_circle(radius, force, depth=strip / r, elements=24).peak_pressure / peak - 1
            for r in ratios
        ]
    )
    assert rises == pytest.approx(ratios**2 / 3.0, abs=1e-3, rel=0.1)


@pytest.mark.parametrize("way", [1, -1], ids=["sharper", "flatter"])
def test_on_a_spiral_the_peak_is_that_of_the_curvature_at_its_place(way: int) -> None:
    """Curvature from 600 to 6000 per metre over 0.3 mm, as along the flank of a camshaft."""
    step = 0.5e-6
    curvature = np.geomspace(600.0, 6000.0, 601)[::way]
    points, profile = curve(curvature, step)
    for place, force in ((200, 230.0), (300, 100.0), (400, 50.0)):
        found = pad_pressure(
            profile, points[place], force, half_thickness=HALF_THICKNESS, sheet=PAD
        )
        assert found.peak_pressure == pytest.approx(hertz(force, curvature[place])[0], rel=0.02)


def test_at_a_joint_of_two_arcs_the_peak_lies_between_theirs() -> None:
    curvature = np.where(np.arange(1601) < 800, 700.0, 2800.0)
    points, profile = curve(curvature, 0.5e-6)
    found = pad_pressure(profile, points[800], 200.0, half_thickness=HALF_THICKNESS, sheet=PAD)
    flat, sharp = hertz(200.0, 700.0), hertz(200.0, 2800.0)
    assert 1.1 * flat[0] < found.peak_pressure < 0.9 * sharp[0]
    assert sharp[1] < found.half_width < flat[1]


def test_a_change_of_curvature_beyond_the_strip_changes_nothing() -> None:
    points, profile = curve(np.where(np.arange(1601) < 900, 700.0, 2800.0), 0.5e-6)
    found = pad_pressure(profile, points[800], 200.0, half_thickness=HALF_THICKNESS, sheet=PAD)
    peak, strip = hertz(200.0, 700.0)
    assert strip < 50e-6
    assert found.peak_pressure == pytest.approx(peak, rel=6e-3)


def test_an_end_of_the_profile_under_the_strip_has_no_peak() -> None:
    """The edge of a rigid body cuts in; a strip that ends before the profile does not feel it."""
    _, strip = hertz(200.0, 700.0)
    points, profile = curve(np.full(1001, 700.0), 0.5e-6)

    def peak(room: float) -> float:
        place = points[-1 - round(room / 0.5e-6)]
        found = pad_pressure(profile, place, 200.0, half_thickness=HALF_THICKNESS, sheet=PAD)
        return found.peak_pressure

    assert peak(0.7 * strip) == np.inf
    assert peak(1.5 * strip) == pytest.approx(hertz(200.0, 700.0)[0], rel=6e-3)


def test_a_hollow_profile_and_a_force_that_pulls_are_refused() -> None:
    hollow = rigid_profile(circle(0.5e-3, count=2001)[::-1])
    convex = rigid_profile(circle(0.5e-3, count=2001))
    point = np.array([0.5e-3, 0.0])
    for profile, force in ((hollow, 200.0), (convex, 0.0), (convex, -1.0)):
        with pytest.raises(ValueError, match="positive force on a convex profile"):
            pad_pressure(profile, point, force, half_thickness=HALF_THICKNESS, sheet=PAD)
