"""The leaf for a stiffness range, by closed forms.

With n leaves of width a and thickness b the least stiffness K at the longest length L and the
stress σ at the deflection φ there are (003, Eqs 6, 7, 10 and 16 at rest)

    K = n E a b³ R²/(4 L³),    σ = 3 E b R sin φ/(2 L²).

So L = b (n a E R²/4K)^⅓ for the wanted K: a thicker or wider leaf is longer and bears less stress.
Of all leaves that bear the deflection the shortest has the stress allowed. Along these L² = c b
and a b³ = d L³, so it is the thinnest, and as wide as that takes. Shear and the estimate of the
stress, in place of Eq. 10, change c and d a little with the length: a few passes settle them.
"""

from __future__ import annotations

import math

from springcad.kinds.leaf_2dof import estimate
from springcad.kinds.leaf_2dof.case import Case, Setup
from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.kinds.leaf_2dof.seating import shear_modulus
from springcad.mechanics.section import SHEAR_CORRECTION

GRID = 1e-6
"""Sized sections and lengths are whole multiples of this (m)."""
_PASSES = 30
_SETTLED = 1e-7


def closed_form_setup(case: Case, leaves: int) -> Setup:
    """The given leaf, or the shortest one within the bounds; lengths as given or as K needs.

    Bounds may leave no leaf that bears the deflection: the setup is then the one that comes
    closest, which the checks refuse.
    """
    width, thickness = case.width, case.thickness
    if case.is_sized:
        width, thickness = _section(case, leaves)
    leaf, lever = case.leaf(width, thickness), case.lever
    shortest, longest = case.shortest, case.longest
    if longest is None:
        longest = _up(length_for(leaf, lever, leaves, _wanted(case.least_stiffness)))
    if shortest is None:
        shortest = _down(length_for(leaf, lever, leaves, _wanted(case.greatest_stiffness)))
    return Setup(leaf, lever, leaves, shortest, longest)


def length_for(leaf: Leaf, lever: Lever, leaves: int, stiffness: float) -> float:
    """Effective length (m) with the stiffness at rest, shear included.

    L³/3EI + L/GA_s = n R²/K is a cubic with one real root.
    """
    bending = 3.0 * leaf.bending_stiffness
    linear = bending / (SHEAR_CORRECTION * shear_modulus(leaf) * leaf.width * leaf.thickness)
    volume = bending * leaves * lever.radius**2 / stiffness
    scale = math.sqrt(linear / 3.0)
    return 2.0 * scale * math.sinh(math.asinh(0.5 * volume / scale**3) / 3.0)


def least_length(case: Case) -> float:
    """Shortest effective length (m) at which the roller clears the guide, however it is turned."""
    return case.roller_radius + case.clearance + approach(case, case.deflection)


def least_bent_length(case: Case) -> float:
    """Length (m) from which on the slope at the deflection is allowed; 0 for no limit."""
    if math.isinf(case.max_bend_angle):
        return 0.0
    thickest = case.leaf(case.width, case.thickness)
    allowed = case.max_bend_angle / (case.slope_factor * (1.0 + estimate.ESTIMATE_ERROR))
    low, high = 0.0, 1.5 * case.arm_radius / math.tan(allowed) + 2.0 * case.arm_radius
    while high - low > GRID:
        middle = 0.5 * (low + high)
        bent = estimate.bend(thickest, case.lever, middle, case.deflection)
        low, high = (low, middle) if bent is not None and bent.slope <= allowed else (middle, high)
    return high


def approach(case: Case, angle: float) -> float:
    """How far the roller's centre comes towards the guide at the angle (m)."""
    return case.arm_radius * (1.0 - math.cos(angle)) if case.clamp == "inboard" else 0.0


def _section(case: Case, leaves: int) -> tuple[float, float]:
    """Width and thickness of the shortest leaf within the bounds; of several the lightest."""
    low_a, high_a = case.least_width or case.width, case.width
    low_b, high_b = case.least_thickness or case.thickness, case.thickness
    least, greatest = _wanted(case.least_stiffness), _wanted(case.greatest_stiffness)
    clear, gentle = least_length(case), least_bent_length(case)
    needed = max(clear * (greatest / least) ** (1.0 / 3.0), gentle)
    stiff = 4.0 * least / (leaves * case.elastic_modulus * case.arm_radius**2)  # a b³ = stiff L³
    bent = _linear_bent(case)  # L² = bent b at the stress allowed
    for _ in range(_PASSES):
        thinnest = max(low_b, bent * (stiff / high_a) ** (2.0 / 3.0))
        length = max(needed, math.sqrt(bent * thinnest))
        # As thick as the stress allows, since a b falls with b² at a length; but not too narrow.
        width = stiff * (length / min(length**2 / bent, high_b)) ** 3
        width = min(max(width, low_a), high_a)
        thickness = min(max(length * (stiff / width) ** (1.0 / 3.0), low_b), high_b)
        exact, shortest = (
            length_for(case.leaf(width, thickness), case.lever, leaves, stiffness)
            for stiffness in (least, greatest)
        )
        needed = max(clear * exact / shortest, gentle)
        stiff = width * (thickness / exact) ** 3
        before, bent = bent, _bent(case, exact, thickness)
        if abs(bent - before) < _SETTLED * bent:
            break
    return _up(width, high_a), _up(thickness, high_b)


def _bent(case: Case, length: float, thickness: float) -> float:
    """L²/b at which a leaf of about this length and thickness has the stress allowed (m)."""
    leaf = case.leaf(case.width, thickness)
    stress = estimate.stress(leaf, case.lever, length, case.deflection)
    if math.isinf(stress):
        return _linear_bent(case)
    return length**2 / thickness * stress * case.stress_factor / case.design_stress


def _linear_bent(case: Case) -> float:
    """The same by Eqs 6 and 10."""
    rise = case.arm_radius * math.sin(case.deflection)
    return 1.5 * case.elastic_modulus * rise * case.stress_factor / case.design_stress


def _wanted(stiffness: float | None) -> float:
    if stiffness is None:
        raise ValueError("a valid spec has a stiffness where a length is to be found")
    return stiffness


def _up(value: float, most: float = math.inf) -> float:
    return min(round(math.ceil(value / GRID - 1e-6) * GRID, 9), most)


def _down(value: float) -> float:
    return round(math.floor(value / GRID + 1e-6) * GRID, 9)
