"""The sections of a roller cam's spec. Symbols: see ``spec``; all values are SI."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from springcad.spec.common import Length, Quantity, TorsionalStiffness, angle, default
from springcad.spec.csv_columns import Column
from springcad.spec.lists import Bounds, Coefficients
from springcad.spec.points import CurvePoints, Point, Points
from springcad.spec.rules import Section
from springcad.spec.units import ANGLE, LENGTH, LINEAR_STIFFNESS, STIFFNESS, TORQUE, show

DEFLECTION = ("0.01 deg", "30 deg")
"""Range of the deflection; the roller leaves the plane of the profile by R (1 - cos β)."""

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
LengthBounds: TypeAlias = Annotated[
    tuple[float, float], Bounds(Quantity(LENGTH, "0.01 mm", "10 m"))
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


class Target(Section):
    """What the joint is to do, in both directions alike."""

    law: Law
    """Torque over the angle from the end of the dead zone."""
    per: Literal["group", "joint"] = "joint"
    """Whose torque the law is: that of one group, or that of all groups together."""
    deflection: Annotated[float, angle(*DEFLECTION)]
    """Largest deflection in normal use, one way from rest, dead zone included, in deg."""
    dead_zone: Annotated[float, angle("0 deg", "30 deg")] = default("0 deg")
    """Angle from rest up to which there is no torque, in deg; the law begins at its end."""


class Drum(Section):
    """The turning drum and the roller on it."""

    drum_radius: Length
    """Radius of the circle on which the roller's centre moves, in mm."""
    roller_radius: Length
    """Radius of the roller, in mm."""
    roller_offset: Length
    """Height of the roller's centre at rest over the axis of the cantilever, in mm."""


class Envelope(Section):
    """The space that the element may take."""

    thickness: LengthBounds
    """Thickness of the sheet (width of the cantilever) in mm, or bounds [low, high] for sizing."""


class CantileverSpec(Section):
    """The elastic part: given, or sized between bounds."""

    length: LengthBounds
    """From the mount to the contact part in mm, or bounds [low, high] for sizing."""
    height: LengthBounds
    """In the plane of bending, in mm, or bounds [low, high] for sizing."""
    objective: Literal["max_stiffness", "min_volume", "min_stress", "target_stiffness"] | None = (
        None
    )
    """What sizing between the bounds is for; target_stiffness: given stiffness, least volume."""
    stiffness: Annotated[float, Quantity(LINEAR_STIFFNESS, "0.1 N/m", "1000000 N/mm")] | None = None
    """Stiffness of the tip in bending, in N/mm, to be met by target_stiffness or min_stress."""
    root_fillet: Length = default("1 mm")
    """Radius between mount and cantilever, in mm."""


class ContactPart(Section):
    """What carries the profile at the tip of the cantilever."""

    thickness: Length = default("3 mm")
    """Material behind the upper end of the profile, along the cantilever, in mm."""


class Mount(Section):
    """The block by which the element is held."""

    length: Length = default("10 mm")
    """Along the cantilever, in mm."""
    height: Length = default("15 mm")
    """Across the cantilever, in mm; at most twice joint.roller_offset."""
    holes: Annotated[int, Field(ge=0, le=20)] = 2
    """Number of holes in a row across the cantilever."""
    hole_diameter: Length = default("4 mm")
    """Diameter of the holes, in mm."""
    held: Literal["plates", "pocket"] = "plates"
    """Between plates up to its face, which turns nowhere; or by its sides and back, in a pocket."""


class Stepwise(Section):
    """The iteration of paper 001."""

    steps: Annotated[int, Field(ge=5, le=5000)] = 190
    """Number of equal steps of the angle."""
    form: Literal["printed", "sound"] = "sound"
    """As printed (eight unknowns, backward difference), or one unknown and the trapezoid rule."""
