"""Ways to change a spec that may make it feasible, each from mild to far, in rounds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from springcad.kinds.rotary_flexure.changes import Change, Knob
from springcad.kinds.rotary_flexure.law_easing import eased_laws
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec

Way = tuple[Change, ...]

FACTORS = (1.01, 1.02, 1.04, 1.06, 1.08, 1.1, 1.15, 1.2, 1.3, 1.4, 1.5, 1.75, 2.0)
"""By which numbers are raised and lowered."""
FAR = (2.3, 2.6, 3.0, 4.0, 5.0)
"""The same where nothing nearer helps."""
FIRSTS = (1.2, 1.5, 2.0)
"""By which the first of two numbers that are changed together is."""

_DEG, _MM = math.pi / 180.0, 1e-3
KNOBS = (
    Knob("target.deflection", "deg", _DEG),
    Knob("envelope.thickness", "mm", _MM),
    Knob("stack.sheet", "mm", _MM),
    Knob("flexures.bend_limit", "", 1.0, downwards=False),
    Knob("flexures.min_gap", "mm", _MM, upwards=False),
    Knob("flexures.count", "", 1.0),
    Knob("envelope.contact_radius", "mm", _MM),
    Knob("envelope.root_radius", "mm", _MM),
    Knob("flexures.tip_thickness", "mm", _MM),
    Knob("target.stiffness", "N*m/rad", 1.0),
    Knob("material.design_stress", "MPa", 1e6, upwards=False),
    Knob("flexures.root_fillet", "mm", _MM, upwards=False),
    Knob("flexures.min_deformed_gap", "mm", _MM, upwards=False),
    Knob("flexures.fillet_stress", "MPa", 1e6, downwards=False),
    Knob("envelope.outer_radius", "mm", _MM, downwards=False),
    Knob("mounting.dowels.radius", "mm", _MM, upwards=False),
    Knob("camshaft.bore_radius", "mm", _MM, upwards=False),
    Knob("camshaft.backlash", "mm", _MM),
    Knob("camshaft.min_tooth", "mm", _MM, upwards=False),
)
"""What may be changed, most telling first. The design stress may only be lowered: raising it is not
a cure."""
KNOB = {knob.key: knob for knob in KNOBS}
PAIRS = (
    ("flexures.count", -1, "envelope.contact_radius", 1),
    ("flexures.count", -1, "envelope.thickness", 1),
    ("flexures.count", -1, "flexures.tip_thickness", -1),
    ("envelope.thickness", 1, "target.deflection", -1),
    ("flexures.count", -1, "target.deflection", -1),
    ("envelope.contact_radius", 1, "target.deflection", -1),
)
"""Numbers that may be changed together, each with its direction: tips and teeth share the circle of
contact, and what fewer flexures bear more, a thicker sheet or a shorter way takes off them."""
OTHER_STYLE = {"serpentine": "straight", "straight": "auto"}


def rounds_of(spec: RotaryFlexureSpec, found: Sequence[Change]) -> Iterator[Iterator[Way]]:
    """Ways to change the spec, those of the next round for where the ones before lead to nothing.

    One number up to a factor of 2, the style or the law; then two numbers; then one number further.

    Args:
        found: changes to limits that were found, which come before all others.
    """
    yield _first_round(spec, found)
    yield _pairs(spec)
    yield _numbers(spec, FAR)


def _first_round(spec: RotaryFlexureSpec, found: Sequence[Change]) -> Iterator[Way]:
    yield from ((change,) for change in found)
    style = OTHER_STYLE.get(spec.flexures.style)
    if style is not None:
        other = _set("flexures.style", style)
        yield (other,)
        if style == "straight":
            # They are quickly sized, and reach less.
            lower = KNOB["target.deflection"].turned(spec, -1, FACTORS)
            yield tuple(other.also(change) for change in lower)
    if spec.optimiser.form == "control-points":
        yield (_set("optimiser.form", "curvature"),)
    if not isinstance(spec.flexures.root_fillet, str):
        yield (_set("flexures.root_fillet", "auto"),)
    if spec.target.law is not None and not isinstance(spec.target.deflection, str):
        yield tuple(
            _eased(share, law) for share, law in eased_laws(spec.target.law, spec.target.deflection)
        )
    yield from _numbers(spec, FACTORS)


def _numbers(spec: RotaryFlexureSpec, factors: Sequence[float]) -> Iterator[Way]:
    """One number; that of the bends only where there are any."""
    for knob in KNOBS:
        if spec.flexures.style != "straight" or knob.key != "flexures.bend_limit":
            yield knob.turned(spec, 1, factors)
            yield knob.turned(spec, -1, factors)


def _pairs(spec: RotaryFlexureSpec) -> Iterator[Way]:
    """Two numbers: for each step of the first every step of the second."""
    for first, first_way, second, second_way in PAIRS:
        seconds = KNOB[second].turned(spec, second_way, FACTORS)
        for change in KNOB[first].turned(spec, first_way, FIRSTS):
            yield tuple(change.also(more) for more in seconds)


def _set(key: str, value: str) -> Change:
    return Change.of(key, value, f"set {key} to {value}", 0.0)


def _eased(share: float, law: str) -> Change:
    part = "all" if share == 1.0 else f"{share:.0%}"
    words = (
        f"set target.law to {law} ({part} of the law replaced by a constant stiffness that ends "
        "at the same torque)"
    )
    return Change.of("target.law", law, words, share)
