"""``springcad preflight``: re-read any drawing as a cutting shop would."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from springcad.cli.console import result_console, say
from springcad.cli.failures import failure_data, failure_text, worst
from springcad.cli.options import Json
from springcad.errors import SpringcadError

if TYPE_CHECKING:
    from springcad.materials.process import Process


def preflight(
    drawings: Annotated[list[Path], typer.Argument(metavar="FILE.dxf", help="Drawings.")],
    process_name: Annotated[
        str | None,
        typer.Option("--process", metavar="P", help="Hold the drawing to the rules of a process."),
    ] = None,
    as_json: Json = False,
) -> None:
    """Re-read drawings as a cutting shop would.

    Tests that contours are closed and simple, the units, the smallest web, gap and inside radius.
    """
    rules = _process(process_name)
    entries = [_preflight(path, rules, as_json) for path in drawings]
    if as_json:
        typer.echo(json.dumps(entries, indent=2, ensure_ascii=False))
    raise typer.Exit(worst([entry["exit_code"] for entry in entries]))


def _process(name: str | None) -> Process | None:
    from springcad.materials.process import PROCESSES, process
    from springcad.spec.text import unknown

    if name is None:
        return None
    if name not in PROCESSES:
        raise typer.BadParameter(unknown("process", name, PROCESSES))
    return process(name)


def _preflight(path: Path, rules: Process | None, as_json: bool) -> dict[str, Any]:
    """What is known of one drawing, for programs; told to people on the way."""
    from springcad.batch.design_one import exit_code_of
    from springcad.report.terminal import print_checks
    from springcad.verify import preflight as verify

    entry: dict[str, Any] = {"file": str(path)}
    try:
        checks = verify.preflight(path, rules)
    except SpringcadError as error:
        say(failure_text(error, path))
        return entry | {"exit_code": error.exit_code, "error": failure_data(error)}
    if not as_json:
        print_checks(checks, str(path), result_console())
    entry["checks"] = [asdict(item) for item in checks]
    return entry | {"exit_code": exit_code_of(checks, strict=False)}
