"""What a line contact may bear, for every kind."""

from __future__ import annotations

from springcad.materials.data import Material

PRESSURE_OVER_ULTIMATE = 1.6
"""Hertzian pressure over tensile strength that hardened steel bears statically: a common rule of
thumb (1.6 to 1.8), not a limit of any standard."""
PRESSURE_OVER_YIELD = 1.67
"""Hertzian pressure over yield strength at which a line contact first yields, below its surface,
by Tresca; 1.79 by von Mises (Johnson, Contact Mechanics, 6.2)."""


def pressure_limit(material: Material) -> tuple[float, str]:
    """Pressure that a contact of this material may bear [Pa], and whence in words.

    From the tensile strength; where that is unknown, that at which yield begins.
    """
    ultimate = material.ultimate_strength
    if ultimate is not None:
        words = f"{PRESSURE_OVER_ULTIMATE:g} x tensile strength is a rule of thumb"
        return PRESSURE_OVER_ULTIMATE * ultimate.value, words
    words = f"{PRESSURE_OVER_YIELD:g} x yield strength: yield begins below the surface"
    return PRESSURE_OVER_YIELD * material.yield_strength.value, words
