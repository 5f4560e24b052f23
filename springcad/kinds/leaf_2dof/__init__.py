"""Leaf springs in a spherical wrist with two axes of variable stiffness (paper 003).

Importing this package is cheap; what is slow to load is loaded when a function is called.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from springcad.kinds.leaf_2dof.spec import SPEC_MODEL, TEMPLATE

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
    from springcad.kinds.leaf_2dof.feasibility import feasibility_checks
    from springcad.kinds.leaf_2dof.inputs import case_of

    return feasibility_checks(case_of(spec.model))


def design_spec(spec: Spec, progress: Progress) -> Result:
    """Design the leaves; InfeasibleError when none can meet the spec."""
    from springcad.kinds.leaf_2dof.design import design_wrist

    return design_wrist(spec, progress)


def explain_spec(spec: Spec, progress: Progress) -> Sheet:
    """The calculation sheet of the leaves and of both axes."""
    from springcad.kinds.leaf_2dof.sheet import explain_leaves

    return explain_leaves(spec, progress)


def judge_design(design: WrittenDesign, progress: Progress) -> Judgement:
    """Finite elements of a leaf and its roller against the report."""
    from springcad.kinds.leaf_2dof.judge import judge_leaf

    return judge_leaf(design, progress)


def judge_decks(design: WrittenDesign) -> Mapping[str, str]:
    """The same finite elements as input decks."""
    from springcad.kinds.leaf_2dof.deck import judge_decks

    return judge_decks(design)
