"""The application: every command by name, and the options that stand before a command."""

from __future__ import annotations

from typing import Annotated

import typer

from springcad import __version__
from springcad.cli.calibrate import calibrate
from springcad.cli.check import check
from springcad.cli.compensate import compensate
from springcad.cli.design import design
from springcad.cli.doctor import doctor
from springcad.cli.explain import explain
from springcad.cli.init import init
from springcad.cli.kinds import kinds
from springcad.cli.materials import materials_app
from springcad.cli.preflight import preflight
from springcad.cli.schema import schema
from springcad.cli.verify import verify

_EXIT_CODES = """
Exit codes: 0 done, every check passes; 1 internal error; 2 wrong usage; 3 spec invalid;
4 no feasible design; 5 designed and written, but a check failed; 6 output could not be written;
130 interrupted. Of several specs: 1 if any, else the highest.
"""

app = typer.Typer(
    name="springcad",
    help="Design compact compliant elements for robot joints, from a YAML spec to cut-ready files.",
    epilog=_EXIT_CODES,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)
for _command in (
    design,
    check,
    explain,
    verify,
    compensate,
    calibrate,
    preflight,
    init,
    schema,
    kinds,
    doctor,
):
    app.command()(_command)
app.add_typer(materials_app, name="materials")


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"springcad {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version."),
    ] = False,
) -> None:
    pass
