"""What a torque curve from elsewhere changes: the pseudo law that the next profile is made for.

A written design was simulated by the user's own program, or measured. Its angles at equal torque
are not those of the law; the angles of the pseudo law that it was made for are multiplied by what
the law's are over them (``pseudo_law.simplest``), and the next profile is made for that. By our
own model that one misses the law on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from springcad.errors import InfeasibleError, Problem, SpecError
from springcad.kinds.roller_cam.element import ElementDimensions
from springcad.kinds.roller_cam.inputs import group_law
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.roller_cam.pseudo_law import (
    AngleRatio,
    TorqueCurve,
    pseudo_law,
    simplest,
)
from springcad.kinds.roller_cam.spec import RollerCamSpec
from springcad.kinds.roller_cam.written_joint import written_joint
from springcad.kinds.target_law import Law
from springcad.result import Value
from springcad.spec.source import Spec, restored_spec
from springcad.spec.torque_curve import TorqueFile
from springcad.spec.units import ANGLE, show
from springcad.written import IncompleteDesignError, WrittenDesign

LEAST_POINTS = 10
"""With torque, in a curve; a series has at most a term for every third one."""
FIRST, LAST = 0.1, 0.95
"""Shares of the stroke between which a curve has to be known."""
LARGEST_FACTOR = 1.6
"""Of given torque and law, either way, in the middle of a curve: beyond it the curve is another."""
_ROUND_OFF = 1e-9
_REPORT = "report.json"


@dataclass(frozen=True)
class Correction:
    """A curve from elsewhere and what follows from it.

    Attributes:
        before: name of the design that the curve is of.
        count: corrections from the first design on, this one included.
        joint, dimensions: of that design; they stay.
        given: the curve, of one group.
        ours: what our model says of the same element.
        ratio: of the pseudo law for the next profile.
        sha256: of the curve's numbers.
    """

    before: str
    count: int
    joint: Joint
    dimensions: ElementDimensions
    given: TorqueCurve
    ours: TorqueCurve
    ratio: AngleRatio
    sha256: str


def next_spec(written: WrittenDesign) -> Spec:
    """The spec of the next design: that of the written one, with the next name.

    Raises:
        SpecError: the spec of the report is not valid.
        IncompleteDesignError: points of its law are missing.
    """
    count = _count(written)
    name = f"{written.name.removesuffix(f'-c{count}')}-c{count + 1}"
    return restored_spec({**_with_points(written), "name": name}, _REPORT)


def correction_of(written: WrittenDesign, spec: RollerCamSpec, file: TorqueFile) -> Correction:
    """The correction that a curve of the written design asks for.

    Raises:
        SpecError: the curve is too short, too sparse, or not of this design.
        IncompleteDesignError: the report lacks something.
    """
    law, share = group_law(spec), 1.0 / spec.groups if spec.target.per == "joint" else 1.0
    angle, torque = np.array(file.points).T
    curve = TorqueCurve(angle, share * torque)
    problems = [*_problems(law, spec, file, curve), *_given_before(written, file, curve)]
    if problems:
        raise SpecError(problems)
    array, made = written.array, written_joint(written)
    ratio = _ratio(written)
    return Correction(
        before=written.name,
        count=_count(written) + 1,
        joint=Joint(made.geometry.cantilever, made.roller),
        dimensions=made.geometry.dimensions,
        given=curve,
        ours=TorqueCurve(array("response.angle_rad"), array("response.group_torque_Nm")),
        ratio=simplest(law, ratio, curve),
        sha256=file.sha256,
    )


def followed_law(law: Law, correction: Correction) -> Law:
    """The pseudo law; InfeasibleError if its angles would not ascend."""
    try:
        return pseudo_law(law, correction.ratio)
    except InfeasibleError as error:
        remedy = "give a smoother curve, with more points; or thicken the contact part"
        claim, numbers = error.claim, (error.value, error.limit)
        raise InfeasibleError(claim, *numbers, error.unit, (remedy,)) from error


def correction_entry(correction: Correction | None) -> Value:
    """As it stands in a report, from which ``correction_of`` goes on."""
    if correction is None:
        return None
    return {
        "before": correction.before,
        "count": correction.count,
        "ratio_coefficients": np.array(correction.ratio.coefficients),
        "ratio_first_rad": correction.ratio.first,
        "ratio_last_rad": correction.ratio.last,
        "given_angle_rad": correction.given.angle,
        "given_group_torque_Nm": correction.given.torque,
    }


def law_points(spec: RollerCamSpec) -> Value:
    """The points by which the spec gives its law, angle and torque or stiffness; None without."""
    points = spec.target.law.table
    if points is None and spec.target.law.stiffness is not None:
        points = spec.target.law.stiffness.table
    return None if points is None else [list(point) for point in points]


def _with_points(written: WrittenDesign) -> dict[str, Any]:
    """The spec as typed, with the points of its law in place of the file that they were in."""
    raw = dict(written.spec)
    target = raw.get("target")
    law = target.get("law") if isinstance(target, Mapping) else None
    if not isinstance(target, Mapping) or not isinstance(law, Mapping):
        return raw
    inner = law.get("stiffness")
    if isinstance(law.get("table"), str):
        law = {**law, "table": _points(written, "N*m")}
    elif isinstance(inner, Mapping) and isinstance(inner.get("table"), str):
        law = {**law, "stiffness": {**inner, "table": _points(written, "N*m/rad")}}
    return {**raw, "target": {**target, "law": law}}


def _points(written: WrittenDesign, unit: str) -> list[Value]:
    try:
        points = np.array(written.design["law_points"], dtype=np.float64).reshape(-1, 2)
    except (KeyError, TypeError, ValueError) as error:
        raise IncompleteDesignError("design.law_points is missing or no list of pairs") from error
    return [[f"{angle!r} rad", f"{value!r} {unit}"] for angle, value in points.tolist()]


def _count(written: WrittenDesign) -> int:
    """Corrections that the written design has had."""
    if written.design.get("correction") is None:
        return 0
    return int(written.number("design.correction.count"))


def _ratio(written: WrittenDesign) -> AngleRatio | None:
    """Of the pseudo law that the written design was made for; None for the law itself."""
    if not _count(written):
        return None
    return AngleRatio(
        tuple(written.array("design.correction.ratio_coefficients").tolist()),
        written.number("design.correction.ratio_first_rad"),
        written.number("design.correction.ratio_last_rad"),
    )


def _problems(
    law: Law, spec: RollerCamSpec, file: TorqueFile, curve: TorqueCurve
) -> Iterator[Problem]:
    """What is wrong with a curve for this law."""
    stroke, full = law.deflection - law.dead_zone, float(law.torque(np.array([law.deflection]))[0])
    beyond = curve.angle - law.dead_zone
    pressed = np.flatnonzero((beyond > 0.0) & (curve.torque > 0.0))
    if len(pressed) < LEAST_POINTS:
        message = f"needs {LEAST_POINTS} points with torque beyond the dead zone, has"
        yield file.problem(f"{message} {len(pressed)}")
    if not len(pressed):
        return
    first = int(pressed[0])
    if beyond[first] > FIRST * stroke * (1.0 + _ROUND_OFF):
        limit = show(law.dead_zone + FIRST * stroke, ANGLE)
        yield file.problem(f"the first torque must be at {limit} or before", first)
    if beyond[-1] < LAST * stroke * (1.0 - _ROUND_OFF) and curve.torque[-1] < full:
        limit = show(law.dead_zone + LAST * stroke, ANGLE)
        message = f"the last angle must be {limit} or more, or its torque that of the deflection"
        yield file.problem(message, len(curve.angle) - 1)
    factor = float(np.median(curve.torque[pressed] / law.torque(curve.angle[pressed])))
    if not 1.0 / LARGEST_FACTOR <= factor <= LARGEST_FACTOR:
        whose = "one group" if spec.target.per == "group" else f"the joint ({spec.groups} groups)"
        yield file.problem(
            f"its torques are {factor:.3g} times those of the law at the same angles (median), more"
            f" than can be put right; are they of {whose}, as target.per says, of this design, and "
            "in the units of the first line?"
        )


def _given_before(
    written: WrittenDesign, file: TorqueFile, curve: TorqueCurve
) -> Iterator[Problem]:
    """The curve from which the written design was made is not the curve of that design."""
    if not _count(written):
        return
    before = (
        written.array(f"design.correction.given_{key}") for key in ("angle_rad", "group_torque_Nm")
    )
    pairs = zip(before, (curve.angle, curve.torque), strict=True)
    if all(len(old) == len(new) and np.allclose(old, new, rtol=1e-9) for old, new in pairs):
        name = cast(Mapping[str, Value], written.design["correction"]).get("before")
        yield file.problem(
            f"is the curve of {name}, from which {written.name} was made; "
            f"give the curve of {written.name}"
        )
