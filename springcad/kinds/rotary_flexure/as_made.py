"""What a ring and a camshaft do that came out other than drawn: the forward analysis.

The camshaft stays the one that was cut for the nominal flexures; its teeth and the ring are moved
as the deviations say, and the ring is seated on it again. Angles are those of the camshaft against
the rim, so that lost motion and preload count: at the design deflection a camshaft with thinner
teeth has bent the flexures less. Derivations: docs/theory/tolerance.md.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.cam_slot import flank_points
from springcad.kinds.rotary_flexure.camshaft import seated_on
from springcad.kinds.rotary_flexure.clearance import deformed_gaps, flexure_gap
from springcad.kinds.rotary_flexure.flexure_contact import flexure_beam
from springcad.kinds.rotary_flexure.full_load import stiffness_of_contact
from springcad.kinds.rotary_flexure.offset_parts import moved_slot, offset_root, thickened
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.mechanics.beam import PreparedBeam, contact_load
from springcad.mechanics.conjugate import Flank, at_rows, until

Floats = NDArray[np.float64]

EVERY = 8
"""The spring is looked at in every so many of the angles of a flank, back from the last,"""
LEAST = 0.8
"""down to this share of the deflection: far below, flanks that lie too far in touch the noses."""
_ROUND_OFF = 1e-9
_PROBE = 1e-6
"""Tip force over the design's under which a flexure is linear."""


class Deviation(NamedTuple):
    """Of a part from its drawing; numbers, or arrays of as many parts.

    Attributes:
        sheet_thickness: more than nominal [m].
        edge_offset: material left on at every cut edge of ring and camshaft [m].
        contact_radius: the camshaft's flanks lie so much further out [m].
        modulus: more than nominal, as a share.
    """

    sheet_thickness: Floats | float = 0.0
    edge_offset: Floats | float = 0.0
    contact_radius: Floats | float = 0.0
    modulus: Floats | float = 0.0


class Behaviour(NamedTuple):
    """What a part does, each entry smooth in the deviations; arrays (..., its own last axis), SI.

    Attributes:
        at_rest: stiffness of the ring with the contact at the noses, and where the flank is.
        secant: torque at the design deflection over it, mean of both directions.
        stress: along a flexure at some angles in both directions: the one that the spec bounds.
        fillet_stress: in the root fillets at the design deflection, in both directions.
        gap: between neighbours, at rest and deformed.
    """

    at_rest: Floats
    secant: Floats
    stress: Floats
    fillet_stress: Floats
    gap: Floats


def behaviour(spring: Spring, deviation: Deviation) -> Behaviour:
    """The forward analysis of one part, all of its deviations plain numbers.

    Raises:
        InfeasibleError: its flexures leave the camshaft.
        ValueError: its edges are so far off that a fillet or a flank is gone.
    """
    t, offset, outward, e = (float(value) for value in deviation)
    inputs = spring.law.inputs
    stiffer = (1.0 + t / inputs.thickness) * (1.0 + e)
    ribbon, root = thickened(spring.found.ribbon, offset), offset_root(spring, offset)
    beam = flexure_beam(
        ribbon,
        thickness=inputs.thickness + t,
        elastic_modulus=inputs.elastic_modulus * (1.0 + e),
        poisson_ratio=spring.camshaft_inputs.poisson_ratio,
        root_compliance=root.compliance / stiffer,
    )
    slot = moved_slot(spring.camshaft.slot, offset, outward)
    torque, stress, fillet_stress = [], [], []
    gap = [np.array([flexure_gap(ribbon, inputs.root_radius, inputs.count)])]
    for flank in spring.camshaft.flanks:
        side = _some_angles(flank, spring.target.deflection)
        points = flank_points(slot, side.direction)
        seat = seated_on(beam, spring.camshaft_inputs, points, slot.free_play, side)
        if len(seat.angle) < len(side.angle) or not np.all(seat.force > 0.0):
            reached = float(seat.angle.max(initial=0.0))
            claim = "angle up to which flexures that are off the drawing rest on the camshaft"
            raise InfeasibleError(claim, reached, spring.target.deflection, "rad")
        states = contact_load(beam, seat.station, seat.force, side.direction)
        nominal = states.nominal_stress
        torque.append(seat.torque[-1])
        stress.append(nominal if spring.spec.stress == "nominal" else states.local_stress)
        fillet_stress.append(root.fillet_stress_factor * nominal[-1, 0])
        gap.append(deformed_gaps(ribbon, beam, states, inputs.root_radius, inputs.count))
    return Behaviour(
        at_rest=_at_rest(spring, ribbon, beam, outward),
        secant=np.array([np.mean(torque) / spring.target.deflection]),
        stress=np.concatenate([values.ravel() for values in stress]),
        fillet_stress=np.array(fillet_stress),
        gap=np.concatenate(gap),
    )


def backlash(spring: Spring, deviation: Deviation) -> Floats:
    """Tangential play of the unloaded tips at the contact radius, m; negative: they do not fit.

    The tip is thicker by twice the offset, its slot narrower by as much. The walls of slot and tip
    are parallel there, so it does not matter at which radius the flanks lie.
    """
    return np.asarray(spring.camshaft_inputs.backlash - 4.0 * np.asarray(deviation.edge_offset))


def _some_angles(flank: Flank, deflection: float) -> Flank:
    """The flank at the design deflection and a few angles below."""
    stroked = until(flank, deflection * (1.0 + _ROUND_OFF))
    rows = np.arange(len(stroked.angle))[::-EVERY][::-1]
    return at_rows(stroked, rows[stroked.angle[rows] >= LEAST * deflection])


def _at_rest(spring: Spring, ribbon: Ribbon, beam: PreparedBeam, outward: float) -> Floats:
    """Stiffness of the ring with its contact at the noses, and ``outward`` of there.

    Where the flanks lie too far in, they touch the round noses: the force goes on through the
    nose's centre. So the larger of both is the stiffness at rest.
    """
    probe, radius = _PROBE * spring.law.force, spring.law.inputs.contact_radius
    # The beam goes on beyond its nose, by far enough to say how fast the second one falls there.
    stations = [ribbon.length, min(ribbon.length - outward, float(beam.edges[-1]))]
    return spring.law.inputs.count * np.array(
        [stiffness_of_contact(beam, s, radius + ribbon.length - s, probe) for s in stations]
    )
