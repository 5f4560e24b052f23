"""What to change where a profile is found to be impossible, each change tried by a synthesis.

The closed forms cannot see that a profile folds back or is undercut, or what its stress is. Here
the numbers of a spec are changed in steps, and a change is given when the closed forms and a
synthesis with small rotations and a rigid contact part find nothing against it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, TypeVar

from springcad.errors import InfeasibleError
from springcad.kinds.knobs import Knob, changed, value_of
from springcad.kinds.roller_cam.case import Case, knobs_of
from springcad.kinds.roller_cam.feasibility import failures
from springcad.kinds.roller_cam.synthesis import ContactProfile, synthesise
from springcad.kinds.roller_cam.tip import linear_tip

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Tried = TypeVar("Tried", bound="DataclassInstance")

STEPS = (0.97, 0.9, 0.75, 0.5)
"""Shares to which a number is lowered, and by whose inverse it is raised, in this order."""
MOST = 3
"""Remedies given at most."""
_ANGLES = 24
_NOT_TRIED = ("material.design_stress",)


def synthesis_remedies(
    case: Case, is_sound: Callable[[ContactProfile], bool] = lambda _: True
) -> tuple[str, ...]:
    """Changes of one number after which a profile exists and ``is_sound``, smallest steps first.

    None where that is so without any change: what is wrong is not seen here.

    Args:
        is_sound: what the profile must have beyond being possible; see ``within_stress``.
    """
    if _cures(case, is_sound):
        return ()
    knobs = [knob for knob in knobs_of(case) if knob.key not in _NOT_TRIED]
    return stepped_remedies(case, knobs, lambda tried: _cures(tried, is_sound))


def stepped_remedies(
    case: Tried, knobs: Sequence[Knob], cures: Callable[[Tried], bool]
) -> tuple[str, ...]:
    """Changes of one number of any case after which ``cures`` holds, smallest steps first."""
    found: list[str] = []
    for step in STEPS:
        for knob in knobs:
            if any(f" {knob.key} " in text for text in found):
                continue
            for value in _values(case, knob, step):
                if len(found) < MOST and cures(changed(case, knob, value)):
                    found.append(_text(case, knob, value))
                    break
    return tuple(found)


def within_stress(case: Case) -> Callable[[ContactProfile], bool]:
    """Whether a profile's stress at the clamp is within the design stress up to the deflection."""

    def is_sound(profile: ContactProfile) -> bool:
        within = profile.flank.angle <= case.deflection * (1.0 + 1e-9)
        return bool(profile.tip.stress[within].max() <= case.design_stress)

    return is_sound


def contact_angle_remedy(angle: float, gamma: float) -> str:
    """For a contact that leaves the roller's quarter: γ at the angle, rad."""
    where = f"{math.degrees(gamma):.4g} deg round the roller at {math.degrees(angle):.4g} deg"
    return f"contact {where}: raise joint.drum_radius, or make the cantilever stiffer"


def interference_remedy(angle: float, depth: float) -> str:
    """For a roller that cuts into the profile away from its contact: depth in m at the angle."""
    cut = f"by {1e6 * depth:.3g} um at {math.degrees(angle):.4g} deg"
    return f"roller cuts the profile {cut}: lower joint.roller_radius, or smooth the law there"


def _values(case: Tried, knob: Knob, step: float) -> Iterator[float]:
    """The number lowered and, where that may be, raised, to three digits."""
    now = value_of(case, knob)
    digits = 2 - math.floor(math.log10(now)) if now > 0.0 else 0
    for factor in (step, 1.0 / step) if knob.upwards else (step,):
        yield round(now * factor, digits)


def _cures(case: Case, is_sound: Callable[[ContactProfile], bool]) -> bool:
    if failures(case):
        return False
    try:
        profile = synthesise(case.joint, case.wanted, beam=linear_tip, angles=_ANGLES)
    except InfeasibleError:
        return False
    return is_sound(profile)


def _text(case: Tried, knob: Knob, value: float) -> str:
    now = value_of(case, knob)
    verb = "raise" if value > now else "lower"
    return f"{verb} {knob.key} from {now:.4g} to {value:g} {knob.unit}"
