"""What was taken for granted about a rotary flexure spring, and what may improve it."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.kinds.rotary_flexure.calibrated import calibration_assumptions
from springcad.kinds.rotary_flexure.numbers import bound_of
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.straight import straight_alternatives


def assumptions(spring: Spring) -> tuple[str, ...]:
    """What was taken for granted and what was not checked, in full sentences."""
    spec, play = spring.spec, math.degrees(spring.camshaft.slot.free_play)
    held = (
        "fixed all round, as if pressed into a stiff bore"
        if spec.mounting.dowels is None
        else "held by its dowels and bends freely between them"
    )
    return (
        "The flexures are beams on a root spring. The spring and the stress in the root fillets "
        "come from linear plane-stress finite elements of one sector of the ring: rim, root, "
        f"fillets ({spring.fillet * 1e3:.2f} mm) and mounting, without dowel cut-outs.",
        *calibration_assumptions(spec),
        "Everything is linear-elastic: where a stress passes yield, stiffness and stresses are "
        "outside the model.",
        f"The rim is {held}; its own stress is not checked.",
        _friction_assumption(spec.camshaft.friction),
        *(
            (
                f"The camshaft has a free play of {play:.3g} deg each way before it touches the "
                "flexures; angles, stiffness and energy do not count it.",
            )
            if play > 0.0
            else ()
        ),
        "Stiffness, stress and gaps are those of a beam with large deflections, shear and axial "
        "force; flexures are sized by it.",
        f"The stress compared with material.design_stress is the {spec.stress} one; the root "
        "fillets are reported apart.",
        "Edge quality of the cut is not checked.",
        "The camshaft is of the same material and thickness as the ring; its fatigue is not "
        "checked. Both parts are cut to size: kerf and tolerances are the shop's.",
        "Paper 004 cites a patent application on the two-part spring, US 15/402,186: check before "
        "you sell.",
    )


def _friction_assumption(coefficient: float) -> str:
    if coefficient == 0.0:
        return (
            "Contact is frictionless. Dry friction adds hysteresis: paper 004 measured 9.7 to 12 % "
            "of the energy at full deflection; camshaft.friction computes it."
        )
    return (
        f"Loading and unloading are for dry friction of {coefficient:g}; stiffness, stress and "
        "camshaft are those of the frictionless contact between them."
    )


def advice(spring: Spring) -> Iterator[str]:
    """How near the bound the design is, and straight flexures that would do the same."""
    if spring.spec.target.law is not None:
        return
    bound = bound_of(spring)
    yield (
        f"The design deflection is {spring.law.inputs.deflection / bound:.0%} of "
        f"{math.degrees(bound):.1f} deg, the bound of a full disk at this stress."
    )
    if spring.found.style == "serpentine":
        for alternative in straight_alternatives(spring.case):
            text = str(alternative)
            yield f"{text[0].upper()}{text[1:]}."
