"""The calibration of a rotary flexure spring: a file of ``springcad calibrate``, or a section.

calibration: S2-calibration.yaml     # beside the spec or in a folder below it
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

from pydantic import BeforeValidator, Field, ValidationError, ValidationInfo

from springcad.errors import Problem, SpecError
from springcad.materials.data import MATERIALS
from springcad.spec.common import ElasticModulus, OneOf
from springcad.spec.complaints import complaints
from springcad.spec.csv_columns import Fault, FaultsError
from springcad.spec.file_text import read_text
from springcad.spec.points import FOLDER, beside
from springcad.spec.rules import Section, rule
from springcad.spec.text import printable
from springcad.spec.tree import Place, parse

if TYPE_CHECKING:
    from springcad.kinds.rotary_flexure.spec_sections import Camshaft
    from springcad.spec.material import MaterialSpec


class Calibration(Section):
    """What a bench test of an earlier design has told, in place of what was taken for granted."""

    design: str
    """Name of the design that was measured."""
    curve: str
    """Name of the file with what was measured."""
    material: Annotated[str, OneOf("material", tuple(MATERIALS))]
    """Material of the design that was measured."""
    elastic_modulus: ElasticModulus
    """Elastic modulus in GPa, in place of the material's."""
    elastic_modulus_error: ElasticModulus | None = None
    """Standard error of elastic_modulus in GPa, where it was fitted."""
    root_coefficient: Annotated[float, Field(ge=-8.0, le=48.0)] = 0.0
    """Extra rotation of a flexure's root, over M/(E t h^2), a bare number."""
    root_coefficient_error: Annotated[float, Field(ge=0.0)] | None = None
    """Standard error of root_coefficient, where it was fitted."""
    friction: Annotated[float, Field(ge=0.0, le=0.6)] | None = None
    """Coefficient of dry friction between tips and camshaft, in place of the camshaft's."""
    friction_error: Annotated[float, Field(ge=0.0)] | None = None
    """Standard error of friction."""


def _from_file(value: object, info: ValidationInfo) -> object:
    """The calibration in the file that ``value`` names; anything but a name as it is.

    Raises FaultsError, each fault with its place in that file.
    """
    if not isinstance(value, str):
        return value
    path = (info.context or {}).get(FOLDER, Path()) / beside(value, "a calibration file")
    shown = printable(path, longest=500)
    try:
        tree = parse(read_text(path, shown), shown)
    except SpecError as error:
        raise FaultsError([((), f"{shown}: {p.message}") for p in error.problems]) from error
    problems, cause = list(tree.problems), None
    if not problems and not isinstance(tree.data, dict):
        problems.append(tree.values[()].problem("holds no calibration"))
    if not problems:
        try:
            return Calibration.model_validate(tree.data)
        except ValidationError as error:
            cause = error
            problems += complaints(error.errors(include_url=False), Calibration, tree)
    raise FaultsError([_fault(problem) for problem in problems]) from cause


def _fault(problem: Problem) -> Fault:
    key = f"{problem.key}: " if problem.key else ""
    return Place(problem.file, problem.line, problem.column), key + problem.message


CalibrationEntry: TypeAlias = Annotated[
    Calibration | None,
    BeforeValidator(_from_file, json_schema_input_type=str | Calibration),
]
"""A calibration by the name of its file, or as a section."""


@rule("calibration", "material")
def same_material(calibration: Calibration | None, material: MaterialSpec) -> str | None:
    """Rule: the modulus is that of the material, and given once."""
    if calibration is None:
        return None
    if calibration.material != material.name:
        return f"is of {calibration.material}, not of {material.name}"
    if material.elastic_modulus is not None:
        return "gives the elastic modulus; leave material.elastic_modulus out"
    return None


@rule("calibration", "camshaft")
def one_friction(calibration: Calibration | None, camshaft: Camshaft) -> str | None:
    """Rule: the friction is given once."""
    if calibration is None or calibration.friction is None:
        return None
    if "friction" not in camshaft.model_fields_set:
        return None
    return "gives the friction; leave camshaft.friction out"
