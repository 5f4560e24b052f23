"""The torque of the finished springs by contact finite elements, which share none of its models.

Design and response use a beam on a root spring, with the contact as one point. Here one sector of
the ring as it is cut (rim, fillets, taper, round nose; nonlinear plane stress, 8-node elements,
cyclic symmetry) is pushed by the camshaft's flank as it is cut.
"""

from __future__ import annotations

import numpy as np
import pytest
from rotary_cases import spring_of
from sector_cases import sector_of

from springcad.kinds.rotary_flexure.cam_slot import flank_points
from springcad.kinds.rotary_flexure.root_compliance import sector_supports
from springcad.kinds.rotary_flexure.sector_mesh import FINE, sector_mesh
from springcad.mechanics.fem.assembly import Sheet, prepare_solid
from springcad.mechanics.fem.contact import prepare_contact
from springcad.mechanics.fem.newton import Load, prepare_model, solve_path
from springcad.mechanics.fem.rigid_profile import rigid_profile

PENALTY = 2e15
"""Pa/m; ten times as much changes the torque by less than 0.1 %."""
PARTS = (0.25, 0.5, 0.75, 1.0)
"""Angles, over the design deflection."""


@pytest.mark.slow
@pytest.mark.parametrize("direction", [1, -1], ids=["counter-clockwise", "clockwise"])
@pytest.mark.parametrize("name", ["S1", "S2", "S3", "S4"])
def test_contact_elements_give_the_torque_of_the_report(name: str, direction: int) -> None:
    spring = spring_of(name)
    inputs = spring.case.inputs
    mesh = sector_mesh(sector_of(name), FINE)
    sheet = Sheet(inputs.elastic_modulus, 0.3, inputs.thickness)
    solid = prepare_solid(mesh, sheet)
    # The profile runs with the camshaft on its left: inward beside one edge, outward at the other.
    points = flank_points(spring.camshaft.slot, direction)[::direction]
    edge = "contact_left" if direction > 0 else "contact_right"
    contact = prepare_contact(solid, edge, rigid_profile(points), PENALTY)
    supports = sector_supports(mesh, inputs.count, "dowels")
    still = np.zeros(mesh.unknowns)
    angles = np.array(PARTS) * inputs.deflection
    states = solve_path(
        prepare_model(solid, supports, contact),
        [Load(still, still, direction * angle) for angle in angles],
    )
    # On the profile, against its motion.
    torque = -direction * inputs.count * np.array([state.contact.torque for state in states])
    stroke = spring.strokes[0 if direction > 0 else 1]
    reported = np.interp(angles, stroke.angle, stroke.torque)
    np.testing.assert_allclose(torque, reported, rtol=0.004)
    np.testing.assert_allclose(torque, inputs.stiffness * angles, rtol=0.004)
