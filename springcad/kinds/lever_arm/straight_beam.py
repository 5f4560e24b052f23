"""A straight leaf pushed aside at its eye, on the nonlinear beam.

The lever's pin is held in a shuttle that a straight guide leads across the leaf; in the shuttle the
pin slides freely along the leaf. So the force on the eye stays across the leaf at rest and the
eye turns freely. Closed forms: ``springcad.mechanics.leaf``; what they leave out is here: large
deflection, shear, the eye, the fillet and the least web.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lever_arm.straight import StraightLeaf, half_seen, joints
from springcad.mechanics.beam import BeamStates, PreparedBeam, RibbonBeam, prepare
from springcad.mechanics.dead_load import dead_load
from springcad.mechanics.leaf import SHAPES, stiffness
from springcad.mechanics.section import area

Floats = NDArray[np.float64]

_PANELS = 8
"""Along the leaf between its fillets."""
_MAX_ITERATIONS = 30
_TOLERANCE = 1e-11
"""Of a deflection, relative."""


@dataclass(frozen=True)
class Elastic:
    """Elastic constants: E [Pa] and Poisson's ratio."""

    elastic_modulus: float
    poisson_ratio: float

    @property
    def shear_modulus(self) -> float:
        """G of the isotropic material [Pa]."""
        return self.elastic_modulus / (2.0 * (1.0 + self.poisson_ratio))


@dataclass(frozen=True)
class LeafStates:
    """One leaf at D deflections.

    Attributes:
        deflection: across (D,) [m].
        force: across (D,) [N].
        energy: elastic (D,) [J].
        place: distance from the pin along the leaf at rest, ascending (N,) [m].
        stress: |M| h/(2 I) + |N|/A at those places, without notch (D, N) [Pa].
        points: of the centre line at those places, in the frame of the part: x, and y the
            deflection (D, N, 2) [m].
    """

    deflection: Floats
    force: Floats
    energy: Floats
    place: Floats
    stress: Floats
    points: Floats

    @property
    def peak_stress(self) -> Floats:
        """Largest along the leaf (D,) [Pa]."""
        return np.asarray(self.stress.max(axis=1))

    @property
    def stiffness(self) -> float:
        """Force over deflection at the last deflection [N/m]."""
        return float(self.force[-1] / self.deflection[-1])


def leaf_beam(leaf: StraightLeaf, material: Elastic) -> PreparedBeam:
    """The leaf from its clamp to its pin.

    What bends out of the sheet has its width vary, which the beam does not know: it is given the
    thickness that makes EI(x) that of the leaf. Shear and stretch, 1e-4 of bending there, are then
    those of that thickness.
    """
    length = leaf.length
    inner = joints(leaf)
    fine = np.linspace(inner[2], inner[3], _PANELS + 1)[1:-1]
    edges = length - np.unique(np.concatenate([inner, fine]))[::-1]
    edges[0], edges[-1] = 0.0, length

    def half_thickness(stations: Floats) -> Floats:
        half = half_seen(leaf, length - stations)
        if leaf.bends_in_sheet:
            return half
        return 0.5 * leaf.thickness * np.cbrt(2.0 * half / leaf.width)

    return prepare(
        RibbonBeam(
            panel_edges=edges,
            curvature=np.zeros_like,
            half_thickness=half_thickness,
            root_angle=0.0,
            thickness=leaf.width,
            elastic_modulus=material.elastic_modulus,
            shear_modulus=material.shear_modulus,
        )
    )


def leaf_states(leaf: StraightLeaf, material: Elastic, deflection: Floats) -> LeafStates:
    """The leaf at deflections (D,) other than 0, of any sign.

    Raises:
        ArithmeticError: no state is found; the leaf is bent far beyond its strength.
    """
    beam = leaf_beam(leaf, material)
    closed = stiffness(
        SHAPES[leaf.shape], material.elastic_modulus, leaf.width, leaf.length, leaf.thickness
    )
    force, states = _pushed(beam, leaf.length, float(closed), np.asarray(deflection, np.float64))
    order = np.argsort(-states.stations[0], kind="stable")
    return LeafStates(
        deflection=states.end_position[:, 1],
        force=force,
        energy=states.energy,
        place=leaf.length - states.stations[0, order],
        stress=_stress(leaf, states)[:, order],
        points=states.positions[:, order] * [-1.0, 1.0] + [leaf.length, 0.0],
    )


def _pushed(
    beam: PreparedBeam, length: float, guess: float, deflection: Floats
) -> tuple[Floats, BeamStates]:
    """Forces (D,) that give the deflections (D,), by secants through 0 and through the last two."""
    force, last = guess * deflection, np.zeros_like(deflection)
    reached = np.zeros_like(deflection)
    for _ in range(_MAX_ITERATIONS):
        states = dead_load(beam, length, np.column_stack([np.zeros_like(force), force]))
        now = states.end_position[:, 1]
        error = deflection - now
        if np.all(np.abs(error) <= _TOLERANCE * np.abs(deflection)):
            return force, states
        moved = np.abs(now - reached) > _TOLERANCE * np.abs(deflection)
        compliance = np.where(moved, (now - reached) / np.where(moved, force - last, 1.0), 1.0)
        step = np.where(moved, error / np.where(moved, compliance, 1.0), 0.0)
        last, reached, force = force, now, force + step
    raise ArithmeticError("no force was found that bends the leaf so far")


def _stress(leaf: StraightLeaf, states: BeamStates) -> Floats:
    """On the edge, of bending and axial force (D, N)."""
    if leaf.bends_in_sheet:
        return states.nominal_stress
    width = 2.0 * half_seen(leaf, leaf.length - states.stations)
    bending = 6.0 * np.abs(states.moment) / (width * leaf.thickness**2)
    return np.asarray(bending + np.abs(states.axial_force) / area(leaf.thickness, 0.5 * width))
