"""What straight flexures tell of their limit is used: few designs, and few that fail."""

from __future__ import annotations

import math
from typing import cast

import pytest
from rotary_cases import rotary_model

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure import climbing
from springcad.kinds.rotary_flexure.aim import Aim, Pair
from springcad.kinds.rotary_flexure.candidates import Candidate
from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.choosing import choose
from springcad.kinds.rotary_flexure.climbing import DESIGNS, STRAIGHT_DESIGNS, Climb
from springcad.kinds.rotary_flexure.design import spring_of
from springcad.kinds.rotary_flexure.screening import Screened
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.straight_limit import STRAIGHT_LIMIT
from springcad.kinds.rotary_flexure.tried import Design, Stop, steps_down
from springcad.result import Check, Progress

LIMIT = math.radians(12.76)
RING = Pair(24, 6e-3)


class UpToLimit(Climb):
    """Straight flexures, good up to 12.76 deg; a refusal names that."""

    def designed(self, pair: Pair, level: int, bound: int) -> Design:
        asked = self.aim.value(level)
        stop = Stop(STRAIGHT_LIMIT, asked, LIMIT, "rad") if asked > LIMIT else None
        design = Design(pair, level, bound, None if stop else cast("Spring", level), stop)
        self.designs.append(design)
        self.best = self.best if stop else design
        return design


@pytest.fixture
def climb(monkeypatch: pytest.MonkeyPatch) -> UpToLimit:
    monkeypatch.setattr(climbing, "_spare_gap", lambda _: 1e-3)
    return UpToLimit(Aim.of(rotary_model("rotary-auto")), spring_of, lambda _: None)


@pytest.mark.parametrize("start", [250, 254, 256, 275])
def test_a_named_limit_is_the_next_level_and_the_last(climb: UpToLimit, start: int) -> None:
    """12.75 deg is the last step of 0.05 deg; one design above it is enough to know."""
    climb.climb(Screened(RING, 251, 280, start, 1e-6))
    assert climb.best is not None
    assert climb.best.level == 255
    assert sum(design.stop is not None for design in climb.designs) <= 1


def test_where_closed_forms_promise_too_much_the_named_limit_is_fallen_back_on(
    climb: UpToLimit,
) -> None:
    climb.straight([Candidate(RING, 1, 262, 300, 1.0)])
    assert [design.level for design in climb.designs] == [262, 255]
    assert climb.best is not None


@pytest.mark.parametrize(
    ("objective", "target"), [("margin", "12 deg"), ("diameter", "12 deg"), ("deflection", "max")]
)
def test_levels_follow_from_the_share_of_the_deflection(objective: str, target: str) -> None:
    """A share of 0.9: a lower margin, a larger root or a smaller deflection makes up for it."""
    overrides = [f"target.deflection={target}", f"objective={objective}"]
    if objective == "diameter":
        overrides += ["envelope.root_radius=auto", "envelope.outer_radius=auto"]
    aim = Aim.of(rotary_model("rotary-auto", *overrides))
    level = 240 if objective == "deflection" else 20
    before, after = aim.value(level), aim.value(aim.level_within(RING, level, 0.9))
    wanted = {
        "deflection": 0.9 * before,
        "margin": 0.9 * (1.0 + before) - 1.0,
        "diameter": 6e-3 + (before - 6e-3) / 0.9,
    }[objective]
    step = {"deflection": math.radians(0.05), "margin": 0.01, "diameter": aim.root_step}[objective]
    assert after == pytest.approx(wanted, abs=1.01 * step)
    assert (after >= wanted - 1e-9) if objective == "diameter" else (after <= wanted + 1e-9)


def test_a_limit_without_a_measure_is_halved_down_to_straight_flexures() -> None:
    """A careful step first, since most rings miss by little."""
    ring = Screened(RING, 250, 300, 298.0, 2e-5)
    none = Stop("searches, of 6, that found a flexure within all limits", 0.0, 1.0, "1")
    first = steps_down(ring, Design(RING, 298, 300, None, none), None, 0)
    second = steps_down(ring, Design(RING, 298 - first, 300, None, none), none, first)
    assert first == 6
    assert second == (298 - first - 250) // 2


def test_a_choice_of_which_nothing_can_be_made_ends_soon() -> None:
    """Straight flexures are fallen back on once and at the end, not after every ring."""
    tried: list[Case] = []

    def nothing(
        spec: RotaryFlexureSpec, case: Case, feasibility: tuple[Check, ...], progress: Progress
    ) -> Spring:
        tried.append(case)
        raise InfeasibleError("gap between neighbouring flexures", 0.1e-3, 0.3e-3, "m")

    spec = rotary_model("rotary-auto", "flexures.style=straight", "camshaft.bore_radius=1 mm")
    with pytest.raises(InfeasibleError, match="springs of"):
        choose(spec, nothing, lambda _: None)
    assert len(tried) <= DESIGNS + 2 * STRAIGHT_DESIGNS
