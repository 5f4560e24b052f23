"""``springcad calibrate``: from a bench test to the next prototype, and what it refuses."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from springcad.cli.run import run
from springcad.errors import SpecError
from springcad.kinds.rotary_flexure.bench_model import Bench, BenchModel, bench_model
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.spec.source import read_spec
from springcad.spec.torque_curve import read_bench_file
from springcad.verify.read_design import read_design

DEGREE = np.pi / 180.0
SPEC = """\
springcad: 1
kind: rotary-flexure
name: {name}
target: {{stiffness: 150 N*m/rad, deflection: 12.56 deg}}
envelope: {{outer_radius: 33.5 mm, root_radius: 31 mm, contact_radius: 6 mm, thickness: 4.5 mm}}
flexures: {{count: 24, style: straight, tip_thickness: 0.35 mm, root_fillet: 0.5 mm}}
material: {{name: aisi-420, design_stress: 912 MPa}}
process: wire-edm
{more}"""
CYCLE = ((0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0))
SIX_PERCENT_LOW = Bench(modulus=0.94, friction=0.15, angle=0.3 * DEGREE)


def calibrate(*arguments: str | Path) -> int:
    """In this process: what is slow to import is there already."""
    return run(["calibrate", *map(str, arguments)])


def design(folder: Path, name: str, more: str = "") -> Path:
    """The folder of a design; its spec is left beside it."""
    spec = folder / f"{name}.yaml"
    spec.write_text(SPEC.format(name=name, more=more), encoding="utf-8")
    assert run(["design", str(spec), "-o", str(folder), "--no-verify"]) == 0
    return folder / name


@cache
def model_of(folder: Path) -> BenchModel:
    written, _ = read_design(folder)
    return bench_model(written, written_spring(written))


def bench_test(
    folder: Path, path: Path, truth: Bench, legs: Sequence[tuple[float, float]] = CYCLE
) -> Path:
    """A recorded test, with noise of 0.03 deg and 0.2 % of the torque."""
    model, noise = model_of(folder), np.random.default_rng(4)
    angle = model.reach * np.concatenate([np.linspace(*leg, 60) for leg in legs])
    travel = np.repeat([1 if end > begin else -1 for begin, end in legs], 60)
    torque = model.torque(truth, angle, travel)
    torque += noise.normal(0.0, 0.002 * model.peak_torque, len(angle))
    return write_curve(path, angle + noise.normal(0.0, 0.03 * DEGREE, len(angle)), torque)


def write_curve(path: Path, angle: np.ndarray, torque: np.ndarray) -> Path:
    rows = [f"{a / DEGREE:.6f}, {t:.6f}" for a, t in zip(angle, torque, strict=True)]
    path.write_text("\n".join(["angle [deg], torque [N*m]", *rows]), encoding="utf-8")
    return path


def report(folder: Path) -> dict:
    return json.loads((folder / "report.json").read_text(encoding="utf-8"))


def secant(folder: Path, truth: Bench) -> float:
    """Stiffness at the design deflection of what is drawn, mean of both directions."""
    model = model_of(folder)
    angle = np.array([1.0, -1.0]) * report(folder)["response"]["max_deflection_rad"]
    return float(np.mean(model.torque(truth, angle, np.array([1, -1])) / angle))


@pytest.fixture(scope="module")
def ring(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return design(tmp_path_factory.mktemp("calibrate"), "ring")


@pytest.fixture(scope="module")
def low(ring: Path) -> Path:
    """A test of a ring that is 6 % too soft, rubs, and whose encoder is off by 0.3 deg."""
    return bench_test(ring, ring.parent / "low.csv", SIX_PERCENT_LOW)


def test_the_second_prototype_hits(ring: Path, low: Path, tmp_path: Path) -> None:
    assert secant(ring, Bench(modulus=0.94)) == pytest.approx(0.94 * 150.0, rel=5e-3)
    assert calibrate(ring, low, "-o", tmp_path) == 0
    second = design(tmp_path, "second", "calibration: ring-calibration.yaml")
    made = report(second)
    modulus = made["design"]["elastic_modulus_Pa"]
    assert modulus == pytest.approx(0.94 * 200e9, rel=2e-3)
    assert made["design"]["camshaft"]["friction"] == pytest.approx(0.15, abs=0.01)
    assert made["response"]["hysteresis_share"] == pytest.approx(0.045, abs=0.005)
    # What is true of the first ring is true of the second.
    truth = Bench(modulus=0.94 * 200e9 / modulus)
    assert secant(second, truth) == pytest.approx(150.0, rel=5e-3)
    source = made["provenance"]["material"]["elastic_modulus_Pa"]["source"]
    assert source == "calibration: bench test low.csv of ring"
    assert made["provenance"]["calibration"]["design"] == "ring"
    assert any("calibrated by the bench test low.csv" in line for line in made["assumptions"])


def test_a_root_that_is_too_soft_is_made_up_for_as_well(ring: Path, tmp_path: Path) -> None:
    soft = Bench(root=4.0, friction=0.1)
    curve = bench_test(ring, tmp_path / "soft.csv", soft)
    assert calibrate(ring, curve, "-o", tmp_path, "--fit", "root") == 0
    second = design(tmp_path, "second", "calibration: ring-calibration.yaml")
    made = report(second)
    found = made["design"]["calibrated_root_coefficient"]
    assert found == pytest.approx(4.0, abs=0.15)
    assert made["design"]["elastic_modulus_Pa"] == 200e9
    # The design holds what was found; the truth is a little more or less.
    assert secant(second, Bench(root=4.0 - found)) == pytest.approx(150.0, rel=5e-3)
    assert secant(second, Bench(root=-found)) > 1.04 * 150.0


def test_modulus_and_root_are_not_fitted_together(
    ring: Path, low: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert calibrate(ring, low, "-o", tmp_path, "--fit", "both", "--json") == 3
    said = capsys.readouterr()
    (problem,) = json.loads(said.out)["error"]["problems"]
    assert (problem["line"], problem["column"]) == (1, 1)
    assert "elastic modulus and root compliance cannot be told apart" in problem["message"]
    assert "condition number" in problem["message"]
    assert not list(tmp_path.iterdir())


def test_what_the_test_cannot_tell_is_held_and_said(
    ring: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    curve = bench_test(ring, tmp_path / "loading.csv", SIX_PERCENT_LOW, ((0.0, 1.0),))
    assert calibrate(ring, curve, "-o", tmp_path, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    held = {entry["name"]: entry["held"] for entry in found["estimates"] if entry["held"]}
    assert set(held) == {
        "extra root compliance, over 1/(E t h^2)",
        "friction",
        "torque at rest",
    }
    assert "cannot be told from elastic modulus (correlation" in held["friction"]
    assert "cannot be told from angle at rest (correlation" in held["torque at rest"]
    assert any("Were it 0.1 more, the modulus would be" in note for note in found["notes"])
    assert "friction:" not in found["text"]


def loop_test(ring: Path, path: Path, half: float, noise: float = 0.05) -> Path:
    """Of a linear spring of 0.94 of the stiffness, that loses twice ``half`` of every torque."""
    angle = 12.7 * DEGREE * np.concatenate([np.linspace(*leg, 60) for leg in CYCLE])
    loading = np.sign(angle) * np.repeat([1, -1, -1, 1], 60)
    torque = 0.94 * 150.0 * angle * (1.0 + half * loading)
    torque += np.random.default_rng(4).normal(0.0, noise, len(angle))
    return write_curve(path, angle, torque)


def test_doubtful_friction_is_fitted_but_not_passed_on(
    ring: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    curve = loop_test(ring, tmp_path / "loop.csv", 0.047)
    assert calibrate(ring, curve, "-o", tmp_path, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    modulus, _, friction, *_ = found["estimates"]
    assert modulus["value"] == pytest.approx(0.94 * 200e9, rel=5e-3)
    assert modulus["doubt"] == friction["held"] == ""
    assert "one coefficient does not explain what was measured" in friction["doubt"]
    assert "2 x standard error = 0.05" in friction["doubt"]
    assert "against a limit of 0.05" in friction["doubt"]
    assert "friction" not in found["text"]
    assert calibrate(ring, curve, "-o", tmp_path) == 0
    assert "Doubtful" in capsys.readouterr().out
    made = report(design(tmp_path, "second", "calibration: ring-calibration.yaml"))
    assert made["design"]["elastic_modulus_Pa"] == pytest.approx(modulus["value"], rel=1e-6)


def test_a_refusal_compares_what_is_over_the_limit(
    ring: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    curve = loop_test(ring, tmp_path / "noise.csv", 0.0, noise=8.0)
    assert calibrate(ring, curve, "-o", tmp_path) == 3
    said = capsys.readouterr().err
    numbers = re.search(r"2 x standard error = ([\d.]+) GPa against a limit of 6 GPa", said)
    assert numbers is not None
    assert float(numbers[1]) > 6.0


def test_the_same_test_gives_the_same_file_and_another_replaces_nothing(
    ring: Path, low: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "ring-calibration.yaml"
    assert calibrate(ring, low, "-o", tmp_path) == 0
    shown = capsys.readouterr().out
    assert "elastic modulus" in shown
    assert "standard error" in shown
    first = file.read_bytes()
    assert calibrate(ring, low, "-o", tmp_path) == 0
    assert file.read_bytes() == first
    file.write_bytes(first + b"#")
    assert calibrate(ring, low, "-o", tmp_path) == 6
    assert "it is kept" in capsys.readouterr().err
    assert file.read_bytes() == first + b"#"


def test_a_curve_that_is_not_of_the_design_is_refused(
    ring: Path, low: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    angle, torque = np.array(read_bench_file(low).points).T
    for change, words in ((-1.0, "turn the sign of one column round"), (0.3, "another design")):
        curve = write_curve(tmp_path / "wrong.csv", angle, change * torque)
        assert calibrate(ring, curve, "-o", tmp_path / "out") == 3
        assert words in capsys.readouterr().err
    curve = write_curve(tmp_path / "short.csv", 0.3 * angle[:15], torque[:15])
    assert calibrate(ring, curve, "-o", tmp_path / "out") == 3
    said = capsys.readouterr().err.splitlines()
    assert [line.startswith(f"{curve}:1:1: ") for line in said] == [True, True]
    assert "needs 20 points or more" in said[0]
    assert "half of the design deflection" in said[1]
    assert not (tmp_path / "out").exists()


def test_every_problem_of_a_file_has_its_line_and_column(tmp_path: Path) -> None:
    path = tmp_path / "bench.csv"
    path.write_text("# x\nangle [deg], torque [N*m]\n0, 0\n1, x\n95, 2\n-3, -4\n2\n")
    with pytest.raises(SpecError) as refused:
        read_bench_file(path)
    found = [(p.line, p.column, p.message) for p in refused.value.problems]
    assert [place[:2] for place in found] == [(4, 4), (5, 1), (7, 1)]
    assert "x N*m is not a number" in found[0][2]
    assert "must be from -90 deg to 90 deg" in found[1][2]


CALIBRATION = """\
design: ring
curve: low.csv
material: aisi-420
elastic_modulus: 188 GPa
friction: 0.2
"""


@pytest.mark.parametrize(
    ("file", "more", "place", "words"),
    [
        (
            CALIBRATION.replace("material", "materail"),
            "",
            ("c.yaml", 3, 1),
            "did you mean material?",
        ),
        (CALIBRATION.replace("188 GPa", "188"), "", ("c.yaml", 4, 18), "needs a unit"),
        ("- 1\n", "", ("c.yaml", 1, 1), "holds no calibration"),
        ("a: &b 1\n", "", ("c.yaml", 1, 4), "anchors"),
        (None, "", ("knee.yaml", 9, 14), "c.yaml: cannot be read"),
        (CALIBRATION.replace("aisi-420", "51crv4"), "", ("knee.yaml", 9, 14), "is of 51crv4"),
        (
            CALIBRATION,
            "camshaft: {friction: 0.1}\n",
            ("knee.yaml", 9, 14),
            "leave camshaft.friction out",
        ),
    ],
)
def test_problems_of_a_calibration_have_their_places(
    file: str | None, more: str, place: tuple[str, int, int], words: str, tmp_path: Path
) -> None:
    if file is not None:
        (tmp_path / "c.yaml").write_text(file, encoding="utf-8")
    spec = tmp_path / "knee.yaml"
    spec.write_text(SPEC.format(name="knee", more=f"calibration: c.yaml\n{more}"))
    with pytest.raises(SpecError) as refused:
        read_spec(spec)
    first = refused.value.problems[0]
    assert (Path(first.file).name, first.line, first.column) == place
    assert words in first.message


def test_a_calibration_counts_as_if_it_stood_in_the_spec(tmp_path: Path) -> None:
    (tmp_path / "c.yaml").write_text(CALIBRATION, encoding="utf-8")
    section = ", ".join(CALIBRATION.splitlines())
    found = []
    for number, entry in enumerate(("c.yaml", f"{{{section}}}")):
        spec = tmp_path / f"{number}.yaml"
        spec.write_text(SPEC.format(name="knee", more=f"calibration: {entry}\n"))
        found.append(read_spec(spec).sha256)
    assert found[0] == found[1]
    spec.write_text(SPEC.format(name="knee", more=""))
    assert read_spec(spec).sha256 != found[0]


def test_a_kind_without_calibration_says_so(
    low: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    texts = {"kind": "leaf-2dof", "name": "wrist"}
    sections = {key: {} for key in ("spec", "design", "response", "files")}
    (tmp_path / "report.json").write_text(json.dumps(texts | sections), encoding="utf-8")
    (tmp_path / "manifest.json").write_text('{"files": {}}', encoding="utf-8")
    assert calibrate(tmp_path, low, "-o", tmp_path / "out") == 2
    said = capsys.readouterr().err
    assert "leaf-2dof offers no calibration" in said
    assert "rotary-flexure" in said
    assert calibrate(tmp_path / "nowhere", low, "-o", tmp_path / "out") == 3
    assert not (tmp_path / "out").exists()
