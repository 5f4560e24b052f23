"""Finite-element mesh of one sector of the ring: a flexure, its root fillets and its piece of rim.

The blocks of ``sector_blocks`` are joined; the mesh is given in the ring's frame, where the flexure
lies on the positive x axis and points to the centre. "Left" and "right" are those of the flexure
looked at from its root.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.rotary_flexure.flexure_contact import global_points
from springcad.kinds.rotary_flexure.sector_blocks import Density, sector_blocks
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry, sector_skeleton
from springcad.mechanics.fem.blocks import Side, edge_nodes, join
from springcad.mechanics.fem.mesh import Mesh

Indices = NDArray[np.intp]

CONTACT_REACH = 8.0
"""The contact edges begin this many tip half thicknesses before the nose."""

EDGE_SETS: dict[str, tuple[tuple[str, Side], ...]] = {
    "outer": (("rim", "west"),),
    "cut_left": (("land left", "north"), ("rim", "north")),
    "cut_right": (("rim", "south"), ("land right", "south")),
    "land_left": (("land left", "east"),),
    "land_right": (("land right", "east"),),
    "fillet_left": (("upper left", "north"), ("lower left", "east")),
    "fillet_right": (("lower right", "east"), ("upper right", "south")),
    "flank_left": (("flexure", "north"), ("start left", "north")),
    "flank_right": (("start right", "south"), ("flexure", "south")),
    "nose": (("nose right", "south"), ("nose front", "east"), ("nose left", "north")),
    "tip": (("flexure", "east"),),
}
"""The sides of blocks along the boundary, with the material on the left; ``tip`` is inside. At
most one of the blocks ``start left`` and ``start right`` exists."""


def sector_mesh(sector: SectorGeometry, density: Density) -> Mesh:
    """Mesh of the sector between two cuts through the rim, midway to the neighbours' fillets.

    Edge sets, and node sets of the same names in the same order: ``outer``; ``cut_left``,
    ``cut_right``; ``land_left``, ``land_right`` (rim between cut and fillet); ``fillet_left``,
    ``fillet_right``; ``flank_left``, ``flank_right``; ``nose``; ``contact_left``,
    ``contact_right`` (the end of a flank and the whole nose); ``tip`` (the section through the
    centre of the nose, inside the part). Node set ``cut_left_turned`` has those nodes of
    ``cut_left`` that lie, turned by one pitch, on the nodes of ``cut_right`` one by one.

    Raises:
        ValueError: there is no such root fillet, the fillets of neighbours run into each other, or
            an element would be turned inside out.
    """
    skeleton = sector_skeleton(sector)
    blocks = sector_blocks(sector, density, skeleton)
    sides = {
        name: [(block, side) for block, side in pieces if block in blocks]
        for name, pieces in EDGE_SETS.items()
    }
    placed = {name: global_points(block, sector.root_radius) for name, block in blocks.items()}
    return _with_contact_edges(join(placed, sides), CONTACT_REACH * skeleton.nose.radius)


def _with_contact_edges(mesh: Mesh, reach: float) -> Mesh:
    """The mesh with ``contact_left`` and ``contact_right``, and the cut's nodes in pairs."""
    sets, nodes = dict(mesh.edge_sets), dict(mesh.node_sets)
    nose, left, right = sets["nose"], sets["flank_left"], sets["flank_right"]

    def near(edges: Indices, end: int) -> NDArray[np.bool_]:
        away = mesh.nodes[edges[:, 1]] - mesh.nodes[end]
        return np.asarray(np.hypot(*away.T) < reach)

    sets["contact_left"] = np.concatenate([nose, left[near(left, nose[-1, 2])]])
    sets["contact_right"] = np.concatenate([right[near(right, nose[0, 0])], nose])
    for name in ("contact_left", "contact_right"):
        nodes[name] = edge_nodes(sets[name])
    nodes["cut_left_turned"] = nodes["cut_left"][::-1]
    return Mesh(mesh.nodes, mesh.elements, nodes, sets)
