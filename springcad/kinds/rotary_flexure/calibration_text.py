"""The calibration file: a section of a spec as text, with where it comes from."""

from __future__ import annotations

import json

from springcad.kinds.calibrating import Calibration, Estimate, calibration_file
from springcad.spec.text import printable
from springcad.spec.torque_curve import TorqueFile
from springcad.spec.units import ANGLE, TORQUE, show
from springcad.written import WrittenDesign

_HEAD = """\
# Written by springcad calibrate: what a bench test of {design} has told.
# For the next design, put this file beside its spec and write there:
#   calibration: {file}
# It stands for material.elastic_modulus{friction}.
"""


def calibration_text(found: Calibration, written: WrittenDesign, file: TorqueFile) -> str:
    """The text of the file, from the estimates in the order modulus, root, friction, offsets."""
    modulus, root, friction, *offsets = found.estimates
    rubs = not (friction.held or friction.doubt)
    keys = [
        ("design", json.dumps(written.name, ensure_ascii=False)),
        ("curve", json.dumps(_last_part(file.shown), ensure_ascii=False)),
        ("material", written.text("design.material")),
        ("elastic_modulus", shown_value(modulus.value, "Pa", 7)),
        *([] if modulus.held else [("elastic_modulus_error", _error(modulus))]),
        ("root_coefficient", f"{root.value:.6g}"),
        *([] if root.held else [("root_coefficient_error", _error(root))]),
        *([("friction", f"{max(friction.value, 0.0):.6g}")] if rubs else []),
        *([("friction_error", _error(friction))] if rubs else []),
    ]
    head = _HEAD.format(
        design=written.name,
        file=calibration_file(written.name),
        friction=" and camshaft.friction" if rubs else "",
    )
    told = [
        f"# {entry.name}: {shown_value(entry.value, entry.unit)}, of the bench alone"
        for entry in offsets
        if not entry.held
    ]
    left = f"# points: {found.used} of {found.points}; left: {found.scatter:.2%} of the torque"
    lines = [f"{key}: {value}" for key, value in keys]
    return head + "\n".join([*lines, left, *told, f"# curve SHA-256: {file.sha256}"]) + "\n"


def _last_part(path: str) -> str:
    return printable(path.replace("\\", "/").rsplit("/", 1)[-1])


def shown_value(value: float, unit: str, digits: int = 4) -> str:
    """An SI value as people type it: moduli in GPa."""
    if unit == "Pa":
        return f"{value * 1e-9:.{digits}g} GPa"
    dimension = {"rad": ANGLE, "N*m": TORQUE}.get(unit)
    return show(value, dimension) if dimension else f"{value:.{digits}g}"


def _error(entry: Estimate) -> str:
    return shown_value(entry.standard_error, entry.unit, 2)
