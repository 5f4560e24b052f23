"""What a report says of a design that was corrected by a curve from elsewhere."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from springcad.kinds.roller_cam.compensation import torque_error
from springcad.kinds.roller_cam.correction import Correction
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.result import Outcome


def correction_outcomes(made: MadeJoint) -> Iterator[Outcome]:
    """What was given, and what our model says of the new profile; nothing without a correction."""
    if made.correction is None:
        return
    stroke, before = made.stroke, made.correction.before
    missed = torque_error(made.law, made.correction.given)
    yield Outcome(f"torque error of {before}, as given", missed, "1", None,
                  "relative, largest from 2.6 % of the stroke on")  # fmt: skip
    yield Outcome("deflection for the same torque, by springcad's model", float(stroke.angle[-1]),
                  "rad", None, "differs from the law on purpose")  # fmt: skip
    pseudo = made.followed.torque(stroke.angle)
    yield Outcome("torque by springcad's model against the pseudo law",
                  float(np.max(np.abs(stroke.torque - pseudo)) / pseudo[-1]), "1", None,
                  "over the full torque")  # fmt: skip


def correction_assumptions(made: MadeJoint, correction: Correction) -> Iterator[str]:
    """What is assumed, and what is by which model."""
    ratio = correction.ratio(np.linspace(correction.ratio.first, correction.ratio.last))
    first, last = (math.degrees(float(angle)) for angle in correction.given.angle[[0, -1]])
    full = math.degrees(float(made.stroke.angle[-1]))
    yield (
        f"The profile is not made for the law but for a pseudo law, since {correction.before} was "
        "simulated or measured elsewhere and missed the law there. At equal torque the angles of "
        "the law are multiplied by "
        f"{ratio.min():.4g} to {ratio.max():.4g} (correction {correction.count})."
    )
    yield (
        "Deflection, stiffness and torque errors are those expected where the curve is from: at "
        "equal torque the angles there and by springcad's model are taken to keep the ratio that "
        f"they had for {correction.before}. By springcad's model alone the full torque is reached "
        f"at {full:.4g} deg. Stress, forces, energy, contact, friction and gaps are that model's."
    )
    yield (
        f"The curve is that of a joint without friction and is known from {first:.4g} to "
        f"{last:.4g} deg; nearer to rest and beyond, the correction is that at its ends."
    )
