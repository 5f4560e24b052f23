"""What to change where a profile is found to be impossible, each change tried by a synthesis.

The closed forms cannot see that a profile folds back or is undercut, or what its stress is. Here
the numbers of a spec are changed in steps, and a change is given when the closed forms and a
synthesis with small rotations and a rigid contact part find nothing against it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from springcad.errors import InfeasibleError
from springcad.kinds.knobs import Knob, changed, value_of
from springcad.kinds.roller_cam.case import Case, knobs_of
from springcad.kinds.roller_cam.element import last_place
from springcad.kinds.roller_cam.feasibility import failures
from springcad.kinds.roller_cam.forward import forward, least_gap
from springcad.kinds.roller_cam.strip import roller_strips
from springcad.kinds.roller_cam.synthesis import ContactProfile, synthesise
from springcad.kinds.roller_cam.tip import linear_carried, linear_tip

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Tried = TypeVar("Tried", bound="DataclassInstance")

STEPS = (0.97, 0.9, 0.75, 0.5)
"""Shares to which a number is lowered, and by whose inverse it is raised, in this order."""
MOST = 3
"""Remedies given at most."""
INTERFERENCE = 2e-6
"""Depth to which the calculated roller may cut into the profile beside its contact (m)."""
_ANGLES = 24
_EVERY = 10
"""Of the angles of a case, every such is looked at."""
_NOT_TRIED = ("material.design_stress",)


def synthesis_remedies(
    case: Case, is_sound: Callable[[ContactProfile], bool] = lambda _: True
) -> tuple[str, ...]:
    """Changes of one number after which a profile exists and ``is_sound``, smallest steps first.

    None where that is so without any change: what is wrong is not seen here.

    Args:
        is_sound: what the profile must have beyond being possible: ``within_stress`` or
            ``bears_roller``.
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


def bears_roller(case: Case) -> Callable[[ContactProfile], bool]:
    """Whether up to the deflection the roller rests on a profile with its whole strip of contact.

    Within a quarter of the roller and within the stress too, and cutting into it nowhere.
    """
    stress = within_stress(case)

    def is_sound(profile: ContactProfile) -> bool:
        angles = case.angle[_EVERY - 1 :: _EVERY]
        try:
            stroke = forward(profile.joint, profile.curve, angles, beam=linear_carried)
            strips = roller_strips(profile.joint, profile.curve, stroke)
        except InfeasibleError:
            return False
        end = stroke.place + strips.middle + strips.half_width
        gap = least_gap(profile.joint, profile.curve, stroke)
        return bool(
            stress(profile)
            and np.nanmax(stroke.gamma) <= 0.5 * math.pi
            and gap.min() >= -INTERFERENCE
            and np.nanmax(end) <= last_place(profile)
        )

    return is_sound


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
