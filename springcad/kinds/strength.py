"""What every kind's result tells of stress and life: where the design stress comes from, and how
long the finished design lasts.

A kind hands over the stress of its finished design over the stroke (``Loading``); nothing here asks
which kind it is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from springcad.kinds.lasting import Lasting, Loading
from springcad.kinds.strength_words import advice, assumptions, life_outcomes, source_outcomes
from springcad.materials.fatigue_strength import Duty, DutyError, FatigueStrength, fatigue_strength
from springcad.mechanics.fatigue import HIGH_CYCLES, size_factor
from springcad.result import Check, Result, Value, check
from springcad.spec.common import ProcessSpec
from springcad.spec.material import MaterialSpec
from springcad.spec.units import STRESS, show

_EQUIVALENT = 0.808
"""Diameter of a round bar over sqrt(h b) of a rectangle in bending, equal highly stressed area
(Shigley's Mechanical Engineering Design, size factor)."""
_NEUTRAL_DIAMETER = 7.62e-3
"""Of the specimens: up to it the size factor is not below 1."""
_LARGEST_DIAMETER = 51e-3
_NOTHING = "nothing is known of the fatigue of this material"


def with_strength(
    result: Result, material: MaterialSpec, process: ProcessSpec, loading: Loading
) -> Result:
    """``result``, with what there is to tell of its design stress and its life."""
    strength = material.strength or _without_life(material, loading.load_ratio)
    if strength is None:
        return replace(
            result,
            response={**result.response, "life_cycles": None, "life_note": _NOTHING},
            assumptions=(*result.assumptions, _nothing_known(material)),
        )
    case = Lasting(material, strength, loading)
    told = replace(
        result,
        response={**result.response, **_response(case)},
        outcomes=(*result.outcomes, *life_outcomes(case)),
        assumptions=(*result.assumptions, *assumptions(case, process)),
    )
    if material.life is None:
        return told
    return replace(
        told,
        design={**result.design, "strength": _entry(strength)},
        outcomes=(*result.outcomes, *source_outcomes(strength), *life_outcomes(case)),
        checks=(*result.checks, *_checks(case)),
        advice=(*result.advice, *advice(case)),
    )


def _without_life(material: MaterialSpec, load_ratio: float) -> FatigueStrength | None:
    """Of polished parts, half of which survive; None where nothing is known of the material."""
    try:
        return fatigue_strength(material.values, Duty(HIGH_CYCLES, load_ratio))
    except DutyError:
        return None


def _entry(strength: FatigueStrength) -> dict[str, Value]:
    """For programs: the line, and every factor of the design stress."""
    points = np.array(strength.smooth.points)
    return {
        "basis": strength.basis,
        "design_stress_Pa": strength.stress,
        "line_cycles": points[:, 0],
        "line_stress_Pa": points[:, 1],
        "line_stress_at_life_Pa": strength.start,
        "factors": {
            factor.name.replace(" ", "_"): {
                "factor": factor.value,
                "of_stress": factor.effect,
                "of_energy": factor.effect**2,
                "source": factor.words,
            }
            for factor in strength.factors
        },
    }


def _response(case: Lasting) -> dict[str, Value]:
    """Lives and safety factors; None where a life is not known or has no end, as the note says."""
    cycles, words = case.life(case.loading.peak)
    values: dict[str, Value] = {"life_cycles": _finite(cycles), "life_note": words}
    if case.loading.local:
        values["local_life_cycles"] = {
            name.replace(" ", "_").replace("-", "_"): _finite(case.life(stress)[0])
            for name, stress in case.loading.local.items()
        }
    if case.wanted is not None:
        values["stress_safety_factor"] = case.strength.stress / case.loading.peak
        values["life_safety_factor"] = _finite(cycles / case.wanted.cycles)
    if case.damage is not None:
        values["miner_sum"] = _finite(case.damage.total)
    return values


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _checks(case: Lasting) -> Iterator[Check]:
    loading, strength = case.loading, case.strength
    if loading.section is not None and strength.estimated:
        yield _size(loading.section, strength)
    name, stress = max(loading.higher.items(), key=lambda place: place[1], default=("", 0.0))
    if name:
        yield check(
            f"{name} against what the life allows", stress, "<=", strength.stress, "Pa",
            source="local stress against the design stress from the life, no notch sensitivity",
            otherwise="warn", remedy=_bounded(case, name),
        )  # fmt: skip
    if case.damage is not None:
        yield check(
            "largest load of the histogram over that at the deflection", case.damage.largest, "<=",
            1.0, "1", source="material.life.histogram; nothing is known beyond the deflection",
            remedy="raise the deflection of the target, or cap the load by a stop",
        )  # fmt: skip
        yield check(
            "Miner's sum of the histogram", case.damage.total, "<=", 1.0, "1",
            source=f"sum of n/N, {loading.name}; {strength.basis}", remedy=case.damage.remedy,
        )  # fmt: skip


def _bounded(case: Lasting, name: str) -> str:
    """What to do where the stress of another place is more than the life allows."""
    key, stress = case.loading.keys.get(name), show(case.strength.stress, STRESS)
    knob = f"{key} bounds it, to {stress} if there is room; or " if key else ""
    return f"{knob}test parts"


def _size(section: tuple[float, float], strength: FatigueStrength) -> Check:
    """The size factor that was taken, before the section was known, against that of the section."""
    diameter = _EQUIVALENT * math.sqrt(math.prod(section))
    least = size_factor(min(diameter, _LARGEST_DIAMETER))
    factor = 1.0 if diameter <= _NEUTRAL_DIAMETER else least
    return check(
        "size factor against that of the section", strength.duty.size_factor, "<=", factor, "1",
        source=f"Marin, equivalent diameter {1e3 * diameter:.3g} mm of the largest section in "
        f"bending; 1 up to {1e3 * _NEUTRAL_DIAMETER:g} mm",
        otherwise="warn", remedy=f"set material.life.size_factor to {factor:.3g}",
    )  # fmt: skip


def _nothing_known(material: MaterialSpec) -> str:
    return (
        "The design stress is taken as given. No life is told: nothing is known of the fatigue of "
        f"{material.name}; give material.ultimate_strength for a steel, or S-N points "
        "(material.life.sn)."
    )
