"""Leaf specs without a solution are refused before anything is bent, with cures that work."""

from __future__ import annotations

import re
import time
from dataclasses import replace

import numpy as np
import pytest
from leaf2_cases import DEGREE
from leaf2dof_specs import shipped_case

from springcad.errors import InfeasibleError
from springcad.kinds.knobs import changed
from springcad.kinds.leaf_2dof.case import Case
from springcad.kinds.leaf_2dof.feasibility import (
    failures,
    feasibility_checks,
    knobs_of,
    require_feasible,
    setup_of,
)
from springcad.kinds.leaf_2dof.unit import stroke

TURN = re.compile(r"(?:raise|lower) (.+) from \S+ to (?:[≥≤] )?(\S+?)( \S+)?(?: \(.*\))?")


def refusal(case: Case) -> InfeasibleError:
    with pytest.raises(InfeasibleError) as refused:
        require_feasible(case)
    return refused.value


def cured(case: Case, remedy: str) -> Case:
    """The case after the change that a remedy names, by its own text."""
    knobs = {knob.key: knob for knob in knobs_of(case)}
    for part in remedy.split(" and "):
        turn = TURN.fullmatch(part)
        assert turn, part
        case = changed(case, knobs[turn[1]], float(turn[2]))
    return case


@pytest.mark.parametrize("name", ["paper", "design"])
def test_a_shipped_spec_is_feasible(name: str) -> None:
    assert all(claim.status == "pass" for claim in require_feasible(shipped_case(name)))


INFEASIBLE = {
    "beyond yield": ("paper", ["material.design_stress=800 MPa"], "design stress against yield"),
    "too stiff at its longest": (
        "paper",
        ["target.stiffness=[1 N*m/rad, 140 N*m/rad]"],
        "least stiffness at rest",
    ),
    "too soft at its shortest": (
        "paper",
        ["target.stiffness=[1.54 N*m/rad, 200 N*m/rad]"],
        "greatest stiffness at rest",
    ),
    "stress": ("paper", ["target.deflection=17 deg"], "stress at the clamp"),
    "bend angle": ("paper", ["leaf.max_bend_angle=10 deg"], "bend angle"),
    "beyond the torque's peak": (
        "paper",
        [
            "target.deflection=30 deg",
            "leaf.thickness=0.2 mm",
            "leaf.max_bend_angle=40 deg",
            "target.stiffness=[0.1 N*m/rad, 5 N*m/rad]",
        ],
        "stiffness at the deflection",
    ),
    "held inboard": ("paper", ["unit.clamp=inboard"], "stress at the clamp"),
    "guide": ("paper", ["leaf.effective_length=[5.1 mm, 45 mm]"], "gap between roller and guide"),
    "guide, far off": (
        "paper",
        ["leaf.effective_length=[1 mm, 45 mm]"],
        "gap between roller and guide",
    ),
    "no beam": (
        "paper",
        [
            "leaf.effective_length=[10 mm, 150 mm]",
            "leaf.thickness=2.4 mm",
            "target={deflection: 2 deg}",
        ],
        "thickness over effective length",
    ),
    "room": ("paper", ["envelope.leaf_length=65 mm"], "length of the whole leaf"),
    "range too short": (
        "paper",
        ["leaf.effective_length=[12 mm, 40 mm]"],
        "least stiffness at rest",
    ),
    "sized, thickness bounded": (
        "design",
        ["leaf.thickness=[0.3 mm, 0.45 mm]", "unit.leaves_per_axis=2"],
        "stress at the clamp",
    ),
    "sized, no room": ("design", ["envelope.leaf_length=50 mm"], "length of the whole leaf"),
}


@pytest.mark.parametrize(("name", "overrides", "claim"), INFEASIBLE.values(), ids=INFEASIBLE.keys())
def test_the_first_broken_condition_is_told_and_every_remedy_cures(
    name: str, overrides: list[str], claim: str
) -> None:
    """Estimates are wrong by up to 1 %: what is printed cures on the exact unit all the same, and
    a sized leaf, whose stress may be 0.6 % more than estimated, may then still be longer.
    """
    case = shipped_case(name, *overrides)
    start = time.process_time()  # other tests may run beside this one
    error = refusal(case)
    assert time.process_time() - start < 1.0
    assert error.claim.startswith(claim)
    assert np.isfinite([error.value, error.limit]).all()
    assert error.remedies
    for remedy in error.remedies:
        better = cured(case, remedy)
        assert failures(replace(better, stress_factor=1.006)) == (), remedy
        if not better.is_sized:
            setup = setup_of(better)
            found = stroke(setup.leaf, setup.lever, setup.longest, better.deflection)
            assert found.stress <= better.design_stress, remedy
            assert found.bend_angle <= better.max_bend_angle, remedy
            assert found.stiffness >= 0.0, remedy


def test_remedies_stay_within_what_a_spec_may_say() -> None:
    """Not beyond another number: no roller as large as the arm, no range upside down."""
    case = shipped_case("paper", "leaf.effective_length=[5.1 mm, 45 mm]")
    for change in (
        {"leaves": 0}, {"leaves": 9}, {"shortest": 46e-3}, {"roller_radius": 30e-3},
        {"thickness": 11e-3}, {"least_stiffness": 150.0},
    ):  # fmt: skip
        assert len(failures(replace(case, **change))) > len(failures(case))


def test_an_estimate_near_its_limit_is_left_to_the_exact_unit() -> None:
    """575.7 MPa by the estimate, 575.8 exactly: 575 allowed is a warning first, then a refusal."""
    case = shipped_case("paper", "material.design_stress=575 MPa")
    near = {claim.name.partition(",")[0]: claim for claim in require_feasible(case)}
    assert near["stress at the clamp (estimate)"].status == "warn"
    exact = replace(case, stress_factor=575.84 / 575.7)
    assert refusal(exact).claim.startswith("stress at the clamp")


@pytest.mark.parametrize(
    "change",
    [
        {"deflection": 30 * DEGREE, "arm_radius": 10.0, "roller_radius": 9.0},
        {"deflection": 0.1 * DEGREE, "design_stress": 1e5},
        {"thickness": 1e-5, "least_thickness": None},
        {"least_stiffness": 1e-4, "greatest_stiffness": 1e6},
        {"clamp": "inboard", "deflection": 30 * DEGREE},
        {"guide_length": 10.0, "leaf_room": 1e-5},
    ],
)
@pytest.mark.parametrize("name", ["paper", "design"])
def test_extreme_numbers_end_in_a_verdict(name: str, change: dict[str, object]) -> None:
    """Without overflow, division by zero or nan slipping through: warnings are errors here."""
    checks = feasibility_checks(replace(shipped_case(name), leaves=2, **change))
    assert all(claim.status != "pass" or np.isfinite(claim.value) for claim in checks)
