"""The cantilever sized within bounds, or the limit that none within them can meet.

The stress is that of the very state in which the cantilever follows the law, with a rigid contact
part. Derivation: docs/theory/roller-cam.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from springcad.errors import InfeasibleError
from springcad.kinds.knobs import Knob
from springcad.kinds.roller_cam.case import Case
from springcad.kinds.roller_cam.feasibility import failures, require_feasible
from springcad.kinds.roller_cam.inputs import case_of
from springcad.kinds.roller_cam.joint import Cantilever, Joint
from springcad.kinds.roller_cam.remedies import stepped_remedies
from springcad.kinds.roller_cam.sizing_search import (
    ENERGY_RESERVE,
    SIZES,
    STIFFNESS,
    VOLUME,
    Beam,
    Objective,
    SizingTask,
    least_of,
    least_stress,
    loads_of,
    samples,
)
from springcad.kinds.roller_cam.spec import RollerCamSpec
from springcad.kinds.roller_cam.synthesis import synthesise
from springcad.kinds.roller_cam.tip import exact_tip, linear_tip
from springcad.kinds.target_law import Law
from springcad.optimise.sqp import Solution

KEYS = {"length": "cantilever.length", "height": "cantilever.height", "width": "envelope.thickness"}
"""Where the sizes stand in the spec."""
HELD = 1e-4
"""A limit that is this near, as a share, holds the result."""
_KNOBS = (
    Knob("the upper bound of cantilever.height", "mm", 1e-3, "high.height"),
    Knob("the upper bound of envelope.thickness", "mm", 1e-3, "high.width"),
    Knob("the upper bound of cantilever.length", "mm", 1e-3, "high.length"),
    Knob("the lower bound of cantilever.length", "mm", 1e-3, "low.length"),
    Knob("the lower bound of envelope.thickness", "mm", 1e-3, "low.width"),
)
"""Not the lower bound of the height, which the cutting process may set."""
_ALWAYS = (
    Knob("joint.drum_radius", "mm", 1e-3, "roller.drum_radius"),
    Knob("target.deflection", "deg", math.pi / 180.0, "law.deflection", upwards=False),
)
_STIFFNESS = Knob("cantilever.stiffness", "N/mm", 1e3, "stiffness")


@dataclass(frozen=True)
class Sized:
    """A cantilever sized within bounds.

    Attributes:
        joint: with the cantilever.
        objective: what it was sized for.
        value: of the objective: tip stiffness in bending [N/m], volume of the cantilever [m³]
            (for target_stiffness too) or stress [Pa].
        stress: largest at the clamp up to the deflection, of the synthesised profile [Pa].
        active: bounds and limits that hold the result.
        words: one line for people.
    """

    joint: Joint
    objective: Objective
    value: float
    stress: float
    active: tuple[str, ...]
    words: str


def size_cantilever(spec: RollerCamSpec, law: Law) -> Sized:
    """The cantilever within the bounds of the spec that is best for its objective.

    Args:
        law: of one group.

    Raises:
        InfeasibleError: none within the bounds meets every limit: the gap to the roller, the
            stiffness wanted, the law's energy and slope at rest, the design stress; or the profile
            of the best would fold back or be undercut. Remedies were tried by sizing again.
    """
    case = replace(case_of(spec), law=law, deflection=law.deflection)
    require_feasible(case)
    task = task_of(spec, law)
    try:
        return sized(task, exact_tip)
    except InfeasibleError as error:
        raise error.with_remedies(*_remedies(task, case)) from error


def task_of(spec: RollerCamSpec, law: Law) -> SizingTask:
    """The sizing that a spec with an objective asks for."""
    if spec.cantilever.objective is None:
        raise ValueError("the spec gives no objective")
    case = case_of(spec)
    bounds = {
        "length": spec.cantilever.length,
        "height": spec.cantilever.height,
        "width": spec.envelope.thickness,
    }
    low, high = (
        replace(case.joint.cantilever, **{name: pair[end] for name, pair in bounds.items()})
        for end in (0, 1)
    )
    return SizingTask(
        law=law,
        roller=case.joint.roller,
        low=low,
        high=high,
        objective=spec.cantilever.objective,
        stiffness=spec.cantilever.stiffness,
        design_stress=spec.material.design_stress,
        clearance=case.clearance,
    )


def sized(task: SizingTask, beam: Beam) -> Sized:
    """The best cantilever, its state by ``beam`` (``exact_tip``, or ``linear_tip`` as in 001).

    Raises:
        InfeasibleError: see ``size_cantilever``; without remedies.
    """
    solution = _within_limits(task, beam)
    if task.objective != "min_stress":
        gradient = -STIFFNESS if task.objective == "max_stiffness" else VOLUME
        solution = least_of(task, beam, gradient, solution)
    joint = Joint(task.cantilever(solution.variables), task.roller)
    profile = synthesise(joint, task.law, beam=beam, overruns=(1.0,))
    stress = float(profile.tip.stress.max())
    active = tuple(_active(task, beam, joint.cantilever, stress))
    value = _value(task.objective, joint.cantilever, stress)
    words = f"{_WORDS[task.objective]}, {_sizes(joint.cantilever)}; held by {', '.join(active)}"
    return Sized(joint, task.objective, value, stress, active, words)


def _within_limits(task: SizingTask, beam: Beam) -> Solution:
    """The cantilever with the least stress; InfeasibleError if none is within all limits."""
    _require_room(task)
    _require_stiffness(task)
    _require_energy(task, beam)
    return _require_stress(task, beam)


def _require_room(task: SizingTask) -> None:
    """Bounds must leave a cantilever; a search for remedies may have crossed them."""
    low, high = task.bounds
    name = SIZES[int(np.argmax(low - high))]
    least, most = getattr(task.low, name), float(np.exp(high[SIZES.index(name)]))
    if least > most * (1.0 + 1e-9):
        claim = f"{KEYS[name]}, whose lower bound must leave room under the roller"
        raise InfeasibleError(claim, least, most, "m")


def _require_stiffness(task: SizingTask) -> None:
    least, most = task.stiffness_range
    if task.stiffness is None or least <= task.stiffness <= most:
        return
    claim = (
        "cantilever.stiffness, where the bounds let the tip have "
        f"{1e-3 * least:.4g} to {1e-3 * most:.4g} N/mm"
    )
    nearest = least if task.stiffness < least else most
    raise InfeasibleError(claim, task.stiffness, nearest, "N/m")


def _require_energy(task: SizingTask, beam: Beam) -> None:
    error, excess = _energy_error(task, beam)
    if excess > -ENERGY_RESERVE:
        raise error


def _require_stress(task: SizingTask, beam: Beam) -> Solution:
    """The cantilever with the least stress, within the design stress."""
    found = least_stress(task, beam)
    if found is None:
        raise _energy_error(task, beam)[0]
    ratio = math.exp(found.variables[3])
    if ratio > 1.0:
        least = _sizes(task.cantilever(found.variables))
        claim = f"least bending stress of a cantilever within the bounds, that of {least}"
        raise InfeasibleError(claim, ratio * task.design_stress, task.design_stress, "Pa")
    return found


def _energy_error(task: SizingTask, beam: Beam) -> tuple[InfeasibleError, float]:
    """What to say where the energy cannot be held, and the logarithm of by how much."""
    wanted = samples(task.law)
    excess = loads_of(task, beam, task.first_to_try, wanted).excess
    worst = int(np.argmax(excess))
    stored, factor = float(wanted.energy[worst]), math.exp(excess[worst])
    which = "the stiffest cantilever within the bounds"
    if task.stiffness is not None:
        which = f"a cantilever of {1e-3 * task.stiffness:.4g} N/mm"
    beyond = ", to which the profile must go on" if worst == len(excess) - 1 else ""
    claim = (
        f"energy that the law stores up to {math.degrees(wanted.angle[worst]):.4g} deg{beyond}; "
        f"giving its torque there {which} holds more: it is too soft by a factor of {factor:.4f}"
    )
    return InfeasibleError(claim, stored, stored * factor, "J"), float(excess[worst])


def _active(task: SizingTask, beam: Beam, cantilever: Cantilever, stress: float) -> Iterator[str]:
    """What would have to give way for a better cantilever."""
    for name, key in KEYS.items():
        size, low, high = (getattr(part, name) for part in (cantilever, task.low, task.high))
        if low < high and size in (low, high):
            end = "lower" if size == low else "upper"
            yield f"{end} bound of {key}"
    is_under_roller = task.low.height < task.high.height and task.largest_height < task.high.height
    if is_under_roller and math.isclose(cantilever.height, task.largest_height, rel_tol=HELD):
        yield "gap between roller and cantilever"
    if task.stiffness is not None:
        yield "cantilever.stiffness"
    if stress > (1.0 - HELD) * task.design_stress:
        yield "material.design_stress"
    if loads_of(task, beam, cantilever, samples(task.law)).excess.max() > -2.0 * ENERGY_RESERVE:
        yield "energy of the law"


def _value(objective: Objective, cantilever: Cantilever, stress: float) -> float:
    if objective == "max_stiffness":
        return cantilever.tip_stiffness
    if objective == "min_stress":
        return stress
    return cantilever.length * cantilever.height * cantilever.width


_WORDS = {
    "max_stiffness": "stiffest cantilever within the bounds",
    "min_volume": "cantilever of least volume within the bounds",
    "min_stress": "cantilever of least stress within the bounds",
    "target_stiffness": "cantilever of the wanted stiffness and least volume within the bounds",
}


def _sizes(cantilever: Cantilever) -> str:
    length, height, width = (1e3 * getattr(cantilever, name) for name in SIZES)
    return f"length {length:.5g} mm, height {height:.5g} mm, thickness {width:.5g} mm"


def _remedies(task: SizingTask, case: Case) -> tuple[str, ...]:
    """Changes of one number of the spec with which the sizing succeeds."""
    knobs = [knob for knob in _KNOBS if _is_free(task, knob)]
    stiffness = [] if task.stiffness is None else [_STIFFNESS]
    return stepped_remedies(
        task, [*knobs, *stiffness, *_ALWAYS], lambda tried: _is_cured(task, tried, case)
    )


def _is_free(task: SizingTask, knob: Knob) -> bool:
    """Whether the size has bounds; a given one has none to move."""
    name = knob.target.partition(".")[2]
    return float(getattr(task.low, name)) < float(getattr(task.high, name))


def _is_cured(task: SizingTask, tried: SizingTask, case: Case) -> bool:
    """Whether sizing succeeds after a change that does not narrow the bounds."""
    narrower = any(
        getattr(tried.low, name) > getattr(task.low, name)
        or getattr(tried.high, name) < getattr(task.high, name)
        for name in SIZES
    )
    stiffest = replace(tried.high, length=tried.low.length)
    changed = replace(
        case, law=tried.law, deflection=tried.law.deflection, joint=Joint(stiffest, tried.roller)
    )
    if narrower or failures(changed):
        return False
    try:
        _within_limits(tried, linear_tip)  # rules most changes out in a tenth of the time
        sized(tried, exact_tip)
    except InfeasibleError:
        return False
    return True
