"""The verdict over all checks, in one sentence: the first thing that anybody reads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from springcad.result import Check, Status


@dataclass(frozen=True)
class Verdict:
    """``status`` is the worst status of all checks, ``text`` says it in plain words.

    ``open`` holds the checks that do not pass, failures first, each with its remedy.
    """

    status: Status
    text: str
    open: tuple[Check, ...]


def verdict(checks: Sequence[Check]) -> Verdict:
    """Judge ``checks`` together; without any check nothing is known, which is a warning."""
    failed = tuple(check for check in checks if check.status == "fail")
    warned = tuple(check for check in checks if check.status == "warn")
    total = len(checks)
    if not checks:
        return Verdict("warn", "Nothing was checked", ())
    if failed:
        text = f"{_count(len(failed), total)} {'fails' if len(failed) == 1 else 'fail'}"
        text += f", {len(warned)} more {'warns' if len(warned) == 1 else 'warn'}" if warned else ""
        return Verdict("fail", text, failed + warned)
    if warned:
        text = f"No check fails, {len(warned)} of {total} {'warns' if len(warned) == 1 else 'warn'}"
        return Verdict("warn", text, warned)
    text = f"All {total} checks pass" if total > 1 else "The only check passes"
    return Verdict("pass", text, ())


def _count(part: int, total: int) -> str:
    return f"{part} of {total} checks" if total > 1 else "The only check"
