"""Contact finite elements of the roller-cam's element: equilibrium, work and the beam's stress."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from roller_element_cases import DEGREE, JOINT, clamped, dimensions, rigid_profile
from scipy.integrate import simpson

from springcad.geometry.biarc import exact_polyline
from springcad.kinds.roller_cam.contact_compliance import profile_compliance
from springcad.kinds.roller_cam.contact_model import (
    contact_part_stress,
    element_contact,
    press_through,
    root_stress,
    side_stress,
    torque,
)
from springcad.kinds.roller_cam.contact_pad import contact_pressure
from springcad.kinds.roller_cam.element import element_geometry, element_profile
from springcad.kinds.roller_cam.element_mesh import Density, coarse, fine
from springcad.kinds.roller_cam.forward import forward
from springcad.kinds.roller_cam.strip import roller_strips
from springcad.mechanics.contact import contact_modulus, peak_pressure

COARSE = coarse(4e-3)
FINE = fine(4e-3)


def test_the_torque_does_the_work_that_the_element_stores() -> None:
    """Exact virtual work of the tilted roller against the strain energy, which knows no arm."""
    element = element_contact(element_geometry(rigid_profile(), dimensions()), JOINT.roller, FINE)
    angle = np.linspace(1.0, 1.4, 9) * DEGREE
    presses = press_through(element, angle)
    energy = presses[-1].state.energy - presses[0].state.energy
    work = simpson([torque(element, press) for press in presses], x=angle)
    assert energy == pytest.approx(work, rel=2e-3)


def test_roller_pulls_along_and_pushes_down() -> None:
    element = element_contact(element_geometry(rigid_profile(), dimensions()), JOINT.roller, COARSE)
    (press,) = press_through(element, [1.0 * DEGREE])
    pull, push = press.force
    assert pull > 0.0 > push
    # all the torque but a thousandth is the push on the arm of the drum
    assert torque(element, press) == pytest.approx(-push * JOINT.roller.drum_radius, rel=2e-3)


def test_beam_with_the_elements_compliance_is_confirmed_over_the_whole_stroke() -> None:
    """At full stroke the softer element gives more torque than the law, not less."""
    profile, size = rigid_profile(), clamped(1.1e-3)
    angle = np.array([0.2, 0.7, 1.2, 1.6, 1.9]) * DEGREE
    element = element_contact(element_geometry(profile, size), JOINT.roller, FINE)
    contact = np.array([torque(element, press) for press in press_through(element, angle)])
    found = profile_compliance(profile, size)
    beam = forward(JOINT, profile.curve, angle, compliance=found.at_place)
    np.testing.assert_allclose(contact, beam.torque, rtol=6e-3)
    assert contact[-1] > profile.torque[np.searchsorted(profile.flank.angle, angle[-1])]


def test_beam_on_a_turning_root_is_confirmed_for_a_mount_in_a_pocket() -> None:
    """The pocket takes a tenth of the torque of a profile that is made for plates."""
    profile, angle = rigid_profile(), np.array([0.7, 1.9]) * DEGREE
    size = dimensions(3e-3, mounting="pocket")
    beam = replace(JOINT.cantilever, pocket_fillet=size.root_fillet)
    profile = replace(profile, joint=replace(JOINT, cantilever=beam))
    element = element_contact(element_geometry(profile, size), JOINT.roller, COARSE)
    presses = press_through(element, angle)
    found = profile_compliance(profile, size)
    stroke = forward(profile.joint, profile.curve, angle, compliance=found.at_place)
    contact = [torque(element, press) for press in presses]
    np.testing.assert_allclose(contact, stroke.torque, rtol=2e-3)
    force = [float(np.hypot(*press.force)) for press in presses]
    np.testing.assert_allclose(force, stroke.normal_force, rtol=2e-3)
    plates = dimensions(3e-3)
    clamped = forward(
        JOINT, profile.curve, angle, compliance=profile_compliance(rigid_profile(), plates).at_place
    )
    assert np.all(stroke.torque < 0.95 * clamped.torque)


def test_pressure_of_a_block_is_that_of_the_strip() -> None:
    """And both are Hertz's, where the curvature changes little."""
    profile, size = rigid_profile(), dimensions(3e-3)
    geometry = element_geometry(profile, size)
    element = element_contact(geometry, JOINT.roller, COARSE)
    (press,) = press_through(element, [1.2 * DEGREE])
    outline = exact_polyline(element_profile(geometry).outer)
    beam = JOINT.cantilever
    modulus = contact_modulus(*(beam.elastic_modulus, beam.poisson_ratio) * 2)
    compliance = profile_compliance(profile, size).at_place
    stroke = forward(JOINT, profile.curve, np.array([press.angle]), compliance=compliance)
    (strip,) = roller_strips(JOINT, profile.curve, stroke).peak_pressure
    assert contact_pressure(element, press, outline) == pytest.approx(strip, rel=0.01)
    (hertz,) = peak_pressure(stroke.normal_force, beam.width, stroke.curvature, modulus)
    assert strip == pytest.approx(hertz, rel=0.01)


def test_stress_beyond_the_notch_is_the_beams() -> None:
    profile, size = rigid_profile(), dimensions()
    element = element_contact(element_geometry(profile, size), JOINT.roller, FINE)
    (press,) = press_through(element, [1.5 * DEGREE])[-1:]
    pull, push = press.force
    beam = JOINT.cantilever
    moved = press.state.displacement.reshape(-1, 2)
    assert press.state.contact is not None
    contact = press.state.contact
    weights = contact.pressure * element.model.contact.weights  # type: ignore[union-attr]
    x, y = np.einsum("kg,kgi->i", weights, contact.positions) / weights.sum()
    # about the section one height from the clamp, where it is now
    mesh = element.model.solid.mesh
    at = np.argmin(np.hypot(*(mesh.nodes - [beam.height - beam.length, 0.0]).T))
    place = mesh.nodes[at] + moved[at]
    moment = (x - place[0]) * push - (y - place[1]) * pull
    nominal = 6.0 * abs(moment) / (beam.width * beam.height**2) + pull / (beam.width * beam.height)
    assert side_stress(element, press) == pytest.approx(nominal, rel=0.02)


@pytest.mark.slow
def test_the_notch_of_the_root_is_resolved_and_a_larger_fillet_blunts_it() -> None:
    profile, angle = rigid_profile(), [1.0 * DEGREE]
    finer = Density(across=16, through=10, fillet=14, contact=0.05e-3)

    def notch(radius: float, density: Density) -> float:
        size = dimensions(root_fillet=radius, mounting="pocket")
        element = element_contact(element_geometry(profile, size), JOINT.roller, density)
        (press,) = press_through(element, angle)
        return root_stress(element, press) / side_stress(element, press)

    sharp = notch(0.5e-3, FINE)
    assert sharp > 1.2 * notch(2e-3, FINE)
    assert sharp == pytest.approx(notch(0.5e-3, finer), rel=0.03)


def test_a_thin_contact_part_is_stressed_more() -> None:
    profile, stresses = rigid_profile(), []
    for thickness in (1e-3, 3e-3):
        geometry = element_geometry(profile, dimensions(thickness))
        element = element_contact(geometry, JOINT.roller, COARSE)
        (press,) = press_through(element, [1.0 * DEGREE])
        stresses.append(contact_part_stress(element, press))
    assert stresses[0] > 1.2 * stresses[1]
