"""A result as JSON for machines: one key order, no NaN, the same bytes on every machine."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from springcad import __version__
from springcad.report.verdict import verdict
from springcad.result import Comparison, Judgement, Result

_DIGITS = 12


def result_to_dict(result: Result, files: Mapping[str, str]) -> dict[str, Any]:
    """The result as plain dicts, lists, strings and finite numbers (SI), in the order of the file.

    ``files`` maps each written file to what it holds. Numbers are rounded to 12 significant
    digits, so that the last bits, in which machines differ, do not show; NaN and infinity become
    None. Raises TypeError for a value that JSON cannot hold.
    """
    judged = verdict(result.checks)
    document = {
        "springcad": __version__,
        "kind": result.kind,
        "name": result.name,
        "verdict": {"status": judged.status, "text": judged.text},
        "spec": result.spec,
        "design": result.design,
        "response": result.response,
        "checks": [asdict(check) for check in result.checks],
        "outcomes": [asdict(outcome) for outcome in result.outcomes],
        "verification": judgement_to_dict(result.judgement),
        "assumptions": result.assumptions,
        "advice": result.advice,
        "files": files,
        "provenance": result.provenance,
    }
    return {key: plain_value(value) for key, value in document.items()}


def judgement_to_dict(judgement: Judgement | None) -> dict[str, Any]:
    """The second opinion in the same form; without one only that it was not formed."""
    if judgement is None:
        return {"method": None}
    return {
        "method": judgement.method,
        **plain_value(judgement.figures),
        "comparisons": [plain_value(_comparison(entry)) for entry in judgement.comparisons],
    }


def _comparison(entry: Comparison) -> dict[str, Any]:
    return {
        "name": entry.name,
        "unit": entry.unit,
        f"{entry.place}_{entry.place_unit}": entry.places,
        "designed": entry.designed,
        "judged": entry.judged,
        "largest_difference": abs(entry.differences[entry.worst]),
        "tolerance": entry.tolerance,
        "relative": entry.relative,
        "source": entry.source,
    }


def result_to_json(result: Result, files: Mapping[str, str]) -> str:
    """The text of ``report.json``: two spaces a level, a list of numbers on one line."""
    text = _render(result_to_dict(result, files), "") + "\n"
    # A lone surrogate cannot be written as UTF-8; its JSON escape can.
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def plain_value(value: object) -> Any:
    """As plain dicts, lists, strings and numbers, in the way of ``result_to_dict``."""
    match value:
        case None | bool() | str():
            return value
        case np.ndarray() | np.generic():
            return plain_value(value.tolist())
        case int():
            return value
        case float():
            return _rounded(value)
        case Mapping():
            return {str(key): plain_value(item) for key, item in value.items()}
        case list() | tuple():
            return [plain_value(item) for item in value]
    raise TypeError(f"a report cannot hold a {type(value).__name__}")


def _rounded(value: float) -> float | None:
    if not math.isfinite(value):
        return None
    return float(f"{value:.{_DIGITS - 1}e}") + 0.0  # + 0.0 makes -0.0 a plain zero


def _render(value: Any, indent: str) -> str:
    inner = indent + "  "
    if isinstance(value, dict) and value:
        lines = [f"{inner}{_scalar(key)}: {_render(item, inner)}" for key, item in value.items()]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    if isinstance(value, list) and any(isinstance(item, dict | list | str) for item in value):
        lines = [inner + _render(item, inner) for item in value]
        return "[\n" + ",\n".join(lines) + f"\n{indent}]"
    return _scalar(value)


def _scalar(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
