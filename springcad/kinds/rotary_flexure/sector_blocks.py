"""Blocks of elements of one sector of the ring, spanned between the curves of its skeleton.

In the flexure frame, as all of ``sector_skeleton``. "Left" and "right" are those of the flexure
looked at from its root.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Arc
from springcad.kinds.rotary_flexure.sector_skeleton import (
    SKIN,
    RootSide,
    SectorGeometry,
    Skeleton,
    flank_points,
    on_arc,
    polar,
    skin_face,
)
from springcad.mechanics.fem.blocks import (
    chain,
    graded,
    spaced,
    straight,
    transfinite,
    with_middles,
)

Floats = NDArray[np.float64]

NOSE_CORE = 0.58
"""Radius of the far corners of the nose's core over that of the nose."""
GROWTH = 0.3
"""Lengths of elements along the flexure and the rim grow by no more than this per length."""


@dataclass(frozen=True)
class Density:
    """How many elements, and how long.

    Attributes:
        skin, core: across the skin and across the core of the flexure.
        grading: size of the innermost over that of the outermost element of the skin.
        fillet: along each half of a fillet.
        nose: along each half of the nose's sides; the front of the nose has ``core`` elements.
        aspect: length over width of the elements of the flexure.
        tip: length of the elements at the nose over the tip's half thickness.
    """

    skin: int
    core: int
    grading: float
    fillet: int
    nose: int
    aspect: float
    tip: float


COARSE = Density(skin=3, core=2, grading=2.0, fillet=6, nose=2, aspect=2.0, tip=0.5)
"""For displacements and the stress in the fillet: about 750 elements."""
FINE = Density(skin=3, core=4, grading=2.5, fillet=6, nose=6, aspect=1.6, tip=0.12)
"""For contact: about 1600 elements."""


def sector_blocks(
    sector: SectorGeometry, density: Density, skeleton: Skeleton
) -> dict[str, Floats]:
    """Nodes of the blocks by name, each a grid of a curved quadrilateral.

    Raises:
        ValueError: the root fillets of neighbours run into each other.
    """
    begin = _begin(sector, density, skeleton)
    return {
        **_rim_blocks(sector, density, skeleton),
        **_root_blocks(density, begin),
        **_flexure_block(sector, density, skeleton, begin),
        **_nose_blocks(density, skeleton.nose),
    }


@dataclass(frozen=True)
class _Begin:
    """How the flexure begins: square across at the station where the later fillet ends.

    Where the other fillet ends clearly before, a piece of skin along the flank leads on from it.

    Attributes:
        station: of the first section.
        skew: of the stations of the left and right side there; 0 with such a piece.
        element: length of the elements at the ends of the fillets.
        surface, face: by side, skin of the upper half of the fillet and of what leads on, from the
            split of the fillet to the first section; all of the same number of points.
        fillet_points: by side, how many of them belong to the fillet.
    """

    station: float
    skew: float
    element: float
    surface: dict[int, Floats]
    face: dict[int, Floats]
    fillet_points: dict[int, int]


def _begin(sector: SectorGeometry, density: Density, skeleton: Skeleton) -> _Begin:
    ribbon = sector.ribbon
    early, late = sorted(skeleton.sides, key=lambda side: side.station)
    element = 0.5 * (early.upper_length + late.upper_length) / density.fillet
    gap = late.station - early.station
    between = np.array([early.station])
    if gap > 0.5 * element:
        dense = np.linspace(early.station, late.station, 200)
        widest = density.aspect * sector.root_thickness / (2 * density.skin + density.core)
        sizes = np.minimum(element + GROWTH * (dense - early.station), max(widest, element))
        between = with_middles(spaced(dense, sizes))
    even = graded(density.fillet)
    lead = flank_points(ribbon, early, between)
    lead[0] = early.end
    face = skin_face(ribbon, between, early.sign)
    face[-1] = lead[-1] + SKIN * (late.end - lead[-1])
    last = late.end + SKIN * (lead[-1] - late.end)
    many = graded(density.fillet + len(between) // 2)
    if len(between) == 1:
        face_of_early = straight(early.corner, face[-1], even)
    else:
        face_of_early = chain(straight(early.corner, face[0], even), face)
    return _Begin(
        station=late.station if len(between) > 1 else 0.5 * (early.station + late.station),
        skew=0.0 if len(between) > 1 else 0.5 * gap * late.sign,
        element=element,
        surface={
            early.sign: chain(_upper_arc(early, even), lead),
            late.sign: _upper_arc(late, many),
        },
        face={early.sign: face_of_early, late.sign: straight(late.corner, last, many)},
        fillet_points={early.sign: len(even), late.sign: len(many)},
    )


def _upper_arc(side: RootSide, fractions: Floats) -> Floats:
    return on_arc(side.arc, side.split + (1.0 - side.split) * fractions)


def _rim_blocks(sector: SectorGeometry, density: Density, skeleton: Skeleton) -> dict[str, Floats]:
    """The core of the rim and its skin beside the fillets."""
    root, inner = sector.root_radius, sector.root_radius + skeleton.skin
    left, right = skeleton.left, skeleton.right
    across = graded(density.skin, 1.0 / density.grading)
    land = math.pi / sector.count - 0.5 * (left.rim_angle - right.rim_angle)
    if land <= 0.0:
        raise ValueError("the root fillets of neighbours run into each other")
    element = 0.5 * (left.lower_length + right.lower_length) / density.fillet / root
    reach = np.linspace(0.0, land, 200)
    steps = with_middles(spaced(reach, element + GROWTH * reach))
    land_left, land_right = left.rim_angle + steps, right.rim_angle - steps[::-1]
    even = graded(density.fillet)
    lower_left = left.corner_angle + even * (left.rim_angle - left.corner_angle)
    lower_right = right.rim_angle + even * (right.corner_angle - right.rim_angle)
    core = graded(density.core)
    under = right.corner_angle + core * (left.corner_angle - right.corner_angle)

    def arc(radius: float, angles: Floats) -> Floats:
        return polar(root, radius, angles)

    outside = arc(
        sector.outer_radius,
        chain(land_right, lower_right, under, lower_left, land_left),
    )
    inside = chain(
        arc(inner, land_right),
        arc(inner, lower_right),
        straight(right.corner, left.corner, core),
        arc(inner, lower_left),
        arc(inner, land_left),
    )
    depth = np.linspace(0.0, sector.outer_radius - inner, 200)
    first = (1.0 - 2.0 * SKIN) * sector.root_thickness / density.core
    rows = spaced(depth, np.minimum(first + GROWTH * depth, 0.5 * depth[-1]))
    radial = 1.0 - with_middles(rows)[::-1] / depth[-1]
    blocks = {"rim": _between(outside, inside, radial)}
    for name, angles in (("land left", land_left), ("land right", land_right)):
        blocks[name] = _between(arc(inner, angles), arc(root, angles), across)
    for name, angles, side in (
        ("lower left", lower_left, left),
        ("lower right", lower_right, right),
    ):
        surface = on_arc(side.arc, side.split * even)[:: -side.sign]
        blocks[name] = _between(arc(inner, angles), surface, across)
    return blocks


def _root_blocks(density: Density, begin: _Begin) -> dict[str, Floats]:
    """The upper halves of the fillets, what leads on from them, and the core between them."""
    outwards = graded(density.skin, 1.0 / density.grading)
    blocks = {"column": _beside(begin.face[-1], begin.face[1], graded(density.core))}
    for sign, word in ((1, "left"), (-1, "right")):
        face, surface, first = begin.face[sign], begin.surface[sign], begin.fillet_points[sign]
        parts = {f"upper {word}": slice(first), f"start {word}": slice(first - 1, None)}
        for name, part in parts.items():
            if len(face[part]) == 1:
                continue
            if sign > 0:
                blocks[name] = _beside(face[part], surface[part], outwards)
            else:
                blocks[name] = _beside(surface[part], face[part], 1.0 - outwards[::-1])
    return blocks


def _flexure_block(
    sector: SectorGeometry, density: Density, skeleton: Skeleton, begin: _Begin
) -> dict[str, Floats]:
    """The flexure from its first section to the centre of its nose."""
    ribbon, nose = sector.ribbon, skeleton.nose
    dense = np.linspace(begin.station, ribbon.length, 2000)
    thickness = 2.0 * ribbon.at(np.maximum(dense, 0.0)).half_thickness
    sizes = np.minimum.reduce(
        [
            density.aspect * thickness / (2 * density.skin + density.core),
            begin.element + GROWTH * (dense - begin.station),
            density.tip * nose.radius + GROWTH * (ribbon.length - dense),
        ]
    )
    stations = with_middles(spaced(dense, sizes))
    fading = np.maximum(1.0 - (stations - begin.station) / float(thickness[0]), 0.0) ** 2
    flanks = {}
    for side in skeleton.sides:
        points = flank_points(ribbon, side, stations + side.sign * begin.skew * fading)
        points[0] = begin.surface[side.sign][-1]
        points[-1] = _nose_point(nose, side.sign * 0.5 * math.pi)
        flanks[side.sign] = points
    return {"flexure": _beside(flanks[-1], flanks[1], _across(density))}


def _nose_blocks(density: Density, nose: Arc) -> dict[str, Floats]:
    """The round nose: a core beyond that of the flexure, and the skin round it."""
    side, front = graded(density.nose), graded(density.core)
    quarter = 0.25 * math.pi
    centre = np.asarray(nose.center)
    arcs = {sign: _nose_point(nose, sign * (2.0 * quarter - quarter * side)) for sign in (1, -1)}
    base = {sign: centre + (1.0 - 2.0 * SKIN) * (arcs[sign][0] - centre) for sign in (1, -1)}
    top = {sign: centre + NOSE_CORE * (arcs[sign][-1] - centre) for sign in (1, -1)}
    lines = {sign: straight(base[sign], top[sign], side) for sign in (1, -1)}
    outwards = graded(density.skin, 1.0 / density.grading)
    return {
        "nose left": _beside(lines[1], arcs[1], outwards),
        "nose right": _beside(arcs[-1], lines[-1], 1.0 - outwards[::-1]),
        "nose core": _beside(lines[-1], lines[1], front),
        "nose front": _between(
            straight(top[-1], top[1], front),
            _nose_point(nose, quarter * (2.0 * front - 1.0)),
            outwards,
        ),
    }


def _across(density: Density) -> Floats:
    """Positions across the flexure, from its right side to its left: skin, core, skin."""
    skin = SKIN * graded(density.skin, density.grading)
    core = SKIN + (1.0 - 2.0 * SKIN) * graded(density.core)
    return chain(skin, core, 1.0 - skin[::-1])


def _beside(right: Floats, left: Floats, across: Floats) -> Floats:
    """Block between two curves along the flexure, straight across."""
    west, east = (straight(right[k], left[k], across) for k in (0, -1))
    return transfinite(right, left, west, east)


def _between(outer: Floats, inner: Floats, inwards: Floats) -> Floats:
    """Block between two curves from right to left, straight from the outer to the inner one."""
    south, north = (straight(outer[k], inner[k], inwards) for k in (0, -1))
    return transfinite(south, north, outer, inner)


def _nose_point(nose: Arc, angle: Floats | float) -> Floats:
    """Points of the nose at angles from the direction in which it points, left positive."""
    turn = nose.start_angle - 0.5 * math.pi + np.asarray(angle)
    return np.asarray(nose.center + nose.radius * np.stack([np.cos(turn), np.sin(turn)], axis=-1))
