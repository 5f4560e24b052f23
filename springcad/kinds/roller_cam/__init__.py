"""Roller cam (paper 001): a cantilever and a contact profile for any torque law.

Importing this package is cheap; what is slow to load is loaded when a function is called.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from springcad.kinds.roller_cam.spec import SPEC_MODEL, TEMPLATE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from springcad.result import Check, Judgement, Progress, Result
    from springcad.sheet import Sheet
    from springcad.spec.source import Spec
    from springcad.spec.torque_curve import TorqueFile
    from springcad.written import WrittenDesign

__all__ = [
    "SPEC_MODEL",
    "TEMPLATE",
    "check_spec",
    "compensate_design",
    "design_spec",
    "explain_spec",
    "judge_decks",
    "judge_design",
    "next_spec",
]


def check_spec(spec: Spec) -> tuple[Check, ...]:
    """Closed-form checks of a spec of this kind, well under a second."""
    from springcad.kinds.roller_cam.feasibility import feasibility_checks
    from springcad.kinds.roller_cam.inputs import case_of

    return feasibility_checks(case_of(spec.model))


def design_spec(spec: Spec, progress: Progress) -> Result:
    """Design the element; InfeasibleError when no part can meet the spec."""
    from springcad.kinds.roller_cam.design import design_joint

    return design_joint(spec, progress)


def explain_spec(spec: Spec, progress: Progress) -> Sheet:
    """The calculation sheet of element and joint."""
    from springcad.kinds.roller_cam.sheet import explain_joint

    return explain_joint(spec, progress)


def judge_design(design: WrittenDesign, progress: Progress) -> Judgement:
    """Contact finite elements against the report, over the whole stroke."""
    from springcad.kinds.roller_cam.judge import judge_joint

    return judge_joint(design, progress)


def next_spec(design: WrittenDesign) -> Spec:
    """The spec of the design that a correction of this one gives, under its next name."""
    from springcad.kinds.roller_cam.correction import next_spec

    return next_spec(design)


def compensate_design(
    spec: Spec, design: WrittenDesign, curve: TorqueFile, progress: Progress
) -> Result:
    """The next design after a torque curve of this one; InfeasibleError when there is none."""
    from springcad.kinds.roller_cam.design import redesign_joint

    return redesign_joint(spec, design, curve, progress)


def judge_decks(design: WrittenDesign) -> Mapping[str, str]:
    """The same finite elements as input decks."""
    from springcad.kinds.roller_cam.deck import judge_decks

    return judge_decks(design)
