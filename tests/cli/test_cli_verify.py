"""``springcad verify`` and ``design --no-verify``: a second opinion, and what it hangs on."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

SPEC = "springcad: 1\nkind: fake\nname: plate\nsize: 20 mm\nprocess: laser\nbehaviour: {}\n"


@pytest.fixture(scope="module")
def designs() -> dict[tuple[str, ...], Path]:
    """Behaviour and options → the folder of a design, each made once."""
    return {}


@pytest.fixture
def design(designs, tmp_path, tmp_path_factory, run_with_fake_kind):
    """``design("good")``: a copy of the folder of a design by the kind of fake_springcad.py."""

    def make(behaviour: str, *options: str) -> Path:
        key = (behaviour, *options)
        if key not in designs:
            folder = tmp_path_factory.mktemp("design")
            (folder / "plate.yaml").write_text(SPEC.format(behaviour), encoding="utf-8")
            run = run_with_fake_kind("design", "plate.yaml", "-o", "out", *options, cwd=folder)
            disagrees = behaviour == "disagree" and not options
            assert run.returncode == (5 if disagrees else 0), run.stderr
            designs[key] = folder / "out/plate"
        return shutil.copytree(designs[key], tmp_path / "out/plate", dirs_exist_ok=True)

    return make


def report(folder: Path) -> dict:
    return json.loads((folder / "report.json").read_text())


def test_design_forms_a_second_opinion_and_writes_it_down(design):
    entry = report(design("good"))["verification"]
    assert entry["method"] == "weighing"
    assert entry["plates"] == 1
    (area,) = entry["comparisons"]
    assert area["name"] == "area"
    assert area["size_m"] == [0.02]
    assert area["largest_difference"] < area["tolerance"] == 1e-3
    names = [check["name"] for check in report(design("good"))["checks"]]
    assert "second opinion: area" in names


def test_disagreement_is_a_failed_check_with_exit_code_5(design):
    found = {check["name"]: check for check in report(design("disagree"))["checks"]}
    assert found["second opinion: area"]["status"] == "fail"
    assert found["second opinion: area"]["value"] == pytest.approx(0.01, rel=1e-3)
    assert "two models disagree" in found["second opinion: area"]["remedy"]


def test_without_a_second_opinion_the_report_says_so(design):
    entry = report(design("disagree", "--no-verify"))
    assert entry["verification"] == {"method": None}
    assert not any("second opinion" in check["name"] for check in entry["checks"])
    assert any("--no-verify" in sentence for sentence in entry["assumptions"])


@pytest.mark.parametrize("options", [(), ("--no-verify",)])
def test_verify_says_the_same_as_the_design_did(design, run_with_fake_kind, options):
    folder = design("good", *options)
    run = run_with_fake_kind("verify", folder / "report.json", "--json")
    (entry,) = json.loads(run.stdout)
    assert (run.returncode, entry["exit_code"], entry["name"]) == (0, 0, "plate")
    if not options:
        assert entry["verification"] == report(folder)["verification"]


def test_verify_takes_the_folder_and_prints_tables(design, run_with_fake_kind):
    run = run_with_fake_kind("verify", design("good"))
    assert run.returncode == 0
    for words in ("plate: All 3 checks pass", "Second opinion: weighing", "The plate is flat."):
        assert words in run.stdout


def test_verify_returns_5_for_a_design_that_disagrees(design, run_with_fake_kind):
    run = run_with_fake_kind("verify", design("disagree", "--no-verify"))
    assert run.returncode == 5
    assert "1.00 %" in run.stdout


def test_a_file_that_was_changed_is_named(design, run_with_fake_kind):
    folder = design("good")
    with (folder / "plate.svg").open("a") as drawing:
        drawing.write("<!-- a note -->")
    run = run_with_fake_kind("verify", folder, "--json")
    (entry,) = json.loads(run.stdout)
    changed = entry["checks"][0]
    assert (changed["status"], changed["value"]) == ("warn", 1.0)
    assert "plate.svg" in changed["source"]


def test_a_drawing_that_was_changed_is_judged_as_it_is(design, run_with_fake_kind):
    folder = design("good")
    drawing = folder / "plate.dxf"
    drawing.write_text(drawing.read_text().replace("\n-10.0\n", "\n-10.1\n"))
    run = run_with_fake_kind("verify", folder)
    assert run.returncode == 5


def test_the_deck_is_written_beside_the_report(design, run_with_fake_kind):
    folder = design("good")
    run = run_with_fake_kind("verify", folder, "--deck")
    assert run.returncode == 0
    assert (folder / "plate-area.inp").read_text() == "** plate\n"
    assert "plate-area.inp" in run.stdout


DAMAGES = (
    (lambda folder: (folder / "report.json").unlink(), "there is no report.json"),
    (lambda folder: (folder / "manifest.json").unlink(), "there is no manifest.json"),
    (lambda folder: (folder / "plate.dxf").unlink(), "there is no such file"),
    (lambda folder: (folder / "plate.dxf").write_text("nothing"), "not a readable DXF"),
    (lambda folder: (folder / "report.json").write_text("{"), "not readable JSON"),
    (lambda folder: (folder / "report.json").write_text("[" * 10000), "not readable JSON"),
    (lambda folder: (folder / "report.json").write_text("[]"), "holds no JSON object"),
    (lambda folder: edit(folder, lambda r: r.pop("design")), "design is missing"),
    (lambda folder: edit(folder, lambda r: r["design"].pop("size_m")), "size_m is missing"),
    (lambda folder: edit(folder, lambda r: r["design"].update(size_m="2")), "not a number"),
    (lambda folder: edit(folder, lambda r: r.update(kind="nope")), "kind 'nope'"),
    (lambda folder: shutil.rmtree(folder), "there is no "),
)


def test_each_damaged_design_is_refused_in_one_line(design, run_with_fake_kind, tmp_path):
    good = design("good")
    folders = []
    for index, (damage, _) in enumerate(DAMAGES):
        folder = shutil.copytree(good, tmp_path / f"damaged-{index}")
        damage(folder)
        folders.append(folder)
    run = run_with_fake_kind("verify", *folders)
    assert run.returncode == 3
    told = run.stderr.splitlines()
    assert len(told) == len(DAMAGES)
    for (_, words), folder, line in zip(DAMAGES, folders, told, strict=True):
        assert folder.name in line
        assert words in line


def edit(folder: Path, change) -> None:
    entry = report(folder)
    change(entry)
    (folder / "report.json").write_text(json.dumps(entry))
