"""The second opinion on an omega leaf: finite elements of both halves against the report."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.judging import snapped
from springcad.kinds.lever_arm.comparing import (
    STRESS_TOLERANCE,
    all_snapped,
    compared_forces,
    lies_on_drawing,
)
from springcad.kinds.lever_arm.leaf_mesh import (
    LeafElements,
    LeafJudgement,
    judge_leaf_at,
    leaf_elements,
)
from springcad.kinds.lever_arm.written_omega import written_omega
from springcad.result import Check, Comparison, Judgement, Progress
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

SHARES = (-1.0, 0.5, 1.0)
"""Deflections at which the models are compared, over the largest."""
CLEAR = (0.1, 0.9)
"""Where stresses are compared, over the half's length from the hub: both ends are held rigidly."""
METHOD = "finite elements of both halves of the leaf"
ASSUMPTIONS = (
    "The second opinion is by nonlinear plane-stress finite elements of both halves, held square "
    "across at the wall and by a rigid hub that turns until their moments on it cancel. Stress is "
    "the elastic modulus times the elongation of the sides.",
    "The second opinion shares with the design: elastic constants, linear elasticity, the clamps "
    "square across the leaf's ends, the rigid hub held at its height, layers that do not rub. The "
    "feet, the fillets and the hub as drawn are in neither.",
)


def judge_omega(written: WrittenDesign, progress: Progress) -> Judgement:
    """Compare force over the stroke, and the stress of both halves at its end.

    Raises:
        IncompleteDesignError: the report or the drawing lacks what the model needs.
        NoEquilibriumError, ValueError: the elements find no equilibrium, or are inside out.
    """
    leaf, case = written_omega(written)
    progress("second opinion: finite elements of the leaf")
    elements = leaf_elements(leaf, case, written.number("design.width_m"))
    judged = [judge_leaf_at(elements, share * case.stroke) for share in SHARES]
    mesh = elements.model.solid.mesh
    return Judgement(
        method=METHOD,
        comparisons=(
            compared_forces(
                written, [at.displacement for at in judged], [at.force for at in judged]
            ),
            *_stresses(written, judged[-1]),
        ),
        checks=(_mesh_lies_on_drawing(written, elements, leaf.length),),
        assumptions=ASSUMPTIONS,
        figures={
            "elements": len(mesh.elements),
            "unknowns": mesh.unknowns,
            "hub_rotation_rad": snapped(judged[-1].rotation),
        },
    )


def _stresses(written: WrittenDesign, judged: LeafJudgement) -> Iterator[Comparison]:
    """The largest of both halves; at the opposite deflection they change places."""
    place = written.array("response.leaf_place_m")
    low, high = written.number("design.leaf.half_length_m") * np.array(CLEAR)
    for name, key, found in (
        ("right", "leaf_stress_Pa", judged.right_stress),
        ("left", "leaf_stress_other_half_Pa", judged.left_stress),
    ):
        inside = (place >= low) & (place <= high)
        designed = np.where(inside, written.array(f"response.{key}"), 0.0)
        worst = int(np.argmax(designed))
        clear = (judged.stations >= low) & (judged.stations <= high)
        yield Comparison(
            name=f"largest stress of the {name} half, clear of its ends",
            unit="Pa",
            place="distance from the hub",
            place_unit="m",
            places=place[[worst]],
            designed=all_snapped(designed[[worst]]),
            judged=all_snapped(np.array([np.max(found[clear])])),
            tolerance=STRESS_TOLERANCE,
            relative=True,
            source="beam with the curved-beam factor; finite elements, larger of both sides, each "
            "at its own worst place",
        )


def _mesh_lies_on_drawing(written: WrittenDesign, elements: LeafElements, length: float) -> Check:
    """Both sides of the right half, where neither hub nor foot has a fillet."""
    mesh = elements.model.solid.mesh
    clear = (elements.stations > 0.15 * length) & (elements.stations < 0.8 * length)
    rows = [mesh.node_sets["right"], mesh.node_sets["left"][::-1]]
    nodes = np.concatenate([mesh.nodes[row[clear]] for row in rows]) - elements.middle
    return lies_on_drawing(written, nodes)
