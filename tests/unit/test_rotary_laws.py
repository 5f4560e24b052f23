"""Rotary springs with a torque law of their own."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from rotary_cases import SPECS, rotary_model, spring_of

from springcad.errors import SpecError
from springcad.kinds.rotary_flexure.checks import spring_checks
from springcad.kinds.rotary_flexure.feasibility import feasibility_checks
from springcad.kinds.rotary_flexure.inputs import case_of
from springcad.kinds.rotary_flexure.loaded_contact import loaded_shift, stiffening_by
from springcad.spec.source import read_spec

NONLINEAR = ("rotary-stiffening", "rotary-exponential")


def with_law(folder: Path, law: str, deflection: str = "14 deg") -> Path:
    """The stiffening spec with another law."""
    text = (SPECS / "rotary-stiffening.yaml").read_text(encoding="utf-8")
    start = text.index("  law:")
    path = folder / "spec.yaml"
    end = text.index("envelope:")
    path.write_text(f"{text[:start]}  law: {law}\n  deflection: {deflection}\n{text[end:]}")
    return path


def failing(path: Path) -> dict[str, float]:
    checks = feasibility_checks(case_of(read_spec(path).model))
    return {claim.name: claim.value for claim in checks if claim.status == "fail"}


@pytest.mark.parametrize("name", NONLINEAR)
def test_the_drawn_camshaft_gives_the_law_over_the_whole_stroke(name: str) -> None:
    """The arcs of its drawing cost up to 0.036 % of the full torque."""
    spring = spring_of(name)
    for stroke in spring.strokes:
        wanted = spring.target.torque(stroke.angle)
        np.testing.assert_allclose(stroke.torque, wanted, rtol=0.0, atol=5e-4 * wanted[-1])
        energy = float(spring.target.energy(stroke.angle[-1:])[0])
        assert stroke.energy[-1] == pytest.approx(energy, rel=1e-5)


@pytest.mark.parametrize("name", NONLINEAR)
def test_a_law_that_stiffens_moves_the_contact_along_the_pad_towards_the_root(name: str) -> None:
    """By a tenth of a millimetre (S1, linear: 0.11) more than for small deflections."""
    spring = spring_of(name)
    for stroke in spring.strokes:
        moved = spring.camshaft_inputs.nose_station - stroke.station
        assert np.all(np.diff(moved) > 0.0)
        assert 0.05e-3 < moved[-1] - spring.law.inputs.shift < 0.2e-3
        assert stroke.station[-1] > spring.camshaft_inputs.pad_start


@pytest.mark.parametrize("name", NONLINEAR)
def test_stiffness_at_rest_and_stress_are_corrected_for_any_law(name: str) -> None:
    spring = spring_of(name)
    at_rest = float(spring.target.stiffness(np.zeros(1))[0])
    assert spring.sized.stiffness_at_rest == pytest.approx(at_rest, rel=1e-3)
    assert max(s.nominal_stress.max() for s in spring.strokes) == pytest.approx(912e6, rel=5e-3)
    assert {c.name for c in spring_checks(spring) if c.status == "fail"} == set()


def test_a_linear_law_is_a_constant_stiffness(tmp_path: Path) -> None:
    """The same closed forms, whichever way it is said."""
    text = (SPECS / "S1.yaml").read_text(encoding="utf-8")
    path = tmp_path / "spec.yaml"
    path.write_text(text.replace("stiffness: 150 N*m/rad", "law: {linear: 150 N*m/rad}"))
    said, plain = (case_of(model) for model in (read_spec(path).model, rotary_model("S1")))
    assert said.shifted.inputs.shift == pytest.approx(0.0, abs=1e-12)
    for name in ("stiffness", "deflection"):
        assert getattr(said.inputs, name) == pytest.approx(getattr(plain.inputs, name), rel=1e-12)
    assert failing(path) == {}


def test_the_contact_stays_for_a_constant_stiffness_and_moves_farther_the_more_it_grows() -> None:
    def shift(stiffening: float) -> float:
        return loaded_shift(
            stiffening, 30.0, span=25e-3, contact_radius=6e-3, count=24, thickness=4.5e-3,
            design_stress=912e6, tip_half_thickness=0.2e-3,
        )  # fmt: skip

    assert shift(1.0) == shift(0.95) == 0.0
    shifts = [shift(s) for s in (1.1, 1.5, 2.0, 3.0)]
    assert shifts[0] > 0.0
    assert shifts == sorted(shifts)
    assert math.isnan(shift(1e4))


def test_the_closed_form_of_stiffening_is_the_compliance_integral() -> None:
    """Integral of (a + shift)^2/lambda^3 over taper and pad, by quadrature, and the arms."""
    span, radius, shift, root, tip = 25e-3, 6e-3, 1e-3, 1.4e-3, 0.2e-3
    lever, w = span - shift, tip / root
    x = lever * (1.0 - np.linspace(1.0, 0.0, 200001) ** 2)
    x = np.append(x, np.linspace(lever, span, 2001)[1:])
    half = np.maximum(root * np.sqrt(np.maximum(1.0 - x / lever, 0.0)), tip)

    def compliance(end: float) -> float:
        return float(np.trapezoid(np.maximum(end - x, 0.0) ** 2 / half**3, x))

    ratio = compliance(span) / compliance(lever) * ((radius + shift) / radius) ** 2
    assert stiffening_by(shift, span, radius, w) == pytest.approx(ratio, rel=1e-4)


def test_laws_that_no_contact_can_give_are_refused_before_any_search(tmp_path: Path) -> None:
    """One that softens, one without stiffness at rest, one that stiffens too much."""
    softening = "{polynomial: [150 N*m/rad, 0 N*m/rad^2, -600 N*m/rad^3]}"
    secant = "secant stiffness of the law at full load over that at rest"
    assert set(failing(with_law(tmp_path, softening))) == {secant}
    at_rest = "stiffness of the law at rest"
    assert failing(with_law(tmp_path, "{polynomial: [0 N*m/rad, 500 N*m/rad^2]}")) == {at_rest: 0.0}
    steep = "{exponential: {scale: 0.001 N*m, decade: 3 deg}}"
    assert set(failing(with_law(tmp_path, steep))) == {secant}


@pytest.mark.parametrize(
    ("target", "message"),
    [
        ("  deflection: 14 deg\n", "target: give one of stiffness, law; none given"),
        (
            "  stiffness: 150 N*m/rad\n  law: {linear: 150 N*m/rad}\n  deflection: 14 deg\n",
            "target: give one of stiffness, law; both given",
        ),
        (
            "  law: {table: [[0 deg, 0 N*m], [5 deg, 10 N*m]]}\n  deflection: 14 deg\n",
            "target.law.table: ends at 5 deg, but must reach the deflection",
        ),
    ],
    ids=["none", "both", "short table"],
)
def test_a_target_is_either_a_stiffness_or_a_law(tmp_path: Path, target: str, message: str) -> None:
    text = (SPECS / "rotary-stiffening.yaml").read_text(encoding="utf-8")
    start, end = text.index("  law:"), text.index("envelope:")
    path = tmp_path / "spec.yaml"
    path.write_text(text[:start] + target + text[end:], encoding="utf-8")
    with pytest.raises(SpecError) as refused:
        read_spec(path)
    assert any(message in str(problem) for problem in refused.value.problems)


def test_a_law_from_a_csv_file_stands_beside_the_spec(tmp_path: Path) -> None:
    rows = "\n".join(
        f"{a}, {100 * math.radians(a) + 600 * math.radians(a) ** 3:.9f}" for a in range(16)
    )
    (tmp_path / "law.csv").write_text(f"angle [deg], torque [N*m]\n{rows}\n")
    table = case_of(read_spec(with_law(tmp_path, "{table: law.csv}")).model)
    formula = case_of(rotary_model("rotary-stiffening"))
    assert table.inputs.stiffness == pytest.approx(formula.inputs.stiffness, rel=1e-4)
    assert table.shifted.inputs.shift == pytest.approx(formula.shifted.inputs.shift, rel=1e-3)
