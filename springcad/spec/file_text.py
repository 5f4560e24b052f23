"""The text of a file that a user names, or what is wrong with the file."""

from __future__ import annotations

import codecs
import stat
from pathlib import Path

from springcad.errors import Problem, SpecError

MAX_BYTES = 256 * 1024  # ruamel.yaml takes up to a second for a MiB; a spec has a few KiB


def read_text(path: Path, shown: str) -> str:
    """What stands in the file; ``shown`` is its name in messages.

    Raises SpecError with the one problem that keeps it from being read.
    """
    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            raise _unreadable(shown, "is a folder, not a file")
        if not stat.S_ISREG(mode):
            raise _unreadable(shown, "is not a regular file")
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        reason = getattr(error, "strerror", None) or str(error)
        raise _unreadable(shown, f"cannot be read: {reason}") from error
    if len(data) > MAX_BYTES:
        raise _unreadable(shown, f"larger than {MAX_BYTES >> 10} KiB")
    if b"\0" in data:
        raise _unreadable(shown, "is not a text file (it holds null bytes)")
    data = data.removeprefix(codecs.BOM_UTF8)
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        before = data[: error.start].decode("utf-8")
        line = before.count("\n") + 1
        column = len(before) - (before.rfind("\n") + 1) + 1
        byte = f"the byte 0x{data[error.start]:02X}"
        message = f"is not UTF-8 text: {byte} is no part of a character"
        raise _unreadable(shown, message, line, column) from error


def _unreadable(shown: str, message: str, line: int = 1, column: int = 1) -> SpecError:
    return SpecError([Problem(shown, line, column, message)])
