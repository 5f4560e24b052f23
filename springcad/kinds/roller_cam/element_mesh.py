"""Finite-element mesh of the roller-cam's element: mount, cantilever and contact part.

Seven blocks of elements are spanned between the curves of ``element.ElementGeometry``, in its
frame. Fillets are cut at their middle, where blocks meet. Rounded outer corners are left square and
holes filled: neither carries stress.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Arc
from springcad.kinds.roller_cam.element import ElementGeometry, require_room
from springcad.mechanics.fem.blocks import (
    Side,
    chain,
    graded,
    join,
    spaced,
    straight,
    transfinite,
    with_middles,
)
from springcad.mechanics.fem.mesh import Mesh

Floats = NDArray[np.float64]

GROWTH = 0.4
"""Lengths of elements in a row grow by no more than this per length."""
SURFACE = 3.0
"""The elements in the middle of the cantilever are this many times as high as at its sides."""
PIECE = 2.0
"""The mount is meshed to this many heights of the cantilever behind the root."""
LEAN = 0.4
"""From the lower end of the profile the blocks' border falls so steeply to the back: the profile
may end level, and neither of the two blocks must be pointed there."""
LOWEST = 0.35
"""It ends no lower than this share of the way from the foot up to the end of the profile."""
_LESS_STEEP = "lower joint.drum_radius: the contact then goes further round the roller"


@dataclass(frozen=True)
class Density:
    """How many elements, and how long.

    Attributes:
        across: over the height of the cantilever; even.
        through: over the thickness of the contact part.
        fillet: along each half of a fillet.
        contact: length along the profile [m].
    """

    across: int
    through: int
    fillet: int
    contact: float


def coarse(roller_radius: float) -> Density:
    """For compliances: about 1500 elements, 0.1 mm long under a roller of 4 mm."""
    return Density(across=8, through=8, fillet=4, contact=roller_radius / 40.0)


def fine(roller_radius: float) -> Density:
    """For contact and stress: about 2500 elements, 0.05 mm long under a roller of 4 mm."""
    return Density(across=10, through=10, fillet=6, contact=roller_radius / 80.0)


EDGE_SETS: dict[str, tuple[tuple[str, Side], ...]] = {
    "contact": (("head", "west"),),
    "back": (("heel", "east"), ("neck", "east"), ("head", "east")),
    "upper side": (("bar", "north"),),
    "lower side": (("bar", "south"),),
    "foot": (("neck", "west"),),
    "root": (
        ("upper mount", "east"),
        ("root", "north"),
        ("root", "south"),
        ("lower mount", "east"),
    ),
    "held": (
        ("upper mount", "north"),
        ("upper mount", "west"),
        ("middle mount", "west"),
        ("lower mount", "west"),
        ("lower mount", "south"),
    ),
}
"""The sides of blocks along the boundary. ``root`` is the fillets with the faces beside them;
``held`` the outline of the mount but for the face that the cantilever grows from."""


def element_mesh(geometry: ElementGeometry, density: Density) -> Mesh:
    """Mesh with the edge sets, and node sets of the same names, of ``EDGE_SETS``.

    The edges of ``contact`` run down the profile, from the free end to the end of the overrun.

    Raises:
        InfeasibleError: the parts of the element do not fit together, or the contact part is of a
            shape that the blocks cannot follow.
    """
    require_room(geometry)
    across = _across(density)
    bar = _bar(geometry, density, across)
    blocks = {
        **_mount_blocks(geometry, density, across),
        "bar": bar,
        **_contact_part_blocks(geometry, density, bar[-1]),
    }
    try:
        return join(blocks, EDGE_SETS)
    except ValueError as error:
        claim = f"meshes of an element with such a steep profile ({error})"
        raise InfeasibleError(claim, 0.0, 1.0, "1", (_LESS_STEEP,)) from error


def _across(density: Density) -> Floats:
    """Positions over the height of the cantilever, from 0 to 1, finer at both sides."""
    half = 0.5 * graded(density.across // 2, SURFACE)
    return chain(half, 1.0 - half[::-1])


def _root_arc(geometry: ElementGeometry) -> Arc:
    """The upper root fillet, from the mount's face to the cantilever's side."""
    radius, beam = geometry.dimensions.root_fillet, geometry.cantilever
    center = (radius - beam.length, 0.5 * beam.height + radius)
    return Arc(center, radius, math.pi, 0.5 * math.pi)


def _mount_blocks(geometry: ElementGeometry, density: Density, across: Floats) -> dict[str, Floats]:
    """The piece of the mount, in three blocks, and the cantilever between its root fillets."""
    arc, mount, beam = _root_arc(geometry), geometry.dimensions.mount, geometry.cantilever
    even = graded(density.fillet)
    face, side = -beam.length, 0.5 * mount.height
    rear = face - min(mount.length, PIECE * beam.height)
    element = 0.25 * math.pi * arc.radius / density.fillet
    to_face, to_bar = _on_arc(arc, 0.5 - 0.5 * even), _on_arc(arc, 0.5 + 0.5 * even)
    steps = _growing(side - arc.center[1], element)
    up = chain(to_face, np.column_stack([np.full(len(steps), face), arc.center[1] + steps]))
    start = to_face[0]
    # One line of nodes lies in the plane of the face, where plates may end.
    beyond, within = _growing(face - rear, element), _growing(start[0] - face, element)
    inwards = chain(face - beyond[::-1], face + within)
    inwards[[0, -1]] = rear, start[0]
    level = np.column_stack([inwards, np.full(len(inwards), start[1])])
    share = (up[:, 1] - start[1]) / (side - start[1])
    end = straight(
        np.array([rear, side]), np.array([face, side]), (inwards - rear) / (start[0] - rear)
    )
    upper = transfinite(level, end, straight(level[0], end[0], share), up)
    mirrored = level * [1.0, -1.0]
    return {
        "upper mount": upper,
        "lower mount": _mirrored(upper),
        "middle mount": _between(mirrored, level, across),
        "root": _between(to_bar * [1.0, -1.0], to_bar, across),
    }


def _bar(geometry: ElementGeometry, density: Density, across: Floats) -> Floats:
    """The cantilever between its fillets, and on to the middle of the fillet at its foot."""
    half, foot = 0.5 * geometry.cantilever.height, geometry.foot
    start, end = _root_arc(geometry).center[0], foot.center[0]
    dense = np.linspace(start, end, 2000)
    sizes = np.minimum.reduce(
        [
            np.full_like(dense, 3.0 * half / density.across),
            _first(geometry.dimensions.root_fillet, density) + GROWTH * (dense - start),
            _first(foot.radius, density) + GROWTH * (end - dense),
        ]
    )
    x = with_middles(spaced(dense, sizes))
    toe = _on_arc(foot, 1.0 - 0.5 * graded(density.fillet))
    north = chain(np.column_stack([x, np.full(len(x), half)]), toe)
    south = np.column_stack([north[:, 0], np.full(len(north), -half)])
    return _between(south, north, across)


def _contact_part_blocks(
    geometry: ElementGeometry, density: Density, section: Floats
) -> dict[str, Floats]:
    """The end of the cantilever (heel), the upright up to the profile (neck), and the head."""
    toe, back = section[-1], geometry.back
    through = graded(density.through, min(4.0, geometry.dimensions.thickness / density.contact))
    neck, head = _neck_front(geometry, density), _head_front(geometry, density)
    length = _lengths(chain(neck, head))
    lowest = toe[1] + LOWEST * (head[0, 1] - toe[1])
    shelf_end = max(head[0, 1] - LEAN * (back - head[0, 0]), lowest)
    knots = length[[0, len(neck) - 1, -1]]
    rise = np.interp(length, knots, [toe[1], shelf_end, geometry.top])
    spine = np.column_stack([np.full(len(rise), back), rise])
    low, high = spine[: len(neck)], spine[len(neck) - 1 :]
    sole = straight(section[0], np.array([back, section[0, 1]]), through)
    level = straight(toe, low[0], through)
    shelf = straight(head[0], high[0], through)
    shares = (section[:, 1] - section[0, 1]) / (toe[1] - section[0, 1])
    return {
        "heel": transfinite(sole, level, section, straight(sole[-1], level[-1], shares)),
        "neck": transfinite(level, shelf, neck, low),
        "head": transfinite(shelf, straight(head[-1], high[-1], through), head, high),
    }


def _neck_front(geometry: ElementGeometry, density: Density) -> Floats:
    """From the middle of the fillet at the foot up to the lower end of the profile."""
    foot, chin, front = geometry.foot, geometry.chin, geometry.front
    fine = np.linspace(0.0, 1.0, 200)
    lower = _on_arc(foot, 0.5 - 0.5 * fine)
    wall = straight(lower[-1], np.array([front, chin.center[1]]), fine)
    whole = chain(lower, wall, _on_arc(chin, 1.0 - fine))
    length = _lengths(whole)
    sizes = np.minimum(
        _first(foot.radius, density) + GROWTH * np.maximum(length - _lengths(lower)[-1], 0.0),
        density.contact + GROWTH * (length[-1] - length),
    )
    places = with_middles(spaced(length, sizes))
    return np.column_stack([np.interp(places, length, axis) for axis in whole.T])


def _head_front(geometry: ElementGeometry, density: Density) -> Floats:
    """Up the profile from its lower end, and straight on to the free end."""
    points, tangents = geometry.points, geometry.tangents
    places = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    curve = CubicHermiteSpline(places, points, tangents)
    beyond = (geometry.top - points[0, 1]) / tangents[0, 1]
    count = math.ceil((places[-1] - beyond) / density.contact)
    along = np.linspace(beyond, places[-1], 2 * count + 1)[::-1]
    above = points[0] + np.minimum(along, 0.0)[:, None] * tangents[0]
    return np.where(along[:, None] < 0.0, above, curve(np.maximum(along, 0.0)))


def _first(radius: float, density: Density) -> float:
    """Length of the elements along a fillet."""
    return 0.25 * math.pi * radius / density.fillet


def _growing(length: float, first: float) -> Floats:
    """Positions (2 K + 1,) from 0 to a length of the nodes of elements that grow from ``first``."""
    dense = np.linspace(0.0, length, 500)
    return with_middles(spaced(dense, first + GROWTH * dense))


def _between(south: Floats, north: Floats, across: Floats) -> Floats:
    """Block between two curves along the element, straight across."""
    return transfinite(
        south, north, straight(south[0], north[0], across), straight(south[-1], north[-1], across)
    )


def _mirrored(block: Floats) -> Floats:
    """A block on the other side of the x axis, its directions right-handed again."""
    return np.asarray(block[:, ::-1] * [1.0, -1.0])


def _lengths(points: Floats) -> Floats:
    """Length along a sampled curve (N, 2) up to each of its points."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def _on_arc(arc: Arc, fractions: Floats) -> Floats:
    """Points of an arc at fractions of its sweep."""
    angle = arc.start_angle + fractions * arc.sweep
    return np.asarray(arc.center) + arc.radius * np.column_stack([np.cos(angle), np.sin(angle)])
