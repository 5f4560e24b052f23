"""springcad's beam and finite elements against scipy's solvers and CalculiX, in one run.

    python bench/mechanics.py [--json FILE]

One thread throughout. The springs are the shipped S4 (beam) and S1 (finite elements).
"""

from __future__ import annotations

import argparse
import json
import platform
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path

import calculix
import element_cases
import numpy as np
import scipy
from beam_methods import Method, OneLoad, backward_integration, collocation, load_of
from element_cases import Case
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table
from stopwatch import best_time
from threadpoolctl import threadpool_limits

from springcad.kinds.rotary_flexure.design import build_spring
from springcad.kinds.rotary_flexure.inputs import rotary_spec
from springcad.mechanics.beam import BeamStates, PreparedBeam, contact_load, prepare
from springcad.spec.source import read_spec

SPECS = Path(__file__).parents[1] / "specs"
LOADS = 32
EVERY = 4
"""scipy solves every fourth load; their errors are compared with ours at the same loads."""
SECONDS = 2.0
"""Each method is repeated for so long."""
METHODS: dict[str, Method] = {
    "DOP853 backward, rtol 1e-6": backward_integration(1e-6),
    "DOP853 backward, rtol 1e-8": backward_integration(1e-8),
    "solve_bvp, tol 1e-3": collocation(1e-3),
    "solve_bvp, tol 1e-5": collocation(1e-5),
}


@dataclass(frozen=True)
class Row:
    """One way to solve the beam: processor seconds per load, largest error over deflection."""

    method: str
    seconds_per_load: float
    error: float


def beam_rows(spec: Path) -> list[Row]:
    """The flexure of a spec under 32 contact loads up to the full one, by every method."""
    spring = build_spring(rotary_spec(read_spec(spec, ()).model), lambda _: None)
    stroke = spring.strokes[0]
    force = stroke.force[-1] * np.linspace(0.0, 1.0, LOADS + 1)[1:]
    station = np.interp(force, stroke.force, stroke.station)

    def one_way(beam: PreparedBeam) -> BeamStates:
        return contact_load(beam, station, force, 1.0)

    def both_ways(beam: PreparedBeam) -> BeamStates:
        sides = np.repeat([1.0, -1.0], LOADS)
        return contact_load(beam, np.tile(station, 2), np.tile(force, 2), sides)

    beam = spring.beam
    states, rest = one_way(beam), contact_load(beam, station, 0.0, 1.0)
    some = range(EVERY - 1, LOADS, EVERY)
    loads = [load_of(beam, states, i, 1.0) for i in some]
    deflection = np.hypot(*(states.point - rest.point)[some].T)
    exact = np.array([backward_integration(1e-12, in_panels=True)(beam, load) for load in loads])

    def error(points: NDArray[np.float64]) -> float:
        return float(np.max(np.hypot(*(points - exact).T) / deflection))

    rows = []
    for nodes in (beam.beam.nodes_per_panel, 5, 4):
        ours = prepare(replace(beam.beam, nodes_per_panel=nodes))
        seconds, found = best_time(partial(one_way, ours), SECONDS)
        name = f"springcad, {LOADS} loads, {nodes} nodes per panel"
        rows.append(Row(name, seconds / LOADS, error(found.point[some])))
    seconds, found = best_time(partial(both_ways, beam), SECONDS)
    name = f"springcad, {LOADS} loads of both directions in one call"
    rows.append(Row(name, seconds / (2 * LOADS), error(found.point[some])))
    for name, method in METHODS.items():
        seconds, points = best_time(partial(_each, method, beam, loads), SECONDS)
        rows.append(Row(name, seconds / len(loads), error(points)))
    return rows


def _each(method: Method, beam: PreparedBeam, loads: Sequence[OneLoad]) -> NDArray[np.float64]:
    return np.array([method(beam, load) for load in loads])


def beam_table(rows: list[Row]) -> Table:
    """The beam for the terminal; times over the first row's, the beam as springcad uses it."""
    shown = _table("beam: a flexure of S4", "ms/load", "error / deflection", "time / ours")
    for row in rows:
        shown.add_row(
            row.method,
            f"{1e3 * row.seconds_per_load:.3f}",
            f"{row.error:.1e}",
            f"{row.seconds_per_load / rows[0].seconds_per_load:.3g}",
        )
    return shown


def element_table(cases: list[Case]) -> Table:
    """The finite elements for the terminal."""
    shown = _table(
        "finite elements: one mesh, two programs",
        "unknowns", "loads", "s", "CalculiX s", "ratio", "difference", "",
    )  # fmt: skip
    for case in cases:
        theirs = case.calculix_seconds
        shown.add_row(
            case.name,
            str(case.unknowns),
            str(case.steps),
            f"{case.seconds:.2f}",
            "-" if theirs is None else f"{theirs:.2f}",
            "-" if theirs is None else f"{theirs / case.seconds:.3g}",
            "-" if case.difference is None else f"{case.difference:.1e}",
            case.note,
        )
    return shown


def _table(title: str, *headings: str) -> Table:
    shown = Table(title=title, title_justify="left")
    shown.add_column("case")
    for heading in headings:
        shown.add_column(heading, justify="right")
    return shown


def element_rows(spec: Path) -> list[Case]:
    """Sector and contact analyses by both programs."""
    spring = element_cases.designed(spec)
    return [
        element_cases.tip_force(spring, nonlinear=False),
        element_cases.tip_force(spring, nonlinear=True),
        element_cases.torque_curve(spring, 4, against=True),
        element_cases.torque_curve(spring, 16, against=False),
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--json", type=Path, help="write the figures to this file")
    options = parser.parse_args()

    console = Console(width=150)
    with threadpool_limits(1):
        rows, cases = beam_rows(SPECS / "S4.yaml"), element_rows(SPECS / "S1.yaml")
    console.print(beam_table(rows))
    console.print(element_table(cases))
    if options.json:
        figures = {
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "calculix": calculix.version(),
            "machine": platform.machine(),
            "beam": [asdict(row) for row in rows],
            "finite_elements": [asdict(case) for case in cases],
        }
        options.json.write_text(json.dumps(figures, indent=2, allow_nan=False) + "\n")


if __name__ == "__main__":
    main()
