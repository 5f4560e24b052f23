"""Large deflection of a curved, tapered ribbon loaded at one material station.

Geometrically exact planar beam with bending, stretch and shear (Reissner 1972; Simo 1985):

    dψ/ds = κ₀ + M/EI,   dr/ds = (1 + N/EA) t(ψ) + (V/GA_s) n(ψ),   M = m + (r_c − r) × f,

with t = (cos ψ, sin ψ), n = (−sin ψ, cos ψ), A_s = 5/6 A, plain EI of the section also where the
ribbon is curved. A contact force is fixed in the frame of the section that it acts on, so in that
frame the equations are an initial value problem from the loaded station s_c back to the root: no
shooting. It is solved by Picard iteration on Gauss–Lobatto panels for all loads at once, then
moved rigidly so that the root is in its place. Beyond s_c the ribbon is stress-free.

Flexure frame: origin at the root, x inward along the radius, y tangential, right-handed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springcad.mechanics.lobatto import lobatto_nodes, running_integral
from springcad.mechanics.plane import rotated
from springcad.mechanics.reissner import integrate_back, stiffness
from springcad.mechanics.section import (
    SHEAR_CORRECTION,
    area,
    curved_beam_factor,
    nominal_bending_stress,
)

Floats = NDArray[np.float64]


_INSIDE = 1.0 - 1e-12
"""The ends of a panel are taken so much inside it, where a function that jumps is the panel's."""


@dataclass(frozen=True)
class RibbonBeam:
    """A ribbon of sheet, fixed at its root.

    Attributes:
        panel_edges: stations s [m], ascending, first 0, last the end of the centre line. Functions
            below must be smooth between them: put an edge at every jump, kink and spline knot, and
            closer ones where the taper is steep.
        curvature: κ₀(s) [1/m] of the unloaded centre line; takes and returns arrays of any shape.
        half_thickness: λ(s) [m].
        root_angle: angle of the tangent from x at s = 0 [rad].
        thickness: of the sheet [m].
        elastic_modulus, shear_modulus: [Pa].
        root_compliance: rotation of the root section per moment [rad/(N m)].
        nodes_per_panel: 3 or more; the error falls with the power 2n − 2 of the panel length.
    """

    panel_edges: Floats
    curvature: Callable[[Floats], Floats]
    half_thickness: Callable[[Floats], Floats]
    root_angle: float
    thickness: float
    elastic_modulus: float
    shear_modulus: float
    root_compliance: float = 0.0
    nodes_per_panel: int = 6


@dataclass(frozen=True)
class PreparedBeam:
    """A beam with its functions evaluated at the nodes (P, n); made by ``prepare``."""

    beam: RibbonBeam
    edges: Floats
    curvature: Floats
    half_thickness: Floats
    unloaded_rotation: Floats
    unloaded_positions: Floats


@dataclass(frozen=True)
class BeamStates:
    """The beam under L loads, in the flexure frame; fields at the N = P·n panel nodes.

    Nodes at panel edges occur twice. Panels beyond the loaded station have zero length and lie at
    it; ``centre_line.deformed_points`` gives the centre line anywhere, with its unloaded end.

    Attributes:
        end_station: loaded station s_c (L,).
        end_position: centre of the loaded section (L, 2).
        end_rotation: its tangent angle ψ (L,).
        point: where the force acts (L, 2): on the surface for a contact.
        normal: outward unit normal of the surface at ``point`` (L, 2).
        force: on the beam (L, 2) [N].
        energy: elastic energy of bending, stretch, shear and root (L,) [J].
        root_moment: (L,) [N m].
        stations, half_thickness, rotation, moment, axial_force: (L, N).
        curvature: of the unloaded centre line (L, N).
        positions: (L, N, 2).
        thickness: of the sheet [m].
    """

    end_station: Floats
    end_position: Floats
    end_rotation: Floats
    point: Floats
    normal: Floats
    force: Floats
    energy: Floats
    root_moment: Floats
    stations: Floats
    half_thickness: Floats
    positions: Floats
    rotation: Floats
    moment: Floats
    axial_force: Floats
    curvature: Floats
    thickness: float

    @cached_property
    def nominal_stress(self) -> Floats:
        """1.5|M|/(t λ²) + |N|/A (L, N) [Pa]."""
        return self._bending_stress + self._direct_stress

    @cached_property
    def local_stress(self) -> Floats:
        """The same with the curved-beam factor K(λ|κ₀|) on the bending part (L, N) [Pa]."""
        factor = curved_beam_factor(self.half_thickness * np.abs(self.curvature))
        return self._bending_stress * factor + self._direct_stress

    @property
    def _bending_stress(self) -> Floats:
        return nominal_bending_stress(self.thickness, self.half_thickness, self.moment)

    @property
    def _direct_stress(self) -> Floats:
        return np.abs(self.axial_force) / area(self.thickness, self.half_thickness)

    @property
    def peak_nominal_stress(self) -> Floats:
        """Largest nominal stress of each load (L,)."""
        return np.asarray(self.nominal_stress.max(axis=1))

    @property
    def peak_local_stress(self) -> Floats:
        """Largest local stress of each load (L,)."""
        return np.asarray(self.local_stress.max(axis=1))


def prepare(beam: RibbonBeam) -> PreparedBeam:
    """Evaluate the beam at its panel nodes and integrate the unloaded centre line."""
    edges = np.asarray(beam.panel_edges, dtype=np.float64)
    if edges.ndim != 1 or len(edges) < 2 or edges[0] != 0.0 or np.any(np.diff(edges) <= 0.0):
        raise ValueError("panel edges must ascend from 0")
    half = 0.5 * np.diff(edges)
    stations = edges[:-1, None] + half[:, None] * (
        1.0 + _INSIDE * lobatto_nodes(beam.nodes_per_panel)
    )
    curvature = np.asarray(beam.curvature(stations), dtype=np.float64)
    rotation = beam.root_angle + running_integral(curvature, half)
    x = running_integral(np.cos(rotation), half)
    y = running_integral(np.sin(rotation), half)
    lam = np.asarray(beam.half_thickness(stations), dtype=np.float64)
    return PreparedBeam(beam, edges, curvature, lam, rotation, np.stack([x, y], axis=-1))


def contact_load(
    prepared: PreparedBeam,
    station: ArrayLike,
    force: ArrayLike,
    side: ArrayLike,
    friction: ArrayLike = 0.0,
) -> BeamStates:
    """States under a contact force on the surface of the ribbon.

    Args:
        station: contact station s_c [m], scalar or (L,); λ must be constant and κ₀ zero there,
            so that the surface is parallel to the centre line.
        force: normal component of the contact force [N], >= 0, scalar or (L,).
        side: +1 when the contact is at +λ n (pushes in −n: positive torque), −1 when at −λ n.
        friction: tangential over normal component, positive when it pulls towards the tip.

    Shear slopes the surface by γ = V/GA_s against the section before the contact and not beyond
    it; the force is normal to the mean of both. With that a frictionless contact does no work
    when it moves along the surface, and moment arm and energy agree.
    """
    station, force, side, friction = (
        np.asarray(a, dtype=np.float64)
        for a in np.broadcast_arrays(np.atleast_1d(station), force, side, friction)
    )
    beam = prepared.beam
    section = area(beam.thickness, beam.half_thickness(station))
    slope = -0.5 * side * force / (SHEAR_CORRECTION * beam.shear_modulus * section)
    load = rotated(np.stack([friction * force, -side * force], axis=-1), slope)
    return _solve(
        prepared, station, load[:, 0], load[:, 1], np.zeros_like(force), side=side, slope=slope
    )


def follower_load(
    prepared: PreparedBeam,
    station: ArrayLike,
    axial: ArrayLike,
    transverse: ArrayLike,
    moment: ArrayLike = 0.0,
) -> BeamStates:
    """States under a force (axial t + transverse n) and a moment that turn with the section."""
    loads = (
        np.asarray(a, dtype=np.float64)
        for a in np.broadcast_arrays(np.atleast_1d(station), axial, transverse, moment)
    )
    station, axial, transverse, moment = loads
    zero = np.zeros_like(station)
    return _solve(prepared, station, axial, transverse, moment, side=zero, slope=zero)


@dataclass(frozen=True)
class _Loaded:
    """The part of the beam between root and loaded stations, at its nodes (L, P, n).

    ``half`` (L, P) are half the panel lengths; panels beyond the station have length 0.
    """

    half: Floats
    stations: Floats
    curvature: Floats
    half_thickness: Floats


def _loaded_part(prepared: PreparedBeam, station: Floats) -> _Loaded:
    """Cut the panels off at the loaded stations (L,)."""
    beam, edges = prepared.beam, prepared.edges
    if np.any(station <= 0.0) or np.any(station > edges[-1] * (1.0 + 1e-12)):
        raise ValueError("the loaded station must lie on the ribbon, beyond its root")
    clipped = np.minimum(edges, station[:, None])
    half = 0.5 * np.diff(clipped)
    s = clipped[:, :-1, None] + half[..., None] * (1.0 + lobatto_nodes(beam.nodes_per_panel))
    curvature = np.broadcast_to(prepared.curvature, s.shape).copy()
    lam = np.broadcast_to(prepared.half_thickness, s.shape).copy()
    cut = int(np.searchsorted(edges, station.min(), side="right")) - 1
    middle = s[:, cut:].mean(axis=-1, keepdims=True)
    inside = middle + _INSIDE * (s[:, cut:] - middle)
    curvature[:, cut:], lam[:, cut:] = beam.curvature(inside), beam.half_thickness(inside)
    return _Loaded(half, s, curvature, lam)


def _solve(
    prepared: PreparedBeam,
    station: Floats,
    axial: Floats,
    transverse: Floats,
    moment: Floats,
    *,
    side: Floats,
    slope: Floats,
) -> BeamStates:
    """States under forces at ``side`` · λ beside the centre line, on a surface of that slope."""
    beam, loads = prepared.beam, len(station)
    part = _loaded_part(prepared, station)
    curvature, lam = part.curvature, part.half_thickness
    offset = side * lam[:, -1, -1]
    fields = integrate_back(
        (part.half, curvature),
        stiffness(beam.thickness, lam, beam.elastic_modulus, beam.shear_modulus),
        (axial, transverse, moment - offset * axial),
    )

    root_moment, root = fields.moment[:, 0, 0], fields.positions[:, 0, 0]
    root_turn = beam.root_compliance * root_moment
    turn = beam.root_angle + root_turn - fields.rotation[:, 0, 0]
    end = rotated(-root, turn)
    positions = rotated(fields.positions - root[:, None, None], turn[:, None, None])
    n = rotated(np.array([0.0, 1.0]), turn)
    return BeamStates(
        end_station=station,
        end_position=end,
        end_rotation=turn,
        point=end + offset[:, None] * n,
        normal=np.where(side < 0.0, -1.0, 1.0)[:, None] * rotated(n, slope),
        force=rotated(np.stack([axial, transverse], axis=-1), turn),
        energy=fields.energy + 0.5 * root_turn * root_moment,
        root_moment=root_moment,
        stations=part.stations.reshape(loads, -1),
        half_thickness=lam.reshape(loads, -1),
        positions=positions.reshape(loads, -1, 2),
        rotation=(fields.rotation + turn[:, None, None]).reshape(loads, -1),
        moment=fields.moment.reshape(loads, -1),
        axial_force=fields.tension.reshape(loads, -1),
        curvature=curvature.reshape(loads, -1),
        thickness=beam.thickness,
    )
