"""A spring for the lever's end, straight or curved, as the rest of the kind sees it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Profile
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.spec import LeverArmSpec
from springcad.kinds.lever_arm.spring_law import SpringLaw
from springcad.result import Check, Dimension, Outcome, Plot, Shape, Value

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class MadeSpring:
    """All leaves together, and what is told of their shape.

    Attributes:
        deflection: of the lever's end, ascending from -s_max to s_max, 0 among them (D,) [m].
        force: of all leaves (D,) [N].
        energy: in all leaves (D,) [J].
        stress: largest at each deflection (D,) [Pa].
        law: the force as a curve.
        width: of one leaf across the plane of bending at its clamp [m].
        layers: of sheet in the stack of one leaf.
        profile: what is cut, ``layers`` times ``count`` of it, in a frame with the lever's pin
            at the origin, the lever coming from -y.
        role: of the part, in plain words.
        sheet: thickness of what is cut [m].
        dimensions: drawn on it.
        shapes: centre lines at -s_max, 0 and s_max in that frame: for each one or more open paths.
        surroundings: what stands round it in that frame.
        mass: of all leaves, blocks and eyes included [kg].
        design, response: further numbers for the report.
        checks, outcomes, plots, assumptions, advice: of the shape.
    """

    deflection: Floats
    force: Floats
    energy: Floats
    stress: Floats
    law: SpringLaw
    width: float
    layers: int
    profile: Profile
    role: str
    sheet: float
    dimensions: tuple[Dimension, ...]
    shapes: tuple[tuple[Floats, ...], ...]
    surroundings: tuple[Shape, ...]
    mass: float
    design: Mapping[str, Value]
    response: Mapping[str, Value]
    checks: tuple[Check, ...]
    outcomes: tuple[Outcome, ...]
    plots: tuple[Plot, ...]
    assumptions: tuple[str, ...]
    advice: tuple[str, ...]

    @property
    def stiffness(self) -> float:
        """Force over deflection at s_max, mean of both directions [N/m]."""
        return self.law.secant_stiffness


@dataclass(frozen=True)
class MadeJoint:
    """Everything that was decided about one joint; SI.

    Attributes:
        spec, case: what it was designed for.
        feasibility: the closed-form checks that it passed before.
        spring: at the lever's end.
    """

    spec: LeverArmSpec
    case: Case
    feasibility: tuple[Check, ...]
    spring: MadeSpring
