"""A straight leaf as it is cut: an eye for the lever's pin, the leaf, a fillet at the clamp.

Frame of the part: the pin is the origin, the leaf runs along x and is clamped at x = l, where the
block begins. What is seen in the sheet is symmetric about x. Leaves of constant and of parabolic
section bend *in* the sheet: their thickness is what is seen, their width a stack of layers. A
triangular leaf bends *out of* the sheet: its width is what is seen, its thickness that of the
sheet.

The parabola and the triangle end in an edge and a point. Half of what is seen goes over smoothly
into half of the least web:

    e(x) = ((e_l (x/l)^m)^8 + (web/2)^8)^(1/8),    m = 1/2 or 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
StraightShape = Literal["constant", "triangular", "parabolic"]

_EXPONENT: dict[StraightShape, float] = {"constant": 0.0, "triangular": 1.0, "parabolic": 0.5}
_BLEND = 8.0
"""The higher, the closer to the larger of ideal leaf and web; at the corner 9 % above it."""
_THICKEST_IN_EYE = 1.2
"""The eye's radius is at least this times half of the leaf seen beside it."""
_SPREAD = 0.25 * np.pi
"""Material of the root fillet outside this angle to the leaf carries nothing."""


@dataclass(frozen=True)
class Fittings:
    """What a leaf is besides its elastic part, m.

    Attributes:
        pin_diameter: of the hole in the eye.
        eye_wall: least material round it.
        eye_fillet, root_fillet: radii between eye and leaf, and between leaf and block.
        min_web: least material seen anywhere.
        block_length, block_height: beyond the clamp, and across.
        hole_count, hole_diameter: of the row of holes across the block.
    """

    pin_diameter: float
    eye_wall: float
    eye_fillet: float
    root_fillet: float
    min_web: float
    block_length: float
    block_height: float
    hole_count: int
    hole_diameter: float


@dataclass(frozen=True)
class StraightLeaf:
    """One leaf.

    Attributes:
        shape: see above.
        length: l, from the pin to the clamp [m].
        thickness: in the direction of bending, at the clamp, without the web's share [m].
        width: across it, at the clamp; of a triangle likewise without the web's share [m].
        fittings: the rest of the part.
    """

    shape: StraightShape
    length: float
    thickness: float
    width: float
    fittings: Fittings

    @property
    def bends_in_sheet(self) -> bool:
        """Whether the thickness is what is seen in the sheet."""
        return self.shape != "triangular"

    @property
    def seen(self) -> float:
        """Half of what is seen in the sheet at the clamp, without the web's share (e_l) [m]."""
        return 0.5 * (self.thickness if self.bends_in_sheet else self.width)

    def edge(self, x: Floats) -> tuple[Floats, Floats]:
        """e(x) and its slope, without eye and fillet."""
        exponent, web = _EXPONENT[self.shape], 0.5 * self.fittings.min_web
        if exponent == 0.0:
            return np.full_like(x, self.seen), np.zeros_like(x)
        share = np.maximum(x, 0.0) / self.length
        power = _BLEND * exponent
        half = (self.seen**_BLEND * share**power + web**_BLEND) ** (1.0 / _BLEND)
        rise = self.seen**_BLEND * exponent * share ** (power - 1.0) / self.length
        return half, rise * half ** (1.0 - _BLEND)

    @cached_property
    def plan(self) -> Plan:
        """Where eye, fillets and leaf meet.

        Raises:
            ValueError: the leaf is too short for its eye and its fillets.
        """
        return _plan(self)


@dataclass(frozen=True)
class Plan:
    """Upper side of the leaf as seen in the sheet; m.

    Attributes:
        eye_radius: of the eye about the pin.
        eye_center: of the fillet between eye and leaf.
        start, end: x of the leaf's own edge between the two fillets.
        root_center: of the fillet at the clamp.
    """

    eye_radius: float
    eye_center: tuple[float, float]
    start: float
    end: float
    root_center: tuple[float, float]


def _plan(leaf: StraightLeaf) -> Plan:
    size, length = leaf.fittings, leaf.length

    def center(x: float, radius: float) -> Floats:
        """Of the circle that touches the edge at x from above."""
        half, slope = (float(value) for value in leaf.edge(np.array(x)))
        normal = np.array([-slope, 1.0]) / np.hypot(1.0, slope)
        return np.asarray(np.array([x, half]) + radius * normal)

    eye = 0.5 * size.pin_diameter + size.eye_wall
    eye = max(eye, _THICKEST_IN_EYE * float(leaf.edge(np.array(eye))[0]))
    reach = eye + size.eye_fillet

    def beside_eye(x: float) -> float:
        return float(np.hypot(*center(x, size.eye_fillet))) - reach

    def before_clamp(x: float) -> float:
        return float(center(x, size.root_fillet)[0]) - (length - size.root_fillet)

    if not (beside_eye(0.0) < 0.0 < beside_eye(0.5 * length) and before_clamp(0.5 * length) < 0.0):
        raise ValueError("the leaf is too short for its eye and its fillets")
    from scipy.optimize import brentq  # what a check of a spec does not need is not loaded for it

    start = float(brentq(beside_eye, 0.0, 0.5 * length, xtol=1e-15))
    end = float(brentq(before_clamp, 0.5 * length, length, xtol=1e-15))
    at_eye, at_root = center(start, size.eye_fillet), center(end, size.root_fillet)
    return Plan(
        eye_radius=eye,
        eye_center=(float(at_eye[0]), float(at_eye[1])),
        start=start,
        end=end,
        root_center=(float(at_root[0]), float(at_root[1])),
    )


def joints(leaf: StraightLeaf) -> Floats:
    """x between which half of what is seen is smooth, from the pin to the clamp (J,)."""
    plan, radius = leaf.plan, leaf.fittings.root_fillet
    at_eye = plan.eye_radius / (plan.eye_radius + leaf.fittings.eye_fillet) * plan.eye_center[0]
    spread = plan.root_center[0] + radius * np.sin(_SPREAD)
    return np.array([0.0, at_eye, plan.start, plan.end, max(spread, plan.end), leaf.length])


def half_seen(leaf: StraightLeaf, x: Floats) -> Floats:
    """Half of what is seen at ``x`` from the pin to the clamp, as far as it carries [m].

    The eye counts as full; the root fillet within 45 deg of the leaf.
    """
    plan, places = leaf.plan, joints(leaf)
    eye = np.sqrt(np.maximum(plan.eye_radius**2 - x**2, 0.0))
    radius, (cx, cy) = leaf.fittings.eye_fillet, plan.eye_center
    beside_eye = cy - np.sqrt(np.maximum(radius**2 - (x - cx) ** 2, 0.0))
    radius, (cx, cy) = leaf.fittings.root_fillet, plan.root_center
    at = np.minimum(x, places[4])
    root = cy - np.sqrt(np.maximum(radius**2 - (at - cx) ** 2, 0.0)) + (x - at) * np.tan(_SPREAD)
    pieces = (eye, beside_eye, leaf.edge(x)[0])
    return np.asarray(np.select([x < place for place in places[1:4]], pieces, root))
