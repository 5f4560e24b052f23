"""How hard the tips are pressed on the camshaft's flanks as drawn.

Near rest the flank is nearly as sharp as the tip's nose, and turns blunter by a tenth within a
micrometre: less than the half width of the contact strip. There Hertz's formula with the curvature
at one place is wrong by a tenth. So the strip is solved on the drawing's own arcs, against the
straight pad and the round nose that follows it (``mechanics.contact_strip``).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.camshaft import Camshaft, CamshaftInputs
from springcad.kinds.rotary_flexure.drawn_flank import drawn_flank
from springcad.mechanics.beam import PreparedBeam
from springcad.mechanics.cam_contact import Seat
from springcad.mechanics.contact import contact_modulus
from springcad.mechanics.contact_strip import Strips, contact_strips

Floats = NDArray[np.float64]


def flank_strips(
    beam: PreparedBeam, inputs: CamshaftInputs, camshaft: Camshaft, seat: Seat, direction: int
) -> Strips:
    """Strips of contact (A,) of the tips seated on the flank of ``direction`` (see ``seated``).

    Places are along the flank from its first point inwards for +1, outwards for −1.

    Raises:
        InfeasibleError: no strip was found.
    """
    profile = drawn_flank(camshaft.drawn, direction)
    heading = np.unwrap(np.arctan2(*profile.curve(profile.places, 1).T[::-1]))
    bend = np.diff(heading) / np.diff(profile.places)
    nose = 1.0 / float(beam.beam.half_thickness(np.array([inputs.nose_station]))[0])
    pad = np.interp(seat.place, profile.places, heading)[:, None]
    past_nose = seat.station[:, None] - inputs.nose_station

    def opening(along: Floats) -> tuple[Floats, Floats]:
        places = seat.place[:, None] + along
        arc = np.clip(np.searchsorted(profile.places, places) - 1, 0, len(bend) - 1)
        turn = heading[arc] + bend[arc] * (places - profile.places[arc]) - pad
        past = np.maximum(direction * along + past_nose, 0.0)
        return turn + direction * nose * past, bend[arc] + nose * (past > 0.0)

    modulus = contact_modulus(*(beam.beam.elastic_modulus, inputs.poisson_ratio) * 2)
    start = np.full_like(seat.force, nose)
    try:
        return contact_strips(opening, seat.force, beam.beam.thickness, start, modulus)
    except ArithmeticError as error:
        claim = "strip of contact found between tip and flank as drawn"
        raise InfeasibleError(claim, 0.0, 1.0, "1") from error
