"""Making up for what the synthesis leaves out: the contact part is not rigid, nor is the mount.

Every method looks at what a profile does, simulated or measured, and says what to make instead:

- ``shift`` (001, section 3.3): at each torque the angle of a pseudo law differs from that of the
  law by as much as the answer does, the other way. Once. Where the torque goes with the angle, an
  error e of it becomes −(e/(1 + e))², nothing gained from a third on.
- ``multiplicative``: at each torque the angle of the last pseudo law is multiplied by that of the
  law over that of the answer. It comes to rest from any error, and needs only a torque curve: that
  of finite elements of the user's own or of a test bench does as well.
- ``compliance``: the compliance of the element enters the synthesis. One update mends all but a
  tenth of the error. Once the error has risen the mean of it and the last is taken: where the
  profile ends with the deflection, nearly as round as the roller, the strip of contact at its end,
  and with it the compliance, would go to and fro.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.kinds.roller_cam.contact_compliance import ProfileCompliance, profile_compliance
from springcad.kinds.roller_cam.element import ElementDimensions
from springcad.kinds.roller_cam.forward import forward
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.roller_cam.part import ContactCompliance
from springcad.kinds.roller_cam.pseudo_law import (
    AngleRatio,
    TorqueCurve,
    corrected,
    pseudo_law,
    shifted,
)
from springcad.kinds.roller_cam.synthesis import OVERRUNS, ContactProfile, synthesise
from springcad.kinds.target_law import Law

Floats = NDArray[np.float64]
Method = Literal["none", "shift", "multiplicative", "compliance"]

JUDGED_FROM = 1.0 / 38.0
"""Errors of the torque count from this share of the stroke (0.05 deg of 1.9 deg): at rest the law
is 0, and a relative error of it means nothing."""
SETTLED = 1e-3
"""Updates end when the largest relative error of the torque is below this."""
MOST_UPDATES = {"none": 0, "shift": 1, "multiplicative": 6, "compliance": 6}
_SIMULATED = 80


@dataclass(frozen=True)
class Compensated:
    """A profile and how it was found.

    Attributes:
        profile: to be made. One made for a pseudo law has the angles of that law.
        compliance: of the element with it.
        error: largest relative error of the torque.
        errors: the same of the profile without compensation and after each update; ``profile`` is
            not always the last.
        ratio: that of the pseudo law that ``profile`` was made for; None where there is none.
    """

    profile: ContactProfile
    compliance: ProfileCompliance
    error: float
    errors: tuple[float, ...]
    ratio: AngleRatio | None


def compensate(
    joint: Joint, law: Law, dimensions: ElementDimensions, method: Method
) -> Compensated:
    """The profile with which the element follows the law, as far as the method goes.

    Updates end when the error is small or has not fallen twice, and the best profile is taken
    (after a shift, the shifted one). Errors are those of the beam with the element's compliance
    (``simulated``).

    Raises:
        InfeasibleError: the joint cannot follow the law or the pseudo law, or the parts of the
            element do not fit together.
    """
    wanted, overruns = law, tuple(OVERRUNS)
    told: ContactCompliance | None = None
    tries = [_tried(synthesise(joint, law), law, dimensions, None)]
    while len(tries) <= MOST_UPDATES[method] and _worth_it([each.error for each in tries]):
        last = tries[-1]
        # An overrun that comes and goes would change the contact part each time.
        reached = last.profile.flank.angle[-1] * (1.0 + 1e-9)
        overruns = tuple(share for share in overruns if share * wanted.deflection <= reached)
        ratio = None
        if method == "compliance":
            found = last.compliance.at_angle
            rose = np.any(np.diff([each.error for each in tries]) > 0.0)
            told = _mean(told, found) if told is not None and rose else found
        else:
            shift = method == "shift"
            ratio = shifted(law, last.curve) if shift else corrected(law, last.ratio, last.curve)
            wanted = pseudo_law(law, ratio)
        profile = synthesise(joint, wanted, compliance=told, overruns=overruns)
        tries.append(_tried(profile, law, dimensions, ratio))
    best = tries[-1] if method == "shift" else min(tries, key=lambda each: each.error)
    errors = tuple(each.error for each in tries)
    return Compensated(best.profile, best.compliance, best.error, errors, best.ratio)


@dataclass(frozen=True)
class _Try:
    """A profile made for the pseudo law with ``ratio``, and what it does."""

    profile: ContactProfile
    compliance: ProfileCompliance
    curve: TorqueCurve
    error: float
    ratio: AngleRatio | None


def _tried(
    profile: ContactProfile, law: Law, dimensions: ElementDimensions, ratio: AngleRatio | None
) -> _Try:
    compliance = profile_compliance(profile, dimensions)
    curve = simulated(profile, compliance)
    return _Try(profile, compliance, curve, torque_error(law, curve), ratio)


def _worth_it(errors: list[float]) -> bool:
    """Whether another update may help: one of the last two left the least error so far."""
    return errors[-1] >= SETTLED and min(errors) in errors[-2:]


def _mean(one: ContactCompliance, other: ContactCompliance) -> ContactCompliance:
    return lambda angle: 0.5 * (one(angle) + other(angle))


def simulated(profile: ContactProfile, compliance: ProfileCompliance) -> TorqueCurve:
    """Torque of the beam with the element's compliance, as far as the profile goes.

    Raises:
        InfeasibleError: the roller rests nowhere on the profile.
    """
    angle, rest = profile.flank.angle, profile.flank.angle[0]
    angles = rest + np.linspace(JUDGED_FROM, 1.0, _SIMULATED) * (angle[-1] - rest)
    yielding = compliance.at_place
    try:
        stroke = forward(profile.joint, profile.curve, angles, compliance=yielding)
    except InfeasibleError as error:
        # The roller leaves a yielding element before the end of the overrun; its value is where.
        angles = angles[angles < error.value]
        if not len(angles):
            raise
        stroke = forward(profile.joint, profile.curve, angles, compliance=yielding)
    on_profile = stroke.place <= profile.curve.length
    return TorqueCurve(angles[on_profile], stroke.torque[on_profile])


def torque_error(law: Law, curve: TorqueCurve) -> float:
    """Largest |τ/τ_law − 1| from ``JUDGED_FROM`` of the stroke to its end; 1 beyond the curve."""
    first = law.dead_zone + JUDGED_FROM * (law.deflection - law.dead_zone)
    counts = (curve.angle >= first * (1.0 - 1e-9)) & (curve.angle <= law.deflection * (1.0 + 1e-9))
    wanted = law.torque(curve.angle[counts])
    missing = float(curve.angle[-1] < law.deflection * (1.0 - 2.0 / _SIMULATED))
    return float(np.max(np.abs(curve.torque[counts] / wanted - 1.0), initial=missing))
