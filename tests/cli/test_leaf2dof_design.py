"""Leaf springs for a wrist as a user designs them."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

Run = Callable[..., "subprocess.CompletedProcess[str]"]
ROOT = Path(__file__).parents[2]
SPECS = ROOT / "specs"


def test_both_shipped_specs_are_designed_and_every_key_is_documented(
    run_springcad: Run, tmp_path: Path
) -> None:
    specs = [SPECS / f"leaf2-{name}.yaml" for name in ("paper", "design")]
    run = run_springcad("design", *specs, "-o", "out", "--json", "--no-verify")
    assert run.returncode == 0, run.stderr + run.stdout[:2000]
    reports = [
        json.loads((tmp_path / f"out/leaf2-{name}/report.json").read_text())
        for name in ("paper", "design")
    ]
    for report in reports:
        assert {check["status"] for check in report["checks"]} == {"pass"}
        folder = tmp_path / "out" / report["name"]
        assert {path.name for path in folder.iterdir()} >= {
            f"{report['name']}.{e}" for e in ("dxf", "svg")
        }
    drawing = (tmp_path / "out/leaf2-paper/leaf2-paper.svg").read_text()
    for words in ("effective length", "guide", "reach of the rod", "14.83 deg"):
        assert words in drawing
    paper = reports[0]["response"]
    assert paper["least_stiffness_Nm_per_rad"] == pytest.approx(1.54, rel=1e-3)
    assert paper["greatest_stiffness_Nm_per_rad"] == pytest.approx(140.4, rel=3e-3)
    assert paper["max_deflection_rad"] == pytest.approx(np.radians(14.83))
    _all_keys_are_documented(reports[0])


def _all_keys_are_documented(report: dict) -> None:
    """Keys about the life are those of every kind, and are told elsewhere."""
    page = (ROOT / "docs/reference/leaf-2dof-report.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"^\| `([^`]+)` \|", page, re.MULTILINE))
    keys = {*_keys("design", report["design"]), *_keys("response", report["response"])}
    assert documented == {key for key in keys if "life" not in key}


def _keys(path: str, value: object) -> Iterator[str]:
    """Dotted paths of all values; the names of strokes and of places of the rod as in the page."""
    if not isinstance(value, dict):
        yield path
        return
    for key, inner in value.items():
        key = "N" if path.endswith(".strokes") else "PLACE" if path.endswith(".rod") else key
        yield from _keys(f"{path}.{key}", inner)
