"""The outline of a straight leaf with its eye and its block, as it is cut."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Arc, Circle, Curve, Line, Outline, Piece, Profile
from springcad.geometry.outline_ops import profile_faults
from springcad.geometry.transform import backwards, mirror
from springcad.kinds.lever_arm.straight import StraightLeaf

Floats = NDArray[np.float64]

LEAST_BLOCK = 20e-3
"""Height of the block where it is left to the design [m], if nothing needs more."""
_POINTS = 200


def block_height(leaf: StraightLeaf) -> float:
    """As given; else the least that leaf, fillets, holes and their webs need, 20 mm or more [m]."""
    size = leaf.fittings
    if size.block_height:
        return size.block_height
    shoulder = 2.0 * (leaf.plan.root_center[1] + size.root_fillet)
    holes = size.hole_count * (size.hole_diameter + 2.0 * size.eye_wall)
    return max(LEAST_BLOCK, shoulder, holes)


def leaf_profile(leaf: StraightLeaf) -> Profile:
    """Counter-clockwise; the pin at the origin, the leaf along x, the block beyond x = l.

    Raises:
        InfeasibleError: the block has no shoulder for the fillets, or the outline is not valid.
    """
    upper = _upper_side(leaf)
    lower = tuple(mirror(piece, 0.0) for piece in upper)
    height, back = block_height(leaf), leaf.length + leaf.fittings.block_length
    top = leaf.plan.root_center[1]
    if 0.5 * height <= top:
        enough = math.ceil(2e3 * (top + leaf.fittings.root_fillet))
        raise InfeasibleError(
            "height of the block, for leaf and fillets", height, 2.0 * top, "m",
            (f"raise mount.height from {1e3 * height:.4g} to {enough} mm",
             "take mount.height out of the spec"),
        )  # fmt: skip
    half, face = 0.5 * height, leaf.length
    block = (
        Line((face, -top), (face, -half)),
        Line((face, -half), (back, -half)),
        Line((back, -half), (back, half)),
        Line((back, half), (face, half)),
        Line((face, half), (face, top)),
    )
    radius = leaf.plan.eye_radius
    opening = math.atan2(leaf.plan.eye_center[1], leaf.plan.eye_center[0])
    eye = Arc((0.0, 0.0), radius, opening, 2.0 * (math.pi - opening))
    outline = Outline((*lower, *block, *backwards(upper), eye))
    profile = Profile(
        outline, (Circle((0.0, 0.0), 0.5 * leaf.fittings.pin_diameter), *_holes(leaf))
    )
    faults = profile_faults(profile)
    if faults:
        claim = f"faults in the outline of the leaf ({'; '.join(faults)})"
        raise InfeasibleError(claim, len(faults), 0.0, "1")
    return profile


def _upper_side(leaf: StraightLeaf) -> tuple[Piece, ...]:
    """From the eye to the block's face: fillet, edge, fillet."""
    plan, size = leaf.plan, leaf.fittings
    x = np.linspace(plan.start, plan.end, _POINTS)
    half, slope = leaf.edge(x)
    tangents = np.column_stack([np.ones_like(slope), slope]) / np.hypot(1.0, slope)[:, None]
    points = np.column_stack([x, half])
    opening = math.atan2(plan.eye_center[1], plan.eye_center[0]) - math.pi
    first = math.atan2(*(points[0] - plan.eye_center)[::-1])
    last = math.atan2(*(points[-1] - plan.root_center)[::-1])
    edge: Piece = Curve(points, tangents)
    if not np.any(slope):
        edge = Line((plan.start, float(half[0])), (plan.end, float(half[-1])))
    return (
        Arc(plan.eye_center, size.eye_fillet, opening, first - opening),
        edge,
        Arc(plan.root_center, size.root_fillet, last, -last),
    )


def _holes(leaf: StraightLeaf) -> tuple[Circle, ...]:
    """Evenly along the middle of the block."""
    size, height = leaf.fittings, block_height(leaf)
    x = leaf.length + 0.5 * size.block_length
    pitch = height / max(size.hole_count, 1)
    return tuple(
        Circle((x, (i + 0.5) * pitch - 0.5 * height), 0.5 * size.hole_diameter)
        for i in range(size.hole_count)
    )
