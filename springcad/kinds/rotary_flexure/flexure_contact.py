"""One flexure of the ring as an elastic part that a camshaft pushes.

The flexure stands at global angle 0: its frame (origin at the root, x inward, y tangential) has
its origin at (R, 0) and is turned by half a turn. Torque of direction +1 turns the camshaft
counter-clockwise; it presses on the flexure's side at +λ n and pushes the tip towards −y.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly

from springcad.geometry.ribbon import Ribbon
from springcad.mechanics.beam import BeamStates, PreparedBeam, RibbonBeam, contact_load, prepare
from springcad.mechanics.centre_line import deformed_points
from springcad.mechanics.elastic_part import ContactState, ElasticPart
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]

NOSE_ALLOWANCE = 0.05
"""Contact may pass the start of the nose by this share of λ_t: there the round nose has fallen
back by 0.05²/2 λ_t, a quarter of a micrometre for λ_t = 0.2 mm."""


def flexure_beam(
    ribbon: Ribbon,
    *,
    thickness: float,
    elastic_modulus: float,
    poisson_ratio: float,
    root_compliance: float = 0.0,
) -> PreparedBeam:
    """The beam of a flexure whose ribbon ends at the nose; it goes on by the nose allowance."""
    edges = ribbon.edges.copy()
    edges[-1] += 2.0 * NOSE_ALLOWANCE * float(ribbon.at(ribbon.edges[-1:]).half_thickness[0])
    return prepare(
        RibbonBeam(
            edges,
            _polynomials(ribbon, ribbon.curvature),
            _polynomials(ribbon, ribbon.half_thickness),
            root_angle=ribbon.root_angle,
            thickness=thickness,
            elastic_modulus=elastic_modulus,
            shear_modulus=elastic_modulus / (2.0 * (1.0 + poisson_ratio)),
            root_compliance=root_compliance,
        )
    )


def _polynomials(ribbon: Ribbon, values: Floats) -> PPoly:
    """The function given by ``values`` at the ribbon's nodes, fast to evaluate anywhere."""
    width = np.diff(ribbon.edges)
    nodes = ribbon.grid.nodes.reshape(len(width), -1)
    powers = np.arange(nodes.shape[1])[::-1]
    local = (nodes - ribbon.edges[:-1, None]) / width[:, None]
    scaled = np.linalg.solve(local[..., None] ** powers, values.reshape(nodes.shape)[..., None])
    return PPoly(scaled[..., 0].T / width ** powers[:, None], ribbon.edges)


def flexure_part(
    beam: PreparedBeam, root_radius: float, direction: int, friction: float = 0.0
) -> ElasticPart:
    """The flexure pressed by the camshaft turning in ``direction`` (+1 counter-clockwise).

    The camshaft carries the profile; its mate is the flat pad, and stations are arc lengths. A
    negative angle turns it the other way, and it pushes from the other side.
    ``friction`` is the tangential over the normal force on the flexure, positive towards the tip.
    """

    def part(angle: Floats, force: Floats, station: Floats) -> ContactState:
        side = np.where(angle < 0.0, -direction, direction)
        states = contact_load(beam, station, force, side, friction)
        back = -direction * angle
        point = rotated(global_points(states.point, root_radius), back)
        normal = rotated(-states.normal, back)
        tangent = side[:, None] * np.stack([normal[:, 1], -normal[:, 0]], axis=-1)
        unit_force = friction * tangent - normal
        moment = point[:, 0] * unit_force[:, 1] - point[:, 1] * unit_force[:, 0]
        return ContactState(
            arm=side * moment,
            reach=np.hypot(*point.T),
            energy=states.energy,
            point=point,
            normal=normal,
            tangent=tangent,
            arc=station,
            mate_curvature=np.zeros_like(station),
        )

    return part


def global_points(points: Floats, root_radius: float) -> Floats:
    """Points (..., 2) of the flexure frame about the ring's centre, the flexure at angle 0."""
    return np.array([root_radius, 0.0]) - points


def tip_outlines(
    beam: PreparedBeam, states: BeamStates, nose_station: float, reach: float, count: int = 60
) -> Floats:
    """Outline of the deformed tip (L, M, 2) in the flexure frame, open towards the root.

    From ``reach`` [m] before the nose along the side at +λ n, round the half-circle nose about
    the centre line at ``nose_station``, and back along the side at −λ n.
    """
    stations = np.linspace(nose_station - reach, nose_station, count)
    points, rotation = deformed_points(beam, states, stations)
    normal = np.stack([-np.sin(rotation), np.cos(rotation)], axis=-1)
    offset = beam.beam.half_thickness(stations)[:, None] * normal
    round_ = np.linspace(0.5 * np.pi, -0.5 * np.pi, count)[1:-1]
    angle = rotation[:, -1:] + round_
    radius = float(beam.beam.half_thickness(stations[-1:])[0])
    nose = points[:, -1:] + radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return np.concatenate([points + offset, nose, (points - offset)[:, ::-1]], axis=1)
