"""What a contact may bear, from what is known of its material."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from springcad.kinds.pressure import PRESSURE_OVER_YIELD, pressure_limit
from springcad.materials.data import material


def test_yield_begins_below_a_line_contact_at_1_67_of_the_yield_strength() -> None:
    """Stress on the axis of a Hertzian strip (Johnson, Eqs 4.46): by Tresca at 0.79 half widths."""

    def shear(depth: float) -> float:
        root = np.hypot(1.0, depth)
        along = -((1.0 + 2.0 * depth**2) / root - 2.0 * depth)
        return 0.5 * (along + 1.0 / root)

    deepest = minimize_scalar(lambda z: -shear(z), bounds=(0.0, 3.0), method="bounded")
    assert deepest.x == pytest.approx(0.786, abs=0.002)
    assert 0.5 / shear(deepest.x) == pytest.approx(PRESSURE_OVER_YIELD, abs=0.01)


def test_the_tensile_strength_counts_where_it_is_known() -> None:
    steel = material("aisi-420")
    assert pressure_limit(steel)[0] == pytest.approx(1.6 * 1720e6)
    unknown = replace(steel, ultimate_strength=None)
    limit, words = pressure_limit(unknown)
    assert limit == pytest.approx(1.67 * 1310e6)
    assert "yield" in words
