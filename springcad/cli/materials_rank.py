"""``springcad materials rank``: which material makes the best leaf spring, and why."""

from __future__ import annotations

import json
import math
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from springcad.cli.console import result_console
from springcad.cli.options import Json

if TYPE_CHECKING:
    from springcad.materials.data import Material
    from springcad.materials.ranking import Ranking


class Element(StrEnum):
    """What the material is for."""

    leaf = "leaf"


def rank(
    element: Annotated[
        Element, typer.Option("--for", help="Leaf spring of given width, length and deflection.")
    ] = Element.leaf,
    cycles: Annotated[
        float | None,
        typer.Option("--life", metavar="CYCLES", help="Rank by fatigue at this life, not yield."),
    ] = None,
    names: Annotated[
        list[str] | None,
        typer.Option("--material", metavar="NAME", help="Only this one; may be given repeatedly."),
    ] = None,
    chart: Annotated[
        Path | None,
        typer.Option("--chart", metavar="FILE.svg", help="Write a chart of modulus and stress."),
    ] = None,
    as_json: Json = False,
) -> None:
    """Rank the materials by the energy that a spring of them can store; JSON values are in SI.

    In a leaf of given width, length and deflection it is proportional to sigma^3/E^2.
    """
    from springcad.materials.ranking import rank_for_leaf
    from springcad.report.material_ranking import print_ranking, ranking_data

    if chart is not None and chart.suffix != ".svg":
        raise typer.BadParameter(f"the chart is an SVG file; {chart.name!r} does not end with .svg")
    ranking = rank_for_leaf(_materials(names), _life(cycles))
    if chart is not None:
        _write_chart(ranking, chart)
    if as_json:
        data = {"for": element.value, **ranking_data(ranking)}
        typer.echo(json.dumps(data, indent=2, ensure_ascii=False))
    else:
        print_ranking(ranking, result_console())


def _life(cycles: float | None) -> float | None:
    from springcad.mechanics.fatigue import LOW_CYCLES

    if cycles is not None and not LOW_CYCLES <= cycles < math.inf:
        raise typer.BadParameter("--life must be a number of cycles from 1e3")
    return cycles


def _materials(names: list[str] | None) -> list[Material]:
    from springcad.materials.data import MATERIALS
    from springcad.spec.text import unknown

    for name in names or ():
        if name not in MATERIALS:
            raise typer.BadParameter(unknown("material", name, MATERIALS))
    return [MATERIALS[name] for name in dict.fromkeys(names or MATERIALS)]


def _write_chart(ranking: Ranking, path: Path) -> None:
    from springcad.export.files import write_files
    from springcad.report.material_chart import material_chart

    write_files(path.parent, {path.name: material_chart(ranking)})
