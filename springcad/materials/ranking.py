"""Materials ranked by the energy that a leaf spring of them can store (paper 000, section III).

At given width, length and deflection the thickness follows from the stress, and energy and
stiffness are proportional to sigma^3/E^2 (Eqs 18 and 19). Where the volume or the mass is given,
sigma^2/(2E) and its quotient by the density count instead.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from springcad.materials.allowable import Allowable, NoFatigueDataError, allowable_stress
from springcad.materials.data import Material


def energy_per_volume(stress: float, modulus: float) -> float:
    """sigma^2/(2E) [J/m^3]: what a material under uniform stress stores (paper 000, Eq. 15)."""
    return stress**2 / (2.0 * modulus)


def energy_per_mass(stress: float, modulus: float, density: float) -> float:
    """sigma^2/(2 E rho) [J/kg]."""
    return energy_per_volume(stress, modulus) / density


def leaf_metric(stress: float, modulus: float) -> float:
    """sigma^3/E^2 [Pa]: energy W s/(b l^3) of a leaf, but for its shape (paper 000, Eq. 18)."""
    return stress**3 / modulus**2


@dataclass(frozen=True)
class Ranked:
    """A material with the stress it is ranked by."""

    material: Material
    allowable: Allowable

    @property
    def modulus(self) -> float:
        """Pa; the value in use, its range is left out."""
        return self.material.elastic_modulus.value

    @property
    def stress(self) -> float:
        """Pa; the value in use, for most materials the lower end of the range."""
        return self.allowable.stress.value

    @property
    def stress_range(self) -> tuple[float, float]:
        """Both ends of what the sources give; the stress in use twice if they give no range."""
        stress = self.allowable.stress
        low, high = (self.stress if end is None else end for end in (stress.low, stress.high))
        return low, high

    @property
    def leaf_metric(self) -> float:
        return leaf_metric(self.stress, self.modulus)

    @property
    def leaf_metric_range(self) -> tuple[float, float]:
        low, high = (leaf_metric(end, self.modulus) for end in self.stress_range)
        return low, high

    @property
    def energy_per_volume(self) -> float:
        return energy_per_volume(self.stress, self.modulus)

    @property
    def energy_per_mass(self) -> float:
        return energy_per_mass(self.stress, self.modulus, self.material.density.value)


@dataclass(frozen=True)
class Ranking:
    """``ranked`` best first, for ``cycles`` (None: for one load); ``unknown``: name, reason."""

    cycles: float | None
    ranked: tuple[Ranked, ...]
    unknown: tuple[tuple[str, str], ...]


def rank_for_leaf(materials: Iterable[Material], cycles: float | None = None) -> Ranking:
    """Rank by sigma^3/E^2, with yield or, for a number of ``cycles``, fatigue as the stress.

    A material of which nothing is known at this life is not ranked. ValueError below 1e3 cycles.
    """
    ranked, unknown = [], []
    for material in materials:
        try:
            ranked.append(Ranked(material, allowable_stress(material, cycles)))
        except NoFatigueDataError as error:
            unknown.append((material.name, str(error)))
    ranked.sort(key=lambda entry: (-entry.leaf_metric, entry.material.name))
    return Ranking(cycles, tuple(ranked), tuple(unknown))


def remarks(ranking: Ranking) -> tuple[str, ...]:
    """What the order alone does not say, in full sentences."""
    if ranking.cycles is None:
        lines = [
            "Ranked by yield: one load to yield, no life. The order by fatigue is another"
            " one (--life CYCLES)."
        ]
    else:
        lines = [
            "Stresses are fully reversed amplitudes that half of smooth specimens survive; surface"
            " and reliability lower them. A life from an S-N line that is estimated is right to a"
            " factor of about 10; a fatigue strength known at a longer life is a lower bound."
        ]
    return (*lines, *_spread(ranking.ranked), *_metals_above_polymers(ranking.ranked))


def _spread(ranked: tuple[Ranked, ...]) -> list[str]:
    """How wide the widest range is, over the range of the stress."""
    ratios = [(high / low, entry) for entry in ranked for low, high in [entry.leaf_metric_range]]
    ratio, widest = max(ratios, key=lambda pair: pair[0], default=(1.0, None))
    if widest is None or ratio == 1.0:
        return []
    return [
        "The temper decides as much as the material: within the range of its stress sigma^3/E^2 of"
        f" {widest.material.name} spans a factor of {ratio:.3g}. Ranked is the value in use, for"
        " most the lower end."
    ]


def _metals_above_polymers(ranked: tuple[Ranked, ...]) -> list[str]:
    """The best metal that beats a polymer, against the conclusion of paper 000."""
    polymers = [entry for entry in ranked if entry.material.family == "polymer"]
    metal = next((entry for entry in ranked if entry.material.family != "polymer"), None)
    beaten = [p for p in polymers if metal is not None and p.leaf_metric < metal.leaf_metric]
    if metal is None or not beaten:
        return []
    names = " and ".join(f"{p.material.name} ({p.leaf_metric / 1e3:.3g} kPa)" for p in beaten)
    return [
        f"{metal.material.name} ({metal.leaf_metric / 1e3:.3g} kPa) beats {names}, against the"
        " conclusion of paper 000 that plastics outperform metals: its Table I has no such metal."
    ]
