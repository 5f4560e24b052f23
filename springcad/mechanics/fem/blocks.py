"""Structured quadratic meshes: transfinite blocks of 8-node quadrilaterals, joined into one mesh.

A block is a grid of points (2 a + 1, 2 b + 1, 2) of a x b elements: corners at even indices,
mid-side nodes between them (the points in the middle of elements are not used). Its first index
runs along ``south`` and ``north``, its second along ``west`` and ``east``; first and second
direction are right-handed. A side is a sampled curve of 2 a + 1 or 2 b + 1 points.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from springcad.mechanics.fem.element import CORNERS, MID_SIDES, gauss_points, shape_functions
from springcad.mechanics.fem.mesh import Mesh

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Side = Literal["south", "east", "north", "west"]

COINCIDENT = 1e-6
"""Nodes of two blocks closer than this share of the smallest element edge are one node."""


def graded(count: int, ratio: float = 1.0) -> Floats:
    """Positions (2 count + 1,) from 0 to 1 of the nodes of ``count`` elements in a row.

    The lengths of the elements form a geometric sequence, the last ``ratio`` times the first.
    """
    lengths = ratio ** (np.arange(count) / max(count - 1, 1))
    return with_middles(np.concatenate([[0.0], np.cumsum(lengths) / np.sum(lengths)]))


def with_middles(corners: Floats) -> Floats:
    """Positions (2 K - 1,) of K corners in a row and of the mid-side nodes between them."""
    nodes = np.empty(2 * len(corners) - 1)
    nodes[::2] = corners
    nodes[1::2] = 0.5 * (corners[1:] + corners[:-1])
    return nodes


def spaced(positions: Floats, sizes: Floats) -> Floats:
    """Corner positions (K,) over the span of ``positions`` whose distances follow ``sizes``.

    Args:
        positions: ascending (M,), dense against the sizes.
        sizes: wanted element length there (M,); all are made smaller by one common factor, so
            that a whole number of elements fits.
    """
    steps = 0.5 * (1.0 / sizes[1:] + 1.0 / sizes[:-1]) * np.diff(positions)
    elements = np.concatenate([[0.0], np.cumsum(steps)])
    count = max(int(np.ceil(elements[-1] * (1.0 - 1e-9))), 1)
    even = np.linspace(0.0, elements[-1], count + 1)
    return np.asarray(np.interp(even, elements, positions))


def straight(start: Floats, end: Floats, fractions: Floats) -> Floats:
    """Points (K, 2) on the line from ``start`` to ``end`` at ``fractions`` (K,) of its length."""
    return np.asarray(start + fractions[:, None] * (end - start))


def chain(*curves: Floats) -> Floats:
    """Curves joined end to start, each common point once."""
    return np.concatenate([curves[0], *(curve[1:] for curve in curves[1:])])


def transfinite(south: Floats, north: Floats, west: Floats, east: Floats) -> Floats:
    """Block between four curves (Gordon and Hall 1973), blended by their lengths.

    Each node takes the fractions of arc length of the two curves that end at its grid lines, so
    the spacing of opposite sides is carried over the block; between straight west and east sides
    of equal spacing all lines across the block are straight.

    Args:
        south, north: (2 a + 1, 2) in the first direction.
        west, east: (2 b + 1, 2) in the second, from south to north.

    Raises:
        ValueError: the curves do not meet at the corners.
    """
    corners = (
        (south[0], west[0]), (south[-1], east[0]), (north[0], west[-1]), (north[-1], east[-1])
    )  # fmt: skip
    extent = np.ptp(np.concatenate([south, north]), axis=0).max()
    if any(np.hypot(*(a - b)) > 1e-9 * extent for a, b in corners):
        raise ValueError("the four sides of a block do not meet at its corners")
    a, b = np.linspace(0.0, 1.0, len(south)), np.linspace(0.0, 1.0, len(west))
    u = np.outer(_fractions(south), 1.0 - b) + np.outer(_fractions(north), b)
    v = np.outer(1.0 - a, _fractions(west)) + np.outer(a, _fractions(east))
    u, v = u[..., None], v[..., None]
    between = (1.0 - v) * south[:, None] + v * north[:, None]
    across = (1.0 - u) * west[None] + u * east[None]
    bilinear = (1.0 - u) * ((1.0 - v) * south[0] + v * north[0]) + u * (
        (1.0 - v) * south[-1] + v * north[-1]
    )
    return np.asarray(between + across - bilinear)


def join(blocks: Mapping[str, Floats], edge_sets: Mapping[str, Sequence[tuple[str, Side]]]) -> Mesh:
    """One mesh from blocks whose common sides have the same nodes.

    Args:
        blocks: grids of points by name.
        edge_sets: by name, the sides of blocks that make it up, in their order along the
            boundary; the nodes of each become the node set of the same name, in that order.

    Raises:
        ValueError: an element is turned inside out or has no area.
    """
    grids, points, cells, borders, first = {}, [], [], [], 0
    for name, block in blocks.items():
        rows, columns = block.shape[:2]
        grids[name] = first + np.arange(rows * columns).reshape(rows, columns)
        points.append(block.reshape(-1, 2))
        cells.append(_cells(grids[name]))
        borders.append(_border(grids[name]))
        first += rows * columns
    elements = np.concatenate(cells)
    nodes, number = _merged(np.concatenate(points), np.concatenate(borders), elements)
    edges = {
        name: np.concatenate([number[_side_edges(grids[block], side)] for block, side in sides])
        for name, sides in edge_sets.items()
    }
    mesh = Mesh(nodes, number[elements], {k: edge_nodes(e) for k, e in edges.items()}, edges)
    if smallest_scaled_jacobian(mesh) <= 0.0:
        raise ValueError("an element of the mesh is turned inside out")
    return mesh


def edge_nodes(edges: Indices) -> Indices:
    """Nodes of a chain of quadratic edges (K, 3) in their order along it (2 K + 1,)."""
    return np.asarray(np.append(edges[:, :2], edges[-1, 2]))


def scaled_jacobians(mesh: Mesh) -> Floats:
    """Sine of the angle between the coordinate lines at the eight nodes of each element (E, 8).

    1 where they are perpendicular, 0 where an element is folded flat or a side has no length,
    below 0 where it is inside out.
    """
    cross, along, across = _area_scales(mesh, np.concatenate([CORNERS, MID_SIDES]))
    lengths = along * across
    return np.asarray(np.where(lengths > 0.0, cross / np.where(lengths > 0.0, lengths, 1.0), 0.0))


def smallest_scaled_jacobian(mesh: Mesh) -> float:
    """Smallest scaled Jacobian of the mesh: a valid mesh has more than 0, a good one over 0.3."""
    return float(scaled_jacobians(mesh).min())


def mesh_area(mesh: Mesh) -> float:
    """Area in m²; exact for quadratic elements."""
    points, weights = gauss_points()
    return float(np.sum(_area_scales(mesh, points)[0] @ weights))


def _area_scales(mesh: Mesh, local: Floats) -> tuple[Floats, Floats, Floats]:
    """Jacobian determinant and lengths of its two columns (E, M) at ``local`` points (M, 2)."""
    lines = shape_functions(local)[1].reshape(-1, 8) @ mesh.nodes[mesh.elements]
    (ax, ay), (bx, by) = lines.reshape(-1, len(local), 2, 2).transpose(2, 3, 0, 1)
    return ax * by - ay * bx, np.hypot(ax, ay), np.hypot(bx, by)


def _fractions(curve: Floats) -> Floats:
    """Share of the length of a sampled curve at its points."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(curve, axis=0).T))])
    return np.asarray(length / length[-1])


def _cells(grid: Indices) -> Indices:
    """Elements (E, 8) of a grid of node numbers."""
    first, last = slice(None, -2, 2), slice(2, None, 2)
    middle = slice(1, None, 2)
    order = (
        (first, first), (last, first), (last, last), (first, last),
        (middle, first), (last, middle), (middle, last), (first, middle),
    )  # fmt: skip
    return np.stack([grid[i, j].ravel() for i, j in order], axis=1)


def _border(grid: Indices) -> Indices:
    """Node numbers along the four sides of a grid."""
    return np.concatenate([grid[0], grid[-1], grid[1:-1, 0], grid[1:-1, -1]])


def _side_edges(grid: Indices, side: Side) -> Indices:
    """Edges (K, 3) of a side, counter-clockwise round the block."""
    sides = {
        "south": grid[:, 0], "east": grid[-1], "north": grid[::-1, -1], "west": grid[0, ::-1]
    }  # fmt: skip
    nodes = sides[side]
    return np.stack([nodes[:-2:2], nodes[1:-1:2], nodes[2::2]], axis=1)


def _merged(points: Floats, border: Indices, elements: Indices) -> tuple[Floats, Indices]:
    """The distinct nodes that elements use, and for each point the number of its node.

    Only points on the ``border`` of a block can be one.
    """
    corners = points[elements[:, :4]]
    edges = np.hypot(*np.moveaxis(corners - np.roll(corners, 1, axis=1), -1, 0))
    near = cKDTree(points[border]).query_pairs(
        COINCIDENT * float(edges.min()), output_type="ndarray"
    )
    links = coo_array((np.ones(len(near)), border[near].T), shape=(len(points), len(points)))
    _, group = connected_components(links, directed=False)
    used = np.unique(elements)
    kept, first = np.unique(group[used], return_index=True)
    number = np.full(int(group.max()) + 1, -1)
    number[kept] = np.arange(len(kept))
    return points[used[first]], number[group]
