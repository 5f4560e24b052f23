"""The mesh that all finite-element modules share: 8-node quadrilaterals with named sets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True)
class Mesh:
    """Plane mesh of serendipity quadrilaterals.

    Attributes:
        nodes: positions (N, 2) [m].
        elements: node numbers (E, 8): the corners 1-2-3-4 counter-clockwise, then the mid-side
            nodes 5 (of 1-2), 6 (of 2-3), 7 (of 3-4), 8 (of 4-1): the order of CPS8.
        node_sets: node numbers by name.
        edge_sets: quadratic edges (K, 3) by name: (start, middle, end), one after the other along
            the boundary with the material on the left.
    """

    nodes: Floats
    elements: Indices
    node_sets: Mapping[str, Indices] = field(default_factory=dict)
    edge_sets: Mapping[str, Indices] = field(default_factory=dict)

    @property
    def unknowns(self) -> int:
        """Number of displacement components, 2 N; unknown 2 i + j is component j of node i."""
        return 2 * len(self.nodes)
