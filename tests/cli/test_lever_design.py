"""Lever arms as a user designs them: stiffness met, drawing read back, leaf judged by elements."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
SPECS = ROOT / "specs"
FEW = ("--set", "optimiser.starts=3")


def designed(run_springcad, name: str, *options: str) -> dict:
    run = run_springcad("design", SPECS / f"lever-{name}.yaml", "--json", *options)
    assert run.returncode == 0, run.stderr + run.stdout[:2000]
    return json.loads(run.stdout)


def statuses(report: dict) -> dict[str, str]:
    return {check["name"]: check["status"] for check in report["checks"]}


@pytest.fixture(scope="module")
def straight(tmp_path_factory: pytest.TempPathFactory) -> dict:
    """The parabola and the triangle, from one run."""
    import subprocess
    import sys

    folder = tmp_path_factory.mktemp("straight")
    names = ("parabolic", "triangular")
    paths = [SPECS / f"lever-{name}.yaml" for name in names]
    subprocess.run(
        [sys.executable, "-m", "springcad", "design", *paths, "-o", folder], check=True,
        capture_output=True,
    )  # fmt: skip
    return {
        name: json.loads((folder / f"lever-{name}" / "report.json").read_text()) for name in names
    }


@pytest.mark.parametrize("name", ["parabolic", "triangular"])
def test_a_straight_leaf_passes_every_check_and_is_judged(straight, name: str):
    report = straight[name]
    found = statuses(report)
    assert set(found.values()) == {"pass"}
    judged = [check for check in found if check.startswith("second opinion")]
    assert len(judged) == (4 if name == "parabolic" else 3)
    design, response = report["design"], report["response"]
    force, energy = np.array(response["force_N"]), np.array(response["spring_energy_J"])
    deflection = np.array(response["deflection_m"])
    assert force == pytest.approx(-force[::-1], rel=1e-9)
    assert energy[-1] == pytest.approx(0.5 * force[-1] * deflection[-1], rel=0.02)
    assert design["width_m"] > 0.0


def test_the_joint_of_the_paper_with_a_parabola(straight):
    """85 N/mm at 10 mm: 4.25 J, 382 N m at q = 5 mm, 3874 N m/rad behind 5000 in series."""
    response = straight["parabolic"]["response"]
    assert response["spring_stiffness_N_per_m"] == pytest.approx(85e3, rel=1e-6)
    assert response["energy_J"] == pytest.approx(4.25, rel=0.02)
    assert response["pivot_m"][0] == pytest.approx(5e-3)
    assert response["end_torque_Nm"][0] == pytest.approx(
        2 * 4.25 / np.tan(np.arcsin(1 / 45)), rel=0.01
    )
    assert response["stiffness_at_rest_Nm_per_rad"][0] == pytest.approx(3874.5, rel=0.01)
    curve = response["curves"][0]
    work = np.trapezoid(curve["torque_Nm"][20:], curve["angle_rad"][20:])
    assert work == pytest.approx(curve["energy_J"][-1], rel=2e-3)


@pytest.mark.slow
def test_an_omega_leaf_from_spec_to_second_opinion(run_springcad):
    """Few starts: at least the 6.3 N/mm per mm of width that trials had found for steel."""
    report = designed(run_springcad, "steel", *FEW)
    assert "fail" not in statuses(report).values()
    judged = {name for name in statuses(report) if name.startswith("second opinion")}
    assert len(judged) == 4
    design, response = report["design"], report["response"]
    assert design["full_stiffness_per_width_N_per_m2"] > 6.3e6
    assert response["spring_stiffness_N_per_m"] == pytest.approx(85e3, rel=1e-4)
    assert min(response["self_gap_m"]) >= 0.999 * design["min_gap_m"]
    assert min(response["wall_gap_m"]) >= 0.999 * design["min_gap_m"]
    assert np.array(response["force_N"]) == pytest.approx(
        -np.array(response["force_N"])[::-1], rel=1e-6
    )
    search = design["search"]
    assert search["feasible"] == len(search["stiffness_per_width_of_searches_N_per_m2"])


def test_layers_that_do_not_do_are_refused_with_the_number_that_does(run_springcad):
    run = run_springcad("design", SPECS / "lever-parabolic.yaml", "--set", "leaf.layers=10")
    assert run.returncode == 4
    assert "to make it feasible: raise leaf.layers from 10 to 11" in run.stderr


def test_every_key_of_the_report_is_documented_and_none_else(straight):
    page = (ROOT / "docs/reference/lever-arm-report.md").read_text(encoding="utf-8")
    rows = re.compile(r"^\| `([^`]+)` \|", re.MULTILINE)
    parts = re.split(r"\nOnly for an omega leaf:\n|\n## response\n", page)
    documented = {key for part in (parts[0], parts[2]) for key in rows.findall(part)}
    report = straight["parabolic"]
    life = {"response.life_cycles", "response.life_note"}
    keys = {f"{part}.{key}" for part in ("design", "response") for key in report[part]} - life
    assert documented == keys
