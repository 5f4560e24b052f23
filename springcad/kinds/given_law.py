"""The torque law that a spec gives."""

from __future__ import annotations

import numpy as np

from springcad.kinds.law_spec import Law as LawSpec
from springcad.kinds.target_law import (
    Rise,
    exponential,
    polynomial,
    stiffness_polynomial,
    stiffness_table,
    table,
)


def rise_of(law: LawSpec, stroke: float) -> Rise:
    """The law over the angle from the end of the dead zone; exactly one form of it is given."""
    if law.exponential is not None:
        return exponential(law.exponential.scale, law.exponential.decade)
    if law.linear is not None:
        return polynomial((law.linear,), stroke)
    if law.polynomial is not None:
        return polynomial(law.polynomial, stroke)
    if law.table is not None:
        return table(np.array(law.table))
    if law.stiffness is not None and law.stiffness.table is not None:
        return stiffness_table(np.array(law.stiffness.table))
    if law.stiffness is not None and law.stiffness.polynomial is not None:
        return stiffness_polynomial(law.stiffness.polynomial, stroke)
    raise ValueError("a valid spec has a law")
