"""Dimensional similarity: a roller cam with all lengths times f is the same roller cam.

With the same material and the torque times f³ it bears the same stresses at the same angles. What
would break this is a length in the program that is neither the spec's nor the workshop's; the
workshop's (least web, gap and inside radius) grow with it here. A nanometre of the drawing does
not: in a small joint its arcs waver more.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from rotary_cases import SPECS

from springcad.kinds.roller_cam.contact_model import element_contact
from springcad.kinds.roller_cam.design import make_joint
from springcad.kinds.roller_cam.inputs import roller_spec
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.spec.source import read_spec

LENGTHS = {
    "joint.drum_radius": 40.0,
    "joint.roller_radius": 4.0,
    "joint.roller_offset": 8.95,
    "envelope.thickness": 3.4,
    "cantilever.length": 24.4,
    "cantilever.height": 4.9,
    "cantilever.root_fillet": 1.0,
    "contact_part.thickness": 3.0,
    "mount.length": 10.0,
    "mount.height": 15.0,
    "mount.hole_diameter": 4.0,
}
SHOP = {"min_web": 0.3, "min_gap": 0.3, "min_inside_radius": 0.15}


@cache
def joint(factor: float) -> MadeJoint:
    """The joint of paper 001 in another size."""
    shop = ", ".join(f"{key}: {value * factor:g} mm" for key, value in SHOP.items())
    overrides = (
        *(f"{key}={value * factor:g} mm" for key, value in LENGTHS.items()),
        f"target.law={{exponential: {{scale: {0.15 * factor**3:.10g} N*m, decade: 1 deg}}}}",
        f"process={{name: wire-edm, {shop}}}",
    )
    spec = read_spec(SPECS / "roller-paper.yaml", overrides)
    return make_joint(roller_spec(spec.model), lambda _: None)


@pytest.mark.parametrize("factor", [0.25, 4.0, 400.0 / 24.4], ids=["quarter", "four", "400 mm"])
def test_a_joint_of_another_size_is_the_same_joint(factor: float) -> None:
    one, other = joint(1.0), joint(factor)
    full, scaled = one.stroke.torque[-1], other.stroke.torque / factor**3
    np.testing.assert_allclose(other.stroke.angle, one.stroke.angle, rtol=1e-12)
    np.testing.assert_allclose(scaled, one.stroke.torque, atol=0.006 * full)
    np.testing.assert_allclose(
        other.geometry.points / factor, one.geometry.points, atol=1e-3 * 4e-3
    )
    assert other.mass / factor**3 == pytest.approx(one.mass, rel=1e-4)
    middle = other.compensated.compliance.at_angle(np.array([0.015])) * factor
    assert middle == pytest.approx(
        one.compensated.compliance.at_angle(np.array([0.015])), rel=0.01, abs=1e-10
    )
    pressure = [np.max(each.strips.peak_pressure) for each in (one, other)]
    assert pressure[1] == pytest.approx(pressure[0], rel=0.05)


@pytest.mark.parametrize("factor", [0.25, 400.0 / 24.4], ids=["quarter", "400 mm"])
def test_it_is_judged_on_as_many_elements(factor: float) -> None:
    count, other = (
        len(element_contact(each.geometry, each.joint.roller).model.solid.mesh.elements)
        for each in (joint(1.0), joint(factor))
    )
    assert other == pytest.approx(count, rel=0.02)
