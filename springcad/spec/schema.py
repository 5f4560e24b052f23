"""The JSON schema (draft-07) of the spec, for editors that complete and check YAML."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from springcad.spec.source import spec_models


def json_schema() -> dict[str, Any]:
    """One schema for all kinds: ``kind`` decides which definition a spec is held to."""
    definitions: dict[str, Any] = {}
    cases: list[dict[str, Any]] = []
    kinds = spec_models()
    for kind, module in kinds.items():
        model = import_module(module).SPEC_MODEL
        template = f"#/definitions/{kind}.{{model}}"
        schema = model.model_json_schema(ref_template=template)
        for name, definition in schema.pop("$defs", {}).items():
            definitions[f"{kind}.{name}"] = _draft07(definition)
        definitions[kind] = _draft07(schema)
        cases.append(
            {
                "if": {"properties": {"kind": {"const": kind}}, "required": ["kind"]},
                "then": {"$ref": f"#/definitions/{kind}"},
            }
        )
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "springcad spec",
        "type": "object",
        "required": ["springcad", "kind", "name"],
        "properties": {
            "springcad": {"const": 1, "description": "Version of the spec format."},
            "kind": {"enum": list(kinds), "description": "Kind of element to design."},
            "name": {"type": "string"},
        },
        "allOf": cases,
        "definitions": definitions,
    }


def _draft07(node: Any) -> Any:
    """pydantic's schema in draft-07 terms, without null values and without made-up titles."""
    if isinstance(node, list):
        return [_draft07(item) for item in node]
    if not isinstance(node, dict):
        return node
    schema = {key: _draft07(value) for key, value in node.items() if not _noise(key, value)}
    kinds = schema.get("anyOf")
    if isinstance(kinds, list) and {"type": "null"} in kinds:
        # null is refused in a spec: a key that is not given is left out
        kinds.remove({"type": "null"})
        if len(kinds) == 1:
            schema = {**schema.pop("anyOf")[0], **schema}
    if "$ref" in schema and len(schema) > 1:
        # draft-07 ignores whatever stands beside $ref
        schema["allOf"] = [{"$ref": schema.pop("$ref")}]
    return schema


def _noise(key: str, value: Any) -> bool:
    return (key == "title" and isinstance(value, str)) or (key == "default" and value is None)
