"""Stresses at integration points, at nodes and along free edges.

In each element the nine Gauss-point values are fitted by a bilinear polynomial in the reference
coordinates, least squares with the Gauss weights; for a quadratic stress that is the same as
sampling at the 2 × 2 points where the 8-node element is superconvergent (Barlow 1976, Int. J.
Numer. Methods Eng. 10). The fit is evaluated at the element's eight nodes, and each node takes the
mean over its elements.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import Solid, deformation, stress
from springcad.mechanics.fem.element import (
    CORNERS,
    MID_SIDES,
    edge_shape_functions,
    gauss_points,
)
from springcad.mechanics.fem.mesh import Mesh

Floats = NDArray[np.float64]

_ON_EDGE = np.array([-1.0, 1.0]) / np.sqrt(3.0)
"""The points on an edge, in its reference coordinate."""


def gauss_stress(solid: Solid, displacement: Floats) -> Floats:
    """Cauchy stress (σ_xx, σ_yy, σ_xy) (3, E, 9) [Pa] at the integration points.

    σ = F S Fᵀ / J with the thickness strain E_zz = −ν/(1 − ν) (E_xx + E_yy) of plane stress in J.
    """
    state = deformation(solid, displacement)
    second = stress(solid.sheet, state.strain)
    nu = solid.sheet.poisson_ratio
    thinning = 1.0 - 2.0 * nu / (1.0 - nu) * (state.strain[0] + state.strain[1])
    xx, xy, yx, yy = state.gradient
    volume = (xx * yy - xy * yx) * np.sqrt(thinning)
    sxx, syy, sxy = second / volume
    return np.stack(
        [
            xx**2 * sxx + xy**2 * syy + 2.0 * xx * xy * sxy,
            yx**2 * sxx + yy**2 * syy + 2.0 * yx * yy * sxy,
            xx * yx * sxx + xy * yy * syy + (xx * yy + xy * yx) * sxy,
        ]
    )


def nodal_stress(solid: Solid, displacement: Floats) -> Floats:
    """Cauchy stress (σ_xx, σ_yy, σ_xy) (3, N) [Pa] at the nodes, recovered and averaged."""
    mesh = solid.mesh
    at_nodes = gauss_stress(solid, displacement) @ _extrapolation().T
    number = mesh.elements.ravel()
    times = np.bincount(number, minlength=len(mesh.nodes))
    total = [np.bincount(number, part.ravel(), minlength=len(mesh.nodes)) for part in at_nodes]
    return np.asarray(np.stack(total) / times)


def edge_stress(solid: Solid, displacement: Floats, edges: str) -> Floats:
    """Cauchy stress along a free edge (K, 2) [Pa], at two points of each of its K elements' edges.

    A free surface is in uniaxial stress: S = E ε with the Green–Lagrange strain ε of the surface,
    σ = S √(1 + 2 ε)/(1 − 2 ν ε). The points are those at which the slope of a quadratic element is
    most accurate.
    """
    mesh, sheet = solid.mesh, solid.sheet
    numbers = mesh.edge_sets[edges]
    _, slope = edge_shape_functions(_ON_EDGE)
    reference = slope @ mesh.nodes[numbers]
    deformed = reference + slope @ displacement.reshape(-1, 2)[numbers]
    strain = 0.5 * (np.sum(deformed**2, axis=-1) / np.sum(reference**2, axis=-1) - 1.0)
    stretch = np.sqrt(1.0 + 2.0 * strain)
    thinning = 1.0 - 2.0 * sheet.poisson_ratio * strain
    return np.asarray(sheet.elastic_modulus * strain * stretch / thinning)


def edge_points(mesh: Mesh, edges: str) -> Floats:
    """Where ``edge_stress`` is told, on the unloaded mesh (K, 2, 2) [m]."""
    value, _ = edge_shape_functions(_ON_EDGE)
    return np.asarray(value @ mesh.nodes[mesh.edge_sets[edges]])


def von_mises(stresses: Floats) -> Floats:
    """Equivalent stress (…) of plane stresses (σ_xx, σ_yy, σ_xy) (3, …) [Pa]."""
    xx, yy, xy = stresses
    return np.asarray(np.sqrt(xx**2 - xx * yy + yy**2 + 3.0 * xy**2))


def _extrapolation() -> Floats:
    """Matrix (8, 9) from the Gauss points to the nodes."""
    points, weights = gauss_points()
    root = np.sqrt(weights)[:, None]
    fit = np.linalg.pinv(_bilinear(points) * root) * root.T
    return np.asarray(_bilinear(np.concatenate([CORNERS, MID_SIDES])) @ fit)


def _bilinear(points: Floats) -> Floats:
    """1, ξ, η, ξη at reference points (G, 2)."""
    x, y = points.T
    return np.stack([np.ones_like(x), x, y, x * y], axis=1)
