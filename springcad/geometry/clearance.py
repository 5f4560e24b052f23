"""How thin a part gets, how narrow its gaps, how tight its inside corners.

Web and gap are measured along the normals: from points spread along every contour a ray runs
perpendicular to the contour, through the material for a web and through the void for a gap, to
the first contour that it meets. It counts where the two sides face each other, that is, where
they converge by less than 60°. The smallest such ray is the web or the gap. From a corner that
juts into what is measured, where there is no one normal, rays run in all directions between the
normals of its two sides.

The nearest ray passes a neck by half the spacing h at most. Between two bulges of radius R it is
longer than a narrow neck by (h/2)²/R, a tenth of a micrometre for R = 1 mm at the default spacing.
Where the sides converge at an angle φ it is longer than the circle between them is wide, by the
factor (1 + 1/cos φ)/2: 0.4 % at 7°.

Sharp corners. The two sides of a corner of 60° or more never face each other, so it is no web
however sharp. A sharper corner would be a web of width zero at its apex; it is left out, as far
as the part widens from the apex at least half as fast as the straight wedge of the same angle.
A corner that is rounded is no corner: there the web is about the diameter of the rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from springcad.geometry.biarc import exact_polyline
from springcad.geometry.outline import Floats, Profile
from springcad.geometry.polyline import (
    BulgePolyline,
    joint_turns,
    length,
    radii,
    segment_lengths,
    signed_area,
    sweeps,
    turned_round,
)
from springcad.geometry.rays import (
    CORNER,
    FAN_STEP,
    Hits,
    Rays,
    Walls,
    cast,
    facing,
    rays_from,
    wall_tree,
    walls_of,
)

DEFAULT_SPACING = 2e-5
"""Distance of the rays along a contour (m)."""

MOST_RAYS = 100_000
"""Beside those of corners and one for every segment."""

_FACING = np.radians(60.0)


@dataclass(frozen=True)
class Width:
    """A smallest distance (m) and the two points (m) between which it lies."""

    distance: float
    start: tuple[float, float]
    end: tuple[float, float]


def nearest(first: shapely.Geometry, second: shapely.Geometry) -> Width:
    """Smallest distance between two geometries, with the two nearest points."""
    start, end = shapely.get_coordinates(shapely.shortest_line(first, second))
    return Width(float(np.hypot(*(end - start))), _pair(start), _pair(end))


def smallest_web(profile: Profile, spacing: float = DEFAULT_SPACING) -> Width | None:
    """Thinnest place of the material; None where no two sides face each other."""
    return narrowest(material_sides(profile), spacing)


def smallest_gap(profile: Profile, spacing: float = DEFAULT_SPACING) -> Width | None:
    """Narrowest place of the void beside and inside the part; None where nothing is narrow."""
    return narrowest([turned_round(side) for side in material_sides(profile)], spacing)


def smallest_inside_radius(profile: Profile) -> float:
    """Tightest radius (m) of the contours where the void is inside the bend; see ``tightest``."""
    return tightest(material_sides(profile))


def tightest(sides: list[BulgePolyline]) -> float:
    """Smallest radius (m) of the bends to the right, 0 at a sharp corner, infinite without any.

    A chain of short straight lines counts as the arc that it stands for, radius = mean chord
    divided by turn.
    """
    smallest = np.inf
    for side in sides:
        concave = (sweeps(side) < 0.0) & (side.bulges != 0.0)
        turns = joint_turns(side)
        if np.any(turns < -CORNER):
            return 0.0
        chord = np.hypot(*side.chords.T)
        straight = (side.bulges == 0.0) & (np.roll(side.bulges, 1) == 0.0)
        facets = straight & (turns < -1e-3)
        with np.errstate(divide="ignore"):
            facet_radii = 0.5 * (chord + np.roll(chord, 1)) / -turns
        smallest = min(
            smallest,
            float(np.min(radii(side), where=concave, initial=np.inf)),
            float(np.min(facet_radii, where=facets, initial=np.inf)),
        )
    return smallest


def material_sides(profile: Profile) -> list[BulgePolyline]:
    """All contours, run through with the material on the left."""
    sides = []
    for contour, turn in [(profile.outer, 1.0), *((inner, -1.0) for inner in profile.inner)]:
        polyline = exact_polyline(contour)
        wrong = turn * signed_area(polyline) < 0.0
        sides.append(turned_round(polyline) if wrong else polyline)
    return sides


def narrowest(sides: list[BulgePolyline], spacing: float = DEFAULT_SPACING) -> Width | None:
    """The narrowest place of the region to the left of all ``sides``; None if no two face.

    ``spacing`` (m) is the distance of the rays along the contours; it is widened where that would
    make more than ``MOST_RAYS`` of them.
    """
    spacing = max(spacing, sum(length(side) for side in sides) / MOST_RAYS)
    rays, walls = rays_from(sides, spacing), walls_of(sides)
    tree = wall_tree(walls)
    apexes = [apex for i, side in enumerate(sides) for apex in _sharp_corners(side, i)]
    corners = np.concatenate([side.points[joint_turns(side) < -CORNER] for side in sides])
    extent = float(np.hypot(*np.ptp(walls.starts, axis=0)))
    reach = min(16.0 * spacing, extent)
    while True:
        # Every hit is within reach, so the shortest of any is the shortest of all.
        width = _shortest(rays, walls, cast(rays, walls, tree, reach), apexes)
        if width is not None:
            return _between_corners(width, corners)
        if reach >= extent:
            return None
        reach = min(4.0 * reach, extent)


def _shortest(rays: Rays, walls: Walls, hits: Hits, apexes: list[_Apex]) -> Width | None:
    """The shortest hit between two sides that face each other and are not one sharp corner."""
    ray, wall = hits.ray, hits.wall
    counts = facing(rays, walls, hits) > np.cos(_FACING)
    for apex in apexes:
        here = (rays.contour[ray] == apex.contour) & (walls.contour[wall] == apex.contour)
        counts &= ~(here & _in_wedge(apex, rays.place[ray], walls.place[wall], hits.distance))
    if not np.any(counts):
        return None
    # Equal webs differ by rounding; the first of them is taken on every machine.
    best = int(np.argmin(np.where(counts, np.round(hits.distance, 12), np.inf)))
    start, distance = rays.points[ray[best]], float(hits.distance[best])
    return Width(distance, _pair(start), _pair(start + distance * rays.directions[ray[best]]))


def _between_corners(width: Width, corners: Floats) -> Width:
    """The width from corner to corner where a ray passes two of them as near as a fan allows."""
    if not len(corners):
        return width
    ends = []
    for end in (width.start, width.end):
        offset = np.hypot(*(corners - end).T)
        near = int(np.argmin(offset))
        within = offset[near] <= 2.0 * FAN_STEP * width.distance
        ends.append(corners[near] if within else np.asarray(end))
    distance = float(np.hypot(*(ends[1] - ends[0])))
    if not 0.0 < distance < width.distance:
        return width
    return Width(distance, _pair(ends[0]), _pair(ends[1]))


@dataclass(frozen=True)
class _Apex:
    """A corner of less than 60°: its contour, place and angle; the length around that contour."""

    contour: int
    place: float
    angle: float
    around: float


def _sharp_corners(side: BulgePolyline, contour: int) -> list[_Apex]:
    lengths = segment_lengths(side)
    places = np.cumsum(lengths) - lengths
    angles = np.pi - joint_turns(side)
    around = float(np.sum(lengths))
    return [
        _Apex(contour, float(places[i]), float(angles[i]), around)
        for i in np.flatnonzero(angles < _FACING)
    ]


def _in_wedge(apex: _Apex, start: Floats, end: Floats, distance: Floats) -> NDArray[np.bool_]:
    """Which rays run from one side of a sharp corner to the other as in the wedge it begins."""

    def offset(place: Floats) -> Floats:
        half = 0.5 * apex.around
        return np.asarray((place - apex.place + half) % apex.around - half)

    before, after = offset(start), offset(end)
    wedge = np.abs(before) * np.tan(apex.angle)
    return np.asarray((before * after < 0.0) & (distance >= 0.5 * wedge))


def _pair(point: Floats) -> tuple[float, float]:
    return float(point[0]), float(point[1])
