"""Specs without a design: one message, exit code 4, nothing written, and remedies that work."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from rotary_cases import SPECS, rotary_model, spring_of, statuses

from springcad.batch.design_one import Wishes, attempt_design
from springcad.batch.specs import read_specs
from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure import design as rotary_design
from springcad.kinds.rotary_flexure.feasibility import failures
from springcad.kinds.rotary_flexure.inputs import case_of
from springcad.kinds.rotary_flexure.straight import straight_alternatives
from springcad.kinds.rotary_flexure.summary import summarise
from springcad.spec.source import read_spec

Run = Callable[..., "subprocess.CompletedProcess[str]"]
NUMBER = r"[0-9.]+(?:e[+-]?[0-9]+)?"
TURN = re.compile(rf"(?:raise|lower) ([a-z_.]+) (?:from {NUMBER} )?to [≥≤]? ?({NUMBER} ?[^ ,]*)")
STYLE = re.compile(r"set ([a-z_.]+) to ([a-z]+)")


def overrides_of(remedy: str) -> list[str]:
    """The changes that a remedy names, as after ``--set``."""
    found = [*TURN.findall(remedy), *STYLE.findall(remedy)]
    assert found, remedy
    return [f"{key}={value.strip()}" for key, value in found]


def design(name: str, *overrides: str, out: Path) -> tuple[int, Exception | None]:
    (reading,) = read_specs([SPECS / f"{name}.yaml"], overrides)
    attempt = attempt_design(reading, Wishes(out, strict=False, judged=False), lambda _: None)
    return attempt.exit_code, attempt.error


ONE_START = "optimiser.starts=1"
"""Enough for these springs, and what is claimed does not hang on how many there are."""

INFEASIBLE = [
    ("S4", "flexures.bend_limit=0.1", "half thickness x curvature in the flattest shape found"),
    ("S3", "flexures.min_gap=1.2 mm", "gap between neighbouring flexures"),
    ("S4", "flexures.root_fillet=2 mm", "root fillet that fits between neighbours"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "change", "claim"), INFEASIBLE)
def test_remedies_found_by_searching_work(
    name: str, change: str, claim: str, tmp_path: Path
) -> None:
    code, error = design(name, ONE_START, change, out=tmp_path)
    assert code == 4
    assert isinstance(error, InfeasibleError)
    assert error.claim.startswith(claim)
    assert error.remedies
    assert list(tmp_path.iterdir()) == []
    for remedy in error.remedies:
        assert spring_of(name, ONE_START, change, *overrides_of(remedy)).mass > 0.0, remedy


FORBIDDEN = [
    ("S1", "flexures.count=54", "flexures.style=straight"),
    ("S2", "target.deflection=21 deg", "flexures.style=serpentine"),
]


@pytest.mark.parametrize(("name", "change", "style"), FORBIDDEN)
def test_remedies_of_what_closed_forms_forbid_pass_every_closed_form(
    name: str, change: str, style: str, tmp_path: Path
) -> None:
    code, error = design(name, change, style, out=tmp_path)
    assert code == 4
    assert isinstance(error, InfeasibleError)
    assert 1 <= len(error.remedies) <= 2
    for remedy in error.remedies:
        case = case_of(rotary_model(name, *[change, style, *overrides_of(remedy)]))
        assert failures(case) == (), remedy


def found_shape(*changes: str) -> bool:
    """Whether a search finds a shape for a change of S2 that passes every closed form.

    The closed forms are necessary, not sufficient: a search may still find none.
    """
    spec = rotary_model("S2", ONE_START, *changes)
    case = case_of(spec).shifted
    assert failures(case) == (), changes
    try:
        rotary_design.spring_of(spec, case, (), lambda _: None)
    except InfeasibleError as error:
        if not error.claim.startswith("searches, of"):
            raise
        return False
    return True


def test_too_soft_to_be_straight_is_told_in_one_message(run_springcad: Run, tmp_path: Path) -> None:
    """f_s < 1: S2's stiffness with 11 deg; all remedies pass the closed forms, one has a shape."""
    run = run_springcad("design", SPECS / "S2.yaml", "--set", "target.deflection=11 deg")
    assert (run.returncode, run.stdout) == (4, "")
    first, *rest = run.stderr.splitlines()
    assert "serpentine factor (below it a straight flexure is already too soft)" in first
    assert re.search(r": 0\.8\d+, limit 0\.99\d+$", first)
    assert list(tmp_path.iterdir()) == []
    remedies = [line for line in rest if "to make it feasible: " in line]
    assert remedies == rest
    found = [found_shape("target.deflection=11 deg", *overrides_of(line)) for line in rest]
    assert any(found)


def test_a_failed_design_leaves_the_earlier_files_alone(run_springcad: Run, tmp_path: Path) -> None:
    assert run_springcad("design", SPECS / "S1.yaml", "-o", "out", "--no-verify").returncode == 0
    before = {path: path.read_bytes() for path in (tmp_path / "out").rglob("*") if path.is_file()}
    run = run_springcad("design", SPECS / "S1.yaml", "-o", "out", "--set", "flexures.count=90")
    assert run.returncode == 4
    after = {path: path.read_bytes() for path in (tmp_path / "out").rglob("*") if path.is_file()}
    assert after == before


def test_a_tool_too_wide_for_the_camshaft_s_slots_is_refused_before_any_search() -> None:
    """A slot is as wide as a tip: an end mill of 2 mm cannot cut one for tips of 1 mm."""
    milled = rotary_model(
        "S1", "process=milling", "mounting=bore", "flexures.tip_thickness=1 mm", "flexures.count=8"
    )
    assert "camshaft slot" in failures(case_of(milled))
    loose = rotary_model(
        "S1", "process=milling", "mounting=bore", "flexures.tip_thickness=1 mm",
        "flexures.count=8", "camshaft.backlash=1.2 mm",
    )  # fmt: skip
    assert "camshaft slot" not in failures(case_of(loose))


@pytest.mark.slow
def test_straight_alternatives_of_s2_can_be_designed_as_promised() -> None:
    """Advice of the report: count and contact radius for straight flexures, with their stress."""
    advice = straight_alternatives(case_of(rotary_model("S2")))
    said = summarise(read_spec(SPECS / "S2.yaml", ()), spring_of("S2")).advice
    for alternative in advice:
        assert any(str(alternative)[1:] in line for line in said)
        changes = (
            "flexures.style=straight",
            f"flexures.count={alternative.count}",
            f"envelope.contact_radius={alternative.contact_radius * 1e3:.4g} mm",
        )
        assert "fail" not in statuses("S2", *changes).values()
        result = summarise(read_spec(SPECS / "S2.yaml", changes), spring_of("S2", *changes))
        design, response = result.design, result.response
        # The advice is that of a clamped flexure and of small deflections.
        assert response["peak_nominal_stress_Pa"] == pytest.approx(alternative.stress, rel=0.02)
        assert response["peak_local_stress_Pa"] == pytest.approx(
            response["peak_nominal_stress_Pa"], rel=1e-9
        )
        assert design["tip_force_N"] == pytest.approx(alternative.force, rel=1e-3)
        assert response["min_gap_m"] == pytest.approx(alternative.gap, abs=2e-5)


def test_warnings_are_0_or_strictly_5_and_a_failed_check_is_5(run_springcad: Run) -> None:
    """Small fillets at the roots of S1 are stressed beyond yield; 52 flexures: too thin a tooth."""
    command = ("design", SPECS / "S1.yaml", "--no-verify", "--set", "flexures.root_fillet=0.2 mm")
    sharp = run_springcad(*command)
    assert (sharp.returncode, "WARN" in sharp.stdout, "FAIL" in sharp.stdout) == (0, True, False)
    assert run_springcad(*command, "--strict").returncode == 5
    thin = run_springcad("design", SPECS / "S1.yaml", "--set", "flexures.count=52", "--no-verify")
    assert thin.returncode == 5
    failing = [line for line in thin.stdout.splitlines() if line.endswith("FAIL")]
    tooth = ("camshaft tooth, thinnest", "camshaft drawing: smallest web")
    assert [line.split("  ")[0] for line in failing] == list(tooth)
