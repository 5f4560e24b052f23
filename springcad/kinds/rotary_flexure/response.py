"""What the finished spring does over its stroke, in both directions.

The ring is seated on the camshaft as drawn, on the very arcs of its drawing: a forward problem that
knows nothing of the torque law for which the camshaft was made. The flexures are geometrically
exact beams on the springs of their roots; contact is frictionless unless the spec gives a
coefficient. Angles do not count the free play, by which a camshaft with backlash first turns
without touching the flexures.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.camshaft import Camshaft, CamshaftInputs, seated
from springcad.kinds.rotary_flexure.clearance import deformed_gaps
from springcad.kinds.rotary_flexure.flank_pressure import flank_strips
from springcad.mechanics.beam import BeamStates, PreparedBeam, contact_load
from springcad.mechanics.conjugate import Flank, until
from springcad.mechanics.friction import FrictionLoop, friction_loop

Floats = NDArray[np.float64]

ROUND_OFF = 1e-9
GAP_EVERY = 4
"""The gap between deformed neighbours is measured at every so many angles, and at the last."""


@dataclass(frozen=True)
class Stroke:
    """One direction from near rest to the design deflection; arrays (A,), SI.

    Attributes:
        direction: +1 counter-clockwise.
        angle: magnitudes, ascending.
        torque, energy: of the whole spring.
        force: normal force on one tip.
        station: of the contact on the flexure.
        nominal_stress, local_stress: largest anywhere on a flexure without its root fillets.
        pressure: largest on the contact strip, on the flank as drawn.
        gap: smallest between deformed neighbours, at ``gap_angle``.
        full: the deformed flexure at the design deflection (one load).
        friction: loading and unloading with the spec's friction, None without.
    """

    direction: int
    angle: Floats
    torque: Floats
    energy: Floats
    force: Floats
    station: Floats
    nominal_stress: Floats
    local_stress: Floats
    pressure: Floats
    gap_angle: Floats
    gap: Floats
    full: BeamStates
    friction: FrictionLoop | None


def stroke(
    ribbon: Ribbon,
    beam: PreparedBeam,
    camshaft: Camshaft,
    inputs: CamshaftInputs,
    direction: int,
    friction: float,
) -> Stroke:
    """The spring turned in ``direction`` up to the design deflection.

    Near rest the angles at which a flexure would touch with its nose, not its pad, are left out.

    Raises:
        InfeasibleError: the flexures have left the camshaft before the design deflection.
    """
    flank = camshaft.flanks[0 if direction > 0 else 1]
    seat = seated(beam, inputs, camshaft, flank)
    within = seat.angle <= inputs.deflection * (1.0 + ROUND_OFF)
    reached = float(seat.angle[within].max(initial=0.0))
    if reached < inputs.deflection * (1.0 - ROUND_OFF):
        claim = "angle up to which the flexures rest on the camshaft as drawn"
        raise InfeasibleError(claim, reached, inputs.deflection, "rad")
    force, station = seat.force[within], seat.station[within]
    states = contact_load(beam, station, force, direction)
    measured = np.flatnonzero(within)[::-GAP_EVERY][::-1]
    some = contact_load(beam, seat.station[measured], seat.force[measured], direction)
    return Stroke(
        direction=direction,
        angle=seat.angle[within],
        torque=seat.torque[within],
        energy=seat.energy[within],
        force=force,
        station=station,
        nominal_stress=states.peak_nominal_stress,
        local_stress=states.peak_local_stress,
        pressure=flank_strips(beam, inputs, camshaft, seat, direction).peak_pressure[within],
        gap_angle=seat.angle[measured],
        gap=deformed_gaps(ribbon, beam, some, inputs.root_radius, inputs.count),
        full=contact_load(beam, station[-1:], force[-1:], direction),
        friction=_friction(beam, camshaft, inputs, flank, friction) if friction > 0.0 else None,
    )


def _friction(
    beam: PreparedBeam,
    camshaft: Camshaft,
    inputs: CamshaftInputs,
    flank: Flank,
    coefficient: float,
) -> FrictionLoop:
    """The loop up to the design deflection."""
    stroked = until(flank, inputs.deflection * (1.0 + ROUND_OFF))
    ahead, behind = (
        seated(beam, inputs, camshaft, stroked, sign * coefficient) for sign in (1.0, -1.0)
    )
    reached = min(float(seat.angle.max(initial=0.0)) for seat in (ahead, behind))
    if reached < stroked.angle[-1] * (1.0 - ROUND_OFF):
        claim = "angle up to which the flexures rest on the camshaft with friction"
        raise InfeasibleError(claim, reached, inputs.deflection, "rad")
    return friction_loop(stroked, ahead, behind, coefficient, count=inputs.count)


def both_ways(forward: Floats, backward: Floats) -> Floats:
    """Values over the whole stroke, from full clockwise to full counter-clockwise (2 A,)."""
    return np.concatenate([backward[::-1], forward])
