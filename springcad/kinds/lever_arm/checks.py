"""The claims that a finished lever arm must stand up to."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.case import Case, pivots
from springcad.kinds.lever_arm.changes import FAULT, HIGH_END, LOW_END, turned
from springcad.kinds.lever_arm.made import MadeJoint
from springcad.kinds.lever_arm.mechanism import boundary, loads, response, stroke
from springcad.kinds.lever_arm.spring_law import SpringLaw
from springcad.result import Check, check

Floats = NDArray[np.float64]

STIFFNESS_TOLERANCE = 1e-3
PIVOTS = 41
"""Pivot positions at which the mechanism is looked at."""


def joint_checks(made: MadeJoint) -> tuple[Check, ...]:
    """All checks, those made before the design first."""
    return (*made.feasibility, *_stiffness(made), *made.spring.checks, *_mechanism(made))


def largest_pivot_force(case: Case, law: SpringLaw) -> float:
    """Over the stroke at all pivot positions [N]; it grows with the stroke."""
    q = pivots(case, PIVOTS)
    end = boundary(case.lever, law, q)
    force = loads(case.lever, q, end.crank_angle, law.force(end.deflection))
    return float(np.max(force.pivot))


def _stiffness(made: MadeJoint) -> Iterator[Check]:
    wanted = made.case.stiffness
    if not wanted:
        return
    yield check(
        "spring stiffness against the target, relative",
        abs(made.spring.stiffness / wanted - 1.0), "<=", STIFFNESS_TOLERANCE, "1",
        source="force over deflection at the spring deflection, nonlinear beam",
        remedy=FAULT,
    )  # fmt: skip


def _mechanism(made: MadeJoint) -> Iterator[Check]:
    case = made.case
    yield from _rising(case, made)
    yield from _balance(case, made)
    if not case.max_pivot_force:
        return
    force = largest_pivot_force(case, made.spring.law)
    yield check(
        "force on the pivot", force, "<=", case.max_pivot_force, "N",
        source="largest over the stroke at all pivot positions", remedy=_farther(case, made),
    )  # fmt: skip


def _rising(case: Case, made: MadeJoint) -> Iterator[Check]:
    """Beyond the largest torque the joint gives way: 45 deg for a yoke with a linear spring."""
    q = pivots(case, PIVOTS)
    least = _end_stiffness(case, made.spring.law)
    worst = int(np.argmin(least))
    yield check(
        f"output stiffness at the end of the stroke, least at q = {1e3 * q[worst]:.4g} mm",
        float(least[worst]), ">=", 0.0, "N*m/rad",
        source="dτ/dφ, series stiffness left out; where it is negative the torque falls",
        remedy=_before_giving_way(case, made), otherwise="warn",
    )  # fmt: skip


def _end_stiffness(case: Case, law: SpringLaw) -> Floats:
    """Of the output at the end of the stroke, at all pivot positions (P,) [N m/rad]."""
    return boundary(case.lever, law, pivots(case, PIVOTS)).crank_stiffness


def _before_giving_way(case: Case, made: MadeJoint) -> str:
    """The farthest pivot position at which the torque rises to the end of the stroke."""
    law = made.spring.law

    def works(tried: Case) -> bool:
        return float(np.min(_end_stiffness(tried, law))) >= 0.0

    return turned(case, (HIGH_END,), works, "a lower high end of mechanism.pivot")


def _farther(case: Case, made: MadeJoint) -> str:
    """The nearest pivot position that loads the pivot no more than it bears."""
    law = made.spring.law

    def works(tried: Case) -> bool:
        return largest_pivot_force(tried, law) <= tried.max_pivot_force

    return turned(case, (LOW_END,), works, "a higher low end of mechanism.pivot")


def _balance(case: Case, made: MadeJoint) -> Iterator[Check]:
    """The law is a curve through points of the beam: its integral must be the beam's energy."""
    law, spring = made.spring.law, made.spring
    stored = float(spring.energy[-1])
    q = case.pivot_low
    end = float(stroke(case.lever, q, case.deflection))
    nodes, weights = np.polynomial.legendre.leggauss(40)
    at = response(case.lever, law, q, 0.5 * end * (1.0 + nodes))
    work = 0.5 * end * float(weights @ at.torque)
    reached = float(response(case.lever, law, q, end).deflection)
    share = (
        stored if math.isclose(reached, case.deflection) else float(law.energy(np.array(reached)))
    )
    yield check(
        "work at the output against the energy of the spring, relative", abs(work / share - 1.0),
        "<=", 1e-3, "1", source="integral of the torque over the crank's angle (000, Eq. 6)",
        remedy=FAULT,
    )  # fmt: skip
