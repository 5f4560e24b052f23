"""One run of the application: whatever happens becomes an exit code and plain words."""

from __future__ import annotations

import errno
import sys
from collections.abc import Sequence

import typer
import typer.main

from springcad.cli.app import app
from springcad.cli.console import say
from springcad.cli.failures import bug_text
from springcad.cli.streams import give_up_stdout, make_streams_safe
from springcad.errors import OutputError, SpringcadError

INTERRUPTED = 130
_STREAM_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EBADF, errno.EFBIG)


def run(arguments: Sequence[str]) -> int:
    """Run the command line ``arguments``; the exit code. Never raises, never shows a traceback."""
    make_streams_safe()
    try:
        exit_code = _invoke(arguments)
        sys.stdout.flush()
    except SpringcadError as error:
        exit_code = error.exit_code
        say(f"error: {error}")
    except KeyboardInterrupt:
        exit_code = INTERRUPTED
        say("interrupted")
    except Exception as error:
        exit_code = _unforeseen(error)
    return exit_code


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
        give_up_stdout()
        say(f"error: cannot write to standard output: {error.strerror}")
        return OutputError.exit_code
    say(bug_text(error))
    return 1
