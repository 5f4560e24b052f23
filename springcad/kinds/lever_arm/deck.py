"""The second opinion as input decks of CalculiX and Abaqus."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from springcad import __version__
from springcad.kinds.lever_arm.curved_judge import SHARES as OMEGA_SHARES
from springcad.kinds.lever_arm.leaf_mesh import LeafElements, judge_leaf_at, leaf_elements
from springcad.kinds.lever_arm.straight_judge import SHARES
from springcad.kinds.lever_arm.straight_mesh import leaf_model, push_through
from springcad.kinds.lever_arm.written_leaf import written_elastic, written_leaf
from springcad.kinds.lever_arm.written_omega import written_omega
from springcad.mechanics.fem.deck import SLICE, slice_deck
from springcad.mechanics.fem.model import Load, Model
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]


def judge_decks(design: WrittenDesign) -> dict[str, str]:
    """The decks of one leaf, through the deflections at which the second opinion compares.

    One for each half of an omega leaf. The elements of a triangular leaf's side view differ in
    width: each column of them has a section of its own, of its mean width.

    Raises:
        IncompleteDesignError: the report lacks what the model needs.
        NoEquilibriumError, ValueError: the leaf cannot be meshed or bent.
    """
    if design.text("design.shape") == "omega":
        return _omega_decks(design)
    return {"leaf": _straight_deck(design)}


def _straight_deck(design: WrittenDesign) -> str:
    model = leaf_model(written_leaf(design), written_elastic(design))
    largest = design.number("design.spring_deflection_m")
    pushes = push_through(model, [share * largest for share in SHARES])
    factor = _factor(model.model)
    return _deck(
        design,
        model.model,
        [push.state.load for push in pushes],
        [
            "Origin: the lever's pin; x along the leaf to its clamp, which is held.",
            "The node of the pin is led across, free along the leaf.",
            "",
            "What springcad found: step, deflection (mm), force of the slice across (N)",
            *(
                f"{step:4d} {1e3 * push.deflection:14.6g} {push.force / factor:14.6g}"
                for step, push in enumerate(pushes, 1)
            ),
        ],
        model.shares,
    )


def _omega_decks(design: WrittenDesign) -> dict[str, str]:
    leaf, case = written_omega(design)
    elements = leaf_elements(leaf, case, design.number("design.width_m"))
    shares = [share for share in OMEGA_SHARES if share > 0.0]
    judged = [judge_leaf_at(elements, share * case.stroke) for share in shares]
    factor = _factor(elements.model)
    notes = [
        "Origin: the middle of the enclosure. The right half of the leaf, held at the wall; the",
        "nodes of HUB are moved as a rigid body. The left half is the right one moved the other",
        "way, in the deck beside this: the force of the leaf is the sum of RF1 over HUB of the",
        "right half less that of the left half.",
        "",
        "What springcad found: step, deflection (mm), turn of the hub (deg),",
        "force of a slice of the whole leaf (N)",
        *(
            f"{step:4d} {1e3 * at.displacement:14.6g} {np.degrees(at.rotation):14.6g} "
            f"{at.force / factor:14.6g}"
            for step, at in enumerate(judged, 1)
        ),
    ]
    return {
        f"{name}-half": _deck(
            design,
            elements.model,
            [_hub_moved(elements, side * at.displacement, side * at.rotation) for at in judged],
            notes,
        )
        for name, side in (("right", 1.0), ("left", -1.0))
    }


def _hub_moved(elements: LeafElements, displacement: float, turn: float) -> Load:
    """The section at the hub moved along x and turned (clockwise) about the hub's middle."""
    mesh = elements.model.solid.mesh
    nodes = mesh.node_sets["hub"]
    arm = mesh.nodes[nodes] - elements.middle
    cos, sin = np.cos(turn), np.sin(turn)
    prescribed = np.zeros((len(mesh.nodes), 2))
    prescribed[nodes] = arm @ np.array([[cos, sin], [-sin, cos]]) - arm + [displacement, 0.0]
    return Load(np.zeros(mesh.unknowns), prescribed.ravel())


def _factor(model: Model) -> float:
    """Forces of the whole width over those of the slice."""
    return model.solid.sheet.thickness / SLICE


def _deck(
    design: WrittenDesign,
    model: Model,
    loads: list[Load],
    notes: Iterable[str],
    shares: Floats | None = None,
) -> str:
    """What the deck is, how to read its results, what our elements found, and the model."""
    return slice_deck(
        model.solid.mesh,
        model.solid.sheet,
        model.constraints,
        loads,
        shares=shares,
        title=f"springcad {__version__}, {design.name}",
        notes=[
            f"The second opinion of springcad {__version__} on a leaf of the lever arm "
            f"{design.name},",
            "for CalculiX (ccx) and Abaqus/Standard.",
            "",
            f"Units: m, N, Pa. Thickness: a slice of {SLICE:g} m of the leaf's width at its",
            "clamp, elsewhere as much less as the leaf is narrower. The whole has",
            f"{_factor(model):.12g} times the forces. Steps: one for each deflection.",
            *notes,
        ],
    )
