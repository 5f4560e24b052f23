"""The second opinion on leaves of adjustable length: contact finite elements against the report."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.polyline import flatten
from springcad.kinds.judging import OUTLINE_TOLERANCE, snapped
from springcad.kinds.leaf_2dof.leaf_mesh import (
    LeafContact,
    Press,
    clamp_stress,
    contact_station,
    leaf_contact,
    press_through,
)
from springcad.kinds.leaf_2dof.written_leaf import WrittenLeaf, WrittenStroke, written_leaf
from springcad.result import Check, Comparison, Judgement, Progress, check
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

SHARES = (0.25, 0.5, 0.75, 1.0)
"""Angles at which the models are compared, over the last of a stroke."""
TOLERANCE = 0.01
"""Of torque and roller force."""
STRESS_TOLERANCE = 0.02
"""Of the stress: that of the beam is nominal and counts the pull along the leaf on top."""
METHOD = "contact finite elements of a leaf"
ASSUMPTIONS = (
    "The second opinion is by nonlinear plane-stress finite elements of one leaf, seen from its "
    "edge, which a rigid roller bends without friction, at the shortest, a middle and the longest "
    "effective length.",
    "The second opinion shares with the design: elastic constants, linear elasticity, plane stress "
    "across the leaf (a beam, not a plate), a section that stays plane at the face of the guide, "
    "no play, and that all leaves of an axis bear alike.",
)
_CHORD = 1e-8


def judge_leaf(written: WrittenDesign, progress: Progress) -> Judgement:
    """Compare torque, roller force and stress at three effective lengths.

    Raises:
        IncompleteDesignError: the report or the drawing lacks what the model needs.
    """
    known = written_leaf(written)
    comparisons: list[Comparison] = []
    checks = [_drawing_is_of_the_leaf(known)]
    elements = 0
    for stroke in judged_strokes(known):
        progress(f"second opinion: finite elements at {1e3 * stroke.length:.4g} mm")
        contact, presses = pressed(known, stroke)
        elements += len(contact.model.solid.mesh.elements)
        comparisons += _comparisons(known, stroke, contact, presses)
        checks += _checks(known, stroke, contact, presses)
    return Judgement(METHOD, tuple(comparisons), tuple(checks), ASSUMPTIONS, {"elements": elements})


def judged_strokes(known: WrittenLeaf) -> list[WrittenStroke]:
    """At the shortest, a middle and the longest length, or at as many as there are."""
    last = len(known.strokes) - 1
    return [known.strokes[index] for index in sorted({0, (last + 1) // 2, last})]


def pressed(known: WrittenLeaf, stroke: WrittenStroke) -> tuple[LeafContact, list[Press]]:
    """The leaf at one effective length, with the lever at the angles that are compared."""
    most = float(stroke.angle[-1])
    contact = leaf_contact(
        known.leaf, known.lever, stroke.length, _overhang(known), stroke.station, most
    )
    return contact, press_through(contact, [share * most for share in SHARES])


def _overhang(known: WrittenLeaf) -> float:
    """Of the leaf behind the roller at rest, the same at all lengths: the guide moves."""
    return known.end - max(stroke.length for stroke in known.strokes)


def _comparisons(
    known: WrittenLeaf, stroke: WrittenStroke, contact: LeafContact, presses: Sequence[Press]
) -> Iterator[Comparison]:
    if not presses:
        return
    angles = np.array([press.angle for press in presses])

    def compared(
        name: str, unit: str, reported: Floats, judged: Callable[[Press], float], tolerance: float
    ) -> Comparison:
        return Comparison(
            name=f"{name}, length {1e3 * stroke.length:.4g} mm",
            unit=unit,
            place="angle",
            place_unit="rad",
            places=angles,
            designed=np.array([snapped(v) for v in np.interp(angles, stroke.angle, reported)]),
            judged=np.array([snapped(judged(press)) for press in presses]),
            tolerance=tolerance,
            relative=True,
            source="beam with a contact that moves along it; finite elements",
        )

    yield compared(
        "torque of an axis", "N*m", stroke.torque, lambda p: known.leaves * p.torque, TOLERANCE
    )
    yield compared("roller force", "N", stroke.force, lambda p: p.force, TOLERANCE)
    yield compared(
        "stress at the clamp", "Pa", stroke.stress, lambda p: clamp_stress(contact, p),
        STRESS_TOLERANCE,
    )  # fmt: skip


def _checks(
    known: WrittenLeaf, stroke: WrittenStroke, contact: LeafContact, presses: Sequence[Press]
) -> Iterator[Check]:
    at = f"length {1e3 * stroke.length:.4g} mm"
    yield check(
        f"second opinion: angle reached, {at}",
        presses[-1].angle if presses else 0.0,
        ">=",
        SHARES[-1] * float(stroke.angle[-1]),
        "rad",
        source="contact finite elements, last equilibrium found",
        remedy="the finite elements find no equilibrium beyond; the roller may leave the leaf",
    )
    if presses:
        farthest = max(contact_station(contact, press) for press in presses)
        yield check(
            f"second opinion: contact from the end of the leaf, {at}",
            snapped(stroke.length + _overhang(known) - farthest),
            ">=",
            known.end_radius,
            "m",
            source="middle of the contact; the corners of the end are round",
            remedy="the roller runs on to the rounded corners: design the leaf again",
        )


def _drawing_is_of_the_leaf(known: WrittenLeaf) -> Check:
    corners = flatten(known.outline, _CHORD)
    length, width = np.ptp(corners, axis=0)
    return check(
        "second opinion: its leaf against the drawing",
        snapped(float(max(abs(length - known.whole), abs(width - known.leaf.width)))),
        "<=",
        OUTLINE_TOLERANCE,
        "m",
        source="length and width of the contour of the drawing",
        remedy="the drawing is not of the leaf in the report: design it again",
    )
