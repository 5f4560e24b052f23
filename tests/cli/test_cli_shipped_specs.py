"""The shipped specs through the command line: several real designs in one run."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., "subprocess.CompletedProcess[str]"]
SPECS = Path(__file__).parents[2] / "specs"
TWO = [SPECS / "rotary-stack.yaml", SPECS / "S1.yaml"]
"""Of one kind, with straight flexures, which need no search."""


def test_every_shipped_spec_passes_check(run_springcad: Run) -> None:
    run = run_springcad("check", SPECS)
    assert (run.returncode, run.stderr) == (0, "")
    assert all(str(path) in run.stdout for path in SPECS.glob("*.yaml"))


@pytest.mark.slow
def test_designs_of_one_run_do_not_touch_each_other(run_springcad: Run, tmp_path: Path) -> None:
    """Each is, to the byte, what it is when designed alone."""
    together = run_springcad("design", *TWO, "-o", "together", "--json", "--no-verify")
    assert together.returncode == 0, together.stderr
    assert [entry["exit_code"] for entry in json.loads(together.stdout)] == [0, 0]
    alone = run_springcad("design", TWO[1], "-o", "alone", "--no-verify")
    assert alone.returncode == 0, alone.stderr
    files = sorted(path.name for path in (tmp_path / "alone" / "S1").iterdir())
    assert "S1.dxf" in files
    for name in files:
        one, other = (tmp_path / folder / "S1" / name for folder in ("alone", "together"))
        assert one.read_bytes() == other.read_bytes(), name


def test_an_infeasible_request_is_4_with_a_remedy(run_springcad: Run, tmp_path: Path) -> None:
    run = run_springcad("design", SPECS / "S2.yaml", "--set", "flexures.count=90")
    assert (run.returncode, run.stdout) == (4, "")
    first, *remedies = run.stderr.splitlines()
    assert "no feasible design: " in first
    assert ", limit " in first
    assert remedies
    assert all(line.startswith("  to make it feasible: ") for line in remedies)
    assert list(tmp_path.iterdir()) == []
