"""The flexures over the stroke, on the camshaft that the torque law asks for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.flexure_contact import NOSE_ALLOWANCE, flexure_part
from springcad.kinds.target_law import Law
from springcad.mechanics.beam import BeamStates, PreparedBeam, contact_load
from springcad.mechanics.conjugate_contact import find_contacts
from springcad.mechanics.torque_law import TorqueLaw

Floats = NDArray[np.float64]

DIRECTIONS = (1, -1)
LOADS = 20
"""Evenly spaced angles up to the design deflection at which a flexure is looked at: under a law
that stiffens, its tip may bear more on the way than at the end. Between them the stress is at most
0.13 % higher in the shipped springs."""


@dataclass(frozen=True)
class Demand:
    """What the ring must do, of one of its flexures, SI.

    Attributes:
        root_radius, contact_radius: where flexures leave the rim and touch the camshaft at rest.
        law: torque and energy at ``LOADS`` angles, the last the design deflection.
        stiffness: at rest.
    """

    root_radius: float
    contact_radius: float
    law: TorqueLaw
    stiffness: float


def demand_of(target: Law, root_radius: float, contact_radius: float, count: int) -> Demand:
    """What a torque law of the whole ring asks of each flexure."""
    angle = target.deflection * np.arange(1, LOADS + 1) / LOADS
    share = TorqueLaw(angle, target.torque(angle) / count, target.energy(angle) / count)
    at_rest = float(target.stiffness(np.zeros(1))[0]) / count
    return Demand(root_radius, contact_radius, share, at_rest)


def stiffness_at_rest(ribbon: Ribbon, beam: PreparedBeam, demand: Demand) -> float:
    """Stiffness of one flexure with contact at the contact radius, N m/rad."""
    # So small that the beam is linear.
    probe = 1e-6 * float(demand.law.torque[-1]) / demand.contact_radius
    return stiffness_of_contact(beam, ribbon.length, demand.contact_radius, probe)


def stiffness_of_contact(beam: PreparedBeam, station: float, radius: float, probe: float) -> float:
    """Stiffness (F r)^2/(2 U) of one flexure under the small tip force ``probe`` (N), N m/rad.

    The arm of the tangential force at ``station`` is the ``radius`` at which it acts.
    """
    energy = float(contact_load(beam, station, probe, 1.0).energy[0])
    return (probe * radius) ** 2 / (2.0 * energy)


def loads_of(
    ribbon: Ribbon, beam: PreparedBeam, demand: Demand, share: float = 1.0
) -> tuple[BeamStates, BeamStates]:
    """One flexure at the angles of the demand, pushed in direction +1 and in direction −1.

    A flexure that is not sized yet takes a ``share`` of torque and energy, its stiffness over the
    wanted one. The contact may lie up to a pad's length before the pad, but not beyond half of
    the way to the root: it may ask for more pad than it has.

    Raises:
        InfeasibleError: no contact gives the torque while the flexure holds the energy.
    """
    pad = ribbon.length - float(ribbon.edges[-2])
    nose = NOSE_ALLOWANCE * float(ribbon.half_thickness[-1])
    before = ribbon.length - pad
    limits = (max(before - pad, 0.5 * before), ribbon.length + nose)
    one = demand.law
    law = TorqueLaw(
        np.concatenate([direction * one.angle for direction in DIRECTIONS]),
        share * np.tile(one.torque, len(DIRECTIONS)),
        share * np.tile(one.energy, len(DIRECTIONS)),
    )
    search = find_contacts(flexure_part(beam, demand.root_radius, 1), law, limits, 1)
    if not search.found.all():
        first = int(np.argmin(search.found))
        held = float(law.energy[first] * np.exp(search.contact.excess[first]))
        claim = (
            f"energy of a flexure that gives the torque at {abs(np.degrees(law.angle[first])):.4g} "
            "deg, nearest to that of the law"
        )
        raise InfeasibleError(claim, held, float(law.energy[first]), "J")
    stations, forces = (
        np.split(values, len(DIRECTIONS))
        for values in (search.contact.station, search.contact.force)
    )
    forward, backward = map(partial(contact_load, beam), stations, forces, DIRECTIONS)
    return forward, backward
