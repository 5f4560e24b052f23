"""The second opinion as input decks of CalculiX and Abaqus."""

from __future__ import annotations

import math

from springcad import __version__
from springcad.kinds.leaf_2dof.judge import judged_strokes, pressed
from springcad.kinds.leaf_2dof.leaf_mesh import LeafContact, Press, clamp_stress, turned
from springcad.kinds.leaf_2dof.written_leaf import written_leaf
from springcad.mechanics.fem.deck import SLICE, slice_deck
from springcad.mechanics.fem.deck_contact import rigid_strip
from springcad.written import WrittenDesign


def judge_decks(design: WrittenDesign) -> dict[str, str]:
    """A deck for each effective length of the second opinion, numbered from the shortest.

    Raises:
        IncompleteDesignError: the report or the drawing lacks what the model needs.
        ValueError: no equilibrium of leaf and roller is found.
    """
    known = written_leaf(design)
    presses = [pressed(known, stroke) for stroke in judged_strokes(known)]
    return {
        f"leaf-{number}": leaf_deck(contact, pressed_to, design.name)
        for number, (contact, pressed_to) in enumerate(presses, start=1)
    }


def leaf_deck(contact: LeafContact, presses: list[Press], name: str) -> str:
    """The leaf bent to the angles of ``presses`` in order, two steps for each.

    Raises:
        ValueError: the roller does not touch the leaf.
    """
    model = contact.model
    states = [press.state.contact for press in presses if press.state.contact is not None]
    if not states or model.contact is None:
        raise ValueError("the roller does not touch the leaf")
    return slice_deck(
        model.solid.mesh,
        model.solid.sheet,
        model.constraints,
        [turned(contact, press.angle) for press in presses],
        strip=rigid_strip(model.contact, states),
        title=f"springcad {__version__}, {name}",
        notes=_explanation(contact, presses, name),
    )


def _explanation(contact: LeafContact, presses: list[Press], name: str) -> list[str]:
    """What the deck is, how to read its results, and what our elements found."""
    sheet = contact.model.solid.sheet
    factor = sheet.thickness / SLICE
    rows = [
        f"{2 * i + 2:4d} {math.degrees(press.angle):12.6g} {press.torque / factor:14.6g} "
        f"{press.force / factor:14.6g} {clamp_stress(contact, press):14.6g}"
        for i, press in enumerate(presses)
    ]
    return [
        f"The second opinion of springcad {__version__} on the leaves {name},",
        "for CalculiX (ccx) and Abaqus/Standard.",
        "",
        "Units: m, N, Pa. The origin is the pivot of the axis, x along the lever at rest.",
        f"PART: one leaf in plane stress, seen from its edge, bent over {contact.length:g} m.",
        "PROFILE: a strip along the roller; all of it turns about the pivot.",
        "Contact: penalty, without friction.",
        f"Thickness: a slice of {SLICE:g} m of the leaf's width of {sheet.thickness:g} m, since",
        f"CalculiX makes solids of plane elements; the whole has {factor:.12g} times the forces.",
        "Steps: two for each angle. The first turns the roller, the second holds it and lets the",
        "solver find the directions of contact again. Compare after the second.",
        "Torque of the slice: in CalculiX the moment about the origin, below the surface force.",
        "",
        "What springcad found: step, angle (deg), torque (N m) and force (N) of the slice,",
        "largest stress at the clamp (Pa)",
        *rows,
    ]
