"""Rays across a region, from the contours that bound it to the first contour that they meet.

The region lies to the left of every contour. Contours are found by their chords, and the distance
is then taken to the arc itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from springcad.geometry.outline import Floats
from springcad.geometry.polyline import (
    BulgePolyline,
    directions_at,
    flat_places,
    joint_turns,
    points_at,
    radii,
    rotate_vectors,
    segment_lengths,
    spread_places,
    sweeps,
)

CORNER = float(np.radians(15.0))
"""A joint that turns by more is a corner; less is taken for a facet of something smooth."""

FAN_STEP = float(np.radians(1.0))
"""Largest angle between neighbouring rays: along small arcs and in the fan of a corner."""

_CHORD = 5e-7  # m: a wall is an arc within this distance of its chord
_SKIP = 2.0 * _CHORD  # m: rays begin clear of the chords of their own arc

Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Rays:
    """Where rays start, their directions, and where that is: contour and arc length along it."""

    points: Floats
    directions: Floats
    contour: Indices
    place: Floats


@dataclass(frozen=True)
class Walls:
    """The pieces of arc that the rays meet, found by their chords; addressed as the rays are."""

    starts: Floats
    ends: Floats
    tangents: Floats
    curvatures: Floats
    contour: Indices
    place: Floats


@dataclass(frozen=True)
class Hits:
    """Rays that meet a wall: index of the ray and of its first wall, and the distance (m)."""

    ray: Indices
    wall: Indices
    distance: Floats


def rays_from(sides: Sequence[BulgePolyline], spacing: float) -> Rays:
    """Rays into the region: one every ``spacing`` (m) or degree, a fan from jutting corners."""
    parts = [_rays(side, i, spacing) for i, side in enumerate(sides)]
    return Rays(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.directions for part in parts]),
        np.concatenate([part.contour for part in parts]),
        np.concatenate([part.place for part in parts]),
    )


def walls_of(sides: Sequence[BulgePolyline]) -> Walls:
    """The contours themselves, in pieces so short that each is nearly its chord."""
    parts = [_walls(side, i) for i, side in enumerate(sides)]
    return Walls(
        np.concatenate([part.starts for part in parts]),
        np.concatenate([part.ends for part in parts]),
        np.concatenate([part.tangents for part in parts]),
        np.concatenate([part.curvatures for part in parts]),
        np.concatenate([part.contour for part in parts]),
        np.concatenate([part.place for part in parts]),
    )


def wall_tree(walls: Walls) -> shapely.STRtree:
    """The index in which ``cast`` finds the walls that a ray may meet."""
    return shapely.STRtree(shapely.linestrings(np.stack((walls.starts, walls.ends), axis=1)))


def cast(rays: Rays, walls: Walls, tree: shapely.STRtree, reach: float) -> Hits:
    """The first wall that each ray meets within ``reach`` (m)."""
    ends = (rays.points + _SKIP * rays.directions, rays.points + reach * rays.directions)
    ray, wall = tree.query(shapely.linestrings(np.stack(ends, axis=1)), predicate="intersects")
    span = walls.ends[wall] - walls.starts[wall]
    to_wall = walls.starts[wall] - rays.points[ray]
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = _cross(to_wall, span) / _cross(rays.directions[ray], span)
    crossing = np.isfinite(distance)
    distance, ray, wall = distance[crossing], ray[crossing], wall[crossing]
    order = np.lexsort((distance, ray))
    first = order[np.unique(ray[order], return_index=True)[1]]
    return _refined(rays, walls, Hits(ray[first], wall[first], distance[first]))


def facing(rays: Rays, walls: Walls, hits: Hits) -> Floats:
    """Cosine of the angle between each ray and the outward normal of the wall it meets."""
    span = walls.ends[hits.wall] - walls.starts[hits.wall]
    return np.asarray(_cross(rays.directions[hits.ray], span) / np.hypot(*span.T))


def _refined(rays: Rays, walls: Walls, hits: Hits) -> Hits:
    """From the chord to its arc: two Newton steps on κ |x - a|² - 2 n·(x - a) = 0."""
    tangent, bend = walls.tangents[hits.wall], walls.curvatures[hits.wall]
    normal = np.column_stack((-tangent[:, 1], tangent[:, 0]))
    direction = rays.directions[hits.ray]
    offset = rays.points[hits.ray] - walls.starts[hits.wall]
    across = np.sum(normal * direction, axis=1)
    distance = hits.distance
    for _ in range(2):
        x = offset + distance[:, None] * direction
        value = bend * np.sum(x * x, axis=1) - 2.0 * np.sum(normal * x, axis=1)
        slope = 2.0 * (bend * np.sum(x * direction, axis=1) - across)
        # A grazing ray has no slope; it faces nothing and its distance does not matter.
        distance = distance - np.divide(value, slope, out=np.zeros_like(value), where=slope != 0.0)
    return Hits(hits.ray, hits.wall, distance)


def _rays(side: BulgePolyline, contour: int, spacing: float) -> Rays:
    lengths = segment_lengths(side)
    places = np.cumsum(lengths) - lengths
    turned = np.abs(sweeps(side)) / FAN_STEP
    counts = np.maximum(np.ceil(np.maximum(lengths / spacing, turned)), 1.0)
    index, fraction = spread_places(counts)
    segment = index.astype(np.intp)
    fraction = fraction + 0.5 / counts[segment]
    along = [directions_at(side, index, fraction)]
    points = [points_at(side, index, fraction)]
    place = [places[segment] + fraction * lengths[segment]]
    turns = joint_turns(side)
    for i in np.flatnonzero(turns < -CORNER):
        steps = int(np.ceil(-turns[i] / FAN_STEP)) + 1
        before = directions_at(side, np.array([i - 1.0]), np.ones(1))
        fan = np.linspace(0.0, turns[i], steps)
        along.append(rotate_vectors(np.repeat(before, steps, axis=0), fan))
        points.append(np.repeat(side.points[[i]], steps, axis=0))
        place.append(np.full(steps, places[i]))
    tangents = np.concatenate(along)
    normals = np.column_stack((-tangents[:, 1], tangents[:, 0]))
    where = np.concatenate(place)
    return Rays(np.concatenate(points), normals, np.full(len(where), contour), where)


def _walls(side: BulgePolyline, contour: int) -> Walls:
    index, fraction = flat_places(side, _CHORD)
    segment = index.astype(np.intp)
    points = points_at(side, index, fraction)
    ends = np.roll(points, -1, axis=0)
    chords = np.hypot(*(ends - points).T)
    # The chords are a little shorter than the arcs; the places only tell one side from another.
    return Walls(
        points,
        ends,
        directions_at(side, index, fraction),
        (np.sign(side.bulges) / radii(side))[segment],
        np.full(len(points), contour),
        np.cumsum(chords) - 0.5 * chords,
    )


def _cross(first: Floats, second: Floats) -> Floats:
    return np.asarray(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
