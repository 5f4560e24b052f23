"""From a torque law to the profile of the roller's element, and back by the forward analysis.

Expected numbers were computed independently (R = 40 mm, r = 4 mm, y0 = 8.95 mm), once with the
linear cantilever of paper 001 and once with a geometrically exact beam with shear.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from roller_cases import CANTILEVER, DEGREE, EXPONENTIAL, FULL, PAPER, paper_joint, power

from springcad.errors import InfeasibleError
from springcad.kinds.roller_cam.curve import curve_through
from springcad.kinds.roller_cam.forward import (
    forward,
    least_gap,
    offset_sensitivity,
    roller_friction,
)
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.roller_cam.part import STATION_LIMITS, exact_part, linear_part
from springcad.kinds.roller_cam.synthesis import ContactProfile, synthesise
from springcad.kinds.roller_cam.tip import carried, exact_tip, linear_carried, linear_tip
from springcad.kinds.target_law import Law, law_of, sampled, table
from springcad.mechanics.cam_contact import seat
from springcad.mechanics.conjugate import conjugate_flank, until
from springcad.mechanics.contact import contact_modulus, peak_pressure

SAMPLES = np.linspace(0.0, FULL, 12)
LAWS = {
    "exponential": EXPONENTIAL,
    "linear": power(1.0, 8.0),
    "power 1.5": power(1.5, 8.0),
    "quadratic": power(2.0, 11.76),
    "cubic": power(3.0, 11.76),
    "fifth power": power(5.0, 11.76),
    "dead zone": power(1.0, 8.0, 0.4 * DEGREE),
    "dead zone, then quadratic": power(2.0, 8.0, 0.4 * DEGREE),
    "table": law_of(table(np.column_stack([SAMPLES, EXPONENTIAL.torque(SAMPLES)])), FULL),
}
BEAMS = {"linear": (linear_tip, linear_carried), "exact": (exact_tip, carried)}


@cache
def profile_of(law: str, beam: str = "exact") -> ContactProfile:
    return synthesise(PAPER, LAWS[law], beam=BEAMS[beam][0])


def angles(law: Law, count: int = 60) -> np.ndarray:
    """From the first touch, without it, to the deflection."""
    return np.linspace(law.dead_zone, law.deflection, count + 1)[1:]


LINEAR = [
    (0.0, 3.991672, 8.692015),
    (0.1, 3.986124, 8.609193),
    (0.5, 3.956805, 8.252130),
    (1.0, 3.886377, 7.700177),
    (1.5, 3.680499, 6.845753),
    (1.9, 3.008042, 5.551144),
]


@pytest.mark.parametrize(("degrees", "m", "n"), LINEAR)
def test_the_profile_of_the_linear_cantilever(degrees: float, m: float, n: float) -> None:
    """Oracle rows A05 to A10; the angles are not among those of the spline."""
    curve = profile_of("exponential", "linear").curve
    place = forward(PAPER, curve, np.array([max(degrees * DEGREE, 1e-9)]), beam=linear_carried)
    np.testing.assert_allclose(1e3 * curve.points(place.place)[0], [m, n], atol=1.5e-6)


def test_the_contact_with_the_exact_beam() -> None:
    """Oracle row A11."""
    angle = np.linspace(0.0, FULL, 20)
    flank = conjugate_flank(
        exact_part(PAPER),
        sampled(EXPONENTIAL, angle),
        count=1,
        direction=1,
        station_limits=STATION_LIMITS,
    )
    assert np.degrees(np.exp(flank.station[-1])) == pytest.approx(38.06916, rel=1e-6)
    np.testing.assert_allclose(1e3 * flank.points[-1], [3.021190, 5.569908], rtol=1e-6)
    stroke = forward(PAPER, profile_of("exponential").curve, np.array([FULL]))
    assert np.degrees(stroke.tip.rotation[0]) == pytest.approx(-1.326100, rel=1e-6)
    assert np.degrees(stroke.gamma[0]) == pytest.approx(38.06916, rel=1e-6)


@pytest.mark.parametrize("beam", BEAMS)
@pytest.mark.parametrize("law", LAWS)
def test_law_to_profile_to_law(law: str, beam: str) -> None:
    """The forward analysis integrates from the other end and knows neither law nor energy."""
    wanted, angle = LAWS[law], angles(LAWS[law])
    found = forward(PAPER, profile_of(law, beam).curve, angle, beam=BEAMS[beam][1])
    torque = wanted.torque(angle)
    assert np.abs(found.torque - torque).max() < 1e-6 * torque[-1]
    np.testing.assert_allclose(found.energy, wanted.energy(angle), atol=2e-6 * found.energy[-1])


@pytest.mark.parametrize("law", LAWS)
def test_the_roller_cuts_into_no_part_of_the_profile(law: str) -> None:
    """Condition 10: the smallest gap is 0, at the contact; without contact it is positive."""
    angle, curve = np.linspace(0.0, FULL, 40), profile_of(law).curve
    assert least_gap(PAPER, curve, forward(PAPER, curve, angle)).min() > -1e-10


@pytest.mark.parametrize("law", ["dead zone", "dead zone, then quadratic"])
def test_the_roller_is_free_in_the_dead_zone(law: str) -> None:
    angle, profile = np.linspace(0.0, 0.4, 30) * DEGREE, profile_of(law)
    stroke = forward(PAPER, profile.curve, angle)
    assert np.abs(stroke.torque).max() < 1e-9
    above = profile.curve.points(np.linspace(-0.3e-3, 0.0, 5))
    np.testing.assert_allclose(np.diff(above, 2, axis=0), 0.0, atol=1e-15)


@pytest.mark.parametrize("law", LAWS)
def test_the_first_contact(law: str) -> None:
    """A law without slope begins beside the roller, with an upright tangent."""
    profile = profile_of(law)
    start, tangent = profile.curve.points(np.zeros(1))[0], profile.curve.tangents(np.zeros(1))[0]
    if law in ("power 1.5", "quadratic", "cubic", "fifth power", "dead zone, then quadratic"):
        roller, rest = PAPER.roller, LAWS[law].dead_zone
        height = roller.offset - roller.drum_radius * np.sin(rest)
        np.testing.assert_allclose(start, [roller.radius, height], atol=1e-12)
        np.testing.assert_allclose(tangent, [0.0, -1.0], atol=2e-3)
    else:
        assert profile.flank.angle[0] == LAWS[law].dead_zone
        np.testing.assert_array_equal(start, profile.flank.points[0])
        np.testing.assert_allclose(tangent, profile.flank.tangents[0], atol=1e-5)


@pytest.mark.parametrize("law", LAWS)
def test_slopes_and_curvature_of_the_curve_are_those_of_the_contact(law: str) -> None:
    profile = profile_of(law)
    inner = slice(3, -3)
    tangents = profile.curve.tangents(profile.place)[inner]
    np.testing.assert_allclose(tangents, profile.flank.tangents[inner], atol=2e-5)
    ratio = -profile.flank.curvature / profile.flank.mate_curvature
    assert ratio.max() < 1.0


def test_what_the_profile_says_of_forces_and_stress() -> None:
    """Oracle row A10 with the linear cantilever; the energy fixes the stress."""
    profile = profile_of("exponential", "linear")
    angle = profile.flank.angle
    for values, expected in (
        (profile.push, 294.8919),
        (profile.pull, 372.4423),
        (profile.tip.stress, 769.187e6),
        (profile.tip.rotation, -1.336263 * DEGREE),
    ):
        spline = np.interp(FULL, angle, values)
        assert spline == pytest.approx(expected, rel=1e-3)
    np.testing.assert_allclose(profile.tip.energy[1:], profile.energy[1:], rtol=1e-9)
    np.testing.assert_allclose(profile.angle_of(profile.place), angle, atol=1e-12)


SPLINES = [(3, 2.2e-4), (5, 2.3e-6)]


@pytest.mark.parametrize(("degree", "expected"), SPLINES)
def test_error_of_the_spline_through_forty_contacts(degree: int, expected: float) -> None:
    """Oracle row A14, to a factor of 2, from 0.02 deg."""
    flank = conjugate_flank(
        linear_part(PAPER),
        sampled(EXPONENTIAL, np.linspace(0.0, FULL, 41)),
        count=1,
        direction=1,
        station_limits=STATION_LIMITS,
    )
    angle = np.linspace(0.02 * DEGREE, FULL, 300)
    curve, _ = curve_through(flank.points, degree)
    found = forward(PAPER, curve, angle, beam=linear_carried)
    error = np.abs(found.torque / EXPONENTIAL.torque(angle) - 1.0).max()
    assert error < 2.0 * expected


def test_torque_is_the_derivative_of_the_energy_on_any_profile() -> None:
    """On a ramp that was made for no law."""
    steep = np.radians(70.0)
    start = np.array([PAPER.roller.radius * np.sin(steep), 8.95e-3])
    start[1] -= PAPER.roller.radius * np.cos(steep)
    way = np.linspace(0.0, 3e-3, 30)[:, None]
    ramp, _ = curve_through(start - way * [np.cos(steep), np.sin(steep)])
    angle, step = np.linspace(0.1, 1.5, 8) * DEGREE, 1e-5
    for beam in (carried, linear_carried):
        less, more = (forward(PAPER, ramp, angle + s, beam=beam).energy for s in (-step, step))
        torque = forward(PAPER, ramp, angle, beam=beam).torque
        np.testing.assert_allclose((more - less) / (2.0 * step), torque, rtol=1e-6)


def test_the_same_as_the_forward_problem_of_the_mechanics_core() -> None:
    profile, rows = profile_of("exponential"), slice(10, -10)
    flank = profile.flank
    found = seat(
        exact_part(PAPER),
        profile.curve.dense(2000),
        flank.angle[rows],
        count=1,
        force=0.9 * flank.force[rows],
        station=flank.station[rows] + 0.1,
        station_limits=STATION_LIMITS,
    )
    stroke = forward(PAPER, profile.curve, flank.angle[rows])
    np.testing.assert_allclose(stroke.torque, found.torque, rtol=1e-6)
    np.testing.assert_allclose(stroke.normal_force, found.force, rtol=1e-6)


@pytest.mark.parametrize(("degrees", "expected"), [(0.05, -0.021), (1.0, -0.009), (1.88, -0.007)])
def test_what_the_linear_cantilever_leaves_out(degrees: float, expected: float) -> None:
    """Its profile with the exact beam is too soft: shear near rest, then large deflections."""
    angle = np.array([degrees * DEGREE])
    stroke = forward(PAPER, profile_of("exponential", "linear").curve, angle)
    error = stroke.torque / EXPONENTIAL.torque(angle) - 1.0
    assert error[0] == pytest.approx(expected, abs=6e-4)


def test_a_micrometre_matters_at_small_angles() -> None:
    """Outward by 1 µm: +43 % at 0.05 deg, +3.5 % at 0.5, +1.2 % at 1.0, +0.2 % at 1.9 deg."""
    angle = np.array([0.05, 0.5, 1.0, 1.9]) * DEGREE
    per_metre = offset_sensitivity(PAPER, profile_of("exponential").curve, angle)
    share = 1e-6 * per_metre / EXPONENTIAL.torque(angle)
    np.testing.assert_allclose(share, [0.43, 0.035, 0.012, 0.002], rtol=0.01, atol=0.5e-3)
    assert np.all((1e-6 * per_metre > 0.007) & (1e-6 * per_metre < 0.024))


def compliance(angle: np.ndarray) -> np.ndarray:
    """Of a contact part, softer at its upper end."""
    s = 1.0 - 0.7 * angle / FULL
    rows = np.stack([6.0 * s**3, 1.5 * s**2], -1), np.stack([1.5 * s**2, 2.0 * s], -1)
    return 0.1e-6 * np.stack(rows, -2)


@pytest.mark.parametrize("beam", BEAMS)
def test_a_compliant_contact_part_is_allowed_for(beam: str) -> None:
    """With it the law is met; left out of the design it costs more than half of the torque."""
    tip, carried_tip = BEAMS[beam]
    angle = angles(EXPONENTIAL)
    torque = EXPONENTIAL.torque(angle)
    errors = []
    for profile in (
        synthesise(PAPER, EXPONENTIAL, beam=tip, compliance=compliance),
        profile_of("exponential", beam),
    ):
        stroke = forward(
            PAPER,
            profile.curve,
            angle,
            beam=carried_tip,
            compliance=lambda place, profile=profile: compliance(profile.angle_of(place)),
        )
        errors.append(stroke.torque - torque)
    assert np.abs(errors[0]).max() < 1e-6 * torque[-1]
    assert (errors[1] / torque).min() < -0.5


def test_a_bump_on_the_profile_is_found() -> None:
    """As high as it is where the roller would touch under it; out of reach it is nothing."""
    profile, rows = profile_of("exponential"), np.array([10, 50, 90])
    curve, place = profile.curve, profile.place[50]
    along = np.linspace(0.0, curve.length, 400)
    bump = 20e-6 * np.exp(-(((along - place) / 0.2e-3) ** 2))
    bumped, _ = curve_through(curve.points(along) - bump[:, None] * curve.normals(along), 3)
    stroke = forward(PAPER, curve, profile.flank.angle[rows])
    before, at, after = least_gap(PAPER, bumped, stroke)
    assert at == pytest.approx(-20e-6, rel=0.01)
    assert min(before, after) > -1e-6


def test_a_roller_that_leaves_the_profile_is_refused() -> None:
    with pytest.raises(InfeasibleError, match="up to which the roller rests on") as caught:
        forward(PAPER, profile_of("exponential").curve, np.array([9.0 * DEGREE]))
    assert 1.12 * FULL < caught.value.value < caught.value.limit == 9.0 * DEGREE


def test_friction_dissipates_the_work_of_sliding() -> None:
    profile = profile_of("exponential")
    loop = roller_friction(PAPER, profile.curve, until(profile.flank, FULL), 0.02)
    assert loop.loss == pytest.approx(loop.sliding_work, rel=0.02)
    assert np.all(loop.loading[1:] > loop.unloading[1:])


def test_pressure_is_hertz_with_both_curvatures() -> None:
    profile = profile_of("exponential")
    modulus = contact_modulus(206e9, 0.29, 210e9, 0.3)
    stroke = forward(PAPER, profile.curve, profile.flank.angle[5:-5])
    here = peak_pressure(stroke.normal_force, CANTILEVER.width, stroke.curvature, modulus)
    made = profile.flank
    there = peak_pressure(made.force, CANTILEVER.width, made.relative_curvature, modulus)
    np.testing.assert_allclose(here, there[5:-5], rtol=1e-5)
    alone = peak_pressure(stroke.normal_force, CANTILEVER.width, 1.0 / 4e-3, modulus)
    assert np.all(here < alone)


def test_the_overrun_is_left_out_where_the_cantilever_cannot_follow() -> None:
    """With R = 24.9 mm the law can be had to its deflection, and little beyond."""
    profile = synthesise(paper_joint(24.9e-3), EXPONENTIAL)
    reached = profile.flank.angle[-1] / FULL
    assert 1.0 <= reached < 1.12
    assert profile_of("exponential").flank.angle[-1] == pytest.approx(1.12 * FULL)


@pytest.mark.parametrize(
    ("law", "joint", "said"),
    [
        (EXPONENTIAL, paper_joint(23.5e-3), "too soft"),
        (power(0.7, 11.76), PAPER, "slope of the law at rest"),
        (power(1.0, 8.0), replace(PAPER, roller=replace(PAPER.roller, drum_radius=9e-3)), "slope"),
    ],
)
def test_what_no_profile_gives_is_refused(law: Law, joint: Joint, said: str) -> None:
    with pytest.raises(InfeasibleError, match=said):
        synthesise(joint, law)
