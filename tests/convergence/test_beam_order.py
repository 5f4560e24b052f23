"""The error of the beam falls with the order that its quadrature promises."""

from __future__ import annotations

import numpy as np
import pytest

from springcad.mechanics.beam import RibbonBeam, contact_load, prepare


def tip(nodes: int, panels: int) -> np.ndarray:
    beam = RibbonBeam(
        np.linspace(0.0, 25e-3, panels + 1),
        lambda s: 200.0 * np.sin(400.0 * s),
        lambda s: 1e-3 - s**2,
        root_angle=0.1,
        thickness=4e-3,
        elastic_modulus=200e9,
        shear_modulus=77e9,
        nodes_per_panel=nodes,
    )
    states = contact_load(prepare(beam), 25e-3, 150.0, 1.0)
    return np.array([*states.point[0], 1e-3 * states.end_rotation[0]])


@pytest.mark.parametrize(("nodes", "panels"), [(3, 24), (4, 8)])
def test_the_order_is_twice_the_number_of_nodes_minus_two(nodes: int, panels: int) -> None:
    exact = tip(12, 32)
    errors = [np.max(np.abs(tip(nodes, p) - exact)) for p in (panels, 2 * panels, 4 * panels)]
    order = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(order, 2 * nodes - 2, atol=0.35)
