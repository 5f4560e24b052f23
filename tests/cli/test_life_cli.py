"""A life on the command line: in place of the design stress, and a histogram that is too much."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

TRIANGLE = Path(__file__).parents[2] / "specs" / "lever-triangular.yaml"


def with_life(histogram: str) -> tuple[str, str]:
    life = f"{{cycles: 1e5, reliability: 0.9, histogram: {histogram}}}"
    return "--set", f"material={{name: 51crv4, life: {life}}}"


def test_a_design_that_does_not_bear_its_loads_is_written_and_is_5(run_springcad) -> None:
    # By hand: 0.9 S_ut = 990 MPa, S_e = 0.897 x 550 MPa, read at 1e5 cycles.
    run = run_springcad("design", TRIANGLE, *with_life("[[1, 9e5]]"), "--json", "--no-verify")
    assert run.returncode == 5, run.stderr
    report = json.loads(run.stdout)
    strength = report["design"]["strength"]
    assert strength["design_stress_Pa"] == pytest.approx(
        990e6 * (0.897 * 550 / 990) ** (2 / 3), rel=1e-9
    )
    failed = [check for check in report["checks"] if check["status"] == "fail"]
    assert [check["name"] for check in failed] == ["Miner's sum of the histogram"]
    assert "raise material.life.cycles to" in failed[0]["remedy"]
    response = report["response"]
    assert response["miner_sum"] == pytest.approx(9e5 / response["life_cycles"], rel=1e-9)


def test_a_torque_is_refused_where_none_is_defined(run_springcad) -> None:
    run = run_springcad("design", TRIANGLE, *with_life("[[20 N*m, 1e4]]"))
    assert run.returncode == 3
    assert "--set:1:1: material.life.histogram: this kind has no single torque" in run.stderr
