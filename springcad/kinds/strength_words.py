"""Stress and life for people: lines of the results table, what was assumed, and advice."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from springcad.kinds.lasting import Lasting
from springcad.materials.fatigue_strength import (
    POLISHED,
    FatigueStrength,
    fatigue_strength,
)
from springcad.mechanics.fatigue import power
from springcad.result import Outcome
from springcad.spec.common import ProcessSpec

ESTIMATE = "a life from the ultimate strength alone is right to a factor of about 10"


def source_outcomes(strength: FatigueStrength) -> Iterator[Outcome]:
    """The line, and the factors on the way from it to the design stress."""
    duty = strength.duty
    yield Outcome(
        "design stress from the life", strength.stress, "Pa", None,
        f"{power(duty.cycles)} cycles, R = {duty.load_ratio:g}, "
        f"{100 * duty.reliability:.4g} % survive",
    )  # fmt: skip
    smooth = strength.smooth
    for cycles, stress in dict.fromkeys((smooth.points[0], smooth.points[-1])):
        yield Outcome(f"S-N line at {power(cycles)} cycles", stress, "Pa")
    yield Outcome(
        f"S-N line at the life, {power(duty.cycles)} cycles", strength.start, "Pa", None,
        strength.basis,
    )  # fmt: skip
    for factor in strength.factors:
        table = "" if factor.value == factor.effect else f"; {factor.value:.4g} at 1e6 cycles"
        yield Outcome(
            f"factor: {factor.name}", factor.effect, "1", None,
            f"{factor.words}{table}; energy x {factor.effect**2:.4g}",
        )  # fmt: skip


def life_outcomes(case: Lasting) -> Iterator[Outcome]:
    """How long the finished design lasts, and how far it is from the wanted life."""
    loading, strength, wanted = case.loading, case.strength, case.wanted
    cycles, words = case.life(loading.peak)
    if wanted is None:
        words += f"; as if polished, R = {strength.duty.load_ratio:g}, half survive"
    target = None if wanted is None else wanted.cycles
    yield Outcome(f"life at the {loading.name}", cycles, "1", target, words)
    for name, peak in loading.higher.items():
        local, note = case.life(peak)
        yield Outcome(f"life at the {name}", local, "1", None, note)
    if wanted is not None:
        yield Outcome("safety factor on stress", strength.stress / loading.peak, "1", None,
                      f"design stress over {loading.name}")  # fmt: skip
        yield Outcome("safety factor on life", cycles / wanted.cycles, "1", None,
                      f"life at the {loading.name} over the wanted one")  # fmt: skip
    if case.damage is not None:
        yield Outcome("Miner's sum of the histogram", case.damage.total, "1", None,
                      case.damage.words)  # fmt: skip


def assumptions(case: Lasting, process: ProcessSpec) -> Iterator[str]:
    """What the lives are for, and what lowers them."""
    strength, duty = case.strength, case.strength.duty
    basis = f"{ESTIMATE}: test" if strength.estimated else f"the line is the {strength.basis}"
    if case.wanted is None:
        yield (
            "The design stress is taken as given. Lives are those of polished parts, half of which "
            f"survive, under a stress from {duty.load_ratio:g} to 1 times the largest; {basis}. "
            "Surface and reliability lower them: material.life counts them."
        )
        return
    yield (
        f"The design stress is for {power(duty.cycles)} cycles from {duty.load_ratio:g} to 1 times "
        f"the full load, {100 * duty.reliability:.4g} % of the parts surviving; {basis}. "
        "Lives at other places take the whole stress there (no notch sensitivity) and are lower "
        "bounds. Corrosion, fretting, heat and residual stress are not counted."
    )
    last = strength.line.points[-1][0]
    if strength.line.endures and duty.cycles > last:
        yield (
            f"Beyond {power(last)} cycles the endurance limit counts; steels of high strength can "
            "break below it after 1e8 cycles and more."
        )
    if duty.surface_factor is not None:
        yield (
            f"Warning: the surface factor of {duty.surface_factor:g} is the spec's own. None is "
            "published for wire EDM, laser or waterjet, whose recast layer and heat-affected zone "
            "lower the strength: test parts as cut."
        )
    elif duty.points is not None and duty.surface == POLISHED:
        yield "The S-N points are taken to be of the part's own surface and size."
    elif (duty.surface, process.name) != ("machined", "milling"):
        yield (
            f"Warning: the surface is taken as {duty.surface}, which one cut by {process.name} is "
            "only if it is finished so afterwards; material.life.surface_factor is for the surface "
            "as cut."
        )


def advice(case: Lasting) -> Iterator[str]:
    """What a more careful spec leaves of the stress, and what the kind's load ratio would give."""
    strength, duty = case.strength, case.strength.duty
    if duty.load_ratio < case.loading.load_ratio:
        yield (
            "Each element is bent to one side only, also where the joint turns both ways: "
            f"material.life.load_ratio may be {case.loading.load_ratio:g} in place of "
            f"{duty.load_ratio:g}, which allows more stress."
        )
    favourable = (duty.reliability, duty.surface, duty.surface_factor) == (0.5, POLISHED, None)
    if not strength.estimated or not favourable:
        return
    careful = fatigue_strength(
        case.material.values, replace(duty, reliability=0.99, surface="machined")
    )
    share = careful.stress / strength.stress
    yield (
        f"{strength.stress / 1e6:.4g} MPa are for polished parts, half of which survive. With a "
        f"machined surface and 99 % surviving the same life allows {careful.stress / 1e6:.4g} MPa, "
        f"and {share**2:.0%} of the energy (material.life.surface, reliability)."
    )
