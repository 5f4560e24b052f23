"""The JSON schema for editors: draft-07, accepts what the tool accepts, marks common mistakes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft7Validator
from ruamel.yaml import YAML

from springcad.kinds.rotary_flexure.spec import TEMPLATE
from springcad.spec.schema import json_schema

SCHEMA = json_schema()
SPECS = sorted((Path(__file__).parents[2] / "specs").rglob("*.yaml"))


def load(text: str) -> Any:
    return YAML(typ="safe", pure=True).load(text)


def errors(spec: Any) -> list[str]:
    return [error.json_path for error in Draft7Validator(SCHEMA).iter_errors(spec)]


def test_it_is_a_draft_07_schema() -> None:
    assert SCHEMA["$schema"] == "http://json-schema.org/draft-07/schema#"
    Draft7Validator.check_schema(SCHEMA)
    assert not {"$defs", "prefixItems", "unevaluatedProperties"} & set(_keywords(SCHEMA))


def test_nothing_stands_beside_a_reference() -> None:
    for node in _nodes(SCHEMA):
        if "$ref" in node:
            assert set(node) == {"$ref"}


def test_every_key_is_described() -> None:
    for name, definition in SCHEMA["definitions"].items():
        assert definition["additionalProperties"] is False
        for key, field in definition["properties"].items():
            target = field.get("$ref", "").removeprefix("#/definitions/")
            described = field if "description" in field else SCHEMA["definitions"][target]
            assert described["description"], f"{name}.{key}"


def test_defaults_are_written_as_in_a_spec() -> None:
    flexures = SCHEMA["definitions"]["rotary-flexure.Flexures"]["properties"]
    assert flexures["tip_thickness"]["default"] == "0.35 mm"
    assert flexures["style"]["default"] == "auto"
    assert "default" not in flexures["min_gap"]
    assert SCHEMA["definitions"]["rotary-flexure"]["properties"]["mounting"]["default"] == "bore"


def test_the_template_is_valid() -> None:
    assert errors(load(TEMPLATE)) == []


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_every_shipped_spec_is_valid(path: Path) -> None:
    assert errors(load(path.read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize(
    ("section", "key", "value"),
    [
        ("envelope", "outer_radius", "33.5 um"),
        ("envelope", "outer_radius", "3.35cm"),
        ("target", "stiffness", "150 N m/rad"),
        ("target", "stiffness", "150 N·m / rad"),
        ("target", "stiffness", "2.6 Nm/deg"),
        ("target", "deflection", "14.5°"),
        ("material", "design_stress", "912 N/mm^2"),
        ("material", "design_stress", "9.12e2 MPa"),
        ("material", "density", "7.7 g/cm³"),
        ("flexures", "root_fillet", "0.5 mm"),
        (None, "mounting", {"dowels": {"count": 8, "radius": "1.5 mm"}}),
        (None, "process", {"name": "laser", "min_gap": "0.4 mm"}),
    ],
)
def test_other_spellings_are_valid(section: str | None, key: str, value: object) -> None:
    spec = load(TEMPLATE)
    (spec[section] if section else spec)[key] = value
    assert errors(spec) == []


@pytest.mark.parametrize(
    ("section", "key", "value"),
    [
        ("envelope", "outer_radius", 33.5),
        ("envelope", "outer_radius", "33.5"),
        ("envelope", "outer_radius", "33.5 MPa"),
        ("envelope", "outer_radus", "33.5 mm"),
        ("target", "stiffness", "150 N*m"),
        ("material", "design_stress", "912 MPA"),
        ("material", "name", "aisi420"),
        ("flexures", "count", "24"),
        ("flexures", "count", 2),
        ("flexures", "style", "straigth"),
        ("flexures", "min_gap", None),
        (None, "mounting", "glue"),
        (None, "process", "lazer"),
        (None, "kind", "bicycle"),
        (None, "springcad", 2),
        (None, "name", "a/b"),
        (None, "zzz", 1),
    ],
)
def test_common_mistakes_are_marked(section: str | None, key: str, value: object) -> None:
    spec = load(TEMPLATE)
    (spec[section] if section else spec)[key] = value
    assert errors(spec)


def test_a_missing_section_is_marked() -> None:
    spec = load(TEMPLATE)
    del spec["envelope"]
    assert errors(spec)


def _nodes(node: Any) -> Iterator[dict[str, Any]]:
    if isinstance(node, dict):
        yield node
    for inner in node.values() if isinstance(node, dict) else node:
        if isinstance(inner, (dict, list)):
            yield from _nodes(inner)


def _keywords(node: Any) -> Iterator[str]:
    for inner in _nodes(node):
        yield from inner
