"""A calculation sheet for programs: SI numbers, formulas in Python's syntax."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from springcad import __version__
from springcad.report.json_report import plain_value
from springcad.sheet import Sheet, agrees, recomputed


def sheet_to_dict(sheet: Sheet) -> dict[str, Any]:
    """The sheet as plain dicts, lists, strings and finite numbers.

    A step's ``recomputed`` is what its formula gives with the values of the steps before it, and
    ``agrees`` whether that is its value; both None for a step without a formula.
    """
    again = recomputed(sheet)
    document = {
        "springcad": __version__,
        "kind": sheet.kind,
        "name": sheet.name,
        "sections": [
            {
                "title": section.title,
                "text": section.text,
                "steps": [
                    {
                        "number": f"{number}.{place}",
                        **asdict(step),
                        "recomputed": again.get(step.symbol),
                        "agrees": agrees(step, again[step.symbol]) if step.formula else None,
                    }
                    for place, step in enumerate(section.steps, 1)
                ],
            }
            for number, section in enumerate(sheet.sections, 1)
        ],
        "checks": [asdict(check) for check in sheet.checks],
    }
    return {key: plain_value(value) for key, value in document.items()}
