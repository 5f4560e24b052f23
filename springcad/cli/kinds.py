"""``springcad kinds``: what can be designed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from springcad.kinds import Kind


def kinds() -> None:
    """List the kinds of element that springcad designs."""
    from springcad.kinds import KINDS

    width = max(map(len, KINDS))
    for name, (_, description) in KINDS.items():
        typer.echo(f"{name:{width}}  {description}")


def known_kind(name: str) -> Kind:
    """The kind ``name``; wrong usage (exit code 2) for an unknown one."""
    from springcad.kinds import KINDS, load_kind
    from springcad.spec.text import unknown

    if name in KINDS:
        return load_kind(name)
    raise typer.BadParameter(unknown("kind", name, KINDS))
