"""The points and curves between which the mesh of one sector of the ring is spanned.

A skin of elements follows the free edge of the part: rim, fillet, side of the flexure, nose. On
each side of the root the inner face of the skin has one ``corner``, where five blocks meet. All in
the flexure frame; "left" (+1) and "right" (-1) as in ``Ribbon.boundary``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Arc, Line
from springcad.geometry.ribbon import Ribbon
from springcad.geometry.transform import backwards
from springcad.kinds.rotary_flexure.ring import edge_points, flexure_side, nose_arc
from springcad.mechanics.fem.blocks import straight

Floats = NDArray[np.float64]

SKIN = 0.25
"""Thickness of the skin over the local thickness of the flexure; less in a thin rim."""
SKIN_OF_RIM = 0.4
"""The skin takes no more than this share of the rim."""
SPLIT = (0.3, 0.7)
"""Between these shares of its sweep, from the rim, a fillet is divided into a lower and an upper
half."""


@dataclass(frozen=True)
class SectorGeometry:
    """What the mesh follows, SI: the flexure of the ring as it is cut, and the rim.

    ``blend`` is the radius between taper and pad, as in ``flexure_pieces``.
    """

    ribbon: Ribbon
    root_radius: float
    outer_radius: float
    count: int
    fillet: float
    blend: float

    @property
    def root_thickness(self) -> float:
        """Of the flexure, m."""
        return 2.0 * float(self.ribbon.at(np.zeros(1)).half_thickness[0])


@dataclass(frozen=True)
class RootSide:
    """One side of the root.

    Attributes:
        sign: +1 left, -1 right.
        station: where the fillet leaves the flexure.
        arc: the fillet, from the rim to the flexure.
        split: share of the arc that belongs to its lower half.
        rim_angle: about the ring's centre, of the fillet's end on the rim; left positive.
        corner, corner_angle: of the inner face of the skin.
        inner: inner face of the skin on the section at ``station``.
        flank: the edge from the fillet to the nose as it is cut.
    """

    sign: int
    station: float
    arc: Arc
    split: float
    rim_angle: float
    corner: Floats
    corner_angle: float
    inner: Floats
    flank: tuple[Line | Arc, ...]

    @property
    def end(self) -> Floats:
        """Where the fillet leaves the flexure."""
        return np.asarray(on_arc(self.arc, np.ones(1))[0])

    @property
    def upper_length(self) -> float:
        """Length of the upper half of the fillet."""
        return self.arc.radius * abs(self.arc.sweep) * (1.0 - self.split)

    @property
    def lower_length(self) -> float:
        """Length of the lower half of the fillet."""
        return self.arc.radius * abs(self.arc.sweep) * self.split


@dataclass(frozen=True)
class Skeleton:
    """Both sides of the root, the thickness of the rim's skin, and the nose."""

    left: RootSide
    right: RootSide
    skin: float
    nose: Arc

    @property
    def sides(self) -> tuple[RootSide, RootSide]:
        """Left, right."""
        return self.left, self.right


def sector_skeleton(sector: SectorGeometry) -> Skeleton:
    """Where the blocks of a sector meet.

    Raises:
        ValueError: there is no such root fillet.
    """
    rim = sector.outer_radius - sector.root_radius
    skin = min(SKIN * sector.root_thickness, SKIN_OF_RIM * rim)
    left, right = (_root_side(sector, skin, sign) for sign in (1, -1))
    return Skeleton(left, right, skin, nose_arc(sector.ribbon))


def _root_side(sector: SectorGeometry, skin: float, sign: int) -> RootSide:
    root = sector.root_radius
    fillet, flank = flexure_side(sector.ribbon, root, sector.fillet, sector.blend, sign)
    (arc,) = (fillet.arc,) if sign > 0 else backwards((fillet.arc,))
    assert isinstance(arc, Arc)
    here = np.array([fillet.station])
    (inner,) = skin_face(sector.ribbon, here, sign)
    corner = _towards_rim(inner, edge_points(sector.ribbon, here, sign)[1][0], root, root + skin)
    turn = math.atan2(*(corner - arc.center)[::-1]) - arc.start_angle
    turned = math.remainder(turn - 0.5 * arc.sweep, 2.0 * math.pi) + 0.5 * arc.sweep
    return RootSide(
        sign=sign,
        station=fillet.station,
        arc=arc,
        split=min(max(turned / arc.sweep, SPLIT[0]), SPLIT[1]),
        rim_angle=_polar_angle(on_arc(arc, np.zeros(1))[0], root),
        corner=corner,
        corner_angle=_polar_angle(corner, root),
        inner=inner,
        flank=flank,
    )


def skin_face(ribbon: Ribbon, stations: Floats, sign: int) -> Floats:
    """Inner face (K, 2) of the skin of one side of the flexure; straight on before the root."""
    near, _ = edge_points(ribbon, stations, sign)
    far, _ = edge_points(ribbon, stations, -sign)
    return np.asarray(near + SKIN * (far - near))


def flank_points(ribbon: Ribbon, side: RootSide, stations: Floats) -> Floats:
    """Points (K, 2) at stations of one side of the flexure, on the edge as it is cut."""
    return _nearest(side.flank, edge_points(ribbon, stations, side.sign)[0])


def on_arc(arc: Arc, fractions: Floats) -> Floats:
    """Points (K, 2) at fractions of the sweep."""
    angle = arc.start_angle + fractions * arc.sweep
    return np.asarray(arc.center + arc.radius * np.column_stack([np.cos(angle), np.sin(angle)]))


def polar(root_radius: float, radius: float, angles: Floats) -> Floats:
    """Points (K, 2) of the flexure frame at ``angles`` (left positive) about the ring's centre."""
    return np.column_stack([root_radius - radius * np.cos(angles), radius * np.sin(angles)])


def _polar_angle(point: Floats, root_radius: float) -> float:
    return math.atan2(point[1], root_radius - point[0])


def _towards_rim(start: Floats, tangent: Floats, root_radius: float, radius: float) -> Floats:
    """Where a line from ``start``, halfway between edge and radius, meets the circle ``radius``."""
    heading = -(tangent + np.array([1.0, 0.0]))
    heading /= np.hypot(*heading)
    away = start - np.array([root_radius, 0.0])
    along = float(away @ heading)
    reach = -along + math.sqrt(along**2 - float(away @ away) + radius**2)
    return np.asarray(start + reach * heading)


def _nearest(pieces: tuple[Line | Arc, ...], points: Floats) -> Floats:
    """The points (M, 2) of a chain of lines and arcs that are nearest to ``points`` (M, 2)."""
    lines = [piece for piece in pieces if isinstance(piece, Line)]
    arcs = [piece for piece in pieces if isinstance(piece, Arc)]
    candidates = np.concatenate(
        [*(_nearest_on_line(line, points)[None] for line in lines), _nearest_on_arcs(arcs, points)]
    )
    best = np.argmin(np.sum((candidates - points) ** 2, axis=-1), axis=0)
    return np.asarray(candidates[best, np.arange(len(points))])


def _nearest_on_line(line: Line, points: Floats) -> Floats:
    start, along = np.asarray(line.start), np.subtract(line.end, line.start)
    share = (points - start) @ along / (along @ along)
    return straight(start, start + along, np.clip(share, 0.0, 1.0))


def _nearest_on_arcs(arcs: list[Arc], points: Floats) -> Floats:
    """On each of K arcs (K, M, 2)."""
    rows = [(*arc.center, arc.radius, arc.start_angle, arc.sweep) for arc in arcs]
    x, y, radius, start, sweep = np.array(rows).reshape(-1, 5).T[:, :, None]
    turn = np.arctan2(points[:, 1] - y, points[:, 0] - x) - start - 0.5 * sweep
    turn -= 2.0 * math.pi * np.round(turn / (2.0 * math.pi))
    angle = start + np.clip(0.5 + turn / sweep, 0.0, 1.0) * sweep
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle)], axis=-1)
