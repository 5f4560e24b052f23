"""Springs designed in full, ring by ring, at higher and higher levels until a check stops them.

How high a ring reaches is known from its shape on the design law alone (``screening``). What that
leaves out is learned on the way and held against the rings that follow: how many levels the root
and the stroke cost, by how much a drawn tooth is thinner than the pitch leaves it, and at which
contact radius a camshaft is too weak. A ring that fails repeatedly is left for the next one. The
level that straight flexures reach by closed forms is what a ring falls back on.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.aim import Aim, Pair
from springcad.kinds.rotary_flexure.candidates import Candidate, candidate, rounded_up, worth
from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.checks import DEFORMED_GAP, spring_checks
from springcad.kinds.rotary_flexure.feasibility import feasibility_checks
from springcad.kinds.rotary_flexure.rim import rim_check
from springcad.kinds.rotary_flexure.screening import Screened, screened
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.tried import Design, Stop, steps_down, steps_up
from springcad.result import Check, Progress

Build = Callable[[RotaryFlexureSpec, Case, tuple[Check, ...], Progress], Spring]

DESIGNS = 9
"""Springs designed at most, of rings whose shape was searched for."""
STRAIGHT_DESIGNS = 4
"""The same of rings with straight flexures, in case those fail."""
MISSES = 3
"""Designs of one ring that may fail before the next is tried."""
DOUBT = 0.5
"""A ring is not designed where it is expected to miss the least level of use by more than this."""
WIDER = 1.2
"""Tooth added to one that came out too thin, over what it lacks."""


@dataclass
class Climb:
    """Designs in full, the best so far, and what they have told about other rings.

    Attributes:
        widened: rings with wider teeth than those screened before, as they were screened.
        optimism: levels by which shapes on the design law reach higher than springs.
        loss: of a tooth between pitch and drawing, over the cube of the contact radius, 1/m2.
        weak_radius: contact radius at which the camshaft was too weak in torsion, m.
        left: springs that may still be designed of rings that were screened.
    """

    aim: Aim
    build: Build
    progress: Progress
    designs: list[Design] = field(default_factory=list)
    best: Design | None = None
    widened: list[Screened] = field(default_factory=list)
    optimism: float = 0.0
    loss: float = 0.0
    weak_radius: float = 0.0
    left: int = DESIGNS

    def climb(self, ring: Screened) -> None:
        """Design one ring at higher and higher levels; only what would be better than the best."""
        least = self._least
        if (
            self._is_weak(ring.pair)
            or not self._may_win(ring.pair, ring.bound)
            or ring.level - self.optimism + DOUBT < least
        ):
            return
        low, high, spare, fall = least - 1, ring.bound + 1, 0.0, ring.fall
        level, step, misses = max(least, min(self._start(ring), ring.bound)), 0, 0
        stop: Stop | None = None
        while low < level < high and misses < MISSES and self.left > 0:
            self.left -= 1
            design = self.designed(ring.pair, level, ring.bound)
            if design.spring is not None:
                gap = _spare_gap(design.spring)
                fell = (spare - gap) / (level - low) if low >= least else 0.0
                fall = fell if fell > 0.0 else ring.fall
                low, spare, misses = level, gap, 0
                level = low + steps_up(high - low, spare, fall, stop)
                continue
            high, earlier, stop, misses = level, stop, design.stop, misses + 1
            within = self._within(design)
            if within is not None:
                level, high = within, within + 1
                continue
            if low >= least:
                level = low + steps_up(high - low, spare, fall, stop)
                continue
            self._learn(ring, design)
            if stop is not None and stop.tooth is not None:
                wider = self._wider(ring, stop.tooth)
                if wider is None:
                    return
                ring, high, fall, stop = wider, wider.bound + 1, wider.fall, None
                level = max(least, min(level, self._start(ring)))
            elif stop is not None and "camshaft" in stop.claim:
                return
            else:
                step = steps_down(ring, design, earlier, step)
                level = max(level - step, ring.straight) if level > ring.straight else low
        if low >= least:
            ahead = spare / fall if fall > 0.0 else 1.0
            self.optimism = ring.level - min(low + max(1.0, ahead), high)

    def straight(self, rings: Iterable[Candidate]) -> None:
        """Design the rings at the level of straight flexures while that beats the best.

        Closed forms give that level; where sizing names a lower one, it is designed next.
        """
        left, tried = STRAIGHT_DESIGNS, {(design.pair, design.level) for design in self.designs}
        for ring in rings:
            if left == 0:
                return
            pair, level = ring.pair, ring.straight if ring.has_straight else None
            while (
                left > 0
                and level is not None
                and level >= self.aim.lowest
                and self._may_win(pair, level)
                and not self._is_weak(pair)
                and (pair, level) not in tried
            ):
                left -= 1
                tried.add((pair, level))
                design = self.designed(pair, level, ring.bound)
                self._learn(None, design)
                level = self._within(design)

    def designed(self, pair: Pair, level: int, bound: int) -> Design:
        """One spring in full; the best so far is remembered."""
        self.progress(f"designing {pair}, level {level} of the {self.aim.objective}")
        trial = self.aim.at(pair, level)
        try:
            feasibility = feasibility_checks(trial.case)
            spring = self.build(trial.spec, trial.case, feasibility, lambda _: None)
        except InfeasibleError as error:
            stop = Stop(error.claim, error.value, error.limit, error.unit)
            design = Design(pair, level, bound, None, stop)
        else:
            failed = [c for c in choice_checks(self.aim, spring) if c.status == "fail"]
            stops = [Stop(c.name, c.value, c.limit, c.unit) for c in failed]
            design = Design(
                pair, level, bound, None if stops else spring, stops[0] if stops else None
            )
        self.designs.append(design)
        if design.spring is not None:
            self.best = design
        return design

    @property
    def _least(self) -> int:
        """The lowest level that is of any use."""
        if self.best is None or self.aim.objective == "mass":
            return self.aim.lowest
        return self.best.level + 1

    def _may_win(self, pair: Pair, level: int) -> bool:
        best = self.best
        aim = self.aim
        return best is None or worth(aim, pair, level) > worth(aim, best.pair, best.level)

    def _is_weak(self, pair: Pair) -> bool:
        """Whether what earlier rings have shown lets this one's camshaft fail as well."""
        if pair.contact_radius <= self.weak_radius:
            return True
        return self._tooth(pair) < self._least_tooth

    def _tooth(self, pair: Pair) -> float:
        """Thickness of a tooth after what drawn ones have lost, m."""
        return self._nominal_tooth(pair) - self.loss * pair.contact_radius**3

    @property
    def _least_tooth(self) -> float:
        return self.aim.spec.process.rules.min_web

    def _nominal_tooth(self, pair: Pair) -> float:
        """Width that pitch and tips leave, m; the drawn tooth narrows towards its tip."""
        pitch = 2.0 * math.pi * pair.contact_radius / pair.count
        return pitch - self.aim.spec.flexures.tip_thickness

    def _start(self, ring: Screened) -> int:
        """The level that the ring is expected to reach."""
        return max(math.floor(ring.level - self.optimism), min(ring.straight, ring.bound))

    def _within(self, design: Design) -> int | None:
        """The last level of straight flexures that are too weak at this one; None for others."""
        share = None if design.stop is None else design.stop.straight_share
        return None if share is None else self.aim.level_within(design.pair, design.level, share)

    def _learn(self, ring: Screened | None, design: Design) -> None:
        """What the failure of a design says about other rings."""
        stop, pair = design.stop, design.pair
        if stop is None:
            return
        if "torsion" in stop.claim:
            self.weak_radius = max(self.weak_radius, pair.contact_radius)
        if stop.tooth is not None:
            lost = self._nominal_tooth(pair) - stop.tooth
            self.loss = max(self.loss, lost / pair.contact_radius**3)
        if ring is not None and stop.lack is not None and ring.fall > 0.0:
            self.optimism = max(self.optimism, ring.level - design.level + stop.lack / ring.fall)
        if ring is not None and stop.no_shape:
            self.optimism = max(self.optimism, ring.level - design.level)

    def _wider(self, ring: Screened, tooth: float) -> Screened | None:
        """The ring with more tooth than that, where its radius is free and it has a shape.

        Beyond some radius teeth lose more than the pitch gives them: some counts never have any.
        """
        if not isinstance(self.aim.spec.envelope.contact_radius, str):
            return None
        count, radius = ring.pair.count, ring.pair.contact_radius
        thickest = math.sqrt(2.0 * math.pi / (3.0 * count * self.loss)) if self.loss else radius
        if self._tooth(Pair(count, max(radius, thickest))) < self._least_tooth:
            return None
        added = WIDER * count * (self._least_tooth - tooth) / (2.0 * math.pi)
        pair = Pair(count, rounded_up(radius + added))
        known = candidate(self.aim, pair)
        if known is None or not self._may_win(pair, known.bound):
            return None
        self.progress(f"searching for shapes, wider teeth: {pair}")
        wider = screened(self.aim, known)
        if wider is not None:
            self.widened.append(wider)
        return wider


def _spare_gap(spring: Spring) -> float:
    """What the gaps at rest and at full load have to spare, the smaller, m."""
    deformed = min(float(stroke.gap.min()) for stroke in spring.strokes)
    asked = spring.spec.flexures.min_deformed_gap or DEFORMED_GAP
    return min(deformed - asked, spring.found.gap - spring.case.min_gap)


def choice_checks(aim: Aim, spring: Spring) -> tuple[Check, ...]:
    """The checks of a spring, with that of its rim where it is chosen."""
    checks = spring_checks(spring)
    if isinstance(aim.spec.envelope.outer_radius, str):
        checks = (*checks, rim_check(spring))
    return checks
