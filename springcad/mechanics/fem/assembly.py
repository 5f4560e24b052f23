"""Energy, forces and stiffness of a plane-stress sheet under large displacements.

Total Lagrangian: Green–Lagrange strain E = (FᵀF − 1)/2 and the St. Venant–Kirchhoff law
S = λ̄ tr(E) 1 + 2μ E in plane stress, λ̄ = Eν/(1 − ν²), per reference area and thickness. It is the
law that CalculiX uses for *ELASTIC with NLGEOM. It differs from other laws with the same E and ν by
about the strain: half a per cent of the stress at a strain of half a per cent, of opposite sign on
the two sides of a bent ribbon, so that its bending stiffness is the same to the strain squared.

All elements are treated at once: arrays run over elements (E), integration points (G = 9, full
3 × 3 rule) and nodes of the element (8).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.element import edge_shape_functions, gauss_points, shape_functions
from springcad.mechanics.fem.mesh import Mesh

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Sheet:
    """Isotropic elastic sheet: E [Pa], ν, thickness [m]."""

    elastic_modulus: float
    poisson_ratio: float
    thickness: float

    @property
    def lame(self) -> tuple[float, float]:
        """(λ̄, μ) of plane stress [Pa]."""
        nu = self.poisson_ratio
        shear = 0.5 * self.elastic_modulus / (1.0 + nu)
        return self.elastic_modulus * nu / (1.0 - nu**2), shear


@dataclass(frozen=True)
class Solid:
    """A mesh of sheet with what its elements need; made by ``prepare_solid``.

    Attributes:
        gradients: ∂N_a/∂X_K at the integration points (E, G, 2, 8) [1/m].
        weights: volume of each integration point, sheet thickness included (E, G) [m³].
    """

    mesh: Mesh
    sheet: Sheet
    gradients: Floats
    weights: Floats


@dataclass(frozen=True)
class Deformation:
    """Fields at the integration points; components as separate arrays (E, G).

    Attributes:
        gradient: (F_xx, F_xy, F_yx, F_yy), F_iK = ∂x_i/∂X_K, along the first axis (4, E, G).
        strain: (E_xx, E_yy, 2 E_xy) (3, E, G).
    """

    gradient: Floats
    strain: Floats


def prepare_solid(mesh: Mesh, sheet: Sheet) -> Solid:
    """Evaluate the shape functions of every element.

    Raises:
        ValueError: an element is turned inside out or has an edge folded over.
    """
    points, rule = gauss_points()
    derivatives = shape_functions(points)[1]
    nodal = mesh.nodes[mesh.elements]
    (ax, bx), (ay, by) = (
        (derivatives.reshape(-1, 8) @ nodal)
        .reshape(len(nodal), len(rule), 2, 2)
        .transpose(3, 2, 0, 1)
    )
    determinant = ax * by - ay * bx
    if np.any(determinant <= 0.0):
        bad = np.flatnonzero(np.any(determinant <= 0.0, axis=1))
        raise ValueError(f"element {bad[0]} has no positive area everywhere ({len(bad)} such)")
    along, across = derivatives.transpose(1, 0, 2)
    inverse = (1.0 / determinant)[..., None]
    gradients = np.empty((*determinant.shape, 2, 8))
    gradients[:, :, 0] = (by[..., None] * along - ay[..., None] * across) * inverse
    gradients[:, :, 1] = (ax[..., None] * across - bx[..., None] * along) * inverse
    return Solid(mesh, sheet, gradients, determinant * rule * sheet.thickness)


def deformation(solid: Solid, displacement: Floats) -> Deformation:
    """Deformation gradient and Green–Lagrange strain of nodal displacements (2 N,) [m]."""
    count, points = solid.weights.shape
    nodal = displacement.reshape(-1, 2)[solid.mesh.elements]
    gradient = (solid.gradients.reshape(count, 2 * points, 8) @ nodal).reshape(count, points, 4)
    xx, yx, xy, yy = np.ascontiguousarray(gradient.transpose(2, 0, 1))
    strain = np.stack(
        [
            xx + 0.5 * (xx**2 + yx**2),
            yy + 0.5 * (xy**2 + yy**2),
            xy + yx + xx * xy + yx * yy,
        ]
    )
    return Deformation(np.stack([1.0 + xx, xy, yx, 1.0 + yy]), strain)


def linear_strain(solid: Solid, at: Deformation, change: Floats) -> Floats:
    """First-order change (3, E, G) of the Green–Lagrange strain under a displacement (2 N,)."""
    moved = deformation(solid, change).gradient
    xx, xy, yx, yy = at.gradient
    dxx, dxy, dyx, dyy = moved[0] - 1.0, moved[1], moved[2], moved[3] - 1.0
    return np.stack(
        [xx * dxx + yx * dyx, xy * dxy + yy * dyy, xx * dxy + xy * dxx + yx * dyy + yy * dyx]
    )


def stress(sheet: Sheet, strain: Floats) -> Floats:
    """Second Piola–Kirchhoff stress (S_xx, S_yy, S_xy) (3, …) [Pa] of (E_xx, E_yy, 2 E_xy)."""
    lam, mu = sheet.lame
    trace = lam * (strain[0] + strain[1])
    return np.stack([trace + 2.0 * mu * strain[0], trace + 2.0 * mu * strain[1], mu * strain[2]])


def strain_energy(solid: Solid, state: Deformation) -> float:
    """Elastic energy of the solid [J]."""
    density = 0.5 * np.sum(stress(solid.sheet, state.strain) * state.strain, axis=0)
    return float(np.sum(density * solid.weights))


def internal_force(solid: Solid, state: Deformation) -> Floats:
    """Gradient of the strain energy with respect to the nodal displacements (2 N,) [N]."""
    count, points = solid.weights.shape
    xx, xy, yx, yy = state.gradient
    sxx, syy, sxy = stress(solid.sheet, state.strain) * solid.weights
    nominal = np.stack(
        [xx * sxx + xy * sxy, yx * sxx + yy * sxy, xx * sxy + xy * syy, yx * sxy + yy * syy],
        axis=-1,
    ).reshape(count, 2 * points, 2)
    nodal = solid.gradients.reshape(count, 2 * points, 8).transpose(0, 2, 1) @ nominal
    return _sum_at_nodes(solid.mesh, nodal)


def stiffness_blocks(solid: Solid, state: Deformation, stresses: Floats) -> Floats:
    """Element stiffness ∂²W/∂u² [N/m], (E, 8, 3, 8): for every node its blocks (xx, xy, yy).

    ``stresses`` (3, E, G) enter the geometric part; ``stress`` of the strain of ``state`` for the
    exact second derivative.
    """
    count, points = solid.weights.shape
    lam, mu = solid.sheet.lame
    f = state.gradient.reshape(2, 2, count, points)
    left = f[0, 0] * f[:, 0] + f[0, 1] * f[:, 1], f[1, 0] * f[:, 0] + f[1, 1] * f[:, 1]
    sxx, syy, sxy = stresses
    second = ((sxx, sxy), (sxy, syy))
    moduli = np.empty((count, points, 2, 3, 2))
    for block, (i, j) in enumerate(((0, 0), (0, 1), (1, 1))):
        for k in range(2):
            for m in range(2):
                # ∂P_iK/∂F_jL = λ̄ F_iK F_jL + μ (F_iL F_jK + b_ij δ_KL) + S_KL δ_ij, b = F Fᵀ
                modulus = lam * f[i, k] * f[j, m] + mu * f[i, m] * f[j, k]
                if k == m:
                    modulus += mu * left[i][j]
                if i == j:
                    modulus += second[k][m]
                moduli[:, :, k, block, m] = solid.weights * modulus
    nominal = moduli.reshape(count, points, 6, 2) @ solid.gradients
    test = solid.gradients.reshape(count, 2 * points, 8).transpose(0, 2, 1)
    return (test @ nominal.reshape(count, 2 * points, 24)).reshape(count, 8, 3, 8)


def block_product(solid: Solid, blocks: Floats, vector: Floats) -> Floats:
    """The assembled stiffness of ``stiffness_blocks`` times a vector (2 N,)."""
    nodal = vector.reshape(-1, 2)[solid.mesh.elements][..., None]
    xx, xy, yy = blocks.transpose(2, 0, 1, 3)
    x = xx @ nodal[:, :, 0] + xy @ nodal[:, :, 1]
    y = xy.transpose(0, 2, 1) @ nodal[:, :, 0] + yy @ nodal[:, :, 1]
    return _sum_at_nodes(solid.mesh, np.concatenate([x, y], axis=2))


def _sum_at_nodes(mesh: Mesh, nodal: Floats) -> Floats:
    """Add vectors at the nodes of the elements (E, 8, 2) up to (2 N,)."""
    number = 2 * mesh.elements[..., None] + np.arange(2)
    total = np.bincount(number.ravel(), nodal.ravel(), minlength=mesh.unknowns)
    return np.asarray(total, dtype=np.float64)


def edge_load(mesh: Mesh, edges: str, force: Floats) -> Floats:
    """Nodal forces (2 N,) of a force (2,) [N] spread evenly over the length of an edge set."""
    numbers = mesh.edge_sets[edges]
    x, w = np.polynomial.legendre.leggauss(3)
    value, slope = edge_shape_functions(x)
    length = w * np.hypot(*np.einsum("ga,kai->ikg", slope, mesh.nodes[numbers]))
    share = np.einsum("kg,ga->ka", length, value) / length.sum()
    nodal = np.zeros_like(mesh.nodes)
    np.add.at(nodal, numbers.ravel(), share.ravel()[:, None] * np.asarray(force))
    return nodal.ravel()
