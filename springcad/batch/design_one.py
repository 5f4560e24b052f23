"""One design the whole way: from a spec to checked files, or to the reason why there is none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from springcad.batch.specs import Reading
from springcad.errors import OutputError, SpringcadError
from springcad.export.files import check_writable, write_files

if TYPE_CHECKING:
    from springcad.result import Check, Progress, Result
    from springcad.spec.source import Spec


@dataclass(frozen=True)
class Attempt:
    """A spec and what became of it.

    Either ``result`` with the ``files`` that were written and the text of its ``report.json``, or
    ``error``: a ``SpringcadError`` for the user, any other exception for the developers (a bug).
    """

    path: Path
    exit_code: int
    name: str = ""
    result: Result | None = None
    files: tuple[Path, ...] = ()
    report: str = ""
    error: Exception | None = None


def attempt_design(reading: Reading, out: Path, *, strict: bool, progress: Progress) -> Attempt:
    """Design and write one spec; whatever goes wrong is part of the answer, never raised."""
    spec = reading.outcome
    if isinstance(spec, Exception):
        return _failed(reading.path, "", spec)
    try:
        return design_one(reading.path, spec, out, strict=strict, progress=progress)
    except Exception as error:
        return _failed(reading.path, spec.name, error)


def _failed(path: Path, name: str, error: Exception) -> Attempt:
    exit_code = error.exit_code if isinstance(error, SpringcadError) else 1
    return Attempt(path, exit_code, name, error=error)


def design_one(path: Path, spec: Spec, out: Path, *, strict: bool, progress: Progress) -> Attempt:
    """Design ``spec``, re-read every drawing, and write all files into ``out``/NAME.

    Nothing is written before everything is known. The exit code is 5 when a check failed (with
    ``strict`` also when one warned), else 0.

    Raises:
        InfeasibleError: no part meets the spec; nothing is written.
        OutputError: the files cannot be written; earlier ones are kept.
    """
    check_writable(out, [f"{spec.name}/manifest.json"])

    # Only now what is slow to import: a spec or an output folder that will not do answers at once.
    from springcad.kinds import load_kind

    result = load_kind(spec.kind).design_spec(spec, progress)
    progress("writing and reading back the drawings")
    drawings = _drawings(result)
    result = replace(result, checks=result.checks + _preflight(drawings, spec))
    contents = _all_files(result, drawings, spec.sha256)
    written = write_files(out, {f"{spec.name}/{name}": text for name, text in contents.items()})
    return Attempt(
        path,
        exit_code_of(result.checks, strict=strict),
        spec.name,
        result=result,
        files=written,
        report=contents["report.json"],
    )


def exit_code_of(checks: Sequence[Check], *, strict: bool) -> int:
    """5 when a check failed, with ``strict`` also when one warned; else 0."""
    bad = ("fail", "warn") if strict else ("fail",)
    return 5 if any(check.status in bad for check in checks) else 0


def _drawings(result: Result) -> dict[str, tuple[str, str]]:
    """File name → (text, role) of the drawing of each part."""
    from springcad.export.dxf import part_to_dxf

    return {
        f"{result.name}{'-' if part.suffix else ''}{part.suffix}.dxf": (
            part_to_dxf(part),
            part.role,
        )
        for part in result.parts
    }


def _preflight(drawings: Mapping[str, tuple[str, str]], spec: Spec) -> tuple[Check, ...]:
    """Checks of the drawings as a shop would read them, from a temporary copy."""
    from springcad.spec.common import ProcessSpec
    from springcad.verify.preflight import preflight

    entry = getattr(spec.model, "process", None)
    rules = entry.rules if isinstance(entry, ProcessSpec) else None
    checks: list[Check] = []
    try:
        with TemporaryDirectory(prefix="springcad-") as folder:
            for name, (text, role) in drawings.items():
                copy = Path(folder, name)
                copy.write_text(text, encoding="utf-8", newline="")
                checks += _as_one_part(role, preflight(copy, rules))
    except OSError as error:
        raise OutputError(f"no temporary copy of the drawings: {error.strerror}") from error
    return tuple(checks)


def _as_one_part(role: str, checks: Sequence[Check]) -> list[Check]:
    """The checks of one drawing under its role; counts that are as they should be become one line.

    A drawing of ours has a dozen of those (open ends, crossings, units, ...), seldom of interest.
    """
    from springcad.result import check as compare

    plain = [check for check in checks if check.unit == "1" and check.status == "pass"]
    rest = [check for check in checks if check not in plain]
    tested = "; ".join(check.name for check in plain)
    sound = compare(
        f"{role} drawing, read back: faults", 0.0, "<=", 0.0, "1", source=f"tested: {tested}"
    )
    return [sound, *(replace(check, name=f"{role} drawing: {check.name}") for check in rest)]


def _all_files(
    result: Result, drawings: Mapping[str, tuple[str, str]], spec_sha256: str
) -> dict[str, str]:
    """File name → text of everything in the folder of the design; the manifest comes last."""
    from springcad.export.manifest import manifest_json
    from springcad.export.svg import result_to_svg
    from springcad.report.html import result_to_html
    from springcad.report.json_report import result_to_json

    held = {name: f"{role}, for cutting" for name, (_, role) in drawings.items()} | {
        f"{result.name}.svg": "all parts in true size, with dimensions",
        "report.html": "the report for people",
        "report.json": "the whole result for programs",
        "manifest.json": "SHA-256 of each file, and versions",
    }
    svg = result_to_svg(result)
    contents = {name: text for name, (text, _) in drawings.items()} | {
        f"{result.name}.svg": svg,
        "report.html": result_to_html(result, svg[svg.index("<svg") :], held),
        "report.json": result_to_json(result, held),
    }
    manifest = manifest_json(result.kind, result.name, spec_sha256, contents)
    return contents | {"manifest.json": manifest}
