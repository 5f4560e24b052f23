"""Unquoted scalars by the core schema of YAML 1.2: ``no`` and ``12:30`` are text, ``012`` is 12."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

_NOT_FINITE = re.compile(r"[-+]?\.?(nan|inf|infinity)", re.IGNORECASE)
_INTEGER = re.compile(r"[-+]?[0-9]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_BASED = {"0o": 8, "0x": 16}
_WORDS: Mapping[str, bool | None] = {
    "": None, "~": None, "null": None, "Null": None, "NULL": None,
    "true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False,
}  # fmt: skip


def read_plain(text: str) -> str | int | float | bool | None:
    """An unquoted scalar by the core schema of YAML 1.2 (10.3.2); ValueError if not finite."""
    if text in _WORDS:
        return _WORDS[text]
    if _NOT_FINITE.fullmatch(text):
        raise ValueError("must be a finite number")
    if _INTEGER.fullmatch(text):
        return int(text)
    if re.fullmatch("0o[0-7]+|0x[0-9a-fA-F]+", text):
        return int(text[2:], _BASED[text[:2]])
    if _FLOAT.fullmatch(text):
        number = float(text)
        if not math.isfinite(number):
            raise ValueError("must be a finite number")
        return number
    return text
