"""``springcad compensate``: the next design, after the user's own simulation or test of one."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from springcad.cli.console import progress_shown, result_console, say
from springcad.cli.failures import failure_data, failure_text
from springcad.cli.options import Json


def compensate(
    design: Annotated[
        Path, typer.Argument(metavar="DESIGN", help="report.json of a design, or its folder.")
    ],
    curve: Annotated[
        Path,
        typer.Argument(
            metavar="CURVE.csv", help="What it does: columns angle [deg] and torque [N*m]."
        ),
    ],
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Folder for the result, which gets its own.")
    ] = Path("out"),
    as_json: Json = False,
    strict: Annotated[bool, typer.Option("--strict", help="Warnings count as failures.")] = False,
    no_verify: Annotated[
        bool, typer.Option("--no-verify", help="Leave out the second opinion; faster.")
    ] = False,
) -> None:
    """Correct a written design by a torque curve of it.

    The curve is from your own simulation or test, its torque of what target.per in the spec says.
    Writes the next design, NAME-c1 after NAME and NAME-c2 after NAME-c1, into OUT.
    """
    from springcad.batch.compensate_one import attempt_compensation
    from springcad.batch.design_one import Wishes

    with progress_shown() as progress:
        attempt = attempt_compensation(
            design, curve, Wishes(out, strict=strict, judged=not no_verify), progress
        )
    if attempt.error is not None:
        say(failure_text(attempt.error, design))
        if as_json:
            entry = {"design": str(design), "curve": str(curve), "exit_code": attempt.exit_code}
            entry |= {"error": failure_data(attempt.error)}
            typer.echo(json.dumps(entry, indent=2, ensure_ascii=False))
    elif as_json:
        typer.echo(attempt.report, nl=False)
    elif attempt.result is not None:
        from springcad.report.terminal import print_result

        print_result(attempt.result, attempt.files, result_console())
    raise typer.Exit(attempt.exit_code)
