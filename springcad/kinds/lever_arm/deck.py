"""The second opinion as an input deck of CalculiX and Abaqus."""

from __future__ import annotations

from springcad import __version__
from springcad.kinds.lever_arm.straight_judge import SHARES
from springcad.kinds.lever_arm.straight_mesh import Push, leaf_model, push_through
from springcad.kinds.lever_arm.written_leaf import written_elastic, written_leaf
from springcad.mechanics.fem.deck import SLICE, slice_deck
from springcad.written import WrittenDesign


def judge_decks(design: WrittenDesign) -> dict[str, str]:
    """The deck of one leaf, through the deflections at which the second opinion compares.

    None for a triangular leaf, whose elements differ in width as plane elements of CalculiX do
    not, and none for an omega leaf.

    Raises:
        IncompleteDesignError: the report lacks what the model needs.
        ValueError: the leaf cannot be meshed.
    """
    if design.text("design.shape") == "omega":
        return {}
    leaf = written_leaf(design)
    if not leaf.bends_in_sheet:
        return {}
    model = leaf_model(leaf, written_elastic(design))
    largest = design.number("design.spring_deflection_m")
    pushes = push_through(model, [share * largest for share in SHARES])
    solid = model.model.solid
    text = slice_deck(
        solid.mesh,
        solid.sheet,
        model.model.constraints,
        [push.state.load for push in pushes],
        title=f"springcad {__version__}, {design.name}",
        notes=_explanation(design.name, solid.sheet.thickness / SLICE, pushes),
    )
    return {"leaf": text}


def _explanation(name: str, factor: float, pushes: list[Push]) -> list[str]:
    """What the deck is, how to read its results, and what our elements found."""
    rows = [
        f"{step:4d} {1e3 * push.deflection:14.6g} {push.force / factor:14.6g}"
        for step, push in enumerate(pushes, 1)
    ]
    return [
        f"The second opinion of springcad {__version__} on a leaf of the lever arm {name},",
        "for CalculiX (ccx) and Abaqus/Standard.",
        "",
        "Units: m, N, Pa. The origin is the lever's pin, x along the leaf to its clamp.",
        "The leaf is held at its clamp; the node of the pin is led across, free along the leaf.",
        f"Thickness: a slice of {SLICE:g} m of the stack; its forces are {factor:.12g} times as",
        "large. Steps: one for each deflection.",
        "",
        "What springcad found: step, deflection (mm), force of the slice across (N)",
        *rows,
    ]
