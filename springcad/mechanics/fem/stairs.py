"""Cholesky factorisation of a symmetric band that is not equally wide everywhere.

A wide rim and a narrow ribbon make one band with a step in it, and LAPACK's banded Cholesky would
take the width of the rim for all of it: its work grows with the width squared. So the columns are
divided into stairs, each a band as wide as its own columns need. A stair is factorised together
with the corner of the next that its columns reach, L Lᵀ of that corner is what the elimination has
left of it, and the next stair begins with that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, solve_banded
from scipy.linalg.lapack import dpbtrf, dtbtrs

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_GRAIN = 64
"""Stairs begin at multiples of this many columns."""
_SLOW = 64
"""LAPACK takes a time proportional to (width + this)² per column,"""
_CALLS = 1.5e6
"""and for each stair as long as for so much of that: some 30 microseconds."""


@dataclass(frozen=True)
class Stair:
    """Columns ``start`` to ``end`` of the lower triangle, with the corner of those that follow.

    Attributes:
        overlap: how many rows beyond ``end`` the columns reach: the size of the corner.
        width: rows below the diagonal that are kept.
        offset: of the first entry in the storage: column by column, from the diagonal down.
    """

    start: int
    end: int
    overlap: int
    width: int
    offset: int

    @property
    def count(self) -> int:
        """Number of columns, the corner's included."""
        return self.end - self.start + self.overlap

    @property
    def size(self) -> int:
        """Number of entries in the storage."""
        return (self.width + 1) * self.count


def find_stairs(rows: Indices, columns: Indices, count: int) -> tuple[Stair, ...]:
    """The quickest stairs for a matrix (count, count) with entries at (rows[i], columns[i])."""
    heights = _heights(rows, columns, count)
    cuts = np.append(np.arange(0, max(count, 1), _GRAIN), count)
    tallest = np.maximum.reduceat(heights, cuts[:-1])
    overlaps = np.append(heights, 0)[cuts - 1]
    overlaps[0] = 0
    least, best = np.zeros(len(cuts)), np.zeros(len(cuts), dtype=np.intp)
    for last in range(1, len(cuts)):
        widths = np.maximum.accumulate(tallest[last - 1 :: -1])[::-1]
        lengths = cuts[last] - cuts[:last]
        work = least[:last] + (lengths + overlaps[last]) * (widths + _SLOW) ** 2.0 + _CALLS
        work[lengths < overlaps[:last]] = np.inf  # the corner of the stair before must be in it
        best[last] = np.argmin(work)
        least[last] = work[best[last]]
    bounds = [len(cuts) - 1]
    while bounds[-1] > 0:
        bounds.append(int(best[bounds[-1]]))
    stairs: list[Stair] = []
    offset = 0
    for first, last in zip(bounds[:0:-1], bounds[-2::-1], strict=True):
        width = int(max(*tallest[first:last], overlaps[first]))
        stairs.append(Stair(int(cuts[first]), int(cuts[last]), int(overlaps[last]), width, offset))
        offset += stairs[-1].size
    return tuple(stairs)


def _heights(rows: Indices, columns: Indices, count: int) -> Indices:
    """How many rows below the diagonal every column has to keep, with what elimination fills in."""
    first = np.arange(count)
    np.minimum.at(first, rows, columns)
    reach = np.arange(count)
    np.maximum.at(reach, first, np.arange(count))
    return np.asarray(np.maximum.accumulate(reach) - np.arange(count))


def places(stairs: Sequence[Stair], rows: Indices, columns: Indices) -> Indices:
    """Where entries of the lower triangle are stored."""
    base = [s.offset - s.start + (np.arange(s.start, s.end) - s.start) * s.width for s in stairs]
    return np.asarray(np.concatenate(base)[columns] + rows)


def storage(stairs: Sequence[Stair]) -> int:
    """Number of entries of all stairs."""
    return stairs[-1].offset + stairs[-1].size


def solve_definite(stairs: Sequence[Stair], entries: Floats, right: Floats) -> Floats:
    """Solve the system with the stored ``entries``, which are lost, for right sides (m, c).

    Raises:
        LinAlgError: the matrix is not positive definite.
    """
    factors, corners = _factorised(stairs, entries)
    solution = right.copy()
    for stair, factor, corner in zip(stairs, factors, corners, strict=True):
        known = slice(stair.start, stair.end + stair.overlap)
        solution[known] = dtbtrs(factor, solution[known], uplo="L")[0]
        solution[stair.end : known.stop] = corner @ solution[stair.end : known.stop]
    for stair, factor, corner in zip(stairs[::-1], factors[::-1], corners[::-1], strict=True):
        half = solution[stair.start : stair.end + stair.overlap].copy()
        half[stair.end - stair.start :] = corner.T @ half[stair.end - stair.start :]
        back = dtbtrs(factor, half, uplo="L", trans="T")[0]
        solution[stair.start : stair.end] = back[: stair.end - stair.start]
    return solution


def _factorised(stairs: Sequence[Stair], entries: Floats) -> tuple[list[Floats], list[Floats]]:
    """Cholesky factors of the stairs (width + 1, count), which take the place of ``entries``.

    And the square of every factor (overlap, overlap) that belongs to its corner.

    Raises:
        LinAlgError: the matrix is not positive definite.
    """
    factors, corners = [], []
    for stair, after in zip(stairs, [*stairs[1:], None], strict=True):
        lower = np.tri(stair.overlap, dtype=np.bool_)
        corner = _square(entries, stair, stair.end, stair.overlap)
        if after is not None:
            left = _square(entries, after, stair.end, stair.overlap)
            corner[lower] = left[lower]
        columns = entries[stair.offset : stair.offset + stair.size].reshape(stair.count, -1)
        factor, failed = dpbtrf(columns.T, lower=1, overwrite_ab=1)
        if failed:
            raise LinAlgError
        factors.append(factor)
        corners.append(np.where(lower, corner, 0.0))
        if after is not None:
            left[lower] = (corners[-1] @ corners[-1].T)[lower]
    return factors, corners


def _square(entries: Floats, stair: Stair, start: int, size: int) -> Floats:
    """View (size, size) of the storage of a square on the diagonal, its upper half meaningless."""
    first = stair.offset + (start - stair.start) * (stair.width + 1)
    # One column on is one row up: (i, j) is stored at first + j width + i.
    return entries[first : first + size * stair.width].reshape(size, stair.width)[:, :size].T


def solve_indefinite(stairs: Sequence[Stair], entries: Floats, right: Floats) -> Floats:
    """The same by LU with pivoting, for any matrix.

    Raises:
        ArithmeticError: the matrix is singular: the part is not held.
    """
    width = max(stair.width for stair in stairs)
    full = np.zeros((2 * width + 1, len(right)))
    for stair in stairs:
        columns = entries[stair.offset : stair.offset + stair.size].reshape(stair.count, -1)
        own = columns[: stair.end - stair.start].T
        full[width : width + len(own), stair.start : stair.end] = own
    for k in range(1, width + 1):
        full[width - k, k:] = full[width + k, : len(right) - k]
    try:
        return np.asarray(solve_banded((width, width), full, right))
    except LinAlgError as error:
        raise ArithmeticError("the stiffness matrix is singular") from error
