"""The lever arm from spec to result: spring, mechanism, checks."""

from __future__ import annotations

from springcad.kinds.lever_arm.curved_spring import curved_spring
from springcad.kinds.lever_arm.feasibility import require_feasible
from springcad.kinds.lever_arm.inputs import case_of, fittings_of, lever_spec
from springcad.kinds.lever_arm.made import MadeJoint
from springcad.kinds.lever_arm.spec import LeverArmSpec
from springcad.kinds.lever_arm.straight_spring import straight_spring
from springcad.kinds.lever_arm.summary import summarise
from springcad.result import Progress, Result
from springcad.spec.source import Spec


def design_joint(spec: Spec, progress: Progress) -> Result:
    """Design the spring and say what the joint does with it.

    Raises:
        InfeasibleError: no spring of this shape can meet the spec.
    """
    return summarise(spec, make_joint(lever_spec(spec.model), progress))


def make_joint(spec: LeverArmSpec, progress: Progress) -> MadeJoint:
    """The joint itself, without words about it.

    Raises:
        InfeasibleError: no spring can; with changes that were tried and that work.
    """
    case, fittings = case_of(spec), fittings_of(spec)
    feasibility = require_feasible(case)
    density = spec.material.values.density.value
    if case.shape == "omega":
        search = (spec.leaf.topology, spec.optimiser.starts, spec.optimiser.seed)
        spring = curved_spring(case, fittings, search, density, progress)
    else:
        spring = straight_spring(case, fittings, density, progress)
    return MadeJoint(spec, case, feasibility, spring)
