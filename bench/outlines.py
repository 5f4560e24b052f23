"""One ruler for all methods: gap, validity and fold-over of the finished outline (shapely)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely import LinearRing, Polygon
from shapely.affinity import rotate

from springcad.kinds.rotary_flexure.problem import FlexureProblem

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Ruled:
    """What the drawn outline shows: gap to the neighbour (m), validity, largest lambda |kappa|."""

    gap: float
    valid: bool
    largest_bend: float

    @property
    def sound(self) -> bool:
        """A valid outline without fold-over that does not touch its neighbour."""
        return self.valid and self.largest_bend < 1.0 and self.gap > 0.0


def ruled(
    flexure: FlexureProblem,
    x: Floats,
    y: Floats,
    angle: Floats,
    curvature: Floats,
    half_thickness: Floats,
) -> Ruled:
    """Measure a centre line (N,) from the root on; what lies on the tip's pad is left out.

    The straight pad is the same for all methods: its end alone would put 1.17 mm (S2, S3) and
    0.63 mm (S4) above every gap, whatever the shape.
    """
    kept = x <= flexure.span - flexure.pad_length + 1e-9
    x, y, angle, half = x[kept], y[kept], angle[kept], half_thickness[kept]
    normal = half * np.vstack((-np.sin(angle), np.cos(angle)))
    left, right = (np.vstack((x, y)) + normal).T, (np.vstack((x, y)) - normal).T
    outline = np.vstack((left, right[::-1]))
    ring = LinearRing(outline)
    neighbour = rotate(ring, flexure.pitch, origin=(flexure.root_radius, 0.0), use_radians=True)
    return Ruled(
        gap=float(ring.distance(neighbour)),
        valid=bool(Polygon(outline).is_valid),
        largest_bend=float(np.max(half * np.abs(curvature[kept]))),
    )
