"""The camshaft of a ring of flexures: its exact flanks, its outline and what it must bear.

Paper 004 leaves the camshaft open. Here each direction of motion has the conjugate flank of the
wanted torque law, so the torque is exact whatever the flexure's own nonlinearity and asymmetry.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.biarc import fit_contour
from springcad.geometry.outline import Arc, Circle, Outline, Piece, Profile
from springcad.geometry.polyline import BulgePolyline
from springcad.geometry.transform import rotate
from springcad.kinds.rotary_flexure.cam_clearance import overlap, thinnest_tooth
from springcad.kinds.rotary_flexure.cam_slot import Rest, Slot, require_round, tooth_space
from springcad.kinds.rotary_flexure.cam_tooth import tooth_root_stress
from springcad.kinds.rotary_flexure.drawn_flank import drawn_flank
from springcad.kinds.rotary_flexure.flexure_contact import (
    NOSE_ALLOWANCE,
    flexure_part,
    global_points,
)
from springcad.kinds.rotary_flexure.room import hub_shear_stress
from springcad.mechanics.beam import PreparedBeam
from springcad.mechanics.cam_contact import Seat, seat
from springcad.mechanics.centre_line import unloaded_points
from springcad.mechanics.conjugate import Flank, at_rows, conjugate_flank, hertz_half_width
from springcad.mechanics.contact import contact_modulus
from springcad.mechanics.fem.assembly import Sheet
from springcad.mechanics.torque_law import TorqueLaw

Floats = NDArray[np.float64]

ANGLES = 50
"""Angles up to the deflection at which a flank is solved, evenly spaced from the first step; the
flank between them deviates by less than 1 nm."""
SHARES = (0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)
"""Shares of the deflection tried to say how far a flexure can be bent at all."""
STRIPS = 2.0
"""Half widths of the contact strip by which a flank goes on beyond its last contact."""
FLANK_TOLERANCE = 3e-6
"""The arcs of the camshaft's drawing follow it within this share of the contact radius, 18 nm for
6 mm: at 2 um they waver enough to change the torque by 0.5 % locally, at 36 nm by 0.05 %."""

NO_TOOTH = "no camshaft tooth is left between two tips"
"""A claim that the choice of a contact radius looks at."""


@dataclass(frozen=True)
class CamshaftInputs:
    """What the camshaft follows from, SI.

    Attributes:
        root_radius: R, where the flexures begin.
        count: number of flexures and of teeth.
        nose_station: where the flexure's round nose begins, the contact at rest.
        pad_start: where its straight pad of constant thickness begins.
        deflection: largest angle in each direction.
        torque, energy: of the whole spring over the angle (a magnitude), energy from zero.
        poisson_ratio: of flexure and camshaft, both of the flexure's elastic modulus.
        sheets: as many equal rings twist the camshaft together.
        bore_radius: of the camshaft, 0 for none.
        backlash: tangential play of the unloaded tips at the contact radius, both sides together.
        bottom_clearance: radial clearance of the noses at rest, at least, over their radius.
        overrange: share of the deflection by which the flanks go on.
        smallest_radius: of curvature of the flanks, over that of the noses. They are convex: no
            tool asks for a radius. A sharper one is pressed harder near rest, a blunter one stands
            farther into the unloaded tip.
    """

    root_radius: float
    count: int
    nose_station: float
    pad_start: float
    deflection: float
    torque: Callable[[Floats], Floats]
    energy: Callable[[Floats], Floats]
    poisson_ratio: float
    sheets: int = 1
    bore_radius: float = 0.0
    backlash: float = 0.0
    bottom_clearance: float = 4.0 / 7.0
    overrange: float = 0.04
    smallest_radius: float = 0.75


@dataclass(frozen=True)
class Camshaft:
    """The camshaft as a part, and its loads.

    Attributes:
        profile: outline and bore, in the frame in which flexure 0 lies at angle 0 at rest.
        tolerance: within which the drawing's arcs follow the profile (m).
        drawn: its outer contour as drawn.
        slot: one tooth space.
        flanks: of directions +1 and −1, to the end of the overrange.
        tooth_thickness: smallest thickness of a tooth (m).
        tooth_height: from the bottom to the tip circle (m).
        tooth_stress: at the roots of the teeth at the end of the flanks, by finite elements (Pa).
        hub_stress: torsion of the round core inside the slots, without notch (Pa).
        overlap: how deep the tips, at rest and deformed, cut into the teeth anywhere (m).
    """

    profile: Profile
    tolerance: float
    drawn: BulgePolyline
    slot: Slot
    flanks: tuple[Flank, Flank]
    tooth_thickness: float
    tooth_height: float
    tooth_stress: float
    hub_stress: float
    overlap: float


def flank(beam: PreparedBeam, inputs: CamshaftInputs, direction: int) -> Flank:
    """The conjugate flank of one direction.

    Raises:
        InfeasibleError: the contact would leave the pad, or no bent shape gives the torque law.
    """
    try:
        return _flank(beam, inputs, direction)
    except ArithmeticError as error:
        reached = 0.0
        for share in SHARES:
            reached = share * inputs.deflection
            try:
                _flank(beam, replace(inputs, deflection=reached), direction)
            except (ArithmeticError, InfeasibleError):
                reached = 0.0
            else:
                break
        claim = "deflection up to which a bent shape of the flexures gives the torque law"
        raise InfeasibleError(claim, reached, inputs.deflection, "rad") from error


def _flank(beam: PreparedBeam, inputs: CamshaftInputs, direction: int) -> Flank:
    """The same; ArithmeticError where the beam model does not converge."""
    steps = round(ANGLES * (1.0 + inputs.overrange))
    angle = inputs.deflection * np.arange(1, steps + 1) / ANGLES
    return conjugate_flank(
        flexure_part(beam, inputs.root_radius, direction),
        TorqueLaw(angle, inputs.torque(angle), inputs.energy(angle)),
        count=inputs.count,
        direction=direction,
        station_limits=_pad(beam, inputs),
        intervals=1,
    )


def _pad(beam: PreparedBeam, inputs: CamshaftInputs) -> tuple[float, float]:
    """Stations between which a flexure may touch the camshaft."""
    lam = float(beam.beam.half_thickness(np.array([inputs.nose_station]))[0])
    return inputs.pad_start, inputs.nose_station + NOSE_ALLOWANCE * lam


def design_camshaft(beam: PreparedBeam, inputs: CamshaftInputs) -> Camshaft:
    """Flanks, outline, strength and clearance.

    Raises:
        InfeasibleError: the contact would leave the pad, a flank would be too sharp, or no tooth
            is left between two tips.
    """
    flanks = (flank(beam, inputs, 1), flank(beam, inputs, -1))
    rest = _rest(beam, inputs)
    smallest_radius = inputs.smallest_radius * rest.half_thickness
    for side in flanks:
        require_round(side, smallest_radius)
    modulus = contact_modulus(*(beam.beam.elastic_modulus, inputs.poisson_ratio) * 2)
    ends = [at_rows(side, np.array([-1])) for side in flanks]
    strip = max(float(hertz_half_width(end, beam.beam.thickness, modulus)[0]) for end in ends)
    slot = tooth_space(
        flanks,
        rest,
        smallest_radius=smallest_radius,
        backlash=inputs.backlash,
        bottom_clearance=inputs.bottom_clearance * rest.half_thickness,
        land=STRIPS * strip,
    )
    if inputs.bore_radius >= slot.bottom_radius:
        raise InfeasibleError(
            "the camshaft's bore cuts its slots", inputs.bore_radius, slot.bottom_radius, "m"
        )
    profile = camshaft_profile(slot, inputs.count, inputs.bore_radius)
    tolerance = FLANK_TOLERANCE * float(np.hypot(*rest.nose_center))
    outline = fit_contour(profile.outer, tolerance)
    sheet = Sheet(beam.beam.elastic_modulus, inputs.poisson_ratio, beam.beam.thickness)
    stresses = [
        tooth_root_stress(outline, side, sheet, count=inputs.count, foot_radius=slot.foot_radius)
        for side in flanks
    ]
    torque = inputs.sheets * float(inputs.torque(flanks[0].angle[-1:])[0])
    return Camshaft(
        profile=profile,
        tolerance=tolerance,
        drawn=outline,
        slot=slot,
        flanks=flanks,
        tooth_thickness=thinnest_tooth(slot, inputs.count),
        tooth_height=slot.tip_radius - slot.bottom_radius,
        tooth_stress=float(np.max(stresses)),
        hub_stress=float(hub_shear_stress(torque, slot.bottom_radius, inputs.bore_radius)),
        overlap=max(slot.preload, *(overlap(beam, inputs, slot, side) for side in flanks)),
    )


def camshaft_profile(slot: Slot, count: int, bore_radius: float) -> Profile:
    """The outline with ``count`` slots, counter-clockwise, and the bore if there is one."""
    pitch = 2.0 * np.pi / count
    lower, upper = slot.opening
    land = pitch - (upper - lower)
    if land <= 0.0:
        raise InfeasibleError(NO_TOOTH, land * slot.tip_radius, 0.0, "m")
    tooth: tuple[Piece, ...] = (*slot.pieces, Arc((0.0, 0.0), slot.tip_radius, upper, land))
    pieces = tuple(rotate(piece, pitch * i) for i in range(count) for piece in tooth)
    inner = (Circle((0.0, 0.0), bore_radius),) if bore_radius > 0.0 else ()
    return Profile(Outline(pieces), inner)


def _rest(beam: PreparedBeam, inputs: CamshaftInputs) -> Rest:
    """The unloaded tip."""
    nose = np.array([inputs.nose_station])
    point, angle = unloaded_points(beam, nose)
    return Rest(
        nose_center=global_points(point[0], inputs.root_radius),
        inward=-np.array([np.cos(angle[0]), np.sin(angle[0])]),
        half_thickness=float(beam.beam.half_thickness(nose)[0]),
    )


def seated(
    beam: PreparedBeam,
    inputs: CamshaftInputs,
    camshaft: Camshaft,
    side: Flank,
    friction: float = 0.0,
) -> Seat:
    """The ring on the camshaft as drawn, at the angles of ``side``, that flank alone.

    Angles are those of the camshaft less its free play. Angles at which a flexure would touch with
    its nose, not its pad, are left out.

    ``friction`` is the tangential over the normal force on the flexures, positive towards their
    tips: with a coefficient μ it is −μ sign(sliding) while the angle grows (see ``Flank``) and
    +μ sign(sliding) while it falls.
    """
    points = drawn_flank(camshaft.drawn, side.direction).points
    return seated_on(beam, inputs, points, camshaft.slot.free_play, side, friction)


def seated_on(
    beam: PreparedBeam,
    inputs: CamshaftInputs,
    points: Floats,
    free_play: float,
    side: Flank,
    friction: float = 0.0,
) -> Seat:
    """``seated`` on the dense points (M, 2) of a flank, with its free play (rad)."""
    found = seat(
        flexure_part(beam, inputs.root_radius, side.direction, friction),
        points,
        side.angle + free_play,
        count=inputs.count,
        force=side.force,
        station=side.station,
        station_limits=_pad(beam, inputs),
    )
    return replace(found, angle=found.angle - free_play)
