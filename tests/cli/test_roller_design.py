"""Roller cams as a user designs them: law met, drawing read back, judged by finite elements."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
SPECS = ROOT / "specs"
NAMES = ("roller-paper", "roller-linear", "roller-quadratic", "roller-table", "roller-stiffness")


@pytest.fixture(scope="module")
def designed(tmp_path_factory) -> Callable[..., dict]:
    """``designed(name, options…)``: the report of a real process, each made once."""
    folder = tmp_path_factory.mktemp("designs")

    @cache
    def report(name: str, *options: str) -> dict:
        command = [sys.executable, "-m", "springcad", "design", SPECS / f"{name}.yaml", "--json"]
        run = subprocess.run([*command, *options], cwd=folder, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr + run.stdout[:2000]
        return json.loads(run.stdout)

    return report


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_every_shipped_joint_follows_its_law_and_is_judged_to_do_so(designed, name: str):
    report = designed(name)
    response = report["response"]
    torque, law = (np.array(response[f"{key}_torque_Nm"]) for key in ("group", "law"))
    assert np.abs(torque - law).max() < 3e-3 * law.max()
    assert response["torque_error"] < 3e-3
    statuses = {check["name"]: check["status"] for check in report["checks"]}
    judged = {name: status for name, status in statuses.items() if name.startswith("second")}
    assert len(judged) == 8
    assert set(judged.values()) == {"pass"}
    assert "fail" not in statuses.values()


def test_the_joint_of_the_paper(designed):
    """Three groups of 12 N m (11.765 by the law), at 769 MPa by the linear beam."""
    report = designed("roller-paper")
    response, design = report["response"], report["design"]
    assert response["max_torque_Nm"] == pytest.approx(3 * 11.765, rel=2e-3)
    assert response["energy_J"] == pytest.approx(3 * 0.0842024, rel=5e-3)
    assert response["peak_nominal_stress_Pa"] == pytest.approx(769e6, rel=0.03)
    assert design["tip_stiffness_N_per_m"] == pytest.approx(1418.094e3, rel=1e-6)
    # Not compensated it would miss the law by what the paper found, 15 to 29 %, at small angles.
    errors = design["torque_errors_of_updates"]
    assert 0.1 < errors[0] < 0.3
    assert errors[-1] < 1e-3
    # The paper's iteration in its sound form ends nanometres from the energy balance.
    assert design["stepwise_distance_m"] < 2e-8


def test_a_drum_that_is_too_small_is_refused_with_the_radius_that_will_do(run_springcad):
    run = run_springcad("design", SPECS / "roller-paper.yaml", "--set", "joint.drum_radius=23.5 mm")
    assert run.returncode == 4
    assert "no feasible design" in run.stderr
    assert re.search(r"raise joint\.drum_radius (from \S+ )?to ", run.stderr)


@pytest.mark.slow
def test_a_law_that_leaves_the_roller_clear_at_rest_is_judged_too(designed):
    """With the cube of the angle the mirrored element has the place of the first contacts."""
    law = "[0 N*m/deg, 0 N*m/deg^2, 3.4 N*m/deg^3]"
    report = designed("roller-quadratic", "--set", f"target.law.polynomial={law}")
    response = report["response"]
    assert response["contact_angle_rad"][0] is None
    assert response["roller_force_N"][0] == 0.0
    assert response["first_contact_angle_rad"] > np.radians(0.1)
    judged = [check for check in report["checks"] if check["name"].startswith("second")]
    assert len(judged) == 8
    assert {check["status"] for check in judged} == {"pass"}


def test_a_profile_that_few_steps_spoil_is_laid_to_the_steps(run_springcad):
    few = ("method=stepwise", "compensation=none", "stepwise={steps: 19, form: printed}")
    options = [word for each in few for word in ("--set", each)]
    run = run_springcad("design", SPECS / "roller-paper.yaml", "--no-verify", *options)
    assert run.returncode == 4
    assert "on the profile of 19 steps" in run.stderr
    assert "raise stepwise.steps" in run.stderr
    assert "drum_radius" not in run.stderr


@pytest.mark.slow
def test_a_strip_too_wide_for_the_contact_part_is_told_and_not_taken_for_disagreement(designed):
    """0.5 mm behind the profile; at full stroke the strip is 0.7 mm long."""
    report = designed("roller-paper", "--set", "contact_part.thickness=0.5 mm")
    checks = {check["name"]: check for check in report["checks"]}
    untold = checks["second opinion: angles at which it cannot tell the pressure"]
    assert (untold["value"], untold["status"]) == (1.0, "warn")
    assert checks["second opinion: contact pressure"]["status"] == "pass"


def test_friction_opens_a_loop(designed):
    report = designed("roller-linear", "--set", "friction=0.05", "--no-verify")
    loading, unloading = (
        np.array(report["response"][f"{key}_torque_Nm"]) for key in ("loading", "unloading")
    )
    assert np.all(loading[1:] > unloading[1:])
    assert 0.0 < report["response"]["hysteresis_share"] < 0.5


def test_every_key_of_the_report_is_documented_and_none_else(designed):
    page = (ROOT / "docs/reference/roller-cam-report.md").read_text(encoding="utf-8")
    always, with_friction = page.split("\nOnly with `friction`")
    row = re.compile(r"^\| `([^`]+)` \|", re.MULTILINE)
    plain = designed("roller-linear")
    rubbing = designed("roller-linear", "--set", "friction=0.05", "--no-verify")

    def keys(report: dict) -> set[str]:
        return {f"{part}.{key}" for part in ("design", "response") for key in report[part]}

    assert set(row.findall(always)) == keys(plain)
    assert set(row.findall(with_friction)) == keys(rubbing) - keys(plain)
