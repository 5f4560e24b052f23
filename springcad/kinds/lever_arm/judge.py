"""The second opinion on a lever arm: finite elements of its leaf against the report."""

from __future__ import annotations

from springcad.kinds.lever_arm.curved_judge import judge_omega
from springcad.kinds.lever_arm.straight_judge import judge_straight
from springcad.mechanics.fem.newton import NoEquilibriumError
from springcad.result import Judgement, Progress, check
from springcad.written import WrittenDesign


def judge_leaf(written: WrittenDesign, progress: Progress) -> Judgement:
    """Compare force and stress over the stroke.

    Raises:
        IncompleteDesignError: the report or the drawing lacks what the model needs.
    """
    judge = judge_omega if written.text("design.shape") == "omega" else judge_straight
    try:
        return judge(written, progress)
    except (NoEquilibriumError, ValueError) as error:
        return _nothing_found(str(error))


def _nothing_found(reason: str) -> Judgement:
    failed = check(
        "second opinion: meshes and bends the leaf",
        0.0,
        ">=",
        1.0,
        "1",
        source=reason,
        remedy="nobody has judged this leaf; change its fillets or its length",
    )
    return Judgement("finite elements of the leaf", (), (failed,), (), {})
