"""Linear constraints between displacements, solved for some of them.

Every equation gives one displacement component (the slave) from others and a constant:
u_s = Σ f_m u_m + c. Supports, prescribed motions, cyclic symmetry and any other linear
multi-point constraint have that form. Component 2 i + j is displacement j of node i.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import sparse

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Equations:
    """C equations; their terms as triplets (equation, master component, factor), each (M,)."""

    slaves: Indices
    constants: Floats
    rows: Indices
    masters: Indices
    factors: Floats


@dataclass(frozen=True)
class Constraints:
    """Displacements from free unknowns q and prescribed values c: u = T q + A c.

    Attributes:
        transform: T (2 N, m).
        free: the components that are free unknowns themselves (m,).
        lift: A (2 N, 2 N); c is zero except at slaves.
        constants: the c of the equations (2 N,) [m].
        equations: what all this was made from.
    """

    transform: sparse.csr_array[np.float64]
    free: Indices
    lift: sparse.csr_array[np.float64]
    constants: Floats
    equations: Equations


def prescribe(
    nodes: ArrayLike, displacement: ArrayLike = 0.0, components: tuple[int, ...] = (0, 1)
) -> Equations:
    """Displacement components of nodes given: ``displacement`` broadcasts to (K, components)."""
    numbers = 2 * np.atleast_1d(np.asarray(nodes, dtype=np.intp))[:, None] + np.array(components)
    values = np.broadcast_to(np.asarray(displacement, dtype=np.float64), numbers.shape)
    none = np.empty(0, dtype=np.intp)
    return Equations(numbers.ravel(), values.ravel().copy(), none, none, np.empty(0))


def tie(slaves: ArrayLike, masters: ArrayLike, angle: float = 0.0) -> Equations:
    """u_slave = R(angle) u_master for pairs of nodes: equal nodes, or cyclic symmetry."""
    slave = 2 * np.atleast_1d(np.asarray(slaves, dtype=np.intp))[:, None] + np.arange(2)
    master = 2 * np.atleast_1d(np.asarray(masters, dtype=np.intp))[:, None] + np.arange(2)
    if slave.shape != master.shape:
        raise ValueError("a tie needs as many slave nodes as master nodes")
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    rows = np.repeat(np.arange(slave.size), 2)
    factors = np.tile(turn.ravel(), len(slave))
    keep = factors != 0.0
    return Equations(
        slave.ravel(),
        np.zeros(slave.size),
        rows[keep],
        np.repeat(master, 2, axis=0).ravel()[keep],
        factors[keep],
    )


def combine(*parts: Equations) -> Equations:
    """All equations as one."""
    first = np.cumsum([0, *(len(part.slaves) for part in parts)])
    return Equations(
        np.concatenate([part.slaves for part in parts]),
        np.concatenate([part.constants for part in parts]),
        np.concatenate([part.rows + k for part, k in zip(parts, first, strict=False)]),
        np.concatenate([part.masters for part in parts]),
        np.concatenate([part.factors for part in parts]),
    )


def solve_constraints(unknowns: int, *parts: Equations) -> Constraints:
    """Eliminate the slaves of all equations among ``unknowns`` = 2 N components.

    A master may itself be a slave of another equation (the corner of a tied side that is also
    supported), as long as the chain ends.

    Raises:
        ValueError: a component is the slave of two equations, or equations form a circle.
    """
    equations = combine(*parts)
    slaves = equations.slaves
    numbers, times = np.unique(slaves, return_counts=True)
    if np.any(times > 1):
        node, component = divmod(int(numbers[np.argmax(times)]), 2)
        raise ValueError(f"component {component} of node {node} is constrained twice")
    free = np.setdiff1d(np.arange(unknowns), slaves)
    rows = np.concatenate([slaves[equations.rows], free])
    columns = np.concatenate([equations.masters, free])
    factors = np.concatenate([equations.factors, np.ones(len(free))])
    step = sparse.csr_array((factors, (rows, columns)), shape=(unknowns, unknowns))
    constants = np.zeros(unknowns)
    constants[slaves] = equations.constants

    # u = step u + c, put into itself until only free components remain on the right.
    is_slave = np.zeros(unknowns, dtype=bool)
    is_slave[slaves] = True
    chain, lift = step, sparse.eye_array(unknowns, format="csr")
    for _ in range(len(slaves) + 1):
        if not np.any(is_slave[chain.indices]):
            break
        lift = lift + _columns(chain, is_slave)
        chain = step @ chain
        chain.eliminate_zeros()
    else:
        raise ValueError("the constraints form a circle")
    return Constraints(sparse.csr_array(chain[:, free]), free, lift, constants, equations)


def _columns(
    matrix: sparse.csr_array[np.float64], mask: NDArray[np.bool_]
) -> sparse.csr_array[np.float64]:
    """The matrix with the columns outside ``mask`` set to zero."""
    return sparse.csr_array(matrix @ sparse.diags_array(mask.astype(np.float64)))
