"""The second opinion of one direction as an input deck of CalculiX and Abaqus."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from springcad import __version__
from springcad.kinds.rotary_flexure.judge import SHARES
from springcad.kinds.rotary_flexure.sector_contact import (
    WAYS,
    SectorContact,
    Turn,
    sector_contact,
    side_stress,
    torque,
    turn_through,
)
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.mechanics.fem.deck import SLICE, slice_deck
from springcad.mechanics.fem.deck_contact import rigid_strip
from springcad.mechanics.fem.model import Load
from springcad.mechanics.fem.recovery import edge_stress
from springcad.written import WrittenDesign


def judge_decks(design: WrittenDesign) -> dict[str, str]:
    """Direction as a word → deck with the angles at which the second opinion compares.

    Raises:
        IncompleteDesignError: the report or a drawing lacks what the model needs.
        ValueError: the sector has no valid mesh, or the flexure is not touched.
    """
    spring = written_spring(design)
    decks = {}
    for direction, way in WAYS.items():
        sector = sector_contact(spring, direction)
        turns = turn_through(sector, [share * spring.deflection for share in SHARES])
        decks[way] = sector_deck(sector, turns, design.name)
    return decks


def sector_deck(sector: SectorContact, turns: Sequence[Turn], name: str) -> str:
    """The sector turned to the angles of ``turns`` in order, two steps for each.

    Comments say what the deck is, how to get the torque of the spring from it, and what our own
    elements found at each angle.

    Args:
        turns: of ``turn_through``.
        name: of the design, plain ASCII.

    Raises:
        ValueError: the flexure is not touched in any of ``turns``.
    """
    contact = sector.model.contact
    assert contact is not None
    states = [turn.state.contact for turn in turns if turn.state.contact is not None]
    still = np.zeros(sector.mesh.unknowns)
    way = WAYS[sector.direction]
    return slice_deck(
        sector.mesh,
        sector.spring.sheet,
        sector.model.constraints,
        [Load(still, still, turn.state.load.rotation) for turn in turns],
        strip=rigid_strip(contact, states),
        title=f"{name}, {way}",
        notes=[*_explanation(sector, name, way), *_findings(sector, turns)],
    )


def slice_factor(sector: SectorContact) -> float:
    """What a moment of the deck is multiplied with to be that of the whole spring."""
    return sector.spring.sector.count * sector.spring.sheet.thickness / SLICE


def middle_nodes(sector: SectorContact) -> tuple[int, int]:
    """The nodes half way along the left and right side of the flexure, numbered from 0."""
    left, right = (sector.mesh.edge_sets[f"flank_{side}"] for side in ("left", "right"))
    return int(left[len(left) // 2, 1]), int(right[len(right) // 2, 1])


def _explanation(sector: SectorContact, name: str, way: str) -> list[str]:
    """What the deck is and how to read its results."""
    spring = sector.spring
    count = spring.sector.count
    return [
        f"The second opinion of springcad {__version__} on the rotary flexure spring {name},",
        f"camshaft turned {way}, for CalculiX (ccx) and Abaqus/Standard.",
        "",
        "Units: m, N, Pa. The axis of the camshaft is the origin; the unloaded flexure lies on",
        "the positive x axis, its root outside.",
        f"PART: one of {count} equal sectors of the ring, plane stress. Both cut sides move alike",
        f"(cyclic symmetry); the outer edge is held as by the mounting: {spring.mounting}.",
        "PROFILE: a strip along the flank of the camshaft as drawn, all of its nodes moved.",
        "Contact: penalty, without friction.",
        f"Thickness: a slice of {SLICE:g} m of the sheet of {spring.sheet.thickness:g} m, since",
        "CalculiX makes solids of plane elements. Displacements and stresses are those of the",
        f"spring; its torque is {slice_factor(sector):.12g} times the moment of the slice.",
        "Steps: two for each angle. The first turns the camshaft, the second holds it and lets",
        "the solver find the directions of contact again. Compare after the second.",
        "Moment of the slice: in CalculiX the last of the six numbers below 'total surface force",
        "and moment about the origin'; in Abaqus ask for CMN.",
        "Or add up (x + U1) RF2 - (y + U2) RF1 over the node set PROFILE.",
        "Stress: along the surface. At a node of a free side it is S11 + S22, since the stress",
        "across is zero.",
    ]


def _findings(sector: SectorContact, turns: Sequence[Turn]) -> list[str]:
    """What our elements found, a line for each turn."""
    left, right = middle_nodes(sector)
    lines = [
        "",
        "Found by springcad: after step; angle without free play (deg); torque of the spring",
        "(N m); moment of the slice (N m); stress at two nodes in the middle of the flexure (Pa);",
        "largest stress along its sides away from root fillet and pad (Pa).",
        f"step   angle        torque        moment  at {left + 1:6d}  at {right + 1:6d}    largest",
    ]
    for k, turn in enumerate(turns):
        whole = torque(sector, turn)
        middle = (_middle_stress(sector, turn, side) for side in ("left", "right"))
        stresses = [*middle, side_stress(sector, turn)]
        lines.append(
            f"{2 * k + 2:4d}{math.degrees(turn.angle):8.3f}{whole:14.6g}"
            f"{sector.direction * whole / slice_factor(sector):14.6g}"
            + "".join(f"{stress:11.4g}" for stress in stresses)
        )
    return lines


def _middle_stress(sector: SectorContact, turn: Turn, side: str) -> float:
    """Stress half way along a side of the flexure (Pa)."""
    stress = edge_stress(sector.model.solid, turn.state.displacement, f"flank_{side}")
    return float(np.mean(stress[len(stress) // 2]))
