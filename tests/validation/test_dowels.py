"""What dowels do to a ring that the root model of one sector leaves out, by finite elements.

Group of sectors that repeats round the ring, with one half-round cut-out that bears on a rigid,
frictionless dowel; every tip carries the same force. S4 has 31 flexures on 8 dowels: its group is
of 4 sectors, as if the dowels were 46.5 and not 45 degrees apart.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray
from rotary_cases import spring_of
from sector_cases import sector_of

from springcad.kinds.rotary_flexure.root_compliance import sector_supports
from springcad.kinds.rotary_flexure.sector_blocks import COARSE
from springcad.kinds.rotary_flexure.sector_mesh import sector_mesh
from springcad.mechanics.fem.assembly import Sheet, edge_load, prepare_solid
from springcad.mechanics.fem.blocks import smallest_scaled_jacobian
from springcad.mechanics.fem.constraints import Equations, solve_constraints, tie
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, prepare_model
from springcad.mechanics.fem.newton import linear_solution
from springcad.mechanics.fem.recovery import nodal_stress, von_mises
from springcad.mechanics.plane import rotated

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

SHEET = Sheet(200e9, 0.3, 4.5e-3)
GROUP = {"S1": 3, "S2": 3, "S3": 3, "S4": 4}
CUT_ELEMENTS = 12
"""Round the half-round cut-out."""


@dataclass(frozen=True)
class Group:
    """Sectors side by side; the cut-out is opposite flexure 0, on the x axis.

    Attributes:
        mesh: nodes of sector k are turned by k pitches.
        ties: of the sectors to each other and of the last to the first; ``tied`` their slaves.
        outer: nodes of the rim's edge without the ``seat``, the nodes of the cut-out.
        normals: at the seat, from the dowel into the rim.
        push: a force of 1 N on every tip, against the direction in which y turns x (2 N,).
    """

    mesh: Mesh
    ties: tuple[Equations, ...]
    tied: Indices
    outer: Indices
    seat: Indices
    normals: Floats
    push: Floats


@dataclass(frozen=True)
class Outcome:
    """Stiffness of the flexures, and the largest stress along the cut-out at full load."""

    stiffness: Floats
    seat_stress: float

    @property
    def mean(self) -> float:
        """Stiffness of the ring over the number of its flexures."""
        return float(np.mean(self.stiffness))


def rim_grid(mesh: Mesh) -> Indices:
    """Node numbers of the block ``rim`` (columns along the edge, rows inwards), -1 at centres."""
    across = len(mesh.edge_sets["outer"])
    rows = 1
    while np.array_equal(
        mesh.elements[(rows - 1) * across : rows * across, 1],
        mesh.elements[rows * across : (rows + 1) * across, 0],
    ):
        rows += 1
    grid = np.full((2 * across + 1, 2 * rows + 1), -1)
    places = [(0, 0), (0, 2), (2, 2), (2, 0), (0, 1), (1, 2), (2, 1), (1, 0)]
    for number, nodes in enumerate(mesh.elements[: rows * across]):
        row, column = divmod(number, across)
        for (along, inwards), node in zip(places, nodes, strict=True):
            grid[2 * column + along, 2 * row + inwards] = node
    return grid


def with_cut_out(mesh: Mesh, outer_radius: float, radius: float) -> tuple[Mesh, Indices]:
    """The sector with a half-round on its outer edge at polar angle 0, and the nodes along it."""
    grid, nodes = rim_grid(mesh), mesh.nodes.copy()
    edge, face = nodes[grid[:, 0]], nodes[grid[:, -1]]
    angles = np.arctan2(edge[:, 1], edge[:, 0])
    middle = 2 * int(np.argmin(np.abs(angles[::2])))
    first, last = middle - CUT_ELEMENTS, middle + CUT_ELEMENTS
    corner = 2.0 * math.asin(0.5 * radius / outer_radius) * np.sign(angles[0])
    # Equal shares of the rest of the edge on either side, of the half-round between.
    moved = angles.copy()
    for part, fixed, end in ((slice(first + 1), 0, first), (slice(last, None), -1, last)):
        share = (angles[part] - angles[fixed]) / (angles[end] - angles[fixed])
        target = corner if end == first else -corner
        moved[part] = angles[fixed] + share * (target - angles[fixed])
    places = outer_radius * np.stack([np.cos(moved), np.sin(moved)], axis=1)
    centre = np.array([outer_radius, 0.0])
    reach = 0.5 * (math.pi - abs(corner)) * np.sign(corner)
    turn = math.pi - reach * np.linspace(1.0, -1.0, last - first + 1)
    places[first : last + 1] = centre + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)

    depth = (
        np.hypot(*(nodes[grid] - edge[:, None]).transpose(2, 0, 1))
        / np.hypot(*(face - edge).T)[:, None]
    )
    used = grid >= 0
    nodes[grid[used]] = (places[:, None] + depth[..., None] * (face - places)[:, None])[used]
    cut = Mesh(nodes, mesh.elements, mesh.node_sets, mesh.edge_sets)
    return cut, grid[first : last + 1, 0]


@cache
def group_of(name: str) -> Group:
    sector, spring = sector_of(name), spring_of(name)
    count, pitch = GROUP[name], 2.0 * math.pi / sector.count
    dowels = spring.spec.mounting.dowels
    assert dowels is not None
    whole = sector_mesh(sector, COARSE)
    cut, seat = with_cut_out(whole, sector.outer_radius, dowels.radius)
    assert smallest_scaled_jacobian(cut) > 0.3
    size = len(whole.nodes)
    sectors = [rotated((whole if k else cut).nodes, np.asarray(k * pitch)) for k in range(count)]
    mesh = Mesh(
        np.concatenate(sectors), np.concatenate([whole.elements + k * size for k in range(count)])
    )
    # The right cut of a sector is the left cut of the next one.
    right, left = whole.node_sets["cut_right"], whole.node_sets["cut_left_turned"]
    ties, last = [], count - 1
    for k in range(count):
        turn = 0.0 if k < last else count * pitch
        ties.append(tie(right + k * size, left + (k + 1) % count * size, turn))
    tied = np.concatenate([right + k * size for k in range(count)])
    outer = np.concatenate([whole.node_sets["outer"] + k * size for k in range(count)])
    away = mesh.nodes[seat] - [sector.outer_radius, 0.0]
    push = edge_load(whole, "tip", np.array([0.0, -1.0])).reshape(-1, 2)
    return Group(
        mesh=mesh,
        ties=tuple(ties),
        tied=tied,
        outer=np.setdiff1d(np.setdiff1d(outer, tied), seat),
        seat=seat,
        normals=away / np.hypot(*away.T)[:, None],
        push=np.concatenate([rotated(push, np.asarray(k * pitch)) for k in range(count)]).ravel(),
    )


def no_displacement_along(nodes: Indices, normals: Floats) -> Equations:
    """n·u = 0 at nodes, solved for the larger component."""
    row = np.arange(len(nodes))
    major = np.argmax(np.abs(normals), axis=1)
    factor = -normals[row, 1 - major] / normals[row, major]
    keep = factor != 0.0
    return Equations(
        2 * nodes + major, np.zeros(len(nodes)), row[keep], (2 * nodes + 1 - major)[keep],
        factor[keep],
    )  # fmt: skip


@cache
def sector_stiffness(name: str, mounting: str) -> float:
    """Tip force over tip displacement of the sector of the root model."""
    sector = sector_of(name)
    mesh = sector_mesh(sector, COARSE)
    supports = sector_supports(mesh, sector.count, mounting)  # type: ignore[arg-type]
    force = edge_load(mesh, "tip", np.array([0.0, -1.0]))
    model = prepare_model(prepare_solid(mesh, SHEET), supports)
    state = linear_solution(model, Load(force, np.zeros(mesh.unknowns)))
    return 1.0 / float(force @ state.displacement)


@cache
def ring(name: str, *, bearing: str, slides: bool) -> Outcome:
    """The ring on its dowels.

    ``bearing`` is where a half-round touches its dowel: all round (``both``), or only on the side
    on which the torque of one direction presses it (``+``, ``-``). ``slides``: the rest of the
    edge neither enters nor leaves the bore; otherwise it is free.
    """
    group = group_of(name)
    along = group.normals[:, 1]
    bears = {"both": along < np.inf, "+": along > 0.02, "-": along < -0.02}[bearing]
    held = [no_displacement_along(group.seat[bears], group.normals[bears])]
    if slides:
        nodes = group.mesh.nodes[group.outer]
        held.append(no_displacement_along(group.outer, nodes / np.hypot(*nodes.T)[:, None]))
    supports = solve_constraints(group.mesh.unknowns, *group.ties, *held)
    model = prepare_model(prepare_solid(group.mesh, SHEET), supports)
    state = linear_solution(model, Load(group.push, np.zeros(group.mesh.unknowns)))
    tips = (group.push * state.displacement).reshape(GROUP[name], -1).sum(axis=1)
    full = max(float(stroke.force[-1]) for stroke in spring_of(name).strokes)
    stress = von_mises(nodal_stress(model.solid, full * state.displacement))[group.seat]
    return Outcome(1.0 / tips, float(stress.max()))


@pytest.mark.parametrize("bearing", ["both", "+", "-"])
@pytest.mark.parametrize("name", GROUP)
def test_between_its_dowels_a_rim_bends_as_one_with_a_free_edge(name: str, bearing: str) -> None:
    found = ring(name, bearing=bearing, slides=False)
    assert found.mean == pytest.approx(sector_stiffness(name, "dowels"), rel=2.5e-3)
    assert found.stiffness == pytest.approx(found.mean, rel=8e-3)


@pytest.mark.parametrize(("name", "softer"), {"S1": 1.9, "S2": 2.0, "S3": 1.1, "S4": 0.4}.items())
def test_a_bore_that_the_rim_can_neither_enter_nor_leave_would_stiffen_it_by_up_to_two_per_cent(
    name: str, softer: float
) -> None:
    for bearing in ("both", "+", "-"):
        free, held = (ring(name, bearing=bearing, slides=s).mean for s in (False, True))
        assert 100.0 * (1.0 - free / held) == pytest.approx(softer, abs=0.2)


@pytest.mark.parametrize("name", GROUP)
def test_the_cut_outs_are_stressed_less_than_the_flexures(name: str) -> None:
    """At full load; the flexures bear 912 MPa, and their root fillets more."""
    for bearing in ("+", "-"):
        assert ring(name, bearing=bearing, slides=False).seat_stress < 0.7 * 912e6
