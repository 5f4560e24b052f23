"""How far unit forces move a held solid, each at the place of every other: small displacements."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import deformation, stiffness_blocks, stress
from springcad.mechanics.fem.band import solve
from springcad.mechanics.fem.model import Model

Floats = NDArray[np.float64]


def compliance(model: Model, forces: Floats) -> Floats:
    """Work (C, C) of nodal forces (2 N, C) on each other's small displacements.

    With forces of 1 N it is their compliance matrix [m/N].

    Raises:
        ArithmeticError: the solid is not held.
    """
    solid = model.solid
    rest = deformation(solid, np.zeros(solid.mesh.unknowns))
    blocks = stiffness_blocks(solid, rest, stress(solid.sheet, rest.strain))
    right = np.asarray(model.constraints.transform.T @ forces)
    moved = solve(model.pattern, [(model.element_scatter, blocks)], right)
    return np.asarray(right.T @ moved)
