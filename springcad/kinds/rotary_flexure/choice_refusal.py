"""What a refused choice says: what stops the ring that comes nearest, or the last one designed."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.aim import Aim, Pair
from springcad.kinds.rotary_flexure.candidates import pairs
from springcad.kinds.rotary_flexure.feasibility import closed_forms
from springcad.kinds.rotary_flexure.tried import Design
from springcad.result import Check


def nothing_possible(aim: Aim) -> InfeasibleError:
    """No ring is within the closed forms: the limit that the nearest one fails."""
    tried = [(pair, failed) for pair in pairs(aim) for failed in _failures(aim, pair)]
    if not tried:
        claim = f"rings for objective {aim.objective} with flexures between their radii"
        return InfeasibleError(claim, 0.0, 1.0, "1")
    pair, failed = min(tried, key=lambda ring: (len(ring[1]), _miss(ring[1][0])))
    stop = failed[0]
    others = f"limits it fails: {len(failed)}"
    claim = (
        f"{stop.name}, of the ring that comes nearest ({pair}; {others}; no ring for objective "
        f"{aim.objective} is within all closed-form limits)"
    )
    return InfeasibleError(claim, stop.value, stop.limit, stop.unit)


def nothing_made(designs: list[Design]) -> InfeasibleError:
    """Rings are within the closed forms, but none of those designed passes."""
    last = designs[-1] if designs else None
    if last is None or last.stop is None:
        claim = "rings with a shape of the flexures within all limits"
        return InfeasibleError(claim, 0.0, 1.0, "1")
    stop = last.stop
    rings = len({design.pair for design in designs})
    claim = (
        f"{stop.claim}, of the last ring tried ({last.pair}; {len(designs)} springs of {rings} "
        "rings were designed, none passes)"
    )
    return InfeasibleError(claim, stop.value, stop.limit, stop.unit)


def _failures(aim: Aim, pair: Pair) -> Iterator[tuple[Check, ...]]:
    """What fails for a ring at levels ever twice as high."""
    level, highest = aim.lowest, aim.highest_of(pair)
    while level <= highest:
        case = aim.at(pair, level).case
        failed = tuple(claim for claim in closed_forms(case) if claim.status == "fail")
        if failed:
            yield failed
        level = max(2 * level, 1)


def _miss(claim: Check) -> float:
    """By how much a limit is missed, as a share."""
    if claim.value > 0.0 and claim.limit > 0.0:
        return abs(math.log(claim.value / claim.limit))
    return math.inf
