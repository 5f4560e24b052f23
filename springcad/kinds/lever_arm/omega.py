"""The omega leaf: a curved leaf spring inside a cylindrical enclosure (paper 000, II-D, III-D).

Frame of the enclosure: origin in its centre, y along the lever's line at rest, x across. The
lever comes from -y and holds the middle of the leaf, its hub, at (0, y_A); it moves the hub to
(u, y_A), |u| <= stroke, and lets it turn. The leaf is symmetric about x = 0: each half runs from
the hub to the wall, |B| + h/2 = R_c, where it is clamped. The right half (x > 0) is described;
the left one is its mirror image. All forces are of the whole spring, both halves together, and per
width or of a width as said.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.ribbon import Ribbon

Floats = NDArray[np.float64]
Topology = Literal["omega", "free"]


@dataclass(frozen=True)
class OmegaCase:
    """What an omega leaf must fit and stand, SI.

    Attributes:
        enclosure_radius: R_c of the cylinder's inside.
        stroke: s_max, to both sides.
        corridor: width of the lever with the room that it needs. It begins half its width below
            the middle of the hub, with a round end about a point one width below the middle, and
            moves with the lever, see ``arms``.
        arms: shortest and longest distance from the hub to the lever's pivot. At the hub's
            displacement u the corridor's centre, at the depth d below the hub, is taken to lie
            anywhere between u (1 - d/arm) for the two arms, 0 beyond the pivot.
        middle: lowest and highest y_A; equal if the mechanism fixes it.
        hub_radius: rigid disc about the middle, from which both halves leave radially; 0 for
            an ideal joint of the two halves.
        min_web: smallest thickness of the leaf in the plane.
        min_gap: smallest gap between parts of the leaf, to the wall and to the corridor, at rest
            and through the whole stroke. Towards the clamp the gap to the wall closes.
        elastic_modulus, poisson_ratio, allowable_stress: of the material.
        topology: ``omega`` bends to one side only along each half; ``free`` may fold.
        bend_limit: largest |curvature| x thickness.
        taper_limit: largest |dh/ds|.
    """

    enclosure_radius: float
    stroke: float
    elastic_modulus: float
    poisson_ratio: float
    allowable_stress: float
    min_web: float
    min_gap: float
    corridor: float = 12e-3
    arms: tuple[float, float] = (5e-3, 45e-3)
    middle: tuple[float, float] = (0.0, 40e-3)
    hub_radius: float = 0.0
    topology: Topology = "free"
    bend_limit: float = 0.5
    taper_limit: float = 0.5

    @property
    def shear_modulus(self) -> float:
        """G of the isotropic material."""
        return self.elastic_modulus / (2.0 * (1.0 + self.poisson_ratio))


@dataclass(frozen=True)
class OmegaLeaf:
    """One half of the leaf, from the hub's edge to the wall; everything else follows from it.

    Attributes:
        angle_coefficients: of the tangent angle theta(s), a clamped uniform cubic B-spline over
            the half's length, from the x axis, rad.
        thickness_coefficients: of the full thickness h(s), a clamped uniform quadratic B-spline
            with as many spans, m.
        length: of the half, m.
        middle: y_A, m.
        hub_radius: m; the half begins at the hub's edge, (0, y_A) + hub_radius (cos, sin) theta(0).
    """

    angle_coefficients: Floats
    thickness_coefficients: Floats
    length: float
    middle: float
    hub_radius: float


@dataclass(frozen=True)
class OmegaSpread:
    """How the local optima of the linear search spread.

    Attributes:
        starts: searches made, restarts near the best among them.
        stiffness: k/b of every search that met all requirements, best first, N/m per m.
    """

    starts: int
    stiffness: Floats

    @property
    def feasible(self) -> int:
        """Searches that met every requirement."""
        return len(self.stiffness)

    def quantile(self, share: float) -> float:
        """k/b that ``share`` of the feasible searches stay below, N/m per m."""
        return float(np.quantile(self.stiffness, share))


@dataclass(frozen=True)
class OmegaDesign:
    """The leaf that was found, and how.

    Attributes:
        case: what was asked for.
        leaf: the half spring, corrected on the nonlinear beam: its peak stress over the stroke to
            either side is the allowable one.
        stiffness: force of the whole spring at the stroke, over stroke and width, N/m per m
            (= Pa), on the nonlinear beam.
        linear_leaf, linear_stiffness: the best leaf before the correction and its k/b.
        spread: of the linear search."""

    case: OmegaCase
    leaf: OmegaLeaf
    stiffness: float
    linear_leaf: OmegaLeaf
    linear_stiffness: float
    spread: OmegaSpread


@dataclass(frozen=True)
class OmegaResponse:
    """The whole spring of a width at D displacements of the hub, on the nonlinear beam.

    Stations (S,) run along the right half from the hub to the wall. ``right`` and ``left`` are
    the centre lines in the enclosure's frame. Stress is (|M| h/2I K + |N|/A) (1 + h'^2/4): the
    larger of both edges, with the curved-beam factor K, along the tapered edge.

    Attributes:
        displacement: u of the hub (D,), ascending through 0, m.
        force: that the lever exerts along x (D,), N.
        side_force: along y, that holds the hub on its line; of second order in u (D,), N.
        rotation: of the hub (D,), rad.
        energy: stored in the spring (D,), J.
        stations: (S,), m.
        thickness: at the stations (S,), m.
        right, left: (D, S, 2), m.
        right_stress, left_stress: (D, S), Pa.
        self_gap: smallest gap between parts of the leaf that face each other, its other half
            included (D,), m; infinite where none do.
        wall_gap: smallest distance to the wall, away from the clamps (D,), m.
        corridor_gap: smallest distance to the lever's corridor (D,), m.
    """

    displacement: Floats
    force: Floats
    side_force: Floats
    rotation: Floats
    energy: Floats
    stations: Floats
    thickness: Floats
    right: Floats
    left: Floats
    right_stress: Floats
    left_stress: Floats
    self_gap: Floats
    wall_gap: Floats
    corridor_gap: Floats

    @property
    def peak_stress(self) -> Floats:
        """Largest stress of both halves at each displacement (D,)."""
        return np.asarray(np.maximum(self.right_stress.max(axis=1), self.left_stress.max(axis=1)))


def find_omega(
    case: OmegaCase,
    *,
    starts: int = 40,
    seed: int = 1,
    progress: Callable[[str], None] = lambda _: None,
) -> OmegaDesign:
    """The stiffest leaf found from ``starts`` seeded starts, corrected on the nonlinear beam.

    Raises:
        InfeasibleError: no search met the requirements, or no correction did.
    """
    from springcad.kinds.lever_arm.omega_search import find

    return find(case, starts, seed, progress)


def omega_response(
    leaf: OmegaLeaf, case: OmegaCase, width: float, displacements: Floats
) -> OmegaResponse:
    """The spring of ``width`` (stacked layers), m, at the given displacements (D,) of the hub.

    Raises:
        ArithmeticError: no equilibrium found: the leaf buckles.
    """
    from springcad.kinds.lever_arm.omega_response import response

    return response(leaf, case, width, displacements)


def half_ribbon(leaf: OmegaLeaf) -> Ribbon:
    """The right half as a ribbon from the hub's edge to the wall.

    The ribbon's frame has its origin at the hub's edge, ``half_start(leaf)``, and the axes of the
    enclosure. ``Ribbon.boundary`` gives its left and right edge with tangents; ``Ribbon.length``
    is the half's length.
    """
    from springcad.kinds.lever_arm.omega_form import ribbon

    return ribbon(leaf)


def half_start(leaf: OmegaLeaf) -> Floats:
    """Where the right half leaves the hub, (2,), m."""
    angle = float(leaf.angle_coefficients[0])
    along = leaf.hub_radius * np.array([np.cos(angle), np.sin(angle)])
    return np.array([0.0, leaf.middle]) + along
