"""Contact pressure of the second opinion: a block of the tip, pressed on the flank as drawn.

The elements of the sector are longer than the contact strip: a few of their points bear the force,
and the middle of these is beside the place of contact by up to half of the strip's width, over
which the flank's curvature near rest changes by a fifth. But the elements know the force, and which
way the tip has turned and where its nose has come to: the flank is touched where it is parallel
to the tip. Both bodies are elastic in the block.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.rotary_flexure.sector_contact import SectorContact, Turn
from springcad.mechanics.contact import contact_modulus
from springcad.mechanics.contact_strip import INNER
from springcad.mechanics.fem.pad import pad_pressure
from springcad.mechanics.fem.rigid_profile import RigidProfile, rigid_profile
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]


def contact_pressure(sector: SectorContact, turn: Turn) -> float:
    """Peak pressure between tip and flank (Pa); infinite where the contact is at a corner, not a
    number where nothing touches or the flank is hollow or so flat that there is no strip.
    """
    contact = turn.state.contact
    assert contact is not None
    force = float(np.hypot(*contact.force))
    difference = _difference(sector, *_tip(sector, turn))
    heights = difference.curve(difference.places, 1)[:, 1]
    # The body is below and runs to the left: on its top the slope turns from upwards to downwards.
    tops = np.flatnonzero((heights[:-1] > 0.0) & (heights[1:] <= 0.0))
    if force == 0.0 or not len(tops):
        return math.nan
    top = tops[0]
    share = heights[top] / (heights[top] - heights[top + 1])
    place = difference.places[top] + share * np.diff(difference.places)[top]
    sheet = sector.spring.sheet
    modulus = contact_modulus(*(sheet.elastic_modulus, sheet.poisson_ratio) * 2)
    try:
        return pad_pressure(
            difference,
            difference.curve(place),
            force,
            half_thickness=sector.spring.tip_half_thickness,
            sheet=replace(sheet, elastic_modulus=modulus),
        ).largest_within(INNER)
    except ValueError:
        return math.nan


def _tip(sector: SectorContact, turn: Turn) -> tuple[Floats, Floats]:
    """Where the pad ends and its direction towards the nose (2,), in the camshaft's frame.

    The direction is that of the other side, which no contact dents.
    """
    mesh, sides = sector.mesh, ("flank_left", "flank_right")
    pushed, other = sides if sector.direction > 0 else sides[::-1]
    (end,) = np.intersect1d(mesh.node_sets[pushed], mesh.node_sets["nose"])
    (far_end,) = np.intersect1d(mesh.node_sets[other], mesh.node_sets["nose"])
    moved = mesh.nodes + turn.state.displacement.reshape(-1, 2)
    moved = rotated(moved, np.asarray(-turn.state.load.rotation))
    away = np.hypot(*(mesh.nodes[mesh.node_sets[other]] - mesh.nodes[far_end]).T)
    near = away < sector.spring.tip_half_thickness
    outwards = np.polyfit(away[near], moved[mesh.node_sets[other][near]], 1)[0]
    return moved[end], -outwards / np.hypot(*outwards)


def _difference(sector: SectorContact, end: Floats, inwards: Floats) -> RigidProfile:
    """The body that is as far from a straight pad as the flank is from the tip.

    The flank with what the round nose has fallen back from the pad added to its gap. Its first
    coordinate is along the pad from the nose's beginning, its second across, towards the tip.
    """
    flank, radius = sector.profile, sector.spring.tip_half_thickness
    tangent = sector.direction * inwards
    axes = np.column_stack([tangent, [tangent[1], -tangent[0]]])
    # Where the nose begins the curvature jumps: a point of the profile has to be there.
    beginning = np.interp(0.0, (flank.points - end) @ tangent, flank.places)
    places = np.union1d(flank.places, beginning)
    points, slopes = (flank.curve(places) - end) @ axes, flank.curve(places, 1) @ axes
    past = np.clip(sector.direction * points[:, 0], 0.0, 0.5 * radius)
    fallen = radius - np.sqrt(radius**2 - past**2)
    tilt = sector.direction * past / np.sqrt(radius**2 - past**2)
    points[:, 1] -= fallen
    slopes[:, 1] -= tilt * slopes[:, 0]
    return rigid_profile(points[::-1], -slopes[::-1])
