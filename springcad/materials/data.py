"""Material values, each with its source; the user of a spec may override any of them.

One grade spans a wide range of strength with its temper. Where the sources give a range, ``low``
and ``high`` hold it and ``value`` is the one that is used: the lower end for a strength, so that
a check against it is on the safe side, and for a modulus or a density what ``source`` says.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Family = Literal["steel", "copper alloy", "aluminium alloy", "titanium alloy", "polymer"]


@dataclass(frozen=True)
class Value:
    """A number in SI with its source; ``weak`` marks one that needs a better source."""

    value: float
    source: str
    low: float | None = None
    high: float | None = None
    weak: bool = False


@dataclass(frozen=True)
class Material:
    """A material in a stated temper.

    Attributes:
        name: as in the spec.
        title, temper: for people.
        family: what rules hold for it: an S-N line can be estimated for steels only.
        elastic_modulus: Pa, in bending where the sources tell bending from tension.
        poisson_ratio: 1.
        density: kg/m^3.
        yield_strength: Pa, in tension.
        flexural_strength: Pa, yield strength in bending where it is not that in tension.
        ultimate_strength: Pa, in tension.
        fatigue_strength: Pa, stress amplitude at the load and life that its source says.
        fatigue_cycles: that life; None if the source is silent about it.
    """

    name: str
    title: str
    temper: str
    family: Family
    elastic_modulus: Value
    poisson_ratio: Value
    density: Value
    yield_strength: Value
    flexural_strength: Value | None = None
    ultimate_strength: Value | None = None
    fatigue_strength: Value | None = None
    fatigue_cycles: float | None = None


_MPA = 1e6
_GPA = 1e9
_PAPER_000 = "paper 000, Table I"
_LOWER_END = "lower end of the range: give yield_strength for your temper"


def _poisson(value: float) -> Value:
    return Value(value, "common handbook value", weak=True)


def _handbook_density(value: float, low: float | None = None, high: float | None = None) -> Value:
    return Value(value, "common handbook value", low, high, weak=True)


_TABLE = (
    Material(
        name="aisi-420",
        title="stainless steel AISI 420 (1.4028)",
        temper="hardened, as paper 004 takes it",
        family="steel",
        elastic_modulus=Value(
            200 * _GPA, "reproduces the designs of paper 004, Table I", 190 * _GPA, 200 * _GPA
        ),
        poisson_ratio=_poisson(0.3),
        density=Value(
            7700,
            "MakeItFrom; the masses of paper 004, Table I imply 7660 to 7710",
            7660,
            7800,
        ),
        yield_strength=Value(1310 * _MPA, "MakeItFrom"),
        ultimate_strength=Value(1720 * _MPA, "MakeItFrom; gives the 912 MPa of paper 004"),
        fatigue_strength=Value(670 * _MPA, "MakeItFrom"),
    ),
    Material(
        name="51crv4",
        title="spring steel 51CrV4 (1.8159)",
        temper="quenched and tempered",
        family="steel",
        elastic_modulus=Value(206 * _GPA, _PAPER_000),
        poisson_ratio=_poisson(0.3),
        density=_handbook_density(7850),
        yield_strength=Value(
            900 * _MPA,
            "EN data sheets, at least; paper 000, Table I has 840 to 1260",
            840 * _MPA,
            1260 * _MPA,
        ),
        ultimate_strength=Value(1100 * _MPA, "EN data sheets, lower end", 1100 * _MPA, 1300 * _MPA),
    ),
    Material(
        name="50crva",
        title="spring steel 50CrVA",
        temper="not stated in the source",
        family="steel",
        elastic_modulus=Value(206 * _GPA, "paper 001, section 4.1 (printed there as 2.06 GPa)"),
        poisson_ratio=Value(0.29, "paper 001, section 4.1"),
        density=_handbook_density(7850),
        yield_strength=Value(1320 * _MPA, "paper 001, section 4.1"),
    ),
    Material(
        name="65mn",
        title="spring steel 65Mn",
        temper="quenched and tempered",
        family="steel",
        elastic_modulus=Value(208 * _GPA, "paper 003"),
        poisson_ratio=_poisson(0.3),
        density=_handbook_density(7850, 7810, 7850),
        yield_strength=Value(
            726 * _MPA, "paper 003; GB/T 1222 asks for at least 784", 726 * _MPA, 784 * _MPA
        ),
        ultimate_strength=Value(980 * _MPA, "GB/T 1222, at least"),
    ),
    Material(
        name="cube2",
        title="beryllium copper CuBe2",
        temper=f"from annealed to age-hardened; {_LOWER_END}",
        family="copper alloy",
        elastic_modulus=Value(122 * _GPA, _PAPER_000),
        poisson_ratio=_poisson(0.3),
        density=_handbook_density(8250),
        yield_strength=Value(140 * _MPA, f"{_PAPER_000}, lower end", 140 * _MPA, 1000 * _MPA),
    ),
    Material(
        name="cusn6",
        title="phosphor bronze CuSn6",
        temper=f"from soft to spring-hard; {_LOWER_END}",
        family="copper alloy",
        elastic_modulus=Value(118 * _GPA, _PAPER_000),
        poisson_ratio=_poisson(0.34),
        density=_handbook_density(8800),
        yield_strength=Value(230 * _MPA, f"{_PAPER_000}, lower end", 230 * _MPA, 500 * _MPA),
    ),
    Material(
        name="en-aw-2014",
        title="aluminium EN AW-2014",
        temper=f"from annealed to T6; {_LOWER_END}",
        family="aluminium alloy",
        elastic_modulus=Value(70 * _GPA, _PAPER_000),
        poisson_ratio=_poisson(0.33),
        density=_handbook_density(2800),
        yield_strength=Value(125 * _MPA, f"{_PAPER_000}, lower end", 125 * _MPA, 380 * _MPA),
    ),
    Material(
        name="al-7075-t6",
        title="aluminium 7075-T6",
        temper="T6",
        family="aluminium alloy",
        elastic_modulus=Value(71.7 * _GPA, "common data sheets", weak=True),
        poisson_ratio=_poisson(0.33),
        density=_handbook_density(2810),
        yield_strength=Value(
            505 * _MPA, "common data sheets, lower end", 505 * _MPA, 572 * _MPA, weak=True
        ),
        fatigue_strength=Value(159 * _MPA, "common data sheets, life not stated", weak=True),
    ),
    Material(
        name="ti-6al-4v",
        title="titanium Ti-6Al-4V (grade 5)",
        temper="solution treated and aged",
        family="titanium alloy",
        elastic_modulus=Value(
            112.5 * _GPA, "ASM and producers, middle of the range", 105 * _GPA, 120 * _GPA
        ),
        poisson_ratio=_poisson(0.34),
        density=Value(4430, "ASM and producers", 4420, 4430),
        yield_strength=Value(965 * _MPA, "ASM and producers, lower end", 965 * _MPA, 980 * _MPA),
        ultimate_strength=Value(1035 * _MPA, "ASM and producers"),
        fatigue_strength=Value(
            570 * _MPA,
            "ASM and producers: smooth specimens at 1e7 cycles, lower end",
            570 * _MPA,
            700 * _MPA,
        ),
        fatigue_cycles=1e7,
    ),
    Material(
        name="17-7ph",
        title="stainless steel 17-7PH",
        temper="precipitation hardened; peening changes its fatigue strength",
        family="steel",
        elastic_modulus=Value(204 * _GPA, "AZoM"),
        poisson_ratio=_poisson(0.3),
        density=Value(7800, "AZoM"),
        yield_strength=Value(1030 * _MPA, "AZoM"),
        ultimate_strength=Value(1275 * _MPA, "AZoM"),
    ),
    Material(
        name="maraging-300",
        title="maraging steel 300",
        temper="aged",
        family="steel",
        elastic_modulus=Value(189.6 * _GPA, "one user's table", weak=True),
        poisson_ratio=_poisson(0.3),
        density=Value(8000, "one user's table", 8000, 8100, weak=True),
        yield_strength=Value(2135 * _MPA, "one user's table", weak=True),
        ultimate_strength=Value(2169 * _MPA, "one user's table", weak=True),
    ),
    Material(
        name="pom-c",
        title="POM-C (TECAFORM AH)",
        temper="as extruded; no endurance limit, creeps",
        family="polymer",
        elastic_modulus=Value(
            2.6 * _GPA, f"{_PAPER_000}, flexural (tensile 2.8 GPa)", 2.6 * _GPA, 2.8 * _GPA
        ),
        poisson_ratio=_poisson(0.35),
        density=Value(1410, "Engineering Plastics Handbook"),
        yield_strength=Value(67 * _MPA, f"{_PAPER_000}, tensile"),
        flexural_strength=Value(91 * _MPA, f"{_PAPER_000}, flexural"),
    ),
    Material(
        name="pet",
        title="PET (TECADUR PET)",
        temper="as extruded; no endurance limit, creeps",
        family="polymer",
        elastic_modulus=Value(
            3.4 * _GPA, f"{_PAPER_000}, flexural (tensile 3.3 GPa)", 3.3 * _GPA, 3.4 * _GPA
        ),
        poisson_ratio=_poisson(0.38),
        density=_handbook_density(1390),
        yield_strength=Value(91 * _MPA, f"{_PAPER_000}, tensile"),
        flexural_strength=Value(134 * _MPA, f"{_PAPER_000}, flexural"),
    ),
    Material(
        name="pei",
        title="PEI (TECAPEI)",
        temper="as extruded; no endurance limit, creeps",
        family="polymer",
        elastic_modulus=Value(
            3.3 * _GPA, f"{_PAPER_000}, flexural (tensile 3.2 GPa)", 3.2 * _GPA, 3.3 * _GPA
        ),
        poisson_ratio=_poisson(0.36),
        density=_handbook_density(1270),
        yield_strength=Value(127 * _MPA, f"{_PAPER_000}, tensile"),
        flexural_strength=Value(164 * _MPA, f"{_PAPER_000}, flexural"),
    ),
)

MATERIALS = {entry.name: entry for entry in _TABLE}
"""Name in the spec → values."""


def material(name: str) -> Material:
    """The values of ``name``; KeyError for an unknown name."""
    return MATERIALS[name]
