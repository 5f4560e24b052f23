"""Torque laws in a spec, for every kind that can follow one; all values SI."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from springcad.spec.common import Quantity, TorsionalStiffness, angle
from springcad.spec.csv_columns import Column
from springcad.spec.lists import Coefficients
from springcad.spec.points import CurvePoints, Point, Points
from springcad.spec.rules import Section, rule
from springcad.spec.units import ANGLE, STIFFNESS, TORQUE, show

MOST_DECADES = 12
LEAST_STEP = 1e-7
"""Between the angles of two points, rad."""


def _torque_fault(before: Point | None, point: Point) -> str | None:
    torque = point[1]
    if before is None:
        if torque == 0.0:
            return None
        return f"torque at 0 is {show(torque, TORQUE)}; must be 0: a mirrored pair has no preload"
    if torque == 0.0:
        return f"no torque up to {show(point[0], ANGLE)}: give that as target.dead_zone instead"
    if torque < before[1]:
        return f"torque falls; it must not be less than the {show(before[1], TORQUE)} before it"
    return None


def _stiffness_fault(_: Point | None, point: Point) -> str | None:
    return None if point[1] >= 0.0 else "stiffness must not be negative"


_ANGLE = Column("angle", Quantity(ANGLE, "0 deg", "60 deg"))
_TORQUE = Column("torque", Quantity(TORQUE, "0 N*m", "1000000 N*m"))
_STIFFNESS = Column("stiffness", Quantity(STIFFNESS, "0 N*m/rad", "1000000000 N*m/rad"))

TorquePoints: TypeAlias = Annotated[Points, CurvePoints(_ANGLE, _TORQUE, LEAST_STEP, _torque_fault)]
StiffnessPoints: TypeAlias = Annotated[
    Points, CurvePoints(_ANGLE, _STIFFNESS, LEAST_STEP, _stiffness_fault)
]


class Exponential(Section):
    """Torque scale (10^(angle/decade) - 1), the law of paper 001."""

    scale: Annotated[float, Quantity(TORQUE, "0.000000001 N*m", "1000000 N*m")]
    """Factor of the law, in N*m: what the torque and it together have grown from."""
    decade: Annotated[float, angle("0.001 deg", "1000 deg")]
    """Angle in which torque plus scale grows tenfold, in deg."""


class Stiffness(Section):
    """Stiffness against angle, integrated to the torque: one of table and polynomial."""

    table: StiffnessPoints | None = None
    """CSV file (angle, stiffness) beside the spec, or pairs [angle, stiffness]."""
    polynomial: Annotated[tuple[float, ...], Coefficients(1)] | None = None
    """Coefficients of 1, angle, angle^2, ...: N*m/rad, N*m/rad^2, ... or per deg, deg^2, ..."""


class Law(Section):
    """Torque over the angle from the end of the dead zone: exactly one of these."""

    exponential: Exponential | None = None
    """Torque scale (10^(angle/decade) - 1), the law of paper 001."""
    linear: TorsionalStiffness | None = None
    """A constant stiffness, in N*m/rad or N*m/deg."""
    polynomial: Annotated[tuple[float, ...], Coefficients(1)] | None = None
    """Coefficients of angle, angle^2, ...: N*m/rad, N*m/rad^2, ... or per deg, deg^2, ..."""
    table: TorquePoints | None = None
    """CSV file (angle, torque) beside the spec, or pairs [angle, torque]; from 0, never falling."""
    stiffness: Stiffness | None = None
    """Stiffness against angle, integrated to the torque."""


@rule("target.law")
def _one_law(law: Law | None) -> str | None:
    return None if law is None else _exactly_one(law)


@rule("target.law.stiffness")
def _one_stiffness(stiffness: Stiffness | None) -> str | None:
    return None if stiffness is None else _exactly_one(stiffness)


def _exactly_one(section: Section) -> str | None:
    known = list(type(section).model_fields)
    given = [name for name in known if getattr(section, name) is not None]
    if len(given) == 1:
        return None
    return f"give one of {', '.join(known)}; {' and '.join(given) or 'none'} given"


@rule("target.law.exponential.decade", "target.deflection")
def _decades(decade: float, deflection: float | str) -> str | None:
    if isinstance(deflection, str) or deflection <= MOST_DECADES * decade:
        return None
    return f"the torque grows by more than {MOST_DECADES} decades up to {show(deflection, ANGLE)}"


LAW_RULES = (_one_law, _one_stiffness, _decades)
"""Rules on ``target.law`` and ``target.deflection``."""


def reaches(points: Points | None, stroke: float) -> str | None:
    """What is wrong with a table that ends before the stroke does."""
    if points is None or points[-1][0] >= stroke * (1.0 - 1e-9):
        return None
    ends, wanted = show(points[-1][0], ANGLE), show(stroke, ANGLE)
    return f"ends at {ends}, but must reach the deflection less the dead zone, {wanted}"
