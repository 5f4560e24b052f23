"""The second opinion on a roller cam: contact finite elements against the report."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.kinds.judging import OUTLINE_TOLERANCE, distance_from, snapped
from springcad.kinds.roller_cam.contact_model import (
    ElementContact,
    Press,
    contact_part_stress,
    element_contact,
    press_through,
    root_stress,
    torque,
)
from springcad.kinds.roller_cam.written_joint import WrittenJoint, written_joint
from springcad.result import Check, Comparison, Judgement, Progress, Value, check
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

SHARES = (0.1, 0.25, 0.5, 0.75, 1.0)
"""Angles at which the models are compared, over the stroke from the end of the dead zone."""
TOLERANCE = 0.005
"""Of torque and force, over the largest: near rest a micrometre is more than a per cent of them."""
METHOD = "contact finite elements of the element"
ASSUMPTIONS = (
    "The second opinion is by nonlinear plane-stress finite elements of the whole element, finer "
    "than those that the design used for its contact part, pressed without friction by the rigid "
    "roller as it sinks and tilts.",
    "The second opinion shares with the design: elastic constants, linear elasticity, a sheet in "
    "plane stress, a mount held between plates that end with its face, no play.",
)


def judge_joint(written: WrittenDesign, progress: Progress) -> Judgement:
    """Compare torque and roller force over the stroke.

    Raises:
        IncompleteDesignError: the report or the drawing lacks what the model needs.
    """
    joint = written_joint(written)
    progress("second opinion: contact finite elements")
    try:
        element = element_contact(joint.geometry, joint.roller)
    except (InfeasibleError, ValueError) as error:
        return Judgement(METHOD, (), (_no_mesh(str(error)),), ASSUMPTIONS, {})
    asked = [joint.dead_zone + share * (joint.deflection - joint.dead_zone) for share in SHARES]
    presses = press_through(element, asked)
    mesh = element.model.solid.mesh
    figures: dict[str, Value] = {"elements": len(mesh.elements), "unknowns": mesh.unknowns}
    if presses:
        figures |= {
            "root_fillet_stress_Pa": snapped(root_stress(element, presses[-1])),
            "contact_part_stress_Pa": snapped(contact_part_stress(element, presses[-1])),
        }
    return Judgement(
        method=METHOD,
        comparisons=tuple(_comparisons(written, element, presses)),
        checks=(_mesh_lies_on_drawing(joint, element), _reaches_the_end(asked, presses)),
        assumptions=ASSUMPTIONS,
        figures=figures,
    )


def _comparisons(
    written: WrittenDesign, element: ElementContact, presses: Sequence[Press]
) -> Iterator[Comparison]:
    if not presses:
        return
    angles = np.array([press.angle for press in presses])

    def compared(name: str, unit: str, key: str, judged: Callable[[Press], float]) -> Comparison:
        reported = np.interp(
            angles, written.array("response.angle_rad"), written.array(f"response.{key}")
        )
        return Comparison(
            name=name,
            unit=unit,
            place="angle",
            place_unit="rad",
            places=angles,
            designed=np.array([snapped(float(value)) for value in reported]),
            judged=np.array([snapped(judged(press)) for press in presses]),
            tolerance=TOLERANCE * float(np.max(reported)),
            relative=False,
            source="beam with a yielding contact part, drawn profile; finite elements",
        )

    yield compared(
        "torque of a group", "N*m", "group_torque_Nm", lambda press: torque(element, press)
    )
    yield compared(
        "force of the roller",
        "N",
        "roller_force_N",
        lambda press: float(np.hypot(*press.force)),
    )


def _no_mesh(reason: str) -> Check:
    return check(
        "second opinion: meshes of the element",
        0.0,
        ">=",
        1.0,
        "1",
        source=reason,
        remedy="nobody has judged this part; change cantilever.root_fillet or contact_part",
    )


def _mesh_lies_on_drawing(joint: WrittenJoint, element: ElementContact) -> Check:
    """That the profile which is judged is the one that is drawn."""
    mesh = element.model.solid.mesh
    nodes = mesh.nodes[np.unique(mesh.edge_sets["contact"])]
    lower, upper = joint.geometry.points[[-1, 0], 1]
    nodes = nodes[(nodes[:, 1] >= lower) & (nodes[:, 1] <= upper)]  # without the roundings
    return check(
        "second opinion: its profile against the drawing",
        snapped(distance_from(joint.outline, nodes)),
        "<=",
        OUTLINE_TOLERANCE,
        "m",
        source="largest distance of the mesh's contact edge from the contour of the drawing",
        remedy="the drawing is not of the profile in the report: design the joint again",
    )


def _reaches_the_end(asked: Sequence[float], presses: Sequence[Press]) -> Check:
    return check(
        "second opinion: angle reached",
        presses[-1].angle if presses else 0.0,
        ">=",
        asked[-1],
        "rad",
        source="contact finite elements, last equilibrium found",
        remedy="the finite elements find no equilibrium beyond; the roller may leave the profile",
    )
