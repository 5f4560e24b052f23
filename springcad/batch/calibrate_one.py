"""One written design and a bench test of it, to the file that calibrates the next."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from springcad.errors import OutputError, SpringcadError
from springcad.export.files import check_writable, write_files
from springcad.result import Progress
from springcad.spec.torque_curve import read_bench_file

if TYPE_CHECKING:
    from springcad.kinds.calibrating import Calibration, Stiffness


class NoCalibrationError(SpringcadError):
    """The kind of the design offers no calibration."""

    exit_code = 2


@dataclass(frozen=True)
class Calibrated:
    """What was found, the file that was written, and files of the design that were changed."""

    calibration: Calibration
    file: Path
    changed: str


def calibrate_one(
    design: Path, curve: Path, out: Path, stiffness: Stiffness, progress: Progress
) -> Calibrated:
    """Fit a bench test of a written design, and write NAME-calibration.yaml into ``out``.

    Args:
        design: a report or its folder; nothing in it is changed.
        curve: CSV file of angle and torque, in the order in which they were measured.

    Raises:
        SpecError: the curve will not do, or cannot tell what is asked.
        IncompleteDesignError, DrawingError: the design cannot be read.
        NoCalibrationError: its kind offers none.
        OutputError: the file cannot be written, or would replace another.
    """
    file = read_bench_file(curve)

    # Only now what is slow to import: a curve that will not do is refused at once.
    from springcad.kinds import KINDS, calibrating_kind
    from springcad.kinds.calibrating import calibration_file
    from springcad.verify.read_design import read_design

    written, unchanged = read_design(design)
    kind = calibrating_kind(written.kind)
    if kind is None:
        known = ", ".join(name for name in KINDS if calibrating_kind(name))
        raise NoCalibrationError(f"{written.kind} offers no calibration; kinds that do: {known}")
    name = calibration_file(written.name)
    check_writable(out, [name])
    found = kind.calibrate_design(written, file, stiffness, progress)
    _keep_other(out / name, found.text)
    (path,) = write_files(out, {name: found.text})
    changed = "" if unchanged.status == "pass" else unchanged.source
    return Calibrated(found, path, changed)


def _keep_other(path: Path, text: str) -> None:
    """OutputError if another calibration is there already."""
    if path.exists() and path.read_bytes() != text.encode("utf-8"):
        raise OutputError(
            f"{path} is there already and holds something else; it is kept: choose another folder "
            "with --out, or move it away"
        )
