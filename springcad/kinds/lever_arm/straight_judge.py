"""The second opinion on a straight leaf: finite elements of it against the report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.judging import OUTLINE_TOLERANCE, distance_from, snapped
from springcad.kinds.lever_arm.straight_mesh import (
    LeafModel,
    Push,
    leaf_model,
    peak_stress,
    push_through,
    side_stress,
)
from springcad.kinds.lever_arm.written_leaf import written_elastic, written_leaf, written_outline
from springcad.result import Check, Comparison, Judgement, Progress, check
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

SHARES = (0.25, 0.5, 0.75, 1.0)
"""Deflections to one side at which the models are compared, over the largest; to the other side
the largest alone."""
FORCE_TOLERANCE = 0.02
STRESS_TOLERANCE = 0.05
PLACES = (0.25, 0.4, 0.55, 0.7, 0.85)
"""Where stresses are compared, over the length from the pin: clear of eye and fillet."""
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
    checks = (_mesh_lies_on_drawing(written, model),) if leaf.bends_in_sheet else ()
    return Judgement(
        method=METHOD,
        comparisons=(_forces(written, pushes), *_stresses(written, model, pushes)),
        checks=checks,
        assumptions=ASSUMPTIONS,
        figures={
            "elements": len(mesh.elements),
            "unknowns": mesh.unknowns,
            "peak_stress_with_notch_Pa": snapped(peak_stress(model, pushes[-1])),
        },
    )


def _forces(written: WrittenDesign, pushes: Sequence[Push]) -> Comparison:
    places = np.array([push.deflection for push in pushes])
    count = written.number("design.count")
    reported = np.interp(
        places, written.array("response.deflection_m"), written.array("response.force_N")
    )
    return Comparison(
        name="force of the spring",
        unit="N",
        place="deflection",
        place_unit="m",
        places=places,
        designed=_snapped(reported),
        judged=_snapped(np.array([count * push.force for push in pushes])),
        tolerance=FORCE_TOLERANCE,
        relative=True,
        source="nonlinear beam; finite elements",
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
            designed=_snapped(reported),
            judged=_snapped(np.interp(places, *side_stress(model, push))),
            tolerance=STRESS_TOLERANCE,
            relative=True,
            source="nominal stress of the beam; mean of both sides of the finite elements",
        )


def _snapped(values: Floats) -> Floats:
    return np.array([snapped(float(value)) for value in values])


def _mesh_lies_on_drawing(written: WrittenDesign, model: LeafModel) -> Check:
    """The leaf's upper side between its fillets and in them, turned as it is drawn."""
    mesh = model.model.solid.mesh
    numbers = np.unique(mesh.edge_sets["lower"])
    clear = mesh.nodes[numbers, 0] < model.leaf.plan.root_center[0]
    x, y = mesh.nodes[numbers[clear]].T
    return check(
        "second opinion: its leaf against the drawing",
        snapped(distance_from(written_outline(written), np.column_stack([-y, x]))),
        "<=",
        OUTLINE_TOLERANCE,
        "m",
        source="largest distance of the mesh's side from the contour of the drawing",
        remedy="the drawing is not of the leaf in the report: design it again",
    )
