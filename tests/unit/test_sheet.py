"""The calculation sheet: every formula of every kind gives the value of the design again."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from springcad.formula import FormulaError, symbols
from springcad.kinds import KINDS, load_kind
from springcad.kinds.lever_arm import omega_search
from springcad.report.display import display_unit
from springcad.report.sheet_json import sheet_to_dict
from springcad.report.sheet_text import sheet_text
from springcad.sheet import Section, Sheet, agrees, derived, given, recomputed, suffixed
from springcad.spec.source import read_spec

ROOT = Path(__file__).parents[2]
SPECS = ROOT / "specs"

LIFE = "material={name: 51crv4, life: {cycles: 2e5, load_ratio: -0.5, reliability: 0.9}}"
GERBER = "{cycles: 3e4, load_ratio: 0, surface: machined, mean_stress: gerber}"
SIZED = "cantilever={length: 24.4 mm, height: [4.2 mm, 4.9 mm], objective: min_volume}"
CASES = (
    "lever-parabolic",
    "lever-triangular",
    "leaf2-paper",
    "leaf2-design",
    "S1",
    "roller-paper",
)
"""Shipped specs of every kind that are designed quickly."""
VARIANTS: dict[str, tuple[str, tuple[str, ...]]] = {
    "crank behind": ("lever-triangular", ("mechanism.output=crank-behind",)),
    "crank ahead, past its dead angle": (
        "lever-triangular",
        ("mechanism.output=crank-ahead", "mechanism.pivot=[5 mm, 45 mm]"),
    ),
    "a width for a wanted stiffness": (
        "lever-triangular",
        ("leaf={shape: triangular, length: 70 mm}", "target.spring_stiffness=30 N/mm"),
    ),
    "a sheet that the shop has": ("lever-triangular", ("leaf.sheet_thickness=1.8 mm",)),
    "a life, Goodman": ("lever-triangular", (LIFE,)),
    "a life, Gerber": ("lever-triangular", (f"material={{name: 51crv4, life: {GERBER}}}",)),
    "an endurance limit from a source": (
        "lever-triangular",
        ("material={name: aisi-420, life: {cycles: 5e6, reliability: 0.99, surface: ground}}",),
    ),
    "S-N points of the user's own": (
        "lever-triangular",
        (
            "material={name: 51crv4, life: {cycles: 5e5, load_ratio: -1, reliability: 0.99, "
            "sn: [[1e4, 800 MPa], [1e5, 700 MPa], [1e7, 500 MPa]]}}",
        ),
    ),
    "a stack of given layers": (
        "lever-parabolic",
        ("target={spring_deflection: 10 mm}", "leaf={shape: constant, length: 80 mm, "
         "sheet_thickness: 3 mm, layers: 4}"),
    ),
    "leaves held inboard": (
        "leaf2-paper",
        ("unit.clamp=inboard", "target.deflection=12 deg"),
    ),
    "a pocket, friction, and sizing": (
        "roller-linear",
        ("mount={held: pocket}", "friction=0.02", SIZED),
    ),
}  # fmt: skip
SLOW = ("rotary-exponential", "rotary-full", "roller-quadratic", "roller-stiffness")
"""Laws of other forms, shared or after a dead zone; friction; the paper's control points."""


@cache
def explained(name: str, overrides: tuple[str, ...] = ()) -> Sheet:
    spec = read_spec(SPECS / f"{name}.yaml", overrides)
    return load_kind(spec.kind).explain_spec(spec, lambda _: None)


def assert_recomputes(sheet: Sheet) -> None:
    again = recomputed(sheet)
    wrong = {
        step.symbol: (step.formula, step.value, again[step.symbol])
        for step in sheet.steps
        if step.symbol in again and not agrees(step, again[step.symbol])
    }
    assert not wrong


def assert_complete(sheet: Sheet) -> None:
    """No step without value, unit and source; a page that is a source exists, and its section."""
    for step in sheet.steps:
        for page, number in re.findall(r"theory/([\w-]+\.md)(?:, (\d+))?", step.source):
            text = (ROOT / "docs/theory" / page).read_text(encoding="utf-8")
            assert not number or f"\n## {number}. " in text, step
        assert math.isfinite(step.value), step
        assert step.unit, step
        assert step.source, step
        assert step.meaning, step


def test_every_kind_is_explained_by_one_of_the_tests() -> None:
    assert {read_spec(SPECS / f"{name}.yaml", ()).kind for name in CASES} == set(KINDS)


@pytest.mark.parametrize("name", CASES)
def test_every_formula_of_a_shipped_spec_recomputes(name: str) -> None:
    sheet = explained(name)
    assert sheet.refusal is None
    assert_recomputes(sheet)
    assert_complete(sheet)
    assert len(recomputed(sheet)) >= 25
    assert sheet.checks


@pytest.mark.parametrize("case", VARIANTS)
def test_every_formula_of_other_arrangements_recomputes(case: str) -> None:
    sheet = explained(*VARIANTS[case])
    assert sheet.refusal is None
    assert_recomputes(sheet)
    assert_complete(sheet)


@pytest.mark.slow
@pytest.mark.parametrize("name", SLOW)
def test_every_formula_of_specs_with_more_in_them_recomputes(name: str) -> None:
    sheet = explained(name)
    assert sheet.refusal is None
    assert_recomputes(sheet)
    assert_complete(sheet)


@pytest.mark.slow
def test_every_formula_of_an_omega_leaf_recomputes(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a short search: what it finds does not matter here."""
    monkeypatch.setattr(omega_search, "RESTARTED", 0)
    monkeypatch.setattr(omega_search, "FINISHED", 1)
    sheet = explained("lever-pom", ("optimiser={starts: 2, seed: 1}", "leaf.topology=omega"))
    assert sheet.refusal is None
    assert_recomputes(sheet)
    assert_complete(sheet)


@pytest.mark.parametrize("name", ["lever-triangular", "leaf2-paper"])
def test_the_sheet_tells_what_the_report_tells(name: str) -> None:
    """Checks are those of the design, number for number."""
    spec = read_spec(SPECS / f"{name}.yaml", ())
    result = load_kind(spec.kind).design_spec(spec, lambda _: None)
    sheet = explained(name)
    assert sheet.checks == result.checks
    assert (sheet.kind, sheet.name) == (result.kind, result.name)


@pytest.mark.parametrize("name", CASES)
def test_a_formula_is_what_tells_derived_numbers_from_others(name: str) -> None:
    sheet = explained(name)
    assert all((step.basis == "derived") == bool(step.formula) for step in sheet.steps)
    assert {step.basis for step in sheet.steps} == {"given", "derived", "found"}


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("lever-parabolic", "target.spring_deflection=30 mm"),
        ("leaf2-paper", "target.deflection=30 deg"),
        ("roller-paper", "joint.drum_radius=20 mm"),
        ("S2", "target.deflection=25 deg"),
    ],
)
def test_a_refused_design_is_explained_as_far_as_closed_forms_go(name: str, change: str) -> None:
    sheet = explained(name, (change,))
    assert sheet.refusal is not None
    assert_recomputes(sheet)
    assert_complete(sheet)
    assert any(check.status == "fail" for check in sheet.checks)
    assert len(sheet.steps) >= 15


def _changed(sheet: Sheet, symbol: str, change: Callable[[float], float]) -> Sheet:
    sections = tuple(
        replace(
            section,
            steps=tuple(
                replace(step, value=change(step.value)) if step.symbol == symbol else step
                for step in section.steps
            ),
        )
        for section in sheet.sections
    )
    return replace(sheet, sections=sections)


def test_a_step_that_does_not_recompute_is_never_passed_over() -> None:
    """One value changed by a hundredth: the step itself and what follows from it say so."""
    sheet = _changed(explained("leaf2-paper"), "I", lambda value: 1.01 * value)
    text = sheet_text(sheet)
    assert "DOES NOT RECOMPUTE: the equation gives 0.1800 mm⁴" in text
    assert "2 of 66 equations" in text
    assert "do NOT give the value of the design: I, B." in " ".join(text.split())
    disagreeing = [
        step["symbol"]
        for section in sheet_to_dict(sheet)["sections"]
        for step in section["steps"]
        if step["agrees"] is False
    ]
    assert disagreeing == ["I", "B"]


def test_formulas_use_earlier_steps_only_and_symbols_once() -> None:
    early = derived("a", "early", "b*2", 2.0, "1", "test")
    late = given("b", "late", 1.0, "1")
    with pytest.raises(FormulaError, match="b has no value"):
        recomputed(Sheet("kind", "name", (Section("all", (early, late)),)))
    with pytest.raises(ValueError, match="two steps of the sheet are called b"):
        recomputed(Sheet("kind", "name", (Section("all", (late, late)),)))


def test_steps_of_several_places_keep_their_formulas_apart() -> None:
    steps = suffixed(
        (given("q", "place", 2.0, "m"), derived("s", "square", "q**2*t", 12.0, "m", "test")), "near"
    )
    assert [step.symbol for step in steps] == ["q_near", "s_near"]
    assert symbols(steps[1].formula) == ("q_near", "t")


@pytest.mark.parametrize("name", CASES)
def test_every_step_is_printed_with_its_number_its_equation_and_its_source(name: str) -> None:
    sheet = explained(name)
    text = sheet_text(sheet)
    assert max(len(line) for line in text.splitlines()) <= 100
    flat = " ".join(text.split())
    for number, section in enumerate(sheet.sections, 1):
        for place, step in enumerate(section.steps, 1):
            assert f"\n{number}.{place}  {step.meaning}" in text
            assert " ".join(step.note.split()) in flat
            assert f"[{step.source}]" in flat
    assert f"All {len(recomputed(sheet))} equations" in text
    assert "nan" not in flat
    assert "not computed" not in flat


def test_the_excerpt_of_a_step_reads_like_a_calculation_by_hand() -> None:
    text = sheet_text(explained("leaf2-paper"))
    assert "φ_max = 14.83 deg   [spec]" in text
    assert "K₁₆_long = 3·n·B·R²/L_long³\n" in text
    assert (
        "= 3 · 2 · 0.03744 N·m² · (25.00 mm)² / (45.00 mm)³ = 1.541 N·m/rad   "
        "[003, Eq. 16, of n leaves]" in text
    )


def test_the_same_spec_gives_the_same_sheet() -> None:
    spec = read_spec(SPECS / "lever-triangular.yaml", ())
    again = load_kind(spec.kind).explain_spec(spec, lambda _: None)
    assert sheet_text(again) == sheet_text(explained("lever-triangular"))


def test_published_numbers_stand_in_the_sheets() -> None:
    """003: 1.54 and 140.4 N·m/rad, 14.83 deg; 004: Table I; 001: 12 N·m a group; 000: η_A = 1/3."""
    wrist = {step.symbol: step.value for step in explained("leaf2-paper").steps}
    assert wrist["K_16_long"] == pytest.approx(1.54, abs=0.005)
    assert wrist["K_16_short"] == pytest.approx(140.4, abs=0.05)
    assert np.degrees(wrist["phi_theta_long"]) == pytest.approx(14.83, abs=0.005)
    spring = {step.symbol: step.value for step in explained("S1").steps}
    assert spring["f_s"] == pytest.approx(1.00, abs=0.006)
    assert spring["f_d"] == pytest.approx(0.40, abs=0.005)
    assert np.degrees(spring["theta_s"]) == pytest.approx(12.6, abs=0.05)
    cam = {step.symbol: step.value for step in explained("roller-paper").steps}
    assert cam["T"] == pytest.approx(12.0, rel=0.03)
    lever = {step.symbol: step.value for step in explained("lever-parabolic").steps}
    assert lever["eta_A"] == pytest.approx(1.0 / 3.0, rel=1e-12)


def test_volumes_and_second_moments_are_shown_in_millimetres() -> None:
    assert display_unit("m^3") == (1e9, "mm^3")
    assert display_unit("m^4") == (1e12, "mm^4")
