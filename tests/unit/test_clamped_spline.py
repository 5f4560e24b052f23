"""The clamped spline against scipy's, and its answer to moving knots against differences."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from springcad.geometry.clamped_spline import clamped_spline, knot_derivatives, piecewise_cubic

KNOTS = {
    1: ([0.0, 9.0, 25.0], [0.0, -4.0, 0.0]),
    2: ([0.0, 5.0, 11.6, 25.0], [0.0, -4.2, 1.4, 0.0]),
    4: ([0.0, 4.0, 12.2, 17.0, 22.8, 25.0], [0.0, -3.7, 2.4, -1.0, 0.5, 0.0]),
}
AT = np.linspace(0.0, 25.0, 203)


@pytest.mark.parametrize("m", KNOTS)
def test_it_is_the_cubic_spline_with_zero_end_slopes(m):
    x, y = map(np.array, KNOTS[m])
    spline, known = clamped_spline(x, y), CubicSpline(x, y, bc_type="clamped")
    inside = AT[~np.isin(AT, x)]
    for order, values in enumerate(spline(inside)):
        np.testing.assert_allclose(values, known(inside, order), atol=1e-13)


def test_a_cubic_with_zero_end_slopes_is_reproduced():
    x = np.array([0.0, 0.2, 0.7, 1.0])
    with_offset = 3 * x**2 - 2 * x**3
    at = np.linspace(0.0, 1.0, 50)
    np.testing.assert_allclose(
        clamped_spline(x, with_offset)(at)[0], 3 * at**2 - 2 * at**3, atol=1e-14
    )


@pytest.mark.parametrize("m", KNOTS)
def test_knot_derivatives_are_exact(m):
    x, y = map(np.array, KNOTS[m])
    derivatives = knot_derivatives(clamped_spline(x, y))
    exact = piecewise_cubic(x, derivatives, AT)[0]
    step = 1e-5
    for row, parameter in enumerate(step * np.eye(2 * m)):
        across, up = np.pad(parameter[:m], 1), np.pad(parameter[m:], 1)
        moved = [clamped_spline(x + s * across, y + s * up)(AT)[0] for s in (1, -1)]
        difference = (moved[0] - moved[1]) / (2 * step)
        np.testing.assert_allclose(exact[row], difference, atol=2e-8)
