"""How far straight flexures turn before the exact beam reaches the design stress.

Length, number and stiffness leave a straight flexure no freedom: its thickness follows from the
stiffness, its stress, the same before the pad, from the deflection. The law of 004 (Eq. 11) knows
small deflections and a rigid rim; the limit here is that of the flexure as it is sized.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from springcad.kinds.rotary_flexure.settling import EVEN

STRAIGHT_LIMIT = "deflection, against that at which straight flexures reach the design stress"
STRAIGHT_STRESS = "stress of straight flexures at full load, against the design stress"
STRAIGHT_EXCESS = EVEN
"""Share by which the stress may exceed the allowed one, as that of any flexure."""
CLOSE = 1e-4
_SECANTS = 8


def straight_limit(level: Callable[[float], float], deflection: float, here: float) -> float:
    """The deflection at which the stress is the allowed one, by secants on its logarithm.

    Args:
        level: stress over the allowed one, at a deflection (rad); about proportional to it.
        deflection: from which the search starts, rad.
        here: the level there.
    """
    at, excess, slope = math.log(deflection), math.log(here), 1.0
    for _ in range(_SECANTS):
        if abs(excess) < CLOSE:
            break
        there = at - excess / slope
        found = math.log(level(math.exp(there)))
        slope = (found - excess) / (there - at)
        at, excess = there, found
    return math.exp(at)
