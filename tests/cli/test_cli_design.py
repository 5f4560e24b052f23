"""What comes out of `springcad design` and `check`: files, text, exit codes. With a fake kind."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from springcad.cli.failures import worst

Run = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture
def springcad(run_with_fake_kind: Run) -> Run:
    return run_with_fake_kind


def write_spec(folder: Path, name: str, behaviour: str = "good", size: str = "20 mm") -> str:
    """A spec of the fake kind in ``folder``/NAME.yaml; its file name."""
    text = f"springcad: 1\nkind: fake\nname: {name}\nsize: {size}\nprocess: laser\n"
    (folder / f"{name}.yaml").write_text(f"{text}behaviour: {behaviour}\n")
    return f"{name}.yaml"


def contents(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_a_design_writes_its_files_and_tells_about_them(springcad: Run, tmp_path: Path) -> None:
    run = springcad("design", write_spec(tmp_path, "knee"), "-o", "out")
    assert (run.returncode, run.stderr) == (0, "")
    files = contents(tmp_path / "out")
    names = ["knee.dxf", "knee.svg", "manifest.json", "report.html", "report.json"]
    assert list(files) == [f"knee/{name}" for name in names]
    assert all(name in run.stdout for name in names)


def test_the_manifest_vouches_for_every_other_file(springcad: Run, tmp_path: Path) -> None:
    springcad("design", write_spec(tmp_path, "knee"), "-o", "out")
    files = contents(tmp_path / "out" / "knee")
    manifest = json.loads(files.pop("manifest.json"))
    hashes = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    assert manifest["files"] == hashes
    assert (manifest["kind"], manifest["name"]) == ("fake", "knee")
    assert re.fullmatch("[0-9a-f]{64}", manifest["spec_sha256"])
    assert str(tmp_path) not in json.dumps(manifest)


def test_the_drawing_is_read_back_and_the_report_says_so(springcad: Run, tmp_path: Path) -> None:
    run = springcad("design", write_spec(tmp_path, "knee"), "--json")
    report = json.loads(run.stdout)
    assert run.stdout == (tmp_path / "out/knee/report.json").read_text(encoding="utf-8")
    read_back = [check for check in report["checks"] if check["name"].startswith("plate drawing: ")]
    assert len(read_back) >= 2
    assert {check["status"] for check in read_back} == {"pass"}


def test_set_replaces_a_value(springcad: Run, tmp_path: Path) -> None:
    spec = write_spec(tmp_path, "knee")
    run = springcad("design", spec, "--set", "size=30mm", "--set", "name=ankle", "--json")
    report = json.loads(run.stdout)
    assert (report["name"], report["design"]["size_m"]) == ("ankle", 0.03)
    assert (tmp_path / "out/ankle/ankle.dxf").exists()


def test_a_failed_check_is_5_and_written(springcad: Run, tmp_path: Path) -> None:
    run = springcad("design", write_spec(tmp_path, "knee", "fail"))
    assert (run.returncode, run.stderr) == (5, "")
    assert (tmp_path / "out/knee/manifest.json").exists()


def test_strict_counts_a_warning_as_a_failure(springcad: Run, tmp_path: Path) -> None:
    spec = write_spec(tmp_path, "knee", "warn")
    assert springcad("design", spec).returncode == 0
    assert springcad("design", spec, "--strict").returncode == 5


def test_a_spec_error_is_3_with_file_line_and_column(springcad: Run, tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(
        "springcad: 1\nkind: fake\nname: a\nsiez: 20 mm\nsize: 20 mm\nprocess: lasr\n"
    )
    run = springcad("design", "a.yaml")
    assert (run.returncode, run.stdout) == (3, "")
    assert run.stderr.splitlines() == [
        "a.yaml:4:1: siez: unknown key; did you mean size?",
        "a.yaml:6:10: process: unknown process lasr; did you mean laser?",
    ]
    assert not (tmp_path / "out").exists()


def test_the_same_as_annotations_for_github(springcad: Run, tmp_path: Path) -> None:
    (tmp_path / "a,b.yaml").write_text("springcad: 1\nkind: fake\nname: a\nsiez: 1\n")
    for command in ("design", "check"):
        run = springcad(command, "a,b.yaml", "--format", "github")
        assert run.returncode == 3
        assert (
            "::error file=a%2Cb.yaml,line=4,col=1::siez: unknown key; did you mean size?"
            in run.stderr.splitlines()
        )
        assert all(line.startswith("::error ") for line in run.stderr.splitlines())


def test_no_feasible_design_is_4_with_limit_value_and_remedy(
    springcad: Run, tmp_path: Path
) -> None:
    spec = write_spec(tmp_path, "knee")
    springcad("design", spec)
    before = contents(tmp_path / "out")
    run = springcad("design", spec, "--set", "behaviour=infeasible")
    assert (run.returncode, run.stdout) == (4, "")
    assert run.stderr.splitlines() == [
        "knee.yaml: no feasible design: size: 40.00 mm, limit 20.00 mm",
        "  to make it feasible: lower size to 10 mm",
    ]
    assert contents(tmp_path / "out") == before


def test_a_bug_is_1_in_one_line_with_a_log(springcad: Run, tmp_path: Path) -> None:
    run = springcad("design", write_spec(tmp_path, "knee", "bug"), env={"TMPDIR": str(tmp_path)})
    assert (run.returncode, run.stdout) == (1, "")
    (line,) = run.stderr.splitlines()
    message = "internal error (a bug): RuntimeError: [bold]unforeseen[/bold] in knee"
    assert line.startswith(f"knee.yaml: {message}; details in {tmp_path}")
    log = Path(line.rpartition(" ")[2]).read_text()
    assert log.startswith("Traceback")
    assert not (tmp_path / "out").exists()


def test_one_bad_spec_does_not_stop_the_others(springcad: Run, tmp_path: Path) -> None:
    specs = tmp_path / "specs"
    specs.mkdir()
    write_spec(specs, "a")
    write_spec(specs, "b", "infeasible")
    write_spec(specs, "d", "fail")
    write_spec(specs, "e", "bug")
    write_spec(specs, ".hidden", "bug")
    (specs / "c.yml").write_text("springcad: 2\n")
    (specs / "notes.txt").write_text("not a spec")
    (specs / "inner").mkdir()
    write_spec(specs / "inner", "f", "bug")
    run = springcad("design", "specs", "-o", "out")
    assert run.returncode == 1
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["a", "d"]
    table = run.stdout[run.stdout.rindex("exit code") :].splitlines()[2:]
    codes = {line.split()[0]: re.search(r" ([0-9])  ", line) for line in table}
    assert {name: int(match[1]) for name, match in codes.items() if match} == {
        "specs/a.yaml": 0,
        "specs/b.yaml": 4,
        "specs/c.yml": 3,
        "specs/d.yaml": 5,
        "specs/e.yaml": 1,
    }


@pytest.mark.parametrize(
    ("exit_codes", "expected"),
    [([], 0), ([0, 0], 0), ([0, 3, 0], 3), ([5, 4], 5), ([3, 6, 5], 6), ([6, 1, 4], 1)],
)
def test_of_several_the_highest_code_counts_and_a_bug_above_all(
    exit_codes: list[int], expected: int
) -> None:
    assert worst(exit_codes) == expected


@pytest.mark.parametrize("second", ["knee", "KNEE"])
def test_two_specs_of_one_name_are_refused_before_anything_is_written_for_the_second(
    springcad: Run, tmp_path: Path, second: str
) -> None:
    (tmp_path / "more").mkdir()
    first = write_spec(tmp_path, "knee")
    other = f"more/{write_spec(tmp_path / 'more', second, size='30 mm')}"
    run = springcad("design", first, other)
    assert run.returncode == 3
    assert run.stderr == (
        f"{other}:3:7: name: {second} is taken by {first};"
        " names must differ in more than the case\n"
    )
    report = json.loads((tmp_path / "out/knee/report.json").read_text(encoding="utf-8"))
    assert report["design"]["size_m"] == 0.02
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["knee"]


def test_a_spec_that_is_named_twice_is_designed_once(springcad: Run, tmp_path: Path) -> None:
    spec = write_spec(tmp_path, "knee")
    run = springcad("design", spec, ".", "--json")
    assert run.returncode == 0
    assert [entry["name"] for entry in json.loads(run.stdout)] == ["knee"]


def test_a_folder_without_specs_and_a_missing_file_are_3(springcad: Run, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    run = springcad("design", "empty", "nowhere.yaml")
    assert run.returncode == 3
    first, second = run.stderr.splitlines()
    assert first == "empty:1:1: no *.yaml or *.yml file in this folder"
    assert second.startswith("nowhere.yaml:1:1: cannot be read")


def test_json_of_several_holds_reports_and_errors(springcad: Run, tmp_path: Path) -> None:
    write_spec(tmp_path, "a")
    write_spec(tmp_path, "b", "infeasible")
    (tmp_path / "c.yaml").write_text("[")
    run = springcad("design", ".", "--json")
    good, infeasible, invalid = json.loads(run.stdout)
    assert (good["exit_code"], good["report"]["name"]) == (0, "a")
    assert good["files"][0] == "out/a/a.dxf"
    assert infeasible["exit_code"] == 4
    assert infeasible["error"] == {
        "claim": "size",
        "value": 0.04,
        "limit": 0.02,
        "unit": "m",
        "remedies": ["lower size to 10 mm"],
    }
    assert invalid["exit_code"] == 3
    assert invalid["error"]["problems"][0]["file"] == "c.yaml"


def test_json_of_one_that_failed_is_its_error(springcad: Run, tmp_path: Path) -> None:
    run = springcad("design", write_spec(tmp_path, "b", "infeasible"), "--json")
    assert run.returncode == 4
    assert json.loads(run.stdout)["error"]["claim"] == "size"


@pytest.mark.parametrize(
    ("size", "exit_code"), [("20 mm", 0), ("200 mm", 4)], ids=["feasible", "infeasible"]
)
def test_check_tells_whether_a_design_can_exist(
    springcad: Run, tmp_path: Path, size: str, exit_code: int
) -> None:
    spec = write_spec(tmp_path, "knee", "bug", size)
    run = springcad("check", spec)
    assert (run.returncode, run.stderr) == (exit_code, "")
    assert ("make it smaller" in run.stdout) == (exit_code == 4)
    assert [path.name for path in tmp_path.iterdir()] == [spec]


def test_check_takes_the_overrides_of_design(springcad: Run, tmp_path: Path) -> None:
    spec = write_spec(tmp_path, "knee", size="200 mm")
    assert springcad("check", spec).returncode == 4
    assert springcad("check", spec, "--set", "size=20mm").returncode == 0
    wrong = [springcad(command, spec, "--set", "size=x") for command in ("check", "design")]
    assert {(run.returncode, run.stderr) for run in wrong} == {(3, wrong[0].stderr)}


def test_every_spec_is_designed_though_nobody_reads_on(tmp_path: Path) -> None:
    """``springcad design good.yaml failing.yaml | head -1``: files and exit code as ever."""
    specs = [write_spec(tmp_path, "knee"), write_spec(tmp_path, "ankle", "fail")]
    run = subprocess.Popen(
        [sys.executable, Path(__file__).with_name("fake_springcad.py"), "design", *specs],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        cwd=tmp_path,
    )
    assert run.stdout is not None
    run.stdout.close()
    assert run.wait() == 5
    assert run.stderr is not None
    assert run.stderr.read() == b""
    run.stderr.close()
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"knee", "ankle"}


def test_preflight_of_a_written_drawing(springcad: Run, tmp_path: Path) -> None:
    springcad("design", write_spec(tmp_path, "knee"))
    drawing = "out/knee/knee.dxf"
    people = springcad("preflight", drawing, "--process", "laser")
    assert (people.returncode, people.stderr) == (0, "")
    machine = springcad("preflight", drawing, "--json")
    (entry,) = json.loads(machine.stdout)
    assert (entry["file"], entry["exit_code"]) == (drawing, 0)
    assert {check["status"] for check in entry["checks"]} == {"pass"}


def test_preflight_of_what_is_no_drawing(springcad: Run, tmp_path: Path) -> None:
    (tmp_path / "a.dxf").write_text("nonsense")
    run = springcad("preflight", "a.dxf", "missing.dxf")
    assert run.returncode not in (0, 1)
    assert "Traceback" not in run.stderr
    assert len(run.stderr.splitlines()) == 2


def test_markup_and_escapes_in_names_stay_text(springcad: Run, tmp_path: Path) -> None:
    (tmp_path / "[red]\x1b[31m.yaml").write_text("springcad: 1\n")
    run = springcad("design", ".")
    assert run.returncode == 3
    assert "[red]" in run.stderr
    assert "\x1b" not in run.stderr + run.stdout
