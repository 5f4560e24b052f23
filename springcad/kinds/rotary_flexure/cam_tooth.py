"""The stress at the root of a camshaft's teeth: plane finite elements of one of them.

The teeth are as high as they are thick, and the tips push them close to their roots: beam theory,
even with shear and a notch factor, is off by a fifth (docs/theory/camshaft.md). One sector of the
camshaft as drawn, pushed as all others are, is a mesh of a thousand elements.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.polyline import BulgePolyline, rotate_vectors
from springcad.kinds.judging import snapped
from springcad.kinds.rotary_flexure.drawn_flank import drawn_flank
from springcad.kinds.rotary_flexure.root_compliance import surface_stress
from springcad.mechanics.conjugate import Flank
from springcad.mechanics.fem.assembly import Sheet, prepare_solid
from springcad.mechanics.fem.blocks import graded, join, straight, transfinite
from springcad.mechanics.fem.constraints import prescribe, solve_constraints, tie
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, prepare_model
from springcad.mechanics.fem.newton import linear_solution

Floats = NDArray[np.float64]

INSIDE = 0.4
"""Radius at which the core is held, over that of the slots' bottoms."""
ALONG, ACROSS, INWARD = 64, 16, 12
"""Elements along a side of the tooth, across it, and from the slots' bottoms to the core: the
largest stress is within 2 % of that of twice as many."""
SMALLEST = 0.15
"""Radial length of the outermost element of the core over that of the innermost."""


@dataclass(frozen=True)
class Pushed:
    """Stress along the surface of a tooth, on both of its sides.

    Attributes:
        radius: distance from the centre (K,) [m].
        stress: along the surface (K,) [Pa].
    """

    radius: Floats
    stress: Floats


def tooth_root_stress(
    drawn: BulgePolyline, flank: Flank, sheet: Sheet, *, count: int, foot_radius: float
) -> float:
    """Largest stress along the bottoms of the slots under the last contact of a flank, Pa.

    Args:
        drawn: outer contour of the camshaft (m).
        foot_radius: where the round bottoms begin; nearer to the contact a tooth bears what Hertz's
            pressure says.

    Not a number where the tooth has no valid mesh.
    """
    try:
        mesh = tooth_mesh(drawn, count)
    except ValueError:
        return float("nan")
    turn = np.array([flank.direction * np.pi / count])
    point, normal = (rotate_vectors(v[-1:], turn)[0] for v in (flank.points, flank.normals))
    pushed = tooth_stress(mesh, sheet, count, float(flank.force[-1]) * normal, point)
    return snapped(float(np.max(np.abs(pushed.stress[pushed.radius <= foot_radius]))))


def tooth_stress(mesh: Mesh, sheet: Sheet, count: int, force: Floats, point: Floats) -> Pushed:
    """Stress along both sides of a tooth when all are pushed alike; small displacements.

    Args:
        mesh: of ``tooth_mesh``.
        force: on each tooth (2,) [N]; it acts at the node of its side that is nearest to ``point``.
    """
    # Sides run round their block: the left one inwards, the right one outwards.
    left, right = mesh.node_sets["cut_left"][::-1], mesh.node_sets["cut_right"]
    inside = np.unique(mesh.node_sets["inside"])
    free = ~np.isin(left, inside)
    model = prepare_model(
        prepare_solid(mesh, sheet),
        solve_constraints(
            mesh.unknowns, prescribe(inside), tie(left[free], right[free], 2.0 * np.pi / count)
        ),
    )
    sides = mesh.node_sets["sides"]
    nearest = sides[np.argmin(np.hypot(*(mesh.nodes[sides] - point).T))]
    load = np.zeros(mesh.unknowns)
    load[2 * nearest : 2 * nearest + 2] = force
    state = linear_solution(model, Load(load, np.zeros(mesh.unknowns)))
    middles = mesh.nodes[mesh.edge_sets["sides"][:, 1]]
    stress = surface_stress(mesh, sheet.elastic_modulus, state.displacement, "sides")
    return Pushed(np.hypot(*middles.T), stress.mean(axis=1))


def tooth_mesh(drawn: BulgePolyline, count: int, along: int = ALONG, across: int = ACROSS) -> Mesh:
    """A sector of the camshaft about one tooth on the x axis; sets sides, cuts and inside.

    Raises:
        ValueError: the sides are such that an element would be turned inside out.
    """
    low, high = (_resampled(side, along) for side in tooth_sides(drawn, count))
    first = max(_steep(low), _steep(high))
    width = graded(across)
    cut = straight(low[first], high[first], width)
    blocks = {
        "tooth": transfinite(low[first:], high[first:], cut, straight(low[-1], high[-1], width))
    }
    inner, foot = INSIDE * float(np.hypot(*low[0])), np.linspace(0.0, 1.0, first + 1)
    angles = [_polar(point) for point in (low[0], low[first], high[first], high[0])]
    tops = {"right": low[: first + 1], "middle": cut, "left": high[: first + 1][::-1]}
    spacing = {"right": foot, "middle": width, "left": foot}
    for i, (name, outer) in enumerate(tops.items()):
        circle = _arc(inner, angles[i], angles[i + 1], spacing[name])
        south, north = (straight(circle[k], outer[k], graded(INWARD, SMALLEST)) for k in (0, -1))
        blocks[name] = transfinite(south, north, circle, outer)
    return join(
        blocks,
        {
            "sides": [
                ("left", "east"), ("tooth", "north"), ("right", "east"), ("tooth", "south")
            ],
            "cut_right": [("right", "south")],
            "cut_left": [("left", "north")],
            "inside": [(name, "west") for name in tops],
        },
    )  # fmt: skip


def tooth_sides(drawn: BulgePolyline, count: int) -> tuple[Floats, Floats]:
    """The right and the left side (M, 2) of a tooth about the x axis, from slot bottom to tip.

    The right one, of negative y, is the flank of direction −1, the left one that of +1.
    """
    half = np.pi / count
    right = drawn_flank(drawn, -1).points
    left = np.concatenate([right[:1], drawn_flank(drawn, 1).points[::-1]])
    return (
        rotate_vectors(right, np.full(len(right), -half)),
        rotate_vectors(left, np.full(len(left), half)),
    )


def _resampled(side: Floats, count: int) -> Floats:
    """Corners and middles (2 count + 1, 2) of equal elements along a side."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(side, axis=0).T))])
    at = length[-1] * graded(count)
    return np.column_stack([np.interp(at, length, column) for column in side.T])


def _steep(side: Floats) -> int:
    """First corner at which a side rises from the slot's bottom by 45 deg; the tooth begins."""
    along, outwards = np.diff(side, axis=0), side[:-1]
    rising = np.sum(along * outwards, axis=1) / np.hypot(*along.T) / np.hypot(*outwards.T)
    steep = int(np.argmax(rising > np.sqrt(0.5)))
    return steep + steep % 2


def _arc(radius: float, start: float, end: float, fractions: Floats) -> Floats:
    angle = start + fractions * (end - start)
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def _polar(point: Floats) -> float:
    return float(np.arctan2(point[1], point[0]))
