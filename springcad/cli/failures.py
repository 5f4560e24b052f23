"""Errors as people, CI systems and programs read them: the only place where they become text."""

from __future__ import annotations

import tempfile
import traceback
from dataclasses import asdict
from enum import StrEnum
from pathlib import Path
from typing import Any

from springcad.errors import InfeasibleError, SpecError, SpringcadError


class Format(StrEnum):
    """How problems are shown: lines for people, or annotations for a GitHub workflow."""

    text = "text"
    github = "github"


def worst(exit_codes: list[int]) -> int:
    """The exit code of several specs: 1 (a bug) if there is one, else the highest."""
    return 1 if 1 in exit_codes else max(exit_codes, default=0)


def failure_text(error: Exception, path: Path, form: Format = Format.text) -> str:
    """What to tell about ``error``, which the spec (or drawing) ``path`` ran into."""
    if isinstance(error, SpecError):
        if form is Format.text:
            return str(error)
        return "\n".join(
            _annotation(f"{p.key}: {p.message}" if p.key else p.message, p.file, p.line, p.column)
            for p in error.problems
        )
    text = _reason(error)
    return _annotation(text, str(path)) if form is Format.github else f"{path}: {text}"


def failure_data(error: Exception) -> dict[str, Any]:
    """The same for programs; values in SI."""
    if isinstance(error, SpecError):
        return {"problems": [asdict(problem) for problem in error.problems]}
    if isinstance(error, InfeasibleError):
        return {
            "claim": error.claim,
            "value": error.value,
            "limit": error.limit,
            "unit": error.unit,
            "remedies": list(error.remedies),
        }
    return {"message": str(error) if isinstance(error, SpringcadError) else repr(error)}


def _reason(error: Exception) -> str:
    if isinstance(error, InfeasibleError):
        from springcad.report.display import format_apart

        value, limit = format_apart(error.value, error.limit, error.unit)
        lines = [f"no feasible design: {error.claim}: {value}, limit {limit}"]
        return "\n".join(lines + [f"  to make it feasible: {remedy}" for remedy in error.remedies])
    return str(error) if isinstance(error, SpringcadError) else bug_text(error)


def bug_text(error: Exception) -> str:
    """One line for an error that nobody foresaw; its traceback goes to a log file."""
    where = _log("".join(traceback.format_exception(error)))
    message = " ".join(str(error).split())
    return f"internal error (a bug): {type(error).__name__}: {message}; details in {where}"


def _log(text: str) -> str:
    """Name of a new file with ``text`` in the folder for temporary files."""
    try:
        with tempfile.NamedTemporaryFile(
            "w", prefix="springcad-", suffix=".log", delete=False, encoding="utf-8"
        ) as log:
            log.write(text)
    except OSError as error:
        return f"no file (the log could not be written: {error.strerror})"
    return log.name


def _annotation(message: str, file: str, line: int = 1, column: int = 1) -> str:
    """A GitHub workflow command; the characters that it uses itself are escaped."""
    text = message.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")
    name = file.replace("%", "%25").replace(":", "%3A").replace(",", "%2C")
    return f"::error file={name},line={line},col={column}::{text}"
