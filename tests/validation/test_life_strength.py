"""Life to stress and stress to life: textbook numbers, round trips, and what a report tells."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from springcad.kinds.lasting import Loading
from springcad.kinds.strength import with_strength
from springcad.materials.data import Value, material
from springcad.materials.fatigue_strength import Duty, DutyError, fatigue_strength
from springcad.mechanics.fatigue import (
    MEAN_STRESS,
    SNLine,
    amplitude_and_mean,
    estimated_line,
    life_at_stress,
    miners_sum,
    peak_for_reversed,
    power,
    stress_at_life,
)
from springcad.result import Result
from springcad.spec.common import ProcessSpec
from springcad.spec.material import MaterialSpec

STEEL = material("aisi-420")
LINE = estimated_line(1720e6)
DUTIES = {
    "paper 004": Duty(1e5),
    "careful": Duty(1e5, reliability=0.99, surface="machined"),
    "one way, ground": Duty(3e4, load_ratio=0.0, surface="ground", reliability=0.9),
    "Gerber, as cut, large": Duty(
        2e5, load_ratio=0.3, mean_stress="gerber", surface_factor=0.5, size_factor=0.9
    ),
    "Soderberg": Duty(1e6, load_ratio=-0.5, mean_stress="soderberg", reliability=0.999),
    "own points": Duty(1e5, points=((1e3, 900e6), (2e4, 700e6), (1e6, 300e6)), reliability=0.95),
    "beyond the line": Duty(1e8),
    "up to yield": Duty(1e3),
}


def allowed(name: str) -> float:
    return fatigue_strength(STEEL, DUTIES[name]).stress


@pytest.mark.parametrize("surface", [{"surface": "machined"}, {"surface_factor": 0.6}])
def test_machined_and_99_percent_leave_550_to_620_mpa_of_912(surface: dict) -> None:
    careful = fatigue_strength(STEEL, Duty(1e5, reliability=0.99, **surface)).stress
    assert allowed("paper 004") == pytest.approx(912.0e6, abs=0.05e6)
    assert 550e6 <= careful <= 620e6
    assert 0.37 <= (careful / allowed("paper 004")) ** 2 <= 0.47


@pytest.mark.parametrize("name", DUTIES)
def test_the_factors_lead_from_the_line_to_the_stress(name: str) -> None:
    """Against the line with the factors in it, corrected for the mean stress and cut at yield."""
    duty, strength = DUTIES[name], fatigue_strength(STEEL, DUTIES[name])
    product = math.prod(factor.effect for factor in strength.factors)
    assert strength.start * product == pytest.approx(strength.stress, rel=1e-14)
    cycles = min(duty.cycles, strength.line.points[-1][0])
    amplitude = stress_at_life(strength.line, cycles)
    limit = 1310e6 if duty.mean_stress == "soderberg" else 1720e6
    peak = peak_for_reversed(amplitude, duty.load_ratio, duty.mean_stress, limit)
    assert strength.stress == pytest.approx(min(peak, 1310e6), rel=1e-12)


@pytest.mark.parametrize("name", [name for name in DUTIES if name != "up to yield"])
def test_the_stress_for_a_life_has_that_life(name: str) -> None:
    strength = fatigue_strength(STEEL, DUTIES[name])
    wanted = min(DUTIES[name].cycles, 1e6)
    # At the end of the line the smallest excess of round-off would be a life without end.
    assert strength.life(strength.stress * (1.0 + 1e-12)) == pytest.approx(wanted, rel=1e-9)


def test_estimated_factors_act_on_the_endurance_limit_and_not_at_1e3() -> None:
    full = fatigue_strength(STEEL, Duty(1e6, surface_factor=0.5))
    half_way = fatigue_strength(STEEL, Duty(math.sqrt(1e9), surface_factor=0.5))
    none = fatigue_strength(STEEL, Duty(1e3, surface_factor=0.5))
    effects = [strength.factors[0].effect for strength in (full, half_way, none)]
    assert effects == pytest.approx([0.5, math.sqrt(0.5), 1.0])
    own = fatigue_strength(STEEL, Duty(1e3, surface_factor=0.5, points=((1e3, 9e8), (1e6, 4e8))))
    assert own.factors[0].effect == 0.5


@pytest.mark.parametrize("correction", MEAN_STRESS)
@pytest.mark.parametrize("ratio", [-1.0, -0.4, 0.0, 0.5, 0.9])
def test_mean_stress_corrections_and_their_inverses_agree(correction: str, ratio: float) -> None:
    peak = peak_for_reversed(500e6, ratio, correction, 1720e6)
    amplitude, mean = amplitude_and_mean(peak, ratio)
    assert MEAN_STRESS[correction](amplitude, mean, 1720e6) == pytest.approx(500e6, rel=1e-12)
    assert peak >= 500e6


def test_the_stress_never_passes_yield_in_bending() -> None:
    assert allowed("up to yield") == 1310e6
    polymer = material("pet")
    points = ((1e3, 200e6), (1e6, 150e6))
    assert polymer.flexural_strength is not None
    capped = fatigue_strength(polymer, Duty(1e4, points=points))
    assert capped.stress == pytest.approx(polymer.flexural_strength.value)


def test_points_of_the_user_go_before_data_and_data_before_nothing() -> None:
    titanium = material("ti-6al-4v")
    assert fatigue_strength(titanium, Duty(1e5)).stress == 570e6
    assert fatigue_strength(titanium, Duty(1e5, points=((1e4, 8e8), (1e6, 6e8)))).stress > 570e6
    with pytest.raises(DutyError, match="up to 10 million cycles only"):
        fatigue_strength(titanium, Duty(1e8))


def test_an_endurance_limit_of_the_source_is_not_that_of_a_softer_temper() -> None:
    soft = replace(STEEL, ultimate_strength=Value(700e6, "spec"), yield_strength=Value(4e8, "spec"))
    assert fatigue_strength(soft, Duty(1e8)).stress == pytest.approx(350e6)
    assert fatigue_strength(STEEL, Duty(1e8)).stress == pytest.approx(670e6)


def test_lives_on_a_line_of_several_points() -> None:
    line = SNLine(((1e3, 900e6), (1e4, 500e6), (1e7, 200e6)))
    for cycles in (1e3, 5e3, 1e4, 1e5, 1e7):
        assert life_at_stress(line, stress_at_life(line, cycles)) == pytest.approx(cycles)
    assert life_at_stress(line, 100e6) == 1e7
    with pytest.raises(ValueError, match="fewer than 1e3 cycles"):
        life_at_stress(line, 901e6)
    assert [power(n) for n in (1e3, 2.5e5, 123456.0)] == ["1e3", "2.5e5", "1.235e5"]


def test_miners_sum_of_one_level_is_the_share_of_its_life() -> None:
    for stress in (800e6, 912e6, 1500e6):
        assert miners_sum(LINE, [(stress, 3e4)]) == pytest.approx(
            3e4 / life_at_stress(LINE, stress)
        )


def test_miners_sum_adds_up_and_knows_the_endurance_limit() -> None:
    high, low, small = (900e6, 1e4), (750e6, 2e5), (400e6, 1e6)
    assert miners_sum(LINE, [high, low]) == pytest.approx(
        miners_sum(LINE, [high]) + miners_sum(LINE, [low])
    )
    assert miners_sum(LINE, [small]) == 0.0
    # Elementary Miner: beside a damaging level small ones count, by the line gone on with.
    slope = math.log(1e3) / math.log(1548 / 700)
    added = miners_sum(LINE, [high, small]) - miners_sum(LINE, [high])
    assert added == pytest.approx(1e6 / (1e6 * (700 / 400) ** slope), rel=1e-9)
    with pytest.raises(ValueError, match="beyond the S-N line"):
        miners_sum(LINE, [high, (1600e6, 1.0)])


SHARE = np.linspace(0.1, 1.0, 10)
EMPTY = Result("rotary-flexure", "x", {}, {}, {}, (), (), ())


def told(loading: Loading, process: str = "wire-edm", **material_keys: object) -> Result:
    keys = {"name": "aisi-420", **material_keys}
    spec = MaterialSpec.model_validate(keys)
    return with_strength(EMPTY, spec, ProcessSpec(name=process), loading)


def loading(peak: float = 900e6, **keys: object) -> Loading:
    return Loading("nominal stress", SHARE, peak * SHARE, torque=40.0 * SHARE, **keys)


def outcomes(result: Result) -> dict[str, float]:
    return {outcome.label: outcome.value for outcome in result.outcomes}


def test_the_lines_of_the_report_multiply_to_the_design_stress() -> None:
    life = {"cycles": 1e5, "load_ratio": 0.0, "reliability": 0.99, "surface": "machined"}
    result = told(loading(), life=life)
    lines = outcomes(result)
    factors = [value for label, value in lines.items() if label.startswith("factor: ")]
    assert len(factors) == 5
    assert lines["S-N line at the life, 1e5 cycles"] * math.prod(factors) == pytest.approx(
        lines["design stress from the life"]
    )
    assert (lines["S-N line at 1e3 cycles"], lines["S-N line at 1e6 cycles"]) == (1548e6, 700e6)
    entry = result.design["strength"]
    for name, factor in entry["factors"].items():
        assert factor["of_energy"] == factor["of_stress"] ** 2, name
    assert entry["factors"]["reliability"]["factor"] == 0.814


def test_a_favourable_life_is_told_what_a_careful_one_leaves() -> None:
    text = " ".join(told(loading(), life={"cycles": 1e5}).advice)
    assert "912 MPa are for polished parts, half of which survive" in text
    assert "allows 582 MPa, and 41% of the energy" in text
    assert told(loading(), life={"cycles": 1e5, "reliability": 0.9}).advice == ()


def test_a_factor_of_ones_own_and_an_unfinished_cut_carry_a_warning() -> None:
    own = told(loading(), life={"cycles": 1e5, "surface_factor": 0.6}).assumptions
    assert any("None is published for wire EDM" in text for text in own)
    cut = told(loading(), life={"cycles": 1e5}).assumptions
    assert any("taken as polished, which one cut by wire-edm is only if" in text for text in cut)
    milled = told(loading(), "milling", life={"cycles": 1e5, "surface": "machined"}).assumptions
    assert not any("Warning" in text for text in milled)


def test_life_and_safety_of_a_finished_design() -> None:
    result = told(loading(960e6, local={"root fillet stress": 1478e6}), life={"cycles": 1e5})
    line, response = estimated_line(1720e6), result.response
    assert response["life_cycles"] == pytest.approx(life_at_stress(line, 960e6))
    assert response["local_life_cycles"]["root_fillet_stress"] == pytest.approx(
        life_at_stress(line, 1478e6)
    )
    assert response["stress_safety_factor"] == pytest.approx(911.988 / 960, rel=1e-6)
    assert response["life_safety_factor"] == pytest.approx(response["life_cycles"] / 1e5)
    (claim,) = (check for check in result.checks if check.name.startswith("root fillet"))
    assert (claim.status, claim.limit) == ("warn", pytest.approx(911.988e6, rel=1e-6))


@pytest.mark.parametrize(
    ("peak", "cycles", "note"),
    [
        (600e6, None, "below the endurance limit, 700 MPa"),
        (1600e6, None, "beyond the S-N line: fewer than 1e3"),
        (912e6, 1e5, "S-N line estimated from S_ut"),
    ],
)
def test_a_given_stress_has_a_life_as_far_as_the_line_goes(
    peak: float, cycles: float | None, note: str
) -> None:
    result = told(loading(peak), design_stress="912 MPa")
    assert result.response["life_note"] == note
    assert result.response["life_cycles"] == (cycles and pytest.approx(cycles, rel=2e-4))
    assert result.checks == ()


def test_no_life_is_told_where_nothing_is_known() -> None:
    result = told(loading(40e6), name="pom-c", design_stress="45 MPa")
    assert result.response["life_cycles"] is None
    assert result.response["life_note"] == "nothing is known of the fatigue of this material"
    assert result.outcomes == ()
    assert "nothing is known of the fatigue of pom-c" in result.assumptions[-1]


def test_torques_and_shares_of_a_linear_spring_do_the_same_damage() -> None:
    def total(histogram: list) -> float:
        result = told(loading(), life={"cycles": 1e5, "histogram": histogram})
        return float(result.response["miner_sum"])

    by_torque = total([["20 N*m", 1e4], ["36 N*m", 500]])
    assert by_torque == pytest.approx(total([[0.5, 1e4], [0.9, 500]]))
    assert by_torque == pytest.approx(miners_sum(LINE, [(450e6, 1e4), (810e6, 500)]))


def test_a_histogram_beyond_the_life_fails_with_a_change_that_cures_it() -> None:
    histogram = [[1.0, 2e5], [0.9, 1e5]]
    result = told(loading(912e6), life={"cycles": 1e5, "histogram": histogram})
    failed = {check.name: check for check in result.checks if check.status == "fail"}
    assert set(failed) == {"Miner's sum of the histogram"}
    remedy = failed["Miner's sum of the histogram"].remedy
    cycles = float(remedy.rpartition("material.life.cycles to ")[2])
    again = MaterialSpec.model_validate({"name": "aisi-420", "life": {"cycles": cycles}})
    cured = told(loading(again.design_stress), life={"cycles": cycles, "histogram": histogram})
    assert 0.97 < cured.response["miner_sum"] <= 1.0


def test_a_load_beyond_the_deflection_is_refused_a_sum() -> None:
    result = told(loading(), life={"cycles": 1e5, "histogram": [["41 N*m", 10]]})
    assert result.response["miner_sum"] is None
    failed = [check.name for check in result.checks if check.status == "fail"]
    assert failed[0] == "largest load of the histogram over that at the deflection"


def test_a_large_section_asks_for_its_size_factor() -> None:
    def claim(section: tuple[float, float], factor: float):
        life = {"cycles": 1e5, "size_factor": factor}
        (only,) = told(loading(section=section), life=life).checks
        return only

    assert claim((4e-3, 9e-3), 1.0).status == "pass"
    large = claim((20e-3, 20e-3), 1.0)
    assert (large.status, large.limit) == ("warn", pytest.approx(1.24 * 16.16**-0.107))
    assert claim((20e-3, 20e-3), 0.92).status == "pass"


def test_an_element_bent_to_one_side_is_told_of_its_load_ratio() -> None:
    one_sided = loading(load_ratio=0.0)
    careful = {"cycles": 1e5, "reliability": 0.9}
    assert "load_ratio may be 0" in told(one_sided, life=careful).advice[0]
    assert told(one_sided, life={**careful, "load_ratio": 0.0}).advice == ()
    response = told(one_sided, design_stress="912 MPa").response
    assert response["life_cycles"] is None  # by Goodman from 0 to 900 MPa is below the limit
    assert "below the endurance limit" in str(response["life_note"])
