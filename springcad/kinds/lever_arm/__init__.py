"""Lever arm (paper 000): leaf springs behind a lever whose pivot moves.

Importing this package is cheap; what is slow to load is loaded when a function is called.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from springcad.kinds.lever_arm.spec import SPEC_MODEL, TEMPLATE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from springcad.result import Check, Judgement, Progress, Result
    from springcad.sheet import Sheet
    from springcad.spec.source import Spec
    from springcad.written import WrittenDesign

__all__ = [
    "SPEC_MODEL",
    "TEMPLATE",
    "check_spec",
    "design_spec",
    "explain_spec",
    "judge_decks",
    "judge_design",
]


def check_spec(spec: Spec) -> tuple[Check, ...]:
    """Closed-form checks of a spec of this kind, well under a second."""
    from springcad.kinds.lever_arm.feasibility import feasibility_checks
    from springcad.kinds.lever_arm.inputs import case_of

    return feasibility_checks(case_of(spec.model))


def design_spec(spec: Spec, progress: Progress) -> Result:
    """Design the spring; InfeasibleError when no part can meet the spec."""
    from springcad.kinds.lever_arm.design import design_joint

    return design_joint(spec, progress)


def explain_spec(spec: Spec, progress: Progress) -> Sheet:
    """The calculation sheet of the spring and its mechanism."""
    from springcad.kinds.lever_arm.sheet import explain_joint

    return explain_joint(spec, progress)


def judge_design(design: WrittenDesign, progress: Progress) -> Judgement:
    """Finite elements of the drawn leaf against the report, in both directions."""
    from springcad.kinds.lever_arm.judge import judge_leaf

    return judge_leaf(design, progress)


def judge_decks(design: WrittenDesign) -> Mapping[str, str]:
    """The same finite elements as input decks."""
    from springcad.kinds.lever_arm.deck import judge_decks

    return judge_decks(design)
