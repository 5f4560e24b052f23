"""Thickness, layers and width of a straight leaf, on the nonlinear beam.

The closed form (000, Eq. 17) gives the thickness at which the stress is reached at s_max; the beam
corrects it. That is the thickest leaf, and the stiffest. Where a stiffness is wanted, a stack takes
the fewest layers that reach it and is then made thinner until it has just that; a triangular leaf
takes the width. A sheet has the thickness it is sold with, so the stress of a triangle is below.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from springcad.errors import InfeasibleError
from springcad.kinds.lever_arm.feasibility import Case, full_thickness, sheet_for
from springcad.kinds.lever_arm.straight import Fittings, StraightLeaf, StraightShape
from springcad.kinds.lever_arm.straight_beam import Elastic, LeafStates, leaf_states
from springcad.mechanics.leaf import SHAPES, greatest_stiffness

_PASSES = 20
_TOLERANCE = 1e-7
"""Of stress and stiffness, relative."""
_ROUND_OFF = 1e-6
"""Share of a layer that is not worth another one."""
_SHAPES: dict[str, StraightShape] = {
    "constant": "constant",
    "triangular": "triangular",
    "parabolic": "parabolic",
}


@dataclass(frozen=True)
class SizedLeaf:
    """A leaf of the spring, and how it came to its size.

    Attributes:
        leaf: one of ``case.count`` equal ones.
        layers: of its stack; 1 for a triangular leaf.
        full_thickness: at which it would reach the design stress, on the beam [m].
        full_stiffness: of all leaves at that thickness and this width [N/m].
        closed_thickness, closed_stiffness: the same by the closed forms.
    """

    leaf: StraightLeaf
    layers: int
    full_thickness: float
    full_stiffness: float
    closed_thickness: float
    closed_stiffness: float


def elastic(case: Case) -> Elastic:
    """Constants of the case's material."""
    return Elastic(case.elastic_modulus, case.poisson_ratio)


def size_leaf(case: Case, fittings: Fittings) -> SizedLeaf:
    """The leaf of a straight shape.

    Raises:
        InfeasibleError: layers or height do not reach the wanted stiffness, the sheet is too thick
            for the stress, or the leaf becomes thinner than can be cut.
    """
    try:
        sized = _triangle(case, fittings) if case.shape == "triangular" else _stack(case, fittings)
    except ValueError as error:
        claim = f"length of the leaf ({error})"
        raise InfeasibleError(
            claim, case.length, case.length, "m", ("raise leaf.length",)
        ) from error
    except ArithmeticError as error:
        claim = f"deflection that the beam follows ({error})"
        raise InfeasibleError(
            claim, case.deflection, case.deflection, "m", ("lower target.spring_deflection",)
        ) from error
    least = case.min_web if case.shape != "triangular" else 0.0
    if sized.leaf.thickness < least:
        raise InfeasibleError(
            "thickness at the clamp, for the wanted stiffness", sized.leaf.thickness, least, "m",
            ("lower leaf.sheet_thickness: one layer has more stiffness than is wanted",),
        )  # fmt: skip
    return sized


def _stack(case: Case, fittings: Fittings) -> SizedLeaf:
    """Thickness by the stress; layers, then a smaller thickness, by the stiffness."""
    one = StraightLeaf(_SHAPES[case.shape], case.length, full_thickness(case), case.sheet, fittings)
    full = _at_stress(case, one)
    layer = case.count * _loaded(case, full).stiffness
    layers = case.layers or math.ceil(case.stiffness / layer * (1.0 - _ROUND_OFF))
    wide = replace(full, width=layers * case.sheet)
    most = layers * layer
    _require_layers(case, layer, layers)
    leaf = _at_stiffness(case, wide, _by_thickness) if case.stiffness else wide
    return _sized(case, leaf, layers, full.thickness, most)


def _require_layers(case: Case, layer: float, layers: int) -> None:
    """Layers and height must do for the wanted stiffness; what would do is computed."""
    enough = math.ceil(case.stiffness / layer * (1.0 - _ROUND_OFF))
    if case.stiffness and layers < enough:
        raise InfeasibleError(
            f"stiffness of {layers} layers at the design stress", layers * layer, case.stiffness,
            "N/m", (f"raise leaf.layers from {layers} to {enough}",),
        )  # fmt: skip
    height = case.count * layers * case.sheet
    if case.height and height > case.height * (1.0 + 1e-9):
        raise InfeasibleError(
            f"height of {case.count} x {layers} layers", height, case.height, "m",
            (f"raise envelope.height from {1e3 * case.height:.4g} to {1e3 * height:.4g} mm",),
        )  # fmt: skip


def _triangle(case: Case, fittings: Fittings) -> SizedLeaf:
    """Thickness of a sheet that the stress allows; the width by the stiffness, or as given."""
    closed = full_thickness(case)
    guess = case.width or min(case.room, 0.5 * case.length)
    start = StraightLeaf("triangular", case.length, closed, guess, fittings)
    full = _at_stress(case, start)
    sheet = case.sheet or sheet_for(full.thickness)
    leaf = replace(full, thickness=sheet)
    if case.stiffness:
        leaf = _at_stiffness(case, leaf, _by_width)
    stress = float(_loaded(case, leaf).peak_stress[-1])
    if stress > case.design_stress * (1.0 + 1e-6):
        thinner = sheet_for(full.thickness)
        raise InfeasibleError(
            f"stress of a sheet of {1e3 * sheet:.4g} mm", stress, case.design_stress, "Pa",
            (f"lower leaf.sheet_thickness from {1e3 * sheet:.4g} to {1e3 * thinner:.4g} mm",),
        )  # fmt: skip
    if case.height and case.count * leaf.width > case.height * (1.0 + 1e-9):
        height = math.ceil(1e5 * case.count * leaf.width) / 1e5
        raise InfeasibleError(
            f"height of {case.count} leaves", case.count * leaf.width, case.height, "m",
            (f"raise envelope.height from {1e3 * case.height:.4g} to {1e3 * height:.6g} mm",),
        )  # fmt: skip
    most = case.count * _loaded(case, replace(leaf, thickness=full.thickness)).stiffness
    return _sized(case, leaf, 1, full.thickness, most)


def _sized(
    case: Case, leaf: StraightLeaf, layers: int, full_thick: float, full_stiff: float
) -> SizedLeaf:
    closed = greatest_stiffness(
        SHAPES[case.shape],
        case.elastic_modulus,
        leaf.width,
        case.length,
        case.design_stress,
        case.deflection,
    )
    return SizedLeaf(
        leaf=leaf,
        layers=layers,
        full_thickness=full_thick,
        full_stiffness=full_stiff,
        closed_thickness=full_thickness(case),
        closed_stiffness=case.count * float(closed),
    )


def _loaded(case: Case, leaf: StraightLeaf) -> LeafStates:
    """The leaf at s_max; both directions are alike."""
    return leaf_states(leaf, elastic(case), np.array([case.deflection]))


def _at_stress(case: Case, leaf: StraightLeaf) -> StraightLeaf:
    """The leaf as thick as the design stress allows: its stress is nearly as its thickness."""
    for _ in range(_PASSES):
        share = case.design_stress / float(_loaded(case, leaf).peak_stress[-1])
        if abs(share - 1.0) <= _TOLERANCE:
            return leaf
        leaf = replace(leaf, thickness=share * leaf.thickness)
    return leaf


def _at_stiffness(
    case: Case, leaf: StraightLeaf, by: Callable[[StraightLeaf, float], StraightLeaf]
) -> StraightLeaf:
    """The leaf with the wanted stiffness at s_max; ``by`` changes its stiffness by a factor.

    It is given up where the leaf becomes far thinner than can be cut.
    """
    for _ in range(_PASSES):
        share = case.stiffness / (case.count * _loaded(case, leaf).stiffness)
        if abs(share - 1.0) <= _TOLERANCE or leaf.thickness < 0.5 * case.min_web:
            return leaf
        leaf = by(leaf, share)
    return leaf


def _by_thickness(leaf: StraightLeaf, share: float) -> StraightLeaf:
    return replace(leaf, thickness=leaf.thickness * float(np.cbrt(share)))


def _by_width(leaf: StraightLeaf, share: float) -> StraightLeaf:
    return replace(leaf, width=leaf.width * share)
