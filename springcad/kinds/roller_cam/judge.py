"""The second opinion on a roller cam: contact finite elements against the report."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

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
    side_stress,
    torque,
)
from springcad.kinds.roller_cam.contact_pad import contact_pressure
from springcad.kinds.roller_cam.element import MOUNTED
from springcad.kinds.roller_cam.joint import Cantilever, Roller
from springcad.kinds.roller_cam.part import roller_contact
from springcad.kinds.roller_cam.written_joint import WrittenJoint, written_joint
from springcad.mechanics.section import area, nominal_bending_stress
from springcad.result import Check, Comparison, Judgement, Progress, Value, check
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

SHARES = (0.1, 0.25, 0.5, 0.75, 1.0)
"""Angles at which the models are compared, over the stroke from the end of the dead zone."""
TOLERANCE = 0.005
"""Of torque and force, over the largest: near rest a micrometre is more than a per cent of them.
Where the arcs of the drawing change the torque by more, which a check of its own tells, by as much:
the report's numbers are of those arcs, the mesh is of the profile that they follow."""
STRESS_TOLERANCE = 0.02
"""Over the largest. The beam's section is taken where it rests, not where it has gone to."""
PRESSURE_TOLERANCE = 0.05
"""The block of the second opinion has a depth, the half-planes of the design have none."""
METHOD = "contact finite elements of the element"
_ASSUMPTIONS = (
    "The second opinion is by nonlinear plane-stress finite elements of the whole element, finer "
    "than those that the design used for its contact part, pressed without friction by the rigid "
    "roller as it sinks and tilts; the contact pressure is that of a block on finer elements.",
    "The second opinion shares with the design: elastic constants, linear elasticity, a sheet in "
    "plane stress, {mounted}, no play.",
)


def judge_joint(written: WrittenDesign, progress: Progress) -> Judgement:
    """Compare torque, roller force, stress and contact pressure over the stroke.

    Raises:
        IncompleteDesignError: the report or the drawing lacks what the model needs.
    """
    joint = written_joint(written)
    mounted = MOUNTED[joint.geometry.dimensions.mount.mounting]
    assumptions = tuple(each.format(mounted=mounted) for each in _ASSUMPTIONS)
    progress("second opinion: contact finite elements")
    try:
        element = element_contact(joint.geometry, joint.roller)
    except (InfeasibleError, ValueError) as error:
        return Judgement(METHOD, (), (_no_mesh(str(error)),), assumptions, {})
    asked = [joint.dead_zone + share * (joint.deflection - joint.dead_zone) for share in SHARES]
    presses = press_through(element, asked)
    mesh = element.model.solid.mesh
    pressures, untold = _pressures(written, joint, element, presses)
    figures: dict[str, Value] = {"elements": len(mesh.elements), "unknowns": mesh.unknowns}
    checks = [_mesh_lies_on_drawing(joint, element), _reaches_the_end(asked, presses), *untold]
    if presses:
        notch = snapped(root_stress(element, presses[-1]))
        hook = snapped(contact_part_stress(element, presses[-1]))
        figures |= {"root_fillet_stress_Pa": notch, "contact_part_stress_Pa": hook}
        checks += _stress_checks(notch, hook, written.number("design.yield_strength_Pa"))
    return Judgement(
        method=METHOD,
        comparisons=(*_comparisons(written, joint, element, presses), *pressures),
        checks=tuple(checks),
        assumptions=assumptions,
        figures=figures,
    )


def _comparisons(
    written: WrittenDesign, joint: WrittenJoint, element: ElementContact, presses: Sequence[Press]
) -> Iterator[Comparison]:
    if not presses:
        return
    source = "beam with a yielding contact part, drawn profile; finite elements"
    share = max(TOLERANCE, written.number("design.drawing_torque_change"))
    moment = _reported(written, "group_torque_Nm", presses)
    yield _compared(
        "torque of a group", "N*m", presses, moment, [torque(element, press) for press in presses],
        share * float(np.max(moment)), source,
    )  # fmt: skip
    force = _reported(written, "roller_force_N", presses)
    yield _compared(
        "force of the roller", "N", presses, force,
        [float(np.hypot(*press.force)) for press in presses],
        share * float(np.max(force)), source,
    )  # fmt: skip
    angles = np.array([press.angle for press in presses])
    gamma = _reported(written, "contact_angle_rad", presses)
    stress = beam_stress(joint.geometry.cantilever, joint.roller, angles, force, gamma)
    yield _compared(
        "stress along the cantilever", "Pa", presses, stress,
        [side_stress(element, press) for press in presses],
        STRESS_TOLERANCE * float(np.max(stress)),
        "beam under the reported force; finite elements; one height from the clamp",
    )  # fmt: skip


def _pressures(
    written: WrittenDesign, joint: WrittenJoint, element: ElementContact, presses: Sequence[Press]
) -> tuple[tuple[Comparison, ...], tuple[Check, ...]]:
    """Contact pressure where the roller is on the profile, and a check if a block cannot tell it.

    Before the first contact of the law the roller is on the corner where the profile begins.
    """
    first = written.number("response.first_contact_angle_rad")
    on_profile = [press for press in presses if press.angle >= first]
    found = [contact_pressure(element, press, joint.outline) for press in on_profile]
    told = [k for k, pressure in enumerate(found) if not math.isnan(pressure)]
    checks = () if len(told) == len(found) else (_untold_pressure(len(found) - len(told)),)
    if not told:
        return (), checks
    at = [on_profile[k] for k in told]
    comparison = _compared(
        "contact pressure", "Pa", at, _reported(written, "contact_pressure_Pa", at),
        [found[k] for k in told], PRESSURE_TOLERANCE,
        "elastic strip; elements of a block pressed on the profile as drawn", relative=True,
    )  # fmt: skip
    return (comparison,), checks


def _reported(written: WrittenDesign, key: str, presses: Sequence[Press]) -> Floats:
    """What the report says at the angles of the presses.

    A roller that is clear has no contact angle; as it has no force either, that of the first
    contact will do.
    """
    known = written.array_with_gaps(f"response.{key}")
    touching = np.isfinite(known)
    at = written.array("response.angle_rad")[touching]
    return np.asarray(np.interp([press.angle for press in presses], at, known[touching]))


def _compared(
    name: str,
    unit: str,
    presses: Sequence[Press],
    designed: Floats,
    judged: Sequence[float],
    tolerance: float,
    source: str,
    *,
    relative: bool = False,
) -> Comparison:
    return Comparison(
        name=name,
        unit=unit,
        place="angle",
        place_unit="rad",
        places=np.array([press.angle for press in presses]),
        designed=np.array([snapped(float(value)) for value in designed]),
        judged=np.array([snapped(value) for value in judged]),
        tolerance=tolerance,
        relative=relative,
        source=source,
    )


def beam_stress(
    beam: Cantilever, roller: Roller, angle: Floats, force: Floats, gamma: Floats
) -> Floats:
    """Nominal stress one height from the clamp under forces (A,) [N] at contact angles (A,) [Pa].

    The place of the contact is where the roller is; the section is taken where it rests.
    """
    touch = roller_contact(roller, angle, gamma)
    arm = touch.point - np.array([beam.height - beam.length, 0.0])
    pull, push = (force[:, None] * touch.normal).T
    moment = arm[:, 0] * push - arm[:, 1] * pull
    half = 0.5 * beam.height
    bending = nominal_bending_stress(beam.width, half, moment)
    return np.asarray(bending + np.abs(pull) / area(beam.width, half))


def _stress_checks(notch: float, hook: float, yield_strength: float) -> Iterator[Check]:
    """Peaks that a beam does not know; local yield there is not failure under a static load."""
    yield check(
        "second opinion: stress in the root fillets against yield", notch, "<=", yield_strength,
        "Pa", source="finite elements at the deflection; surface stress, notch included",
        remedy="a larger cantilever.root_fillet lowers it", otherwise="warn",
    )  # fmt: skip
    yield check(
        "second opinion: stress in the contact part against yield", hook, "<=", yield_strength,
        "Pa", source="finite elements at the deflection; back of it and fillet at its foot",
        remedy="a larger contact_part.thickness lowers it", otherwise="warn",
    )  # fmt: skip


def _untold_pressure(count: int) -> Check:
    return check(
        "second opinion: angles at which it cannot tell the pressure", float(count), "<=", 0.0, "1",
        source="the strip is wider than 0.35 of the contact part is thick: there neither the "
        "half-planes of the design nor a block are like it",
        remedy="a larger contact_part.thickness", otherwise="warn",
    )  # fmt: skip


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
