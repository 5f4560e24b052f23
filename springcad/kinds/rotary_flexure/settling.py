"""When the passes of a sizing have come as near to their aim as they will."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

CLOSE = 0.0004
"""The sizing stops within this share of its aim, so within 0.1 % of the wanted stiffness,"""
EVEN = 0.004
"""and within this share of the allowed stress, or as near as it comes: where the inner fibres
count, the thickness cannot follow every change of side of a bend, and a pad that the contact runs
along is stressed unevenly. The checks judge what is left."""
PATIENCE = 3
"""So many passes in turn may come no nearer, in neither share; more would be lost."""
NEARER = 0.95
"""Over the distance before, what counts as nearer."""


@dataclass
class Settling:
    """The nearest that stiffness and stress have come to their aims, and the passes lost since."""

    nearest: Floats = field(default_factory=lambda: np.full(2, math.inf))
    lost: int = 0

    def ended(self, off: float, evenness: float, *, shaping: bool) -> bool:
        """Whether another pass would be lost; while the shape is optimised, none is.

        Args:
            off: of the stiffness from its aim, as a share.
            evenness: largest deviation of the stress from the allowed one, as a share.
        """
        away = np.maximum([off, evenness], [CLOSE, EVEN])
        nearer = bool((away < NEARER * self.nearest).any())
        self.lost = 0 if shaping or nearer else self.lost + 1
        self.nearest = np.minimum(self.nearest, away)
        return self.lost == PATIENCE
