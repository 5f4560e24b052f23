"""How the real element yields more than a rigid contact part on a clamped beam.

Linear plane-stress finite elements of the whole element are loaded along its profile by patches of
the width of Hertz's strip: a point load would sink in without limit. What they give less what the
beam of the synthesis gives is the compliance of the contact part, and with it that of root, fillets
and mount. It enters the synthesis as a function of the angle at which the roller is there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebfit, chebval
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.kinds.roller_cam.element import (
    ElementDimensions,
    ElementGeometry,
    element_geometry,
    first_place,
)
from springcad.kinds.roller_cam.element_mesh import Density, coarse, element_mesh
from springcad.kinds.roller_cam.joint import Cantilever
from springcad.kinds.roller_cam.synthesis import ContactProfile
from springcad.mechanics.contact import half_width
from springcad.mechanics.fem.assembly import Sheet, prepare_solid
from springcad.mechanics.fem.compliance import compliance
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.element import edge_shape_functions
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Model, prepare_model
from springcad.mechanics.section import SHEAR_CORRECTION

Floats = NDArray[np.float64]

_SAMPLES = 41
"""Points along the profile at which the compliance is computed."""
_DEGREES = (2, 9)
"""Least and greatest degree of the compliance over the place."""
_NARROWEST = 0.01
"""Half width of a strip at least, over that of the patch which stands for it."""
_PATCH_POINTS = 48
"""Points of the midpoint rule over a patch, in the angle whose sine is the place on it."""


@dataclass(frozen=True)
class ProfileCompliance:
    """What the element yields beyond its beam, where the roller touches its profile.

    Attributes:
        angle: at which the roller touches there, ascending (P,) [rad].
        place: along the profile from its first contact, ascending (P,) [m].
        matrix: in the frame of the tip (P, 2, 2) [m/N].
        element: length of the elements along the profile [m].
    """

    angle: Floats
    place: Floats
    matrix: Floats
    element: float

    def at_angle(self, angle: Floats) -> Floats:
        """The compliance (A, 2, 2) over the angle; that of the end beyond the ends."""
        within = np.clip(angle, self.angle[0], self.angle[-1])
        return self.at_place(CubicSpline(self.angle, self.place)(within))

    def at_place(self, place: Floats) -> Floats:
        """The compliance (A, 2, 2) over the place, linear beyond the ends.

        A polynomial, by least squares: its second derivative enters the profile's curvature. Its
        degree is at most one per two elements: what differs between elements is no compliance.
        """
        degree = int(np.clip(np.ptp(self.place) / (2.0 * self.element), *_DEGREES))
        middle, half = 0.5 * (self.place[0] + self.place[-1]), 0.5 * np.ptp(self.place)
        known = self.matrix.reshape(len(self.place), 4)
        coefficients = chebfit((self.place - middle) / half, known, degree)
        x = (place - middle) / half
        within = np.clip(x, -1.0, 1.0)
        beyond = (x - within) * chebval(within, chebder(coefficients))
        return np.asarray((chebval(within, coefficients) + beyond).T.reshape(-1, 2, 2))


def profile_compliance(
    profile: ContactProfile, dimensions: ElementDimensions, density: Density | None = None
) -> ProfileCompliance:
    """Compliance of the element with this profile beyond that of its beam; a coarse mesh will do.

    First contacts that are left out (``first_place``) are left out here too.

    Raises:
        InfeasibleError: the parts of the element do not fit together.
    """
    density = density or coarse(profile.joint.roller.radius)
    geometry = element_geometry(profile, dimensions)
    rows = np.flatnonzero(profile.place >= first_place(profile, dimensions))
    rows = rows[np.unique(np.linspace(0, len(rows) - 1, _SAMPLES).astype(np.intp))]
    flank, beam = profile.flank, profile.joint.cantilever
    strip = half_width(
        flank.force[rows], beam.width, flank.relative_curvature[rows], beam.elastic_modulus
    )
    points = flank.points[rows]
    model = element_model(geometry, density)
    whole = element_compliance(model, points, flank.normals[rows], strip)
    return ProfileCompliance(
        flank.angle[rows],
        profile.place[rows],
        whole - beam_compliance(beam, points),
        density.contact,
    )


def element_model(geometry: ElementGeometry, density: Density) -> Model:
    """The mesh of the element, held as its mounting says."""
    beam, mesh = geometry.cantilever, element_mesh(geometry, density)
    sheet = Sheet(beam.elastic_modulus, beam.poisson_ratio, beam.width)
    if geometry.dimensions.mount.mounting == "plates":
        nodes = np.flatnonzero(mesh.nodes[:, 0] <= -beam.length * (1.0 - 1e-9))
    else:
        nodes = np.unique(mesh.node_sets["held"])
    held = solve_constraints(mesh.unknowns, prescribe(nodes))
    return prepare_model(prepare_solid(mesh, sheet), held)


def element_compliance(model: Model, points: Floats, normals: Floats, strip: Floats) -> Floats:
    """Compliance C (P, 2, 2) [m/N] of the element at points (P, 2) of its profile.

    C F is the displacement under the force F (2,), and Fᵀ C F/2 the energy; the displacement is the
    mean over the strip of contact, weighted by its semi-elliptic pressure. That mean falls with the
    logarithm of the width: a strip narrower than the elements is loaded as wide as they are, one
    that hangs over an end of the profile as wide as there is room, and the difference is made up
    for along its normal (the half plane, Johnson, Contact Mechanics, 2.3).

    Args:
        normals: unit vectors along which the strip is pressed (P, 2).
        strip: half width of the strip (P,) [m]; a hundredth of an element at least
            is taken.
    """
    mesh, sheet = model.solid.mesh, model.solid.sheet
    shares, wide = _patch_shares(mesh, points, strip)
    forces = np.zeros((mesh.unknowns, 2 * len(points)))
    forces[0::2, 0::2] = shares.T
    forces[1::2, 1::2] = shares.T
    whole = compliance(model, forces).reshape(len(points), 2, len(points), 2)
    rows = np.arange(len(points))
    narrower = np.log(wide / np.maximum(strip, _NARROWEST * wide))
    local = 2.0 * narrower / (np.pi * sheet.elastic_modulus * sheet.thickness)
    along = normals[:, :, None] * normals[:, None, :]
    return np.asarray(whole[rows, :, rows, :] + local[:, None, None] * along)


def beam_compliance(beam: Cantilever, points: Floats) -> Floats:
    """Compliance (P, 2, 2) [m/N] at points (P, 2) carried rigidly by the tip of the beam.

    Bending, shear (5/6 of the section), stretch and the turning of the clamp; the force at (x, y)
    has the moment M = x F_y - y F_x about the tip, and moves with its rotation.
    """
    length, bending, root = beam.length, beam.bending_stiffness, beam.root_compliance
    section = beam.width * beam.height
    tip = np.array(
        [
            [length / (beam.elastic_modulus * section), 0.0, 0.0],
            [
                0.0,
                length**3 / (3.0 * bending)
                + length / (SHEAR_CORRECTION * beam.shear_modulus * section)
                + root * length**2,
                length**2 / (2.0 * bending) + root * length,
            ],
            [0.0, length**2 / (2.0 * bending) + root * length, length / bending + root],
        ]
    )
    carry = np.zeros((len(points), 3, 2))
    carry[:, 0, 0] = carry[:, 1, 1] = 1.0
    carry[:, 2] = np.column_stack([-points[:, 1], points[:, 0]])
    return np.asarray(carry.transpose(0, 2, 1) @ tip @ carry)


def _patch_shares(mesh: Mesh, points: Floats, strip: Floats) -> tuple[Floats, Floats]:
    """Shares (P, N) of the nodes in unit loads on patches round the points; half widths (P,)."""
    edges = mesh.edge_sets["contact"]
    ends = mesh.nodes[edges]
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T) + np.hypot(*(ends[:, 2] - ends[:, 1]).T)
    corners = np.concatenate([[0.0], np.cumsum(lengths)])
    angles = np.pi * ((np.arange(_PATCH_POINTS) + 0.5) / _PATCH_POINTS - 0.5)
    weights = 2.0 / _PATCH_POINTS * np.cos(angles) ** 2
    shares, wide = np.zeros((len(points), len(mesh.nodes))), strip.copy()
    for row, point in enumerate(points):
        middle, shortest = _place(ends, corners, point)
        wide[row] = max(min(strip[row], middle, corners[-1] - middle), shortest)
        places = np.clip(middle + wide[row] * np.sin(angles), 0.0, corners[-1])
        edge = np.clip(np.searchsorted(corners, places, side="right") - 1, 0, len(edges) - 1)
        local = 2.0 * (places - corners[edge]) / lengths[edge] - 1.0
        value = edge_shape_functions(local)[0] * weights[:, None]
        np.add.at(shares[row], edges[edge].ravel(), value.ravel())
    return shares, wide


def _place(ends: Floats, corners: Floats, point: Floats) -> tuple[float, float]:
    """Length along the contact edges to the foot of a point, and the length of the edge there."""
    chord = ends[:, 2] - ends[:, 0]
    along = np.clip(np.sum((point - ends[:, 0]) * chord, axis=1) / np.sum(chord**2, axis=1), 0, 1)
    away = np.hypot(*(ends[:, 0] + along[:, None] * chord - point).T)
    edge = int(np.argmin(away))
    length = corners[edge + 1] - corners[edge]
    return float(corners[edge] + along[edge] * length), float(length)
