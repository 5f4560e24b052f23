"""A result as one self-contained page: no script, no network, every text escaped."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from springcad import __version__
from springcad.report.display import (
    format_check,
    format_deviation,
    format_difference,
    format_value,
    printable,
    typeset,
)
from springcad.report.entries import entries, spec_lines
from springcad.report.plots import LegendEntry, legend, plot_svg
from springcad.report.verdict import verdict
from springcad.result import Check, Judgement, Outcome, Plot, Result

_KEY_NUMBERS = 6
_XML_DECLARATION = re.compile(r"\A\s*<\?xml[^>]*\?>")


class _Row(NamedTuple):
    """A check or an outcome with its numbers as text; ``bound`` is its limit or its target."""

    item: Check | Outcome
    value: str
    bound: str
    deviation: str = ""


class _ComparisonRow(NamedTuple):
    """A quantity of the second opinion at one place."""

    name: str
    source: str
    place: str
    designed: str
    judged: str
    difference: str
    tolerance: str


class _Figure(NamedTuple):
    title: str
    svg: Markup
    legend: list[LegendEntry]


def result_to_html(result: Result, svg: str, files: Mapping[str, str]) -> str:
    """The page of ``result`` with the drawing ``svg`` in it.

    ``files`` maps each written file to what it holds. The drawing is trusted to have escaped its
    own texts; ValueError if it is not an SVG document or holds a script.
    """
    environment = Environment(
        loader=PackageLoader("springcad.report"),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=_readable,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    outcomes = [_outcome_row(outcome) for outcome in result.outcomes]
    return environment.get_template("report.html.jinja").render(
        version=__version__,
        result=result,
        verdict=verdict(result.checks),
        key_numbers=outcomes[:_KEY_NUMBERS],
        outcomes=outcomes,
        checks=[_check_row(check) for check in result.checks],
        parts=[(part, typeset(format_value(part.thickness, "m"))) for part in result.parts],
        drawing=_trusted_drawing(svg),
        figures=[_figure(plot, index) for index, plot in enumerate(result.plots, 1)],
        design=entries(result.design),
        judgement=result.judgement,
        comparisons=_comparison_rows(result.judgement),
        provenance=entries(result.provenance),
        spec="\n".join(spec_lines(result.spec)),
        files=files,
    )


def _readable(value: object) -> object:
    return value if isinstance(value, Markup) else printable(str(value))


def _trusted_drawing(svg: str) -> Markup:
    element = _XML_DECLARATION.sub("", svg).strip()
    if not element.startswith("<svg") or "<script" in element.lower():
        raise ValueError("the drawing is not an SVG document without scripts")
    return Markup(element)


def _check_row(check: Check) -> _Row:
    value, limit = format_check(check)
    sign = {"<=": "\N{LESS-THAN OR EQUAL TO}", ">=": "\N{GREATER-THAN OR EQUAL TO}"}[check.sense]
    return _Row(check, typeset(value), f"{sign} {typeset(limit)}")


def _outcome_row(outcome: Outcome) -> _Row:
    target = "" if outcome.target is None else format_value(outcome.target, outcome.unit)
    value = format_value(outcome.value, outcome.unit)
    return _Row(outcome, typeset(value), typeset(target), typeset(format_deviation(outcome)))


def _comparison_rows(judgement: Judgement | None) -> list[_ComparisonRow]:
    """Every place of every comparison."""
    return [
        _ComparisonRow(
            entry.name,
            entry.source,
            typeset(format_value(float(entry.places[i]), entry.place_unit)),
            typeset(format_value(float(entry.designed[i]), entry.unit)),
            typeset(format_value(float(entry.judged[i]), entry.unit)),
            typeset(format_difference(float(entry.differences[i]), entry)),
            typeset(format_difference(entry.tolerance, entry)),
        )
        for entry in (judgement.comparisons if judgement else ())
        for i in range(len(entry.places))
    ]


def _figure(plot: Plot, index: int) -> _Figure:
    return _Figure(plot.title, Markup(plot_svg(plot, f"plot-{index}")), legend(plot))
