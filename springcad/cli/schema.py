"""``springcad schema``: the JSON schema of the spec, for editors."""

from __future__ import annotations

import json

import typer


def schema() -> None:
    """Print the JSON schema (draft-07) of the spec."""
    from springcad.spec.schema import json_schema

    typer.echo(json.dumps(json_schema(), indent=2, ensure_ascii=False))
