"""What must hold for the design law of any spring: scaling, monotony, identities, cures."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.case import Case
from springcad.kinds.rotary_flexure.feasibility import KNOBS, require_feasible, straight_gap
from springcad.kinds.rotary_flexure.law import LawInputs, design_law
from springcad.kinds.rotary_flexure.room import annulus_area, deflection_bound, packing_bound

ROUND_OFF = 1e-9

repeatable = settings(deadline=None, derandomize=True)


@st.composite
def springs(draw) -> LawInputs:
    """Rings from the size of a watch to that of a wheel, with f_s between about 0.3 and 3."""
    root = draw(st.floats(5e-3, 0.3))
    contact = root * draw(st.floats(0.1, 0.6))
    modulus = draw(st.floats(2e9, 300e9))
    stress = modulus * draw(st.floats(1e-3, 2e-2))
    shape = LawInputs(
        stiffness=draw(st.floats(0.1, 1e4)),
        deflection=0.1,
        root_radius=root,
        contact_radius=contact,
        count=draw(st.integers(3, 80)),
        thickness=root * draw(st.floats(0.02, 0.5)),
        elastic_modulus=modulus,
        design_stress=stress,
        tip_half_thickness=0.0,
    )
    straight = design_law(shape).straight_deflection
    sized = replace(shape, deflection=straight * draw(st.floats(0.45, 2.0)))
    tip = design_law(sized).root_half_thickness * draw(st.just(0.0) | st.floats(1e-6, 0.5))
    return replace(sized, tip_half_thickness=tip)


@given(springs())
@repeatable
def test_energy_is_area_at_the_design_stress(inputs):
    """n sigma_d^2 t A_serp / (6 E) = k theta^2 / 2 (004, Eqs 9, 10)."""
    law = design_law(inputs)
    density = inputs.design_stress**2 / (6 * inputs.elastic_modulus)
    stored = inputs.count * density * inputs.thickness * law.required_area
    assert stored == pytest.approx(law.energy, rel=ROUND_OFF)
    assert law.torque * inputs.deflection / 2 == pytest.approx(law.energy, rel=ROUND_OFF)


@given(springs())
@repeatable
def test_serpentine_factor_is_deflection_over_the_straight_one_to_three_halves(inputs):
    law = design_law(inputs)
    ratio = inputs.deflection / law.straight_deflection
    assert law.serpentine_factor == pytest.approx(ratio**1.5, rel=ROUND_OFF)


@given(springs(), st.floats(0.1, 10.0))
@repeatable
def test_a_spring_scaled_in_size_keeps_its_angle_and_its_factors(inputs, scale):
    """All lengths times c, stiffness times c^3: same angle, f_s, f_d; lengths scale with c."""
    law = design_law(inputs)
    scaled = design_law(
        replace(
            inputs,
            stiffness=inputs.stiffness * scale**3,
            root_radius=inputs.root_radius * scale,
            contact_radius=inputs.contact_radius * scale,
            thickness=inputs.thickness * scale,
            tip_half_thickness=inputs.tip_half_thickness * scale,
        )
    )
    for name in ("serpentine_factor", "density_factor", "straight_deflection", "straight_factor"):
        assert getattr(scaled, name) == pytest.approx(getattr(law, name), rel=ROUND_OFF)
    for name in ("root_half_thickness", "tip_pad_length", "tooth_width"):
        assert getattr(scaled, name) == pytest.approx(
            scale * getattr(law, name), rel=ROUND_OFF, abs=1e-12 * inputs.root_radius * scale
        )


@given(springs(), st.floats(0.1, 10.0))
@repeatable
def test_a_stiffer_material_at_the_same_strain_changes_nothing_but_the_stiffness(inputs, factor):
    law = design_law(inputs)
    stiffer = design_law(
        replace(
            inputs,
            elastic_modulus=inputs.elastic_modulus * factor,
            design_stress=inputs.design_stress * factor,
            stiffness=inputs.stiffness * factor,
        )
    )
    for name in ("serpentine_factor", "density_factor", "root_half_thickness", "required_area"):
        assert getattr(stiffer, name) == pytest.approx(getattr(law, name), rel=ROUND_OFF)


@given(springs(), st.floats(1.01, 1.5))
@repeatable
def test_what_eases_the_bending_lowers_the_serpentine_factor(inputs, more):
    """More stress, thickness, flexures or radius: less waviness; more angle or rate: more."""
    factor = design_law(inputs).serpentine_factor
    for name in ("design_stress", "thickness", "root_radius"):
        eased = replace(inputs, **{name: getattr(inputs, name) * more})
        assert design_law(eased).serpentine_factor < factor
    assert design_law(replace(inputs, count=inputs.count + 1)).serpentine_factor < factor
    for name in ("deflection", "stiffness", "elastic_modulus"):
        harder = replace(inputs, **{name: getattr(inputs, name) * more})
        assert design_law(harder).serpentine_factor > factor


@given(springs())
@repeatable
def test_the_thicker_straight_flexure_has_the_wanted_stiffness(inputs):
    """u - rho^3 u^2 / 2 = f_s with u = m^-3: the tip's share counted, where a solution exists."""
    law = design_law(inputs)
    u = law.straight_thickness_factor**-3
    cube = (inputs.tip_half_thickness / law.root_half_thickness) ** 3
    if math.isnan(u):
        assert law.serpentine_factor > 1 / (2 * cube) * (1 - ROUND_OFF)
    else:
        assert u - cube * u**2 / 2 == pytest.approx(law.serpentine_factor, rel=ROUND_OFF)
        assert (u <= 1 + ROUND_OFF) == (
            law.serpentine_factor <= law.straight_factor * (1 + ROUND_OFF)
        )


@given(springs())
@repeatable
def test_density_factor_and_deflection_bound_say_the_same(inputs):
    law = design_law(inputs)
    bound = deflection_bound(
        inputs.stiffness,
        inputs.root_radius,
        inputs.contact_radius,
        inputs.thickness,
        inputs.design_stress,
        inputs.elastic_modulus,
    )
    assert (inputs.deflection / bound) ** 2 == pytest.approx(law.density_factor, rel=ROUND_OFF)


@given(springs())
@repeatable
def test_straight_flexures_that_keep_their_gap_also_keep_the_packing_bound(inputs):
    """What can be built never breaks the bound that is called necessary."""
    law = design_law(inputs)
    thick = law.straight_thickness_factor
    half_pitch = math.pi / inputs.count
    beside_tips = 2 * (
        inputs.contact_radius * math.sin(half_pitch)
        - inputs.tip_half_thickness * math.cos(half_pitch)
    )
    gap = min(straight_gap(law), beside_tips)
    if not gap > 0:
        return
    tip_ratio = inputs.tip_half_thickness / (thick * law.root_half_thickness)
    area = thick * law.nominal_area * (1 + tip_ratio**3 / 2)
    filled = inputs.count * area / annulus_area(inputs.root_radius, inputs.contact_radius)
    assert filled <= packing_bound(inputs.root_radius, inputs.contact_radius, inputs.count, gap)


@given(springs(), st.sampled_from(["auto", "straight", "serpentine"]), st.floats(0.5, 3.0))
@settings(repeatable, max_examples=30)
def test_no_remedy_is_given_that_does_not_cure(inputs, style, yield_ratio):
    """For any spring: applied as printed, every remedy passes every check."""
    case = Case(
        inputs=inputs,
        style=style,
        outer_radius=1.1 * inputs.root_radius,
        yield_strength=yield_ratio * inputs.design_stress,
        min_web=0.01 * inputs.root_radius,
        min_gap=0.01 * inputs.root_radius,
    )
    try:
        require_feasible(case)
    except InfeasibleError as refusal:
        for remedy in refusal.remedies:
            cured = case
            for change in remedy.split(" and "):
                cured = _changed(cured, change)
            require_feasible(cured)


def _changed(case: Case, change: str) -> Case:
    words = change.split()
    if words[0] == "set":
        return replace(case, style=words[-1])
    (knob,) = [knob for knob in KNOBS if knob.key == words[1]]
    after = words[words.index("to") + 1 :]
    number = float(after[1] if after[0] in "≥≤" else after[0])
    name = knob.target.removeprefix("inputs.")
    value = number * knob.scale if knob.unit else int(number)
    if name == knob.target:
        return replace(case, **{name: value})
    return replace(case, inputs=replace(case.inputs, **{name: value}))
