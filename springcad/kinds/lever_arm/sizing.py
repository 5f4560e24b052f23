"""Thickness, layers and width of a straight leaf, on the nonlinear beam.

The closed form (000, Eq. 17) gives the thickness at which the stress is reached at s_max; the beam
corrects it. That is the thickest leaf, and the stiffest. Where a stiffness is wanted, a stack takes
the fewest layers that reach it and is then made thinner until it has just that; a triangular leaf
takes the width. A sheet has the thickness it is sold with, so the stress of a triangle is below.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from springcad.errors import InfeasibleError
from springcad.kinds.knobs import remedies
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.changes import KNOBS
from springcad.kinds.lever_arm.estimate import full_thickness, sheet_for
from springcad.kinds.lever_arm.feasibility import case_remedies, failures
from springcad.kinds.lever_arm.stack import higher_envelope, layer_count
from springcad.kinds.lever_arm.straight import Fittings, StraightLeaf, StraightShape
from springcad.kinds.lever_arm.straight_beam import Elastic, LeafStates, leaf_states
from springcad.mechanics.leaf import SHAPES, greatest_stiffness

_PASSES = 20
_TOLERANCE = 1e-7
"""Of stress and stiffness, relative."""
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
        return _triangle(case, fittings) if case.shape == "triangular" else _stack(case, fittings)
    except ValueError as error:
        raise _too_short(case, fittings, str(error)) from error
    except ArithmeticError as error:
        claim = f"deflection that the beam follows ({error})"
        raise InfeasibleError(
            claim, case.deflection, case.deflection, "m", case_remedies(case)
        ) from error


def _too_short(case: Case, fittings: Fittings, reason: str) -> InfeasibleError:
    """With the length at which eye and fillets have room, tried on the outline."""

    def faults(tried: Case) -> tuple[str, ...]:
        try:
            _ = _first_guess(tried, fittings).plan
        except ValueError:
            return ("plan", *failures(tried))
        return failures(tried)

    longer = remedies(case, [knob for knob in KNOBS if knob.target == "length"], faults)
    return InfeasibleError(f"length of the leaf ({reason})", case.length, case.length, "m", longer)


def _first_guess(case: Case, fittings: Fittings) -> StraightLeaf:
    """As thick as the closed form says; a stack of one layer."""
    width = case.sheet
    if case.shape == "triangular":
        width = case.width or min(case.room, 0.5 * case.length)
    return StraightLeaf(_SHAPES[case.shape], case.length, full_thickness(case), width, fittings)


def _require_thickness(case: Case, leaf: StraightLeaf, purpose: str) -> None:
    if leaf.thickness < case.min_web:
        raise InfeasibleError(
            f"thickness at the clamp, {purpose}", leaf.thickness, case.min_web, "m",
            case_remedies(case),
        )  # fmt: skip


def _stack(case: Case, fittings: Fittings) -> SizedLeaf:
    """Thickness by the stress; layers, then a smaller thickness, by the stiffness."""
    full = _at_stress(case, _first_guess(case, fittings))
    _require_thickness(case, full, "at the design stress")
    layer = case.count * _loaded(case, full).stiffness
    layers = layer_count(case, layer)
    wide = replace(full, width=layers * case.sheet)
    leaf = _at_stiffness(case, wide, _by_thickness) if case.stiffness else wide
    _require_thickness(case, leaf, "for the wanted stiffness")
    return _sized(case, leaf, layers, full.thickness, layers * layer)


def _triangle(case: Case, fittings: Fittings) -> SizedLeaf:
    """Thickness of a sheet that the stress allows; the width by the stiffness, or as given."""
    full = _at_stress(case, _first_guess(case, fittings))
    sheet = case.sheet or sheet_for(full.thickness)
    leaf = replace(full, thickness=sheet)
    if case.stiffness:
        leaf = _at_stiffness(case, leaf, _by_width)
    stress = float(_loaded(case, leaf).peak_stress[-1])
    if stress > case.design_stress * (1.0 + 1e-6):
        raise InfeasibleError(
            f"stress of a sheet of {1e3 * sheet:.4g} mm", stress, case.design_stress, "Pa",
            case_remedies(case),
        )  # fmt: skip
    higher = higher_envelope(case, case.count * leaf.width)
    if higher:
        raise InfeasibleError(
            f"height of {case.count} leaves", case.count * leaf.width, case.height, "m",
            tuple(higher),
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
        if abs(share - 1.0) <= _TOLERANCE or _hopeless(case, leaf):
            return leaf
        leaf = replace(leaf, thickness=share * leaf.thickness)
    return leaf


def _hopeless(case: Case, leaf: StraightLeaf) -> bool:
    """Far thinner than can be cut: the web near the pin, not the thickness, then decides."""
    return leaf.bends_in_sheet and leaf.thickness < 0.5 * case.min_web


def _at_stiffness(
    case: Case, leaf: StraightLeaf, by: Callable[[StraightLeaf, float], StraightLeaf]
) -> StraightLeaf:
    """The leaf with the wanted stiffness at s_max; ``by`` changes its stiffness by a factor."""
    for _ in range(_PASSES):
        share = case.stiffness / (case.count * _loaded(case, leaf).stiffness)
        if abs(share - 1.0) <= _TOLERANCE or _hopeless(case, leaf):
            return leaf
        leaf = by(leaf, share)
    return leaf


def _by_thickness(leaf: StraightLeaf, share: float) -> StraightLeaf:
    return replace(leaf, thickness=leaf.thickness * float(np.cbrt(share)))


def _by_width(leaf: StraightLeaf, share: float) -> StraightLeaf:
    return replace(leaf, width=leaf.width * share)
