"""Rings that closed forms allow, and how high each could reach at best.

The closed forms are necessary (``feasibility``), so a ring whose bound is not above what another
one reaches need not be looked at: pruning by this bound loses nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from springcad.kinds.rotary_flexure.aim import Aim, Pair, Trial
from springcad.kinds.rotary_flexure.camshaft import CamshaftInputs
from springcad.kinds.rotary_flexure.case import STRAIGHT_TOLERANCE
from springcad.kinds.rotary_flexure.feasibility import STRAIGHT_ROOM, failures, follows_law
from springcad.kinds.rotary_flexure.inputs import number, target_of
from springcad.kinds.rotary_flexure.law import DesignLaw, design_law
from springcad.kinds.rotary_flexure.room import hub_shear_stress
from springcad.result import Check, check
from springcad.spec.units import LENGTH, show

FEWEST, MOST = 3, 400
COUNT_RATIO = 1.25
"""Counts first looked at are so far apart."""
RADIUS_RATIO = 1.2
"""The same of contact radii."""
RADII = 16
"""Contact radii at most of each count, from the smallest that leaves room for the teeth."""
SURE = 1.01
"""A camshaft is taken to be too weak where its shear is so much above the limit."""
WEAK_CORE = "camshaft torsion inside the slots"
_DIGITS = 3
"""Digits of a contact radius that is chosen: 0.01 mm from 1 to 10 mm."""


@dataclass(frozen=True)
class Candidate:
    """A ring that passes all closed forms at some level.

    Attributes:
        pair: count and contact radius.
        lowest: the level from which on its flexures are soft enough.
        straight: the last level at which straight flexures are enough.
        bound: the last level that passes.
        waviness: serpentine factor at the lowest level, over that of straight flexures.
    """

    pair: Pair
    lowest: int
    straight: int
    bound: int
    waviness: float

    @property
    def has_straight(self) -> bool:
        """Whether straight flexures are enough at the level ``straight``."""
        return self.waviness <= 1.0


def candidates(aim: Aim) -> tuple[Candidate, ...]:
    """Rings over the whole range of what is open, those first that need waves least."""
    found = [c for pair in pairs(aim) if (c := candidate(aim, pair)) is not None]
    return tuple(sorted(found, key=promise))


def promise(ring: Candidate) -> tuple[float, float, float]:
    """What rings are looked at by, the least first: what helps straight flexures helps others."""
    return (-ring.straight, ring.waviness, ring.pair.contact_radius)


def worth(aim: Aim, pair: Pair, level: float) -> float:
    """What rings are compared by: the level, or for the objective mass the area, negative (m2)."""
    if aim.objective != "mass":
        return level
    case = aim.at(pair, level).case
    law = design_law(case.inputs)
    rim = case.outer_radius**2 - case.inputs.root_radius**2
    return -(case.inputs.count * law.flexure_area + math.pi * rim)


def candidate(aim: Aim, pair: Pair) -> Candidate | None:
    """A ring with its levels, or None where no level passes the closed forms.

    Between the lowest level, found by itself, and the bound limits only get harder to keep.
    """
    if not 0.0 < pair.contact_radius < _root_radius(aim):
        return None
    highest = aim.highest_of(pair)
    # Only how far a ring turns is found on the exact beam; other aims keep to the closed form.
    room = STRAIGHT_ROOM if aim.objective == "deflection" else STRAIGHT_TOLERANCE

    def law(level: int) -> DesignLaw:
        return design_law(aim.at(pair, level).case.inputs)

    def too_stiff(level: int) -> bool:
        """The tip is thicker than the root, or a serpentine flexure shorter than a straight one."""
        here = law(level)
        thick = here.inputs.tip_half_thickness > here.root_half_thickness
        return thick or (serpentine and here.serpentine_factor < here.straight_factor)

    serpentine = aim.spec.flexures.style == "serpentine"
    lowest = aim.lowest
    if not follows_law(aim.at(pair, lowest).case):
        return None
    if too_stiff(lowest):
        lowest = last_level(lowest, highest, too_stiff) + 1
    if lowest > highest or forbidden(aim.at(pair, lowest), room):
        return None
    bound = last_level(lowest, highest, lambda level: not failures(aim.at(pair, level).case, room))
    if forbidden(aim.at(pair, bound), room):
        bound = last_level(lowest, bound, lambda level: not forbidden(aim.at(pair, level), room))
    straight = last_level(lowest, bound, lambda level: not _waves(law(level)))
    here = law(lowest)
    return Candidate(pair, lowest, straight, bound, here.serpentine_factor / here.straight_factor)


def forbidden(trial: Trial, straight_room: float = STRAIGHT_ROOM) -> tuple[str, ...]:
    """The closed forms that a ring fails, with the torsion of its camshaft as it will be drawn.

    Args:
        straight_room: as in ``failures``.
    """
    failed = failures(trial.case, straight_room)
    limit = SURE * trial.case.yield_strength / math.sqrt(3.0)
    return failed or ((WEAK_CORE,) if core_shear(trial) > limit else ())


def core_shear(trial: Trial) -> float:
    """Torsional shear in the core inside the slots at the end of the flanks, Pa.

    Within 1 % of that of the designed camshaft, which follows the bent tips. The closed forms of
    the spec leave out the room below the tips, the backlash and the overrange.
    """
    inputs, case = trial.case.inputs, trial.case
    nose = inputs.tip_half_thickness
    slot = nose + 0.5 * case.backlash + CamshaftInputs.bottom_clearance * nose
    core = inputs.contact_radius - slot
    if core <= case.camshaft_bore_radius:
        return math.inf
    target = target_of(trial.spec)
    end = np.array([(1.0 + CamshaftInputs.overrange) * target.deflection])
    torque = case.stack.parallel * float(target.torque(end)[0])
    return float(hub_shear_stress(torque, core, case.camshaft_bore_radius))


def _waves(law: DesignLaw) -> bool:
    """Whether a flexure must be longer than a straight one."""
    return law.serpentine_factor > law.straight_factor


def last_level(low: int, high: int, holds: Callable[[int], bool]) -> int:
    """The last level on which something holds that holds from ``low``, or ``low`` itself."""
    while high > low:
        middle = (low + high + 1) // 2
        low, high = (middle, high) if holds(middle) else (low, middle - 1)
    return low


def smallest_radius(aim: Aim, count: int) -> float:
    """Contact radius at which the teeth of the camshaft are as wide as they must be, m."""
    spec = aim.spec
    tooth = max(spec.camshaft.min_tooth or 0.0, spec.process.rules.min_web)
    return rounded_up(count * (tooth + spec.flexures.tip_thickness) / (2.0 * math.pi))


def rounded_up(radius: float) -> float:
    """The next radius with as many digits as are chosen, m."""
    digits = _DIGITS - 1 - math.floor(math.log10(radius))
    return round(math.ceil(round(radius * 10.0**digits, 6)) / 10.0**digits, digits)


def any_candidate(aim: Aim) -> bool:
    """Whether closed forms allow any ring."""
    return any(candidate(aim, pair) is not None for pair in pairs(aim))


def pairs(aim: Aim) -> Iterator[Pair]:
    """Rings over the whole range of what is open, not judged yet."""
    count, radius = aim.spec.flexures.count, aim.spec.envelope.contact_radius
    for n in _counts() if isinstance(count, str) else (count,):
        if not isinstance(radius, str):
            yield Pair(n, radius)
            continue
        tried = smallest_radius(aim, n)
        for _ in range(RADII):
            if tried < _root_radius(aim):
                yield Pair(n, tried)
                tried = rounded_up(RADIUS_RATIO * tried)


def _counts() -> Iterator[int]:
    count = FEWEST
    while count <= MOST:
        yield count
        count = max(count + 1, round(COUNT_RATIO * count))


def _root_radius(aim: Aim) -> float:
    return aim.largest_root or number(aim.spec.envelope.root_radius)


def range_checks(aim: Aim) -> tuple[Check, ...]:
    """What the closed forms leave of the range: the rings that they allow, and the best bound."""
    allowed = candidates(aim)
    name = f"rings for objective {aim.objective} within all closed-form limits"
    if not allowed:
        source = "every ring tried fails one of them at every level of the objective"
        return (check(name, 0.0, ">=", 1.0, "1", source=source, remedy=_remedy(aim)),)
    counts = [ring.pair.count for ring in allowed]
    radii = [ring.pair.contact_radius for ring in allowed]
    ranges = (
        f"{name}, counts {min(counts)} to {max(counts)}, "
        f"contact radii {show(min(radii), LENGTH)} to {show(max(radii), LENGTH)}"
    )
    possible = check(
        ranges, float(len(allowed)), ">=", 1.0, "1", source="closed forms, every ring tried"
    )
    if aim.objective != "deflection":
        return (possible,)
    best = max(aim.value(ring.bound) for ring in allowed)
    return (
        possible,
        check("deflection that no ring of them can pass", best, ">=", aim.value(aim.lowest), "rad",
              source="closed forms alone; the search ends below it"),
    )  # fmt: skip


def _remedy(aim: Aim) -> str:
    """What fails for the ring in the middle of the range."""
    inside = [p for p in pairs(aim) if p.contact_radius < _root_radius(aim)]
    if not inside:
        return "lower envelope.contact_radius or raise envelope.root_radius"
    failed = forbidden(aim.at(inside[len(inside) // 2], aim.lowest))
    return f"a ring in the middle of the range fails: {'; '.join(failed)}" if failed else ""
