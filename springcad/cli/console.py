"""Where the commands write: the result to stdout, progress and talk to stderr."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from rich.console import Console

    from springcad.result import Progress

_WIDTH_OF_A_FILE = 100


def result_console() -> Console:
    """A rich console on stdout: no markup in texts, no colour and a fixed width in files."""
    from rich.console import Console

    is_fixed = not sys.stdout.isatty() and "COLUMNS" not in os.environ
    width = _WIDTH_OF_A_FILE if is_fixed else None
    return Console(file=sys.stdout, markup=False, emoji=False, highlight=False, width=width)


def say(text: str) -> None:
    """Write plain text to stderr."""
    typer.echo(plain(text), err=True)


def plain(text: str) -> str:
    """``text`` (lines of it) without what could steer a terminal."""
    return "".join(c if c.isprintable() or c == "\n" else "\N{REPLACEMENT CHARACTER}" for c in text)


@contextmanager
def progress_shown() -> Iterator[Progress]:
    """A callback for progress: a spinner with the message on a terminal, nothing elsewhere."""
    from rich.console import Console
    from rich.text import Text

    console = Console(stderr=True)
    if not console.is_terminal or console.is_dumb_terminal:
        yield lambda _: None
        return
    with console.status("") as status:
        yield lambda message: status.update(Text(message))
