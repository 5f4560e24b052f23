"""Sectors of the springs of paper 004, with their beams, for tests of meshes and root models."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from rotary_cases import spring_of, written_of

from springcad.kinds.rotary_flexure.sector_contact import sector_contact, torque, turn_through
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry
from springcad.kinds.rotary_flexure.written_spring import written_spring


def sector_of(name: str) -> SectorGeometry:
    """One sector of a shipped spec's ring, with the fillet that the design chose."""
    spring = spring_of(name)
    return SectorGeometry(
        ribbon=spring.found.ribbon,
        root_radius=spring.case.inputs.root_radius,
        outer_radius=spring.case.outer_radius,
        count=spring.case.inputs.count,
        fillet=spring.fillet,
        blend=spring.sized.blend,
    )


@cache
def rough_cycle(name: str, friction: float) -> tuple[np.ndarray, np.ndarray]:
    """Angles and torques of contact elements with friction: 8 up to the full deflection, 4 back."""
    spring = written_spring(written_of(name))
    sector = sector_contact(spring, 1)
    assert sector.model.contact is not None
    rough = replace(sector.model.contact, friction=friction)
    sector = replace(sector, model=replace(sector.model, contact=rough))
    up = np.linspace(0.125, 1.0, 8) * spring.deflection
    turns = turn_through(sector, [*up, *up[-2:2:-1]])
    angles = np.array([turn.angle for turn in turns])
    return angles, np.array([torque(sector, turn) for turn in turns])
