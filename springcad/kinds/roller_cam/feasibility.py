"""Can any profile give the law? Closed forms only, before any profile is sought.

Each limit but the stress, which is an estimate, is necessary: a case that fails one has no design
that bears its strip of contact to the end. A case that passes all may still have none, because the
profile may fold back or be undercut.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.feasible import advised, require_all
from springcad.kinds.interpolation import ROUND_OFF
from springcad.kinds.knobs import remedies
from springcad.kinds.roller_cam.case import ANGLES, Case, knobs_of
from springcad.kinds.roller_cam.limits import (
    LEAST_OVERRUN,
    end_stress,
    lowest_point,
    required_arm,
    tip_stiffness,
)
from springcad.result import Check, check

Floats = NDArray[np.float64]

ESTIMATE_ERROR = 0.03
"""Share by which the estimate of the stress may be wrong; measured: 0.9 to 1.4 %, too high."""
DRUM_ROOM = 1.08
"""Drum radius over the limiting one that remedies aim at: nearer to it the roller is so close to
the tip at the end, and so nearly as round the profile, that the contact part's yielding decides
whether the strip of contact at full stroke still lies on it."""
_DRUM = "drum radius"
_GAP = "gap between roller and cantilever"


def feasibility_checks(case: Case) -> tuple[Check, ...]:
    """All closed-form checks; those that fail carry remedies that make every one of them pass."""
    return advised(_checks(case), lambda: case_remedies(case))


def require_feasible(case: Case) -> tuple[Check, ...]:
    """The checks of a feasible case; InfeasibleError with the first failing one otherwise."""
    return require_all(
        _checks(case),
        lambda: case_remedies(case),
        lambda claim: f"{claim.name} ({claim.source})",
    )


def failures(case: Case) -> tuple[str, ...]:
    """Names of the checks that fail, without the numbers in them; for use in searches."""
    return tuple(claim.name.partition(",")[0] for claim in _checks(case) if claim.status == "fail")


def _checks(case: Case) -> tuple[Check, ...]:
    """Every claim, without remedies; in this order the first failing one is reported."""
    wanted, angle = case.wanted, case.angle
    if not case.deflection > wanted.dead_zone:
        return (
            check("deflection, beyond the dead zone", case.deflection, ">=", wanted.dead_zone,
                  "rad", source="the law begins at the end of the dead zone"),
        )  # fmt: skip
    torque, stiffness = wanted.torque(angle), wanted.stiffness(angle)
    law = (*_material(case), *_law(angle, torque, stiffness))
    if any(claim.status == "fail" for claim in law):
        return law
    held = (
        *_energy(case),
        *_slope(case, float(wanted.stiffness(np.array([wanted.dead_zone]))[0])),
    )
    if all(claim.status == "pass" for claim in held):
        held += _stress(case, float(torque[-1]), float(wanted.energy(angle)[-1]))
    return (*law, *held, *_clearance(case))


def _material(case: Case) -> tuple[Check, ...]:
    return (
        check("design stress against yield", case.design_stress, "<=", case.yield_strength, "Pa",
              source="material data"),
    )  # fmt: skip


def _law(angle: Floats, torque: Floats, stiffness: Floats) -> tuple[Check, ...]:
    """Torque beyond the dead zone, and no fall of it: the contact would have to run back."""
    least, softest = int(np.argmin(torque)), int(np.argmin(stiffness))
    smallest = float(stiffness[softest])
    if abs(smallest) < ROUND_OFF * torque[-1] / (angle[-1] - angle[0]):
        smallest = 0.0
    positive = check(
        f"torque of the law, least at {_degrees(angle[least])}", float(torque[least]), ">=",
        0.0, "N*m", source="no torque only in the dead zone: without a force nothing holds the "
        "contact",
    )  # fmt: skip
    if positive.value <= 0.0:
        positive = replace(positive, status="fail")
    rising = check(
        f"stiffness of the law, least at {_degrees(angle[softest])}", smallest, ">=", 0.0,
        "N*m/rad", source="where the torque falls the contact would run back and cut the profile",
    )  # fmt: skip
    return (positive, rising)


def _energy(case: Case) -> tuple[Check, ...]:
    """The cantilever must not hold more than the law has stored; the roller is right over it."""
    wanted, rest = case.wanted, case.law.dead_zone
    angle = rest + (LEAST_OVERRUN * case.deflection - rest) * np.arange(1, ANGLES + 1) / ANGLES
    torque, energy = wanted.torque(angle), wanted.energy(angle)
    stiffness = tip_stiffness(case.joint.cantilever)
    roller = case.joint.roller
    arm = required_arm(torque, energy, stiffness)
    radius = (arm + roller.radius * np.sin(angle)) / np.cos(angle)
    worst = int(np.argmax(radius))
    reach = roller.drum_radius * math.cos(angle[worst]) - roller.radius * math.sin(angle[worst])
    held = float(arm[worst] / reach) ** 2 * float(energy[worst])
    return (
        check(
            f"{_DRUM}, for the energy at {_degrees(angle[worst])}", roller.drum_radius, ">=",
            float(radius[worst]), "m",
            source=f"the profile goes on to {LEAST_OVERRUN:g} of the deflection; law stores "
            f"{1e3 * energy[worst]:.4g} N*mm there; F = {torque[worst] / reach:.4g} N needs at "
            f"least {1e3 * held:.4g} N*mm in a cantilever with k = {1e-3 * stiffness:.4g} N/mm",
        ),
    )  # fmt: skip


def _slope(case: Case, slope: float) -> tuple[Check, ...]:
    """No contact is stiffer than the roller right over the tip."""
    roller, rest = case.joint.roller, case.law.dead_zone
    reach = roller.drum_radius * math.cos(rest) - roller.radius * math.sin(rest)
    return (
        check(f"stiffness of the law at rest, {_degrees(rest)}", slope, "<=",
              tip_stiffness(case.joint.cantilever) * reach**2, "N*m/rad",
              source="k R² of the cantilever alone, the roller right over its tip"),
    )  # fmt: skip


def _stress(case: Case, torque: float, energy: float) -> tuple[Check, ...]:
    """Nothing is said where sizing sees to the stress."""
    if case.is_sized:
        return ()
    stress = end_stress(case.joint, case.deflection, torque, energy)
    within = stress <= (1.0 + ESTIMATE_ERROR) * case.design_stress
    return (
        check(f"bending stress (estimate), at {_degrees(case.deflection)}", stress, "<=",
              case.design_stress, "Pa", otherwise="warn" if within else "fail",
              source=f"small rotations, rigid contact part; within {ESTIMATE_ERROR:.0%}, the "
              "profile decides"),
    )  # fmt: skip


def _clearance(case: Case) -> tuple[Check, ...]:
    roller, angle = case.joint.roller, case.deflection
    height = case.least_height if case.is_sized else case.joint.cantilever.height
    gap = lowest_point(roller, angle) - 0.5 * height
    return (
        check(f"{_GAP}, at {_degrees(angle)}", gap, ">=",
              case.clearance, "m",
              source="y0 - R sin - r cos - h/2, the cantilever straight; smallest gap of the "
              "process"),
    )  # fmt: skip


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.4g} deg"


_LAW = "change target.law there: no other number within a factor of two helps"
_MATERIAL = (
    "lower material.design_stress to at most the yield strength and see what else is left, or "
    "change the material: no number alone helps"
)


def case_remedies(case: Case) -> tuple[str, ...]:
    """Changes of the spec after which every closed-form check passes, each one recomputed.

    A check that fails must then pass with room for what the closed forms leave out; one that had
    none to begin with need not. Where no number helps, what is left to change.
    """
    close = set(_without_room(case)).difference(failures(case))

    def left(tried: Case) -> tuple[str, ...]:
        still = failures(tried)
        return tuple(name for name in _without_room(tried) if name not in close or name in still)

    last = _LAW if case.design_stress <= case.yield_strength else _MATERIAL
    return remedies(case, knobs_of(case), left) or (last,)


def _without_room(case: Case) -> tuple[str, ...]:
    """Names of the checks that fail, or pass by less than the closed forms are sure of."""

    def has_room(claim: Check) -> bool:
        if claim.name.startswith(_DRUM):
            return claim.value >= DRUM_ROOM * claim.limit
        # The profile may end as low as the roller comes, and the fillet is below it.
        return not claim.name.startswith(_GAP) or claim.value >= case.foot_fillet

    return tuple(
        claim.name.partition(",")[0]
        for claim in _checks(case)
        if claim.status != "pass" or not has_room(claim)
    )
