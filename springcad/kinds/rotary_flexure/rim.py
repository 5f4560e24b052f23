"""The thinnest rim that bears the flexures by itself, without help from the housing.

Between two roots the rim is a beam that each root bends by its moment M. All roots being alike, M
goes to both sides in equal parts: the rim's moment runs from -M/2 to M/2, whatever the pitch. The
root's force F acts at the root radius, so about the middle of a rim of the width w its lever is
L + w/2. Between dowels the tangential forces of the flexures add up to n F/(2 m) on either side of
each of the m dowels; in a bore they go into the housing where they arise. On the edges

    sigma = 3 F (L + w/2)/(t w^2) + N/(t w),    w without the depth of the dowels' cut-outs

(docs/theory/choose-for-me.md). Not in it: the curvature of the rim, notches, the press fit.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from springcad.kinds.rotary_flexure.law import DesignLaw
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.result import Check, check

if TYPE_CHECKING:
    from springcad.kinds.rotary_flexure.spring import Spring

RIM_STEP = 1e-4
"""Widths are multiples of a tenth of a millimetre, m."""
SPARE = 1.03
"""Force that a rim is made for over that of the law, in which the contact does not move."""


def rim_stress(force: float, span: float, thickness: float, width: float, pull: float) -> float:
    """Largest nominal stress in a rim, Pa.

    Args:
        force: at the tip of a flexure, N.
        span: from the root to the tip, m.
        thickness: of the sheet, m.
        width: of the rim where it is narrowest, m.
        pull: tangential force in the rim, N.
    """
    bending = 3.0 * force * (span + 0.5 * width) / (thickness * width**2)
    return bending + pull / (thickness * width)


def rim_width(force: float, span: float, thickness: float, stress: float, pull: float) -> float:
    """The width with which ``rim_stress`` is ``stress``, m: a quadratic in the width."""
    linear = pull + 1.5 * force
    square = linear**2 + 12.0 * thickness * stress * force * span
    return (linear + math.sqrt(square)) / (2.0 * thickness * stress)


def thinnest_rim(spec: RotaryFlexureSpec, law: DesignLaw) -> float:
    """Outer less root radius of the thinnest rim at the design stress that can be cut, m."""
    inputs, force = law.inputs, SPARE * law.force
    web = rim_width(force, law.span, inputs.thickness, inputs.design_stress, _pull(spec, law))
    width = max(web, spec.process.rules.min_web) + _cut_out(spec)
    return RIM_STEP * math.ceil(round(width / RIM_STEP, 6))


def rim_check(spring: Spring) -> Check:
    """The claim that the rim bears the flexures, with the moments at full load."""
    law = spring.law
    inputs = law.inputs
    force = max(float(stroke.force.max()) for stroke in spring.strokes)
    width = spring.case.outer_radius - inputs.root_radius - _cut_out(spring.spec)
    pull = _pull(spring.spec, law)
    return check(
        "rim between the roots, nominal stress",
        rim_stress(force, law.span, inputs.thickness, width, pull), "<=", inputs.design_stress,
        "Pa", source="rim as a beam without help from the housing; design stress",
        remedy="give envelope.outer_radius a larger number",
    )  # fmt: skip


def _pull(spec: RotaryFlexureSpec, law: DesignLaw) -> float:
    dowels = spec.mounting.dowels
    return 0.0 if dowels is None else law.inputs.count * law.force / (2.0 * dowels.count)


def _cut_out(spec: RotaryFlexureSpec) -> float:
    dowels = spec.mounting.dowels
    return 0.0 if dowels is None else dowels.radius
