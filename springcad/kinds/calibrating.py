"""What a bench test of a written design has told, the same for every kind with calibration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Stiffness = Literal["modulus", "root", "both"]
"""What a measured stiffness is put down to."""


def calibration_file(design: str) -> str:
    """Name of the file that holds the calibration of a design."""
    return f"{design}-calibration.yaml"


@dataclass(frozen=True)
class Estimate:
    """One number that the model of the bench has, SI.

    Attributes:
        name: in plain words.
        value: fitted, or held.
        unit: of value and errors.
        designed: what the design has.
        standard_error: of a fitted value, from the scatter of the points.
        model_error: largest change of a fitted value that an error of the model can make.
        held: why the value was not fitted; empty if it was.
        doubt: why a fitted value is not passed on to the next design; empty if it is sure enough.
    """

    name: str
    value: float
    unit: str
    designed: float
    standard_error: float = 0.0
    model_error: float = 0.0
    held: str = ""
    doubt: str = ""


@dataclass(frozen=True)
class Calibration:
    """What was found, and the text of the file that ``design`` takes.

    Attributes:
        design, kind: that was measured.
        estimates: all numbers of the model of the bench.
        points, used: of the file; of these in the fit.
        scatter: root mean square of what the fit leaves, over the torque at the design deflection.
        designed_scatter: the same with the numbers of the design.
        notes: what must be known to use it.
        text: of the calibration file.
    """

    design: str
    kind: str
    estimates: tuple[Estimate, ...]
    points: int
    used: int
    scatter: float
    designed_scatter: float
    notes: tuple[str, ...]
    text: str
