"""What a refused choice says: what was tried, what stopped it, and a change that was tried."""

from __future__ import annotations

import math

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.aim import Aim
from springcad.kinds.rotary_flexure.candidates import candidates, range_checks
from springcad.kinds.rotary_flexure.climbing import Build, Climb, Design
from springcad.result import Progress

LESS = (0.9, 0.8, 0.65, 0.5, 0.35, 0.25)
"""Shares of the deflection that are tried, the mildest first."""


def nothing_possible(aim: Aim, build: Build, progress: Progress) -> InfeasibleError:
    """No ring is within the closed forms."""
    (rings,) = range_checks(aim)
    remedies = _smaller_deflection(aim, build, progress)
    if not remedies and rings.remedy:
        remedies = (rings.remedy,)
    return InfeasibleError(rings.name, rings.value, rings.limit, rings.unit, remedies)


def nothing_made(
    aim: Aim, designs: list[Design], build: Build, progress: Progress
) -> InfeasibleError:
    """Rings are within the closed forms, but none of those designed passes."""
    remedies = _smaller_deflection(aim, build, progress)
    last = designs[-1] if designs else None
    if last is None or last.stop is None:
        claim = "rings with a shape of the flexures within all limits"
        return InfeasibleError(claim, 0.0, 1.0, "1", remedies)
    stop = last.stop
    rings = len({design.pair for design in designs})
    claim = (
        f"{stop.claim}, of the last ring tried ({last.pair}; {len(designs)} springs of {rings} "
        "rings were designed, none passes)"
    )
    return InfeasibleError(claim, stop.value, stop.limit, stop.unit, remedies)


def _smaller_deflection(aim: Aim, build: Build, progress: Progress) -> tuple[str, ...]:
    """The largest share of a given deflection at which a ring of straight flexures passes."""
    wanted = aim.spec.target.deflection
    if isinstance(wanted, str) or aim.spec.target.law is not None:
        return ()
    progress("no ring can be made: trying less deflection")
    for share in LESS:
        degrees = round(math.degrees(share * wanted), 2)
        target = aim.spec.target.model_copy(update={"deflection": math.radians(degrees)})
        milder = Aim.of(aim.spec.model_copy(update={"target": target}))
        tried = Climb(milder, build, lambda _: None)
        tried.straight([ring for ring in candidates(milder) if ring.has_straight][:1])
        if tried.best is not None:
            return (
                f"lower target.deflection from {math.degrees(wanted):.4g} to {degrees:g} deg: "
                f"{tried.best.pair} pass there",
            )
    return ()
