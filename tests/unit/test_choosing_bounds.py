"""Choosing count, contact radius and rim: closed forms, rules of the spec, and the rim."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rotary_cases import rotary_model

from springcad.errors import SpecError
from springcad.kinds.rotary_flexure.aim import Aim, Pair, is_open, objective_of
from springcad.kinds.rotary_flexure.candidates import candidate, candidates, forbidden, range_checks
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.rim import RIM_STEP, rim_stress, rim_width, thinnest_rim
from springcad.spec.source import read_spec

SPEC = Path(__file__).parents[2] / "specs/rotary-auto.yaml"
FIXED = ("flexures.count=31", "envelope.contact_radius=5.1 mm")
ROOMY = ("envelope.root_radius=auto", "envelope.outer_radius=auto", "target.deflection=13 deg")


def aim_of(*overrides: str) -> Aim:
    return Aim.of(rotary_model("rotary-auto", *overrides))


def test_nothing_beyond_the_bound_passes_the_closed_forms() -> None:
    """The bound prunes: no level above it, on a grid of rings, is within the limits."""
    aim = aim_of()
    for ring in candidates(aim)[::12]:
        for level in (ring.bound + 1, ring.bound + 5, ring.bound + 40):
            assert forbidden(aim.at(ring.pair, level)), ring
        assert not forbidden(aim.at(ring.pair, ring.bound))


def test_the_bound_is_below_that_of_a_full_disk() -> None:
    """Paper 004, Eq. 10 with a density factor of 1: 16.7 deg at S4's contact radius."""
    ring = candidate(aim_of(*FIXED), Pair(31, 5.1e-3))
    assert ring is not None
    assert 14.9 < np.degrees(aim_of(*FIXED).value(ring.bound)) < 16.74


def test_straight_rings_reach_what_eq_11_says() -> None:
    """Straight flexures of S4's count and radius: 12.07 deg; of 28 at 4 mm: 13.3 deg, on a
    camshaft without a bore, which would be twisted off before."""
    solid = "camshaft={min_tooth: 0.5 mm}"
    for pair, degrees in ((Pair(31, 5.1e-3), 12.07), (Pair(28, 4.02e-3), 13.3)):
        ring = candidate(aim_of(solid), pair)
        assert ring is not None
        assert np.degrees(aim_of().value(ring.straight)) == pytest.approx(degrees, abs=0.06)


def test_levels_are_numbers_that_people_type() -> None:
    trial = aim_of().at(Pair(28, 4.02e-3), 300)
    assert trial.case.inputs.deflection == pytest.approx(np.radians(15.0), rel=1e-12)
    aim = aim_of("objective=diameter", *ROOMY)
    inputs = aim.at(Pair(28, 4.02e-3), 200).case.inputs
    assert (inputs.root_radius * 1e4) == pytest.approx(round(inputs.root_radius * 1e4), abs=1e-6)


def test_a_margin_tightens_every_limit_that_the_choice_moves() -> None:
    aim = aim_of("objective=margin", "target.deflection=13 deg")
    plain, tight = (aim.at(Pair(24, 4.0e-3), level) for level in (0, 25))
    assert tight.case.inputs.design_stress == pytest.approx(plain.case.inputs.design_stress / 1.25)
    assert tight.case.yield_strength == pytest.approx(plain.case.yield_strength / 1.25)
    assert tight.case.min_tooth == pytest.approx(1.25 * plain.case.min_tooth)
    assert tight.case.min_gap == pytest.approx(1.25 * plain.case.min_gap)


def test_a_rim_of_the_width_found_bears_exactly_the_stress() -> None:
    for pull in (0.0, 400.0):
        width = rim_width(220.0, 20.9e-3, 4.5e-3, 912e6, pull)
        assert rim_stress(220.0, 20.9e-3, 4.5e-3, width, pull) == pytest.approx(912e6, rel=1e-12)


def test_a_long_flexure_asks_for_a_rim_of_its_root_thickness_over_the_root_of_two() -> None:
    """Half of the root's moment on either side: 6 (M/2)/(t w^2) = 6 M/(t h^2)."""
    force, span, thickness, stress = 100.0, 1.0, 4.5e-3, 912e6
    root = np.sqrt(6.0 * force * span / (thickness * stress))
    width = rim_width(force, span, thickness, stress, 0.0)
    assert width == pytest.approx(root / np.sqrt(2.0), rel=0.01)


def test_dowels_and_the_process_thicken_the_rim() -> None:
    spec = rotary_model("S4")
    law = design_law(aim_of(*FIXED).at(Pair(31, 5.1e-3), 268).case.inputs)
    held = thinnest_rim(spec, law)
    bore = spec.mounting.model_copy(update={"dowels": None})
    free = thinnest_rim(spec.model_copy(update={"mounting": bore}), law)
    assert held > free + 1e-3 - RIM_STEP
    little = design_law(replace(law.inputs, deflection=1e-3))
    rules = spec.process.rules
    assert thinnest_rim(spec.model_copy(update={"mounting": bore}), little) < free
    assert thinnest_rim(spec, little) >= rules.min_web


def test_what_is_not_said_is_the_largest_margin_or_only_the_rim() -> None:
    spec = rotary_model("rotary-auto")
    assert is_open(spec)
    assert objective_of(spec) == "deflection"
    assert not is_open(rotary_model("S4"))
    assert objective_of(rotary_model("rotary-auto", "target.deflection=13 deg")) == "margin"
    assert objective_of(rotary_model("S4", "envelope.outer_radius=auto")) == "mass"


def test_check_tells_the_range() -> None:
    rings, bound = range_checks(aim_of())
    assert rings.status == bound.status == "pass"
    assert "counts" in rings.name
    assert np.degrees(bound.value) == pytest.approx(16.8, abs=0.1)


def test_an_impossible_range_is_refused_with_what_fails() -> None:
    narrow = ("envelope.root_radius=3 mm", "envelope.contact_radius=2.9 mm", "camshaft={}")
    (rings,) = range_checks(aim_of(*narrow))
    assert rings.status == "fail"
    assert rings.remedy


@pytest.mark.parametrize(
    ("overrides", "message"),
    [
        (("objective=mass",), "max is for objective: deflection"),
        (("objective=deflection", "target.deflection=13 deg"), "needs target.deflection: max"),
        (("objective=diameter", "target.deflection=13 deg"), "needs envelope.root_radius: auto"),
        (("envelope.root_radius=auto",), "needs objective: diameter"),
        (
            ("objective=mass", "target.deflection=13 deg", *FIXED),
            "nothing is left to choose",
        ),
        (("optimiser={form: control-points}",), "need form: curvature"),
        (("target={law: {linear: 150 N*m/rad}, deflection: max}",), "max needs target.stiffness"),
        (("camshaft.min_tooth=0.1 mm",), "is below"),
        (("flexures.count=2",), "must be from 3 to 400"),
    ],
)
def test_silly_combinations_are_refused(overrides: tuple[str, ...], message: str) -> None:
    with pytest.raises(SpecError, match=message):
        read_spec(SPEC, overrides)
