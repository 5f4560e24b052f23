"""Vectors in the plane."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def rotated(vectors: Floats, angles: Floats) -> Floats:
    """Vectors (..., 2) turned counter-clockwise by ``angles`` (...), broadcast."""
    cos, sin = np.cos(angles), np.sin(angles)
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([cos * x - sin * y, sin * x + cos * y], axis=-1)
