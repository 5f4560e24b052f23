"""One design the whole way: from a spec to checked files, or to the reason why there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from springcad.batch.specs import Reading
from springcad.errors import OutputError, SpringcadError
from springcad.export.files import check_writable, write_files

if TYPE_CHECKING:
    from springcad.result import Check, Part, Progress, Result
    from springcad.spec.source import Spec
    from springcad.verify.drawing import Drawing


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


@dataclass(frozen=True)
class Wishes:
    """How designs are to be made and judged.

    Attributes:
        out: folder in which each design gets its own.
        strict: warnings count as failures.
        judged: a second opinion is formed.
    """

    out: Path
    strict: bool
    judged: bool


def attempt_design(reading: Reading, wishes: Wishes, progress: Progress) -> Attempt:
    """Design and write one spec; whatever goes wrong is part of the answer, never raised."""
    spec = reading.outcome
    if isinstance(spec, Exception):
        return _failed(reading.path, "", spec)
    try:
        return design_one(reading.path, spec, wishes, progress)
    except Exception as error:
        return _failed(reading.path, spec.name, error)


def _failed(path: Path, name: str, error: Exception) -> Attempt:
    exit_code = error.exit_code if isinstance(error, SpringcadError) else 1
    return Attempt(path, exit_code, name, error=error)


def design_one(path: Path, spec: Spec, wishes: Wishes, progress: Progress) -> Attempt:
    """Design ``spec``, re-read every drawing, judge the design, and write all files into OUT/NAME.

    Nothing is written before everything is known. The exit code is 5 when a check failed (with
    ``strict`` also when one warned), else 0.

    Raises:
        InfeasibleError: no part meets the spec; nothing is written.
        OutputError: the files cannot be written; earlier ones are kept.
    """
    check_writable(wishes.out, [f"{spec.name}/manifest.json"])

    # Only now what is slow to import: a spec or an output folder that will not do answers at once.
    from springcad.kinds import load_kind

    result = load_kind(spec.kind).design_spec(spec, progress)
    return written_attempt(path, result, spec, wishes, progress)


def written_attempt(
    path: Path, result: Result, spec: Spec, wishes: Wishes, progress: Progress
) -> Attempt:
    """The result with its drawings read back and judged, all its files written into OUT/NAME.

    ``path`` is what the user named. Raises OutputError like ``design_one``.
    """
    progress("writing and reading back the drawings")
    sheets = _sheets(result)
    result = replace(result, checks=result.checks + _preflight(sheets, spec))
    result = _judged(result, sheets, progress) if wishes.judged else _not_judged(result)
    contents = _all_files(result, sheets, spec.sha256)
    files = {f"{spec.name}/{name}": text for name, text in contents.items()}
    written = write_files(wishes.out, files)
    return Attempt(
        path,
        exit_code_of(result.checks, strict=wishes.strict),
        spec.name,
        result=result,
        files=written,
        report=contents["report.json"],
    )


def exit_code_of(checks: Sequence[Check], *, strict: bool) -> int:
    """5 when a check failed, with ``strict`` also when one warned; else 0."""
    bad = ("fail", "warn") if strict else ("fail",)
    return 5 if any(check.status in bad for check in checks) else 0


@dataclass(frozen=True)
class _Sheet:
    """The drawing of a part: as the text of its file, and as it is read from there."""

    part: Part
    file: str
    text: str
    drawing: Drawing


def _sheets(result: Result) -> tuple[_Sheet, ...]:
    """Every part drawn, and read back from a temporary copy."""
    from springcad.export.dxf import part_file, part_to_dxf
    from springcad.verify.drawing import read_drawing

    sheets = []
    try:
        with TemporaryDirectory(prefix="springcad-") as folder:
            for part in result.parts:
                text = part_to_dxf(part)
                copy = Path(folder, part_file(result.name, part.suffix))
                copy.write_text(text, encoding="utf-8", newline="")
                sheets.append(_Sheet(part, copy.name, text, read_drawing(copy)))
    except OSError as error:
        raise OutputError(f"no temporary copy of the drawings: {error.strerror}") from error
    return tuple(sheets)


def _preflight(sheets: Sequence[_Sheet], spec: Spec) -> tuple[Check, ...]:
    """Checks of the drawings as a shop would read them."""
    from springcad.spec.common import ProcessSpec
    from springcad.verify.preflight import drawing_checks

    entry = getattr(spec.model, "process", None)
    rules = entry.rules if isinstance(entry, ProcessSpec) else None
    return tuple(
        check
        for sheet in sheets
        for check in _as_one_part(sheet.part.role, drawing_checks(sheet.drawing, rules))
    )


def _judged(result: Result, sheets: Sequence[_Sheet], progress: Progress) -> Result:
    """The result with the second opinion on what is about to be written."""
    from springcad.verify.second_opinion import judgement_checks, second_opinion
    from springcad.written import WrittenDesign

    design = WrittenDesign(
        result.kind,
        result.name,
        result.design,
        result.response,
        {sheet.part.suffix: sheet.drawing.polylines for sheet in sheets},
        result.spec,
    )
    judgement = second_opinion(design, progress)
    return replace(
        result,
        judgement=judgement,
        checks=result.checks + judgement_checks(judgement),
        assumptions=result.assumptions + judgement.assumptions,
    )


def _not_judged(result: Result) -> Result:
    from springcad.verify.second_opinion import NOT_JUDGED

    return replace(result, assumptions=(*result.assumptions, NOT_JUDGED))


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


def _all_files(result: Result, sheets: Sequence[_Sheet], spec_sha256: str) -> dict[str, str]:
    """File name → text of everything in the folder of the design; the manifest comes last."""
    from springcad.export.manifest import manifest_json
    from springcad.export.svg import result_to_svg
    from springcad.report.html import result_to_html
    from springcad.report.json_report import result_to_json

    held = {sheet.file: f"{sheet.part.role}, for cutting" for sheet in sheets} | {
        f"{result.name}.svg": "all parts in true size, with dimensions",
        "report.html": "the report for people",
        "report.json": "the whole result for programs",
        "manifest.json": "SHA-256 of each file, and versions",
    }
    svg = result_to_svg(result)
    contents = {sheet.file: sheet.text for sheet in sheets} | {
        f"{result.name}.svg": svg,
        "report.html": result_to_html(result, svg[svg.index("<svg") :], held),
        "report.json": result_to_json(result, held),
    }
    manifest = manifest_json(result.kind, result.name, spec_sha256, contents)
    return contents | {"manifest.json": manifest}
