"""What a refusal advises was tried: eased laws, the limit that is named, changes that work."""

from __future__ import annotations

import math

import numpy as np
import pytest
from rotary_cases import SPECS, problem_for

from springcad.errors import InfeasibleError
from springcad.kinds.given_law import rise_of
from springcad.kinds.law_spec import Law
from springcad.kinds.rotary_flexure.changes import Change, ways_of
from springcad.kinds.rotary_flexure.decision import decide
from springcad.kinds.rotary_flexure.feasibility import feasibility_checks
from springcad.kinds.rotary_flexure.inputs import case_of, rotary_spec
from springcad.kinds.rotary_flexure.law_easing import eased_laws
from springcad.kinds.rotary_flexure.refusal import Judges, changes_that_work
from springcad.kinds.rotary_flexure.shape_refusal import BEND, GAP, NoShapeError, limit_of
from springcad.kinds.rotary_flexure.spec_sections import Optimiser
from springcad.spec.source import Spec, changed_spec, read_spec

END = math.radians(14.0)


def spec_of(name: str, *overrides: str) -> Spec:
    return read_spec(SPECS / f"{name}.yaml", overrides)


def quiet(_: str) -> None:
    pass


def test_an_eased_law_keeps_the_torque_at_its_end_and_gains_slope_at_rest() -> None:
    """(1 - w) c x^2 + w T x/end has the slope w T/end at rest and the torque T at the end."""
    law = Law.model_validate({"polynomial": ["0 N*m/rad", "600 N*m/rad^2"]})
    stiffening = spec_of("rotary-stiffening")
    torque = 600.0 * END**2
    for share, text in eased_laws(law, END):
        eased = rotary_spec(changed_spec(stiffening, [f"target.law={text}"]).model).target.law
        assert eased is not None
        rise = rise_of(eased, END)
        assert float(rise.torque(np.array([END]))[0]) == pytest.approx(torque, rel=1e-3)
        slope = float(rise.stiffness(np.zeros(1))[0])
        assert slope == pytest.approx(share * torque / END, rel=1e-3)


def test_a_law_that_is_no_polynomial_is_eased_to_a_table_of_the_same_blend() -> None:
    law = rotary_spec(spec_of("rotary-exponential").model).target.law
    assert law is not None
    end = math.radians(13.5)
    share, text = next(iter(eased_laws(law, end)))
    spec = changed_spec(spec_of("rotary-exponential"), [f"target.law={text}"])
    eased = rotary_spec(spec.model).target.law
    assert eased is not None
    angle = np.linspace(0.0, end, 50)
    full, mixed = rise_of(law, end).torque(angle), rise_of(eased, end).torque(angle)
    assert mixed == pytest.approx((1.0 - share) * full + share * full[-1] * angle / end, rel=2e-3)


def test_neighbours_that_overlap_name_the_gap() -> None:
    """4 deg more than S2 turns: the shapes that there are overlap by more than the gap wanted."""
    wavy = problem_for("S2", 0.4, serpentine_factor=1.75)
    told = limit_of(NoShapeError("searches", wavy, None), Optimiser(starts=2), 0.3e-3)
    assert told.claim.startswith(GAP)
    assert told.value < 0.0 < told.limit == 0.3e-3


def test_bends_that_are_too_flat_name_the_flattest_that_do() -> None:
    problem = problem_for("S4", 0.1)
    told = limit_of(NoShapeError("searches", problem, None), Optimiser(starts=2), 0.3e-3)
    assert told.claim.startswith(BEND)
    assert 0.1 < told.value < 0.3
    assert told.limit == 0.1


def stiffness(spec: Spec) -> float:
    return rotary_spec(spec.model).target.stiffness or 0.0


def test_the_mildest_change_with_a_shape_that_works_is_told() -> None:
    """Possible from 140 down, a shape below 130, a design below 122: what is told is below that."""
    judges = Judges(
        lambda spec: stiffness(spec) < 140.0,
        lambda spec: stiffness(spec) < 130.0,
        lambda spec: () if stiffness(spec) < 122.0 else None,
    )
    spec = spec_of("S2")
    (words,) = changes_that_work(spec, ways_of(rotary_spec(spec.model)), judges, quiet)
    assert words.startswith("lower target.stiffness from 150 to 1")
    assert float(words.split(" to ")[1].split()[0]) < 122.0


def test_a_change_that_needs_another_is_told_with_it() -> None:
    loose = Change.of("camshaft.backlash", "0.1 mm", "raise camshaft.backlash to 0.1 mm", 0.0)

    def missing(spec: Spec) -> tuple[Change, ...]:
        return () if rotary_spec(spec.model).camshaft.backlash > 0.09e-3 else (loose,)

    judges = Judges(lambda spec: stiffness(spec) < 149.0, lambda _: True, missing)
    spec = spec_of("S2")
    (words,) = changes_that_work(spec, ways_of(rotary_spec(spec.model)), judges, quiet)
    assert words.endswith(" and raise camshaft.backlash to 0.1 mm")


@pytest.mark.parametrize("stiffness", [5, 20, 60])
def test_style_auto_takes_a_straight_ring_that_is_softer_than_its_strength_asks(
    stiffness: int,
) -> None:
    case = case_of(
        spec_of("S1", "flexures.style=auto", f"target.stiffness={stiffness} N*m/rad").model
    )
    assert all(claim.status != "fail" for claim in feasibility_checks(case))


def test_a_law_that_softens_is_refused_in_words_with_one_that_was_designed() -> None:
    softening = "target.law={polynomial: [250 N*m/rad, -400 N*m/rad^2]}"
    with pytest.raises(InfeasibleError, match="the contact would have to leave the tips") as told:
        decide(spec_of("rotary-stiffening", softening), quiet)
    (remedy,) = told.value.remedies
    assert remedy.startswith("set target.law to {linear: 152.3 N*m/rad}")
