"""Renew what the documentation takes from the program itself.

    python docs/generate.py            rewrite the pages that are out of date
    python docs/generate.py --fast     the same without the designs, which take some seconds each

Three things are renewed, and a test holds each of them:

* text between ``<!-- generated: NAME -->`` and ``<!-- end -->``: reference made from the code;
* what a command prints in a fence that begins with ```` ```console ````: lines with ``$ `` (and
  ``> ``, where a command goes on) are run in order, in one new folder a page, with ``specs/`` in
  it; of a fence that begins with ```` ```console head=N ```` only the first N lines are shown;
* ``docs/img/S2.svg``, the drawing that ``springcad design specs/S2.yaml`` writes.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, Literal, get_args, get_origin

from pydantic.fields import FieldInfo

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs/img/S2.svg"
ELISION = "..."
ARITHMETIC = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_CORETYPE": "Haswell",
    "OPENBLAS_NUM_THREADS": "1",
}
"""One set of linear algebra kernels, for every x86-64 processor with AVX2: others round
differently, and a search between equally good shapes may then end at the other one."""

_GENERATED = re.compile(r"(<!-- generated: ([a-z0-9-]+) -->\n).*?(<!-- end -->)", re.DOTALL)
_CONSOLE = re.compile(r"(```console(?: head=(\d+))?\n)(.*?)(```\n)", re.DOTALL)


def pages() -> list[Path]:
    """Every page of the documentation."""
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


# Reference made from the code


def with_reference(text: str) -> str:
    """``text`` with every generated passage renewed; KeyError for an unknown name."""
    return _GENERATED.sub(lambda match: f"{match[1]}\n{PASSAGES[match[2]]()}\n{match[3]}", text)


def command_help() -> str:
    """What ``--help`` says, for the program and each command."""
    from typer.main import get_command
    from typer.testing import CliRunner

    from springcad.cli.app import app

    passages = []
    for path in _paths(get_command(app)):
        command = " ".join(["springcad", *path])
        run = CliRunner().invoke(app, [*path, "--help"], prog_name="springcad", terminal_width=88)
        passages.append(f"## {command}\n\n```text\n{run.stdout.strip()}\n```\n")
    return "\n".join(passages)


def _paths(command: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """The words that lead to a command and to each of its own commands."""
    yield path
    for name, inner in getattr(command, "commands", {}).items():
        yield from _paths(inner, (*path, name))


def spec_keys(kind: str) -> str:
    """Every key of a spec of a kind: what it may be, its default, what it means."""
    from springcad.kinds import load_kind

    fields = load_kind(kind).SPEC_MODEL.model_fields
    rows = ["| key | value | default | meaning |", "|---|---|---|---|"]
    rows += ["| " + " | ".join(row) + " |" for row in _spec_rows(fields, "")]
    return "\n".join(rows) + "\n"


def _spec_rows(fields: dict[str, FieldInfo], prefix: str) -> Iterator[tuple[str, ...]]:
    from springcad.spec.rules import section_of

    for name, field in fields.items():
        section = section_of(field)
        meaning = field.description or ""
        yield f"`{prefix}{name}`", _allowed(field), _default(field), meaning
        if section is not None:
            yield from _spec_rows(section.model_fields, f"{prefix}{name}.")


def _allowed(field: FieldInfo) -> str:
    from springcad.spec.common import NAME_PATTERN, Count, OneOf, Quantity
    from springcad.spec.lists import Bounds, Coefficients, Range
    from springcad.spec.pairs import Pairs
    from springcad.spec.points import CurvePoints
    from springcad.spec.rules import section_of

    for note in (field.annotation, *field.metadata, *_notes(field.annotation)):
        if isinstance(note, Quantity):
            return f"{_words(note.words)}{note.dimension.name}, {note.low} to {note.high}"
        if isinstance(note, Count):
            return f"{_words(note.words)}whole number, from {note.low} to {note.high}"
        if isinstance(note, Range):
            return (
                f"{_words(note.quantity.words)}{note.quantity.dimension.name}: `[least, greatest]`"
            )
        if isinstance(note, OneOf):
            return f"name of a {note.what}"
        if isinstance(note, Bounds):
            return f"{note.quantity.dimension.name}, or two: `[low, high]`"
        if isinstance(note, Coefficients):
            return "list of coefficients"
        if isinstance(note, Pairs):
            return f"list of pairs {note.words}"
        if isinstance(note, CurvePoints):
            return "CSV file, or list of pairs"
    if section_of(field):
        return "section"
    if get_origin(field.annotation) is Literal:
        return ", ".join(f"`{choice}`" for choice in get_args(field.annotation))
    if field.annotation is str:
        return f"text, `{NAME_PATTERN}`"
    return _number(field)


def _words(words: tuple[str, ...]) -> str:
    return "".join(f"`{word}` or " for word in words)


def _notes(annotation: Any) -> Iterator[Any]:
    """What is attached to the parts of ``Annotated[...] | None``."""
    for part in get_args(annotation):
        yield from getattr(part, "__metadata__", ())


def _number(field: FieldInfo) -> str:
    notes = [*field.metadata, *_notes(field.annotation)]
    for note in notes:
        notes += getattr(note, "metadata", [])
    limits = [
        f"{words} {getattr(note, mark)}"
        for note in notes
        for mark, words in (("ge", "from"), ("le", "to"), ("lt", "to below"))
        if getattr(note, mark, None) is not None
    ]
    kind = "whole number" if field.annotation is int else "number"
    return f"{kind}, {' '.join(limits)}" if limits else kind


def _default(field: FieldInfo) -> str:
    if field.is_required():
        return "required"
    default = field.default
    return "optional" if default is None or field.default_factory else f"`{default}`"


def material_names() -> str:
    """The materials, one a row."""
    from springcad.materials.data import MATERIALS

    rows = ["| name | material | temper | E, GPa | yield, MPa |", "|---|---|---|---|---|"]
    for entry in MATERIALS.values():
        modulus, strength = entry.elastic_modulus.value / 1e9, entry.yield_strength.value / 1e6
        rows.append(
            f"| `{entry.name}` | {entry.title} | {entry.temper} | {modulus:g} | {strength:g} |"
        )
    return "\n".join(rows) + "\n"


def process_rules() -> str:
    """The processes and their rules, one a row."""
    from springcad.materials.process import PROCESSES

    rows = [
        "| name | process | web, mm | gap, mm | inside radius, mm | source |",
        "|---|---|---|---|---|---|",
    ]
    for entry in PROCESSES.values():
        sizes = (entry.min_web, entry.min_gap, entry.min_inside_radius)
        numbers = " | ".join(f"{1e3 * size:g}" for size in sizes)
        rows.append(f"| `{entry.name}` | {entry.title} | {numbers} | {entry.source} |")
    return "\n".join(rows) + "\n"


def spec_s2() -> str:
    """The spec of the README."""
    return f"```yaml\n{(ROOT / 'specs/S2.yaml').read_text(encoding='utf-8')}```\n"


def template(kind: str) -> str:
    """The commented spec of ``springcad init``."""
    from springcad.kinds import load_kind

    return f"```yaml\n{load_kind(kind).TEMPLATE}```\n"


PASSAGES: dict[str, Callable[[], str]] = {
    "commands": command_help,
    "rotary-keys": lambda: spec_keys("rotary-flexure"),
    "roller-keys": lambda: spec_keys("roller-cam"),
    "lever-keys": lambda: spec_keys("lever-arm"),
    "leaf2-keys": lambda: spec_keys("leaf-2dof"),
    "materials": material_names,
    "processes": process_rules,
    "spec-s2": spec_s2,
    "rotary-template": lambda: template("rotary-flexure"),
    "roller-template": lambda: template("roller-cam"),
    "lever-template": lambda: template("lever-arm"),
    "leaf2-template": lambda: template("leaf-2dof"),
}


# What commands print


def with_output(text: str, *, fast: bool = False) -> str:
    """``text`` with what each command of it prints; with ``fast`` nothing is designed."""
    with TemporaryDirectory(prefix="springcad-docs-") as folder:
        return with_output_in(Path(folder), text, fast=fast)


def with_output_in(folder: Path, text: str, *, fast: bool = False) -> str:
    """The same in a folder that is given, which is empty before and keeps what was written."""
    (folder / "specs").symlink_to(ROOT / "specs")
    return _CONSOLE.sub(_Session(folder, fast).renewed, text)


def is_slow(command: str) -> bool:
    """Whether a command designs something or looks at a design, or at what that printed."""
    return any(words in command for words in ("springcad design", "out/", "out.txt"))


def designs(text: str) -> bool:
    """Whether a page has a command that is slow."""
    return any(is_slow(match[3]) for match in _CONSOLE.finditer(text))


class _Session:
    """A folder in which the commands of one page run, and the exit code of the last one."""

    def __init__(self, folder: Path, fast: bool) -> None:
        self.folder = folder
        self.fast = fast
        self.exit_code = 0
        self.is_skipping = False

    def renewed(self, match: re.Match[str]) -> str:
        lines = [line for step in _steps(match[3]) for line in self._renewed_step(step)]
        if match[2] and len(lines) > int(match[2]):
            lines = [*lines[: int(match[2])], ELISION]
        return match[1] + "".join(f"{line}\n" for line in lines) + match[4]

    def _renewed_step(self, step: list[str]) -> list[str]:
        typed = [line for line in step if line.startswith(("$ ", "> "))]
        command = "\n".join(line[2:] for line in typed)
        if command != "echo $?":
            self.is_skipping = self.fast and is_slow(command)
        if self.is_skipping:
            return step
        return typed + self._printed(command)

    def _printed(self, command: str) -> list[str]:
        environment = {
            "HOME": str(self.folder),
            "LC_ALL": "C.UTF-8",
            **ARITHMETIC,
            "PATH": os.pathsep.join((str(Path(sys.executable).parent), os.defpath)),
        }
        run = subprocess.run(
            ["bash", "-c", f"(exit {self.exit_code})\n{command}"],
            cwd=self.folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            encoding="utf-8",
            timeout=120,
            check=False,
        )
        self.exit_code = run.returncode
        return [line.rstrip() for line in run.stdout.rstrip().splitlines()]


def _steps(body: str) -> list[list[str]]:
    """The lines of a fence, a list for each command: what is typed, then what it printed."""
    steps: list[list[str]] = []
    for line in body.splitlines():
        if line.startswith("$ "):
            steps.append([])
        steps[-1].append(line)
    return steps


def picture() -> str:
    """The drawing of S2 as the tool makes it."""
    with TemporaryDirectory(prefix="springcad-docs-") as folder:
        command = [sys.executable, "-m", "springcad", "design", "specs/S2.yaml", "-o", folder]
        environment = {**os.environ, **ARITHMETIC}
        subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.DEVNULL, check=True)
        return Path(folder, "S2/S2.svg").read_text(encoding="utf-8")


def main(arguments: list[str]) -> None:
    fast = arguments == ["--fast"]
    for page in pages():
        old = page.read_text(encoding="utf-8")
        new = with_output(with_reference(old), fast=fast)
        if new != old:
            page.write_text(new, encoding="utf-8")
            sys.stderr.write(f"renewed {page.relative_to(ROOT)}\n")
    if not fast:
        PICTURE.write_text(picture(), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
