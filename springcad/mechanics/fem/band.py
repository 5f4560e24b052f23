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
from scipy.linalg import LinAlgError
from scipy.sparse.csgraph import reverse_cuthill_mckee

from springcad.mechanics.fem.constraints import Constraints
from springcad.mechanics.fem.stairs import (
    Stair,
    find_stairs,
    places,
    solve_definite,
    solve_indefinite,
    storage,
)

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Scatter:
    """Which source entries, times which factors, add up to which places of the band."""

    source: Indices
    factor: Floats
    place: Indices


Part = tuple[Scatter, Floats]
"""Element matrices (any shape) of a sum, and where they go."""


@dataclass(frozen=True)
class Pattern:
    """Numbering of the m free unknowns: ``place`` (m,) in the band, and the stairs of the band.

    ``constraints`` take free unknowns to the displacements of the N nodes. ``untouched`` (2 N,) is
    the place of every component that no equation names, -1 where one does.
    """

    constraints: Constraints
    place: Indices
    stairs: tuple[Stair, ...]
    untouched: Indices


def number_unknowns(constraints: Constraints, elements: Indices) -> Pattern:
    """Renumber the free unknowns of a mesh with elements (E, 8) for a narrow band.

    Both components of a node have the same neighbours, so that nodes are put in order.
    """
    transform, equations = constraints.transform, constraints.equations
    entry, unknown, _ = _expand(transform, components_of(elements).ravel())
    element = entry // 16
    nodes, node = np.unique(constraints.free // 2, return_inverse=True)
    incidence = sparse.csr_array(
        (np.ones(len(unknown)), (element, node[unknown])), shape=(len(elements), len(nodes))
    )
    graph = sparse.csr_matrix(incidence.T @ incidence)
    turn = np.empty(len(nodes), dtype=np.intp)
    turn[reverse_cuthill_mckee(graph, symmetric_mode=True)] = np.arange(len(nodes))
    place = np.empty(len(node), dtype=np.intp)
    place[np.argsort(turn[node], kind="stable")] = np.arange(len(node))

    # The columns of an element reach from its first unknown to all its others.
    first = np.full(len(elements), len(place), dtype=np.intp)
    np.minimum.at(first, element, place[unknown])
    untouched = np.full(transform.shape[0], -1, dtype=np.intp)
    untouched[constraints.free] = place
    untouched[equations.masters] = -1
    stairs = find_stairs(place[unknown], first[element], len(place))
    return Pattern(constraints, place, stairs, untouched)


def components_of(nodes: Indices) -> Indices:
    """Displacement components (K, 2 n) of rows of n nodes (K, n): x and y of one, of the next."""
    return (2 * nodes[..., None] + np.arange(2)).reshape(len(nodes), -1)


def scatter(pattern: Pattern, rows: Indices, columns: Indices, source: Indices) -> Scatter:
    """Where entries of a symmetric matrix go: ``source[i]`` belongs to (rows[i], columns[i]).

    All entries are given; the band keeps the lower triangle.
    """
    transform = pattern.constraints.transform
    entry, row, row_factor = _expand(transform, rows)
    again, column, column_factor = _expand(transform, columns[entry])
    source, row, column = source[entry][again], pattern.place[row[again]], pattern.place[column]
    factor = row_factor[again] * column_factor
    lower = row >= column
    place = places(pattern.stairs, row[lower], column[lower])
    return Scatter(source[lower], factor[lower], place)


def scatter_untouched(pattern: Pattern, components: Indices, source: Indices) -> Scatter:
    """The same for symmetric matrices of K x n components (K, n) that no equation names.

    ``source`` (K, n (n + 1) / 2) is of their lower triangles, row by row.
    """
    unknowns = pattern.untouched[components]
    rows, columns = (unknowns[:, some] for some in np.tril_indices(components.shape[1]))
    place = places(pattern.stairs, np.maximum(rows, columns), np.minimum(rows, columns))
    return Scatter(source.ravel(), np.ones(source.size), place.ravel())


def together(first: Scatter, second: Scatter) -> Scatter:
    """Both, of the same source."""
    return Scatter(
        np.concatenate([first.source, second.source]),
        np.concatenate([first.factor, second.factor]),
        np.concatenate([first.place, second.place]),
    )


def _expand(
    transform: sparse.csr_array[np.float64], components: Indices
) -> tuple[Indices, Indices, Floats]:
    """Replace displacement components by the free unknowns behind them.

    Returns which of the ``components`` each came from, the unknown, and its factor.
    """
    first = transform.indptr[components]
    count = transform.indptr[components + 1] - first
    entry = np.repeat(np.arange(len(components)), count)
    within = np.arange(len(entry)) - np.repeat(np.cumsum(count) - count, count)
    position = first[entry] + within
    return entry, transform.indices[position], transform.data[position]


def _gathered(pattern: Pattern, parts: list[Part]) -> Floats:
    """The parts added up in the band."""
    band = np.zeros(storage(pattern.stairs))
    for where, values in parts:
        np.add.at(band, where.place, values.ravel()[where.source] * where.factor)
    return band


def solve(pattern: Pattern, parts: list[Part], right: Floats) -> Floats:
    """Solve K q = right (m, c) for the free unknowns (m, c), in their original order.

    Cholesky, or LU with pivoting when the matrix is not positive definite (beyond a limit point).

    Raises:
        ArithmeticError: the matrix is singular: the part is not held.
    """
    ordered = np.empty_like(right)
    ordered[pattern.place] = right
    try:
        solution = solve_definite(pattern.stairs, _gathered(pattern, parts), ordered)
    except LinAlgError:
        solution = solve_indefinite(pattern.stairs, _gathered(pattern, parts), ordered)
    return solution[pattern.place]


def solve_corrected(
    pattern: Pattern, parts: list[Part], right: Floats, components: Indices, correction: Floats
) -> Floats:
    """Solve (K + Bᵀ C B) q = right (m,), B the rows of the transform of r displacement components.

    ``correction`` C (r, r) need not be symmetric; by the Woodbury formula the band stays so.
    """
    some = np.asarray(pattern.constraints.transform[components].toarray())
    solution = solve(pattern, parts, np.column_stack([right, some.T]))
    plain, answers = solution[:, 0], solution[:, 1:]
    inner = np.eye(len(components)) + correction @ (some @ answers)
    return np.asarray(plain - answers @ np.linalg.solve(inner, correction @ (some @ plain)))
