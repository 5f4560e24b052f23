"""The second opinion as an input deck of CalculiX and Abaqus."""

from __future__ import annotations

import math

from springcad import __version__
from springcad.kinds.roller_cam.contact_model import (
    ElementContact,
    Press,
    element_contact,
    press_through,
    raised,
    torque,
    turned,
)
from springcad.kinds.roller_cam.judge import SHARES
from springcad.kinds.roller_cam.written_joint import written_joint
from springcad.mechanics.fem.deck import SLICE, slice_deck
from springcad.mechanics.fem.deck_contact import rigid_strip
from springcad.written import WrittenDesign


def judge_decks(design: WrittenDesign) -> dict[str, str]:
    """The deck of one element, through the angles at which the second opinion compares.

    Raises:
        IncompleteDesignError: the report or the drawing lacks what the model needs.
        InfeasibleError: the parts of the element do not fit together.
        ValueError: the roller does not touch the element.
    """
    joint = written_joint(design)
    element = element_contact(joint.geometry, joint.roller)
    stroke = joint.deflection - joint.dead_zone
    presses = press_through(element, [joint.dead_zone + share * stroke for share in SHARES])
    return {"element": element_deck(element, presses, design.name)}


def element_deck(element: ElementContact, presses: list[Press], name: str) -> str:
    """The element pressed to the angles of ``presses`` in order, two steps for each.

    Raises:
        ValueError: the roller does not touch the element.
    """
    if not presses:
        raise ValueError("the roller does not touch the element")
    model = turned(element, presses[-1].angle)
    states = [press.state.contact for press in presses if press.state.contact is not None]
    assert model.contact is not None
    return slice_deck(
        model.solid.mesh,
        model.solid.sheet,
        model.constraints,
        [raised(element, press.angle) for press in presses],
        strip=rigid_strip(model.contact, states),
        title=f"springcad {__version__}, {name}",
        notes=_explanation(element, presses, name),
    )


def _explanation(element: ElementContact, presses: list[Press], name: str) -> list[str]:
    """What the deck is, how to read its results, and what our elements found."""
    sheet = element.model.solid.sheet
    factor = sheet.thickness / SLICE
    rows = []
    for i, press in enumerate(presses):
        fx, fy = press.force / factor
        angle, found = math.degrees(press.angle), torque(element, press)
        rows.append(f"{2 * i + 2:4d} {angle:12.6g} {fx:14.6g} {fy:14.6g} {found:14.6g}")
    return [
        f"The second opinion of springcad {__version__} on the roller cam {name},",
        "for CalculiX (ccx) and Abaqus/Standard.",
        "",
        "Units: m, N, Pa. The origin is the tip of the unloaded cantilever, x along it.",
        "PART: one element in plane stress, its mount moved up by what the roller sinks.",
        "PROFILE: a strip along the roller, which rests; its tilt is that of the last angle",
        "(its height shrinks by the cosine, 0.06 % at 2 deg).",
        "Contact: penalty, without friction.",
        f"Thickness: a slice of {SLICE:g} m of the sheet of {sheet.thickness:g} m, since CalculiX",
        f"makes solids of plane elements; forces of the element are {factor:.12g} times as large.",
        "Steps: two for each angle. The first moves the mount, the second holds it and lets the",
        "solver find the directions of contact again. Compare after the second.",
        "Force of the roller: in CalculiX the first two numbers below 'total surface force'.",
        "",
        "What springcad found: step, angle (deg), force of the slice x, y (N), torque (N m)",
        *rows,
    ]
