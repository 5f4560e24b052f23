"""The claims that finished leaves must stand up to."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from springcad.kinds.leaf_2dof.made import MadeLeaves
from springcad.kinds.leaf_2dof.sizing import approach
from springcad.kinds.leaf_2dof.unit import contact_pressure
from springcad.kinds.pressure import pressure_limit
from springcad.mechanics.contact import contact_modulus
from springcad.result import Check, check

_ROUND_OFF = 1e-9


def leaf_checks(made: MadeLeaves) -> tuple[Check, ...]:
    """All checks, those made before the strokes first."""
    return (*made.feasibility, *_deflection(made), *_contact(made), *_room(made))


def pressure(made: MadeLeaves) -> np.ndarray:
    """Hertzian, roller of the leaf's material (P, A) [Pa]."""
    leaf = made.setup.leaf
    modulus = contact_modulus(*(leaf.elastic_modulus, leaf.poisson_ratio) * 2)
    return np.asarray(contact_pressure(leaf, made.setup.lever, made.strokes.force, modulus))


def _deflection(made: MadeLeaves) -> Iterator[Check]:
    """What the exact unit says of the longest length."""
    case, reach = made.case, made.reach
    wanted = case.deflection
    yield check(
        "deflection, longest length", wanted, "<=", float(reach.by_geometry[-1]), "rad",
        source="exact unit; beyond it the torque falls or the roller runs out of its way",
        remedy=_lower_deflection(float(reach.by_geometry[-1])),
    )  # fmt: skip
    yield check(
        "stress at the clamp, longest length", float(made.full.stress[-1]), "<=",
        case.design_stress, "Pa",
        source="exact unit: large deflection, contact that moves; no notch",
        remedy=_lower_deflection(float(reach.by_stress[-1])),
    )  # fmt: skip
    if math.isfinite(case.max_bend_angle):
        yield check(
            "bend angle, longest length", float(made.full.bend_angle[-1]), "<=",
            case.max_bend_angle, "rad", source="exact unit, slope at the roller",
            remedy=_lower_deflection(float(reach.by_bend[-1])),
        )  # fmt: skip


def _lower_deflection(most: float) -> str:
    """To an angle that the exact unit allows, rounded down; nothing for a limit not reached."""
    if math.isinf(most):
        return ""
    return f"lower target.deflection to <= {math.floor(100.0 * math.degrees(most)) / 100.0:g} deg"


def _contact(made: MadeLeaves) -> Iterator[Check]:
    planform, strokes = made.planform, made.strokes
    straight = planform.overhang - planform.end_radius
    yield check(
        "contact beyond its place at rest, all lengths",
        max(0.0, float(np.max(strokes.station - strokes.length))), "<=", straight, "m",
        source="exact unit; up to where the corners of the contact end begin",
    )  # fmt: skip
    limit, words = pressure_limit(made.spec.material.values)
    yield check(
        "contact pressure of the roller", float(np.max(pressure(made))), "<=", limit, "Pa",
        source=f"Hertz; {words}",
        remedy="a larger unit.roller_radius or a wider leaf lowers it", otherwise="warn",
    )  # fmt: skip


def _room(made: MadeLeaves) -> Iterator[Check]:
    """Guide and roller at their closest, and the leaf as drawn."""
    case, strokes = made.case, made.strokes
    ends = zip(strokes.length[:, -1], strokes.angle[:, -1], strict=True)
    gap = min(float(at) - approach(case, float(angle)) for at, angle in ends) - case.roller_radius
    yield check(
        "gap between roller and guide, all lengths", gap, ">=", case.clearance, "m",
        source="exact stroke; a guide as high as the roller; smallest gap of the process",
        remedy="raise the shortest leaf.effective_length",
    )  # fmt: skip
    if math.isfinite(case.leaf_room):
        yield check(
            "length of the leaf as drawn", made.planform.length, "<=",
            case.leaf_room * (1.0 + _ROUND_OFF), "m", source="envelope.leaf_length",
            remedy="raise envelope.leaf_length, or shorten mount or guide",
        )  # fmt: skip
