"""Blocks of quadratic elements: spacing, transfinite interpolation, joining, quality."""

from __future__ import annotations

import numpy as np
import pytest

from springcad.mechanics.fem.blocks import (
    chain,
    edge_nodes,
    graded,
    join,
    mesh_area,
    scaled_jacobians,
    smallest_scaled_jacobian,
    spaced,
    straight,
    transfinite,
    with_middles,
)
from springcad.mechanics.fem.mesh import Mesh


def quadrilateral(corners: list[list[float]], a: int, b: int, ratio: float = 1.0) -> np.ndarray:
    """Block on a straight-sided quadrilateral, corners counter-clockwise."""
    p = np.array(corners, dtype=float)
    u, v = graded(a), graded(b, ratio)
    return transfinite(
        straight(p[0], p[1], u), straight(p[3], p[2], u),
        straight(p[0], p[3], v), straight(p[1], p[2], v),
    )  # fmt: skip


def ring_block(inner: float, outer: float, sweep: float, count: int) -> np.ndarray:
    """Block on a sector of a ring, ``count`` x ``count`` elements."""
    angle = sweep * graded(count)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    out = graded(count, 2.0)
    return transfinite(
        straight(inner * circle[0], outer * circle[0], out),
        straight(inner * circle[-1], outer * circle[-1], out),
        inner * circle,
        outer * circle,
    )


def circulation_area(mesh: Mesh, names: list[str]) -> float:
    """Area inside a closed boundary of quadratic edges, by Green's theorem."""
    total = 0.0
    for name in names:
        p = mesh.nodes[mesh.edge_sets[name]]
        for x, w in zip(*np.polynomial.legendre.leggauss(3), strict=True):
            at = np.array([0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)]) @ p
            along = np.array([x - 0.5, -2.0 * x, x + 0.5]) @ p
            total += 0.5 * w * np.sum(at[:, 0] * along[:, 1] - at[:, 1] * along[:, 0])
    return float(total)


def test_graded_elements_form_a_geometric_sequence_with_their_middles_halfway() -> None:
    nodes = graded(5, 16.0)
    lengths = np.diff(nodes[::2])
    assert nodes[0] == 0.0
    assert nodes[-1] == pytest.approx(1.0, abs=1e-15)
    assert lengths[-1] / lengths[0] == pytest.approx(16.0, rel=1e-12)
    assert lengths[1:] / lengths[:-1] == pytest.approx(2.0, rel=1e-12)
    assert nodes[1::2] == pytest.approx(0.5 * (nodes[:-2:2] + nodes[2::2]), abs=1e-15)


def test_spacing_follows_the_wanted_sizes_and_never_exceeds_them() -> None:
    positions = np.linspace(0.0, 1.0, 2000)
    corners = spaced(positions, 0.01 + 0.2 * positions)
    lengths = np.diff(corners)
    assert corners[0] == 0.0
    assert corners[-1] == pytest.approx(1.0, abs=1e-12)
    assert np.all(lengths <= 0.01 + 0.2 * corners[1:])
    # The local ratio to the wanted size is the same everywhere.
    ratio = lengths / (0.01 + 0.1 * (corners[1:] + corners[:-1]))
    assert np.ptp(ratio) < 0.01 * ratio.mean()


def test_even_sizes_that_divide_the_span_are_kept() -> None:
    assert spaced(np.linspace(0.0, 1.0, 50), np.full(50, 0.25)) == pytest.approx(
        np.linspace(0.0, 1.0, 5), abs=1e-12
    )
    assert len(with_middles(np.array([0.0, 1.0, 3.0]))) == 5


def test_a_straight_sided_block_is_the_bilinear_map() -> None:
    corners = np.array([[0.0, 0.0], [2.0, 0.3], [2.5, 1.8], [-0.2, 1.1]])
    block = quadrilateral(corners.tolist(), 3, 4, ratio=3.0)
    u, v = np.meshgrid(graded(3), graded(4, 3.0), indexing="ij")
    weights = np.stack([(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v], axis=-1)
    assert block == pytest.approx(weights @ corners, abs=1e-14)


def test_lines_across_a_graded_ring_stay_straight_and_radial() -> None:
    block = ring_block(1.0, 1.5, 1.2, 4)
    angles = np.arctan2(block[..., 1], block[..., 0])
    radii = np.hypot(block[..., 0], block[..., 1])
    assert angles == pytest.approx(np.broadcast_to(1.2 * graded(4), angles.shape), abs=1e-14)
    assert np.ptp(radii, axis=1).max() < 1e-14


def test_sides_that_do_not_meet_are_refused() -> None:
    u = graded(1)
    a, b, c, d = (np.array(p) for p in ([0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]))
    with pytest.raises(ValueError, match="do not meet"):
        transfinite(
            straight(a, b, u), straight(d, c, u), straight(a, d, u), straight(b, c + 1e-3, u)
        )


def test_the_area_of_a_ring_sector_converges_with_the_fourth_order() -> None:
    exact = 0.5 * 1.2 * (1.5**2 - 1.0)
    errors = [
        abs(mesh_area(join({"a": ring_block(1.0, 1.5, 1.2, n)}, {})) / exact - 1.0)
        for n in (2, 4, 8)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    # A parabola through three points of an arc of angle a lacks the share a^4 / 480 of its sector.
    assert errors[-1] == pytest.approx((1.2 / 8.0) ** 4 / 480.0, rel=0.01)
    assert np.all(np.abs(orders - 4.0) < 0.1)


def test_joined_blocks_share_their_nodes_and_keep_their_boundary_in_order() -> None:
    left = quadrilateral([[0, 0], [1, 0], [1, 2], [0, 2]], 2, 3)
    right = quadrilateral([[1, 0], [3, 0], [3, 2.5], [1, 2]], 4, 3)
    mesh = join(
        {"left": left, "right": right},
        {
            "bottom": [("left", "south"), ("right", "south")],
            "end": [("right", "east")],
            "top": [("right", "north"), ("left", "north")],
            "start": [("left", "west")],
            "between": [("left", "east")],
        },
    )
    # A grid of 6 x 3 serendipity elements: 7 x 4 corners and 6 x 4 + 7 x 3 mid-sides.
    assert len(mesh.nodes) == 28 + 45
    assert len(mesh.elements) == 18
    assert mesh_area(mesh) == pytest.approx(2.0 + 4.5, rel=1e-14)
    outside = ["bottom", "end", "top", "start"]
    assert circulation_area(mesh, outside) == pytest.approx(mesh_area(mesh), rel=1e-13)
    for name, following in zip(outside, outside[1:] + outside[:1], strict=True):
        assert mesh.edge_sets[name][-1, 2] == mesh.edge_sets[following][0, 0]
        edges = mesh.edge_sets[name]
        assert np.array_equal(edges[:-1, 2], edges[1:, 0])
    assert mesh.nodes[mesh.node_sets["between"], 0] == pytest.approx(1.0, abs=1e-15)
    assert np.array_equal(mesh.node_sets["bottom"], edge_nodes(mesh.edge_sets["bottom"]))


def test_element_nodes_run_counter_clockwise_with_mid_sides_after_the_corners() -> None:
    mesh = join({"a": quadrilateral([[0, 0], [2, 0], [2, 1], [0, 1]], 1, 1)}, {})
    expected = [[0, 0], [2, 0], [2, 1], [0, 1], [1, 0], [2, 0.5], [1, 1], [0, 0.5]]
    assert mesh.nodes[mesh.elements[0]] == pytest.approx(np.array(expected), abs=1e-15)


@pytest.mark.parametrize("degrees", [30.0, 60.0, 90.0, 135.0])
def test_the_scaled_jacobian_of_a_parallelogram_is_the_sine_of_its_angle(degrees: float) -> None:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    mesh = join({"a": quadrilateral([[0, 0], [3, 0], [3 + c, s], [c, s]], 2, 2)}, {})
    assert scaled_jacobians(mesh) == pytest.approx(s, abs=1e-13)


def test_a_block_that_is_inside_out_or_flat_is_refused() -> None:
    with pytest.raises(ValueError, match="inside out"):
        join({"a": quadrilateral([[0, 0], [0, 1], [1, 1], [1, 0]], 2, 2)}, {})
    with pytest.raises(ValueError, match="inside out"):
        join({"a": quadrilateral([[0, 0], [1, 0], [0.2, 0.2], [0, 1]], 1, 1)}, {})
    with pytest.raises(ValueError, match="inside out"):
        join({"a": quadrilateral([[0, 0], [1, 0], [2, 0], [0, 1]], 1, 1)}, {})


def test_chained_curves_have_each_joint_once() -> None:
    u = graded(2)
    a, b, c = np.array([0.0, 0.0]), np.array([1.0, 0.0]), np.array([1.0, 1.0])
    path = chain(straight(a, b, u), straight(b, c, u))
    assert len(path) == 9
    assert np.all(np.hypot(*np.diff(path, axis=0).T) > 0.0)
    assert smallest_scaled_jacobian(join({"a": ring_block(1.0, 2.0, 1.0, 1)}, {})) > 0.9
