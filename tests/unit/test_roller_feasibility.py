"""Roller-cam specs without a solution are refused before any profile is sought, with cures."""

from __future__ import annotations

import re
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from springcad.errors import InfeasibleError
from springcad.kinds import KINDS
from springcad.kinds.roller_cam.case import Case
from springcad.kinds.roller_cam.feasibility import feasibility_checks, require_feasible
from springcad.kinds.roller_cam.inputs import case_of
from springcad.kinds.roller_cam.limits import (
    LEAST_OVERRUN,
    end_stress,
    required_arm,
    tip_stiffness,
)
from springcad.kinds.roller_cam.remedies import synthesis_remedies, within_stress
from springcad.kinds.roller_cam.synthesis import synthesise
from springcad.kinds.roller_cam.tip import linear_tip
from springcad.spec.source import read_spec

SPECS = Path(__file__).parents[2] / "specs"
SHIPPED = ("paper", "linear", "quadratic", "table", "stiffness")
DEGREE = np.pi / 180.0
TURN = re.compile(r"(?:raise|lower) (.+) from \S+ to (?:[≥≤] )?(\S+) (\S+)(?: \(.*\))?")


@pytest.fixture(autouse=True)
def _registered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(KINDS, "roller-cam", ("springcad.kinds.roller_cam", "roller cam"))


def shipped(name: str, *overrides: str) -> Case:
    """A shipped spec read by the real reader, with overrides as on the command line."""
    return case_of(read_spec(SPECS / f"roller-{name}.yaml", overrides).model)


def refusal(name: str, *overrides: str) -> InfeasibleError:
    with pytest.raises(InfeasibleError) as refused:
        require_feasible(shipped(name, *overrides))
    return refused.value


def with_remedy(remedy: str, name: str, *overrides: str) -> Case:
    """The spec after the change that a remedy names, by its own text."""
    changes, share = [], 1.0
    for part in remedy.split(" and "):
        turn = re.fullmatch(
            r"(?:raise|lower) (.+) from \S+ to (?:[≥≤] )?(\S+) (\S+)(?: \(.*\))?", part
        )
        assert turn, part
        if turn[1].startswith("all torques"):
            share = float(turn[2]) / 100.0
        else:
            changes.append(f"{turn[1]}={turn[2]} {turn[3]}")
    case = shipped(name, *overrides, *changes)
    return replace(case, law=replace(case, torque_share=share).wanted)


def test_the_tip_stiffness_of_paper_001() -> None:
    """1418 N/mm in bending (1400 in the paper, 1.5 %), 1375.17 N/mm with shear."""
    beam = shipped("paper").joint.cantilever
    assert beam.tip_stiffness == pytest.approx(1418.094e3, rel=1e-6)
    assert beam.tip_stiffness == pytest.approx(1400e3, rel=0.015)
    assert tip_stiffness(beam) == pytest.approx(1375.17e3, rel=1e-4)


def test_oracle_a04_of_paper_001() -> None:
    """The arm that the energy asks of bending alone: 24.0746 mm, at the full deflection."""
    case = shipped("paper")
    arms = required_arm(
        case.law.torque(case.angle),
        case.law.energy(case.angle),
        case.joint.cantilever.tip_stiffness,
    )
    assert arms.max() == pytest.approx(24.0746e-3, rel=1e-4)
    assert arms.argmax() == len(arms) - 1


def test_the_estimate_of_the_stress_is_that_of_oracle_a10() -> None:
    case, end = shipped("paper"), 1.9 * DEGREE
    torque, energy = (
        float(curve(np.array([end]))[0]) for curve in (case.law.torque, case.law.energy)
    )
    assert end_stress(case.joint, end, torque, energy) == pytest.approx(769.187e6, rel=1e-4)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_shipped_spec_is_feasible(name: str) -> None:
    assert all(claim.status == "pass" for claim in require_feasible(shipped(name)))


@pytest.mark.parametrize("radius", [25e-3, 30e-3, 60e-3])
def test_the_least_drum_radius_is_where_profiles_begin_to_exist(radius: float) -> None:
    """With a hair more than the closed form's limit one is long enough, with less there is none."""
    case = shipped("paper")
    stiffer = replace(
        case.joint.cantilever,
        length=case.joint.cantilever.length * (24e-3 / radius) ** -0.6,
    )
    case = replace(case, joint=replace(case.joint, cantilever=stiffer))
    limit = {claim.name.partition(",")[0]: claim for claim in feasibility_checks(case)}[
        "drum radius"
    ].limit
    # the closed form counts shear, which the linear beam of this synthesis does not
    limit_bending = limit * np.sqrt(tip_stiffness(stiffer) / stiffer.tip_stiffness)
    for factor, exists in ((1.002, True), (0.998, False)):
        roller = replace(case.joint.roller, drum_radius=factor * limit_bending)
        joint = replace(case.joint, roller=roller)
        if exists:
            synthesise(joint, case.law, beam=linear_tip, overruns=(LEAST_OVERRUN,))
        else:
            with pytest.raises(InfeasibleError, match=r"energy|slope"):
                synthesise(joint, case.law, beam=linear_tip, overruns=(LEAST_OVERRUN,))


INFEASIBLE = {
    "stress beyond yield": ("paper", ["material.design_stress=1400 MPa"], "design stress"),
    "law without torque at first": (
        "linear",
        ["target.law={stiffness: {table: [[0 deg, 0 N*m/rad], [1 deg, 0 N*m/rad], "
         "[2 deg, 500 N*m/rad]]}}"],
        "torque of the law",
    ),
    "hump": (
        "linear",
        ["target.law={polynomial: [4 N*m/deg, -1.2 N*m/deg^2]}"],
        "stiffness of the law, least at 1.9 deg",
    ),
    "energy": ("paper", ["joint.drum_radius=24 mm"], "drum radius, for the energy at 1.957 deg"),
    "slope": (
        "linear",
        ["target.law={exponential: {scale: 400 N*m, decade: 25 deg}}", "joint.drum_radius=39 mm"],
        "drum radius",
    ),
    "stress": ("linear", ["target.law.linear=6.19 N*m/deg"], "bending stress"),
    "clearance": ("paper", ["joint.roller_offset=7.9 mm"], "gap between roller and cantilever"),
}  # fmt: skip
WITHOUT_CURE = ("law without torque at first", "slope")
"""For lack of one: the law itself must change."""


@pytest.mark.parametrize(("name", "overrides", "claim"), INFEASIBLE.values(), ids=INFEASIBLE.keys())
def test_the_first_broken_condition_is_told_with_angle_value_and_limit(
    name: str, overrides: list[str], claim: str
) -> None:
    error = refusal(name, *overrides)
    assert error.claim.startswith(claim)
    assert np.isfinite([error.value, error.limit]).all()


@pytest.mark.parametrize(
    ("name", "overrides", "claim"),
    [case for key, case in INFEASIBLE.items() if key not in WITHOUT_CURE],
)
def test_every_remedy_makes_the_spec_feasible_as_printed(
    name: str, overrides: list[str], claim: str
) -> None:
    """The remedy's own text, put into the real spec, passes the real reader and every check."""
    remedies = refusal(name, *overrides).remedies
    assert remedies
    for remedy in remedies:
        require_feasible(with_remedy(remedy, name, *overrides))


def test_a_design_stress_above_yield_is_not_laid_to_the_law() -> None:
    """Lowered to yield, the stress is above it in its turn: no number alone helps."""
    refused = refusal("paper", "material.name=en-aw-2014", "material.design_stress=250 MPa")
    assert refused.claim.startswith("design stress against yield")
    (remedy,) = refused.remedies
    assert "material.design_stress" in remedy
    assert "target.law" not in remedy


def test_the_energy_that_is_missing_is_told() -> None:
    """At 1.03 of the deflection: the profile must go on beyond the strip at full stroke."""
    claim = refusal("paper", "joint.drum_radius=24 mm").claim
    decades = 1.03 * 1.9
    stored = 150.0 * DEGREE * ((10.0**decades - 1.0) / np.log(10.0) - decades)
    arm = 24.0 * np.cos(decades * DEGREE) - 4.0 * np.sin(decades * DEGREE)
    force = 150.0 * (10.0**decades - 1.0) / arm
    assert f"law stores {stored:.4g} N*mm there" in claim
    needed = force**2 / (2.0 * 1375.17)
    assert f"needs at least {needed:.4g} N*mm in a cantilever with k = 1375 N/mm" in claim


HOSTILE = [
    "polynomial: [1e-300 N*m/rad, 1e-300 N*m/rad^2]",
    "polynomial: [1e40 N*m/rad, 1e40 N*m/rad^2]",
    "polynomial: [0 N*m/rad, 0 N*m/rad^2, 0 N*m/rad^3]",
    "polynomial: [0 N*m/rad, 0 N*m/rad^2, 0 N*m/rad^3, 0 N*m/rad^4, 0 N*m/rad^5, 9e9 N*m/rad^6]",
    "exponential: {scale: 1e6 N*m, decade: 0.16 deg}",
    "exponential: {scale: 1e-9 N*m, decade: 1000 deg}",
    "linear: 1e9 N*m/rad",
    "table: [[0 deg, 0 N*m], [0.00001 deg, 1e6 N*m], [2 deg, 1e6 N*m]]",
    "table: [[0 deg, 0 N*m], [1.99999 deg, 1e-12 N*m], [2 deg, 1e6 N*m]]",
    "stiffness: {table: [[0 deg, 0 N*m/rad], [2 deg, 0 N*m/rad]]}",
]


@pytest.mark.parametrize("law", HOSTILE)
def test_extreme_numbers_end_in_a_verdict(law: str) -> None:
    """Without overflow, division by zero or nan slipping through: warnings are errors here."""
    checks = feasibility_checks(shipped("linear", f"target.law={{{law}}}"))
    assert all(claim.status != "pass" or np.isfinite(claim.value) for claim in checks)


def test_the_remedies_for_too_small_a_drum_are_those_one_would_think_of() -> None:
    remedies = refusal("paper", "joint.drum_radius=24 mm").remedies
    assert any(
        remedy.startswith("raise joint.drum_radius from 24 to ≥ 28.3 mm") for remedy in remedies
    )
    assert any(remedy.startswith("raise cantilever.height from 4.9") for remedy in remedies)


def test_a_law_that_is_stiffer_at_rest_than_the_cantilever_is_refused() -> None:
    """k R² is 2200 N*m/rad."""
    claims = {
        claim.name: claim
        for claim in feasibility_checks(shipped("linear", "target.law.linear=40 N*m/deg"))
    }
    slope = claims["stiffness of the law at rest, 0 deg"]
    assert (slope.status, slope.unit) == ("fail", "N*m/rad")
    assert slope.value == pytest.approx(2291.8, rel=1e-4)
    assert slope.limit == pytest.approx(1375.17e3 * 40e-3**2, rel=1e-4)


def test_a_cantilever_to_be_sized_is_judged_at_its_stiffest() -> None:
    overrides = [
        "cantilever.length=[23 mm, 25 mm]",
        "cantilever.height=[3 mm, 5 mm]",
        "envelope.thickness=[3 mm, 3.5 mm]",
        "cantilever.objective=max_stiffness",
    ]
    case = shipped("paper", *overrides)
    beam = case.joint.cantilever
    assert (beam.length, beam.height, beam.width) == (23e-3, 5e-3, 3.5e-3)
    assert beam.tip_stiffness == pytest.approx(1851.8e3, rel=1e-4)
    assert not any("stress (estimate)" in claim.name for claim in require_feasible(case))


def test_checks_take_no_time() -> None:
    case = shipped("paper", "joint.drum_radius=24 mm")
    start = time.perf_counter()
    feasibility_checks(case)
    assert time.perf_counter() - start < 1.0


STEP = (
    "target.law={table: [[0 deg, 0 N*m], [0.8 deg, 0.8 N*m], [1 deg, 2.4 N*m], [1.4 deg, 2.8 N*m], "
    "[1.9 deg, 3.8 N*m]]}"
)


def test_a_fold_is_cured_by_numbers_that_were_tried() -> None:
    case = shipped("linear", STEP)
    require_feasible(case)
    with pytest.raises(InfeasibleError, match="folds back"):
        synthesise(case.joint, case.law, beam=linear_tip)
    remedies = synthesis_remedies(case)
    assert remedies
    for remedy in remedies:
        cured = with_remedy(remedy, "linear", STEP)
        synthesise(cured.joint, cured.law, beam=linear_tip)


def test_a_profile_with_too_much_stress_is_cured_by_numbers_that_were_tried() -> None:
    overrides = ["target.law.linear=6.19 N*m/deg"]
    case = shipped("linear", *overrides)
    remedies = synthesis_remedies(case, within_stress(case))
    assert remedies
    for remedy in remedies:
        cured = with_remedy(remedy, "linear", *overrides)
        profile = synthesise(cured.joint, cured.law, beam=linear_tip)
        assert within_stress(cured)(profile)
