"""A written design read back from its folder: report, drawings and manifest."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from springcad.geometry.polyline import BulgePolyline
from springcad.kinds import KINDS
from springcad.result import Check, check
from springcad.verify.drawing import read_drawing
from springcad.written import IncompleteDesignError, WrittenDesign

REPORT = "report.json"
MANIFEST = "manifest.json"
LARGEST_FILE = 64 * 2**20


def read_design(path: Path) -> tuple[WrittenDesign, Check]:
    """The design whose ``report.json`` (or whose folder) is ``path``, and whether it is as written.

    Raises:
        IncompleteDesignError: no readable report, or drawings are missing.
        DrawingError: a drawing cannot be read.
    """
    report_path = path / REPORT if path.is_dir() else path
    report = _object(report_path)
    kind, name = (_text(report, key) for key in ("kind", "name"))
    if kind not in KINDS:
        raise IncompleteDesignError(f"kind {kind!r} is not known to this version")
    files = [file for file in _mapping(report, "files") if Path(file).name == file]
    design = WrittenDesign(
        kind=kind,
        name=name,
        design=_mapping(report, "design"),
        response=_mapping(report, "response"),
        contours=_contours(report_path.parent, name, files),
        spec=_mapping(report, "spec"),
    )
    return design, _unchanged(report_path.parent)


def _contours(folder: Path, name: str, files: list[str]) -> dict[str, tuple[BulgePolyline, ...]]:
    """Contours of every drawing that the report names, by the suffix of the file."""
    drawings = [Path(file) for file in files if file.endswith(".dxf") and file.startswith(name)]
    return {
        file.stem.removeprefix(name).removeprefix("-"): read_drawing(folder / file).polylines
        for file in drawings
    }


def _unchanged(folder: Path) -> Check:
    """Whether every file is the one that the manifest vouches for."""
    vouched = _mapping(_object(folder / MANIFEST), "files")
    changed = [file for file, digest in vouched.items() if _digest(folder, file) != digest]
    return check(
        "files changed since the design was written",
        float(len(changed)),
        "<=",
        0.0,
        "1",
        source=f"{MANIFEST}{': ' if changed else ''}{', '.join(changed)}",
        remedy="design the part again; or bear in mind that the files are not as designed",
        otherwise="warn",
    )


def _digest(folder: Path, file: str) -> str:
    """SHA-256 of a file of the folder; empty if it is gone."""
    path = folder / Path(file).name
    return hashlib.sha256(_content(path)).hexdigest() if path.is_file() else ""


def _object(path: Path) -> Mapping[str, Any]:
    """The JSON object in a file."""
    if not path.is_file():
        raise IncompleteDesignError(f"there is no {path.name} in {path.parent}")
    try:
        value = json.loads(_content(path))
    except (ValueError, RecursionError) as error:
        raise IncompleteDesignError(f"{path.name} is not readable JSON") from error
    if not isinstance(value, dict):
        raise IncompleteDesignError(f"{path.name} holds no JSON object")
    return value


def _content(path: Path) -> bytes:
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise IncompleteDesignError(f"{path.name} cannot be read: {error.strerror}") from error
    if len(content) > LARGEST_FILE:
        raise IncompleteDesignError(f"{path.name} is larger than {LARGEST_FILE // 2**20} MiB")
    return content


def _text(report: Mapping[str, Any], key: str) -> str:
    value = report.get(key)
    if not isinstance(value, str):
        raise IncompleteDesignError(f"{key} is missing in {REPORT}")
    return value


def _mapping(report: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    value = report.get(key)
    if not isinstance(value, dict):
        raise IncompleteDesignError(f"{key} is missing in {REPORT} or {MANIFEST}")
    return value
