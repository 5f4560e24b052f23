"""Piecewise polynomials on panels: Gauss–Lobatto nodes, cumulative integrals, interpolation.

A function is known by its values at the n Gauss–Lobatto nodes of each panel; integrals from the
start of a panel to every node are exact for the polynomial through them, and over a whole panel
exact up to degree 2n − 3 (Hairer, Nørsett & Wanner, Solving ODEs I, II.7: Lobatto IIIA).
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@lru_cache(maxsize=16)
def lobatto_nodes(count: int) -> Floats:
    """The Gauss–Lobatto nodes on [−1, 1], ends included; count >= 3."""
    inner = legendre.legroots(legendre.legder(np.eye(count)[count - 1]))
    nodes = np.concatenate([[-1.0], inner, [1.0]])
    nodes.flags.writeable = False
    return nodes


@lru_cache(maxsize=16)
def integration_matrix(count: int) -> Floats:
    """J with (J f)_i = ∫ from −1 to node i of the polynomial through the nodal values f."""
    nodes = lobatto_nodes(count)
    basis = np.eye(count)
    integrals = np.stack(
        [legendre.legval(nodes, legendre.legint(b, lbnd=-1.0)) for b in basis], axis=1
    )
    matrix = np.asarray(integrals @ np.linalg.inv(legendre.legvander(nodes, count - 1)))
    matrix.flags.writeable = False
    return matrix


def lagrange_basis(count: int, local: Floats) -> Floats:
    """Values of the n Lagrange polynomials of the nodes at ``local`` in [−1, 1]: (..., n)."""
    inverse = np.linalg.inv(legendre.legvander(lobatto_nodes(count), count - 1))
    return np.asarray(legendre.legvander(local, count - 1) @ inverse)


def running_integral(values: Floats, half_lengths: Floats) -> Floats:
    """∫ from the first panel's start to every node of ``values`` (..., P, n).

    ``half_lengths`` (..., P) are half the lengths of the panels, which follow each other.
    """
    inside = half_lengths[..., None] * (values @ integration_matrix(values.shape[-1]).T)
    ends = np.cumsum(inside[..., -1], axis=-1)
    return np.asarray(inside + (ends - inside[..., -1])[..., None])
