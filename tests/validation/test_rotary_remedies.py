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


def test_the_fillet_stress_that_the_warning_names_ends_the_warning() -> None:
    """The fillets of S2 bear more than yield; bounded to what the remedy says they do not."""
    name = "root fillet stress against yield"
    plain = {claim.name: claim for claim in spring_checks(spring_of("S2"))}[name]
    assert plain.status == "warn"
    (stress,) = re.findall(r"flexures.fillet_stress: ([\d.]+ MPa)", plain.remedy)
    bounded = spring_of("S2", f"flexures.fillet_stress={stress}")
    assert {claim.name: claim.status for claim in spring_checks(bounded)}[name] == "pass"


def test_a_little_less_stress_in_the_fillets_costs_a_little_gap() -> None:
    """A search that stops short of its constraints goes on; else 1300 MPa has no design at all."""
    gaps = [
        spring_of("S2", f"flexures.fillet_stress={stress} MPa").found.gap for stress in (1310, 1300)
    ]
    assert gaps[1] == pytest.approx(gaps[0], abs=0.02e-3)


def test_every_warning_of_the_papers_form_names_what_ends_it() -> None:
    """The form of the paper balances the flexure by its mean; the other one does it exactly."""
    warned = {
        c.name: c.remedy for c in spring_checks(spring_of("rotary-full")) if c.status != "pass"
    }
    assert all(warned.values())
    balance = next(name for name in warned if name.startswith("lateral balance"))
    assert "optimiser.form to curvature" in warned[balance]
    exact = spring_of("rotary-full", "optimiser={form: curvature}")
    assert {c.name: c.status for c in spring_checks(exact)}[balance] == "pass"
    (bend,) = re.findall(r"bend_limit below ([\d.]+)", warned["inner-fibre stress against yield"])
    assert float(bend) == pytest.approx(
        spring_of("rotary-full").found.ribbon.largest_bend, rel=0.02
    )
