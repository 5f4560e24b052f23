"""From a bench test of a written spring to what the next design should take for granted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from springcad.kinds.calibrating import Calibration, Estimate, Stiffness
from springcad.kinds.rotary_flexure.bench_fit import (
    ALIKE,
    BOUNDS,
    MODEL_ERROR,
    Fit,
    Points,
    at_end,
    first_known,
    fit,
    friction_apart,
    limit,
    scatter,
    unknown,
)
from springcad.kinds.rotary_flexure.bench_model import (
    FRICTIONS,
    Bench,
    BenchModel,
    bench_model,
    stack_counts,
)
from springcad.kinds.rotary_flexure.calibration_text import calibration_text, shown_value
from springcad.kinds.rotary_flexure.measured import travel_of
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.result import Progress
from springcad.spec.source import spec_error
from springcad.spec.torque_curve import TorqueFile
from springcad.spec.units import ANGLE, show
from springcad.written import WrittenDesign

FEWEST = 20
"""Points that a fit is made from."""
REACH = 0.5
"""Of the design deflection, that a test must reach."""
ANOTHER = 1.6
"""Torques that are more times those of the design, or less than the inverse, are not of it."""
LARGEST_SCATTER = 0.01
"""Of the peak torque; above it the model does not explain what was measured."""
MORE_FRICTION = 0.1
NOT_WORSE = 1.05
STIFFNESS = {"modulus": ("modulus",), "root": ("root",), "both": ("modulus", "root")}
NAMES = {
    "modulus": "elastic modulus",
    "root": "extra root compliance, over 1/(E t h^2)",
    "friction": "friction",
    "angle": "angle at rest",
    "torque": "torque at rest",
}
_UNITS = {"modulus": "Pa", "root": "1", "friction": "1", "angle": "rad", "torque": "N*m"}
_SHORT = {**NAMES, "root": "root compliance"}


def calibrate_spring(
    written: WrittenDesign, file: TorqueFile, stiffness: Stiffness, progress: Progress
) -> Calibration:
    """Fit what the test can tell.

    Raises:
        SpecError: the test is too short or not of this design, or it cannot tell what is asked.
        IncompleteDesignError: the design lacks what the model needs.
    """
    progress("turning the spring on the bench")
    spring = written_spring(written)
    _, series = stack_counts(written)
    points = _points(series * (spring.deflection + spring.free_play), file)
    model = bench_model(written, spring)
    designed = Bench(friction=min(written.number("design.camshaft.friction"), FRICTIONS[-1]))
    _require_own(model, designed, points, file)
    progress("fitting")
    wanted = STIFFNESS[stiffness]
    found = first_known(model, points, designed, wanted)
    if found is None:
        raise spec_error([file.problem(_refusal(model, points, designed, wanted))])
    # What is doubtful is not passed on, wherever it comes out.
    doubtful = unknown(model, found)
    if ends := [name for name in at_end(found) if name not in doubtful]:
        raise spec_error(file.problem(_too_far(found, name)) for name in ends)
    root = written.number("design.calibrated_root_coefficient")
    estimates = tuple(_estimates(model, points, designed, found, root))
    before = replace(designed, angle=found.bench.angle, torque=found.bench.torque)
    notes = tuple(_notes(model, points, designed, found, wanted))
    calibration = Calibration(
        design=written.name,
        kind=written.kind,
        estimates=estimates,
        points=len(file.points),
        used=len(points.angle),
        scatter=found.scatter,
        designed_scatter=scatter(model, points, before),
        notes=notes,
        text="",
    )
    return replace(calibration, text=calibration_text(calibration, written, file))


def _points(reach: float, file: TorqueFile) -> Points:
    """The points that count: within the stroke, and not just after a turn."""
    angle, torque = np.array(file.points).T
    travel = travel_of(angle)
    used = travel.settled & (np.abs(angle) <= reach)
    problems = []
    if used.sum() < FEWEST:
        problems.append(
            f"needs {FEWEST} points or more within {show(reach, ANGLE)} each way and away "
            f"from turns; {used.sum()} of {len(angle)} are"
        )
    reached = float(np.max(np.abs(angle)))
    if reached < REACH * reach:
        problems.append(
            f"reaches {show(reached, ANGLE)}; must reach {show(REACH * reach, ANGLE)}, half "
            "of the design deflection"
        )
    if problems:
        raise spec_error(file.problem(text) for text in problems)
    return Points(angle[used], torque[used], travel.direction[used])


def _require_own(model: BenchModel, designed: Bench, points: Points, file: TorqueFile) -> None:
    """SpecError if the torque is not of this design."""
    expected = model.torque(designed, points.angle, points.travel)
    ratio = float(points.torque @ expected / (expected @ expected))
    if 1.0 / ANOTHER <= ratio <= ANOTHER:
        return
    cause = (
        "turn the sign of one column round"
        if -ANOTHER <= ratio <= -1.0 / ANOTHER
        else "is the curve of another design, or in another unit?"
    )
    raise spec_error([file.problem(f"torques are {ratio:.3g} times those of the design: {cause}")])


def _refusal(model: BenchModel, points: Points, designed: Bench, wanted: tuple[str, ...]) -> str:
    """Why not even the stiffness can be told."""
    if len(wanted) == 1:
        tried = fit(model, points, designed, (*wanted, "friction"))
        if not friction_apart(tried, wanted):
            tried = fit(model, points, designed, wanted)
        return f"{_SHORT[wanted[0]]} {_errors(model, tried, wanted[0])}"
    tried = fit(model, points, designed, wanted)
    _, correlation = tried.partner(wanted[0])
    return (
        f"{_SHORT[wanted[0]]} and {_SHORT[wanted[1]]} cannot be told apart (correlation "
        f"{correlation:.4f}, condition number {tried.condition:.0f}): both scale the stiffness. "
        f"An error of the model of {MODEL_ERROR:.1%} of the torque could move the modulus by "
        f"{tried.model_error('modulus'):.0%}; fit one of them, --fit modulus or --fit root"
    )


def _too_far(found: Fit, name: str) -> str:
    unit = "1" if name == "modulus" else _UNITS[name]  # there a factor
    low, high = (shown_value(value, unit) for value in BOUNDS[name])
    value = shown_value(getattr(found.bench, name), unit)
    return (
        f"{_SHORT[name]} comes out at {value}, the end of what is looked for ({low} to {high}): "
        "something else is at work, or the design is another"
    )


def _errors(model: BenchModel, tried: Fit, name: str) -> str:
    """The larger error against its limit, and what makes it so large."""
    scale = model.elastic_modulus if name == "modulus" else 1.0
    spread, by_model = 2.0 * tried.standard_error(name), tried.model_error(name)
    error, most = (
        shown_value(scale * value, _UNITS[name])
        for value in (max(spread, by_model), limit(model, name))
    )
    figure, cause = "model error", "measure more of the stroke"
    if spread > by_model:
        unlike = "one coefficient" if name == "friction" else "the model"
        figure = "2 x standard error"
        cause = f"{unlike} does not explain what was measured, or the points scatter"
    return f"is not known well enough ({figure} = {error} against a limit of {most}): {cause}"


def _estimates(
    model: BenchModel, points: Points, designed: Bench, found: Fit, root: float
) -> Iterator[Estimate]:
    """Every number of the bench; of the root the whole coefficient, ``root`` of it designed."""
    doubtful = unknown(model, found)
    for name, words in NAMES.items():
        scale = model.elastic_modulus if name == "modulus" else 1.0
        offset = root if name == "root" else 0.0
        fitted = name in found.free
        yield Estimate(
            name=words,
            value=scale * getattr(found.bench, name) + offset,
            unit=_UNITS[name],
            designed=scale * getattr(designed, name) + offset,
            standard_error=scale * found.standard_error(name) if fitted else 0.0,
            model_error=scale * found.model_error(name) if fitted else 0.0,
            held="" if fitted else _why_held(model, points, found, name),
            doubt=f"{_errors(model, found, name)}; left out of the file"
            if name in doubtful
            else "",
        )


def _why_held(model: BenchModel, points: Points, found: Fit, name: str) -> str:
    """What kept a number from being fitted."""
    tried = fit(model, points, found.bench, (*found.free, name))
    partner, correlation = tried.partner(name)
    alike = (
        f"{_SHORT[partner]} (correlation {correlation:.4f}, condition number {tried.condition:.0f})"
    )
    if not (missing := unknown(model, tried)):
        return f"not asked for; could be told from {alike}"
    if abs(correlation) < ALIKE:
        if name in missing:
            return _errors(model, tried, name)
        return f"with it, {_SHORT[missing[0]]} {_errors(model, tried, missing[0])}"
    return f"cannot be told from {alike}"


def _notes(
    model: BenchModel, points: Points, designed: Bench, found: Fit, wanted: tuple[str, ...]
) -> Iterator[str]:
    if wanted != STIFFNESS["both"]:
        yield _other_cause(model, points, designed, found, wanted[0])
    if "friction" not in found.free:
        more = replace(found.bench, friction=found.bench.friction + MORE_FRICTION)
        other = fit(model, points, more, found.free)
        change = getattr(other.bench, wanted[0]) - getattr(found.bench, wanted[0])
        yield (
            f"Friction is held at {found.bench.friction:g}. Were it {MORE_FRICTION:g} more, "
            f"{_change(wanted[0], change)}: measure loading and unloading."
        )
    elif "friction" in unknown(model, found):
        yield (
            f"Friction is fitted so that the loop does not go into the {_SHORT[wanted[0]]}, which "
            "is of the mean of loading and unloading; the coefficient is doubtful, and the next "
            "design is not given it."
        )
    elif found.bench.friction < 0.0:
        yield "The friction fitted is below 0, which is none: the file has 0."
    if found.scatter > LARGEST_SCATTER:
        yield (
            f"The fit leaves {found.scatter:.1%} of the torque (root mean square): more than noise "
            "of a good bench, and something that this model does not have. Look at where it "
            "differs before you use the file."
        )


def _other_cause(
    model: BenchModel, points: Points, designed: Bench, found: Fit, wanted: str
) -> str:
    """What else would have given the same stiffness."""
    other = "root" if wanted == "modulus" else "modulus"
    start = replace(found.bench, **{wanted: getattr(designed, wanted)})
    free = (other, *(name for name in found.free if name != wanted))
    instead = fit(model, points, start, free)
    value = getattr(instead.bench, other)
    words = (
        f"an extra root compliance of {value:.2f}/(E t h^2)"
        if other == "root"
        else f"a modulus of {value:.3f} times that of the design"
    )
    return (
        f"With the {NAMES[wanted].split(',')[0]} of the design, {words} explains the test "
        f"{'as well' if instead.scatter < NOT_WORSE * found.scatter else 'less well'} "
        f"(it leaves {instead.scatter:.2%} of the torque, this fit {found.scatter:.2%}), and so "
        "would another thickness: decide by what you know of sheet, cut and mounting."
    )


def _change(name: str, change: float) -> str:
    """In words, of a modulus or a root coefficient."""
    way = "higher" if change > 0.0 else "lower"
    if name == "modulus":
        return f"the modulus would be {abs(change):.1%} of the design's {way}"
    return f"the root coefficient would be {abs(change):.2f} {way}"
