"""Parts off their drawing by contact finite elements, which share none of the design's models.

The mesh is that of a ring with all its edges moved, the flank that of a camshaft read back from its
drawing and moved; the report's sensitivities come from a beam on a root spring and a point contact.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from rotary_cases import spring_of, written_of

from springcad.kinds.rotary_flexure.as_made import Deviation
from springcad.kinds.rotary_flexure.drawn_flank import drawn_flank
from springcad.kinds.rotary_flexure.offset_parts import shortened, thickened
from springcad.kinds.rotary_flexure.response_surface import figures_as_made
from springcad.kinds.rotary_flexure.root_compliance import sector_supports
from springcad.kinds.rotary_flexure.sector_contact import (
    PENALTY,
    SectorContact,
    fillet_stress,
    neighbour_gap,
    sector_contact,
    torque,
    turn_through,
)
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.mechanics.fem.contact import prepare_contact
from springcad.mechanics.fem.model import prepare_model
from springcad.mechanics.fem.rigid_profile import rigid_profile

UM = 1e-6


def moved_contact(name: str, offset: float, outward: float) -> SectorContact:
    """Of direction +1; for a straight flexure, whose shortened ribbon begins on the axis too."""
    spring = written_spring(written_of(name))
    drawn = spring.sector
    assert drawn.ribbon.root_angle == 0.0
    sector = replace(
        drawn,
        ribbon=shortened(thickened(drawn.ribbon, offset), offset),
        root_radius=drawn.root_radius - offset,
        outer_radius=drawn.outer_radius + offset,
        fillet=drawn.fillet - offset,
        blend=drawn.blend - offset,
    )
    contact = sector_contact(replace(spring, sector=sector), 1)
    flank = drawn_flank(spring.camshaft, 1)
    slope = flank.curve(flank.places, 1)
    tangents = slope / np.hypot(*slope.T)[:, None]
    free = np.column_stack([tangents[:, 1], -tangents[:, 0]])
    profile = rigid_profile(flank.points + offset * free + [outward, 0.0], tangents)
    penalty = PENALTY * spring.sheet.elastic_modulus / spring.tip_half_thickness
    solid = contact.model.solid
    pair = prepare_contact(solid, "contact_left", profile, penalty)
    supports = sector_supports(contact.mesh, sector.count, spring.mounting)
    return replace(contact, profile=profile, model=prepare_model(solid, supports, pair))


@cache
def full_load(name: str, offset: float, outward: float) -> tuple[float, float, float]:
    """Torque, fillet stress and gap at the design deflection."""
    contact = moved_contact(name, offset, outward)
    deflection = contact.spring.deflection
    turn = turn_through(contact, [0.3 * deflection, 0.65 * deflection, deflection])[-1]
    assert turn.angle == deflection
    return torque(contact, turn), fillet_stress(contact, turn), neighbour_gap(contact, turn)


@pytest.mark.slow
@pytest.mark.parametrize(("offset", "outward"), [(10 * UM, 0.0), (-10 * UM, 0.0), (0.0, 20 * UM)])
def test_elements_of_moved_parts_change_as_much_as_the_report_says(
    offset: float, outward: float
) -> None:
    """Torque within 1 % of its change: 4.59 for 4.61 %, -4.46 for -4.48, 1.064 for 1.065."""
    drawn, moved = full_load("S1", 0.0, 0.0), full_load("S1", offset, outward)
    here, there = (
        figures_as_made(spring_of("S1"), part)
        for part in (Deviation(), Deviation(edge_offset=offset, contact_radius=outward))
    )
    said = float(there.stiffness / here.stiffness) - 1.0
    assert moved[0] / drawn[0] - 1.0 == pytest.approx(said, rel=0.01)
    said = float(there.root_fillet_stress / here.root_fillet_stress) - 1.0
    assert moved[1] / drawn[1] - 1.0 == pytest.approx(said, rel=0.05)
    assert moved[2] - drawn[2] == pytest.approx(float(there.gap - here.gap), abs=0.3 * UM)
