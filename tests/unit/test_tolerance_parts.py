"""Parts drawn at random: known distributions, seeds, shares with their errors, and the report."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rotary_cases import SPECS, rotary_model, spring_of

from springcad.errors import InfeasibleError, SpecError
from springcad.kinds.rotary_flexure import tolerance_report
from springcad.kinds.rotary_flexure.as_made import Behaviour, Deviation
from springcad.kinds.rotary_flexure.response_surface import (
    STEP,
    Figures,
    ResponseSurface,
    response_surface,
)
from springcad.kinds.rotary_flexure.summary import summarise
from springcad.kinds.rotary_flexure.tolerance import (
    Parts,
    dominant,
    drawn,
    drawn_parts,
    share_of,
    variance_shares,
)
from springcad.kinds.rotary_flexure.tolerance_spec import Tolerance
from springcad.report.json_report import result_to_json
from springcad.result import Result
from springcad.spec.source import read_spec

SPEC = "rotary-tolerance"


def tolerance(**values: object) -> Tolerance:
    return Tolerance.model_validate(values)


def linear_surface() -> ResponseSurface:
    """1 % of secant per step of the offset, 0.5 % per step of the radius, nothing else."""
    spring = spring_of(SPEC)
    flat = np.array([[1.0], *[[0.0]] * 5])
    secant = np.array([[1.0], [0.01], [0.005], [0.0], [0.0], [0.0]])
    return ResponseSurface(spring, Behaviour(flat, secant, flat, flat, flat))


def parts_of(surface: ResponseSurface, **values: object) -> Parts:
    return drawn_parts(surface, tolerance(**values))


def result_of(*overrides: str) -> Result:
    spec = read_spec(SPECS / f"{SPEC}.yaml", overrides)
    spring = replace(spring_of(SPEC), spec=rotary_model(SPEC, *overrides))
    return summarise(spec, spring)


# Distributions


@pytest.mark.parametrize(
    ("distribution", "deviation"), [("normal", 1.0 / 3.0), ("uniform", 1.0 / math.sqrt(3.0))]
)
def test_mean_and_deviation_of_a_linear_case(distribution: str, deviation: float) -> None:
    """Stiffness goes with the modulus; 3 standard errors of 20 000 parts."""
    count, bound = 20000, 0.06
    parts = parts_of(linear_surface(), modulus=bound, samples=count, distribution=distribution)
    stiffness = parts.figures.stiffness
    wanted = bound * deviation
    assert np.mean(stiffness) == pytest.approx(1.0, abs=3.0 * wanted / math.sqrt(count))
    assert np.std(stiffness) == pytest.approx(wanted, rel=3.0 / math.sqrt(2.0 * count))


def test_uniform_parts_stay_within_the_bounds_and_normal_ones_but_one_in_370() -> None:
    even = drawn(tolerance(edge_offset="0.01 mm", distribution="uniform", samples=20000))
    assert 9.9e-6 < np.max(np.abs(even.edge_offset)) <= 1e-5
    bell = drawn(tolerance(edge_offset="0.01 mm", samples=20000))
    beyond = np.mean(np.abs(bell.edge_offset) > 1e-5)
    assert beyond == pytest.approx(0.0027, abs=3.0 * math.sqrt(0.0027 / 20000))


def test_share_within_the_tolerance_is_that_of_the_normal_distribution() -> None:
    """3 % wanted, standard deviation 2 %: erf(1.5/sqrt 2) = 86.6 %."""
    parts = parts_of(linear_surface(), modulus=0.06, samples=20000)
    share = share_of(np.abs(parts.figures.stiffness - 1.0) <= 0.03)
    assert share.error == pytest.approx(math.sqrt(0.866 * 0.134 / 20000), rel=0.02)
    assert share.value == pytest.approx(math.erf(1.5 / math.sqrt(2.0)), abs=3.0 * share.error)


def test_shares_of_the_variance_are_the_squares_of_slope_times_bound() -> None:
    parts = parts_of(
        linear_surface(), edge_offset="0.01 mm", contact_radius="0.02 mm", modulus=0.02,
        samples=20000,
    )  # fmt: skip
    shares = variance_shares(parts, "stiffness")
    wanted = {"sheet_thickness": 0.0, "edge_offset": 1.0, "contact_radius": 1.0, "modulus": 4.0}
    for name, share in shares.items():
        assert share == pytest.approx(wanted[name] / 6.0, rel=0.05)
    assert dominant(shares) == "modulus"
    assert sum(shares.values()) == pytest.approx(1.0, abs=2e-6)
    total = float(np.var(parts.figures.stiffness))
    alone = sum(float(each.stiffness) for each in parts.variance.values())
    assert total == pytest.approx(alone, rel=0.05)


def test_nothing_is_dominant_where_nothing_varies() -> None:
    parts = parts_of(linear_surface(), sheet_thickness="0.05 mm")
    assert dominant(variance_shares(parts, "gap")) is None
    assert dominant(variance_shares(parts, "stiffness")) == "sheet_thickness"


def test_error_of_a_share_is_binomial_and_never_zero() -> None:
    assert share_of(np.arange(1000) < 300).error == pytest.approx(math.sqrt(0.21 / 1000), rel=2e-3)
    every = share_of(np.ones(1000, dtype=np.bool_))
    assert every.value == 1.0
    assert 0.0 < every.error < 2e-3


# Seeds


def test_same_seed_same_parts_and_more_parts_begin_with_the_same() -> None:
    some, more, other = (
        drawn(tolerance(edge_offset="0.01 mm", modulus=0.02, samples=n, seed=seed))
        for n, seed in ((100, 1), (300, 1), (100, 2))
    )
    for few, many, else_ in zip(some, more, other, strict=True):
        np.testing.assert_array_equal(few, np.asarray(many)[:100])
        assert not np.any(few) or not np.array_equal(few, else_)
    assert abs(np.corrcoef(more.edge_offset, more.modulus)[0, 1]) < 0.2


def test_reports_of_two_runs_are_the_same_to_the_byte() -> None:
    one, other = (result_to_json(result_of(), {}) for _ in range(2))
    assert one == other


# The report


def test_report_tells_shares_dominant_deviations_and_how_good_the_surface_is() -> None:
    result = result_of()
    found = result.response["tolerance"]
    assert isinstance(found, dict)
    assert found["dominant"]["stiffness"] == "edge_offset"
    assert found["dominant"]["gap"] == "edge_offset"
    assert 0.0 < found["surface_error"] < 1e-3
    assert found["share_stiffness"]["value"] > 0.99
    low, middle, high = found["stiffness_Nm_per_rad"]
    assert low < middle < high
    assert middle == pytest.approx(150.0, rel=1e-3)
    assert any("Dominant for the stiffness: offset of the cut edges" in a for a in result.advice)
    assert any("normal distribution" in text for text in result.assumptions)
    assert {"parts right in all of this", "parts that fit without force"} <= {
        outcome.label for outcome in result.outcomes
    }


def test_half_of_the_parts_do_not_fit_without_backlash() -> None:
    """Edges are as often left on as cut off."""
    parts = parts_of(response_surface(spring_of("S1")), edge_offset="0.01 mm")
    fits = share_of(parts.figures.backlash >= 0.0)
    assert fits.value == pytest.approx(0.5, abs=3.0 * fits.error)


def test_advice_on_backlash_lets_every_part_within_the_bounds_fit() -> None:
    advice = result_of("tolerance.edge_offset=0.02 mm").advice
    (line,) = (text for text in advice if "tighter than their slots" in text)
    assert "camshaft.backlash: 0.08 mm" in line
    assert not any("tighter" in text for text in result_of("camshaft.backlash=0.02 mm").advice)


def test_sensitivities_are_told_without_a_tolerance_and_shares_are_not() -> None:
    spec = read_spec(SPECS / "S1.yaml")
    result = summarise(spec, spring_of("S1"))
    assert "tolerance" not in result.response
    told = result.response["sensitivity"]
    assert isinstance(told, dict)
    assert list(told) == list(Deviation._fields)
    sheet, edges = told["sheet_thickness"], told["edge_offset"]
    assert sheet["stiffness_share"] == pytest.approx([-1e-5 / 4.5e-3, 1e-5 / 4.5e-3], abs=1e-7)
    assert edges["step_m"] == STEP
    assert edges["backlash_m"] == pytest.approx([4e-5, -4e-5])
    # Every section bears the design stress: thinner or thicker, some section bears more.
    assert min(edges["stress_share"]) > 0.0


def test_a_spring_without_a_forward_analysis_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(_: object) -> ResponseSurface:
        raise InfeasibleError("angle", 0.1, 0.2, "rad")

    monkeypatch.setattr(tolerance_report, "response_surface", fails)
    result = result_of()
    assert result.response["sensitivity"] is None
    assert "tolerance" not in result.response
    assert any("Sensitivities to tolerances are not known" in a for a in result.assumptions)


def test_corners_beyond_the_flanks_are_told() -> None:
    surface = response_surface(spring_of("S3"))
    parts = parts_of(surface, contact_radius="0.1 mm")
    assert math.isnan(parts.surface_error)
    assert np.all(np.isfinite(parts.figures.stiffness))


def test_every_figure_has_a_value_for_every_part() -> None:
    parts = parts_of(linear_surface(), edge_offset="0.01 mm", samples=1234)
    assert all(len(getattr(parts.figures, name)) == 1234 for name in Figures._fields)


# Specs


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("{seed: 2}", "tolerance: give at least one of sheet_thickness, edge_offset"),
        ("{edge_offset: 0.1 mm}", "tolerance.edge_offset: must be at most 0.2 of flexures.tip"),
        ("{edge_offset: 0.01}", "tolerance.edge_offset: needs a unit, for example 0.01 mm"),
        ("{edge_offset: -0.01 mm}", "tolerance.edge_offset: must be from 0 mm"),
        ("{sheet_thickness: 2 mm}", "tolerance.sheet_thickness: must be at most a fifth"),
        ("{contact_radius: 0.2 mm}", "tolerance.contact_radius: must be from 0 mm to 0.1 mm"),
        ("{modulus: 2 %}", "tolerance.modulus: "),
        ("{modulus: 0.5}", "tolerance.modulus: "),
        ("{modulus: 0.02, samples: 10}", "tolerance.samples: must be from 100 to 20000"),
        ("{modulus: 0.02, distribution: gauss}", "tolerance.distribution: "),
        ("{modulus: 0.02, stiffness: 0}", "tolerance.stiffness: "),
        ("{modulus: 0.02, kerf: 0.1 mm}", "tolerance.kerf: unknown key"),
    ],
)
def test_what_is_wrong_with_a_tolerance_is_said_with_its_line(
    tmp_path: Path, given: str, message: str
) -> None:
    text = (SPECS / "S1.yaml").read_text(encoding="utf-8") + f"tolerance: {given}\n"
    path = tmp_path / "spec.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SpecError) as caught:
        read_spec(path, ())
    (problem,) = caught.value.problems
    assert message in str(problem)
    assert problem.line == text.count("\n")
