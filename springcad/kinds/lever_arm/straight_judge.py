"""The second opinion on a straight leaf: finite elements of it against the report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.judging import snapped
from springcad.kinds.lever_arm.comparing import (
    STRESS_TOLERANCE,
    all_snapped,
    compared_forces,
    lies_on_drawing,
)
from springcad.kinds.lever_arm.straight import half_seen
from springcad.kinds.lever_arm.straight_mesh import (
    LeafModel,
    Push,
    leaf_model,
    peak_stress,
    push_through,
    side_stress,
)
from springcad.kinds.lever_arm.written_leaf import written_elastic, written_leaf
from springcad.result import Check, Comparison, Judgement, Progress, check
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

SHARES = (0.25, 0.5, 0.75, 1.0)
"""Deflections to one side at which the models are compared, over the largest; to the other side
the largest alone."""
PLACES = (0.25, 0.4, 0.55, 0.7, 0.85)
"""Where stresses are compared, over the length from the pin: clear of eye and fillet."""
_SEEN = 50
"""Places at which a triangle's width is compared with the drawing."""
METHOD = "finite elements of the leaf"
ASSUMPTIONS = (
    "The second opinion is by nonlinear plane-stress finite elements of one leaf in its plane of "
    "bending, held at the block's face, its pin led across; of a triangular leaf they are the side "
    "view, each element as wide as the leaf is drawn there.",
    "The second opinion shares with the design: elastic constants, linear elasticity, the clamp at "
    "the block's face, a pin that slides freely along the leaf, layers that do not rub.",
)


def judge_straight(written: WrittenDesign, progress: Progress) -> Judgement:
    """Compare force and stress over the stroke, to both sides.

    Raises:
        IncompleteDesignError: the report or the drawing lacks what the model needs.
        NoEquilibriumError, ValueError: the elements find no equilibrium, or are inside out.
    """
    leaf = written_leaf(written)
    largest = written.number("design.spring_deflection_m")
    progress("second opinion: finite elements of the leaf")
    model = leaf_model(leaf, written_elastic(written))
    pushes = [
        *push_through(model, [-largest]),
        *push_through(model, [share * largest for share in SHARES]),
    ]
    mesh = model.model.solid.mesh
    checks = [_leaf_lies_on_drawing(written, model)]
    if leaf.bends_in_sheet:
        checks.append(_notch(written, model, pushes))
    return Judgement(
        method=METHOD,
        comparisons=(
            compared_forces(
                written, [push.deflection for push in pushes], [push.force for push in pushes]
            ),
            *_stresses(written, model, pushes),
        ),
        checks=tuple(checks),
        assumptions=ASSUMPTIONS,
        figures={
            "elements": len(mesh.elements),
            "unknowns": mesh.unknowns,
        },
    )


def _stresses(
    written: WrittenDesign, model: LeafModel, pushes: Sequence[Push]
) -> Iterator[Comparison]:
    """Along the leaf at the largest deflection to either side."""
    length = written.number("design.leaf.length_m")
    places = length * np.array(PLACES)
    reported = np.interp(
        places,
        written.array("response.leaf_place_m"),
        written.array("response.leaf_stress_Pa"),
    )
    for push, side in ((pushes[0], "negative"), (pushes[-1], "positive")):
        yield Comparison(
            name=f"stress along the leaf, at the largest {side} deflection",
            unit="Pa",
            place="distance from the pin",
            place_unit="m",
            places=places,
            designed=all_snapped(reported),
            judged=all_snapped(np.interp(places, *side_stress(model, push))),
            tolerance=STRESS_TOLERANCE,
            relative=True,
            source="nominal stress of the beam; mean of both sides of the finite elements",
        )


def _notch(written: WrittenDesign, model: LeafModel, pushes: Sequence[Push]) -> Check:
    """A peak that the beam does not know; local yield there is not failure under a static load."""
    return check(
        "second opinion: stress in the root fillets against yield",
        snapped(peak_stress(model, pushes[-1])),
        "<=",
        written.number("design.yield_strength_Pa"),
        "Pa",
        source="finite elements at the spring deflection; surface stress, notch included",
        remedy="a larger mount.root_fillet or a lower material.design_stress lowers it",
        otherwise="warn",
    )


def _leaf_lies_on_drawing(written: WrittenDesign, model: LeafModel) -> Check:
    """One side of what is seen in the sheet, from the eye's fillet to that of the clamp."""
    leaf = model.leaf
    plan = leaf.plan
    if leaf.bends_in_sheet:
        mesh = model.model.solid.mesh
        numbers = np.unique(mesh.edge_sets["lower"])
        x, y = mesh.nodes[numbers[mesh.nodes[numbers, 0] < plan.root_center[0]]].T
        drawn = np.column_stack([-y, x])
    else:
        x = np.linspace(plan.start, plan.end, _SEEN)
        drawn = np.column_stack([x, half_seen(leaf, x)])
    return lies_on_drawing(written, drawn)
