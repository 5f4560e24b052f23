"""What a refusal advises was tried: eased laws, the limit that is named, changes that work."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np
import pytest
from rotary_cases import SPECS, problem_for

from springcad.errors import InfeasibleError
from springcad.kinds.given_law import rise_of
from springcad.kinds.law_spec import Law
from springcad.kinds.rotary_flexure.changes import Change
from springcad.kinds.rotary_flexure.control_points import (
    ControlPointOutcome,
    optimise_control_points,
)
from springcad.kinds.rotary_flexure.decision import decide, given_by
from springcad.kinds.rotary_flexure.feasibility import feasibility_checks
from springcad.kinds.rotary_flexure.inputs import case_of, rotary_spec, target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.law_easing import eased_laws
from springcad.kinds.rotary_flexure.refusal import (
    DESIGNS_OF_A_WAY,
    Judges,
    Verdict,
    changes_that_work,
)
from springcad.kinds.rotary_flexure.shape import straight_ribbon
from springcad.kinds.rotary_flexure.shape_refusal import BEND, GAP, NoShapeError, limit_of
from springcad.kinds.rotary_flexure.sizing import size_flexure
from springcad.kinds.rotary_flexure.spec_sections import Optimiser
from springcad.kinds.rotary_flexure.ways import KNOB, Way, rounds_of
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


def deflection(spec: Spec) -> float:
    return math.degrees(float(rotary_spec(spec.model).target.deflection))


SOFTER: Way = KNOB["target.stiffness"].turned(
    rotary_spec(spec_of("S2").model), -1, (1.01, 1.02, 1.05, 1.1, 1.2, 1.3, 1.5, 2.0)
)
"""150 N m/rad lowered to 149, 147, 143, 136, 125, 115, 100 and 75."""


def all_but(limit: float) -> Callable[[Spec], Verdict]:
    """A design that needs less stiffness than a limit, and misses it by what it has more."""
    return lambda spec: (
        Verdict()
        if stiffness(spec) <= limit
        else Verdict.missed("stiffness", stiffness(spec), limit)
    )


def test_the_mildest_change_with_room_that_works_is_told() -> None:
    """Possible below 148, room below 140; so 136 is designed, and works."""
    judges = Judges(lambda spec: stiffness(spec) < 148.0, lambda spec: stiffness(spec) < 140.0,
                    all_but(138.0))  # fmt: skip
    words = changes_that_work(spec_of("S2"), [[SOFTER]], judges, quiet)
    assert words == ("lower target.stiffness from 150 to 136 N*m/rad",)


def test_two_designs_that_fail_tell_how_far_to_go() -> None:
    """149 and 136 fail by shares that fall in proportion: the third is the first that is enough."""
    judges = Judges(lambda _: True, lambda _: True, all_but(101.0))
    words = changes_that_work(spec_of("S2"), [[SOFTER]], judges, quiet)
    assert words == ("lower target.stiffness from 150 to 100 N*m/rad",)


def test_a_way_that_gets_no_nearer_is_left_after_two_designs() -> None:
    tried: list[str] = []
    judges = Judges(lambda _: True, lambda _: True, lambda _: Verdict("gap", 0.3))
    assert changes_that_work(spec_of("S2"), [[SOFTER]], judges, tried.append) == ()
    assert len(tried) == 2 < DESIGNS_OF_A_WAY


def test_a_change_that_needs_another_is_told_with_it() -> None:
    loose = Change.of("camshaft.backlash", "0.1 mm", "raise camshaft.backlash to 0.1 mm", 0.0)

    def design(spec: Spec) -> Verdict:
        enough = rotary_spec(spec.model).camshaft.backlash > 0.09e-3
        return Verdict() if enough else Verdict("interference", 1.0, loose)

    judges = Judges(lambda _: True, lambda _: True, design)
    (words,) = changes_that_work(spec_of("S2"), [[SOFTER]], judges, quiet)
    assert words.endswith(" and raise camshaft.backlash to 0.1 mm")


def told_of_s1(is_possible: Callable[[Spec], bool]) -> tuple[str, ...]:
    """Advice for S1 where whatever is possible can be designed."""
    spec = spec_of("S1", "flexures.style=auto", "flexures.root_fillet=auto")
    judges = Judges(is_possible, lambda _: True, lambda _: Verdict())
    return changes_that_work(spec, rounds_of(rotary_spec(spec.model), ()), judges, quiet)


def test_two_numbers_are_changed_where_one_alone_does_not_help() -> None:
    def both(spec: Spec) -> bool:
        model = rotary_spec(spec.model)
        return int(model.flexures.count) <= 20 and float(model.envelope.contact_radius) > 6.5e-3

    assert told_of_s1(both) == (
        "lower flexures.count from 24 to 20 and raise envelope.contact_radius from 6 to 6.6 mm",
    )


def test_a_number_is_changed_beyond_its_double_where_nothing_else_helps() -> None:
    far = told_of_s1(lambda spec: deflection(spec) < 5.0)
    assert far == ("lower target.deflection from 12.56 to 4.8 deg",)


@pytest.mark.parametrize(
    ("key", "limit", "value"),
    [
        ("target.deflection", math.radians(12.5), "12.49 deg"),
        ("target.deflection", math.radians(12.5012), "12.5 deg"),
        ("flexures.min_gap", 0.2533e-3, "0.25 mm"),
    ],
)
def test_a_limit_that_was_found_is_advised_to_the_hundredth_below(
    key: str, limit: float, value: str
) -> None:
    model = rotary_spec(spec_of("S1", "flexures.min_gap=0.4 mm").model)
    (change,) = KNOB[key].lowered_below(model, limit)
    assert change.overrides == (f"{key}={value}",)
    assert KNOB[key].lowered_below(model, 1.0) == ()


def test_a_joint_is_told_the_limit_of_the_joint() -> None:
    """Two springs in series turn twice as far as each, the limit of which is in the message."""
    model = rotary_spec(spec_of("rotary-stack", "target.deflection=25 deg").model)
    case = case_of(model).shifted
    with pytest.raises(InfeasibleError) as refused:
        size_flexure(model, case, design_law(case.inputs), target_of(model), quiet)
    (change,) = given_by(refused.value, model)
    (limit,) = re.findall(r"lower target\.deflection from 25 to ([0-9.]+) deg", change.words)
    assert 0.0 < 2.0 * math.degrees(refused.value.limit) - float(limit) <= 0.01
    lowered = rotary_spec(changed_spec(spec_of("rotary-stack"), change.overrides).model)
    case = case_of(lowered).shifted
    assert size_flexure(lowered, case, design_law(case.inputs), target_of(lowered), quiet).level < 1


@pytest.mark.parametrize(
    ("gap", "bend", "factor", "claim"),
    [(0.1e-3, 0.3, 1.6, GAP), (0.29e-3, 0.6, 1.6, BEND), (0.29e-3, 0.31, 1.0, "serpentine factor")],
)
def test_control_points_name_the_limit_that_is_missed_by_most(
    gap: float, bend: float, factor: float, claim: str
) -> None:
    problem = problem_for("S2", 0.3, serpentine_factor=1.6)
    nearest = ControlPointOutcome(
        feasible=False, violation=1.0, knots=np.zeros((4, 2)), ribbon=straight_ribbon(problem),
        cost=0.0, smallest_gap=gap, largest_bend=bend, serpentine_factor=factor, starts=1,
        feasible_starts=0, variables=np.zeros(5),
    )  # fmt: skip
    told = limit_of(NoShapeError("searches", problem, nearest), Optimiser(), 0.3e-3)
    assert told.claim.startswith(claim)


def test_a_search_for_control_points_that_ends_nowhere_says_what_it_missed() -> None:
    """Bends of 0.05 cannot store the energy of S2 in two waves."""
    problem = problem_for("S2", 0.05)
    nearest = optimise_control_points(problem, starts=1, seed=1)
    assert not nearest.feasible
    told = limit_of(NoShapeError("searches", problem, nearest), Optimiser(starts=1), 0.3e-3)
    assert told.claim.startswith((GAP, BEND, "serpentine factor"))
    assert told.value != pytest.approx(told.limit, rel=0.01)


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
