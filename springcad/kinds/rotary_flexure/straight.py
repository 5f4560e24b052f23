"""Straight flexures that would do instead of serpentine ones, with another count or contact radius.

A bend raises the inner-fibre stress; a straight flexure does not. At the same tooth width the
straight deflection grows with the flexure's length, so a smaller contact radius is the strongest
knob, until the camshaft's torsion or the process stops it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.law import (
    required_area,
    straight_area,
    straight_thickness_factor,
    tapered_half_thickness,
    tip_force,
)
from springcad.kinds.rotary_flexure.room import hub_shear_stress, neighbour_gap, tooth_width

Floats = NDArray[np.float64]

RADII = 1000
"""The contact radii tried are multiples of a power of ten, at most so many up to the root."""
COUNTS = (3, 400)
"""Fewest and most flexures tried."""


@dataclass(frozen=True)
class StraightAlternative:
    """A ring of straight flexures of the same stiffness, deflection and root radius; SI.

    Attributes:
        count, contact_radius: what is changed.
        force: on one tip at the full deflection.
        root_half_thickness: of the flexure.
        stress: on both edges at the full deflection.
        tooth_width: left for a cam tooth.
        gap: pinch between neighbours, unloaded.
        hub_shear: torsional shear of the camshaft's core.
    """

    count: int
    contact_radius: float
    force: float
    root_half_thickness: float
    stress: float
    tooth_width: float
    gap: float
    hub_shear: float

    def __str__(self) -> str:
        return (
            f"straight flexures would do with flexures.style straight, flexures.count "
            f"{self.count} and envelope.contact_radius {self.contact_radius * 1e3:.4g} mm: "
            f"stress {self.stress / 1e6:.0f} MPa on both edges without a bend, "
            f"tip force {self.force:.0f} N, cam tooth {self.tooth_width * 1e3:.2f} mm, "
            f"gap {self.gap * 1e3:.2f} mm, camshaft torsion {self.hub_shear / 1e6:.0f} MPa"
        )


def straight_alternatives(case: Case) -> tuple[StraightAlternative, ...]:
    """The straight ring nearest to the case, and the one with the largest smallest margin.

    Searched over every count and a grid of contact radii, 0.1 mm for a root radius of 26 mm.
    Margins are the ratios to the design stress, the thinnest web and tooth, the smallest gap and
    the torsion limit of the camshaft (yield and design stress over sqrt(3)). Empty when no straight
    ring will do; one if both are the same.
    """
    radius, count = _grid(case)
    if not radius.size or not count.size:
        return ()
    tried = _Rings.of(case, radius, count)
    margin = tried.margin(case)
    if not (margin >= 1.0).any():
        return ()
    away = np.hypot(np.log(count / case.inputs.count), np.log(radius / case.inputs.contact_radius))
    nearest = int(np.argmin(np.where(margin >= 1.0, away, np.inf)))
    safest = int(np.argmax(margin))
    chosen = [nearest] if nearest == safest else [nearest, safest]
    return tuple(tried.pick(index) for index in chosen)


def _grid(case: Case) -> tuple[Floats, Floats]:
    """Contact radii (columns) and counts (rows) that leave a hub and a tooth at all."""
    inputs, tip = case.inputs, case.inputs.tip_half_thickness
    step = 10.0 ** math.ceil(math.log10(inputs.root_radius / RADII))
    lowest = math.floor((case.camshaft_bore_radius + tip) / step) + 1
    radius = step * np.arange(lowest, math.ceil(inputs.root_radius / step), dtype=np.float64)
    fewest, most = COUNTS
    room = int(2.0 * math.pi * inputs.root_radius / (2.0 * tip + case.min_web))
    count = np.arange(fewest, min(most, room) + 1, dtype=np.float64)[:, None]
    return radius, count


@dataclass(frozen=True)
class _Rings:
    """Straight rings over the grid, each array of the same shape."""

    count: Floats
    contact_radius: Floats
    force: Floats
    root_half_thickness: Floats
    stress: Floats
    tooth_width: Floats
    gap: Floats
    hub_shear: Floats

    @classmethod
    def of(cls, case: Case, radius: Floats, count: Floats) -> _Rings:
        inputs, tip = case.inputs, case.inputs.tip_half_thickness
        k, theta, t = inputs.stiffness, inputs.deflection, inputs.thickness
        limit, modulus = inputs.design_stress, inputs.elastic_modulus
        span = inputs.root_radius - radius
        force = tip_force(k, theta, radius, count)
        law = tapered_half_thickness(force, span, t, limit)
        factor = required_area(k, theta, count, t, limit, modulus) / straight_area(span, law)
        thickness_factor = straight_thickness_factor(factor, tip / law)
        thick = thickness_factor * law
        columns = (
            count,
            radius,
            force,
            thick,
            limit / thickness_factor**2,
            tooth_width(radius, count, tip),
            neighbour_gap(span, radius, count, thick, tip),
            hub_shear_stress(
                case.stack.parallel * k * theta, radius - tip, case.camshaft_bore_radius
            ),
        )
        return cls(*np.broadcast_arrays(*columns))

    def margin(self, case: Case) -> Floats:
        """Smallest ratio of what is there to what is needed; 0 where there is no such flexure."""
        inputs = case.inputs
        core = self.contact_radius - inputs.tip_half_thickness - case.camshaft_bore_radius
        ratios = (
            inputs.design_stress / self.stress,
            self.tooth_width / max(case.min_tooth, case.min_web),
            self.gap / case.min_gap,
            core / case.min_web,
            min(case.yield_strength, inputs.design_stress) / math.sqrt(3.0) / self.hub_shear,
        )
        smallest: Floats = np.nan_to_num(np.minimum.reduce(ratios), nan=0.0)
        return smallest

    def pick(self, index: int) -> StraightAlternative:
        values = {
            field.name: float(getattr(self, field.name).flat[index]) for field in fields(self)
        }
        return StraightAlternative(**{**values, "count": int(values["count"])})  # type: ignore[arg-type]
