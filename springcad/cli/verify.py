"""``springcad verify``: the second opinion again, on designs that were written."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from springcad.cli.console import progress_shown, result_console, say
from springcad.cli.failures import failure_data, failure_text, worst
from springcad.cli.options import Json
from springcad.errors import SpringcadError

if TYPE_CHECKING:
    from springcad.result import Progress


def verify(
    designs: Annotated[
        list[Path],
        typer.Argument(metavar="DESIGN", help="report.json of a design, or its folder."),
    ],
    deck: Annotated[
        bool,
        typer.Option("--deck", help="Write the model beside the report, for CalculiX or Abaqus."),
    ] = False,
    as_json: Json = False,
) -> None:
    """Form the second opinion on a written design again.

    Judges what report and drawings say with a model that took no part in the design.
    """
    entries = []
    for path in designs:
        with progress_shown() as progress:
            entries.append(_verify(path, deck, as_json, progress))
    if as_json:
        typer.echo(json.dumps(entries, indent=2, ensure_ascii=False))
    raise typer.Exit(worst([entry["exit_code"] for entry in entries]))


def _verify(path: Path, deck: bool, as_json: bool, progress: Progress) -> dict[str, Any]:
    """What is known of one design, for programs; told to people on the way."""
    from springcad.batch.design_one import exit_code_of
    from springcad.batch.judge_one import judge_one
    from springcad.report.json_report import judgement_to_dict
    from springcad.report.terminal import print_judgement

    entry: dict[str, Any] = {"design": str(path)}
    try:
        judged = judge_one(path, write_decks=deck, progress=progress)
    except SpringcadError as error:
        say(failure_text(error, path))
        return entry | {"exit_code": error.exit_code, "error": failure_data(error)}
    if deck and not judged.decks:
        say(f"{judged.name}: no input deck is written; its second opinion cannot be told in one")
    if not as_json:
        print_judgement(
            judged.name, judged.judgement, judged.checks, judged.decks, result_console()
        )
    return entry | {
        "name": judged.name,
        "exit_code": exit_code_of(judged.checks, strict=False),
        "verification": judgement_to_dict(judged.judgement),
        "checks": [asdict(item) for item in judged.checks],
        "files": [str(file) for file in judged.decks],
    }
