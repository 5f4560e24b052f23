"""A calculation sheet: every step of a design with its equation, source, numbers and units.

The value of a step is the design's own. Its formula says how the value follows from those of the
steps before it, so that whoever evaluates the formulas calculates the design a second time.
All numbers are SI.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Literal

from springcad.errors import InfeasibleError
from springcad.formula import evaluate, renamed
from springcad.result import Check

Basis = Literal["given", "derived", "found"]

TOLERANCE = 1e-6
"""Relative difference up to which a formula gives the value of its step again."""


@dataclass(frozen=True)
class Step:
    """One number of a design.

    Attributes:
        symbol: a Python name, unique in its sheet; Greek letters by their names, as ``sigma_d``.
        meaning: in a few words.
        value, unit: SI.
        basis: given to the calculation; derived from earlier steps in closed form; or found in
            another way, as by a search, by the beam with large deflections or by finite elements.
        formula: over the symbols of earlier steps (see ``springcad.formula``); empty for what is
            given or found.
        source: of the value or of the formula: the spec, an equation of a paper, a method.
        note: what else there is to know.
    """

    symbol: str
    meaning: str
    value: float
    unit: str
    basis: Basis
    formula: str = ""
    source: str = ""
    note: str = ""


@dataclass(frozen=True)
class Section:
    """Steps that belong together, under a title; ``text`` says what they are for."""

    title: str
    steps: tuple[Step, ...]
    text: str = ""


@dataclass(frozen=True)
class Sheet:
    """The calculation of one design, in the order in which an engineer would do it.

    Attributes:
        kind, name: as in the spec.
        sections: the calculation.
        checks: what the design must stand up to; empty where there is none.
        refusal: why there is no design; the sections then end with the closed forms.
    """

    kind: str
    name: str
    sections: tuple[Section, ...]
    checks: tuple[Check, ...] = ()
    refusal: InfeasibleError | None = None

    @property
    def steps(self) -> tuple[Step, ...]:
        """Of all sections."""
        return tuple(step for section in self.sections for step in section.steps)


def recomputed(sheet: Sheet) -> dict[str, float]:
    """Symbol → value by the formula, for every step that has one, from the values before it.

    Raises:
        ValueError: two steps have the same symbol.
        FormulaError: a formula has a symbol that no earlier step has.
    """
    values: dict[str, float] = {}
    found = {}
    for step in sheet.steps:
        if step.symbol in values:
            raise ValueError(f"two steps of the sheet are called {step.symbol}")
        if step.formula:
            found[step.symbol] = evaluate(step.formula, values)
        values[step.symbol] = step.value
    return found


def agrees(step: Step, again: float) -> bool:
    """Whether the formula has given the value of its step ``again``."""
    return math.isclose(again, step.value, rel_tol=TOLERANCE)


def given(
    symbol: str, meaning: str, value: float, unit: str, source: str = "spec", note: str = ""
) -> Step:
    """A step that the calculation starts from."""
    return Step(symbol, meaning, float(value), unit, "given", "", source, note)


def derived(
    symbol: str,
    meaning: str,
    formula: str,
    value: float,
    unit: str,
    source: str,
    note: str = "",
) -> Step:
    """A step that follows from earlier ones in closed form; ``value`` is that of the design."""
    return Step(symbol, meaning, float(value), unit, "derived", formula, source, note)


def found(symbol: str, meaning: str, value: float, unit: str, source: str, note: str = "") -> Step:
    """A step that no closed form gives; ``source`` says what does."""
    return Step(symbol, meaning, float(value), unit, "found", "", source, note)


def suffixed(steps: Iterable[Step], suffix: str) -> tuple[Step, ...]:
    """The steps with ``_suffix`` behind their symbols: for what is calculated at several places."""
    given_steps = tuple(steps)
    names = {step.symbol: f"{step.symbol}_{suffix}" for step in given_steps}
    return tuple(
        replace(step, symbol=names[step.symbol], formula=renamed(step.formula, names))
        for step in given_steps
    )
