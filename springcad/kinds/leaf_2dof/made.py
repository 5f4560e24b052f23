"""Finished leaves, before anything is said about them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Profile
from springcad.kinds.leaf_2dof.case import Case, Setup
from springcad.kinds.leaf_2dof.limits import Reach
from springcad.kinds.leaf_2dof.parts import Planform
from springcad.kinds.leaf_2dof.spec import Leaf2dofSpec
from springcad.kinds.leaf_2dof.unit import UnitStroke
from springcad.result import Check

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class RodState:
    """The rod with the axes turned by α_x and α_y, at the longest effective length; SI.

    Attributes:
        angle: α_x, α_y.
        direction: of the rod (3,).
        tilt, azimuth: of the rod; azimuth nan at rest.
        axis_torque, axis_stiffness: of the two axes (2,).
        output_torque: by azimuth and tilt (2,); nan at rest.
        spherical_stiffness: Hessian of the energy by azimuth and tilt (2, 2); nan at rest.
        paper_stiffness: Eq. 22 of 003 with its own J, which lacks the geometric term; nan at rest.
        rod_stiffness: against more tilt and sideways, tangent-plane coordinates (2, 2).
    """

    angle: tuple[float, float]
    direction: Floats
    tilt: float
    azimuth: float
    axis_torque: Floats
    axis_stiffness: Floats
    output_torque: Floats
    spherical_stiffness: Floats
    paper_stiffness: Floats
    rod_stiffness: Floats


@dataclass(frozen=True)
class MadeLeaves:
    """Everything that was decided about one axis and what it does; SI.

    Attributes:
        spec, case: what it was designed for.
        feasibility: the closed-form checks that hold to the end.
        setup: leaf, lever and lengths.
        strokes: of one leaf at P lengths, each to its limit or the deflection (P, A).
        lengths: at which limits are known (N,), from the shortest to the longest.
        reach: by design stress and bend angle, at these lengths.
        yield_reach: by the yield strength alone.
        planform: of the leaf.
        profile: the leaf as a part.
        rods: at rest, with one axis turned, and with both.
        diagonal: stiffness of the rod (A, 2, 2) with both axes turned alike, over the angles of
            the longest stroke.
        boundary: tip of the rod round its workspace (M, 3).
        mass: of one leaf.
    """

    spec: Leaf2dofSpec
    case: Case
    feasibility: tuple[Check, ...]
    setup: Setup
    strokes: UnitStroke
    lengths: Floats
    reach: Reach
    yield_reach: Reach
    planform: Planform
    profile: Profile
    rods: tuple[RodState, ...]
    diagonal: Floats
    boundary: Floats
    mass: float

    @property
    def full(self) -> UnitStroke:
        """The stroke at the longest length (A,)."""
        return at_length(self.strokes, -1)


def at_length(strokes: UnitStroke, index: int) -> UnitStroke:
    """The stroke (A,) at one of the lengths."""
    return UnitStroke(**{name: values[index] for name, values in vars(strokes).items()})
