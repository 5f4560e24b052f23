"""The roller-cam's element as one flat part: mount, cantilever and the contact part at its tip.

Frame of ``springcad.kinds.roller_cam.joint``: the tip of the cantilever is the origin, the root is
at x = −l. The contact part hooks up beyond the tip, on the +x side of the roller, with the profile
on the roller's side. Below the profile's lower end its front falls straight to the cantilever: the
roller never comes below the tangent there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Arc, Circle, Curve, Line, Outline, Profile
from springcad.kinds.roller_cam.curve import ProfileCurve
from springcad.kinds.roller_cam.joint import Cantilever
from springcad.kinds.roller_cam.synthesis import ContactProfile

Floats = NDArray[np.float64]

Mounting = Literal["plates", "pocket"]
"""What holds the mount:

- ``plates``: it is clamped between plates that end with its face; no point of it moves. This is the
  clamp of beam theory.
- ``pocket``: its back and its two sides are held, and the face that the cantilever grows from is
  free. The block then yields: for the joint of paper 001 the cantilever's tip is softer by a fifth
  (``Cantilever.root_compliance``).
"""

MOUNTED: dict[Mounting, str] = {
    "plates": "a mount held between plates that end with its face",
    "pocket": "a mount held rigidly in a pocket, by its back and sides",
}
"""The same for people."""

OVERHANG = 0.1
"""The profile goes on by this share of the roller's radius, straight above its first contact as far
as there is room and round below its last (``_lower_end``): the strip of contact has a width. It is
fixed, as an end that changes with the strip would change the compliance in its turn."""
_POINTS = 400


@dataclass(frozen=True)
class Mount:
    """The block at the root, centred on the cantilever, with a row of holes along its height.

    Attributes:
        length: along the cantilever [m].
        height: across it [m].
        hole_diameter: [m].
        hole_count: 0 for none.
        mounting: what holds it.
    """

    length: float
    height: float
    hole_diameter: float
    hole_count: int
    mounting: Mounting = "plates"


@dataclass(frozen=True)
class ElementDimensions:
    """What the element is besides its cantilever and its profile, m.

    Attributes:
        thickness: of the contact part along x, behind the upper end of its profile.
        root_fillet: radius between mount and cantilever.
        foot_fillet: radius between cantilever and contact part.
        rounding: radius of the contact part's outer corners.
        gap: to the mirrored element, which the roller touches from its other side.
        mount: the block at the root.
    """

    thickness: float
    root_fillet: float
    foot_fillet: float
    rounding: float
    gap: float
    mount: Mount


@dataclass(frozen=True)
class ElementGeometry:
    """All that the drawing and the mesh of an element are made from.

    Attributes:
        cantilever: the elastic part.
        points, tangents: of the profile (N, 2), dense, from its upper end down; the tangents are
            unit vectors along that way.
        dimensions: the rest of the element.
    """

    cantilever: Cantilever
    points: Floats
    tangents: Floats
    dimensions: ElementDimensions

    @property
    def back(self) -> float:
        """x of the back of the contact part."""
        return float(self.points[0, 0]) + self.dimensions.thickness

    @property
    def brow(self) -> Arc:
        """The rounding above the profile, from the level top down to its first point."""
        center = self.points[0] + self.dimensions.rounding * _left(self.tangents[0])
        return _turning_to(center, self.dimensions.rounding, 0.5 * math.pi, self.tangents[0])

    @property
    def top(self) -> float:
        """y of the free end of the contact part."""
        return self.brow.center[1] + self.dimensions.rounding

    @property
    def chin(self) -> Arc:
        """The rounding below the profile, from its last point to the upright front."""
        tangent = self.tangents[-1]
        center = self.points[-1] + self.dimensions.rounding * _left(tangent)
        start = math.atan2(-tangent[0], tangent[1])
        return _turning_to(center, self.dimensions.rounding, start, np.array([0.0, -1.0]))

    @property
    def front(self) -> float:
        """x of the upright front below the profile."""
        return self.chin.center[0] - self.dimensions.rounding

    @property
    def foot(self) -> Arc:
        """The fillet from the front to the cantilever's upper side."""
        radius = self.dimensions.foot_fillet
        center = (self.front - radius, 0.5 * self.cantilever.height + radius)
        return Arc(center, radius, 0.0, -0.5 * math.pi)


def element_geometry(profile: ContactProfile, dimensions: ElementDimensions) -> ElementGeometry:
    """The element with a profile, as high as the element mirrored at the roller's axis lets it be.

    Where the roller would touch above that height the profile is left out (``first_place``).

    Raises:
        InfeasibleError: there is no room for the profile's upper end.
    """
    curve = profile.curve
    places = np.linspace(first_place(profile, dimensions), last_place(profile), _POINTS)
    above, below = np.minimum(places, curve.length), np.maximum(places - curve.length, 0.0)
    points, tangents = curve.points(above), curve.tangents(above)
    points[below > 0.0], tangents[below > 0.0] = _lower_end(curve, below[below > 0.0])
    return ElementGeometry(profile.joint.cantilever, points, tangents, dimensions)


def first_place(profile: ContactProfile, dimensions: ElementDimensions) -> float:
    """Place of the profile's upper end, before its first contact (< 0) if there is room [m].

    Raises:
        InfeasibleError: see ``element_geometry``.
    """
    roller = profile.joint.roller
    highest = roller.offset - 0.5 * dimensions.gap - dimensions.rounding
    places = np.linspace(-OVERHANG * roller.radius, 0.5 * profile.curve.length, 2000)
    height = profile.curve.points(places)[:, 1]
    free = np.flatnonzero(height <= highest)
    if not len(free):
        lowest = float(height[-1])
        claim = "height of the upper half of the profile, which the mirrored element leaves free"
        raise InfeasibleError(claim, lowest, highest, "m", ("raise joint.roller_radius",))
    return float(places[free[0]])


def last_place(profile: ContactProfile) -> float:
    """Place of the profile's lower end, beyond its last contact [m]."""
    return profile.curve.length + OVERHANG * profile.joint.roller.radius


def _lower_end(curve: ProfileCurve, beyond: Floats) -> tuple[Floats, Floats]:
    """Points and unit tangents (M, 2) beyond the last contact (M,) [m].

    On its circle of curvature, as if roller and profile went on as they touched last, until that is
    level or upright, and then straight: the profile neither rises nor turns back.
    """
    end = np.array([curve.length])
    ((along, down),), (curvature,) = curve.tangents(end), curve.curvature(end)
    left = math.atan2(down, -along) if curvature < 0.0 else math.atan2(along, down)
    bent = np.minimum(beyond, abs(left / curvature)) if curvature else beyond
    points, tangents = curve.on_circle(bent)
    return points + (beyond - bent)[:, None] * tangents, tangents


def require_room(geometry: ElementGeometry) -> None:
    """Refuse an element whose parts do not fit together.

    Raises:
        InfeasibleError: the profile comes too near to the cantilever, the contact part is longer
            than the cantilever, or the mount has no shoulder for the root fillets.
    """
    beam, size = geometry.cantilever, geometry.dimensions
    shoulder = 0.5 * (size.mount.height - beam.height)
    needs = (
        (
            "room between the profile's lower end and the cantilever, for the fillet there",
            geometry.chin.center[1] - 0.5 * beam.height,
            size.foot_fillet,
            ("raise joint.roller_offset", "lower cantilever.height"),
        ),
        (
            "length of the cantilever up to the contact part, for the fillets at both ends",
            beam.length + geometry.front,
            size.foot_fillet + size.root_fillet,
            ("raise cantilever.length", "lower cantilever.root_fillet"),
        ),
        (
            "shoulder of the mount beside the cantilever, for the root fillet",
            shoulder,
            size.root_fillet,
            (
                f"raise mount.height above {1e3 * (beam.height + 2.0 * size.root_fillet):.4g} mm",
                f"lower cantilever.root_fillet below {1e3 * shoulder:.4g} mm",
            ),
        ),
        (
            "thickness of the contact part, for the roundings of its upper end",
            size.thickness,
            2.0 * size.rounding,
            (f"raise contact_part.thickness above {2e3 * size.rounding:g} mm",),
        ),
    )
    for claim, value, limit, remedies in needs:
        if value <= limit:
            raise InfeasibleError(claim, value, limit, "m", remedies)


def element_profile(geometry: ElementGeometry) -> Profile:
    """The element as it is cut, counter-clockwise from the lower corner of the mount's back.

    Raises:
        InfeasibleError: see ``require_room``.
    """
    require_room(geometry)
    size, back, top = geometry.dimensions, geometry.back, geometry.top
    half, side = 0.5 * geometry.cantilever.height, 0.5 * size.mount.height
    face = -geometry.cantilever.length
    rear, root = face - size.mount.length, face + size.root_fillet
    brow, chin, foot, quarter = geometry.brow, geometry.chin, geometry.foot, 0.5 * math.pi
    radius, outer = size.root_fillet, size.rounding
    pieces = (
        Line((rear, -side), (face, -side)),
        Line((face, -side), (face, -half - radius)),
        Arc((root, -half - radius), radius, math.pi, -quarter),
        Line((root, -half), (back - outer, -half)),
        Arc((back - outer, outer - half), outer, -quarter, quarter),
        Line((back, outer - half), (back, top - outer)),
        Arc((back - outer, top - outer), outer, 0.0, quarter),
        Line((back - outer, top), (brow.center[0], top)),
        brow,
        Curve(geometry.points, geometry.tangents),
        chin,
        Line((geometry.front, chin.center[1]), (geometry.front, foot.center[1])),
        foot,
        Line((foot.center[0], half), (root, half)),
        Arc((root, half + radius), radius, -quarter, -quarter),
        Line((face, half + radius), (face, side)),
        Line((face, side), (rear, side)),
        Line((rear, side), (rear, -side)),
    )
    return Profile(Outline(pieces), mount_holes(geometry))


def mount_holes(geometry: ElementGeometry) -> tuple[Circle, ...]:
    """The holes, evenly along the middle of the mount."""
    mount = geometry.dimensions.mount
    x = -geometry.cantilever.length - 0.5 * mount.length
    pitch = mount.height / max(mount.hole_count, 1)
    return tuple(
        Circle((x, (i + 0.5) * pitch - 0.5 * mount.height), 0.5 * mount.hole_diameter)
        for i in range(mount.hole_count)
    )


def _left(tangent: Floats) -> Floats:
    """The unit vector to the left of a direction."""
    return np.array([-tangent[1], tangent[0]])


def _turning_to(center: Floats, radius: float, start: float, tangent: Floats) -> Arc:
    """The counter-clockwise arc from the angle ``start`` to where it runs along ``tangent``."""
    end = math.atan2(-tangent[0], tangent[1])
    return Arc((float(center[0]), float(center[1])), radius, start, (end - start) % (2.0 * math.pi))
