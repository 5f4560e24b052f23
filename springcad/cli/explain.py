"""``springcad explain``: the calculation sheet, every step with its equation and its numbers."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from springcad.cli.console import progress_shown, result_console, say
from springcad.cli.failures import Format, failure_data, failure_text, worst
from springcad.cli.options import Json, Overrides, ProblemFormat, Specs
from springcad.errors import SpringcadError

if TYPE_CHECKING:
    from springcad.batch.specs import Reading
    from springcad.sheet import Sheet

_NARROWEST = 60
"""Columns below which a terminal may break the lines itself."""


def explain(
    specs: Specs,
    overrides: Overrides = None,
    as_json: Json = False,
    form: ProblemFormat = Format.text,
) -> None:
    """Print the calculation sheet of a design.

    Designs what the specs ask for and shows every step with its equation, source, numbers and
    units. Writes no files, and forms no second opinion.
    """
    from springcad.batch.specs import read_specs

    accounts: list[_Account] = []
    for reading in read_specs(specs, overrides or ()):
        account = _explained(reading)
        if account.sheet is not None and not as_json:
            _print(account.sheet, is_first=not any(earlier.sheet for earlier in accounts))
        if account.error is not None:
            say(failure_text(account.error, account.path, form))
        accounts.append(account)
    if as_json:
        is_single = len(specs) == 1 and not specs[0].is_dir()
        typer.echo(_as_json(accounts, is_single))
    raise typer.Exit(worst([account.exit_code for account in accounts]))


@dataclass(frozen=True)
class _Account:
    """A spec, its sheet, and what went wrong; of a refused design both."""

    path: Path
    sheet: Sheet | None = None
    error: Exception | None = None

    @property
    def exit_code(self) -> int:
        """As that of ``springcad design`` for what is known here: 5 when a check fails."""
        if self.error is not None:
            return self.error.exit_code if isinstance(self.error, SpringcadError) else 1
        checks = self.sheet.checks if self.sheet else ()
        return 5 if any(check.status == "fail" for check in checks) else 0


def _explained(reading: Reading) -> _Account:
    """Whatever goes wrong is part of the answer: even a bug of ours must not stop other specs."""
    spec = reading.outcome
    if isinstance(spec, Exception):
        return _Account(reading.path, error=spec)
    try:
        from springcad.kinds import load_kind

        with progress_shown() as progress:
            sheet = load_kind(spec.kind).explain_spec(spec, progress)
    except Exception as error:
        return _Account(reading.path, error=error)
    return _Account(reading.path, sheet, sheet.refusal)


def _print(sheet: Sheet, *, is_first: bool) -> None:
    from springcad.report.sheet_text import sheet_text

    if not is_first:
        typer.echo()
    typer.echo(sheet_text(sheet, max(result_console().width, _NARROWEST)), nl=False)


def _as_json(accounts: Sequence[_Account], is_single: bool) -> str:
    """A sheet for each spec, of a single one itself; beside it what went wrong."""
    entries = [_entry(account) for account in accounts]
    document = entries[0] if is_single else entries
    return json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)


def _entry(account: _Account) -> dict[str, Any]:
    entry: dict[str, Any] = {"spec": str(account.path), "exit_code": account.exit_code}
    if account.sheet is not None:
        from springcad.report.sheet_json import sheet_to_dict

        entry |= sheet_to_dict(account.sheet)
    if account.error is not None:
        entry["error"] = failure_data(account.error)
    return entry
