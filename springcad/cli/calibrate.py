"""``springcad calibrate``: what a bench test of a written design tells the next one."""

from __future__ import annotations

import json
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from springcad.cli.console import progress_shown, result_console, say
from springcad.cli.failures import failure_data, failure_text
from springcad.cli.options import Json


class Cause(StrEnum):
    """What a measured stiffness is put down to."""

    modulus = "modulus"
    root = "root"
    both = "both"


def calibrate(
    design: Annotated[
        Path, typer.Argument(metavar="DESIGN", help="report.json of a design, or its folder.")
    ],
    curve: Annotated[
        Path,
        typer.Argument(
            metavar="CURVE.csv",
            help="What was measured, in this order: columns angle [deg] and torque [N*m].",
        ),
    ],
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder for the file.")] = Path(),
    cause: Annotated[
        Cause, typer.Option("--fit", help="What the stiffness is put down to.")
    ] = Cause.modulus,
    as_json: Json = False,
) -> None:
    """Calibrate the next design by a bench test of a written one.

    Fits elastic modulus or root compliance, friction and offset, each with its standard error, as
    far as the test can tell. Writes NAME-calibration.yaml, which the key calibration of a spec
    takes.
    """
    from springcad.batch.calibrate_one import calibrate_one
    from springcad.errors import SpringcadError

    try:
        with progress_shown() as progress:
            done = calibrate_one(design, curve, out, cause.value, progress)
    except SpringcadError as error:
        say(failure_text(error, design))
        if as_json:
            entry = {"design": str(design), "curve": str(curve), "exit_code": error.exit_code}
            entry |= {"error": failure_data(error)}
            typer.echo(json.dumps(entry, indent=2, ensure_ascii=False))
        raise typer.Exit(error.exit_code) from error
    if done.changed:
        say(f"{design}: files changed since the design was written: {done.changed}")
    if as_json:
        from dataclasses import asdict

        entry = {"exit_code": 0, "file": str(done.file), **asdict(done.calibration)}
        typer.echo(json.dumps(entry, indent=2, ensure_ascii=False))
        return
    from springcad.report.terminal import print_calibration

    print_calibration(done.calibration, done.file, result_console())
