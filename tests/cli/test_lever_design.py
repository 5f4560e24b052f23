"""Lever arms as a user designs them: stiffness met, drawing read back, leaf judged by elements."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from springcad.cli.run import run
from springcad.kinds.lever_arm import judge_decks, omega_search
from springcad.mechanics.fem.deck import SLICE
from springcad.verify.read_design import read_design

ROOT = Path(__file__).parents[2]
SPECS = ROOT / "specs"


def statuses(report: dict) -> dict[str, str]:
    return {check["name"]: check["status"] for check in report["checks"]}


@pytest.fixture(scope="module")
def straight_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The parabola and the triangle, from one run."""
    folder = tmp_path_factory.mktemp("straight")
    names = ("parabolic", "triangular")
    paths = [str(SPECS / f"lever-{name}.yaml") for name in names]
    assert run(["design", *paths, "-o", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def straight(straight_folder: Path) -> dict:
    return {
        name: json.loads((straight_folder / f"lever-{name}" / "report.json").read_text())
        for name in ("parabolic", "triangular")
    }


@pytest.mark.parametrize("name", ["parabolic", "triangular"])
def test_a_straight_leaf_passes_every_check_and_is_judged(straight, name: str):
    report = straight[name]
    found = statuses(report)
    assert set(found.values()) == {"pass"}
    judged = [check for check in found if check.startswith("second opinion")]
    assert len(judged) == (5 if name == "parabolic" else 4)
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


@pytest.fixture(scope="module")
def omega_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The POM leaf, bent to one side; a search without restarts, to save time."""
    folder = tmp_path_factory.mktemp("omega")
    few = ("--set", "optimiser={starts: 2, seed: 1}", "--set", "leaf.topology=omega")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(omega_search, "RESTARTED", 0)
        patch.setattr(omega_search, "FINISHED", 1)
        assert run(["design", str(SPECS / "lever-pom.yaml"), "-o", str(folder), *few]) == 0
    return folder / "lever-pom"


@pytest.fixture(scope="module")
def omega(omega_folder: Path) -> dict:
    return json.loads((omega_folder / "report.json").read_text())


@pytest.mark.slow
def test_an_omega_leaf_from_spec_to_second_opinion(omega):
    """At least the 5.2 N/mm per mm of width that trials had found for POM."""
    found = statuses(omega)
    assert "fail" not in found.values()
    assert [name for name, status in found.items() if status == "warn"] == ["strain at the edge"]
    assert len([name for name in found if name.startswith("second opinion")]) == 4
    design, response = omega["design"], omega["response"]
    assert design["full_stiffness_per_width_N_per_m2"] > 5.2e6
    assert response["spring_stiffness_N_per_m"] == pytest.approx(150e3, rel=1e-4)
    assert min(response["self_gap_m"]) >= 0.999 * design["min_gap_m"]
    assert min(response["wall_gap_m"]) >= 0.999 * design["min_gap_m"]
    assert np.array(response["force_N"]) == pytest.approx(
        -np.array(response["force_N"])[::-1], rel=1e-6
    )
    search = design["search"]
    assert search["feasible"] == len(search["stiffness_per_width_of_searches_N_per_m2"])


def test_layers_that_do_not_do_are_refused_with_the_number_that_does(run_springcad):
    done = run_springcad("design", SPECS / "lever-parabolic.yaml", "--set", "leaf.layers=10")
    assert done.returncode == 4
    assert "to make it feasible: raise leaf.layers from 10 to 11" in done.stderr


KEY = re.compile(r"^\| `([^`]+)` \|", re.MULTILINE)


def assert_documented(report: dict, shape: str) -> None:
    """Keys of the report and rows of the page that are of every shape or of this one."""
    page = (ROOT / "docs/reference/lever-arm-report.md").read_text(encoding="utf-8")
    documented: set[str] = set()
    for part in re.split(r"\n(?=## |Only for )", page):
        if not part.startswith("Only for") or part.startswith(f"Only for {shape}:"):
            documented |= set(KEY.findall(part))
    found = {f"{part}.{key}" for part in ("design", "response") for key in report[part]}
    assert found == documented


def test_every_key_of_a_straight_leaf_is_documented_and_none_else(straight):
    assert_documented(straight["parabolic"], "a straight leaf")


@pytest.mark.slow
def test_every_key_of_an_omega_leaf_is_documented_and_none_else(omega):
    assert_documented(omega, "an omega leaf")


@pytest.mark.slow
def test_the_decks_of_an_omega_leaf_are_its_halves(omega_folder: Path, omega):
    """The force that their comments state, of a slice of one leaf, is that of the report."""
    design, _ = read_design(omega_folder)
    decks = judge_decks(design)
    assert set(decks) == {"right-half", "left-half"}
    (row,) = re.findall(r"^\*\* +2 +10 +(\S+) +(\S+)$", decks["right-half"], re.MULTILINE)
    force = float(row[1]) * omega["design"]["width_m"] / SLICE
    assert force == pytest.approx(omega["response"]["force_N"][-1], rel=0.02)


def test_a_triangle_has_a_deck_with_a_section_for_each_width(capsys, straight_folder: Path):
    assert run(["verify", str(straight_folder / "lever-triangular"), "--deck"]) == 0
    assert "lever-triangular-leaf.inp" in capsys.readouterr().out
    deck = (straight_folder / "lever-triangular" / "lever-triangular-leaf.inp").read_text()
    assert deck.upper().count("*SOLID SECTION") > 10


def test_a_drawing_of_another_leaf_is_found_out(capsys, straight_folder: Path, tmp_path: Path):
    """The triangle's width comes from the report; it must be that of the drawing."""
    folder = shutil.copytree(straight_folder / "lever-triangular", tmp_path / "lever-triangular")
    report = json.loads((folder / "report.json").read_text())
    report["design"]["leaf"]["width_m"] *= 1.01
    (folder / "report.json").write_text(json.dumps(report))
    assert run(["verify", str(folder), "--json"]) == 5
    (entry,) = json.loads(capsys.readouterr().out)
    assert statuses(entry)["second opinion: its leaf against the drawing"] == "fail"
