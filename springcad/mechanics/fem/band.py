"""The stiffness matrix of the free unknowns in banded storage, and its solution.

Where every entry of the element matrices goes, through constraints and renumbering, is found once;
after that assembly is a single weighted count. Ribbons and rings have narrow bands after reverse
Cuthill–McKee numbering, and LAPACK's banded Cholesky is then the fastest solver.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import reverse_cuthill_mckee

from springcad.mechanics.fem.stairs import Stair, find_stairs, places, storage
from springcad.mechanics.fem.stairs import solve as solve_stairs

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Scatter:
    """Which source entries, times which factors, add up to which places of the band."""

    source: Indices
    factor: Floats
    place: Indices


@dataclass(frozen=True)
class Pattern:
    """Numbering of the m free unknowns: ``place`` (m,) in the band, and the stairs of the band.

    ``transform`` (2 N, m) takes free unknowns to displacements.
    """

    transform: sparse.csr_array[np.float64]
    place: Indices
    stairs: tuple[Stair, ...]


def number_unknowns(transform: sparse.csr_array[np.float64], elements: Indices) -> Pattern:
    """Renumber the free unknowns of a mesh with elements (E, 8) for a narrow band."""
    unknowns, free = transform.shape
    components = (2 * elements[..., None] + np.arange(2)).reshape(len(elements), -1)
    owner = np.repeat(np.arange(len(elements)), components.shape[1])
    incidence = sparse.csr_array(
        (np.ones(components.size), (owner, components.ravel())), shape=(len(elements), unknowns)
    )
    touched = incidence @ abs(transform)
    graph = sparse.csr_matrix(touched.T @ touched)
    order = reverse_cuthill_mckee(graph, symmetric_mode=True)
    place = np.empty(free, dtype=np.intp)
    place[order] = np.arange(free)
    entries = graph.tocoo()
    return Pattern(transform, place, find_stairs(place[entries.row], place[entries.col], free))


def scatter(pattern: Pattern, rows: Indices, columns: Indices, source: Indices) -> Scatter:
    """Where entries of a symmetric matrix go: ``source[i]`` belongs to (rows[i], columns[i]).

    All entries are given; the band keeps the lower triangle.
    """
    entry, row, row_factor = _expand(pattern, rows)
    again, column, column_factor = _expand(pattern, columns[entry])
    source, row = source[entry][again], row[again]
    factor = row_factor[again] * column_factor
    lower = row >= column
    place = places(pattern.stairs, row[lower], column[lower])
    return Scatter(source[lower], factor[lower], place)


def _expand(pattern: Pattern, components: Indices) -> tuple[Indices, Indices, Floats]:
    """Replace displacement components by the free unknowns behind them, in the new numbering.

    Returns which of the ``components`` each came from, the unknown, and its factor.
    """
    transform = pattern.transform
    count = np.diff(transform.indptr)[components]
    entry = np.repeat(np.arange(len(components)), count)
    within = np.arange(len(entry)) - np.repeat(np.cumsum(count) - count, count)
    position = transform.indptr[components][entry] + within
    return entry, pattern.place[transform.indices[position]], transform.data[position]


def gather(pattern: Pattern, parts: list[tuple[Scatter, Floats]]) -> Floats:
    """Add element matrices (any shape, in the order the scatter was made for) up into the band."""
    band = np.zeros(storage(pattern.stairs))
    for where, values in parts:
        np.add.at(band, where.place, values.ravel()[where.source] * where.factor)
    return band


def solve(pattern: Pattern, band: Floats, right: Floats) -> Floats:
    """Solve K q = right (m, c) for the free unknowns (m, c), in their original order.

    Cholesky, or LU with pivoting when the matrix is not positive definite (beyond a limit point).

    Raises:
        ArithmeticError: the matrix is singular: the part is not held.
    """
    ordered = np.empty_like(right)
    ordered[pattern.place] = right
    return solve_stairs(pattern.stairs, band, ordered)[pattern.place]


def solve_corrected(
    pattern: Pattern, band: Floats, right: Floats, components: Indices, correction: Floats
) -> Floats:
    """Solve (K + Bᵀ C B) q = right (m,), B the rows of the transform of r displacement components.

    ``correction`` C (r, r) need not be symmetric; by the Woodbury formula the band stays so.
    """
    some = np.asarray(pattern.transform[components].toarray())
    solution = solve(pattern, band, np.column_stack([right, some.T]))
    plain, answers = solution[:, 0], solution[:, 1:]
    inner = np.eye(len(components)) + correction @ (some @ answers)
    return np.asarray(plain - answers @ np.linalg.solve(inner, correction @ (some @ plain)))
