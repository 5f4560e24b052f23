"""Rotary flexure spring (paper 004): a ring of tapered flexures round a toothed camshaft.

Importing this package is cheap; what is slow to load is loaded when a function is called.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from springcad.kinds.rotary_flexure.spec import SPEC_MODEL, TEMPLATE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from springcad.kinds.calibrating import Calibration, Stiffness
    from springcad.result import Check, Judgement, Progress, Result
    from springcad.sheet import Sheet
    from springcad.spec.source import Spec
    from springcad.spec.torque_curve import TorqueFile
    from springcad.written import WrittenDesign

__all__ = [
    "SPEC_MODEL",
    "TEMPLATE",
    "calibrate_design",
    "check_spec",
    "design_spec",
    "explain_spec",
    "judge_decks",
    "judge_design",
]


def check_spec(spec: Spec) -> tuple[Check, ...]:
    """Closed-form checks of a spec of this kind, well under a second."""
    from springcad.kinds.rotary_flexure.aim import Aim, is_open
    from springcad.kinds.rotary_flexure.candidates import range_checks
    from springcad.kinds.rotary_flexure.feasibility import feasibility_checks
    from springcad.kinds.rotary_flexure.inputs import case_of, rotary_spec
    from springcad.kinds.rotary_flexure.stack import named, stack_of

    model = rotary_spec(spec.model)
    if is_open(model):
        return range_checks(Aim.of(model))
    return named(feasibility_checks(case_of(model)), stack_of(model))


def design_spec(spec: Spec, progress: Progress) -> Result:
    """Design ring and camshaft; InfeasibleError when no part can meet the spec."""
    from springcad.kinds.rotary_flexure.decision import design_spring

    return design_spring(spec, progress)


def explain_spec(spec: Spec, progress: Progress) -> Sheet:
    """The calculation sheet of ring and camshaft."""
    from springcad.kinds.rotary_flexure.sheet import explain_spring

    return explain_spring(spec, progress)


def judge_design(design: WrittenDesign, progress: Progress) -> Judgement:
    """Contact finite elements against the report, over the whole stroke in both directions."""
    from springcad.kinds.rotary_flexure.judge import judge_spring

    return judge_spring(design, progress)


def calibrate_design(
    design: WrittenDesign, curve: TorqueFile, stiffness: Stiffness, progress: Progress
) -> Calibration:
    """Modulus or root compliance, friction and offset from a bench test of a written spring."""
    from springcad.kinds.rotary_flexure.calibration import calibrate_spring

    return calibrate_spring(design, curve, stiffness, progress)


def judge_decks(design: WrittenDesign) -> Mapping[str, str]:
    """The same finite elements as input decks, one for each direction."""
    from springcad.kinds.rotary_flexure.deck import judge_decks

    return judge_decks(design)
