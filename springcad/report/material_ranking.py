"""A ranking of materials in the terminal and for programs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from typing import Any

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from springcad.materials.ranking import Ranked, Ranking, remarks
from springcad.report.display import format_number, format_value

_FIGURES = (
    ("material", ""),
    ("stress", "MPa"),
    ("E", "GPa"),
    ("sigma^3/E^2", "kPa"),
    ("over its range", "kPa"),
    ("sigma^2/2E", "MPa"),
    ("per mass", "J/kg"),
)


def print_ranking(ranking: Ranking, console: Console) -> None:
    """Print the order, the stress behind each place with its source, and what is not known."""
    if ranking.ranked:
        headings = [f"{name}\n{unit}" for name, unit in _FIGURES]
        _print_table(console, headings, map(_figures, ranking.ranked))
        _print_table(console, ("stress of", "range", "what it is", "source"), _sources(ranking))
    if ranking.unknown:
        _print_table(console, ("not ranked", "why"), ranking.unknown)
    if any(entry.allowable.stress.weak for entry in ranking.ranked):
        console.print(Text("* weak source: find a better one if the choice hangs on it"))
    for remark in remarks(ranking):
        console.print(Text(remark))


def ranking_data(ranking: Ranking) -> dict[str, Any]:
    """The same in SI, for JSON."""
    return {
        "life_cycles": ranking.cycles,
        "ranking": [_entry(entry) for entry in ranking.ranked],
        "not_ranked": dict(ranking.unknown),
        "remarks": list(remarks(ranking)),
    }


def _entry(entry: Ranked) -> dict[str, Any]:
    return {
        "name": entry.material.name,
        "stress_Pa": asdict(entry.allowable.stress),
        "basis": entry.allowable.basis,
        "elastic_modulus_Pa": entry.modulus,
        "leaf_metric_Pa": entry.leaf_metric,
        "leaf_metric_range_Pa": list(entry.leaf_metric_range),
        "energy_per_volume_J_per_m3": entry.energy_per_volume,
        "energy_per_mass_J_per_kg": entry.energy_per_mass,
    }


def _figures(entry: Ranked) -> list[str]:
    low, high = entry.leaf_metric_range
    metric_range = "" if low == high else f"{_short(low / 1e3)} to {_short(high / 1e3)}"
    return [
        entry.material.name,
        format_number(entry.stress / 1e6),
        _short(entry.modulus / 1e9),
        format_number(entry.leaf_metric / 1e3),
        metric_range,
        _short(entry.energy_per_volume / 1e6),
        _short(entry.energy_per_mass),
    ]


def _sources(ranking: Ranking) -> Iterator[tuple[str, str, str, str]]:
    for entry in ranking.ranked:
        stress = entry.allowable.stress
        low, high = (format_value(end, "Pa", 3) for end in entry.stress_range)
        weak = " *" if stress.weak else ""
        stress_range = "" if low == high else f"{low} to {high}"
        yield entry.material.name, stress_range, entry.allowable.basis, f"{stress.source}{weak}"


def _short(value: float) -> str:
    return format_number(value, 3)


def _print_table(console: Console, headings: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    for heading in headings:
        table.add_column(Text(heading), overflow="fold", no_wrap=heading not in ("source", "why"))
    for row in rows:
        table.add_row(*map(Text, row))
    console.print(table)
    console.print()
