"""``springcad init``: a commented spec to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from springcad.cli.console import say
from springcad.cli.kinds import known_kind
from springcad.errors import OutputError


def init(
    kind: Annotated[str, typer.Argument(help="Kind of element; `springcad kinds` lists them.")],
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="File to write, - for stdout.", show_default="KIND.yaml"),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it exists.")] = False,
) -> None:
    """Write a commented spec that designs as it stands."""
    from springcad.export.files import write_files

    template = known_kind(kind).TEMPLATE
    if out == Path("-"):
        typer.echo(template, nl=False)
        return
    path = out or Path(f"{kind}.yaml")
    if path.exists() and not force:
        raise OutputError(f"{path} is there already; --force replaces it")
    write_files(path.parent, {path.name: template})
    say(f"wrote {path}; next: springcad design {path}")
