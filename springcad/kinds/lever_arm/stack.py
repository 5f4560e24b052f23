"""How many layers of sheet a leaf is stacked of, straight or curved."""

from __future__ import annotations

import math
from collections.abc import Callable

from springcad.errors import InfeasibleError
from springcad.kinds.lever_arm.case import Case

_ROUND_OFF = 1e-6
"""Share of a layer that is not worth another one."""


def layer_count(case: Case, layer: float) -> int:
    """As given, else the fewest that reach the wanted stiffness.

    Args:
        layer: stiffness of all leaves of one layer each, at the design stress [N/m].

    Raises:
        InfeasibleError: layers or height do not do, with the numbers that do.
    """
    enough = max(math.ceil(case.stiffness / layer * (1.0 - _ROUND_OFF)), 1)
    layers = case.layers or enough
    if layers < enough:
        change = [f"raise leaf.layers from {layers} to {enough}", *_higher(case, enough)]
        raise InfeasibleError(
            f"stiffness of {layers} layers at the design stress", layers * layer, case.stiffness,
            "N/m", (" and ".join(change),),
        )  # fmt: skip
    change = _higher(case, layers)
    if change:
        raise InfeasibleError(
            f"height of {case.count} x {layers} layers", case.count * layers * case.sheet,
            case.height, "m", tuple(change),
        )  # fmt: skip
    return layers


def too_stiff(case: Case, layers: int, least: float) -> InfeasibleError:
    """For a stack that has ``least`` stiffness [N/m] where it is as thin as can be cut.

    Stiffness is proportional to the stack's width, so the changes hold exactly.
    """
    share = case.stiffness / least
    changes = [f"raise target.spring_stiffness from {1e-3 * case.stiffness:.4g} to "
               f"{_rounded(1e-3 * least, math.ceil):g} N/mm"]  # fmt: skip
    fewer = math.floor(share * layers)
    if case.layers and fewer:
        changes.append(f"lower leaf.layers from {layers} to {fewer}")
    elif layers == 1:
        changes.append(f"lower leaf.sheet_thickness from {1e3 * case.sheet:.4g} to "
                       f"{_rounded(1e3 * share * case.sheet, math.floor):g} mm")  # fmt: skip
    return InfeasibleError(
        f"stiffness of {case.count} x {layers} layers, as thin as can be cut", least,
        case.stiffness, "N/m", tuple(changes),
    )  # fmt: skip


def _rounded(value: float, way: Callable[[float], int]) -> float:
    """To three digits."""
    digits = 2 - math.floor(math.log10(value))
    return way(value * 10.0**digits) / 10.0**digits


def _higher(case: Case, layers: int) -> list[str]:
    """The envelope's height that so many layers need, if it has less."""
    return higher_envelope(case, case.count * layers * case.sheet)


def higher_envelope(case: Case, height: float) -> list[str]:
    """The change that gives leaves of a height [m] room; none if they have it."""
    if not case.height or height <= case.height * (1.0 + 1e-9):
        return []
    rounded = math.ceil(1e5 * height * (1.0 - 1e-9)) / 1e2
    return [f"raise envelope.height from {1e3 * case.height:.4g} to {rounded:.6g} mm"]
