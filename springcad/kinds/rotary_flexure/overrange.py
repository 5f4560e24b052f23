"""How far a finished spring may be turned beyond its design deflection, and what ends it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.camshaft import Camshaft, CamshaftInputs, seated
from springcad.kinds.rotary_flexure.clearance import deformed_gaps
from springcad.mechanics.beam import PreparedBeam, contact_load
from springcad.mechanics.conjugate import between

Floats = NDArray[np.float64]

FROM = 0.5
"""Share of the deflection from which on the limits are looked for: they come with the load."""
FLANK = "the flanks of the camshaft end"
YIELD = "inner fibres reach yield"
GAP = "neighbouring flexures touch"


@dataclass(frozen=True)
class EndOfUse:
    """The first of the limits in one direction, SI.

    Attributes:
        angle: a magnitude.
        torque: of the whole ring there.
        limit: in words.
    """

    angle: float
    torque: float
    limit: str


def end_of_use(
    ribbon: Ribbon,
    beam: PreparedBeam,
    camshaft: Camshaft,
    inputs: CamshaftInputs,
    direction: int,
    yield_strength: float,
) -> EndOfUse:
    """Turn the spring on its camshaft as drawn until something ends its use.

    Up to the end of the flanks the contact is where the flexures rest on them; beyond it the corner
    of a tooth would cut into a tip. Before that the inner fibres of the flexures may reach yield,
    or neighbours touch. The root fillets, where a little yielding stays local, have a check of
    their own, and so has the room between tips and teeth up to the same end.
    """
    flank = camshaft.flanks[0 if direction > 0 else 1]
    loaded = between(flank, FROM * inputs.deflection, float(flank.angle[-1]))
    seat = seated(beam, inputs, camshaft, loaded)
    states = contact_load(beam, seat.station, seat.force, direction)
    gap = deformed_gaps(ribbon, beam, states, inputs.root_radius, inputs.count)
    ends = [
        (_first_above(seat.angle, states.peak_local_stress, yield_strength), YIELD),
        (_first_above(seat.angle, -gap, 0.0), GAP),
        (float(seat.angle[-1]), FLANK),
    ]
    angle, limit = min(ends)
    return EndOfUse(angle, float(np.interp(angle, seat.angle, seat.torque)), limit)


def _first_above(angle: Floats, values: Floats, limit: float) -> float:
    """Angle at which values first pass a limit, infinite where they never do."""
    above = np.flatnonzero(values > limit)
    if not len(above):
        return float("inf")
    last = int(above[0])
    first = max(last - 1, 0)
    return float(np.interp(limit, values[[first, last]], angle[[first, last]]))
