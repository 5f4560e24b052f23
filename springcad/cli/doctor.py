"""``springcad doctor``: is everything that springcad needs installed, and does it load?"""

from __future__ import annotations

import importlib
import re
import sys

import typer

from springcad import __version__

_MODULE = {"ruamel-yaml": "ruamel.yaml"}
"""Library → the module to import, where the two names differ."""


def doctor() -> None:
    """Show what is installed and whether it works."""
    import platform

    typer.echo(f"springcad     {__version__}")
    typer.echo(f"Python        {platform.python_version()} ({sys.executable})")
    typer.echo(f"system        {platform.platform()}")
    broken = 0
    for name in _requirements():
        state, works = _state(name)
        broken += not works
        typer.echo(f"{name:13} {state}")
    if broken:
        typer.echo(f"{broken} of the libraries above do not work; install springcad again")
    raise typer.Exit(1 if broken else 0)


def _requirements() -> list[str]:
    """Names of the libraries that springcad needs at run time."""
    from importlib.metadata import requires

    needed = (text for text in requires("springcad") or () if "extra ==" not in text)
    return sorted(re.split(r"[^A-Za-z0-9._-]", text)[0] for text in needed)


def _state(name: str) -> tuple[str, bool]:
    """Version of a library, or what is wrong with it."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        installed = version(name)
        importlib.import_module(_MODULE.get(name, name))
    except PackageNotFoundError:
        return "is not installed", False
    except Exception as error:
        return f"{installed} does not load: {type(error).__name__}: {error}", False
    return installed, True
