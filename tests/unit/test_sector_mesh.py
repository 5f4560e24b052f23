"""The mesh of one sector of the ring: it is the part, closed, valid and cyclic."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from sector_cases import sector_of

from springcad.geometry.outline import Arc, Line, Outline
from springcad.geometry.outline_ops import contour_area, contour_points
from springcad.geometry.panels import panel_grid
from springcad.geometry.ribbon import ORDER, Ribbon
from springcad.geometry.transform import rotate, translate
from springcad.kinds.rotary_flexure.ring import flexure_pieces, largest_fillet
from springcad.kinds.rotary_flexure.sector_blocks import COARSE, FINE
from springcad.kinds.rotary_flexure.sector_mesh import sector_mesh
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry
from springcad.mechanics.fem.blocks import mesh_area, smallest_scaled_jacobian
from springcad.mechanics.fem.mesh import Mesh

SPRINGS = ("S1", "S2", "S3", "S4")
BOUNDARY = (
    "land_right", "fillet_right", "flank_right", "nose", "flank_left", "fillet_left", "land_left",
    "cut_left", "outer", "cut_right",
)  # fmt: skip
"""The sets round the sector, counter-clockwise."""


def exact_outline(sector: SectorGeometry) -> Outline:
    """The sector from the pieces that are cut, flexure frame turned and shifted to the ring's."""
    pieces = flexure_pieces(sector.ribbon, sector.root_radius, sector.fillet, sector.blend)
    placed = [translate(rotate(p, math.pi), sector.root_radius, 0.0) for p in pieces]
    first, last = placed[0], placed[-1]
    assert isinstance(first, Arc)
    assert isinstance(last, Arc)
    root, outer, half = sector.root_radius, sector.outer_radius, math.pi / sector.count
    # Their ends lie on the rim at these angles; the flexure's left is at the smaller one.
    left = math.atan2(*_end(first, 0.0)[::-1])
    right = math.atan2(*_end(last, 1.0)[::-1])
    middle = 0.5 * (left + right)

    def at(radius: float, angle: float) -> tuple[float, float]:
        return radius * math.cos(angle), radius * math.sin(angle)

    low, high = middle - half, middle + half
    return Outline(
        (
            *placed,
            Arc((0.0, 0.0), root, right, high - right),
            Line(at(root, high), at(outer, high)),
            Arc((0.0, 0.0), outer, high, low - high),
            Line(at(outer, low), at(root, low)),
            Arc((0.0, 0.0), root, low, left - low),
        )
    )


def _end(arc: Arc, fraction: float) -> tuple[float, float]:
    angle = arc.start_angle + fraction * arc.sweep
    return (
        arc.center[0] + arc.radius * math.cos(angle),
        arc.center[1] + arc.radius * math.sin(angle),
    )


def bent_ribbon(root_angle: float, bend: float) -> Ribbon:
    """A tapered flexure, root 2.8 mm, that leaves the rim at an angle and with a bend."""
    thickness, length, tip = 2.8e-3, 27.5e-3, 0.175e-3
    pad = length * (2.0 * tip / thickness) ** 2
    edges = np.append(np.linspace(0.0, length - pad, 25), length)
    grid = panel_grid(edges, ORDER)
    half = np.maximum(0.5 * thickness * np.sqrt(1.0 - grid.nodes / length), tip)
    x = np.clip(grid.nodes / (length - pad), 0.0, 1.0)
    curvature = 2.0 * bend / thickness * np.cos(2.2 * np.pi * x) * (1.0 - x) ** 2
    turn = root_angle + grid.weights @ curvature
    curvature -= turn * 30.0 * x**2 * (1.0 - x) ** 2 / (length - pad)
    return Ribbon(edges, curvature, half, root_angle)


@pytest.mark.parametrize("density", [COARSE, FINE], ids=["coarse", "fine"])
@pytest.mark.parametrize("name", SPRINGS)
def test_the_mesh_of_a_published_spring_has_well_shaped_elements(name: str, density) -> None:
    mesh = sector_mesh(sector_of(name), density)
    assert smallest_scaled_jacobian(mesh) > math.sin(math.radians(26.5))
    assert len(mesh.elements) < (900 if density is COARSE else 1700)


@pytest.mark.parametrize("name", SPRINGS)
def test_the_mesh_covers_the_part_as_it_is_cut(name: str) -> None:
    sector = sector_of(name)
    exact = abs(contour_area(exact_outline(sector)))
    coarse, fine = (mesh_area(sector_mesh(sector, d)) / exact - 1.0 for d in (COARSE, FINE))
    assert abs(coarse) < 1e-5
    assert abs(fine) < 2e-6


@pytest.mark.parametrize("name", ["S1", "S3"])
def test_every_free_node_lies_on_the_outline_that_is_cut(name: str) -> None:
    sector = sector_of(name)
    mesh = sector_mesh(sector, FINE)
    outline = shapely.LinearRing(contour_points(exact_outline(sector), 1e-8))
    on_boundary = np.unique(np.concatenate([mesh.node_sets[name] for name in BOUNDARY]))
    distance = shapely.distance(outline, shapely.points(mesh.nodes[on_boundary]))
    assert np.max(distance) < 1.1e-8
    inside = np.setdiff1d(np.arange(len(mesh.nodes)), on_boundary)
    assert np.min(shapely.distance(outline, shapely.points(mesh.nodes[inside]))) > 1e-6


@pytest.mark.parametrize("name", ["S1", "S4"])
def test_the_edge_sets_close_round_the_sector_with_the_material_on_the_left(name: str) -> None:
    mesh = sector_mesh(sector_of(name), COARSE)
    edges = np.concatenate([mesh.edge_sets[name] for name in BOUNDARY])
    assert np.array_equal(edges[:, 2], np.roll(edges[:, 0], -1))
    assert len(np.unique(edges[:, 0])) == len(edges)
    assert _circulation(mesh, edges) == pytest.approx(mesh_area(mesh), rel=1e-12)


def _circulation(mesh: Mesh, edges: np.ndarray) -> float:
    """Area inside quadratic edges by Green's theorem: exact formula for parabolas."""
    start, middle, end = (mesh.nodes[edges[:, k]] for k in range(3))

    def cross(a: np.ndarray, b: np.ndarray) -> float:
        return float(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]))

    return (4.0 * cross(start, middle) + 4.0 * cross(middle, end) - cross(start, end)) / 6.0


@pytest.mark.parametrize("name", SPRINGS)
def test_the_left_cut_turned_by_one_pitch_is_the_right_cut(name: str) -> None:
    sector = sector_of(name)
    mesh = sector_mesh(sector, COARSE)
    pitch = 2.0 * math.pi / sector.count
    turn = np.array([[math.cos(pitch), -math.sin(pitch)], [math.sin(pitch), math.cos(pitch)]])
    left, right = mesh.node_sets["cut_left_turned"], mesh.node_sets["cut_right"]
    assert mesh.nodes[left] @ turn.T == pytest.approx(mesh.nodes[right], abs=1e-15)


def test_the_nose_is_round_and_belongs_to_both_contact_sets() -> None:
    sector = sector_of("S2")
    mesh = sector_mesh(sector, FINE)
    tip = sector.ribbon.at(np.array([sector.ribbon.length]))
    centre = np.array([sector.root_radius - tip.x[0], -tip.y[0]])
    nose = mesh.nodes[mesh.node_sets["nose"]]
    assert np.hypot(*(nose - centre).T) == pytest.approx(tip.half_thickness[0], rel=1e-9)
    left, right = (mesh.edge_sets[f"contact_{side}"] for side in ("left", "right"))
    shared = {tuple(edge) for edge in left} & {tuple(edge) for edge in right}
    assert shared == {tuple(edge) for edge in mesh.edge_sets["nose"]}
    for edges in (left, right):
        assert np.array_equal(edges[:-1, 2], edges[1:, 0])
    section = mesh.nodes[mesh.node_sets["tip"]]
    assert section.mean(axis=0) == pytest.approx(centre, abs=1e-9)
    # Where a cam tooth touches, pad and sides of the nose, elements are short against the tip.
    length = np.hypot(*(mesh.nodes[left[:, 2]] - mesh.nodes[left[:, 0]]).T)
    count = len(mesh.edge_sets["nose"])
    assert length[count - FINE.nose : count + 10].max() < 0.5 * tip.half_thickness[0]
    assert length[count - FINE.nose : count].max() < 0.15 * tip.half_thickness[0]


@pytest.mark.parametrize("rim", [0.3, 3.0])
@pytest.mark.parametrize("bend", [-0.3, 0.0, 0.3])
@pytest.mark.parametrize("degrees", [-28.0, 0.0, 28.0])
@pytest.mark.parametrize("count", [8, 24])
def test_steep_roots_thin_and_thick_rims_and_all_fillets_give_valid_elements(
    degrees: float, bend: float, rim: float, count: int
) -> None:
    ribbon = bent_ribbon(math.radians(degrees), bend)
    largest = largest_fillet(ribbon, 31e-3, count, 5e-5, 1.5e-3)
    for fillet in (1e-4, largest):
        sector = SectorGeometry(ribbon, 31e-3, 31e-3 + rim * 2.8e-3, count, fillet, 0.225e-3)
        mesh = sector_mesh(sector, COARSE)
        assert smallest_scaled_jacobian(mesh) > 0.25
        exact = abs(contour_area(exact_outline(sector)))
        assert mesh_area(mesh) == pytest.approx(exact, rel=2e-5)


def test_a_fillet_that_runs_into_the_neighbour_is_refused() -> None:
    sector = sector_of("S1")
    with pytest.raises(ValueError, match="neighbours"):
        sector_mesh(replace(sector, fillet=3.5e-3), COARSE)
