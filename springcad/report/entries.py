"""Mappings of named values (spec, design, provenance) as rows and lines of a page."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import numpy as np

from springcad.report.display import format_value, typeset
from springcad.result import Value

_UNIT_OF_SUFFIX = {
    "Nm_per_rad": "N*m/rad",
    "N_per_m": "N/m",
    "per_m": "1/m",
    "Nm": "N*m",
    "Pa": "Pa",
    "rad": "rad",
    "kg": "kg",
    "m2": "m^2",
    "m": "m",
    "J": "J",
    "N": "N",
    "s": "s",
}
_SUFFIX = re.compile(rf"^(.+?)_({'|'.join(_UNIT_OF_SUFFIX)})$")


def entries(mapping: Mapping[str, Value]) -> list[tuple[str, str]]:
    """Rows (label, text) of a mapping whose keys end with their unit, as ``mass_kg``.

    Mappings inside become rows of their own, their label behind the outer one; of an array only
    its size is told, since the JSON report holds its numbers.
    """
    return list(_entries("", mapping))


def _entries(prefix: str, mapping: Mapping[str, Value]) -> Iterator[tuple[str, str]]:
    for key, value in mapping.items():
        if isinstance(value, Mapping):
            yield from _entries(f"{prefix}{_words(key)}: ", value)
            continue
        match = _SUFFIX.match(key)
        name, unit = (match[1], _UNIT_OF_SUFFIX[match[2]]) if match else (key, "1")
        yield prefix + _words(name), _text(value, unit)


def _words(key: str) -> str:
    return key.replace("_", " ")


def _text(value: Value, unit: str) -> str:
    match value:
        case None:
            return "not computed"
        case bool():
            return "yes" if value else "no"
        case int() | float():
            return typeset(format_value(value, unit))
        case np.ndarray():
            return f"{value.size} values"
        case list():
            if len(value) <= 6:
                return ", ".join(_text(item, unit) for item in value)
            return f"{len(value)} values"
    return str(value)


def spec_lines(mapping: Mapping[str, Value], indent: str = "") -> list[str]:
    """The spec in the layout of its file: a line for each key, the values as they were typed."""
    lines = []
    for key, value in mapping.items():
        if isinstance(value, Mapping):
            lines += [f"{indent}{key}:", *spec_lines(value, indent + "  ")]
        else:
            lines.append(f"{indent}{key}: {_typed(value)}")
    return lines


def _typed(value: Value) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(_typed(item) for item in value) + "]"
    if isinstance(value, bool) or value is None:
        return {True: "true", False: "false", None: "null"}[value]
    return str(value)
