"""The part of every kind's calculation sheet that tells of material, allowed stress and life."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from springcad.materials.allowable import bending_strength
from springcad.materials.data import Material, Value
from springcad.materials.fatigue_strength import Factor, FatigueStrength
from springcad.mechanics.fatigue import (
    HIGH_CYCLES,
    LOW_CYCLES,
    SURFACES,
    amplitude_and_mean,
    endurance_limit_estimate,
)
from springcad.result import Result
from springcad.sheet import Section, Step, derived, found, given
from springcad.spec.material import MaterialSpec

_PAGE = "theory/fatigue.md"
_MARIN = {"surface": "k_a", "size": "k_b", "reliability": "k_e"}


def material_section(material: MaterialSpec) -> Section:
    """The material's values, and the stress that the design may reach (``sigma_d``)."""
    values = material.values
    steps = [
        _of_material("E", "elastic modulus", values.elastic_modulus, "Pa"),
        _of_material("nu", "Poisson's ratio", values.poisson_ratio, "1"),
        _of_material("rho", "density", values.density, "kg/m^3"),
        _of_material("sigma_y", "yield strength", values.yield_strength, "Pa"),
    ]
    if values.ultimate_strength is not None:
        steps.append(_of_material("S_ut", "ultimate strength", values.ultimate_strength, "Pa"))
    if material.strength is None:
        steps.append(given("sigma_d", "design stress", material.design_stress, "Pa"))
        text = ""
    else:
        steps += _from_life(material, material.strength)
        text = f"The design stress follows from the wanted life. Basis: {material.strength.basis}."
    share = material.design_stress / values.yield_strength.value
    steps.append(
        derived("u_y", "design stress over yield", "sigma_d/sigma_y", share, "1", "definition")
    )
    return Section(f"Material: {values.title}, and the stress allowed", tuple(steps), text)


def life_steps(result: Result, peak: str) -> Iterator[Step]:
    """How long a finished design lasts.

    ``peak`` is the symbol of the largest of the stresses that the design stress bounds.
    """
    cycles, note = result.response.get("life_cycles"), str(result.response.get("life_note", ""))
    if isinstance(cycles, float):
        yield found("N_life", "life at the largest stress, cycles", cycles, "1", _PAGE, note)
    factor = result.response.get("stress_safety_factor")
    if isinstance(factor, float):
        yield derived(
            "n_stress", "safety factor on stress, for the life", f"sigma_d/{peak}", factor, "1",
            f"{_PAGE}, 4",
        )  # fmt: skip


def _of_material(symbol: str, meaning: str, value: Value, unit: str) -> Step:
    spread = ""
    if value.low is not None and value.high is not None and value.low < value.high:
        scale, label = (1e-6, " MPa") if unit == "Pa" else (1.0, f" {unit}".replace(" 1", ""))
        spread = f"range of the sources: {scale * value.low:g} to {scale * value.high:g}{label}"
    return given(symbol, meaning, value.value, unit, value.source, spread)


def _from_life(material: MaterialSpec, strength: FatigueStrength) -> Iterator[Step]:
    """From the S-N line of smooth specimens to the stress of the part, every factor a step."""
    duty = strength.duty
    yield given("N", "wanted life, cycles", duty.cycles, "1")
    yield given("R_load", "load ratio, smallest over largest stress", duty.load_ratio, "1")
    yield from _line(material.values, strength)
    yield from _exponent(strength)
    exponent = "p" if strength.estimated else ""
    amplitude = strength.start
    effects = []
    for factor in strength.factors[:3]:
        symbol = _MARIN[factor.name]
        if factor.name == "surface" and duty.surface_factor is None and duty.surface in SURFACES:
            yield from _surface(duty.surface, factor)
        else:
            yield given(symbol, f"factor: {factor.name}", factor.value, "1", f"{_PAGE}, 2",
                        factor.words)  # fmt: skip
        amplitude *= factor.effect
        effects.append(f"{symbol}**{exponent}" if exponent else symbol)
    yield derived(
        "S_N", "reversed amplitude that the part bears", f"S_smooth*{'*'.join(effects)}", amplitude,
        "Pa", f"Marin, {_PAGE}, 2",
        "the factors act on the endurance limit and not at 1e3 cycles" if exponent else "",
    )  # fmt: skip
    yield from _mean_stress(strength, amplitude)
    once = bending_strength(material.values)
    strongest = "sigma_y"
    if once.basis != "yield":
        strongest = "sigma_b"
        yield given("sigma_b", once.basis, once.stress.value, "Pa", once.stress.source)
    yield derived("sigma_d", "design stress", f"min(sigma_N, {strongest})", strength.stress, "Pa",
                  f"{_PAGE}, 3", "never above yield")  # fmt: skip


def _line(material: Material, strength: FatigueStrength) -> Iterator[Step]:
    """The smooth line, and its stress ``S_smooth`` at the wanted life."""
    points, cycles = strength.smooth.points, strength.duty.cycles
    if len(points) == 1:
        yield given("S_smooth", f"fatigue strength at {points[0][0]:g} cycles", points[0][1], "Pa",
                    strength.basis)  # fmt: skip
        return
    pairs = list(pairwise(points))
    (n1, s1), (n2, s2) = next((pair for pair in pairs if cycles <= pair[1][0]), pairs[-1])
    yield given("N_1", "cycles at a point of the S-N line", n1, "1", _PAGE)
    if strength.estimated and n1 == LOW_CYCLES:
        yield derived("S_1", "stress there", "0.9*S_ut", s1, "Pa", f"estimate, {_PAGE}, 1")
    else:
        yield given("S_1", "stress there", s1, "Pa", strength.basis)
    yield given("N_2", "cycles at the next point", n2, "1", _PAGE)
    if strength.estimated:
        yield from _endurance(material, strength, s2)
    else:
        yield given("S_2", "stress there", s2, "Pa", strength.basis)
    reached = "min(N, N_2)" if strength.smooth.endures else "N"
    yield derived(
        "S_smooth", "stress of the line at the wanted life",
        f"S_1*({reached}/N_1)**(log(S_2/S_1)/log(N_2/N_1))", strength.start, "Pa", f"{_PAGE}, 1",
        "smooth specimens, half of which survive; straight in log-log",
    )  # fmt: skip


def _endurance(material: Material, strength: FatigueStrength, stress: float) -> Iterator[Step]:
    """The endurance limit ``S_2`` of a steel: estimated, or what a source says if it is less."""
    most = endurance_limit_estimate(math.inf)
    yield given("S_e", "largest endurance limit of the estimate", most, "Pa",
                f"Shigley, {_PAGE}, 1")  # fmt: skip
    known, formula = material.fatigue_strength, "min(S_ut/2, S_e)"
    if known is not None and not strength.basis.startswith("estimate"):
        yield given("S_f", "fatigue strength of the source", known.value, "Pa", known.source)
        formula = "min(S_f, S_ut/2, S_e)"
    yield derived("S_2", "stress there", formula, stress, "Pa", f"estimate, {_PAGE}, 1")


def _surface(name: str, factor: Factor) -> Iterator[Step]:
    """Marin's surface factor from the ultimate strength."""
    a, b = SURFACES[name]
    yield given("a_s", f"factor of a {name} surface", a, "1", f"Shigley, {_PAGE}, 2")
    yield given("b_s", "exponent of it", b, "1", f"Shigley, {_PAGE}, 2")
    yield given("S_1MPa", "unit of that formula", 1e6, "Pa", f"{_PAGE}, 2")
    yield derived("k_a", "factor: surface", "min(1, a_s*(S_ut/S_1MPa)**b_s)", factor.value, "1",
                  f"Marin, {_PAGE}, 2", factor.words)  # fmt: skip


def _exponent(strength: FatigueStrength) -> Iterator[Step]:
    """Power ``p`` in which Marin's factors act, where it is not 1."""
    if not strength.estimated:
        return
    cycles = min(strength.duty.cycles, HIGH_CYCLES)
    power = math.log(cycles / LOW_CYCLES) / math.log(HIGH_CYCLES / LOW_CYCLES)
    yield derived("p", "power in which Marin's factors act at this life",
                  "log(min(N, N_2)/N_1)/log(N_2/N_1)", power, "1", f"{_PAGE}, 2")  # fmt: skip


def _mean_stress(strength: FatigueStrength, amplitude: float) -> Iterator[Step]:
    """The peak ``sigma_N`` that is as damaging as the reversed amplitude."""
    duty = strength.duty
    a, m = amplitude_and_mean(1.0, duty.load_ratio)
    peak = amplitude * strength.factors[3].effect
    yield derived("a_R", "amplitude over peak", "(1 - R_load)/2", a, "1", f"{_PAGE}, 3")
    yield derived("m_R", "mean over peak", "(1 + R_load)/2", m, "1", f"{_PAGE}, 3")
    if duty.load_ratio == -1.0:
        formula = "S_N/a_R"
    else:
        limit = "sigma_y" if duty.mean_stress == "soderberg" else "S_ut"
        formula = {
            "gerber": f"2*S_N/(a_R + sqrt(a_R**2 + (2*m_R*S_N/{limit})**2))",
        }.get(duty.mean_stress, f"S_N/(a_R + m_R*S_N/{limit})")
    yield derived(
        "sigma_N", "peak stress as damaging as that amplitude", formula, peak, "Pa",
        f"{_PAGE}, 3, {duty.mean_stress.capitalize()}",
    )  # fmt: skip
