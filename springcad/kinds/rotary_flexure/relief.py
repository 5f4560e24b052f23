"""The root thickened until its fillets bear no more than they may (``flexures.fillet_stress``).

The stress allowed in the flexure falls towards the root to a share of the design stress, the
relief. How the fillets follow it depends on the flexure: the thicker a root, the larger its stress
factor for a given fillet, about as relief^-0.5 where the flexure leans, hardly at all where it is
straight. So the power is learned from pass to pass: secants on logarithms.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.ribbon import Ribbon

Floats = NDArray[np.float64]

REACH = 1.5
"""Length over root thickness along which a root is thickened for the sake of its fillets."""
AIM = 0.998
"""Stress of the fillets, over its limit, that the sizing aims at: it stops near its aim, and on
the safe side of the limit."""
LEAST = 0.3
"""The root is thickened until at least this share of the design stress is left there."""
POWER = 0.7
"""Of the relief with which the stress of the fillets falls, before it is known;"""
POWERS = (0.4, 1.2)
"""a secant between shapes that are not settled may mislead, but not beyond these."""
_DIGITS = 6


@dataclass(frozen=True)
class Relief:
    """Stress allowed at the root over the design stress, and what it is known by.

    Attributes:
        share: of the design stress, for the next shape.
        power: d ln(stress of the fillets) / d ln(share), as far as is known.
        excess: ln of the stress over its aim at the share before, None at first or without a limit.
        before: that share.
    """

    share: float = 1.0
    power: float = POWER
    excess: float | None = None
    before: float = 1.0

    @property
    def kept(self) -> bool:
        """Whether the fillets keep their limit, or no relief makes them."""
        over = self.excess is not None and self.excess > -math.log(AIM)
        return not over or self.before == self.share == LEAST

    def after(self, stress: float, limit: float) -> Relief:
        """The relief that follows from the ``stress`` of the fillets at ``share``, both in Pa."""
        excess, power = math.log(stress / (AIM * limit)), self.power
        if self.excess is not None and self.share != self.before:
            secant = (excess - self.excess) / math.log(self.share / self.before)
            power = min(max(secant, POWERS[0]), POWERS[1])
        share = round(self.share * math.exp(-excess / power), _DIGITS)
        return Relief(min(1.0, max(LEAST, share)), power, excess, self.share)


def allowed_share(ribbon: Ribbon, stations: Floats, relief: float) -> Floats:
    """Allowed stress over the design stress along a flexure (K,): ``relief`` at the root."""
    reach = REACH * 2.0 * float(ribbon.at(np.zeros(1)).half_thickness[0])
    share = np.minimum(stations / reach, 1.0)
    return np.asarray(1.0 - (1.0 - relief) * (1.0 - share) ** 2 * (1.0 + 2.0 * share))
