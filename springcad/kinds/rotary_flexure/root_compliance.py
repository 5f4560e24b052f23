"""How the rim, the root and its fillets change the stiffness of a flexure, and where it is weakest.

A beam ends at the root radius in a rigid clamp. The real flexure ends in fillets, which stiffen
it, and in an elastic rim, which softens it. Linear plane-stress finite elements of one sector
under a tip force give both at once, and the stress in the fillets with them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.judging import snapped
from springcad.kinds.rotary_flexure.sector_blocks import COARSE, Density
from springcad.kinds.rotary_flexure.sector_mesh import sector_mesh
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry
from springcad.mechanics.beam import PreparedBeam, follower_load
from springcad.mechanics.fem.assembly import Sheet, edge_load, prepare_solid
from springcad.mechanics.fem.constraints import (
    Constraints,
    Equations,
    prescribe,
    solve_constraints,
    tie,
)
from springcad.mechanics.fem.element import edge_shape_functions
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, prepare_model
from springcad.mechanics.fem.newton import linear_solution

Floats = NDArray[np.float64]

Mounting = Literal["bore", "dowels"]
"""How the housing holds the outer edge of the rim:

- ``bore``: every point of it is fixed (press fit).
- ``dowels``: the edge as a whole does not turn, the torque being taken evenly round it, and it is
  free to bend. The flexures bend a rim away from its bore by a few micrometres at full load, less
  than the play of a sliding fit, so that the bore does not support it between the dowels.

Whole rings of the shipped specs with half-round cut-outs that bear on rigid dowels come within
0.25 % of the stiffness of ``dowels``, and no flexure differs by more than 0.7 % from their mean
(linear finite elements). In a bore without any play they would be up to 0.4 % stiffer.
"""


def root_unit(elastic_modulus: float, thickness: float, root_thickness: float) -> float:
    """Root compliance of the coefficient 1, 1/(E t h^2) (rad/(N m)), h in the plane."""
    return 1.0 / (elastic_modulus * thickness * root_thickness**2)


@dataclass(frozen=True)
class RootModel:
    """What a clamped beam lacks.

    Attributes:
        compliance: rotation of the beam's root per moment that makes its deflection under a tip
            force that of the finite elements [rad/(N m)]; negative where large fillets stiffen
            the flexure more than the rim softens it.
        fillet_stress_factor: largest stress along the root fillets over the beam's nominal stress
            at the root (bending and axial), under the same force.
    """

    compliance: float
    fillet_stress_factor: float


def root_model(
    beam: PreparedBeam, sector: SectorGeometry, mounting: Mounting, density: Density = COARSE
) -> RootModel:
    """Root compliance and fillet stress of one flexure of the ring.

    With a force normal to the flexure at the centre of its nose, station S = length of the ribbon,
    C = C_beam + (c_fe - c_beam) / a^2, where c = 2 U / F^2 is the compliance at the tip, U the
    elastic energy, a = M_root / F the lever of the force about the root and C_beam the root
    compliance that ``beam`` has already (usually 0). So the beam with the root compliance C has
    exactly the tip compliance of the finite elements, whatever the beam's own error is.

    Args:
        beam: of the same flexure (``flexure_beam(sector.ribbon, ...)``).
        sector: as it is cut.
        mounting: of the rim.
        density: of the mesh; with the default the tip compliance is within 0.03 % and the stress
            factor within 1 % of those of a mesh eight times as fine, for fillets of 0.1 root
            thicknesses and more.

    The last few roots are remembered: a sizing asks for the same one again.

    Raises:
        ValueError: no valid mesh, or no such fillet.
    """
    return _root_model(_Root(beam, sector, mounting, density))


def forget_roots() -> None:
    """Whoever measures times starts afresh."""
    _root_model.cache_clear()


@dataclass(frozen=True, eq=False)
class _Root:
    """What a root model follows from; two are equal if all their numbers are."""

    beam: PreparedBeam
    sector: SectorGeometry
    mounting: Mounting
    density: Density

    def _numbers(self) -> tuple[object, ...]:
        ribbon, sheet, sector = self.sector.ribbon, self.beam.beam, self.sector
        arrays = (ribbon.edges, ribbon.curvature, ribbon.half_thickness, self.beam.curvature)
        lengths = (sector.root_radius, sector.outer_radius, sector.fillet, sector.blend)
        elastic = (sheet.elastic_modulus, sheet.shear_modulus, sheet.root_compliance)
        return (
            *(values.tobytes() for values in (*arrays, self.beam.half_thickness)),
            *(ribbon.root_angle, sheet.thickness, sector.count, self.mounting, self.density),
            *lengths,
            *elastic,
        )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Root) and self._numbers() == other._numbers()

    def __hash__(self) -> int:
        return hash(self._numbers())


@lru_cache(maxsize=16)
def _root_model(root: _Root) -> RootModel:
    beam, sector, mounting, density = root.beam, root.sector, root.mounting, root.density
    modulus = beam.beam.elastic_modulus
    poisson_ratio = 0.5 * modulus / beam.beam.shear_modulus - 1.0
    mesh = sector_mesh(sector, density)
    solid = prepare_solid(mesh, Sheet(modulus, poisson_ratio, beam.beam.thickness))
    supports = sector_supports(mesh, sector.count, mounting)
    end = sector.ribbon.at(np.array([sector.ribbon.length]))
    # In the ring's frame the normal of the flexure points the other way.
    normal = np.array([math.sin(end.angle[0]), -math.cos(end.angle[0])])
    load = Load(edge_load(mesh, "tip", normal), np.zeros(mesh.unknowns))
    state = linear_solution(prepare_model(solid, supports), load)

    # Small enough for the beam to be linear: a strain of 1e-7 at the root.
    section = beam.beam.thickness * sector.root_thickness**2 / 6.0
    force = 1e-7 * modulus * section / sector.ribbon.length
    bent = follower_load(beam, sector.ribbon.length, 0.0, force)
    lever = float(bent.root_moment[0]) / force
    extra = 2.0 * (state.energy - float(bent.energy[0]) / force**2)
    largest = max(
        float(np.max(np.abs(surface_stress(mesh, modulus, state.displacement, edges))))
        for edges in ("fillet_left", "fillet_right")
    )
    return RootModel(
        compliance=snapped(beam.beam.root_compliance + extra / lever**2),
        fillet_stress_factor=snapped(largest * force / float(bent.nominal_stress[0, 0])),
    )


def sector_supports(mesh: Mesh, count: int, mounting: Mounting) -> Constraints:
    """Mounting and cyclic symmetry of a sector of ``count``; mesh as of ``sector_mesh``."""
    pitch = 2.0 * math.pi / count
    left, right = mesh.node_sets["cut_left_turned"], mesh.node_sets["cut_right"]
    outer = mesh.node_sets["outer"]
    if mounting == "bore":
        inside = ~np.isin(right, outer)
        parts = [prescribe(outer), tie(right[inside], left[inside], pitch)]
    else:
        parts = [_no_turning(mesh), tie(right, left, pitch)]
    return solve_constraints(mesh.unknowns, *parts)


def _no_turning(mesh: Mesh) -> Equations:
    """No mean tangential displacement of the outer edge."""
    outer = mesh.node_sets["outer"]
    share = edge_load(mesh, "outer", np.array([1.0, 0.0]))[::2][outer]
    x, y = (mesh.nodes[outer] / np.hypot(*mesh.nodes[outer].T)[:, None]).T
    components = np.concatenate([2 * outer, 2 * outer + 1])
    factors = np.concatenate([-share * y, share * x])
    slave = len(outer) + len(outer) // 2
    others = np.arange(len(components)) != slave
    return Equations(
        components[[slave]],
        np.zeros(1),
        np.zeros(int(others.sum()), dtype=np.intp),
        components[others],
        -factors[others] / factors[slave],
    )


def surface_stress(mesh: Mesh, elastic_modulus: float, displacement: Floats, edges: str) -> Floats:
    """Stress along a free edge (K, 2) [Pa], at two points of each of its K elements' edges.

    A free surface is in uniaxial stress, so it is E times the stretch of the surface, linear in
    the displacements (2 N,). The points are those at which the slope of a quadratic element is
    most accurate.
    """
    numbers = mesh.edge_sets[edges]
    _, slope = edge_shape_functions(np.array([-1.0, 1.0]) / math.sqrt(3.0))
    along = slope @ mesh.nodes[numbers]
    change = slope @ displacement.reshape(-1, 2)[numbers]
    stretch = np.sum(along * change, axis=-1) / np.sum(along**2, axis=-1)
    return np.asarray(elastic_modulus * stretch)
