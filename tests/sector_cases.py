"""Sectors of the springs of paper 004, with their beams, for tests of meshes and root models."""

from __future__ import annotations

from rotary_cases import spring_of

from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry


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
