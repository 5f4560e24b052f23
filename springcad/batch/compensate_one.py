"""One written design and a torque curve of it, from elsewhere, to the next design."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from springcad.batch.design_one import Attempt, Wishes, written_attempt
from springcad.errors import OutputError, SpringcadError
from springcad.export.files import check_writable
from springcad.result import Progress
from springcad.spec.source import Spec
from springcad.spec.torque_curve import TorqueFile, read_torque_file


class NoCompensationError(SpringcadError):
    """The kind of the design offers no compensation."""

    exit_code = 2


def attempt_compensation(design: Path, curve: Path, wishes: Wishes, progress: Progress) -> Attempt:
    """The next design, written; whatever goes wrong is part of the answer, never raised."""
    try:
        return compensate_one(design, curve, wishes, progress)
    except Exception as error:
        exit_code = error.exit_code if isinstance(error, SpringcadError) else 1
        return Attempt(design, exit_code, error=error)


def compensate_one(design: Path, curve: Path, wishes: Wishes, progress: Progress) -> Attempt:
    """Make the next design from a written one, and write it beside under the next name.

    Args:
        design: a report or its folder; nothing in it is changed.
        curve: CSV file of torque over angle.

    Raises:
        SpecError: the curve will not do, or the spec of the report is not valid.
        IncompleteDesignError, DrawingError: the design cannot be read.
        NoCompensationError: its kind offers none.
        InfeasibleError: no part meets the corrected law; nothing is written.
        OutputError: the files cannot be written, or would replace another design.
    """
    file = read_torque_file(curve)

    # Only now what is slow to import: a curve that will not do is refused at once.
    from springcad.kinds import KINDS, compensating_kind
    from springcad.verify.read_design import read_design

    written, unchanged = read_design(design)
    kind = compensating_kind(written.kind)
    if kind is None:
        known = ", ".join(name for name in KINDS if compensating_kind(name))
        raise NoCompensationError(f"{written.kind} offers no compensation; kinds that do: {known}")
    spec = kind.next_spec(written)
    check_writable(wishes.out, [f"{spec.name}/manifest.json"])
    _keep_others(wishes.out / spec.name / "report.json", spec, file)
    result = kind.compensate_design(spec, written, file, progress)
    before = replace(unchanged, name=f"{written.name}: {unchanged.name}")
    result = replace(result, checks=(before, *result.checks))
    return written_attempt(design, result, spec, wishes, progress)


def _keep_others(report: Path, spec: Spec, file: TorqueFile) -> None:
    """OutputError if a design is there already that was not made from this spec and curve."""
    if not report.exists():
        return
    try:
        made_from = json.loads(report.read_text(encoding="utf-8"))["provenance"]
        same = (made_from["spec_sha256"], made_from["curve_sha256"]) == (spec.sha256, file.sha256)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        same = False
    if not same:
        raise OutputError(
            f"{report.parent} holds a design that was not made from this curve; it is kept: "
            "choose another folder with --out, or move it away"
        )
