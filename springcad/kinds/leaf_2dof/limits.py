"""How far a unit may be bent at each effective length, and what it gives there.

Exact unit (``unit``); the paper's closed forms are in ``paper_unit``. All of one leaf.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize.elementwise import find_root

from springcad.kinds.leaf_2dof import paper_unit
from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.kinds.leaf_2dof.seating import rest_offset
from springcad.kinds.leaf_2dof.unit import UnitStroke, stroke

Floats = NDArray[np.float64]
Limit = Literal["stress", "bend angle", "geometry"]

_MOST_TURN = np.radians(60.0)
_MOST_SLOPE = np.tan(np.radians(40.0))
_MOST_WRAP = 0.5  # of the linear slope times r + b/2 over L: the contact is then at about 0.4 L
_ROOT_TOLERANCE = 1e-10  # of the angle


@dataclass(frozen=True)
class Reach:
    """The largest deflection at each of L effective lengths.

    Attributes:
        by_stress, by_bend: angle at which the limit is reached (L,) [rad]; infinite where the
            geometry ends the stroke before, and ``by_bend`` where there is no such limit.
        by_geometry: from ``useful_stroke`` (L,), finite.
        binding: the first of them at each length.
        unit: the unit there (L,); its angle is the least of the three.
    """

    by_stress: Floats
    by_bend: Floats
    by_geometry: Floats
    binding: tuple[Limit, ...]
    unit: UnitStroke


def useful_stroke(leaf: Leaf, lever: Lever, length: ArrayLike) -> Floats:
    """Angle [rad] at which the torque is greatest; beyond it the lever would run away.

    Where that is farther, or never, the stroke ends at 60° of the lever, or with the leaf bent by
    about 40° (by the linear model), or where the contact of a short leaf has come so near the
    clamp (0.4 L) that the roller all but wraps it.
    """
    at = np.asarray(length, dtype=np.float64)
    slope = np.minimum(_MOST_SLOPE, _MOST_WRAP * at / rest_offset(leaf, lever))
    bent = paper_unit.deflection_at_bend(lever, at, np.arctan(slope))
    end = np.minimum(bent, _MOST_TURN)
    peak = _root(lambda angle, at: stroke(leaf, lever, at, angle).stiffness, at, end)
    return np.minimum(peak, end)


def reach(
    leaf: Leaf, lever: Lever, length: ArrayLike, stress_limit: float, bend: float | None = None
) -> Reach:
    """The deflection that stress, bend angle and geometry allow at lengths (L,)."""
    at = np.atleast_1d(np.asarray(length, dtype=np.float64))
    end = useful_stroke(leaf, lever, at)
    by_stress = _root(
        lambda angle, at: 1.0 - stroke(leaf, lever, at, angle).stress / stress_limit, at, end
    )
    by_bend = np.full_like(at, np.inf)
    if bend is not None:
        by_bend = _root(lambda angle, at: bend - stroke(leaf, lever, at, angle).bend_angle, at, end)
    limits: tuple[Limit, ...] = ("stress", "bend angle", "geometry")
    angles = np.stack([by_stress, by_bend, end])
    return Reach(
        by_stress=by_stress,
        by_bend=by_bend,
        by_geometry=end,
        binding=tuple(limits[i] for i in np.argmin(angles, axis=0)),
        unit=stroke(leaf, lever, at, angles.min(axis=0)),
    )


def _root(room: Callable[[Floats, Floats], Floats], length: Floats, end: Floats) -> Floats:
    """Angle in (0, end) where the room, positive at rest, is used up; inf where some is left."""
    used_up = room(end, length) < 0.0
    last = np.where(used_up, end, 0.0)
    found = find_root(
        room, (np.zeros_like(last), last), args=(length,), tolerances={"xrtol": _ROOT_TOLERANCE}
    )
    return np.where(used_up, found.x, np.inf)
