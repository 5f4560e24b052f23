"""The sections of the spec of a rotary flexure spring that are its own; all values SI."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from springcad.kinds.law_spec import Law
from springcad.spec.common import (
    AutoLength,
    Count,
    Length,
    LengthOrZero,
    Quantity,
    Stress,
    TorsionalStiffness,
    angle,
    default,
)
from springcad.spec.rules import Section
from springcad.spec.units import ANGLE


class Target(Section):
    """What the spring is to do."""

    stiffness: TorsionalStiffness | None = None
    """Constant torsional stiffness of the whole joint, in N*m/rad or N*m/deg; or a law."""
    law: Law | None = None
    """Torque of the whole joint over the angle, in place of a constant stiffness."""
    deflection: Annotated[
        float | Literal["max"], Quantity(ANGLE, "0.01 deg", "60 deg", words=("max",))
    ]
    """Largest deflection in normal use, one way from rest, in deg; max: the largest there is."""


class Envelope(Section):
    """The space that the spring may take."""

    outer_radius: AutoLength
    """Outer radius of the rim, in mm; auto: the thinnest rim that bears the flexures by itself."""
    root_radius: AutoLength
    """Radius at which the flexures leave the rim, in mm; auto with objective: diameter."""
    contact_radius: AutoLength
    """Radius at which the flexure tips touch the camshaft at rest, in mm; auto: see objective."""
    thickness: Length | None = None
    """Thickness of the sheet, in mm; with a stack, of the sheets of one spring together."""


class Flexures(Section):
    """The flexures between rim and camshaft."""

    count: Annotated[int | Literal["auto"], Count(3, 400, words=("auto",))]
    """Number of flexures; auto: see objective."""
    style: Literal["auto", "straight", "serpentine"] = "auto"
    """Shape; auto takes straight flexures where they meet the target, else serpentine ones."""
    tip_thickness: Length = default("0.35 mm")
    """Thickness at the tip and the least one anywhere, in mm."""
    bend_limit: Annotated[float, Field(ge=0.05, le=0.6)] = 0.3
    """Largest half thickness times curvature of the centre line, a bare number."""
    max_root_angle: Annotated[float, angle("0 deg", "28.6 deg")] = default("8.6 deg")
    """Largest angle between centre line and radius at the root, in deg; more stiffens the root."""
    root_fillet: AutoLength = default("auto")
    """Fillet radius at the roots, in mm; auto: the largest that fits and does not stiffen."""
    fillet_stress: Stress | None = None
    """Largest stress in the root fillets, in MPa; thicker roots keep it. No limit if not given."""
    min_gap: Length | None = None
    """Least gap between neighbouring flexures at rest, in mm; the process's if not given."""
    min_deformed_gap: Length | None = None
    """The same at every angle of the stroke, in mm; a warning below 0.05 mm if not given."""


class Dowels(Section):
    """Dowel pins half sunk into the outer edge."""

    count: Annotated[int, Field(ge=2, le=100)]
    """Number of dowels, equally spaced."""
    radius: Length
    """Radius of the semicircular cut-outs, in mm."""


class Mounting(Section):
    """How the rim is held: pressed into a bore (no dowels), or by dowels."""

    dowels: Dowels | None
    """Dowel pins half sunk into the outer edge."""


class Camshaft(Section):
    """The toothed shaft inside the flexures."""

    backlash: LengthOrZero = default("0 mm")
    """Tangential play of a tip between two teeth, at the contact radius, in mm."""
    bore_radius: Length | None = None
    """Radius of a hole through the centre, in mm; no hole if not given."""
    friction: Annotated[float, Field(ge=0.0, le=0.6)] = 0.0
    """Coefficient of dry friction between tips and camshaft, for the hysteresis; a bare number."""
    min_tooth: Length | None = None
    """Least width of a tooth between two tips at rest, the pitch less the tip thickness, in mm; the
    process's thinnest web if not given. Towards its tip the drawn tooth is thinner and keeps only
    that web."""


class Optimiser(Section):
    """How the serpentine centre line is searched for."""

    form: Literal["curvature", "control-points"] = "curvature"
    """Unknowns: curvature along the centre line, or the control points of paper 004."""
    starts: Annotated[int, Field(ge=1, le=1000)] = 6
    """Number of starting points."""
    seed: Annotated[int, Field(ge=0, le=2**32 - 1)] = 1
    """Seed of the starting points."""
    coefficients: Annotated[int, Field(ge=8, le=24)] = 13
    """Unknowns of the curvature; more fill a dense ring better and cost time."""
    control_points: Annotated[int, Field(ge=2, le=4)] = 2
    """Number of control points; for form control-points only."""
    weighting: Literal["gap", "sharpness"] = "gap"
    """What the cost weighs more, the gap or the sharpness of bends; for control-points only."""
