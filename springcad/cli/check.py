"""``springcad check``: can it work at all? Closed forms only, no optimisation, no files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typer

from springcad.cli.console import result_console, say
from springcad.cli.failures import Format, failure_text, worst
from springcad.cli.options import Overrides, ProblemFormat, Specs
from springcad.errors import InfeasibleError, SpringcadError

if TYPE_CHECKING:
    from springcad.batch.specs import Reading
    from springcad.result import Check


def check(specs: Specs, overrides: Overrides = None, form: ProblemFormat = Format.text) -> None:
    """Test quickly whether a design can exist.

    Reads the specs and checks them with closed forms; optimises nothing, writes nothing.
    """
    from springcad.batch.specs import read_specs

    readings = read_specs(specs, overrides or ())
    raise typer.Exit(worst([_check(reading, form) for reading in readings]))


def _check(reading: Reading, form: Format) -> int:
    """Exit code of one spec, after telling about it: 4 when a check fails, since none can exist."""
    try:
        checks = _feasibility(reading)
    except Exception as error:  # even a bug of ours must not stop the other specs
        say(failure_text(error, reading.path, form))
        return error.exit_code if isinstance(error, SpringcadError) else 1

    from springcad.report.terminal import print_checks

    print_checks(checks, str(reading.path), result_console())
    failed = [check for check in checks if check.status == "fail"]
    if form is Format.github:
        for item in failed:
            claim = InfeasibleError(item.name, item.value, item.limit, item.unit)
            say(failure_text(claim, reading.path, form))
    return InfeasibleError.exit_code if failed else 0


def _feasibility(reading: Reading) -> tuple[Check, ...]:
    spec = reading.outcome
    if isinstance(spec, Exception):
        raise spec

    from springcad.kinds import load_kind

    return load_kind(spec.kind).check_spec(spec)
