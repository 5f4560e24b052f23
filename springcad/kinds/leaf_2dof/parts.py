"""The leaf as a part: a strip with holes at its mount and rounded corners.

Frame: x from the end at the mount to the contact end, y across, the centre line at y = 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from springcad.geometry.outline import Arc, Circle, Line, Outline, Piece, Profile
from springcad.result import Dimension

_SHORTEST = 1e-9


@dataclass(frozen=True)
class Planform:
    """The leaf seen from above, SI.

    Attributes:
        width: of the leaf.
        mount, guide, longest: lengths of mount and guide, longest effective length.
        overhang: from the roller at rest to the contact end.
        end_radius: of the corners.
        hole_count, hole_diameter: of the mount.
    """

    width: float
    mount: float
    guide: float
    longest: float
    overhang: float
    end_radius: float
    hole_count: int
    hole_diameter: float

    @property
    def contact(self) -> float:
        """x of the roller at rest."""
        return self.mount + self.guide + self.longest

    @property
    def length(self) -> float:
        return self.contact + self.overhang


def leaf_profile(planform: Planform) -> Profile:
    """The strip with its holes in a row along it."""
    pitch = planform.mount / max(planform.hole_count, 1)
    holes = tuple(
        Circle(((index + 0.5) * pitch, 0.0), 0.5 * planform.hole_diameter)
        for index in range(planform.hole_count)
    )
    half = 0.5 * planform.width
    return Profile(rounded_rectangle(0.0, -half, planform.length, half, planform.end_radius), holes)


def rounded_rectangle(x0: float, y0: float, x1: float, y1: float, radius: float) -> Outline:
    """Counter-clockwise from the lower side; edges of no length are left out."""
    r = radius
    corners = (
        ((x1 - r, y0 + r), -0.5 * math.pi),
        ((x1 - r, y1 - r), 0.0),
        ((x0 + r, y1 - r), 0.5 * math.pi),
        ((x0 + r, y0 + r), math.pi),
    )
    ends = (
        ((x0 + r, y0), (x1 - r, y0)),
        ((x1, y0 + r), (x1, y1 - r)),
        ((x1 - r, y1), (x0 + r, y1)),
        ((x0, y1 - r), (x0, y0 + r)),
    )
    pieces: list[Piece] = []
    for (start, end), (center, angle) in zip(ends, corners, strict=True):
        if math.dist(start, end) > _SHORTEST:
            pieces.append(Line(start, end))
        if r > 0.0:
            pieces.append(Arc(center, r, angle, 0.5 * math.pi))
    return Outline(tuple(pieces))


def leaf_dimensions(planform: Planform) -> tuple[Dimension, ...]:
    """What a shop and a fitter need to know."""
    half, p = 0.5 * planform.width, planform
    along = (
        ("mount", 0.0, p.mount),
        ("guide at the longest length", p.mount, p.mount + p.guide),
        ("longest effective length", p.mount + p.guide, p.contact),
        ("beyond the roller", p.contact, p.length),
        ("whole leaf", 0.0, p.length),
    )
    found = [Dimension(label, "linear", (x0, half), (x1, half)) for label, x0, x1 in along]
    found.append(Dimension("width", "linear", (p.length, -half), (p.length, half)))
    if p.hole_count:
        pitch = p.mount / p.hole_count
        radius = 0.5 * p.hole_diameter
        found.append(Dimension("hole", "diameter", (0.5 * pitch, 0.0), (0.5 * pitch, -radius)))
        if p.hole_count > 1:
            found.append(
                Dimension("pitch of the holes", "linear", (0.5 * pitch, 0.0), (1.5 * pitch, 0.0))
            )
    return tuple(found)
