"""The flexures at the design deflection, on the camshaft that the torque law asks for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.flexure_contact import NOSE_ALLOWANCE, flexure_part
from springcad.mechanics.beam import BeamStates, PreparedBeam, contact_load
from springcad.mechanics.conjugate_contact import find_contacts
from springcad.mechanics.torque_law import TorqueLaw

Floats = NDArray[np.float64]

DIRECTIONS = (1, -1)


@dataclass(frozen=True)
class Demand:
    """What the ring must do, of one of its flexures, SI.

    Attributes:
        root_radius, contact_radius: where flexures leave the rim and touch the camshaft at rest.
        deflection: at full load.
        torque, energy: then, and the stiffness at rest: of one flexure.
    """

    root_radius: float
    contact_radius: float
    deflection: float
    torque: float
    energy: float
    stiffness: float


def stiffness_at_rest(ribbon: Ribbon, beam: PreparedBeam, demand: Demand) -> float:
    """Stiffness of one flexure with contact at the contact radius, N m/rad."""
    # So small that the beam is linear; the arm of a tangential force is the contact radius.
    probe = 1e-6 * demand.torque / demand.contact_radius
    energy = float(contact_load(beam, ribbon.length, probe, 1.0).energy[0])
    return (probe * demand.contact_radius) ** 2 / (2.0 * energy)


def full_load(
    ribbon: Ribbon, beam: PreparedBeam, demand: Demand, share: float = 1.0
) -> tuple[BeamStates, BeamStates]:
    """One flexure at the design deflection, pushed in direction +1 and in direction −1.

    A flexure that is not sized yet takes a ``share`` of the torque and the energy, its stiffness
    over the wanted one. The contact may lie up to a pad's length before the pad: it may ask for
    more pad than it has.

    Raises:
        InfeasibleError: no contact gives the torque while the flexure holds the energy.
    """
    pad = ribbon.length - float(ribbon.edges[-2])
    nose = NOSE_ALLOWANCE * float(ribbon.half_thickness[-1])
    limits = (ribbon.length - 2.0 * pad, ribbon.length + nose)
    one = TorqueLaw(
        np.array([demand.deflection]),
        share * np.array([demand.torque]),
        share * np.array([demand.energy]),
    )
    states = []
    for direction in DIRECTIONS:
        found = find_contacts(flexure_part(beam, demand.root_radius, direction), one, limits, 1)
        if not found.found[0]:
            energy = share * demand.energy * float(np.exp(found.contact.excess[0]))
            claim = "energy of a flexure that gives the torque at the design deflection"
            raise InfeasibleError(claim, energy, share * demand.energy, "J")
        contact = found.contact
        states.append(contact_load(beam, contact.station, contact.force, direction))
    return states[0], states[1]
