"""``springcad design``: the main job, for one spec or many."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from springcad.cli.console import plain, progress_shown, result_console, say
from springcad.cli.failures import Format, failure_data, failure_text, worst
from springcad.cli.options import Json, Overrides, ProblemFormat, Specs

if TYPE_CHECKING:
    from springcad.batch.design_one import Attempt


def design(
    specs: Specs,
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Folder for the results; each design gets its own.")
    ] = Path("out"),
    overrides: Overrides = None,
    as_json: Json = False,
    strict: Annotated[bool, typer.Option("--strict", help="Warnings count as failures.")] = False,
    no_verify: Annotated[
        bool, typer.Option("--no-verify", help="Leave out the second opinion; faster.")
    ] = False,
    form: ProblemFormat = Format.text,
) -> None:
    """Design what the specs ask for.

    Writes drawings, report and manifest into OUT/NAME, reads every drawing back, and has the
    design judged by a model that took no part in it.
    """
    from springcad.batch.design_one import Wishes, attempt_design
    from springcad.batch.specs import read_specs

    wishes = Wishes(out, strict=strict, judged=not no_verify)
    attempts: list[Attempt] = []
    for reading in read_specs(specs, overrides or ()):
        with progress_shown() as progress:
            attempt = attempt_design(reading, wishes, progress)
        if attempt.error is not None:
            say(failure_text(attempt.error, attempt.path, form))
        elif not as_json:
            _print_result(attempt)
        attempts.append(attempt)
    is_single = len(specs) == 1 and not specs[0].is_dir()
    if as_json:
        typer.echo(_as_json(attempts, is_single), nl=False)
    elif not is_single:
        _print_summary(attempts)
    raise typer.Exit(worst([attempt.exit_code for attempt in attempts]))


def _print_result(attempt: Attempt) -> None:
    from springcad.report.terminal import print_result

    if attempt.result is not None:
        print_result(attempt.result, attempt.files, result_console())


def _print_summary(attempts: Sequence[Attempt]) -> None:
    """One line a spec: what became of it and where it is."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    for heading in ("spec", "name", "verdict", "exit code", "folder"):
        table.add_column(heading, overflow="fold")
    for attempt in attempts:
        folder = str(attempt.files[0].parent) if attempt.files else "-"
        row = (str(attempt.path), attempt.name, _verdict(attempt), str(attempt.exit_code), folder)
        table.add_row(*(Text(plain(cell)) for cell in row))
    console = result_console()
    console.print()
    console.print(table)


def _verdict(attempt: Attempt) -> str:
    if attempt.result is None:
        return _WITHOUT_RESULT[attempt.exit_code]
    from springcad.report.verdict import verdict

    return verdict(attempt.result.checks).text


_WITHOUT_RESULT = {
    1: "internal error",
    3: "spec invalid",
    4: "no feasible design",
    6: "could not be written",
}


def _as_json(attempts: Sequence[Attempt], is_single: bool) -> str:
    """The report of a single spec as it is in its file; of several a list with a report each."""
    if is_single and attempts[0].report:
        return attempts[0].report
    entries = [_entry(attempt) for attempt in attempts]
    return json.dumps(entries[0] if is_single else entries, indent=2, ensure_ascii=False) + "\n"


def _entry(attempt: Attempt) -> dict[str, Any]:
    entry = {
        "spec": str(attempt.path),
        "name": attempt.name,
        "exit_code": attempt.exit_code,
        "files": [str(path) for path in attempt.files],
    }
    if attempt.error is not None:
        return entry | {"error": failure_data(attempt.error)}
    return entry | {"report": json.loads(attempt.report)}
