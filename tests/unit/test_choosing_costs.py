"""A choice looks at few rings, and at dear limits of a spring only where the cheap ones hold."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import numpy as np
import pytest
from rotary_cases import rotary_model

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure import climbing, design
from springcad.kinds.rotary_flexure.aim import Aim, Pair
from springcad.kinds.rotary_flexure.candidates import WEAK_CORE, candidate, core_shear, forbidden
from springcad.kinds.rotary_flexure.checks import full_load_gaps
from springcad.kinds.rotary_flexure.climbing import Climb
from springcad.kinds.rotary_flexure.design import spring_of, spring_with_room
from springcad.kinds.rotary_flexure.screening import Screened
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.tried import Design, Stop

RING = Pair(24, 4.5e-3)
PLAIN = ("optimiser={starts: 2}", "flexures.min_deformed_gap=0.15 mm")


def aim_of(*overrides: str) -> Aim:
    return Aim.of(rotary_model("rotary-auto", *PLAIN, *overrides))


@pytest.fixture(scope="module")
def spring() -> Spring:
    """24 flexures with contact radius 4.5 mm at 12.5 deg: a gap to spare."""
    trial = aim_of().at(RING, 250)
    return spring_of(trial.spec, trial.case, (), lambda _: None)


def test_torsion_is_known_within_a_percent_before_there_is_a_camshaft(spring: Spring) -> None:
    """The core below the tips at the end of the flanks: closed form against the drawn slots."""
    foreseen = core_shear(aim_of().at(RING, 250))
    assert foreseen == pytest.approx(spring.camshaft.hub_stress, rel=0.01)


def test_gaps_at_full_load_are_known_before_there_is_a_camshaft(spring: Spring) -> None:
    """Within 2 um of the stroke on the drawn camshaft, in each direction."""
    foreseen = [claim.value for claim in full_load_gaps(spring.spec, spring.case, spring.sized)]
    measured = [float(stroke.gap.min()) for stroke in spring.strokes]
    assert foreseen == pytest.approx(measured, abs=2e-6)


def test_no_camshaft_is_made_for_flexures_that_come_too_close(
    spring: Spring, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The gap of the same spring is refused, by name, where a little more is asked for."""
    gap = min(float(stroke.gap.min()) for stroke in spring.strokes)
    flexures = spring.spec.flexures.model_copy(update={"min_deformed_gap": gap + 1e-5})
    spec = spring.spec.model_copy(update={"flexures": flexures})
    monkeypatch.setattr(design, "size_flexure", lambda *_: spring.sized)
    monkeypatch.setattr(design, "design_camshaft", None)
    with pytest.raises(InfeasibleError) as told:
        spring_with_room(spec, spring.case, (), lambda _: None)
    assert told.value.claim.startswith("gap between deformed flexures")
    assert told.value.limit - told.value.value == pytest.approx(1e-5, abs=2e-6)


def test_a_camshaft_that_would_be_twisted_off_is_forbidden_before_any_search() -> None:
    """28 flexures need r = 4.02 mm; a hole of 3 mm leaves it 18 % too weak at 14.9 deg.

    The slots leave 4.02 - 0.2 (nose) - 0.114 (clearance) = 3.706 mm: 2 T R / (pi (R^4 - b^4)) at
    the end of the flanks, 4 % beyond the deflection.
    """
    aim = aim_of()
    weak = Pair(28, 4.02e-3)
    trial = aim.at(weak, 298)
    assert forbidden(trial) == (WEAK_CORE,)
    torque, core, bore = 150.0 * 1.04 * np.radians(14.9), 3.706e-3, 3e-3
    by_hand = 2.0 * torque * core / (np.pi * (core**4 - bore**4))
    assert core_shear(trial) == pytest.approx(by_hand, rel=1e-3)
    ring = candidate(aim, weak)
    assert ring is not None
    assert not forbidden(aim.at(weak, ring.bound))
    assert forbidden(aim.at(weak, ring.bound + 1))


def test_a_core_within_its_bore_bears_no_torque() -> None:
    trial = aim_of().at(RING, 250)
    bored = replace(trial, case=replace(trial.case, camshaft_bore_radius=4.5e-3))
    assert core_shear(bored) == np.inf


class Linear(Climb):
    """Every ring's gap falls by 10 um a level and is used up half way from level 300 to 301."""

    def designed(self, pair: Pair, level: int, bound: int) -> Design:
        lack = 1e-5 * (level - 300.5)
        stop = Stop("gap between flexures at rest", 0.0, lack, "m") if lack > 0.0 else None
        design = Design(pair, level, bound, None if stop else cast("Spring", level), stop)
        self.designs.append(design)
        self.best = self.best if stop else design
        return design


def linear(monkeypatch: pytest.MonkeyPatch, *levels: float) -> Linear:
    """A climb over rings whose shapes promise these levels, and a gap that falls twice as fast."""
    monkeypatch.setattr(climbing, "_spare_gap", lambda level: 1e-5 * (300.5 - level))
    climb = Linear(aim_of(), spring_of, lambda _: None)
    for count, level in enumerate(levels, 24):
        climb.climb(Screened(Pair(count, 4.5e-3), 260, 320, level, 2e-5))
    return climb


def test_the_gap_that_is_left_says_how_far_to_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """35 um at 297 are one step of the 20 um expected, 25 um at 298 two of the 10 um measured."""
    climb = linear(monkeypatch, 297.3)
    assert [design.level for design in climb.designs] == [297, 298, 300, 301]
    assert climb.best is not None
    assert climb.best.level == 300


def test_between_a_pass_and_a_failure_the_gap_is_used_up_on_a_line(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """From one that fails before any passes the lack says how far down."""
    climb = linear(monkeypatch, 304.2)
    assert [design.level for design in climb.designs] == [304, 302, 298, 300, 301]


def test_a_ring_that_will_not_reach_the_next_level_is_not_designed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The first has told by how much shapes are wrong: 0.4 levels less may still do, 0.9 not."""
    climb = linear(monkeypatch, 297.3, 296.4)
    assert {design.pair.count for design in climb.designs} == {24}
    climb = linear(monkeypatch, 297.3, 296.9)
    assert [design.level for design in climb.designs if design.pair.count == 25] == [301]
