"""Lever-arm specs without a solution are refused before any leaf is sized, with cures."""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from springcad.errors import InfeasibleError
from springcad.kinds.lever_arm.estimate import (
    SHEETS,
    estimated_stiffness,
    full_thickness,
    sheet_for,
)
from springcad.kinds.lever_arm.feasibility import feasibility_checks, require_feasible
from springcad.kinds.lever_arm.inputs import case_of, fittings_of, lever_spec
from springcad.kinds.lever_arm.sizing import size_leaf
from springcad.kinds.lever_arm.straight_part import leaf_profile
from springcad.spec.source import read_spec

SPECS = Path(__file__).parents[2] / "specs"
TURN = re.compile(r"(?:raise|lower) (.+) from \S+ to (?:[≥≤] )?(\S+)(?: (\S+))?(?: \(.*\))?")


def case(name: str, *overrides: str):
    return case_of(read_spec(SPECS / f"lever-{name}.yaml", overrides).model)


def refusal(name: str, *overrides: str) -> InfeasibleError:
    with pytest.raises(InfeasibleError) as refused:
        require_feasible(case(name, *overrides))
    return refused.value


def size(name: str, *overrides: str):
    model = lever_spec(read_spec(SPECS / f"lever-{name}.yaml", overrides).model)
    return size_leaf(case_of(model), fittings_of(model))


def cured(remedy: str, high: str) -> list[str]:
    """The overrides that a remedy names, by its own text."""
    changes = []
    for part in remedy.split(" and "):
        turn = TURN.fullmatch(part)
        assert turn, part
        value = f"{turn[2]} {turn[3]}" if turn[3] else turn[2]
        if turn[1].startswith("the low end"):
            changes.append(f"mechanism.pivot=[{value}, {high}]")
        else:
            changes.append(f"{turn[1]}={value}")
    return changes


@pytest.mark.parametrize("name", ["parabolic", "triangular", "steel", "pom"])
def test_a_shipped_spec_is_feasible(name: str) -> None:
    assert all(claim.status == "pass" for claim in require_feasible(case(name)))


def test_closed_forms_of_oracle_b09() -> None:
    """Steel, l = 50 mm, b = 15 mm, s = 10 mm, constant section: 0.753968 mm and 2.700224 N/mm."""
    given = case(
        "parabolic", "leaf={shape: constant, length: 50 mm, sheet_thickness: 3 mm, layers: 5}",
        "target={spring_deflection: 10 mm}",
    )  # fmt: skip
    assert full_thickness(given) == pytest.approx(0.753968e-3, rel=1e-6)
    assert estimated_stiffness(given, given.room) == pytest.approx(2700.224, rel=1e-6)


def test_sheets_are_rounded_down() -> None:
    assert sheet_for(2.38e-3) == 2.0e-3
    assert sheet_for(2.0e-3) == 2.0e-3
    assert sheet_for(0.09e-3) == 0.0
    assert list(SHEETS) == sorted(SHEETS)


INFEASIBLE = {
    "beyond yield": ("parabolic", ["material.design_stress=1300 MPa"], "design stress"),
    "thinner than can be cut": (
        "parabolic", ["leaf={shape: constant, length: 50 mm, sheet_thickness: 3 mm}"],
        "thickness at the clamp",
    ),
    "thicker than a beam": (
        "parabolic", ["target.spring_deflection=1.5 mm", "leaf.length=70 mm"],
        "thickness over length",
    ),
    "far too long": ("parabolic", ["leaf.length=2 m"], "thickness over length"),
    "sheet too thick": ("triangular", ["leaf.sheet_thickness=4 mm"], "thickness of the sheet"),
    "too few layers": ("parabolic", ["leaf.layers=5"], "stiffness at full stress"),
    "too little height": ("parabolic", ["envelope.height=20 mm"], "stiffness at full stress"),
    "pivot overloaded": (
        "parabolic", ["mechanism.max_pivot_force=5 kN"], "force on the pivot, at its low end",
    ),
    "the web near the pin too stiff": (
        "parabolic", ["leaf.length=21 mm", "target.spring_deflection=2 mm"],
        "thickness at the clamp, closed form",
    ),
    "one layer too stiff": (
        "parabolic", ["leaf.sheet_thickness=10 mm", "target.spring_stiffness=0.5 N/mm"],
        "thickness at the clamp for the wanted stiffness",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("name", "overrides", "claim"), INFEASIBLE.values(), ids=INFEASIBLE.keys())
def test_the_first_broken_condition_and_cures_that_work_as_printed(name, overrides, claim) -> None:
    """The two smallest changes on the nonlinear beam too, not only in the closed forms."""
    error = refusal(name, *overrides)
    assert error.claim.startswith(claim)
    assert np.isfinite([error.value, error.limit]).all()
    assert error.remedies
    high = "38 mm" if name == "parabolic" else "35 mm"
    for place, remedy in enumerate(error.remedies):
        changes = (*overrides, *cured(remedy, high))
        require_feasible(case(name, *changes))
        assert place > 1 or size(name, *changes).leaf.thickness > 0.0


def test_keys_that_may_be_left_out_where_no_number_within_reach_does() -> None:
    error = refusal("parabolic", "leaf.layers=3", "leaf.sheet_thickness=0.5 mm")
    assert error.remedies == ("take leaf.layers out of the spec",)


def test_an_omega_leaf_is_promised_nothing() -> None:
    """The bound that no spring can pass refuses; what searches reach warns."""
    little = "leaf={shape: omega, sheet_thickness: 3 mm, layers: 2}"
    claims = {claim.name: claim.status for claim in feasibility_checks(case("steel", little))}
    assert claims["stiffness of a full enclosure, upper bound"] == "pass"
    assert claims["stiffness that omega leaves reach, estimate"] == "pass"
    warned = feasibility_checks(case("steel", little, "target.spring_stiffness=200 N/mm"))
    assert [claim.status for claim in warned] == ["pass", "pass", "warn"]
    error = refusal("steel", little, "target.spring_stiffness=2000 N/mm")
    assert error.remedies
    assert all(remedy.endswith("(the search then decides)") for remedy in error.remedies)


def test_a_spring_that_the_crank_cannot_reach_is_a_warning() -> None:
    """000, Eq. 7: beyond q = l R/(R + s) its arcsin has no value."""
    checks = feasibility_checks(case("parabolic", "mechanism.pivot=[5 mm, 45 mm]"))
    assert [claim.name for claim in checks if claim.status == "warn"] == [
        "deflection of the spring reached, at the farthest pivot"
    ]


def test_layers_that_the_closed_form_lets_pass_are_counted_on_the_beam() -> None:
    """10 layers would do by the closed form; the remedy is the number that the beam needs."""
    assert all(c.status != "fail" for c in feasibility_checks(case("parabolic", "leaf.layers=10")))
    with pytest.raises(InfeasibleError, match="10 layers") as refused:
        size("parabolic", "leaf.layers=10")
    assert refused.value.remedies == ("raise leaf.layers from 10 to 11",)
    assert size("parabolic", "leaf.layers=11").layers == 11


def test_height_that_is_missing_is_told() -> None:
    with pytest.raises(InfeasibleError, match="1 x 11 layers") as refused:
        size("parabolic", "envelope.height=30 mm")
    assert refused.value.remedies == ("raise envelope.height from 30 to 33 mm",)
    assert size("parabolic", "envelope.height=33 mm").layers == 11


def test_layers_and_height_that_are_missing_are_told_together() -> None:
    with pytest.raises(InfeasibleError, match="10 layers") as refused:
        size("parabolic", "leaf.layers=10", "envelope.height=30 mm")
    (remedy,) = refused.value.remedies
    assert remedy == "raise leaf.layers from 10 to 11 and raise envelope.height from 30 to 33 mm"


def test_a_sheet_that_the_closed_form_lets_pass_is_judged_on_the_beam() -> None:
    given = ("leaf={shape: triangular, length: 80 mm, sheet_thickness: 3 mm}",)
    with pytest.raises(InfeasibleError, match="stress of a sheet of 3 mm") as refused:
        size("parabolic", *given)
    (thinner,) = [remedy for remedy in refused.value.remedies if "sheet_thickness" in remedy]
    assert size("parabolic", *given, *cured(thinner, "38 mm")).leaf.thickness > 2.5e-3


def test_a_leaf_without_room_for_its_eye_is_refused() -> None:
    given = ("leaf.length=16 mm", "connection.eye_wall=9 mm", "leaf.width=3 mm")
    with pytest.raises(InfeasibleError, match="too short") as refused:
        size("triangular", *given)
    (remedy,) = refused.value.remedies
    assert size("triangular", *given, *cured(remedy, "35 mm")).leaf.length < 25e-3


def test_a_block_without_room_for_its_fillets_is_refused() -> None:
    low = ("mount={holes: 0, height: 5 mm}",)
    with pytest.raises(InfeasibleError, match="height of the block") as refused:
        leaf_profile(size("parabolic", *low).leaf)
    first, second = refused.value.remedies
    assert second == "take mount.height out of the spec"
    (change,) = cured(first, "38 mm")
    leaf_profile(size("parabolic", *low, change).leaf)


EXTREME = [
    ("parabolic", "leaf.length=9 m"),
    ("parabolic", "target.spring_deflection=0.001 mm"),
    ("parabolic", "target.spring_stiffness=0.1 N/m"),
    ("parabolic", "target.spring_stiffness=1000000 N/mm"),
    ("parabolic", "leaf.count=20"),
    ("parabolic", "mechanism.lever_length=9 m"),
    ("parabolic", "mechanism.crank_radius=0.001 mm"),
    ("triangular", "leaf.width=9 m"),
    ("triangular", "target.spring_deflection=35 mm"),
]


@pytest.mark.parametrize(("name", "override"), EXTREME)
def test_extreme_numbers_end_in_a_verdict(name: str, override: str) -> None:
    """Without overflow, division by zero or nan slipping through: warnings are errors here."""
    checks = feasibility_checks(case(name, override))
    assert all(np.isfinite([claim.value, claim.limit]).all() for claim in checks)
    with suppress(InfeasibleError):
        assert size(name, override).leaf.thickness > 0.0
