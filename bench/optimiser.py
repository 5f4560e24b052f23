"""springcad's optimiser against the method of paper 004, on its S2 to S4, in one run.

    python bench/optimiser.py [--seconds 60] [--json FILE]

Every outline is measured with the same ruler (``outlines.py``); one thread throughout.
"""

from __future__ import annotations

import argparse
import json
import math
import platform
import statistics
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
import scipy
from cases import TABLE_I, flexure
from correction import correction
from outlines import Ruled, ruled
from paper_method import PaperMethod, Trial, search
from rich.console import Console
from rich.table import Table
from scipy.interpolate import CubicSpline
from startup import startup_times
from threadpoolctl import threadpool_limits

from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.control_point_problem import WEIGHTS, Weighting
from springcad.kinds.rotary_flexure.control_points import optimise_control_points
from springcad.kinds.rotary_flexure.curvature_form import optimise
from springcad.kinds.rotary_flexure.problem import FlexureProblem
from springcad.kinds.rotary_flexure.shape import curvature_ribbon

SPECS = Path(__file__).parents[1] / "specs"
STARTS = 40
"""Local searches of each of springcad's forms."""
WHOLE = 6
"""Starts of one whole optimisation: the default of the spec."""
WHOLE_REPEATS = 5
SAME = 0.99
"""A gap counts as reached at this share of it."""


@dataclass(frozen=True)
class Attempt:
    """One local search: its seconds, whether it met its own constraints, its cost and outline."""

    seconds: float
    feasible: bool
    cost: float
    outline: Ruled | None


@dataclass(frozen=True)
class Row:
    """One method on one spring; times in seconds, gaps in metres, shares from 0 to 1.

    Shares after the first are of the feasible outlines. ``gap``, ``valid``, ``largest_bend`` are
    those of the shape that the method itself selects. ``sound_gap`` is the largest gap among its
    feasible outlines that neither fold nor touch.
    The last two: seconds until the method has a shape with the gap of the paper's winner, and until
    it has a sound one with the largest gap of any sound outline of the paper's method.
    """

    method: str
    starts: int
    seconds_per_start: float
    feasible_share: float
    fold_over_share: float
    invalid_share: float
    sound_share: float
    gap: float | None
    valid: bool | None
    largest_bend: float | None
    sound_gap: float | None
    seconds_to_gap: float | None
    seconds_to_sound_gap: float | None


def paper(name: str, weighting: Weighting, seconds: float) -> list[Attempt]:
    """The paper's method; the two weights are in mm² and mm there."""
    problem = flexure(name, math.inf)
    sharpness, nearness = WEIGHTS[weighting]
    trials = search(PaperMethod(problem, 1e6 * sharpness, 1e3 * nearness), seconds)
    ends = [0.0, *(trial.finished for trial in trials)]
    return [
        Attempt(ends[i + 1] - ends[i], trial.feasible, trial.cost, _outline(problem, trial))
        for i, trial in enumerate(trials)
    ]


def _outline(problem: FlexureProblem, trial: Trial) -> Ruled:
    x = problem.span * (1.0 - np.linspace(1.0, 0.0, 1201) ** 2)
    spline = CubicSpline(trial.knots[:, 0], trial.knots[:, 1], bc_type="clamped")
    slope = spline(x, 1)
    half = problem.root_half_thickness * np.sqrt(np.maximum(1.0 - x / problem.span, 0.0))
    return ruled(
        problem,
        x,
        spline(x),
        np.arctan(slope),
        spline(x, 2) / (1.0 + slope**2) ** 1.5,
        np.maximum(half, problem.tip_half_thickness),
    )


def curvature_form(problem: FlexureProblem, seed: int) -> tuple[bool, float, Ribbon | None]:
    """One start of springcad's default form; it maximises the gap."""
    found = optimise(problem, starts=1, seed=seed)
    if found is None:
        return False, math.inf, None
    return True, -found.gap, curvature_ribbon(problem, found)


def control_points(weighting: Weighting) -> Searcher:
    """One start of springcad's control-point form."""

    def start(problem: FlexureProblem, seed: int) -> tuple[bool, float, Ribbon | None]:
        found = optimise_control_points(problem, starts=1, seed=seed, weighting=weighting)
        return found.feasible, found.cost, found.ribbon

    return start


Searcher = Callable[[FlexureProblem, int], tuple[bool, float, Ribbon | None]]


def ours(name: str, bend_limit: float, start: Searcher) -> list[Attempt]:
    """``STARTS`` searches, each timed on its own through the public function."""
    problem = flexure(name, bend_limit)
    start(problem, STARTS)  # warm-up
    attempts = []
    for seed in range(STARTS):
        began = time.perf_counter()
        feasible, cost, ribbon = start(problem, seed)
        seconds = time.perf_counter() - began
        outline = None if ribbon is None else _ruled_ribbon(problem, ribbon)
        attempts.append(Attempt(seconds, feasible, cost, outline))
    return attempts


def _ruled_ribbon(problem: FlexureProblem, ribbon: Ribbon) -> Ruled:
    at = ribbon.at(ribbon.dense_stations(1200))
    return ruled(problem, at.x, at.y, at.angle, at.curvature, at.half_thickness)


def best_so_far(attempts: list[Attempt]) -> list[tuple[float, Attempt]]:
    """The shape that the method would select, each time it changes, with the seconds until then."""
    selected: list[tuple[float, Attempt]] = []
    elapsed = 0.0
    for attempt in attempts:
        elapsed += attempt.seconds
        if attempt.feasible and (not selected or attempt.cost < selected[-1][1].cost):
            selected.append((elapsed, attempt))
    return selected


def seconds_to(gap: float | None, attempts: list[Attempt], *, sound: bool) -> float | None:
    """Seconds until an outline has this gap: the selected one, or any sound one."""
    if gap is None:
        return None
    candidates = best_so_far(attempts)
    if sound:
        ends = np.cumsum([a.seconds for a in attempts])
        candidates = [(float(end), a) for end, a in zip(ends, attempts, strict=True) if a.feasible]
    for elapsed, attempt in candidates:
        outline = attempt.outline
        if outline and outline.gap >= SAME * gap and (outline.sound or not sound):
            return elapsed
    return None


def row(method: str, attempts: list[Attempt], targets: tuple[float | None, float | None]) -> Row:
    """Sum up the attempts of one method; ``targets`` are the two gaps to reach."""
    feasible = [a.outline for a in attempts if a.feasible and a.outline]
    selected = best_so_far(attempts)
    outline = selected[-1][1].outline if selected else None
    count = max(len(feasible), 1)
    return Row(
        method=method,
        starts=len(attempts),
        seconds_per_start=statistics.mean(a.seconds for a in attempts),
        feasible_share=len(feasible) / len(attempts),
        fold_over_share=sum(o.largest_bend >= 1.0 for o in feasible) / count,
        invalid_share=sum(not o.valid for o in feasible) / count,
        sound_share=sum(o.sound for o in feasible) / count,
        gap=outline.gap if outline else None,
        valid=outline.valid if outline else None,
        largest_bend=outline.largest_bend if outline else None,
        sound_gap=largest_sound_gap(attempts),
        seconds_to_gap=seconds_to(targets[0], attempts, sound=False),
        seconds_to_sound_gap=seconds_to(targets[1], attempts, sound=True),
    )


def largest_sound_gap(attempts: list[Attempt]) -> float | None:
    """Largest gap of a feasible outline that neither folds nor touches."""
    outlines = [a.outline for a in attempts if a.feasible and a.outline]
    return max((o.gap for o in outlines if o.sound), default=None)


def rows(name: str, seconds: float) -> list[Row]:
    """All methods on one spring; the gaps to reach are the better of the paper's two weightings."""
    references = {w: paper(name, w, seconds) for w in WEIGHTS}
    winners = [selected[-1][1].outline for a in references.values() if (selected := best_so_far(a))]
    sound = [gap for a in references.values() if (gap := largest_sound_gap(a)) is not None]
    target = max((o.gap for o in winners if o), default=None), max(sound, default=None)
    done = [row(f"paper, {w}", a, target) for w, a in references.items()]
    for limit in (0.9, 0.5):
        for weighting in WEIGHTS:
            attempts = ours(name, limit, control_points(weighting))
            label = f"control points, {weighting}, z <= {limit}"
            done.append(row(label, attempts, target))
    for limit in (0.5, 0.3):
        attempts = ours(name, limit, curvature_form)
        done.append(row(f"curvature form, z <= {limit}", attempts, target))
    return done


def whole(name: str, bend_limit: float) -> float:
    """Median seconds of one whole optimisation by the default form, warm."""
    problem, times = flexure(name, bend_limit), []
    for _ in range(WHOLE_REPEATS + 1):
        began = time.perf_counter()
        optimise(problem, starts=WHOLE, seed=0)
        times.append(time.perf_counter() - began)
    return statistics.median(times[1:])


def table(name: str, lines: list[Row]) -> Table:
    """The rows of one spring for the terminal."""
    shown = Table(title=name, title_justify="left")
    for heading in (
        "method", "starts", "ms/start", "feasible", "fold over", "invalid", "sound", "gap mm",
        "max z", "sound gap mm", "s to gap", "faster", "s to sound gap", "faster",
    ):  # fmt: skip
        shown.add_column(heading, justify="left" if heading == "method" else "right")
    by_paper = [r for r in lines if r.method.startswith("paper")]
    gap = min((r.seconds_to_gap for r in by_paper if r.seconds_to_gap), default=None)
    sound = min((r.seconds_to_sound_gap for r in by_paper if r.seconds_to_sound_gap), default=None)
    for r in lines:
        shown.add_row(
            r.method,
            str(r.starts),
            f"{1e3 * r.seconds_per_start:.0f}",
            f"{r.feasible_share:.0%}",
            f"{r.fold_over_share:.0%}",
            f"{r.invalid_share:.0%}",
            f"{r.sound_share:.0%}",
            _number(r.gap, 1e3),
            _number(r.largest_bend, 1.0),
            _number(r.sound_gap, 1e3),
            _number(r.seconds_to_gap, 1.0),
            _ratio(gap, r.seconds_to_gap),
            _number(r.seconds_to_sound_gap, 1.0),
            _ratio(sound, r.seconds_to_sound_gap),
        )
    return shown


def _ratio(reference: float | None, value: float | None) -> str:
    return f"{reference / value:.3g}x" if reference and value else "-"


def _number(value: float | None, factor: float) -> str:
    return "-" if value is None else f"{factor * value:.3f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seconds", type=float, default=60.0, help="for each search of the paper")
    parser.add_argument("--json", type=Path, help="write the figures to this file")
    options = parser.parse_args()

    console = Console(width=180)
    starts = startup_times()
    with threadpool_limits(1):
        cases = {name: rows(name, options.seconds) for name in TABLE_I}
        wholes = {name: {str(z): whole(name, z) for z in (0.5, 0.3)} for name in TABLE_I}
        corrections = {name: correction(SPECS / f"{name}.yaml") for name in ("S1", *TABLE_I)}
    for name, lines in cases.items():
        console.print(table(name, lines))
    for name, c in corrections.items():
        console.print(
            f"{name}: correction for full load, {c.passes} passes: {1e3 * c.correction:.0f} ms, "
            f"{1e3 * c.without_elements:.0f} ms besides the finite elements of the root, "
            f"{c.correction / c.search:.3g} times the search; warm"
        )
    for name, times in wholes.items():
        for limit, seconds in times.items():
            console.print(f"{name}: {WHOLE} starts, z <= {limit}: {1e3 * seconds:.0f} ms, warm")
    for label, seconds in starts.items():
        console.print(f"{label}: {1e3 * seconds:.0f} ms")
    if options.json:
        figures = {
            "python": platform.python_version(),
            "numpy": np.__version__,
            "scipy": scipy.__version__,
            "machine": platform.machine(),
            "paper_seconds": options.seconds,
            "cases": {name: [asdict(line) for line in lines] for name, lines in cases.items()},
            "whole_optimisation_starts": WHOLE,
            "whole_optimisation_seconds": wholes,
            "startup_seconds": starts,
            "corrections": {name: asdict(c) for name, c in corrections.items()},
        }
        options.json.write_text(json.dumps(figures, indent=2, allow_nan=False) + "\n")


if __name__ == "__main__":
    main()
