"""Strip of contact between two edges whose curvature changes along it, without friction.

Hertz's formula knows one curvature. Edges that are nearly as round as each other touch on a wide
strip, and along it their small relative curvature may change by a good part of itself. As in
Hertz's theory the edges are those of half-planes and strains are small; but the slope g(x) of the
gap between them is any rising function. On the strip m ± b, with x = m + b cos φ,

    g = Σ aₙ cos nφ,   a₀ = 0,   p(φ) = (E*/2) Σ aₙ sin nφ,   load = (π/4) E* b a₁,

where a₀ = 0 lets the pressure end in zero at both ends (Johnson, Contact Mechanics, 2.7 and 5.3).
Hertz's is a₁ = κ b, all others 0. With Φ(m, b) the mean of ∫ g dx over φ both conditions say that

    Φ(m, b) − (2 load/(π E*)) ln b

is least; it is convex because g rises, so Newton's method with short steps finds the one strip.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.contact import half_width

Floats = NDArray[np.float64]
Opening = Callable[[Floats], tuple[Floats, Floats]]
"""Slope g [1] of the gap and its derivative, the relative curvature [1/m], both (A, K), at places
(A, K) [m] along the edges, from where they first touch: there g is 0."""

NODES = 64
"""Places along a strip at which the gap is looked at."""
INNER = 0.9
"""The peak is looked for within this share of the half width: where an edge ends or its curvature
jumps just within the end of the strip, a sliver of it is pressed harder."""
_TOLERANCE = 1e-8
"""Of the last change of the strip, over its half width."""
_LONGEST = 0.5
"""Longest change of an iteration, over the half width."""
_MAX_ITERATIONS = 100


@dataclass(frozen=True)
class Strips:
    """Strips of contact, each (A,).

    Attributes:
        middle: from where the edges touch without load, along them [m].
        half_width: [m].
        peak_pressure: largest but for the ends of the strip (``INNER``) [Pa].
    """

    middle: Floats
    half_width: Floats
    peak_pressure: Floats


def contact_strips(
    opening: Opening, force: Floats, width: float, curvature: Floats, modulus: float
) -> Strips:
    """Where edges touch under normal forces, and how hard.

    Args:
        opening: of the gap; must rise with the place.
        force: (A,) [N], > 0.
        width: length of the line of contact, the thickness of the sheet [m].
        curvature: a relative curvature to begin with (A,) [1/m], > 0.
        modulus: E* from ``contact_modulus`` [Pa].

    Raises:
        ArithmeticError: no strip was found, as where the edges do not part.
    """
    angle = (np.arange(NODES) + 0.5) * np.pi / NODES
    cosine = np.cos(angle)
    drive = 2.0 * force / (width * np.pi * modulus)
    half = half_width(force, width, curvature, modulus)
    middle = np.zeros_like(half)
    for _ in range(_MAX_ITERATIONS):
        slope, bend = opening(middle[:, None] + half[:, None] * cosine)
        # Gradient and Hessian of the function that is least.
        to_middle, to_half = slope.mean(axis=1), slope @ cosine / NODES - drive / half
        mm, mb = bend.mean(axis=1), bend @ cosine / NODES
        bb = bend @ cosine**2 / NODES + drive / half**2
        size = mm * bb - mb**2
        change = np.stack([mb * to_half - bb * to_middle, mb * to_middle - mm * to_half]) / size
        longest = np.abs(change).max(axis=0) / half
        change = change * np.minimum(1.0, _LONGEST / np.maximum(longest, _LONGEST))
        middle, half = middle + change[0], half + change[1]
        if np.max(longest, initial=0.0) <= _TOLERANCE:
            break
    else:
        raise ArithmeticError("no strip of contact was found")
    slope, _ = opening(middle[:, None] + half[:, None] * cosine)
    order = np.arange(1, NODES)
    parts = 2.0 / NODES * slope @ np.cos(np.outer(angle, order))
    inner = angle[np.abs(cosine) < INNER]
    pressure = 0.5 * modulus * parts @ np.sin(np.outer(order, inner))
    return Strips(middle, half, pressure.max(axis=1))
