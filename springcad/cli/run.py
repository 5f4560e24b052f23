"""One run of the application: whatever happens becomes an exit code and plain words."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from io import TextIOWrapper

import typer
import typer.main

from springcad.cli.app import app
from springcad.cli.console import say
from springcad.cli.failures import bug_text
from springcad.errors import OutputError, SpringcadError

INTERRUPTED = 130
_STREAM_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EBADF, errno.EFBIG)


def run(arguments: Sequence[str]) -> int:
    """Run the command line ``arguments``; the exit code. Never raises, never shows a traceback."""
    _make_streams_safe()
    try:
        exit_code = _invoke(arguments)
        sys.stdout.flush()
    except BrokenPipeError:  # the reader, as `head`, has seen enough
        exit_code = OutputError.exit_code
        _give_up_stdout()
    except SpringcadError as error:
        exit_code = error.exit_code
        say(f"error: {error}")
    except KeyboardInterrupt:
        exit_code = INTERRUPTED
        say("interrupted")
    except Exception as error:
        exit_code = _unforeseen(error)
    return exit_code


def _make_streams_safe() -> None:
    """A character that a terminal lacks, or a stream that was closed before, stops nothing."""
    sys.stdout = sys.stdout or open(os.devnull, "w")  # noqa: SIM115 (lives as long as we do)
    sys.stderr = sys.stderr or open(os.devnull, "w")  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")


def _invoke(arguments: Sequence[str]) -> int:
    command = typer.main.get_command(app)
    try:
        with command.make_context("springcad", list(arguments)) as context:
            command.invoke(context)
    except typer.Exit as end:
        return end.exit_code
    except typer.TyperException as error:
        where = getattr(error, "ctx", None)
        say(f"error: {error.format_message()}")
        say(f"try '{where.command_path if where else 'springcad'} --help'")
        return error.exit_code
    return 0


def _unforeseen(error: Exception) -> int:
    """Exit code of an error that is our fault, or that of the place where stdout goes."""
    # Whatever else we write is a file, and its errors are known by then as OutputError.
    if isinstance(error, OSError) and error.filename is None and error.errno in _STREAM_ERRORS:
        _give_up_stdout()
        say(f"error: cannot write to standard output: {error.strerror}")
        return OutputError.exit_code
    say(bug_text(error))
    return 1


def _give_up_stdout() -> None:
    """Send what is still in the buffer nowhere, so that leaving Python does not fail on it."""
    with suppress(OSError, ValueError):
        devnull = os.open(os.devnull, os.O_WRONLY)
        os.dup2(devnull, sys.stdout.fileno())
        os.close(devnull)
