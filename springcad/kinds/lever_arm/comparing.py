"""What the second opinions on straight and on omega leaves compare alike."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.judging import OUTLINE_TOLERANCE, distance_from, drawn_outline, snapped
from springcad.result import Check, Comparison, check
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

FORCE_TOLERANCE = 0.02
STRESS_TOLERANCE = 0.05


def compared_forces(
    written: WrittenDesign, deflections: Sequence[float], forces: Sequence[float]
) -> Comparison:
    """Forces (D,) [N] that the elements find for one leaf, against those of the report."""
    places = np.array(deflections)
    reported = np.interp(
        places, written.array("response.deflection_m"), written.array("response.force_N")
    )
    return Comparison(
        name="force of the spring",
        unit="N",
        place="deflection",
        place_unit="m",
        places=places,
        designed=all_snapped(reported),
        judged=all_snapped(written.number("design.count") * np.array(forces)),
        tolerance=FORCE_TOLERANCE,
        relative=True,
        source="nonlinear beam; finite elements",
    )


def lies_on_drawing(written: WrittenDesign, points: Floats) -> Check:
    """That points (N, 2) [m] of the leaf which is judged are on the contour that is drawn."""
    return check(
        "second opinion: its leaf against the drawing",
        snapped(distance_from(drawn_outline(written, "leaf"), points)),
        "<=",
        OUTLINE_TOLERANCE,
        "m",
        source="largest distance of the model's side from the contour of the drawing",
        remedy="the drawing is not of the leaf in the report: design it again",
    )


def all_snapped(values: Floats) -> Floats:
    """``snapped`` for arrays (N,)."""
    return np.array([snapped(float(value)) for value in values])
