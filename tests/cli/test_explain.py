"""``springcad explain``: what goes where, the exit codes, and JSON for programs."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

SPECS = Path(__file__).parents[2] / "specs"
TRIANGLE, WRIST = SPECS / "lever-triangular.yaml", SPECS / "leaf2-design.yaml"


def test_sheets_of_several_specs_go_to_stdout_and_nothing_is_written(run_springcad, tmp_path):
    run = run_springcad("explain", TRIANGLE, WRIST)
    assert run.returncode == 0, run.stderr
    assert run.stderr == ""
    assert run.stdout.startswith("lever-triangular (lever-arm): calculation sheet\n")
    assert "\n\nleaf2-design (leaf-2dof): calculation sheet\n" in run.stdout
    assert run.stdout.count("give the value of the design again") == 2
    assert list(tmp_path.iterdir()) == []


def test_json_has_si_numbers_and_a_formula_that_a_program_can_evaluate(run_springcad):
    run = run_springcad("explain", TRIANGLE, "--json", "--set", "target.spring_deflection=7mm")
    assert run.returncode == 0, run.stderr
    sheet = json.loads(run.stdout)
    steps = {step["symbol"]: step for section in sheet["sections"] for step in section["steps"]}
    assert (sheet["kind"], sheet["exit_code"]) == ("lever-arm", 0)
    assert steps["s_max"]["value"] == 0.007
    assert steps["s_max"]["formula"] == ""
    assert steps["h_cf"]["formula"] == "2*c*L**2*sigma_d/(E*s_max)"
    L, sigma, E = (steps[symbol]["value"] for symbol in ("L", "sigma_d", "E"))
    by_hand = 2 * 0.5 * L**2 * sigma / (E * 0.007)
    assert steps["h_cf"]["value"] == pytest.approx(by_hand, rel=1e-9)
    assert all(step["agrees"] for step in steps.values() if step["formula"])
    assert {check["status"] for check in sheet["checks"]} <= {"pass", "warn"}


def test_a_refused_design_is_4_with_closed_forms_on_stdout_and_the_reason_on_stderr(run_springcad):
    run = run_springcad("explain", WRIST, "--set", "target.deflection=30 deg")
    assert run.returncode == 4
    assert "Closed forms at the longest length" in run.stdout
    assert "Exact unit" not in run.stdout
    assert "FAIL" in run.stdout
    assert "no feasible design" in run.stderr
    assert "to make it feasible" in run.stderr


def test_a_refused_design_in_json_has_sheet_and_error(run_springcad):
    run = run_springcad("explain", WRIST, TRIANGLE, "--json", "--set", "name=x")
    assert run.returncode == 3  # two specs of one name
    run = run_springcad("explain", WRIST, "--json", "--set", "target.deflection=30 deg")
    assert run.returncode == 4
    sheet = json.loads(run.stdout)
    assert sheet["sections"]
    assert sheet["error"]["value"] < sheet["error"]["limit"] == 0.0  # its torque would fall
    assert sheet["error"]["remedies"]


def test_a_bad_spec_is_3_and_does_not_stop_the_others(run_springcad, tmp_path):
    bad = tmp_path / "bad.yaml"
    text = TRIANGLE.read_text().replace("length: 70 mm", "length: 70")
    bad.write_text(text.replace("lever-triangular", "bad"))
    run = run_springcad("explain", bad, TRIANGLE)
    assert run.returncode == 3
    assert "bad.yaml:7:" in run.stderr
    assert "needs a unit" in run.stderr
    assert run.stdout.startswith("lever-triangular (lever-arm)")


def test_a_failed_check_is_5(run_springcad):
    life = "{cycles: 1e5, reliability: 0.9, histogram: [[1, 9e5]]}"
    run = run_springcad("explain", TRIANGLE, "--set", f"material={{name: 51crv4, life: {life}}}")
    assert run.returncode == 5, run.stderr
    assert "Miner's sum of the histogram" in run.stdout
    assert "FAIL" in run.stdout
