"""Where the centre line of a ribbon is, unloaded and deformed; see ``springcad.mechanics.beam``."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springcad.mechanics.beam import BeamStates, PreparedBeam
from springcad.mechanics.lobatto import lagrange_basis
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]


def unloaded_points(prepared: PreparedBeam, stations: Floats) -> tuple[Floats, Floats]:
    """Centre-line points (..., 2) and tangent angles (...) of the unloaded ribbon."""
    edges, count = prepared.edges, prepared.beam.nodes_per_panel
    panel = np.clip(np.searchsorted(edges, stations, side="right") - 1, 0, len(edges) - 2)
    start, end = edges[panel], edges[panel + 1]
    basis = lagrange_basis(count, 2.0 * (stations - start) / (end - start) - 1.0)
    points = np.einsum("...n,...nd->...d", basis, prepared.unloaded_positions[panel])
    rotation = np.einsum("...n,...n->...", basis, prepared.unloaded_rotation[panel])
    return points, rotation


def deformed_points(
    prepared: PreparedBeam, states: BeamStates, stations: ArrayLike
) -> tuple[Floats, Floats]:
    """Centre-line points (L, M, 2) and tangent angles (L, M) at any stations (M,) or (L, M).

    Beyond the loaded station the unloaded shape goes on, moved with the loaded section.
    """
    loads, count = len(states.end_station), prepared.beam.nodes_per_panel
    edges, s_c = prepared.edges, states.end_station[:, None]
    s = np.asarray(stations, dtype=np.float64)
    s = np.broadcast_to(s, (loads, s.shape[-1]))
    loaded = np.minimum(s, s_c)
    panel = np.clip(np.searchsorted(edges, loaded, side="right") - 1, 0, len(edges) - 2)
    start, end = edges[panel], np.minimum(edges[panel + 1], s_c)
    width = np.where(end > start, end - start, 1.0)
    basis = lagrange_basis(count, 2.0 * (loaded - start) / width - 1.0)
    pick = (np.arange(loads)[:, None], panel)
    rotation = np.einsum("lmn,lmn->lm", basis, states.rotation.reshape(loads, -1, count)[pick])
    points = np.einsum("lmn,lmnd->lmd", basis, states.positions.reshape(loads, -1, count, 2)[pick])
    free, free_angle = unloaded_points(prepared, s)
    free_end, free_end_angle = unloaded_points(prepared, s_c)
    turn = states.end_rotation[:, None] - free_end_angle
    tail = s > s_c
    tail_points = rotated(free - free_end, turn) + states.end_position[:, None, :]
    return (
        np.where(tail[..., None], tail_points, points),
        np.where(tail, free_angle + turn, rotation),
    )
