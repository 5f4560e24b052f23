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

from springcad.geometry.biarc import DEFAULT_TOLERANCE
from springcad.geometry.outline import Contour, Profile

Status = Literal["pass", "warn", "fail"]
Scalar = float | int | str | bool | None
Value = Scalar | NDArray[np.float64] | list["Value"] | Mapping[str, "Value"]
Scale = Literal["linear", "log"]
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
class Dimension:
    """A dimension of a drawing: ``kind`` radius/diameter about ``start``, or start-to-end length.

    Points are in metres in the frame of what it is drawn on.
    """

    label: str
    kind: Literal["radius", "diameter", "linear"]
    start: tuple[float, float]
    end: tuple[float, float]


@dataclass(frozen=True)
class Part:
    """A part to be cut. The file is ``NAME.dxf`` for an empty ``suffix``, else ``NAME-suffix.dxf``.

    ``role`` says what it is in plain words (``flexure ring``, ``camshaft``); the arcs of its
    drawing follow curves of the profile within ``tolerance``; ``dimensions`` are drawn on it;
    ``count`` are cut.
    """

    suffix: str
    role: str
    profile: Profile
    thickness: float
    material: str
    tolerance: float = DEFAULT_TOLERANCE
    dimensions: tuple[Dimension, ...] = ()
    count: int = 1

    @property
    def caption(self) -> str:
        """The role, and how many of it to cut where one will not do."""
        return self.role if self.count == 1 else f"{self.role} (cut {self.count} of it)"


@dataclass(frozen=True)
class Shape:
    """Something in a view: a contour, a profile with its holes, or an open path (N, 2) [m].

    ``role``: a part to be cut, a mate that touches it, a part or mate where it has moved to, a
    limit that must not be crossed, or an axis.
    """

    line: Contour | Profile | NDArray[np.float64]
    role: Literal["part", "mate", "moved", "limit", "axis"]


@dataclass(frozen=True)
class View:
    """Parts among their mates, at true size in a frame of its own; shown, never cut."""

    title: str
    shapes: tuple[Shape, ...]
    dimensions: tuple[Dimension, ...] = ()


@dataclass(frozen=True)
class Series:
    """One curve of a plot."""

    label: str
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    dashed: bool = False


@dataclass(frozen=True)
class Plot:
    """A plot for the report; units are SI and are converted when drawn.

    A logarithmic axis leaves out what is not above zero.
    """

    title: str
    x_label: str
    x_unit: str
    y_label: str
    y_unit: str
    series: tuple[Series, ...]
    limit: float | None = None
    y_scale: Scale = "linear"


@dataclass(frozen=True)
class Comparison:
    """One quantity at K places, by the design's model and by another that shares nothing with it.

    Attributes:
        name, unit: of the quantity.
        place, place_unit: what tells the places apart, as an angle.
        places, designed, judged: (K,).
        tolerance: largest difference that counts as agreement; a share of the designed value if
            ``relative``, else in ``unit``.
        source: how the two sides are known.
    """

    name: str
    unit: str
    place: str
    place_unit: str
    places: NDArray[np.float64]
    designed: NDArray[np.float64]
    judged: NDArray[np.float64]
    tolerance: float
    relative: bool
    source: str

    @property
    def differences(self) -> NDArray[np.float64]:
        """Judged less designed (K,), in the measure of the tolerance."""
        scale = np.abs(self.designed) if self.relative else 1.0
        return np.asarray((self.judged - self.designed) / scale)

    @property
    def worst(self) -> int:
        """Index of the largest difference; of one that is not a number before all others."""
        size = np.abs(self.differences)
        return int(np.argmax(np.where(np.isnan(size), np.inf, size)))


@dataclass(frozen=True)
class Judgement:
    """A second opinion on a finished design.

    Attributes:
        method: the model, in a few words for a heading.
        comparisons: what was compared.
        checks: claims of the judge's own, as that it got through the whole stroke.
        assumptions: what it takes for granted, in full sentences.
        figures: size of the model and the like.
    """

    method: str
    comparisons: tuple[Comparison, ...]
    checks: tuple[Check, ...]
    assumptions: tuple[str, ...]
    figures: Mapping[str, Value]


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
        views: of the parts among their mates.
        plots: for the report.
        assumptions: what was taken for granted and what was not checked, in full sentences.
        advice: findings that may lead to a better design, with their numbers.
        judgement: the second opinion; None if nobody asked for one.
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
    views: tuple[View, ...] = ()
    plots: tuple[Plot, ...] = ()
    assumptions: tuple[str, ...] = ()
    advice: tuple[str, ...] = ()
    judgement: Judgement | None = None
    provenance: Mapping[str, Value] = field(default_factory=dict)
