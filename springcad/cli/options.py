"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from springcad.cli.failures import Format

Specs = Annotated[
    list[Path], typer.Argument(metavar="SPEC", help="Spec files, and folders of them.")
]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Replace a value: target.deflection=12deg"),
]
ProblemFormat = Annotated[
    Format, typer.Option("--format", help="How problems are shown: lines or GitHub annotations.")
]
Json = Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")]
