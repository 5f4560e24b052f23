"""Can any leaf give the spring? Closed forms only, before any leaf is sized on the beam.

The estimate of the stiffness is that of ``springcad.mechanics.leaf``; for an omega leaf it is a
bound that no spring of the material can pass in its enclosure.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from springcad.kinds.feasible import advised, require_all
from springcad.kinds.knobs import Knob, remedies
from springcad.kinds.lever_arm.mechanism import (
    Lever,
    crank_angle,
    dead_angle,
    loads,
    stroke,
    transmission,
)
from springcad.mechanics.leaf import SHAPES, greatest_stiffness, stiffness, thickness_for
from springcad.result import Check, check

Shape = Literal["constant", "triangular", "parabolic", "omega"]

STIFFNESS_ERROR = 0.25
"""Share by which the closed form of the stiffness may be too low or too high: it knows neither
large deflection nor shear, eye, fillet and least web (measured: 2 to 6 %)."""
THICKNESS_ERROR = 0.1
"""The same for thicknesses (measured: 1 to 4 %)."""
CLEAR = 0.9
"""Share of what closed forms allow that a remedy takes: what the beam finds then is in it."""
THINNEST = {"constant": (1.0, 1.0), "triangular": (0.0, 0.0), "parabolic": (1.8, 1.26)}
"""Thickness at the clamp over the least web that a leaf needs at least, closed form: at full stress
and for a wanted stiffness. The web w near the pin of a parabola makes it stiffer: with r = w/h its
factor is c = (2 - r^3)/3. So E h s/(2 c l^2) has a least value, at r^3 = 1/2, where the parabola
alone has h = 1.68 w (measured, with smooth transition and fillets: 1.84 to 1.98; constant section
1.02 to 1.07); and at h = w the leaf is twice as stiff as the parabola."""
_SMOOTH = 1.1
"""Least web of a parabola, its smooth transition counted, over that of the process."""
THICKEST = {"constant": 0.25, "triangular": 0.08, "parabolic": 0.25}
"""Thickness over length up to which a leaf is a beam; the shear in a triangle's narrow end, of
which the beam knows too little, is then 1.5 % of its deflection."""
SHEETS = tuple(
    1e-3 * size
    for size in (
        0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0,
        8.0, 10.0, 12.0, 15.0, 20.0,
    )
)  # fmt: skip
"""Customary thicknesses of sheet [m]; a shop may have others: leaf.sheet_thickness takes any."""
_UTILISATION = 1.0 / 3.0
"""Largest share of σ²/2E that bending stores in a volume (paper 000, III-B)."""
_OMEGA_FOUND = (0.05, 0.2)
"""Shares of the enclosure's bound that omega leaves reach: nearly always, and at best."""


@dataclass(frozen=True)
class Case:
    """What is asked for, SI; 0 stands for a length or a number that is not given.

    Attributes:
        lever: the mechanism.
        pivot_low, pivot_high: its pivot's range.
        shape: of the leaf.
        deflection: s_max.
        stiffness: of all leaves at s_max, wanted; 0 if layers or width decide.
        count: leaves side by side.
        length: of a straight leaf.
        sheet: thickness of the sheet.
        layers: of a stack.
        width: of a triangular leaf.
        height: room along the axis for all leaves.
        radius, corridor: of the enclosure of an omega leaf.
        max_pivot_force: 0 if not limited.
        elastic_modulus, poisson_ratio, design_stress, yield_strength: of the material.
        min_web, min_gap: of the process.
    """

    lever: Lever
    pivot_low: float
    pivot_high: float
    shape: Shape
    deflection: float
    stiffness: float
    count: int
    length: float
    sheet: float
    layers: int
    width: float
    height: float
    radius: float
    corridor: float
    max_pivot_force: float
    elastic_modulus: float
    poisson_ratio: float
    design_stress: float
    yield_strength: float
    min_web: float
    min_gap: float

    @property
    def room(self) -> float:
        """Largest width of one leaf: its layers, else what the height leaves; inf without both."""
        if self.layers:
            return self.layers * self.sheet
        if not self.height:
            return math.inf
        share = self.height / self.count
        if self.shape == "triangular":
            return share
        return math.floor(share / self.sheet * (1.0 + 1e-9)) * self.sheet


def feasibility_checks(case: Case) -> tuple[Check, ...]:
    """All closed-form checks; those that fail carry remedies that make every one of them pass."""
    return advised(tuple(_checks(case)), lambda: case_remedies(case))


def require_feasible(case: Case) -> tuple[Check, ...]:
    """The checks of a feasible case; InfeasibleError with the first failing one otherwise."""
    return require_all(
        tuple(_checks(case)),
        lambda: case_remedies(case),
        lambda claim: f"{claim.name} ({claim.source})",
    )


def failures(case: Case) -> tuple[str, ...]:
    """Names of the checks that fail or are too near to it for a remedy; without numbers."""
    claims = _checks(case, CLEAR)
    return tuple(claim.name.partition(",")[0] for claim in claims if claim.status == "fail")


def full_thickness(case: Case) -> float:
    """Thickness at the clamp that the stress allows, of a straight leaf (000, Eq. 17) [m]."""
    return float(
        thickness_for(
            SHAPES[case.shape],
            case.elastic_modulus,
            case.length,
            case.design_stress,
            case.deflection,
        )
    )


def sheet_for(thickness: float) -> float:
    """The largest customary sheet not above a thickness, 0 if there is none [m]."""
    return max((sheet for sheet in SHEETS if sheet <= thickness * (1.0 + 1e-9)), default=0.0)


def estimated_stiffness(case: Case, width: float) -> float:
    """Of all leaves of a width at their full stress, straight ones, closed form [N/m]."""
    shape = SHAPES[case.shape]
    if case.shape != "triangular":
        one = greatest_stiffness(
            shape, case.elastic_modulus, width, case.length, case.design_stress, case.deflection
        )
        return case.count * float(one) * _web_factor(case)
    sheet = case.sheet or sheet_for(full_thickness(case))
    return case.count * float(stiffness(shape, case.elastic_modulus, width, case.length, sheet))


def _web_factor(case: Case) -> float:
    """Share of a parabola's stiffness at full stress that the least web near the pin leaves.

    With r = w/h and c = (2 - r^3)/3, h is that of the parabola times 1 - r^3/2, hence k times the
    square of it; 3/4, where there is a leaf no longer, at least.
    """
    if case.shape != "parabolic":
        return 1.0
    thinner = 1.0
    for _ in range(20):
        web = _SMOOTH * case.min_web / (thinner * full_thickness(case))
        thinner = max(1.0 - 0.5 * web**3, 0.75)
    return thinner**2


def thickness_for_stiffness(case: Case) -> float:
    """Thickness at the clamp of a stack with the wanted stiffness, closed form [m].

    That of full stress where no layers of the sheet, or those that are given, have more.
    """
    full = full_thickness(case)
    layer = estimated_stiffness(case, case.sheet)
    layers = case.layers or max(1, math.ceil(case.stiffness / layer * (1.0 - 1e-9)))
    return full * min(1.0, math.cbrt(case.stiffness / (layers * layer)))


def _checks(case: Case, share: float = 1.0) -> Iterator[Check]:
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
    yield from _mechanism(case)


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
    volume = case.count * case.room * math.pi * case.radius**2
    dense = case.design_stress**2 / (2.0 * case.elastic_modulus)
    most = 2.0 * _UTILISATION * dense * volume / case.deflection**2
    always, best = _OMEGA_FOUND
    yield check(
        "stiffness of a full enclosure, upper bound", most if share == 1.0 else always * most, ">=",
        case.stiffness, "N/m",
        source=f"σ²/6E in {1e3 * case.count * case.room:.4g} mm of the enclosure's height",
    )  # fmt: skip
    yield check(
        "stiffness that omega leaves reach, estimate", best * most, ">=", case.stiffness, "N/m",
        source=f"{best:.0%} of that bound at best, {always:.0%} nearly always, in trials",
        remedy="more room, layers or stress, or less deflection; only the search can tell",
        otherwise="warn",
    )  # fmt: skip


def _mechanism(case: Case) -> Iterator[Check]:
    """Whether the spring is used at every pivot position, and what the pivot carries."""
    lever, s = case.lever, case.deflection
    angle = float(crank_angle(lever, case.pivot_high, s))
    if math.isnan(angle):
        dead = dead_angle(lever, case.pivot_high)
        reached = float(transmission(lever, case.pivot_high, dead).deflection)
        yield check(
            "deflection of the spring reached, at the farthest pivot", reached, ">=", s, "m",
            source="the crank is at its dead angle before; the spring is not used fully there",
            remedy="lower the high end of mechanism.pivot", otherwise="warn",
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


KNOBS = (
    Knob("target.spring_deflection", "mm", 1e-3, "deflection"),
    Knob("target.spring_stiffness", "N/mm", 1e3, "stiffness", upwards=False),
    Knob("leaf.length", "mm", 1e-3, "length"),
    Knob("leaf.sheet_thickness", "mm", 1e-3, "sheet"),
    Knob("leaf.layers", "", 1.0, "layers"),
    Knob("leaf.width", "mm", 1e-3, "width"),
    Knob("leaf.count", "", 1.0, "count"),
    Knob("envelope.height", "mm", 1e-3, "height"),
    Knob("envelope.radius", "mm", 1e-3, "radius"),
    Knob("the low end of mechanism.pivot", "mm", 1e-3, "pivot_low"),
    Knob("mechanism.max_pivot_force", "N", 1.0, "max_pivot_force"),
    Knob("material.design_stress", "MPa", 1e6, "design_stress", upwards=False),
)
"""What a user may change, most telling first. Raising a stress is not a cure."""


def case_remedies(case: Case) -> tuple[str, ...]:
    """Changes of the spec after which every closed form holds with room for its error.

    Each was recomputed as printed. Empty if closed forms already do, or if nothing was found.
    """
    broken = failures(case)
    if not broken:
        return ()
    turned = remedies(
        case,
        KNOBS,
        lambda tried: failures(tried) if _is_spec(case, tried) else (*broken, "rules of the spec"),
    )
    changes = turned or tuple(_omissions(case))
    if case.shape == "omega":
        return tuple(f"{change} (the search then decides)" for change in changes)
    return changes


def _omissions(case: Case) -> Iterator[str]:
    """Keys without which it works, where no number within reach does."""
    without = {
        "leaf.layers": replace(case, layers=0) if case.stiffness else case,
        "envelope.height": replace(case, height=0.0),
        "mechanism.max_pivot_force": replace(case, max_pivot_force=0.0),
    }
    for key, tried in without.items():
        if not failures(tried):
            yield f"take {key} out of the spec"


def _is_spec(case: Case, tried: Case) -> bool:
    """Whether a spec may say what a turned knob makes of the case."""
    return (
        tried.count > 0
        and bool(tried.layers) == bool(case.layers)
        and tried.pivot_low <= tried.pivot_high
        and not (tried.length and tried.deflection > 0.5 * tried.length)
    )


def pivots(case: Case, count: int) -> np.ndarray:
    """Pivot positions over the range, evenly (P,) [m]; one if the range is none."""
    if case.pivot_low == case.pivot_high:
        return np.array([case.pivot_low])
    return np.linspace(case.pivot_low, case.pivot_high, count)
