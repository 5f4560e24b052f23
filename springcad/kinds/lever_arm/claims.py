"""What a lever arm must keep to in closed form, claim by claim, without advice.

For an omega leaf the stiffness is a bound that no spring of the material can pass in its enclosure.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Literal

from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.changes import HIGH_END, KNOBS, SEARCH_DECIDES, turned
from springcad.kinds.lever_arm.estimate import (
    SHEETS,
    STIFFNESS_ERROR,
    THICKNESS_ERROR,
    estimated_stiffness,
    full_thickness,
    thickness_for_stiffness,
)
from springcad.kinds.lever_arm.mechanism import crank_angle, dead_angle, loads, stroke, transmission
from springcad.result import Check, check

THINNEST = {"constant": (1.0, 1.0), "triangular": (0.0, 0.0), "parabolic": (1.8, 1.26)}
"""Thickness at the clamp over the least web that a leaf needs at least, closed form: at full stress
and for a wanted stiffness. The web w near the pin of a parabola makes it stiffer: with r = w/h its
factor is c = (2 - r^3)/3. So E h s/(2 c l^2) has a least value, at r^3 = 1/2, where the parabola
alone has h = 1.68 w (measured, with smooth transition and fillets: 1.84 to 1.98; constant section
1.02 to 1.07); and at h = w the leaf is twice as stiff as the parabola."""
THICKEST = {"constant": 0.25, "triangular": 0.08, "parabolic": 0.25}
"""Thickness over length up to which a leaf is a beam; the shear in a triangle's narrow end, of
which the beam knows too little, is then 1.5 % of its deflection."""
_UTILISATION = 1.0 / 3.0
"""Largest share of σ²/2E that bending stores in a volume (paper 000, III-B)."""
_OMEGA_FOUND = (0.05, 0.2)
"""Shares of the enclosure's bound that omega leaves reach: nearly always, and at best."""


def claims(case: Case, share: float = 1.0) -> Iterator[Check]:
    """Every claim, without remedies; in this order the first failing one is reported.

    With a ``share`` below 1 closed forms must hold with that share of what they allow.
    """
    yield check("design stress against yield", case.design_stress, "<=", case.yield_strength, "Pa",
                source="material data")  # fmt: skip
    if case.shape == "omega":
        yield from _bound(case, share)
    else:
        yield from _section(case, share)
        yield from _reach(case, share)
    yield from _mechanism(case, share)


def _section(case: Case, share: float) -> Iterator[Check]:
    """Thickness that the stress allows, against what can be cut, bought and called a beam."""
    full = full_thickness(case)
    law = "2 c l² σ/(E s), c = 1/3, 1/2 or 2/3 (000, Eq. 17 for the constant section)"
    if case.shape != "triangular":
        yield from _cuttable(case, share, law)
    elif case.sheet:
        allowed = share * full
        yield check("thickness of the sheet, closed form", case.sheet, "<=", allowed, "m",
                    source=law, otherwise=_doubt(case.sheet, allowed, share, THICKNESS_ERROR),
                    )  # fmt: skip
    else:
        yield check("thickness of the leaf, closed form", share * full, ">=", SHEETS[0], "m",
                    source=f"{law}; thinnest customary sheet")  # fmt: skip
    yield check("thickness over length, closed form", full / case.length, "<=",
                THICKEST[case.shape], "1",
                source="a beam is slender")  # fmt: skip


def _cuttable(case: Case, share: float, law: str) -> Iterator[Check]:
    """A stack's thickness at the clamp, at full stress and as thin as the stiffness makes it."""
    at_stress, at_stiffness = (ratio * case.min_web for ratio in THINNEST[case.shape])
    rule = "smallest web of the process"
    if case.shape == "parabolic":
        rule += ", times what it takes for the web near the pin"
    yield check("thickness at the clamp, closed form", share * full_thickness(case), ">=",
                at_stress, "m", source=f"{law}; {rule}")  # fmt: skip
    if not case.stiffness:
        return
    thin = share * thickness_for_stiffness(case)
    yield check("thickness at the clamp for the wanted stiffness, closed form", thin, ">=",
                at_stiffness, "m", source=f"fewest layers of the sheet, or those given; {rule}",
                otherwise=_doubt(at_stiffness, thin, share, THICKNESS_ERROR))  # fmt: skip


def _reach(case: Case, share: float) -> Iterator[Check]:
    """Whether the wanted stiffness fits into layers or height; nothing where both are free."""
    if not case.stiffness or not math.isfinite(case.room):
        return
    most = share * estimated_stiffness(case, case.room)
    yield check(
        "stiffness at full stress, closed form", most, ">=", case.stiffness, "N/m",
        source=f"{case.count} x {1e3 * case.room:.4g} mm wide; within {STIFFNESS_ERROR:.0%}",
        otherwise=_doubt(case.stiffness, most, share, STIFFNESS_ERROR),
    )  # fmt: skip


def _doubt(wanted: float, most: float, share: float, error: float) -> Literal["warn", "fail"]:
    """What a broken closed form means: within its error the beam decides."""
    return "warn" if share == 1.0 and wanted <= (1.0 + error) * most else "fail"


def _bound(case: Case, share: float) -> Iterator[Check]:
    """No spring stores more than σ²/6E in its enclosure's volume; leaves store far less."""
    if not case.stiffness or not math.isfinite(case.room):
        return
    most = _most_of_enclosure(case)
    always, best = _OMEGA_FOUND
    yield check(
        "stiffness of a full enclosure, upper bound", most if share == 1.0 else always * most, ">=",
        case.stiffness, "N/m",
        source=f"σ²/6E in {1e3 * case.count * case.room:.4g} mm of the enclosure's height",
    )  # fmt: skip
    yield check(
        "stiffness that omega leaves reach, estimate", best * most, ">=", case.stiffness, "N/m",
        source=f"{best:.0%} of that bound at best, {always:.0%} nearly always, in trials",
        remedy=_roomier(case, best) if share == 1.0 else "", otherwise="warn",
    )  # fmt: skip


def _most_of_enclosure(case: Case) -> float:
    """Stiffness of a spring that fills its enclosure and bends, every fibre at its best [N/m]."""
    volume = case.count * case.room * math.pi * case.radius**2
    dense = case.design_stress**2 / (2.0 * case.elastic_modulus)
    return 2.0 * _UTILISATION * dense * volume / case.deflection**2


def _roomier(case: Case, best: float) -> str:
    """What brings the estimate up to the wanted stiffness."""
    found = turned(
        case, KNOBS, lambda tried: best * _most_of_enclosure(tried) >= tried.stiffness,
        "more room, layers or stress, or less deflection",
    )  # fmt: skip
    return f"{found} {SEARCH_DECIDES}"


def _nearer(case: Case) -> str:
    """The farthest pivot position at which the crank reaches the spring's deflection."""

    def works(tried: Case) -> bool:
        return not math.isnan(float(crank_angle(tried.lever, tried.pivot_high, tried.deflection)))

    return turned(case, (HIGH_END,), works, "a lower high end of mechanism.pivot")


def _mechanism(case: Case, share: float) -> Iterator[Check]:
    """Whether the spring is used at every pivot position, and what the pivot carries."""
    lever, s = case.lever, case.deflection
    angle = float(crank_angle(lever, case.pivot_high, s))
    if math.isnan(angle):
        dead = dead_angle(lever, case.pivot_high)
        reached = float(transmission(lever, case.pivot_high, dead).deflection)
        yield check(
            "deflection of the spring reached, at the farthest pivot", reached, ">=", s, "m",
            source="the crank is at its dead angle before; the spring is not used fully there",
            remedy=_nearer(case) if share == 1.0 else "", otherwise="warn",
        )  # fmt: skip
    if not case.max_pivot_force:
        return
    spring = s * _known_stiffness(case)
    force = float(loads(lever, case.pivot_low, stroke(lever, case.pivot_low, s), spring).pivot)
    yield check(
        "force on the pivot, at its low end", force, "<=", case.max_pivot_force, "N",
        source="l/q times the spring's force (000, Eq. 3), the lever tilted",
    )  # fmt: skip


def _known_stiffness(case: Case) -> float:
    """Wanted, else estimated; 0 for an omega leaf whose layers decide."""
    if case.stiffness or case.shape == "omega":
        return case.stiffness
    return estimated_stiffness(case, case.width or case.room)
