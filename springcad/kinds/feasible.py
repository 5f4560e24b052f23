"""What every kind does with its closed-form checks: advise where they fail, or refuse."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from springcad.errors import InfeasibleError
from springcad.result import Check


def advised(checks: tuple[Check, ...], remedies: Callable[[], Sequence[str]]) -> tuple[Check, ...]:
    """The checks; those that fail carry the remedies, which are found only if one does."""
    if not any(claim.status == "fail" for claim in checks):
        return checks
    advice = "; or ".join(remedies())
    return tuple(
        replace(claim, remedy=advice) if claim.status == "fail" else claim for claim in checks
    )


def require_all(
    checks: tuple[Check, ...],
    remedies: Callable[[], tuple[str, ...]],
    words: Callable[[Check], str],
) -> tuple[Check, ...]:
    """The checks, none of which fails.

    Args:
        words: of a claim, for the refusal.

    Raises:
        InfeasibleError: with the first failing one and the remedies.
    """
    for claim in checks:
        if claim.status == "fail":
            raise InfeasibleError(words(claim), claim.value, claim.limit, claim.unit, remedies())
    return checks
