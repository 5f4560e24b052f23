"""Standard output and standard error, made so that nothing about them stops a run half way."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from io import BufferedWriter, BytesIO, FileIO, TextIOWrapper
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer


class _UntilUnread(FileIO):
    """What is written once the reader has left, as ``head`` does, goes nowhere.

    That reader has seen enough and nothing is lost: the command goes on, writes its files and
    returns the code that it would have returned.
    """

    def write(self, data: ReadableBuffer, /) -> int:
        try:
            return super().write(data)
        except BrokenPipeError:
            _lead_nowhere(self.fileno())
            return super().write(data)


def make_streams_safe() -> None:
    """A character that a terminal lacks, a reader that leaves, a closed stream: none stops us."""
    sys.stdout = _safe(sys.stdout)
    sys.stderr = _safe(sys.stderr)


def give_up_stdout() -> None:
    """Send what is still in the buffer nowhere, so that leaving Python does not fail on it."""
    with suppress(OSError, ValueError):
        _lead_nowhere(sys.stdout.fileno())


def _safe(stream: TextIO | None) -> TextIO:
    if stream is None:
        return open(os.devnull, "w")
    if not isinstance(stream, TextIOWrapper) or isinstance(stream.buffer, BytesIO):
        return stream
    stream.flush()
    raw = _UntilUnread(stream.fileno(), "w", closefd=False)
    return TextIOWrapper(
        raw if stream.write_through else BufferedWriter(raw),
        encoding=stream.encoding,
        errors="replace",
        line_buffering=stream.line_buffering,
        write_through=stream.write_through,
    )


def _lead_nowhere(descriptor: int) -> None:
    devnull = os.open(os.devnull, os.O_WRONLY)
    os.dup2(devnull, descriptor)
    os.close(devnull)
