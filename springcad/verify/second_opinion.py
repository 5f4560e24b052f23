"""The second opinion: a finished design judged by a model that took no part in it."""

from __future__ import annotations

from springcad.kinds import load_kind
from springcad.result import Check, Comparison, Judgement, Progress, check
from springcad.written import WrittenDesign

NOT_JUDGED = (
    "No second opinion was formed (--no-verify): the numbers are those of the model that made the "
    "design; springcad verify on its report.json judges it."
)
_REMEDY = (
    "two models disagree about this part, so do not trust either before the reason is known; "
    "springcad verify --deck writes the model for a third solver"
)


def second_opinion(design: WrittenDesign, progress: Progress) -> Judgement:
    """What the kind's own judge says of a written design.

    Raises:
        IncompleteDesignError: the written design lacks something that the judge needs.
    """
    return load_kind(design.kind).judge_design(design, progress)


def judgement_checks(judgement: Judgement) -> tuple[Check, ...]:
    """Disagreement beyond a tolerance is a failed check."""
    return (*judgement.checks, *(_agreement(entry) for entry in judgement.comparisons))


def _agreement(comparison: Comparison) -> Check:
    worst = abs(float(comparison.differences[comparison.worst]))
    return check(
        f"second opinion: {comparison.name}",
        worst,
        "<=",
        comparison.tolerance,
        "1" if comparison.relative else comparison.unit,
        source=f"largest difference; {comparison.source}",
        remedy=_REMEDY,
    )
