"""One sector of the ring, pushed by the camshaft as drawn: contact finite elements over the stroke.

Nonlinear plane stress of flexure, root fillets, nose and rim with cyclic symmetry, against the
rigid flank of the camshaft's drawing. Nothing of the design's models is in it: no beam, no root
spring, no point of contact, no torque law.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.spatial import KDTree

from springcad.kinds.rotary_flexure.clearance import polygon_gap
from springcad.kinds.rotary_flexure.drawn_flank import drawn_flank
from springcad.kinds.rotary_flexure.flexure_contact import global_points
from springcad.kinds.rotary_flexure.root_compliance import sector_supports
from springcad.kinds.rotary_flexure.sector_blocks import FINE
from springcad.kinds.rotary_flexure.sector_mesh import sector_mesh
from springcad.kinds.rotary_flexure.written_spring import WrittenSpring, plain_stations
from springcad.mechanics.fem.assembly import prepare_solid
from springcad.mechanics.fem.contact import prepare_contact
from springcad.mechanics.fem.element import edge_shape_functions
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, Model, State, prepare_model, with_contact
from springcad.mechanics.fem.newton import NoEquilibriumError, solve_path
from springcad.mechanics.fem.recovery import edge_stress
from springcad.mechanics.fem.rigid_profile import RigidProfile

Floats = NDArray[np.float64]

WAYS = {1: "counter-clockwise", -1: "clockwise"}
"""Directions in words."""
PENALTY = 2.0
"""Pressure per penetration of the contact, over modulus per tip half thickness; ten times as much
changes the torque by less than 0.1 %."""
CHORDS = 6
"""An element's edge is so many chords where gaps are measured: they lie within 50 nm of it."""


@dataclass(frozen=True)
class SectorContact:
    """The model of one direction.

    Attributes:
        spring: what it is of.
        direction: +1 when the camshaft turns counter-clockwise.
        profile: the flank as drawn.
        model: sector, supports and contact.
    """

    spring: WrittenSpring
    direction: int
    profile: RigidProfile
    model: Model

    @property
    def mesh(self) -> Mesh:
        """Of the sector, in the ring's frame, flexure 0 along the positive x axis."""
        return self.model.solid.mesh


@dataclass(frozen=True)
class Turn:
    """The sector with the camshaft turned to ``angle``, a magnitude without the free play (rad)."""

    angle: float
    state: State


def sector_contact(spring: WrittenSpring, direction: int) -> SectorContact:
    """Mesh, supports and frictionless contact of one direction.

    Raises:
        ValueError: the sector has no valid mesh.
        IncompleteDesignError: the drawing of the camshaft has no tooth spaces.
    """
    (sector,) = sector_contacts(spring, [direction])
    return sector


def sector_contacts(
    spring: WrittenSpring, directions: Collection[int] = WAYS
) -> list[SectorContact]:
    """``sector_contact`` of several directions, on one mesh."""
    mesh = sector_mesh(spring.sector, FINE)
    solid = prepare_solid(mesh, spring.sheet)
    supports = sector_supports(mesh, spring.sector.count, spring.mounting)
    held = prepare_model(solid, supports)
    penalty = PENALTY * spring.sheet.elastic_modulus / spring.tip_half_thickness
    sectors = []
    for direction in directions:
        profile = drawn_flank(spring.camshaft, direction)
        edges = "contact_left" if direction > 0 else "contact_right"
        contact = prepare_contact(solid, edges, profile, penalty)
        sectors.append(SectorContact(spring, direction, profile, with_contact(held, contact)))
    return sectors


def turn_through(sector: SectorContact, angles: Sequence[float]) -> list[Turn]:
    """Turn the camshaft to each of ``angles`` (ascending magnitudes, rad); as far as it goes.

    The list ends before the first angle for which no equilibrium is found.
    """
    turns: list[Turn] = []
    state: State | None = None
    still = np.zeros(sector.mesh.unknowns)
    for angle in angles:
        rotation = sector.direction * (angle + sector.spring.free_play)
        try:
            (state,) = solve_path(sector.model, [Load(still, still, rotation)], state)
        except NoEquilibriumError:
            break
        turns.append(Turn(angle, state))
    return turns


def torque(sector: SectorContact, turn: Turn) -> float:
    """Of the whole spring against the camshaft, positive (N m)."""
    assert turn.state.contact is not None
    return -sector.direction * sector.spring.sector.count * turn.state.contact.torque


def neighbour_gap(sector: SectorContact, turn: Turn) -> float:
    """Smallest gap between the deformed flexure and its neighbour (m), as ``polygon_gap``."""
    moved = sector.mesh.nodes + turn.state.displacement.reshape(-1, 2)
    edges = np.concatenate(
        [sector.mesh.edge_sets[name] for name in ("flank_right", "nose", "flank_left")]
    )
    shape, _ = edge_shape_functions(np.linspace(-1.0, 1.0, CHORDS, endpoint=False))
    outline = shapely.Polygon((shape @ moved[edges]).reshape(-1, 2))
    return polygon_gap(outline, (0.0, 0.0), sector.spring.sector.count)


def fillet_stress(sector: SectorContact, turn: Turn) -> float:
    """Largest stress along the root fillets (Pa)."""
    return max(
        float(np.max(np.abs(edge_stress(sector.model.solid, turn.state.displacement, edges))))
        for edges in ("fillet_left", "fillet_right")
    )


def side_stress(sector: SectorContact, turn: Turn) -> float:
    """Largest stress along both sides of the flexure between its ``plain_stations`` (Pa)."""
    stations, largest = plain_stations(sector.spring.sector), 0.0
    for edges, sides in (("flank_left", 0), ("flank_right", 1)):
        stress = edge_stress(sector.model.solid, turn.state.displacement, edges)
        along = _stations(sector, edges, sides)
        inside = (along >= stations[0]) & (along <= stations[1])
        largest = max(largest, float(np.max(np.abs(stress) * inside, initial=0.0)))
    return largest


def _stations(sector: SectorContact, edges: str, side: int) -> Floats:
    """Station of the middle of each of the K edges along a side (K, 1)."""
    ribbon, mesh = sector.spring.sector.ribbon, sector.mesh
    dense = ribbon.dense_stations(4000)
    points = global_points(ribbon.boundary(dense)[side].points, sector.spring.sector.root_radius)
    nearest = KDTree(points).query(mesh.nodes[mesh.edge_sets[edges][:, 1]])[1]
    return np.asarray(dense[nearest])[:, None]
