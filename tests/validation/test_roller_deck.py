"""The deck of a roller cam's element: CalculiX finds in it what our elements find.

The joint of paper 001; the test reads what an engineer would read, the comments of the deck and
CalculiX's prints.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from fem_cases import calculix_prints, nodal_stresses, printed_vectors
from roller_element_cases import DEGREE, JOINT, dimensions, rigid_profile

from springcad.kinds.roller_cam.contact_model import element_contact, press_through
from springcad.kinds.roller_cam.deck import element_deck
from springcad.kinds.roller_cam.element import element_geometry
from springcad.kinds.roller_cam.element_mesh import Density
from springcad.mechanics.fem.deck import SLICE
from springcad.mechanics.fem.recovery import nodal_stress

LIGHT = Density(across=4, through=4, fillet=2, contact=0.1e-3)
"""Enough to compare two programs on the same elements, in seconds."""


def findings(deck: str) -> np.ndarray:
    """What the comments say that we found: step, degrees, force x and y, torque (angles, 5)."""
    rows = re.findall(r"^\*\* +(\d+(?: +[-\d.e+]+){4})$", deck, flags=re.MULTILINE)
    return np.array([row.split() for row in rows], dtype=float)


@pytest.mark.slow
def test_calculix_repeats_the_second_opinion_to_the_full_deflection(
    require_tool: Callable[[str], str], tmp_path: Path
) -> None:
    """Push within 0.5 %, force within 0.6 %, its direction within 0.01 rad (CalculiX takes it from
    faces, not the curve); the cantilever's side moved within 0.5 %, its stress within 1 %.
    """
    geometry = element_geometry(rigid_profile(), dimensions(3e-3))
    element = element_contact(geometry, JOINT.roller, LIGHT)
    (press,) = press_through(element, [1.9 * DEGREE])
    deck = element_deck(element, [press], "paper")
    printed = calculix_prints(require_tool("ccx"), deck, tmp_path, timeout=300)
    numbers = re.findall(r"total surface force .*\n\s*\n(.*)\n", printed)
    pull, push = np.array(numbers[-1].split()[:2], dtype=float)
    ((step, degrees, our_pull, our_push, torque),) = findings(deck)
    assert (step, degrees) == (2.0, 1.9)
    assert push == pytest.approx(our_push, rel=5e-3)
    assert np.hypot(pull, push) == pytest.approx(np.hypot(our_pull, our_push), rel=6e-3)
    assert np.arctan2(push, pull) == pytest.approx(np.arctan2(our_push, our_pull), abs=0.01)
    factor = JOINT.cantilever.width / SLICE
    assert torque == pytest.approx(-push * factor * JOINT.roller.drum_radius, rel=8e-3)

    mesh, state = element.model.solid.mesh, press.state
    side = mesh.node_sets["lower side"]
    moved = printed_vectors(printed, "displacements", "PART", side)[-1]
    ours = state.displacement.reshape(-1, 2)[side]
    np.testing.assert_allclose(moved, ours, rtol=0.0, atol=5e-3 * np.ptp(ours[:, 1]))
    x = mesh.nodes[side, 0]
    plain = side[(x > -0.75 * JOINT.cantilever.length) & (x < -0.25 * JOINT.cantilever.length)]
    stress = nodal_stresses(tmp_path / "job.frd", plain)[-1, :, 0]
    known = nodal_stress(element.model.solid, state.displacement)[0, plain]
    np.testing.assert_allclose(stress, known, rtol=0.0, atol=1e-2 * np.abs(known).max())
