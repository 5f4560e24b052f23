"""The behaviour of a part as a function of its deviations, to second order.

In the thickness of the sheet and in the modulus it is exact: forces go with both of them, and with
nothing else does the shape of flexures that a rigid camshaft has bent. In the offset of the edges
and in the radius of the flanks it is the quadratic form through forward analyses (``as_made``) one
step away from the drawing, whose slopes are central differences.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.rotary_flexure.as_made import Behaviour, Deviation, backlash, behaviour
from springcad.kinds.rotary_flexure.spring import Spring

Floats = NDArray[np.float64]

STEP = 1e-5
"""Between the forward analyses, of the offset and of the radius (m)."""


class Figures(NamedTuple):
    """What counts of a part, or of many (S,), SI; ``stress`` is the one that the spec bounds."""

    stiffness_at_rest: Floats
    stiffness: Floats
    stress: Floats
    root_fillet_stress: Floats
    gap: Floats
    backlash: Floats


def figures(spring: Spring, found: Behaviour, deviation: Deviation) -> Figures:
    """The largest stresses and the smallest gap, of one part or of many."""
    return Figures(
        stiffness_at_rest=found.at_rest.max(axis=-1),
        stiffness=found.secant[..., 0],
        stress=found.stress.max(axis=-1),
        root_fillet_stress=found.fillet_stress.max(axis=-1),
        gap=found.gap.min(axis=-1),
        backlash=backlash(spring, deviation),
    )


def figures_as_made(spring: Spring, deviation: Deviation) -> Figures:
    """By the forward analysis; raises as ``behaviour`` does."""
    return figures(spring, behaviour(spring, deviation), deviation)


@dataclass(frozen=True)
class ResponseSurface:
    """Of one spring; ``coefficients`` (6, N) of 1, u, v, u^2/2, v^2/2 and u v for each entry of its
    behaviour, with u and v the offset and the radius in steps.
    """

    spring: Spring
    coefficients: Behaviour

    def at(self, deviation: Deviation) -> Figures:
        """Figures of parts with these deviations: numbers, or arrays (S,)."""
        each = Deviation(*np.broadcast_arrays(*np.atleast_1d(*deviation)))
        u, v = each.edge_offset / STEP, each.contact_radius / STEP
        terms = np.stack([np.ones_like(u), u, v, 0.5 * u**2, 0.5 * v**2, u * v], axis=-1)
        found = Behaviour(*(terms @ entry for entry in self.coefficients))
        stiffer = np.asarray(1.0 + each.modulus)[:, None]
        thicker = 1.0 + each.sheet_thickness / self.spring.law.inputs.thickness
        with_sheet = stiffer * np.asarray(thicker)[:, None]
        scaled = Behaviour(
            at_rest=with_sheet * found.at_rest,
            secant=with_sheet * found.secant,
            stress=stiffer * found.stress,
            fillet_stress=stiffer * found.fillet_stress,
            gap=found.gap,
        )
        return figures(self.spring, scaled, each)


def response_surface(spring: Spring) -> ResponseSurface:
    """From six forward analyses; raises as ``behaviour`` does."""
    drawn, on, off, out, inward, both = (
        behaviour(spring, Deviation(edge_offset=u * STEP, contact_radius=v * STEP))
        for u, v in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1))
    )
    columns = zip(drawn, on, off, out, inward, both, strict=True)
    return ResponseSurface(spring, Behaviour(*(_quadratic(*values) for values in columns)))


def _quadratic(
    here: Floats, on: Floats, off: Floats, out: Floats, inward: Floats, both: Floats
) -> Floats:
    """Coefficients (6, N) of the quadratic form through the six values (N,)."""
    return np.stack(
        [
            here,
            0.5 * (on - off),
            0.5 * (out - inward),
            on - 2.0 * here + off,
            out - 2.0 * here + inward,
            both - on - out + here,
        ]
    )
