"""What a design run hands on: checks, parts, curves and the numbers behind them.

Every kind fills the same types, so reports, drawings and files never ask which kind they show.
All numbers are SI; ``unit`` strings are SI too (``m``, ``rad``, ``N*m``, ``Pa``, ``1``) and are
turned into what people read (mm, deg, MPa) only by ``springcad.report``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Profile

Status = Literal["pass", "warn", "fail"]
Scalar = float | int | str | bool | None
Value = Scalar | NDArray[np.float64] | list["Value"] | Mapping[str, "Value"]
Progress = Callable[[str], None]


@dataclass(frozen=True)
class Check:
    """One claim about the design: ``value`` against ``limit``, and what to change if it fails.

    ``sense`` says on which side of the limit the value must lie. ``source`` names the model, the
    equation or the rule that gave the value and the limit.
    """

    name: str
    value: float
    limit: float
    unit: str
    sense: Literal["<=", ">="]
    status: Status
    source: str
    remedy: str = ""


def check(
    name: str,
    value: float,
    sense: Literal["<=", ">="],
    limit: float,
    unit: str,
    *,
    source: str,
    remedy: str = "",
    otherwise: Literal["warn", "fail"] = "fail",
) -> Check:
    """Compare ``value`` with ``limit``; ``otherwise`` is the status when the claim does not hold.

    A value that is not a number never passes.
    """
    holds = value <= limit if sense == "<=" else value >= limit
    status: Status = "pass" if holds else otherwise
    return Check(name, value, limit, unit, sense, status, source, "" if holds else remedy)


@dataclass(frozen=True)
class Outcome:
    """One line of the results table: what came out, and the target it answers (if there is one)."""

    label: str
    value: float
    unit: str
    target: float | None = None
    note: str = ""


@dataclass(frozen=True)
class Part:
    """A part to be cut. The file is ``NAME.dxf`` for an empty ``suffix``, else ``NAME-suffix.dxf``.

    ``role`` says what it is in plain words (``flexure ring``, ``camshaft``).
    """

    suffix: str
    role: str
    profile: Profile
    thickness: float
    material: str


@dataclass(frozen=True)
class Dimension:
    """A dimension of the drawing: ``kind`` radius/diameter about ``start``, or start-to-end length.

    Points are in metres in the part's own frame; ``suffix`` names the part.
    """

    suffix: str
    label: str
    kind: Literal["radius", "diameter", "linear"]
    start: tuple[float, float]
    end: tuple[float, float]


@dataclass(frozen=True)
class Series:
    """One curve of a plot."""

    label: str
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    dashed: bool = False


@dataclass(frozen=True)
class Plot:
    """A plot for the report; units are SI and are converted when drawn."""

    title: str
    x_label: str
    x_unit: str
    y_label: str
    y_unit: str
    series: tuple[Series, ...]
    limit: float | None = None


@dataclass(frozen=True)
class Result:
    """A finished design: everything that the files and the reports show, before any is written.

    Attributes:
        kind, name: as in the spec.
        spec: the spec as the user typed it.
        design: what was decided; with the spec it rebuilds everything else without solving again.
        response: scalars and arrays over the stroke; keys end with their unit (``angle_rad``).
        checks: every claim that was tested.
        outcomes: the results table, targets beside them.
        parts: what is to be cut.
        dimensions, plots: for the drawing and the report.
        assumptions: what was taken for granted and what was not checked, in full sentences.
        advice: findings that may lead to a better design, with their numbers.
        provenance: seed, counts, library versions; no clock and no path.
    """

    kind: str
    name: str
    spec: Mapping[str, Value]
    design: Mapping[str, Value]
    response: Mapping[str, Value]
    checks: tuple[Check, ...]
    outcomes: tuple[Outcome, ...]
    parts: tuple[Part, ...]
    dimensions: tuple[Dimension, ...] = ()
    plots: tuple[Plot, ...] = ()
    assumptions: tuple[str, ...] = ()
    advice: tuple[str, ...] = ()
    verification: Mapping[str, Value] = field(default_factory=dict)
    provenance: Mapping[str, Value] = field(default_factory=dict)
