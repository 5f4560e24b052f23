"""A calculation sheet as lines of text: each step with its equation, its numbers and its source."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping

from springcad.report.display import format_check, printable, typeset
from springcad.report.formula_text import (
    formula_text,
    numbers_text,
    quantity_text,
    symbol_text,
)
from springcad.result import Check
from springcad.sheet import TOLERANCE, Section, Sheet, Step, agrees, recomputed

WIDTH = 100
_EQUATIONS = 50
"""Column in which equations begin."""
_UNBROKEN = 50
"""Length up to which a source stays on one line."""
_NO_BREAK_SPACE = "\N{NO-BREAK SPACE}"
_WORDS = {"pass": "pass", "warn": "WARN", "fail": "FAIL"}


def sheet_text(sheet: Sheet, width: int = WIDTH) -> str:
    """The whole sheet, its lines at most ``width`` wide but for long words."""
    lines = [f"{sheet.name} ({sheet.kind}): calculation sheet", *_rules(width)]
    again = recomputed(sheet)
    quantities = {step.symbol: (step.value, step.unit) for step in sheet.steps}
    for number, section in enumerate(sheet.sections, 1):
        lines += ["", *_section(number, section, again, quantities, width)]
    if sheet.checks:
        lines += ["", *_checks(len(sheet.sections) + 1, sheet.checks, width)]
    lines += ["", *textwrap.wrap(_verdict(sheet, again), width)]
    return printable("\n".join(lines)).replace(_NO_BREAK_SPACE, " ") + "\n"


def _rules(width: int) -> list[str]:
    """How to read it."""
    text = (
        "Values are those of the design. Below each equation stand its numbers; the source is in "
        "brackets: [spec] is the spec or its default, [000, Eq. 5] an equation of a paper, "
        "[theory/x.md, 2] a section of the documentation."
    )
    return textwrap.wrap(text, width)


def _section(
    number: int,
    section: Section,
    again: Mapping[str, float],
    quantities: Mapping[str, tuple[float, str]],
    width: int,
) -> Iterator[str]:
    yield f"{number}  {section.title}"
    yield from textwrap.wrap(section.text, width, initial_indent="   ", subsequent_indent="   ")
    for place, step in enumerate(section.steps, 1):
        yield from _step(f"{number}.{place}", step, again.get(step.symbol), quantities, width)


def _step(
    label: str,
    step: Step,
    again: float | None,
    quantities: Mapping[str, tuple[float, str]],
    width: int,
) -> Iterator[str]:
    symbol, value = symbol_text(step.symbol), quantity_text(step.value, step.unit)
    equation = f"{symbol} = {formula_text(step.formula) if step.formula else value}"
    source = _source(step.source)
    indent = " " * (len(label) + 2)
    if step.formula:
        yield from _beside(label, step.meaning, equation, width)
        numbers = numbers_text(step.formula, quantities)
        result = f"= {numbers} = {value}" if numbers != value else f"= {value}"
        yield from _wrapped(f"{result}   {source}", indent, width)
    else:
        yield from _told(label, step.meaning, equation, source, width)
    if step.note:
        yield from _wrapped(step.note, indent, width)
    if again is not None and not agrees(step, again):
        yield from _wrapped(
            f"DOES NOT RECOMPUTE: the equation gives {quantity_text(again, step.unit)}",
            indent,
            width,
        )


def _source(source: str) -> str:
    """In brackets; a short one is never broken."""
    words = f"[{source}]" if source else ""
    return words.replace(" ", _NO_BREAK_SPACE) if len(words) <= _UNBROKEN else words


def _told(label: str, meaning: str, equation: str, source: str, width: int) -> Iterator[str]:
    """A value and its source, which goes to a line of its own where it must."""
    lines = list(_beside(label, meaning, equation, width))
    if len(lines[-1]) + 3 + len(source) <= width:
        lines[-1] = f"{lines[-1]}   {source}".rstrip()
        yield from lines
        return
    yield from lines
    yield from _wrapped(source, " " * (len(label) + 2), width)


def _beside(label: str, meaning: str, equation: str, width: int) -> Iterator[str]:
    """The meaning and the equation, on one line where there is room."""
    head = f"{label}  {meaning}"
    line = f"{head:<{_EQUATIONS}}  {equation}".rstrip()
    if len(line) <= width:
        yield line
        return
    yield head
    yield from _wrapped(equation, " " * (len(label) + 2), width)


def _wrapped(text: str, indent: str, width: int) -> list[str]:
    return textwrap.wrap(
        text, width, initial_indent=indent, subsequent_indent=indent + "  ",
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip


def _checks(number: int, checks: tuple[Check, ...], width: int) -> Iterator[str]:
    yield f"{number}  Checks"
    for place, check in enumerate(checks, 1):
        value, limit = (typeset(text) for text in format_check(check))
        sense = {"<=": "≤", ">=": "≥"}[check.sense]
        claim = f"{value} {sense} {limit}: {_WORDS[check.status]}"
        yield from _beside(f"{number}.{place}", check.name, claim, width)
        indent = " " * (len(f"{number}.{place}") + 2)
        yield from _wrapped(f"[{check.source}]", indent, width)
        if check.remedy:
            yield from _wrapped(f"what to change: {check.remedy}", indent, width)


def _verdict(sheet: Sheet, again: Mapping[str, float]) -> str:
    wrong = [step for step in sheet.steps if step.symbol in again]
    wrong = [step for step in wrong if not agrees(step, again[step.symbol])]
    if wrong:
        names = ", ".join(symbol_text(step.symbol) for step in wrong)
        return (
            f"{len(wrong)} of {len(again)} equations, evaluated with the values above them, do NOT "
            f"give the value of the design: {names}."
        )
    return (
        f"All {len(again)} equations, evaluated with the values above them, give the value of the "
        f"design again within {TOLERANCE:g}."
    )
