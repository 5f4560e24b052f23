"""What every kind of spec has in common: value types with their ranges, process, name.

Inside the models all is SI: m, rad, Pa, N*m/rad, kg/m^3.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Literal, TypeAlias

from pydantic import AfterValidator, BeforeValidator, Field, model_validator
from pydantic_core import CoreSchema, core_schema

from springcad.materials.process import PROCESSES, Process, process
from springcad.spec.rules import Rule, Section, broken_rules, parts_of
from springcad.spec.text import listing, printable, unknown
from springcad.spec.tree import dotted
from springcad.spec.units import (
    ANGLE,
    DENSITY,
    LENGTH,
    STIFFNESS,
    STRESS,
    Dimension,
    parse_quantity,
    show,
)


@dataclass(frozen=True)
class Quantity:
    """Type annotation of a number with a unit, from ``low`` to ``high``; ``words`` stand as typed.

    The value in the model is SI.
    """

    dimension: Dimension
    low: str
    high: str
    words: tuple[str, ...] = ()

    def read(self, value: object) -> float | str:
        """The SI value of what stands in the spec; ValueError in words for the user."""
        dimension = self.dimension
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            example = f"{printable(value, 20)} {dimension.unit}"
            raise ValueError(f"needs a unit, for example {example}")
        if not isinstance(value, str):
            raise ValueError(f"must be {dimension.name} with its unit ({dimension.units[0]}, …)")
        if value in self.words:
            return value
        number = parse_quantity(value, dimension)
        low, high = (parse_quantity(limit, dimension) for limit in (self.low, self.high))
        if not low <= number <= high:
            raise ValueError(
                f"must be from {self.low} to {self.high}, is {show(number, dimension)}"
            )
        return number

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, *_: object) -> dict[str, Any]:
        text = {"type": "string", "pattern": self.dimension.pattern}
        return {"anyOf": [{"enum": list(self.words)}, text]} if self.words else text


@dataclass(frozen=True)
class OneOf:
    """Type annotation of a name out of ``names``; ``what`` says what they are names of."""

    what: str
    names: tuple[str, ...]

    def read(self, value: object) -> str:
        if not isinstance(value, str):
            raise ValueError(f"must be the name of a {self.what}: {listing(self.names)}")
        if value not in self.names:
            raise ValueError(unknown(self.what, value, self.names))
        return value

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, *_: object) -> dict[str, Any]:
        return {"type": "string", "enum": list(self.names)}


@dataclass(frozen=True)
class Count:
    """Type annotation of a whole number from ``low`` to ``high``; ``words`` stand as typed."""

    low: int
    high: int
    words: tuple[str, ...] = ()

    def read(self, value: object) -> int | str:
        if isinstance(value, str) and value in self.words:
            return value
        if not isinstance(value, int) or isinstance(value, bool):
            raise ValueError(f"must be {listing(('a whole number', *self.words))}")
        if not self.low <= value <= self.high:
            raise ValueError(f"must be from {self.low} to {self.high}, is {value}")
        return value

    def __get_pydantic_core_schema__(self, *_: object) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, *_: object) -> dict[str, Any]:
        whole = {"type": "integer", "minimum": self.low, "maximum": self.high}
        return {"anyOf": [{"enum": list(self.words)}, whole]} if self.words else whole


Length: TypeAlias = Annotated[float, Quantity(LENGTH, "0.001 mm", "10 m")]
LengthOrZero: TypeAlias = Annotated[float, Quantity(LENGTH, "0 mm", "10 m")]
AutoLength: TypeAlias = Annotated[
    float | Literal["auto"], Quantity(LENGTH, "0.001 mm", "10 m", words=("auto",))
]
Stress: TypeAlias = Annotated[float, Quantity(STRESS, "0.1 MPa", "10000 MPa")]
ElasticModulus: TypeAlias = Annotated[float, Quantity(STRESS, "1 MPa", "1500 GPa")]
TorsionalStiffness: TypeAlias = Annotated[
    float, Quantity(STIFFNESS, "0.000001 N*m/rad", "1000000000 N*m/rad")
]
Density: TypeAlias = Annotated[float, Quantity(DENSITY, "10 kg/m^3", "30000 kg/m^3")]
PoissonRatio: TypeAlias = Annotated[float, Field(ge=0.0, lt=0.5)]


def angle(low: str, high: str) -> Quantity:
    """Annotation of an angle in a range that depends on what it is the angle of."""
    return Quantity(ANGLE, low, high)


def default(text: str) -> Any:
    """A default in the form in which it stands in a spec; it is validated like any other value."""
    return Field(default=text)


class ProcessSpec(Section):
    """How the part is cut, and what the shop can make."""

    name: Annotated[str, OneOf("process", tuple(PROCESSES))]
    """Cutting process."""
    min_web: Length | None = None
    """Narrowest material left standing, in place of the table's."""
    min_gap: Length | None = None
    """Narrowest slot that can be cut, in place of the table's."""
    min_inside_radius: Length | None = None
    """Smallest radius of an inside corner, in place of the table's."""

    @property
    def rules(self) -> Process:
        """The table's rules, each replaced by the user's where the spec gives one."""
        own = {
            key: number
            for key in ("min_web", "min_gap", "min_inside_radius")
            if (number := getattr(self, key)) is not None
        }
        return replace(process(self.name), **own)


def below_process(what: str, length: float, least: float, process: ProcessSpec) -> str | None:
    """Message for a ``length`` below what the process can make; round-off of inputs is allowed."""
    if length >= least * (1.0 - 1e-9):
        return None
    can = f"the {show(least, LENGTH)} that {process.name} can make"
    return f"{what} of {show(length, LENGTH)} is below {can}"


def _as_section(value: object) -> object:
    if not isinstance(value, (str, dict)):
        raise ValueError("must be the name of a process, or a section with name and shop rules")
    return {"name": value} if isinstance(value, str) else value


ProcessEntry: TypeAlias = Annotated[
    ProcessSpec,
    BeforeValidator(
        _as_section,
        json_schema_input_type=Annotated[str, OneOf("process", tuple(PROCESSES))] | ProcessSpec,
    ),
]
"""A process by its name alone, or as a section with shop rules of its own."""

_RESERVED = re.compile("con|prn|aux|nul|com[0-9]|lpt[0-9]", re.IGNORECASE)
NAME_PATTERN = "^[A-Za-z0-9][A-Za-z0-9._-]{0,63}$"


def _file_name(name: str) -> str:
    """A name that is a folder's and a file's on every system."""
    if not re.fullmatch(NAME_PATTERN[1:-1], name):
        raise ValueError(
            "must begin with a letter or a digit and have at most 64 letters, digits, '.', '_', '-'"
        )
    if name.endswith(".") or _RESERVED.fullmatch(name.split(".")[0]):
        raise ValueError("cannot be a file name on Windows")
    return name


class CommonSpec(Section):
    """The keys that every spec has; each kind adds its own and the rules between them."""

    RULES: ClassVar[tuple[Rule, ...]] = ()

    springcad: Literal[1]
    """Version of the spec format."""
    kind: str
    """Kind of element to design."""
    name: Annotated[
        str, AfterValidator(_file_name), Field(json_schema_extra={"pattern": NAME_PATTERN})
    ]
    """Name of the design and of its files: letters, digits, '.', '_' and '-'."""

    @model_validator(mode="after")
    def _keep_rules(self) -> CommonSpec:
        broken = [
            f"{dotted(key)}: {m}" for key, m in broken_rules(self.RULES, dict(parts_of(self)))
        ]
        if broken:
            raise ValueError("; ".join(broken))
        return self
