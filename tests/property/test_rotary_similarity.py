"""Dimensional similarity: a spring with all lengths times f is the same spring.

With the same material and the stiffness times f³ it bears the same stresses at the same angles, so
whatever has no dimension stays. What would break this is a length in the program that is neither
the spec's nor the workshop's; the workshop's (least web, gap and inside radius) grow with it here.
"""

from __future__ import annotations

import numpy as np
import pytest
from rotary_cases import spring_of, statuses

from springcad.kinds.rotary_flexure.spring import Spring

LENGTHS = {
    "envelope.outer_radius": 33.5,
    "envelope.root_radius": 31.0,
    "envelope.contact_radius": 6.0,
    "envelope.thickness": 4.5,
    "flexures.tip_thickness": 0.35,
    "flexures.min_gap": 0.3,
    "flexures.root_fillet": 0.5,
    "mounting.dowels.radius": 1.0,
}
SHOP = {"min_web": 0.3, "min_gap": 0.3, "min_inside_radius": 0.15}


def overrides(factor: float) -> tuple[str, ...]:
    shop = ", ".join(f"{key}: {value * factor:g} mm" for key, value in SHOP.items())
    return (
        *(f"{key}={value * factor:g} mm" for key, value in LENGTHS.items()),
        f"target.stiffness={150.0 * factor**3:.10g} N*m/rad",
        f"process={{name: wire-edm, {shop}}}",
    )


def figures(spring: Spring, factor: float) -> dict[str, np.ndarray]:
    """What should not depend on the size."""
    camshaft = spring.camshaft
    return {
        "torque": np.array([s.torque[-1] / factor**3 for s in spring.strokes]),
        "angle": np.array([s.angle[-1] for s in spring.strokes]),
        "first angle": np.array([s.angle[0] for s in spring.strokes]),
        "stress": np.array([s.nominal_stress.max() for s in spring.strokes]),
        "contact": np.array([s.station[-1] / spring.found.ribbon.length for s in spring.strokes]),
        "tooth": np.array([camshaft.tooth_thickness / factor]),
        "bottom": np.array([camshaft.slot.bottom_radius / factor]),
        "core": np.array([camshaft.hub_stress]),
        "exact from": np.array(camshaft.slot.exact_from),
    }


@pytest.mark.parametrize("factor", [0.25, 4.0])
def test_a_spring_of_another_size_is_the_same_spring(factor: float) -> None:
    """The searched shape and the drawn arcs end a little elsewhere: gap, mass, pressure waver."""
    one, other = spring_of("S2", *overrides(1.0)), spring_of("S2", *overrides(factor))
    plain, scaled = figures(one, 1.0), figures(other, factor)
    for name, value in plain.items():
        np.testing.assert_allclose(scaled[name], value, rtol=1e-3, err_msg=name)
    assert other.mass / factor**3 == pytest.approx(one.mass, rel=5e-3)
    for stroke, copy in zip(one.strokes, other.strokes, strict=True):
        assert copy.gap.min() / factor == pytest.approx(stroke.gap.min(), rel=0.03)
        assert copy.pressure.max() == pytest.approx(stroke.pressure.max(), rel=0.08)
    assert other.camshaft.slot.preload / factor == pytest.approx(
        one.camshaft.slot.preload, rel=0.03
    )
    assert other.camshaft.tooth_stress == pytest.approx(one.camshaft.tooth_stress, rel=5e-3)


@pytest.mark.parametrize("factor", [0.25, 4.0])
def test_no_check_fails_for_its_size(factor: float) -> None:
    assert "fail" not in statuses("S2", *overrides(factor)).values()
