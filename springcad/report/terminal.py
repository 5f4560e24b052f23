"""A result in the terminal: verdict first, then numbers, checks, what was assumed, the files.

Text from specs and file names is never read as markup, and nothing that a decision hangs on is
cut off: numbers keep their columns, names and remedies wrap.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from springcad.kinds.calibrating import Calibration
from springcad.report.display import (
    format_check,
    format_deviation,
    format_difference,
    format_value,
    printable,
)
from springcad.report.verdict import verdict
from springcad.result import Check, Judgement, Outcome, Part, Result, Status

_STYLES: dict[Status, str] = {"pass": "green", "warn": "yellow", "fail": "bold red"}
_WORDS: dict[Status, str] = {"pass": "pass", "warn": "WARN", "fail": "FAIL"}


def print_result(result: Result, files: Sequence[Path], console: Console) -> None:
    """Print the whole result; ``files`` are the paths that were written."""
    judged = verdict(result.checks)
    _print(console, f"{result.name} ({result.kind}): {judged.text}", _STYLES[judged.status])
    for part in result.parts:
        _print(console, _part_line(part))
    if result.outcomes:
        _print_outcomes(result.outcomes, console)
    if result.judgement:
        _print_comparisons(result.judgement, console)
    print_checks(result.checks, "Checks", console)
    _print_list("Assumed and not checked", result.assumptions, console)
    _print_list("Advice", result.advice, console)
    _print_files(files, console)


def print_judgement(
    name: str,
    judgement: Judgement,
    checks: Sequence[Check],
    files: Sequence[Path],
    console: Console,
) -> None:
    """Print a second opinion on the design ``name``; ``files`` are the paths that were written."""
    judged = verdict(checks)
    _print(console, f"{name}: {judged.text}", _STYLES[judged.status])
    _print_comparisons(judgement, console)
    print_checks(checks, "Checks", console)
    _print_list("Assumed", judgement.assumptions, console)
    _print_files(files, console)


def print_calibration(found: Calibration, file: Path, console: Console) -> None:
    """Print what a bench test has told; ``file`` is the calibration file that was written."""
    head = (
        f"{found.design} ({found.kind}): calibrated by {found.used} of {found.points} points; "
        f"{found.scatter:.2%} of the torque is left, {found.designed_scatter:.2%} with the numbers "
        "of the design"
    )
    _print(console, head, "bold")
    table = _table(console, "Fitted")
    table.add_column("number", overflow="fold")
    for heading in ("value", "design", "standard error", "model error"):
        table.add_column(heading, no_wrap=True)
    for entry in found.estimates:
        if not entry.held:
            numbers = (entry.value, entry.designed, entry.standard_error, entry.model_error)
            cells = (entry.name, *(format_value(number, entry.unit) for number in numbers))
            table.add_row(*(_text(console, cell) for cell in cells))
    console.print(table)
    held = [
        f"{entry.name}, held at {format_value(entry.value, entry.unit)}: {entry.held}"
        for entry in found.estimates
        if entry.held
    ]
    _print_list("Not fitted", held, console)
    doubtful = [f"{entry.name} {entry.doubt}" for entry in found.estimates if entry.doubt]
    _print_list("Doubtful", doubtful, console)
    _print_list("To know", found.notes, console)
    _print_files([file], console)


def print_checks(checks: Sequence[Check], title: str, console: Console) -> None:
    """Print a table of ``checks`` under ``title``, then what to change for those that do not pass.

    Sources are left to the files, so that a check stays on one line.
    """
    if not checks:
        return
    table = _table(console, title)
    table.add_column("check", overflow="fold")
    for heading in ("value", "limit", ""):
        table.add_column(heading, no_wrap=True)
    for check in checks:
        value, limit = format_check(check)
        table.add_row(
            _text(console, check.name),
            _text(console, value),
            _text(console, f"{check.sense} {limit}"),
            Text(_WORDS[check.status], _STYLES[check.status]),
        )
    console.print(table)
    _print_list("What to change", [_remedy(c) for c in verdict(checks).open if c.remedy], console)


def _print_outcomes(outcomes: Sequence[Outcome], console: Console) -> None:
    table = _table(console, "Results")
    table.add_column("result", overflow="fold")
    for heading in ("value", "target", "deviation"):
        table.add_column(heading, no_wrap=True)
    for outcome in outcomes:
        target = "" if outcome.target is None else format_value(outcome.target, outcome.unit)
        table.add_row(
            _text(console, f"{outcome.label} ({outcome.note})" if outcome.note else outcome.label),
            _text(console, format_value(outcome.value, outcome.unit)),
            _text(console, target),
            format_deviation(outcome),
        )
    console.print(table)


def _print_comparisons(judgement: Judgement, console: Console) -> None:
    """Each comparison at the place where it is worst; what is allowed stands with the checks."""
    table = _table(console, f"Second opinion: {judgement.method}")
    table.add_column("quantity", overflow="fold")
    for heading in ("design", "judge", "difference"):
        table.add_column(heading, no_wrap=True)
    for entry in judgement.comparisons:
        worst = entry.worst
        place = format_value(float(entry.places[worst]), entry.place_unit)
        table.add_row(
            _text(console, f"{entry.name} (worst at {place})"),
            _text(console, format_value(float(entry.designed[worst]), entry.unit)),
            _text(console, format_value(float(entry.judged[worst]), entry.unit)),
            _text(console, format_difference(float(entry.differences[worst]), entry)),
        )
    console.print(table)


def _print_list(title: str, lines: Iterable[str], console: Console) -> None:
    grid = Table.grid(padding=(0, 1))
    grid.add_column(no_wrap=True)
    grid.add_column(overflow="fold")
    for line in lines:
        grid.add_row("-", _text(console, line))
    if grid.row_count:
        _print(console, f"\n{title}", "bold")
        console.print(grid)


def _print_files(files: Sequence[Path], console: Console) -> None:
    """Paths are never wrapped: they are there to be copied."""
    if not files:
        return
    folders = {path.parent for path in files}
    shared = len(folders) == 1
    _print(console, f"\nFiles in {files[0].parent}" if shared else "\nFiles", "bold", wrap=False)
    for path in files:
        _print(console, f"  {path.name if shared else path}", wrap=False)


def _part_line(part: Part) -> str:
    return f"  {part.caption}: {part.material}, {format_value(part.thickness, 'm')} thick"


def _remedy(check: Check) -> str:
    return f"{check.name}: {check.remedy}"


def _table(console: Console, title: str) -> Table:
    _print(console, f"\n{title}", "bold")
    return Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, header_style="dim")


def _print(console: Console, text: str, style: str = "", *, wrap: bool = True) -> None:
    console.print(_text(console, text, style), soft_wrap=not wrap)


def _text(console: Console, text: str, style: str = "") -> Text:
    """Plain text that the console's encoding can hold; a character that it cannot becomes ``?``."""
    encoding = console.encoding
    return Text(printable(text).encode(encoding, "replace").decode(encoding), style)
