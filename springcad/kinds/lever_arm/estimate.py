"""Thickness and stiffness of a straight leaf in closed form, before it is sized on the beam.

The estimate of the stiffness is that of ``springcad.mechanics.leaf``.
"""

from __future__ import annotations

import math

from springcad.kinds.lever_arm.case import Case
from springcad.mechanics.leaf import SHAPES, greatest_stiffness, stiffness, thickness_for

STIFFNESS_ERROR = 0.25
"""Share by which the closed form of the stiffness may be too low or too high: it knows neither
large deflection nor shear, eye, fillet and least web (measured: 2 to 6 %)."""
THICKNESS_ERROR = 0.1
"""The same for thicknesses (measured: 1 to 4 %)."""
SHEETS = tuple(
    1e-3 * size
    for size in (
        0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0,
        8.0, 10.0, 12.0, 15.0, 20.0,
    )
)  # fmt: skip
"""Customary thicknesses of sheet [m]; a shop may have others: leaf.sheet_thickness takes any."""
_SMOOTH = 1.1
"""Least web of a parabola, its smooth transition counted, over that of the process."""


def full_thickness(case: Case) -> float:
    """Thickness at the clamp that the stress allows, of a straight leaf (000, Eq. 17) [m]."""
    return float(
        thickness_for(
            SHAPES[case.shape],
            case.elastic_modulus,
            case.length,
            case.design_stress,
            case.deflection,
        )
    )


def sheet_for(thickness: float) -> float:
    """The largest customary sheet not above a thickness, 0 if there is none [m]."""
    return max((sheet for sheet in SHEETS if sheet <= thickness * (1.0 + 1e-9)), default=0.0)


def estimated_stiffness(case: Case, width: float) -> float:
    """Of all leaves of a width at their full stress, straight ones, closed form [N/m]."""
    shape = SHAPES[case.shape]
    if case.shape != "triangular":
        one = greatest_stiffness(
            shape, case.elastic_modulus, width, case.length, case.design_stress, case.deflection
        )
        return case.count * float(one) * _web_factor(case)
    sheet = case.sheet or sheet_for(full_thickness(case))
    return case.count * float(stiffness(shape, case.elastic_modulus, width, case.length, sheet))


def _web_factor(case: Case) -> float:
    """Share of a parabola's stiffness at full stress that the least web near the pin leaves.

    With r = w/h and c = (2 - r^3)/3, h is that of the parabola times 1 - r^3/2, hence k times the
    square of it; 3/4, where there is a leaf no longer, at least.
    """
    if case.shape != "parabolic":
        return 1.0
    thinner = 1.0
    for _ in range(20):
        web = _SMOOTH * case.min_web / (thinner * full_thickness(case))
        thinner = max(1.0 - 0.5 * web**3, 0.75)
    return thinner**2


def thickness_for_stiffness(case: Case) -> float:
    """Thickness at the clamp of a stack with the wanted stiffness, closed form [m].

    That of full stress where no layers of the sheet, or those that are given, have more.
    """
    full = full_thickness(case)
    layer = estimated_stiffness(case, case.sheet)
    layers = case.layers or max(1, math.ceil(case.stiffness / layer * (1.0 - 1e-9)))
    return full * min(1.0, math.cbrt(case.stiffness / (layers * layer)))
