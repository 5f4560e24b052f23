"""Designs that needed a cure: a soft root found on the bench, and a law that stiffens."""

from __future__ import annotations

import re

import pytest
from rotary_cases import spring_of

from springcad.kinds.rotary_flexure.checks import spring_checks

SOFT_ROOT = (
    "calibration={design: S2, curve: bench.csv, material: aisi-420, elastic_modulus: 200 GPa, "
    "root_coefficient: 5.1, root_coefficient_error: 0.1}"
)
INTERFERENCE = "interference of camshaft and tips in the stroke"


def test_a_soft_root_on_the_bench_is_made_up_for_by_the_flexure() -> None:
    """S2 with 5.1/(E t h^2) more at the root has its stiffness, and no check fails."""
    spring = spring_of("S2", SOFT_ROOT)
    assert spring.sized.stiffness_at_rest == pytest.approx(150.0, rel=1e-3)
    assert not [claim.name for claim in spring_checks(spring) if claim.status == "fail"]
    thickness = 2.0 * float(spring.found.ribbon.half_thickness[0])
    unit = 1.0 / (200e9 * 4.5e-3 * thickness**2)
    assert spring.sized.root.compliance == pytest.approx(5.1 * unit, rel=0.05)


def test_the_backlash_that_a_stiffening_law_asks_for_is_enough() -> None:
    """The back of the tip cuts into the other flank; the remedy is the backlash of the spec."""
    tight = {
        claim.name: claim
        for claim in spring_checks(spring_of("rotary-stiffening", "camshaft.backlash=0 mm"))
    }[INTERFERENCE]
    assert tight.status == "fail"
    (by,) = re.findall(r"raise camshaft.backlash by ([\d.]+) mm", tight.remedy)
    loose = spring_of("rotary-stiffening")
    assert loose.camshaft_inputs.backlash == pytest.approx(1e-3 * float(by))
    assert {claim.name: claim.status for claim in spring_checks(loose)}[INTERFERENCE] == "pass"
