"""Can any leaf give the spring? Closed forms only, before any leaf is sized on the beam."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from springcad.kinds.feasible import advised, require_all
from springcad.kinds.knobs import far_remedies, remedies
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.changes import KNOBS, SEARCH_DECIDES, is_spec
from springcad.kinds.lever_arm.claims import claims
from springcad.result import Check

CLEAR = 0.9
"""Share of what closed forms allow that a remedy takes: what the beam finds then is in it."""


def feasibility_checks(case: Case) -> tuple[Check, ...]:
    """All closed-form checks; those that fail carry remedies that make every one of them pass."""
    return advised(tuple(claims(case)), lambda: case_remedies(case))


def require_feasible(case: Case) -> tuple[Check, ...]:
    """The checks of a feasible case; InfeasibleError with the first failing one otherwise."""
    return require_all(
        tuple(claims(case)),
        lambda: case_remedies(case),
        lambda claim: f"{claim.name} ({claim.source})",
    )


def failures(case: Case) -> tuple[str, ...]:
    """Names of the checks that fail or are too near to it for a remedy; without numbers."""
    return tuple(
        claim.name.partition(",")[0] for claim in claims(case, CLEAR) if claim.status == "fail"
    )


def case_remedies(case: Case) -> tuple[str, ...]:
    """Changes of the spec after which every closed form holds with room for its error.

    Each was recomputed as printed. Empty if closed forms already do, or if nothing was found.
    """
    broken = failures(case)
    if not broken:
        return ()

    def left(tried: Case) -> tuple[str, ...]:
        return failures(tried) if is_spec(case, tried) else (*broken, "rules of the spec")

    changes = (
        remedies(case, KNOBS, left) or tuple(_omissions(case)) or far_remedies(case, KNOBS, left)
    )
    if case.shape == "omega":
        return tuple(f"{change} {SEARCH_DECIDES}" for change in changes)
    return changes


def _omissions(case: Case) -> Iterator[str]:
    """Keys without which it works, where no number within reach does."""
    without = {
        "leaf.layers": replace(case, layers=0) if case.stiffness else case,
        "envelope.height": replace(case, height=0.0),
        "mechanism.max_pivot_force": replace(case, max_pivot_force=0.0),
    }
    for key, tried in without.items():
        if not failures(tried):
            yield f"take {key} out of the spec"
