"""What an automatic choice aims at: a level that is to be as high as possible.

A ring is fixed by its count and contact radius and by the level. Levels are whole steps, so that
what is chosen is a number that people would type: 0.05 deg of deflection, 1 % of margin, 0.1 mm of
root radius (the level rises as it falls). The objective mass has one level only.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from springcad.kinds.rotary_flexure.case import Case, resolved_style
from springcad.kinds.rotary_flexure.checks import DEFORMED_GAP
from springcad.kinds.rotary_flexure.inputs import case_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.rim import thinnest_rim
from springcad.kinds.rotary_flexure.room import deflection_bound
from springcad.kinds.rotary_flexure.spec import Objective, RotaryFlexureSpec

DEFLECTION_STEP = math.radians(0.05)
MARGIN_STEP = 0.01
MOST_MARGIN = 1000
ROOMY = 2.5
"""The largest root radius tried, over that of a full disk."""
ROOT_DIGITS = 3
"""Digits of a root radius that is chosen."""


@dataclass(frozen=True)
class Pair:
    """Number of flexures and contact radius (m)."""

    count: int
    contact_radius: float

    def __str__(self) -> str:
        return f"{self.count} flexures, contact radius {self.contact_radius * 1e3:.4g} mm"


@dataclass(frozen=True)
class Trial:
    """A spec with nothing left open, and its case with the limits that the choice keeps."""

    spec: RotaryFlexureSpec
    case: Case


def is_open(spec: RotaryFlexureSpec) -> bool:
    """Whether anything is left to be chosen."""
    envelope = spec.envelope
    radii = (envelope.outer_radius, envelope.root_radius, envelope.contact_radius)
    return any(isinstance(v, str) for v in (*radii, spec.flexures.count, spec.target.deflection))


def objective_of(spec: RotaryFlexureSpec) -> Objective:
    """The objective that is given, or follows from what is open."""
    if spec.objective is not None:
        return spec.objective
    if spec.target.deflection == "max":
        return "deflection"
    if isinstance(spec.flexures.count, str) or isinstance(spec.envelope.contact_radius, str):
        return "margin"
    return "mass"


@dataclass(frozen=True)
class Aim:
    """The spec whose open values are chosen, what for, and the radius that levels start from.

    ``largest_root`` (m) is the root radius at level 0 for the objective diameter, else unused.
    """

    spec: RotaryFlexureSpec
    objective: Objective
    largest_root: float
    root_step: float

    @classmethod
    def of(cls, spec: RotaryFlexureSpec) -> Aim:
        """The aim of an open spec."""
        objective = objective_of(spec)
        if objective != "diameter":
            return cls(spec, objective, 0.0, 0.0)
        full = _full_disk(spec)
        step = 10.0 ** (math.floor(math.log10(full)) + 1 - ROOT_DIGITS)
        return cls(spec, objective, step * math.ceil(ROOMY * full / step), step)

    @property
    def lowest(self) -> int:
        """The easiest level."""
        return 1 if self.objective == "deflection" else 0

    def highest_of(self, pair: Pair) -> int:
        """No level of this ring is above it."""
        if self.objective == "deflection":
            return round(math.radians(60.0) / DEFLECTION_STEP)
        if self.objective == "diameter":
            room = round(self.largest_root - pair.contact_radius, 12)
            return math.ceil(room / self.root_step) - 1
        return 0 if self.objective == "mass" else MOST_MARGIN

    def at(self, pair: Pair, level: float) -> Trial:
        """The spec with everything in its place; between two steps for estimates."""
        spec = self.spec
        target, envelope, flexures = spec.target, spec.envelope, spec.flexures
        radii: dict[str, object] = {"contact_radius": pair.contact_radius}
        if self.objective == "diameter":
            radii["root_radius"] = round(self.largest_root - level * self.root_step, 12)
        if self.objective == "deflection":
            target = target.model_copy(update={"deflection": level * DEFLECTION_STEP})
        flexures = flexures.model_copy(update={"count": pair.count})
        envelope = envelope.model_copy(update=radii)
        spec = spec.model_copy(
            update={"target": target, "envelope": envelope, "flexures": flexures}
        )
        margin = MARGIN_STEP * level if self.objective == "margin" else 0.0
        return _resolved(_tightened(_with_rim(spec, margin), margin))

    def level_within(self, pair: Pair, level: int, share: float) -> int:
        """The last level at which straight flexures reach what they are asked for.

        At ``level`` they reach this ``share`` of the deflection. It is about proportional to the
        allowed stress and to their length (004, Eq. 9).
        """
        if self.objective == "deflection":
            return math.floor(share * level)
        if self.objective == "margin":
            return math.floor((share * (1.0 + MARGIN_STEP * level) - 1.0) / MARGIN_STEP)
        if self.objective == "diameter":
            longer = (self.value(level) - pair.contact_radius) / share
            return math.floor((self.largest_root - pair.contact_radius - longer) / self.root_step)
        return level - 1

    def value(self, level: int) -> float:
        """What the level stands for: rad, margin, or root radius in m."""
        if self.objective == "deflection":
            return level * DEFLECTION_STEP
        if self.objective == "diameter":
            return round(self.largest_root - level * self.root_step, 12)
        return MARGIN_STEP * level


def _with_rim(spec: RotaryFlexureSpec, margin: float) -> RotaryFlexureSpec:
    if not isinstance(spec.envelope.outer_radius, str):
        return spec
    root = spec.envelope.root_radius
    assert not isinstance(root, str)
    # The law does not depend on the outer radius.
    bare = spec.envelope.model_copy(update={"outer_radius": 2.0 * root})
    case = _tightened(spec.model_copy(update={"envelope": bare}), margin).case
    outer = round(root + thinnest_rim(spec, design_law(case.inputs)), 12)
    envelope = spec.envelope.model_copy(update={"outer_radius": outer})
    return spec.model_copy(update={"envelope": envelope})


def _tightened(spec: RotaryFlexureSpec, margin: float) -> Trial:
    """Every limit that the choice can move, tightened by the margin."""
    factor = 1.0 + margin
    fillet, gap = spec.flexures.fillet_stress, spec.flexures.min_deformed_gap
    case = case_of(spec)
    if margin > 0.0:
        flexures = spec.flexures.model_copy(
            update={
                "fillet_stress": None if fillet is None else fillet / factor,
                "min_deformed_gap": factor * (gap or DEFORMED_GAP),
            }
        )
        spec = spec.model_copy(update={"flexures": flexures})
        stress = case.inputs.design_stress / factor
        case = replace(
            case,
            inputs=replace(case.inputs, design_stress=stress),
            yield_strength=case.yield_strength / factor,
            min_gap=case.min_gap * factor,
            min_tooth=case.min_tooth * factor,
        )
    return Trial(spec, case.shifted)


def _resolved(trial: Trial) -> Trial:
    """The trial with straight flexures, made as thick as they must be, wherever these will do."""
    if trial.case.style != "auto":
        return trial
    style = resolved_style(design_law(trial.case.inputs), "auto")
    flexures = trial.spec.flexures.model_copy(update={"style": style})
    spec = trial.spec.model_copy(update={"flexures": flexures})
    return Trial(spec, replace(trial.case, style=style))


def _full_disk(spec: RotaryFlexureSpec) -> float:
    """Radius of the full disk that reaches the deflection, 004, Eq. 10 with r = 0, m."""
    envelope = spec.envelope.model_copy(
        update={"root_radius": 1.0, "outer_radius": 2.0, "contact_radius": 0.5}
    )
    flexures = spec.flexures.model_copy(update={"count": 10})
    inputs = case_of(spec.model_copy(update={"envelope": envelope, "flexures": flexures})).inputs
    bound = deflection_bound(
        inputs.stiffness, 1.0, 0.0, inputs.thickness, inputs.design_stress, inputs.elastic_modulus
    )
    return inputs.deflection / float(bound)
