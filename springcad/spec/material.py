"""The material of a spec, and the stress it is designed for: given, or from a wanted life."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Annotated, Any, TypeAlias, cast

from pydantic import AfterValidator, ConfigDict, Field, ValidationInfo, WrapValidator

from springcad.materials.data import MATERIALS, Material, Value, material
from springcad.materials.fatigue_strength import (
    POLISHED,
    Duty,
    DutyError,
    FatigueStrength,
    fatigue_strength,
)
from springcad.mechanics.fatigue import MEAN_STRESS, RELIABILITY_FACTORS, SURFACES
from springcad.spec.common import Density, ElasticModulus, OneOf, PoissonRatio, Quantity, Stress
from springcad.spec.csv_columns import FaultsError
from springcad.spec.pairs import Load, LoadReader, Number, Pairs, alike, falls
from springcad.spec.rules import Section, rule
from springcad.spec.text import listing
from springcad.spec.units import STRESS

LONGEST_LIFE = 1e12
_STRESS = Quantity(STRESS, "0.1 MPa", "10000 MPa")


def _reliability(value: float) -> float:
    if value in RELIABILITY_FACTORS:
        return value
    known = listing([f"{share:g}" for share in RELIABILITY_FACTORS])
    raise ValueError(f"must be {known}, is {value:g}")


def _surface(value: str | None, info: ValidationInfo) -> str | None:
    """The surface, polished where nothing is said; None where a factor stands for it."""
    has_factor = info.data.get("surface_factor") is not None
    if value is not None and has_factor:
        raise ValueError("give one of surface and surface_factor, not both")
    return value or (None if has_factor else POLISHED)


class LifeSpec(Section):
    """Life that the design stress is found from."""

    cycles: Annotated[float, Field(ge=1.0, le=LONGEST_LIFE)]
    """Number of load cycles to bear, a bare number as 1e5."""
    load_ratio: Annotated[float, Field(ge=-1.0, lt=1.0)] = -1.0
    """Smallest over largest stress of a cycle: -1 fully reversed, 0 from rest to one side."""
    reliability: Annotated[
        float,
        AfterValidator(_reliability),
        Field(json_schema_extra={"enum": list(RELIABILITY_FACTORS)}),
    ] = 0.5
    """Share of parts that survive: 0.5, 0.9, 0.95, 0.99 or 0.999."""
    surface_factor: Annotated[float, Field(ge=0.1, le=1.0)] | None = None
    """Factor of a surface for which none is published, as cut by wire EDM, laser or waterjet."""
    surface: Annotated[
        Annotated[str, OneOf("surface", (POLISHED, *SURFACES))] | None, AfterValidator(_surface)
    ] = None
    """Surface of the finished part; polished if neither this nor surface_factor is given."""
    size_factor: Annotated[float, Field(ge=0.5, le=1.0)] = 1.0
    """Factor of the size; below 1 for sections of more than 7.62 mm equivalent diameter only."""
    mean_stress: Annotated[str, OneOf("mean-stress correction", tuple(MEAN_STRESS))] = "goodman"
    """Correction for a load ratio other than -1: goodman, gerber or soderberg."""
    sn: (
        Annotated[
            tuple[tuple[float, float], ...],
            Pairs(Number(0.0, LONGEST_LIFE), _STRESS, "[cycles, stress in MPa]", 2, falls),
        ]
        | None
    ) = None
    """S-N points of your own, [cycles, stress], fully reversed, in place of the table's values."""
    histogram: (
        Annotated[
            tuple[tuple[Load, float], ...],
            Pairs(LoadReader(), Number(0.0, LONGEST_LIFE), "[torque or share, cycles]", 1, alike),
        ]
        | None
    ) = None
    """Loads to bear in all, [torque or share of the full deflection, cycles]: Miner's sum."""

    @property
    def duty(self) -> Duty:
        """What the strength follows from."""
        return Duty(
            cycles=self.cycles,
            load_ratio=self.load_ratio,
            reliability=self.reliability,
            surface=self.surface or POLISHED,
            surface_factor=self.surface_factor,
            size_factor=self.size_factor,
            mean_stress=self.mean_stress,
            points=self.sn,
        )


_OVERRIDES = (
    "elastic_modulus",
    "poisson_ratio",
    "density",
    "yield_strength",
    "ultimate_strength",
)


def _values(given: dict[str, Any]) -> Material:
    """The table's values, each replaced by what is given."""
    own: dict[str, Any] = {
        key: Value(number, "spec") for key in _OVERRIDES if (number := given.get(key)) is not None
    }
    return replace(material(given["name"]), **own)


def _known_life(life: LifeSpec | None, info: ValidationInfo) -> LifeSpec | None:
    """The life, for which the material has a strength; FaultsError, at the key, if it has none.

    Nothing is said while keys that the strength follows from are wrong themselves.
    """
    if life is not None and {"name", *_OVERRIDES} <= set(info.data):
        try:
            fatigue_strength(_values(info.data), life.duty)
        except DutyError as error:
            raise FaultsError([((error.key,) if error.key else (), str(error))]) from error
    return life


def _given_or_from_life(
    value: object, read: Callable[[object], float], info: ValidationInfo
) -> float | None:
    """The design stress that is given, or else the one that the life allows."""
    if value is not None:
        stress = read(value)
        if info.data.get("life") is not None:
            raise ValueError("give one of design_stress and life, not both")
        return stress
    if not {"name", *_OVERRIDES, "life"} <= set(info.data):
        return None  # something else is wrong, which is said where it stands
    if info.data["life"] is None:
        raise ValueError("missing: give design_stress, or life to find it from")
    return fatigue_strength(_values(info.data), info.data["life"].duty).stress


DesignStress: TypeAlias = Annotated[float, _STRESS, WrapValidator(_given_or_from_life)]


class MaterialSpec(Section):
    """What the part is made of, and the stress it is designed for."""

    model_config = ConfigDict(
        json_schema_extra={"oneOf": [{"required": ["design_stress"]}, {"required": ["life"]}]}
    )

    name: Annotated[str, OneOf("material", tuple(MATERIALS))]
    """Material; `springcad materials` lists them with their values and sources."""
    elastic_modulus: ElasticModulus | None = None
    """Elastic modulus in GPa, in place of the table's."""
    poisson_ratio: PoissonRatio | None = None
    """Poisson's ratio, in place of the table's."""
    density: Density | None = None
    """Density in kg/m^3 or g/cm^3, in place of the table's."""
    yield_strength: Stress | None = None
    """Yield strength in MPa, in place of the table's."""
    ultimate_strength: Stress | None = None
    """Ultimate tensile strength in MPa, in place of the table's."""
    # The strength that a life needs follows from what stands above, the stress from the life.
    life: Annotated[LifeSpec | None, AfterValidator(_known_life)] = None
    """Life that the design stress is found from, in place of design_stress."""
    design_stress: DesignStress = Field(default=cast(Any, None))
    """Stress amplitude that the flexures reach at the design deflection, in MPa; or give life."""

    @property
    def values(self) -> Material:
        """The table's values, each replaced by the user's where the spec gives one."""
        return _values(dict(self))

    @property
    def strength(self) -> FatigueStrength | None:
        """What the design stress follows from, where it is found from a life."""
        return None if self.life is None else fatigue_strength(self.values, self.life.duty)


@rule("material.life.histogram")
def shares_only(histogram: tuple[tuple[Load, float], ...] | None) -> str | None:
    """Rule of a kind whose stress does not follow from a torque alone."""
    if histogram is None or histogram[0][0].unit == "1":
        return None
    return "this kind has no single torque; give shares of the full deflection, 0 to 1"
