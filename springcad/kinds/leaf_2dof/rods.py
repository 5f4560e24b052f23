"""What the two axes together do at the rod, at a few places of the workspace."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.leaf_2dof import wrist
from springcad.kinds.leaf_2dof.case import Setup
from springcad.kinds.leaf_2dof.made import RodState
from springcad.kinds.leaf_2dof.unit import stroke

Floats = NDArray[np.float64]


def rod_states(setup: Setup, angle: float) -> tuple[RodState, ...]:
    """At rest, with one axis turned by the angle, and with both; longest effective length."""
    return tuple(_state(setup, *angles) for angles in ((0.0, 0.0), (angle, 0.0), (angle, angle)))


def _state(setup: Setup, alpha_x: float, alpha_y: float) -> RodState:
    unit = stroke(setup.leaf, setup.lever, setup.longest, np.array([alpha_x, alpha_y]))
    torque, stiffness = setup.leaves * unit.torque, setup.leaves * unit.stiffness
    azimuth, tilt = wrist.spherical(alpha_x, alpha_y)
    output, hessian, paper = np.full(2, np.nan), np.full((2, 2), np.nan), np.full((2, 2), np.nan)
    if tilt > 0.0:  # at rest the azimuth has no value
        derivatives = wrist.spherical_derivatives(alpha_x, alpha_y)
        output = wrist.output_torque(derivatives.first, torque)
        hessian = wrist.output_stiffness(derivatives, torque, stiffness)
        of_paper = wrist.spherical_derivatives_small(alpha_x, alpha_y).first
        paper = wrist.transformed_stiffness(of_paper, stiffness)
    on_rod = wrist.tangent_derivatives(alpha_x, alpha_y)
    return RodState(
        angle=(alpha_x, alpha_y),
        direction=wrist.rod_direction(alpha_x, alpha_y),
        azimuth=float(azimuth) if tilt > 0.0 else np.nan,
        tilt=float(tilt),
        axis_torque=torque,
        axis_stiffness=stiffness,
        output_torque=output,
        spherical_stiffness=hessian,
        paper_stiffness=paper,
        rod_stiffness=wrist.output_stiffness(on_rod, torque, stiffness),
    )


def diagonal_stiffness(setup: Setup, angles: Floats) -> Floats:
    """Stiffness of the rod (A, 2, 2), more tilt first, with both axes turned by the angles (A,)."""
    unit = stroke(setup.leaf, setup.lever, setup.longest, angles)
    torque, stiffness = (
        setup.leaves * np.stack([values, values], axis=-1)
        for values in (unit.torque, unit.stiffness)
    )
    return wrist.output_stiffness(wrist.tangent_derivatives(angles, angles), torque, stiffness)
