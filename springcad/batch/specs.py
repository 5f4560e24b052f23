"""From the arguments of a command to specs: files and folders, all read before anything is made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from springcad.errors import Problem, SpecError
from springcad.spec.source import Spec, read_spec


@dataclass(frozen=True)
class Reading:
    """A spec file and what reading it gave: the spec, or why there is none."""

    path: Path
    outcome: Spec | Exception


def read_specs(arguments: Sequence[Path], overrides: Sequence[str]) -> tuple[Reading, ...]:
    """Read every spec that ``arguments`` (files and folders) name; bad ones keep their error.

    A folder stands for its ``*.yaml`` and ``*.yml`` files in order of name, without hidden files
    and without folders inside. A file that is named twice is read once. A spec whose name, but for
    the case of letters, an earlier one has already is refused: the two would share a folder.
    """
    readings: list[Reading] = []
    seen: set[Path] = set()
    owners: dict[str, Path] = {}
    for argument in arguments:
        for path in _files(argument):
            if path.resolve() in seen:
                continue
            seen.add(path.resolve())
            readings.append(Reading(path, _read(path, overrides, owners)))
    return tuple(readings)


def _files(argument: Path) -> tuple[Path, ...]:
    """The files of a folder that are specs; a folder without any stands for itself."""
    if not argument.is_dir():
        return (argument,)
    files = (path for path in argument.iterdir() if path.suffix in (".yaml", ".yml"))
    return tuple(sorted(p for p in files if p.is_file() and p.name[0] != ".")) or (argument,)


def _read(path: Path, overrides: Sequence[str], owners: dict[str, Path]) -> Spec | Exception:
    if path.is_dir():
        return SpecError([Problem(str(path), 1, 1, "no *.yaml or *.yml file in this folder")])
    try:
        spec = read_spec(path, overrides)
    except Exception as error:  # even a bug of ours must not stop the other specs
        return error
    owner = owners.setdefault(spec.name.casefold(), path)
    if owner is path:
        return spec
    message = f"{spec.name} is taken by {owner}; names must differ in more than the case"
    return SpecError([spec.problem(("name",), message)])
