"""Contact strips of a tip on the drawn flank, against Hertz where his formula holds."""

from __future__ import annotations

import numpy as np
import pytest
from rotary_cases import spring_of

from springcad.kinds.rotary_flexure.camshaft import seated
from springcad.kinds.rotary_flexure.flank_pressure import flank_strips
from springcad.mechanics.cam_contact import Seat
from springcad.mechanics.contact import contact_modulus, half_width, peak_pressure
from springcad.mechanics.contact_strip import Strips


def pressed(name: str, direction: int) -> tuple[Seat, Strips]:
    spring = spring_of(name)
    side = spring.camshaft.flanks[0 if direction > 0 else 1]
    seat = seated(spring.beam, spring.camshaft_inputs, spring.camshaft, side)
    strips = flank_strips(spring.beam, spring.camshaft_inputs, spring.camshaft, seat, direction)
    return seat, strips


def modulus_of(name: str) -> float:
    beam = spring_of(name).beam.beam
    return contact_modulus(
        *(beam.elastic_modulus, spring_of(name).camshaft_inputs.poisson_ratio) * 2
    )


@pytest.mark.parametrize("direction", [1, -1])
def test_far_from_rest_the_drawn_arcs_waver_about_hertzs_pressure_of_the_exact_flank(
    direction: int,
) -> None:
    """Curvature is a second derivative: arcs within 18 nm of the flank have it within a fifth."""
    spring = spring_of("S1")
    seat, strips = pressed("S1", direction)
    side = spring.camshaft.flanks[0 if direction > 0 else 1]
    far = seat.angle > 0.5 * spring.target.deflection
    curvature = np.interp(seat.angle[far], side.angle, side.curvature)
    exact = peak_pressure(seat.force[far], spring.beam.beam.thickness, curvature, modulus_of("S1"))
    ratio = strips.peak_pressure[far] / exact
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.01)
    assert np.max(np.abs(ratio - 1.0)) < 0.08


def test_beyond_the_pad_the_round_nose_is_pressed_and_not_a_pad_that_goes_on() -> None:
    """S1 at 4 % of the stroke: 6.5 um past the pad, on a flank of radius ρ and a nose of λ.

    The strip, 2 um to either side, is on the nose alone: Hertz with 1/ρ + 1/λ.
    """
    spring = spring_of("S1")
    seat, strips = pressed("S1", 1)
    nose = spring.camshaft_inputs.nose_station
    past = seat.station[0] - nose
    tip = float(spring.found.ribbon.at(np.array([nose])).half_thickness[0])
    side, arc_until = spring.camshaft.flanks[0], spring.camshaft.slot.exact_from[0]
    curvature = float(side.curvature[side.angle == arc_until][0]) + 1.0 / tip
    width, modulus = spring.beam.beam.thickness, modulus_of("S1")
    assert past > 2.0 * half_width(seat.force[0], width, curvature, modulus)
    hertz = peak_pressure(seat.force[0], width, curvature, modulus)
    assert strips.peak_pressure[0] == pytest.approx(float(hertz), rel=0.02)


@pytest.mark.parametrize("name", ["S1", "S3"])
def test_every_strip_bears_its_force(name: str) -> None:
    """The peak is more than the mean pressure, and less than twice it (Hertz: 4/π)."""
    for direction in (1, -1):
        seat, strips = pressed(name, direction)
        mean = seat.force / (2.0 * strips.half_width * spring_of(name).beam.beam.thickness)
        assert np.all(strips.peak_pressure > mean)
        assert np.all(strips.peak_pressure < 2.0 * mean)
