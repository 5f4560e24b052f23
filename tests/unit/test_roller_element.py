"""The roller-cam's element as a part that can be cut, and its mesh."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from roller_element_cases import JOINT, LAW, dimensions, joint_with, rigid_profile

from springcad.errors import InfeasibleError
from springcad.geometry.biarc import fit_contour
from springcad.geometry.outline import Curve, Outline
from springcad.geometry.outline_ops import (
    contour_bounds,
    outline_corners,
    profile_area,
    profile_faults,
)
from springcad.geometry.polyline import radii
from springcad.kinds.roller_cam.element import (
    ElementGeometry,
    element_geometry,
    element_profile,
    first_place,
    mount_holes,
    require_room,
)
from springcad.kinds.roller_cam.element_mesh import EDGE_SETS, Density, coarse, element_mesh, fine
from springcad.kinds.roller_cam.synthesis import synthesise
from springcad.kinds.target_law import law_of, polynomial
from springcad.mechanics.fem.blocks import mesh_area, smallest_scaled_jacobian

COARSE = coarse(4e-3)
FINE = fine(4e-3)


def geometry_of(thickness: float = 2e-3) -> ElementGeometry:
    return element_geometry(rigid_profile(), dimensions(thickness))


@pytest.mark.parametrize("thickness", [0.2e-3, 1e-3, 5.5e-3])
def test_the_element_is_a_valid_part_for_the_thicknesses_of_the_paper(thickness: float) -> None:
    assert profile_faults(element_profile(geometry_of(thickness))) == ()


def test_the_outline_is_smooth_but_for_the_corners_of_the_mount() -> None:
    outline = element_profile(geometry_of()).outer
    assert isinstance(outline, Outline)
    turns = np.degrees(outline_corners(outline))
    sharp = np.abs(turns) > 1e-3
    np.testing.assert_allclose(turns[sharp], [90.0] * 4, atol=1e-9)


def test_inside_corners_have_the_radius_of_their_fillets() -> None:
    geometry = geometry_of()
    polyline = fit_contour(element_profile(geometry).outer)
    hollow = (polyline.bulges < -1e-9) & (np.abs(polyline.bulges) < 1.0)
    size = geometry.dimensions
    smallest = float(radii(polyline)[hollow].min())
    assert smallest == pytest.approx(min(size.root_fillet, size.foot_fillet), rel=1e-9)


def test_the_drawn_profile_is_the_synthesised_one() -> None:
    outline = element_profile(geometry_of()).outer
    assert isinstance(outline, Outline)
    (curve,) = (piece for piece in outline.pieces if isinstance(piece, Curve))
    profile = rigid_profile()
    for point in profile.flank.points[::9]:
        assert np.hypot(*(curve.points - point).T).min() < 0.02e-3
    dense = profile.curve.points(np.linspace(0.0, profile.curve.length, 20000))
    inside = curve.points[10:-50]
    distance = np.hypot(*(inside[:, None] - dense[None]).transpose(2, 0, 1)).min(axis=1)
    on_curve = (inside[:, 1] < dense[0, 1]) & (inside[:, 1] > dense[-1, 1])
    assert distance[on_curve].max() < 2e-7


def test_the_element_and_its_mirror_image_keep_their_gap() -> None:
    geometry = geometry_of()
    highest = contour_bounds(element_profile(geometry).outer)[3]
    assert 2.0 * (JOINT.roller.offset - highest) >= geometry.dimensions.gap * (1.0 - 1e-9)
    assert geometry.top == pytest.approx(highest, abs=1e-9)


def test_a_profile_that_begins_beside_the_roller_is_cut_below_its_mirror_image() -> None:
    # a quadratic law begins with no slope: the roller touches with its side, at its own height
    law = law_of(polynomial([0.0, 6e3], 1.9 * np.pi / 180.0), 1.9 * np.pi / 180.0)
    profile = synthesise(JOINT, law)
    assert profile.curve.points(np.zeros(1))[0, 1] == pytest.approx(JOINT.roller.offset)
    place = first_place(profile, dimensions())
    assert place > 0.0
    geometry = element_geometry(profile, dimensions())
    assert geometry.top <= JOINT.roller.offset - 0.5 * dimensions().gap + 1e-12
    assert profile_faults(element_profile(geometry)) == ()


def test_holes_lie_in_the_mount() -> None:
    geometry = geometry_of()
    rear = -JOINT.cantilever.length - geometry.dimensions.mount.length
    centres = np.array([hole.center for hole in mount_holes(geometry)])
    assert centres.shape == (2, 2)
    assert np.all((centres[:, 0] > rear) & (centres[:, 0] < -JOINT.cantilever.length))
    np.testing.assert_allclose(centres.sum(axis=0)[1], 0.0, atol=1e-12)


@pytest.mark.parametrize(
    ("change", "claim"),
    [
        ({"foot_fillet": 5e-3}, "room between the profile's lower end"),
        ({"root_fillet": 6e-3}, "shoulder of the mount"),
        ({"root_fillet": 26e-3}, "length of the cantilever"),
        ({"thickness": 0.05e-3}, "thickness of the contact part"),
    ],
)
def test_what_does_not_fit_is_named(change: dict[str, float], claim: str) -> None:
    geometry = element_geometry(rigid_profile(), replace(dimensions(), **change))
    with pytest.raises(InfeasibleError, match=claim):
        require_room(geometry)


def test_a_larger_offset_makes_room_as_the_message_says() -> None:
    fillet = replace(dimensions(), foot_fillet=2.2e-3)
    low, high = (synthesise(joint_with(40e-3, offset), LAW) for offset in (8.95e-3, 9.95e-3))
    with pytest.raises(InfeasibleError) as failure:
        require_room(element_geometry(low, fillet))
    assert failure.value.remedies == ("raise joint.roller_offset", "lower cantilever.height")
    assert failure.value.value < failure.value.limit == fillet.foot_fillet
    require_room(element_geometry(high, fillet))


@pytest.mark.parametrize("density", [COARSE, FINE])
@pytest.mark.parametrize("thickness", [0.2e-3, 2e-3, 5.5e-3])
def test_the_mesh_covers_the_part_with_good_elements(density: Density, thickness: float) -> None:
    geometry = geometry_of(thickness)
    mesh = element_mesh(geometry, density)
    assert smallest_scaled_jacobian(mesh) > 0.5
    # the mount is meshed to 9.8 mm of its 10 mm, its holes are filled, outer corners are square
    filled = profile_area(replace(element_profile(geometry), inner=()))
    missing = (geometry.dimensions.mount.length - 2.0 * 4.9e-3) * geometry.dimensions.mount.height
    corners = 3.0 * (1.0 - 0.25 * np.pi) * geometry.dimensions.rounding**2
    assert mesh_area(mesh) == pytest.approx(filled - missing + corners, rel=1e-4)


def test_a_profile_too_steep_for_the_mesh_is_refused_with_what_helps() -> None:
    """On a drum of 600 mm the roller runs 20 mm down a nearly upright profile."""
    large = joint_with(600e-3, 30e-3)
    with pytest.raises(InfeasibleError, match="steep") as refused:
        element_mesh(element_geometry(synthesise(large, LAW), dimensions(3e-3)), COARSE)
    assert "lower joint.drum_radius" in refused.value.remedies[0]
    smaller = joint_with(300e-3, 20e-3)
    element_mesh(element_geometry(synthesise(smaller, LAW), dimensions(3e-3)), COARSE)


def test_the_contact_edges_run_down_the_profile() -> None:
    geometry = geometry_of()
    mesh = element_mesh(geometry, COARSE)
    assert set(mesh.edge_sets) == set(EDGE_SETS)
    nodes = mesh.nodes[mesh.node_sets["contact"]]
    assert nodes[0, 1] == pytest.approx(geometry.top, abs=1e-9)
    np.testing.assert_allclose(nodes[-1], geometry.points[-1], atol=1e-9)
    steps = np.diff(nodes, axis=0)
    assert np.all(np.sum(steps[:-1] * steps[1:], axis=1) > 0.0)
    assert np.hypot(*steps.T).max() < 0.55 * COARSE.contact


def test_only_the_mounts_outline_but_for_its_face_is_held_in_a_pocket() -> None:
    geometry = geometry_of()
    mesh = element_mesh(geometry, COARSE)
    x, y = mesh.nodes[mesh.node_sets["held"]].T
    side = 0.5 * geometry.dimensions.mount.height
    on_back = np.isclose(x, x.min())
    assert np.all(on_back | np.isclose(np.abs(y), side))
    assert x.max() == pytest.approx(-geometry.cantilever.length, abs=1e-9)
