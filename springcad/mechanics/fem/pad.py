"""Peak pressure between a straight edge of sheet and a rigid profile, resolved by finite elements.

A strip of contact is often narrower than the elements of a model of the whole part, which then
gives the force and the place of the contact but not its pressure. Here a block of the part behind
the strip is pressed against the same profile with the same force, on elements much smaller than
the strip. Unlike Hertz's formula this knows how the curvature changes along the profile and how
deep the part is.

Strains are small and the friction is none, as in Hertz's theory: only then is a rigid profile on
a sheet of the combined modulus the same as two elastic bodies. Of all pressures that push and add
up to the force, the true one has the least complementary energy (Johnson, Contact Mechanics, 5.8).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.contact import half_width
from springcad.mechanics.fem.assembly import Sheet, prepare_solid
from springcad.mechanics.fem.blocks import join, spaced, with_middles
from springcad.mechanics.fem.compliance import compliance
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.element import edge_shape_functions
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import prepare_model
from springcad.mechanics.fem.rigid_profile import Projection, RigidProfile, project

Floats = NDArray[np.float64]

LENGTH = 2.0
"""The block reaches this many of its depths to either side of the strip."""
STRAIGHT = 3.0
"""Only so many half widths of the strip to either side can the profile touch: beyond, the edge of
the real part may turn away, as at a round nose, where the block goes straight on."""
UNIFORM = 1.5
"""Elements are equally long up to this many half widths of the strip to either side."""
GROWTH = 0.5
"""Beyond, and into the depth, they grow by no more than this per length."""
MIDDLE = 0.6
"""The peak is fitted to the pressures within this share of the half width."""
MARGIN = 2
"""A strip nearer to an end of the profile than this many elements runs off it."""

WIDEST = 0.7
"""Widest half width of a strip over half the depth of the block."""
_PASSES = 4
_MAX_CHANGES = 100


@dataclass(frozen=True)
class PadContact:
    """Pressure between pad and profile.

    Attributes:
        peak_pressure: top of the parabola through the squares of the pressures in the middle of
            the strip, by least squares [Pa]. The square of Hertz's pressure is a parabola, and no
            single node decides. Infinite where the strip runs off an end of the profile, whose
            edge then cuts into the pad: no mesh has a limit for that.
        half_width: half the length on which the pad is pressed, to half an element [m].
        places, pressures: along the pad, from the given point and in the direction of the profile,
            linear between them (C,) [m], [Pa].
    """

    peak_pressure: float
    half_width: float
    places: Floats
    pressures: Floats

    def largest_within(self, share: float) -> float:
        """Largest pressure within a share of the half width about the middle of the strip [Pa].

        Where the curvature jumps within the strip its square is no parabola. Infinite as
        ``peak_pressure`` is.
        """
        ends = self.places[self.pressures > 0.0][[0, -1]]
        inside = np.abs(self.places - ends.mean()) < 0.5 * share * np.ptp(ends)
        largest = float(np.max(self.pressures[inside]))
        return largest if np.isfinite(self.peak_pressure) else np.inf


@dataclass(frozen=True)
class _Surface:
    """The edge of the block and its C pressures, which are linear between corner nodes.

    Attributes:
        corners: places of the pressures (C,) [m].
        pushes: nodal forces (2 N, C) of unit pressures [m²].
        areas: force of unit pressures (C,) [m²].
        openings: gap to the profile before it is pressed, weighted with each pressure (C,) [m³].
    """

    corners: Floats
    pushes: Floats
    areas: Floats
    openings: Floats


def pad_pressure(
    profile: RigidProfile,
    point: Floats,
    force: float,
    *,
    half_thickness: float,
    sheet: Sheet,
    elements: int = 8,
) -> PadContact:
    """Press a pad with a straight edge on a rigid profile, tangent to it at its place of contact.

    The pad is a block of depth 2 ``half_thickness`` that is held at its far side. Where the strip
    is narrow against the depth d and the curvature changes little over it, the result is that of
    Hertz's formula; the held far side raises the peak by (b/d)²/3 for half widths b <= 0.3 d. The
    real edge must be straight for twice the half width to either side.

    Args:
        profile: convex near the place; as drawn, with all changes of its curvature.
        point: place of the contact (2,), on the profile or near it, in its frame [m].
        force: normal to the profile [N], > 0.
        sheet: of the pad. With the combined modulus E* (``contact_modulus``) as its E, the
            profile stands for an elastic body too: in plane stress the contact modulus of a sheet
            on a rigid body is its E.
        elements: on the half width after Hertz. With 8 the peak is within 0.5 % of that of finer
            meshes.

    Raises:
        ValueError: the profile is not convex at the place, the force does not push, or the strip
            is wider than 0.35 depths.
        ArithmeticError: no pressure without penetration was found.
    """
    near = project(profile, point)
    strip = _expected_half_width(profile, near, force, half_thickness, sheet)
    mesh = _block(strip, 2.0 * half_thickness, elements)
    origin = point - near.gap * near.normal

    def gaps(places: Floats) -> Floats:
        away = project(profile, origin + places[..., None] * near.tangent).gap
        away = np.where(np.abs(places) < STRAIGHT * strip, away, half_thickness)
        return np.minimum(away, half_thickness)  # beyond the ends of the profile it is infinite

    surface = _surface(mesh, sheet.thickness, gaps)
    held = solve_constraints(mesh.unknowns, prescribe(mesh.node_sets["far side"]))
    pad = prepare_model(prepare_solid(mesh, sheet), held)
    pressures = _least_energy(compliance(pad, surface.pushes), surface, force)
    beyond = gaps(surface.corners) >= half_thickness
    return _pad_contact(surface.corners, pressures, beyond)


def _expected_half_width(
    profile: RigidProfile, near: Projection, force: float, half_thickness: float, sheet: Sheet
) -> float:
    """After Hertz, for the curvature that the profile has over the strip as a whole (m).

    Arcs of a drawing change their curvature within a strip, from one to the next even to none.
    """
    widest = WIDEST * half_thickness
    on_profile = profile.curve(near.place)
    reach = widest
    for _ in range(_PASSES):
        ends = project(profile, on_profile + reach * np.stack([near.tangent, -near.tangent]))
        curvature = 2.0 * float(np.mean(np.minimum(ends.gap, reach))) / reach**2
        if not (force > 0.0 and curvature > 0.0):
            raise ValueError("a contact strip needs a positive force on a convex profile")
        reach = float(half_width(force, sheet.thickness, curvature, sheet.elastic_modulus))
        if reach > widest:
            raise ValueError("the contact strip is too wide for the depth of the pad")
    return reach


def _block(strip: float, depth: float, elements: int) -> Mesh:
    """The pad, its edge along x with the strip about 0, its far side at y = ``depth``."""

    def nodes(reach: float, uniform: float) -> Floats:
        dense = np.linspace(0.0, reach, 4000)
        return with_middles(
            spaced(dense, strip / elements + GROWTH * np.maximum(dense - uniform, 0.0))
        )

    side = nodes(LENGTH * depth, UNIFORM * strip)
    along = np.concatenate([-side[:0:-1], side])
    grid = np.stack(np.meshgrid(along, nodes(depth, 0.0), indexing="ij"), axis=-1)
    return join({"pad": grid}, {"surface": [("pad", "south")], "far side": [("pad", "north")]})


def _surface(mesh: Mesh, thickness: float, gaps: Callable[[Floats], Floats]) -> _Surface:
    """What unit pressures, one at each corner node of the edge, do to the nodes."""
    edges = mesh.edge_sets["surface"]
    x, w = np.polynomial.legendre.leggauss(3)
    value, slope = edge_shape_functions(x)
    linear = 0.5 * np.stack([1.0 - x, 1.0 + x], axis=1)
    places = mesh.nodes[edges, 0] @ value.T
    area = thickness * w * (mesh.nodes[edges, 0] @ slope.T)
    ends = np.arange(len(edges))[:, None] + np.arange(2)
    count = len(edges) + 1

    def at_corners(values: Floats) -> Floats:
        shares = np.einsum("kg,gb->kb", area * values, linear)
        return np.asarray(np.bincount(ends.ravel(), shares.ravel(), minlength=count))

    pushes = np.zeros((mesh.unknowns, count))
    shares = np.einsum("kg,ga,gb->kab", area, value, linear)
    np.add.at(pushes, (2 * edges[:, :, None] + 1, ends[:, None, :]), shares)
    corners = mesh.nodes[np.append(edges[:, 0], edges[-1, 2]), 0]
    return _Surface(corners, pushes, at_corners(np.ones_like(places)), at_corners(gaps(places)))


def _least_energy(matrix: Floats, surface: _Surface, force: float) -> Floats:
    """Pressures p >= 0 (C,) of the least ½ pᵀ C p + openingsᵀ p with areasᵀ p = force.

    By active sets: where the pad is pressed its gap is zero, elsewhere it is not negative. The
    multiplier of the force is how far the far side approaches the profile.
    """
    areas, openings = surface.areas, surface.openings
    pressed = np.ones(len(areas), dtype=bool)
    for _ in range(_MAX_CHANGES):
        both = np.stack([areas[pressed], openings[pressed]], axis=1)
        per_approach, per_opening = np.linalg.solve(matrix[np.ix_(pressed, pressed)], both).T
        approach = (force + areas[pressed] @ per_opening) / (areas[pressed] @ per_approach)
        pressures = np.zeros(len(areas))
        pressures[pressed] = approach * per_approach - per_opening
        gaps = matrix @ pressures + openings - approach * areas
        next_pressed = np.where(pressed, pressures > 0.0, gaps < 0.0)
        if np.array_equal(next_pressed, pressed):
            return pressures
        pressed = next_pressed
    raise ArithmeticError("no pressure was found that keeps the pad out of the profile")


def _pad_contact(places: Floats, pressures: Floats, beyond: NDArray[np.bool_]) -> PadContact:
    """Peak and width of a strip; ``beyond`` the ends of the profile there is nothing to press."""
    pressed = pressures > 0.0
    half = 0.25 * float(np.sum((1.0 * pressed[1:] + pressed[:-1]) * np.diff(places)))
    if np.any(beyond & (np.convolve(pressed, np.ones(2 * MARGIN + 1), "same") > 0.0)):
        return PadContact(np.inf, half, places, pressures)
    middle = np.abs(places - places[np.argmax(pressures)]) < MIDDLE * half
    parabola = np.polynomial.Polynomial.fit(places[middle], pressures[middle] ** 2, 2)
    (top,) = parabola.deriv().roots()
    return PadContact(float(np.sqrt(parabola(top))), half, places, pressures)
