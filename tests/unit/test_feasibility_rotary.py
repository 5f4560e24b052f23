"""Infeasible rotary specs are refused with the limit, and every remedy printed is a cure."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import pytest

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.case import Case, resolved_style
from springcad.kinds.rotary_flexure.feasibility import feasibility_checks, require_feasible
from springcad.kinds.rotary_flexure.inputs import case_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.straight import straight_alternatives
from springcad.spec.source import read_spec

SPECS = Path(__file__).parents[2] / "specs"
SHIPPED = ("S1", "S2", "S3", "S4", "rotary-minimal", "rotary-full")


def shipped(name: str, *overrides: str) -> Case:
    """A shipped spec read by the real reader, with overrides as on the command line."""
    return case_of(read_spec(SPECS / f"{name}.yaml", overrides).model)


def overrides_in(remedy: str) -> list[str]:
    """The changes that a remedy names, as overrides."""
    changes = []
    for part in remedy.split(" and "):
        if style := re.fullmatch(r"set (\S+) to (\S+)", part):
            changes.append(f"{style[1]}={style[2]}")
            continue
        turn = re.fullmatch(
            r"(?:raise|lower) (\S+) from \S+ to (?:[≥≤] )?(\S+)(?: (\S+))?(?: \(.*\))?", part
        )
        assert turn, part
        changes.append(f"{turn[1]}={turn[2]} {turn[3] or ''}".strip())
    return changes


INFEASIBLE = {
    "straight already too soft": ("S4", ["target.deflection=10 deg"], "serpentine factor"),
    "straight flexure over-stressed": ("S4", ["flexures.style=straight"], "serpentine factor"),
    "more than a full disk": ("S4", ["target.deflection=17 deg"], "deflection against a full disk"),
    "no room for the gaps": ("S4", ["target.deflection=16 deg"], "density factor"),
    "no room for the tooth": (
        "S4",
        ["envelope.contact_radius=3.2 mm", "target.deflection=15.6 deg"],
        "cam tooth",
    ),
    "neighbours pinch": ("S4", ["flexures.min_gap=0.7 mm"], "gap between neighbours"),
    "hub twists off": (
        "S2",
        ["envelope.contact_radius=3.2 mm", "flexures.count=12", "target.deflection=16 deg"],
        "camshaft torsion against yield",
    ),
    "no wall around the bore": ("S2", ["camshaft.bore_radius=5.7 mm"], "camshaft wall"),
    "stress beyond yield": (
        "S2",
        ["material.design_stress=1400 MPa", "target.deflection=24 deg"],
        "design stress",
    ),
    "several at once": (
        "S4",
        ["envelope.contact_radius=3 mm", "target.deflection=16.5 deg"],
        "density factor",
    ),
    "tip thicker than the root": (
        "S2",
        ["flexures.tip_thickness=3.4 mm", "flexures.count=8", "envelope.thickness=12 mm"],
        "tip thickness against the root",
    ),
}


@pytest.mark.parametrize("name", SHIPPED)
def test_a_shipped_spec_is_feasible(name):
    assert all(claim.status == "pass" for claim in require_feasible(shipped(name)))


@pytest.mark.parametrize(("name", "overrides", "claim"), INFEASIBLE.values(), ids=INFEASIBLE.keys())
def test_every_remedy_makes_the_spec_feasible_as_printed(name, overrides, claim):
    """The remedy's own text, put into the real spec, passes the real reader and every check."""
    with pytest.raises(InfeasibleError) as refusal:
        require_feasible(shipped(name, *overrides))
    assert refusal.value.claim.startswith(claim)
    assert refusal.value.remedies
    for remedy in refusal.value.remedies:
        require_feasible(shipped(name, *overrides, *overrides_in(remedy)))


@pytest.mark.parametrize(("name", "overrides", "claim"), INFEASIBLE.values(), ids=INFEASIBLE.keys())
def test_a_refusal_gives_value_and_limit(name, overrides, claim):
    case = shipped(name, *overrides)
    checks = feasibility_checks(case)
    failed = [one for one in checks if one.status == "fail"]
    for one in failed:
        assert one.value > one.limit if one.sense == "<=" else one.value < one.limit
        assert one.unit in {"1", "m", "rad", "Pa"}
        assert one.remedy


@pytest.mark.parametrize(
    ("text", "worse"),
    [("target.deflection", 0.1), ("envelope.root_radius", -0.1)],
)
def test_a_remedy_is_the_nearest_number_of_its_grid(text, worse):
    """One step back towards the spec's own value, it is infeasible or beyond experience still."""
    overrides = ["target.deflection=16.3 deg", "flexures.min_gap=0.5 mm",
                 "envelope.outer_radius=34 mm"]  # fmt: skip
    with pytest.raises(InfeasibleError) as refusal:
        require_feasible(shipped("S4", *overrides))
    (remedy,) = [one for one in refusal.value.remedies if text in one]
    (change,) = overrides_in(remedy)
    key, number, unit = re.fullmatch(r"(\S+)=(\S+) (\S+)", change).groups()
    back = f"{key}={float(number) + worse:.1f} {unit}"
    claims = {one.name: one.status for one in feasibility_checks(shipped("S4", *overrides, back))}
    dense = claims["density factor within experience"] == "warn"
    assert dense or "fail" in claims.values()


def test_the_example_of_a_refusal_reads_like_an_order():
    with pytest.raises(InfeasibleError) as refusal:
        require_feasible(shipped("S4", "flexures.style=straight"))
    assert refusal.value.remedies[0] == "set flexures.style to auto"
    assert "lower target.deflection from 13.4 to ≤ 12.1 deg" in refusal.value.remedies
    assert refusal.value.value == pytest.approx(1.1694, abs=1e-4)


def test_a_design_without_any_near_cure_has_no_remedy():
    case = shipped("S4", "target.deflection=60 deg", "target.stiffness=5000 N*m/rad")
    with pytest.raises(InfeasibleError) as refusal:
        require_feasible(case)
    assert refusal.value.remedies == ()


def test_a_rounded_table_value_still_counts_as_straight():
    """Table I prints 12.6 deg for S1: f_s = 1.005, 0.4 % above the design stress."""
    case = shipped("S1", "target.deflection=12.6 deg", "flexures.style=auto",
                   "flexures.tip_thickness=0.4 mm")  # fmt: skip
    law = design_law(case.inputs)
    assert resolved_style(law, "auto") == "straight"
    assert law.straight_thickness_factor**-2 == pytest.approx(1.004, abs=2e-4)
    require_feasible(case)
    require_feasible(replace(case, style="straight"))
    # Between 12.56 and 12.76 deg the exact beam decides (validation/test_straight_limit.py).
    require_feasible(shipped("S1", "target.deflection=12.7 deg"))
    with pytest.raises(InfeasibleError):
        require_feasible(shipped("S1", "target.deflection=14 deg"))


def test_a_straight_flexure_may_be_stronger_than_needed():
    """At 10 deg S4 straight is thicker than Eq. 2 and stays below the design stress."""
    case = shipped("S4", "target.deflection=10 deg", "flexures.style=straight")
    require_feasible(case)
    assert design_law(case.inputs).straight_thickness_factor > 1.0


def test_a_dense_ring_is_warned_about_not_refused():
    case = shipped("S4", "target.deflection=15.2 deg")
    warned = [claim.name for claim in require_feasible(case) if claim.status == "warn"]
    assert warned == ["density factor within experience"]


def test_a_twisted_hub_within_yield_is_warned_about():
    case = shipped("S4", "envelope.contact_radius=3.6 mm", "flexures.count=22",
                   "target.deflection=14.5 deg")  # fmt: skip
    warned = [claim.name for claim in require_feasible(case) if claim.status == "warn"]
    assert warned == ["camshaft torsion against the design stress"]


def test_a_rim_exactly_as_thin_as_the_process_allows_passes():
    """28.5 - 27.2 - 1 is 0.3 mm, whatever binary fractions make of it."""
    case = shipped("S3", "envelope.root_radius=27.2 mm")
    (rim,) = [claim for claim in feasibility_checks(case) if claim.name.startswith("rim")]
    assert rim.status == "pass"


@pytest.mark.parametrize("name", ["S2", "S3", "S4"])
def test_a_straight_alternative_passes_every_check_as_a_spec(name):
    case = shipped(name)
    found = straight_alternatives(case)
    assert found
    for one in found:
        cure = [
            "flexures.style=straight",
            f"flexures.count={one.count}",
            f"envelope.contact_radius={one.contact_radius * 1e3:.4g} mm",
        ]
        straight = shipped(name, *cure)
        require_feasible(straight)
        law = design_law(straight.inputs)
        assert one.force == pytest.approx(law.force, rel=1e-12)
        assert one.tooth_width == pytest.approx(law.tooth_width, rel=1e-12)
        thick = law.straight_thickness_factor
        assert one.stress == pytest.approx(912e6 / thick**2, rel=1e-12)
        assert one.root_half_thickness == pytest.approx(thick * law.root_half_thickness, rel=1e-12)
        assert one.stress <= 912e6
        assert str(one.count) in str(one)


def test_four_millimetres_and_28_straight_flexures_reach_13_3_degrees_in_the_space_of_s4():
    case = shipped("S4", "envelope.contact_radius=4 mm", "flexures.count=28",
                   "flexures.style=straight", "target.deflection=13.3 deg",
                   "flexures.tip_thickness=0.4 mm")  # fmt: skip
    require_feasible(case)
    law = design_law(case.inputs)
    assert math.degrees(law.straight_deflection) == pytest.approx(13.32, abs=0.005)
    assert law.force == pytest.approx(311, abs=0.5)
    assert law.tooth_width == pytest.approx(0.50e-3, abs=0.005e-3)


def test_no_straight_alternative_where_the_web_leaves_no_tooth():
    assert straight_alternatives(replace(shipped("S4"), min_web=0.8e-3)) == ()
