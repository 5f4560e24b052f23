"""``springcad materials``: the data that designs are made with, each value with its source.

``springcad materials rank`` compares them.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING

import typer

from springcad.cli.console import result_console
from springcad.cli.materials_rank import rank
from springcad.cli.options import Json

if TYPE_CHECKING:
    from springcad.materials.data import Material, Value

_UNITS = {
    "elastic_modulus": "Pa",
    "poisson_ratio": "1",
    "density": "kg/m^3",
    "yield_strength": "Pa",
    "flexural_strength": "Pa",
    "ultimate_strength": "Pa",
    "fatigue_strength": "Pa",
}

materials_app = typer.Typer(invoke_without_command=True, rich_markup_mode=None)
materials_app.command()(rank)


@materials_app.callback()
def materials(context: typer.Context, as_json: Json = False) -> None:
    """List the materials, or rank them; JSON values are in SI."""
    from springcad.materials.data import MATERIALS

    if context.invoked_subcommand:
        if as_json:
            raise typer.BadParameter(f"--json stands behind {context.invoked_subcommand}")
        return
    if as_json:
        data = {name: asdict(material) for name, material in MATERIALS.items()}
        typer.echo(json.dumps(data, indent=2, ensure_ascii=False))
        return
    for material in MATERIALS.values():
        _print(material)
    typer.echo("* weak source: give the value in the spec if the design hangs on it")


def _print(material: Material) -> None:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    for heading in (material.name, "value", "range", "source"):
        table.add_column(heading, overflow="fold", no_wrap=heading in ("value", "range"))
    for row in _rows(material):
        table.add_row(*(Text(cell) for cell in row))
    console = result_console()
    console.print(Text(f"{material.title}, {material.temper}", "bold"))
    console.print(table)
    console.print()


def _rows(material: Material) -> Iterator[tuple[str, str, str, str]]:
    from springcad.report.display import format_value

    for key, unit in _UNITS.items():
        entry: Value | None = getattr(material, key)
        if entry is None:
            continue
        ends = [format_value(end, unit) for end in (entry.low, entry.high) if end is not None]
        weak = " *" if entry.weak else ""
        value = format_value(entry.value, unit)
        yield key.replace("_", " "), value, " to ".join(ends), f"{entry.source}{weak}"
