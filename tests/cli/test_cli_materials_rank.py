"""``springcad materials rank``: a table for people, JSON for programs, a chart on request."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from springcad.cli.run import run

Run = Callable[..., subprocess.CompletedProcess[str]]


def test_the_table_ranks_and_says_what_the_stress_is(run_springcad: Run) -> None:
    done = run_springcad("materials", "rank", "--for", "leaf")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("pei"))
    first = [line.split()[0] for line in lines[start : start + 4]]
    assert first == ["pei", "maraging-300", "pet", "pom-c"]
    assert "flexural yield   paper 000, Table I, flexural" in done.stdout
    flat = " ".join(done.stdout.split())
    assert "maraging-300 (271 kPa) beats pet (208 kPa)" in flat
    assert max(map(len, lines)) <= 100


def test_json_for_a_life_holds_sources_and_what_is_unknown(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run(["materials", "rank", "--life", "1e5", "--json"]) == 0
    written = capsys.readouterr()
    assert written.err == ""
    data = json.loads(written.out)
    assert (data["for"], data["life_cycles"]) == ("leaf", 1e5)
    steel = next(entry for entry in data["ranking"] if entry["name"] == "aisi-420")
    assert steel["stress_Pa"]["value"] == pytest.approx(912.0e6, abs=0.05e6)
    assert steel["basis"] == "fatigue, estimated"
    stress, modulus = steel["stress_Pa"]["value"], steel["elastic_modulus_Pa"]
    assert steel["leaf_metric_Pa"] == pytest.approx(stress**3 / modulus**2)
    assert steel["energy_per_volume_J_per_m3"] == pytest.approx(stress**2 / (2 * modulus))
    assert {"pom-c", "pet", "pei", "cube2", "al-7075-t6"} <= set(data["not_ranked"])


def test_only_the_named_materials_and_a_chart(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "charts/two.svg"
    arguments = ["materials", "rank", "--material", "pet", "--material", "51crv4", "--json"]
    assert run([*arguments, "--chart", str(path)]) == 0
    written = capsys.readouterr()
    assert written.err == ""
    assert [entry["name"] for entry in json.loads(written.out)["ranking"]] == ["pet", "51crv4"]
    chart = path.read_bytes()
    assert chart.startswith(b"<svg xmlns=")
    assert run([*arguments, "--chart", str(path)]) == 0
    assert path.read_bytes() == chart
    assert [file.name for file in path.parent.iterdir()] == ["two.svg"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["rank", "--material", "pett"], "unknown material"),
        (["rank", "--life", "10"], "from 1e3"),
        (["rank", "--life", "nan"], "from 1e3"),
        (["rank", "--life", "inf"], "from 1e3"),
        (["rank", "--for", "boat"], "leaf"),
        (["rank", "--chart", "chart.png"], "does not end with .svg"),
        (["--json", "rank"], "--json stands behind rank"),
        (["sort"], "No such command 'sort'"),
    ],
)
def test_wrong_usage_is_2(
    capsys: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    assert run(["materials", *arguments]) == 2
    written = capsys.readouterr()
    assert written.out == ""
    assert message in written.err


def test_a_chart_that_cannot_be_written_is_6(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "chart.svg"
    path.mkdir()
    assert run(["materials", "rank", "--chart", str(path)]) == 6
    written = capsys.readouterr()
    assert written.out == ""
    assert "not an ordinary file" in written.err


def test_the_list_is_still_the_list(run_springcad: Run) -> None:
    listed = run_springcad("materials")
    assert (listed.returncode, listed.stderr) == (0, "")
    assert "flexural strength   91.00 MPa" in listed.stdout
    assert "* weak source" in listed.stdout
