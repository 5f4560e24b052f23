"""The sections of a roller cam's spec. Symbols: see ``spec``; all values are SI."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from springcad.kinds.law_spec import Law
from springcad.spec.common import Length, Quantity, angle, default
from springcad.spec.lists import Bounds
from springcad.spec.rules import Section
from springcad.spec.units import LENGTH, LINEAR_STIFFNESS

DEFLECTION = ("0.01 deg", "30 deg")
"""Range of the deflection; the roller leaves the plane of the profile by R (1 - cos β)."""

LengthBounds: TypeAlias = Annotated[
    tuple[float, float], Bounds(Quantity(LENGTH, "0.01 mm", "10 m"))
]


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
