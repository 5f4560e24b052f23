"""Making up for what the synthesis leaves out: the contact part is not rigid, nor is the mount.

Every method looks at what a profile does, simulated or measured, and says what to make instead:

- ``shift`` (001, section 3.3): at each torque the angle of a pseudo law differs from that of the
  law by as much as the answer does, the other way. Once. Where the torque goes with the angle, an
  error e of it becomes −(e/(1 + e))², nothing gained from a third on.
- ``multiplicative``: at each torque the angle of the last pseudo law is multiplied by that of the
  law over that of the answer. It comes to rest from any error, and needs only a torque curve: that
  of finite elements of the user's own or of a test bench does as well.
- ``compliance``: the compliance of the element enters the synthesis. One update mends all but a
  tenth of the error.

A pseudo law is kept as the ratio of its angle to that of the law, both from the end of the dead
zone: a short series. Interpolated ratios are too rough to be corrected twice.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.errors import InfeasibleError
from springcad.kinds.roller_cam.contact_compliance import ProfileCompliance, profile_compliance
from springcad.kinds.roller_cam.element import ElementDimensions
from springcad.kinds.roller_cam.forward import forward
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.roller_cam.synthesis import OVERRUNS, ContactProfile, synthesise
from springcad.kinds.target_law import OVERRUN, Law

Floats = NDArray[np.float64]
Method = Literal["none", "shift", "multiplicative", "compliance"]

JUDGED_FROM = 1.0 / 38.0
"""Errors of the torque count from this share of the stroke (0.05 deg of 1.9 deg): at rest the law
is 0, and a relative error of it means nothing."""
SETTLED = 1e-3
"""Updates end when the largest relative error of the torque is below this."""
MOST_UPDATES = {"none": 0, "shift": 1, "multiplicative": 6, "compliance": 6}
DEGREE = 7
_FADE = 0.05
"""Share of the series' range over which its slope fades beyond its end."""
_SIMULATED = 80
_DENSE = 3000


@dataclass(frozen=True)
class TorqueCurve:
    """An answer, simulated or measured: torque (A,) [N m] of one group at angles (A,) [rad] > 0."""

    angle: Floats
    torque: Floats


Simulator = Callable[[ContactProfile], TorqueCurve]


@dataclass(frozen=True)
class AngleRatio:
    """Angle of a pseudo law over that of the law, both from the end of the dead zone.

    A Chebyshev series in √(x² + x₁²), x the angle of the law and x₁ the first that was seen: so
    the ratio is level at rest, where a trend would be carried into what nobody knows. Beyond the
    last angle seen it soon becomes level too.

    Attributes:
        coefficients: of the series (N,).
        first, last: x₁ and the last angle [rad].
    """

    coefficients: tuple[float, ...]
    first: float
    last: float

    def __call__(self, angle: Floats) -> Floats:
        """The ratio at angles of the law (A,) [rad], from the end of the dead zone."""
        end = math.hypot(self.last, self.first)
        series = Chebyshev(np.array(self.coefficients), domain=[self.first, end])
        place = np.hypot(angle, self.first)
        within = np.minimum(place, end)
        fade = _FADE * end
        return np.asarray(
            series(within) - fade * np.expm1((within - place) / fade) * series.deriv()(within)
        )


@dataclass(frozen=True)
class Compensated:
    """A profile and how it was found.

    Attributes:
        profile: to be made. One made for a pseudo law has the angles of that law.
        compliance: of the element with it.
        errors: largest relative error of the torque, of the profile without compensation and after
            each update.
        ratio: that of the pseudo law that ``profile`` was made for; None where there is none.
    """

    profile: ContactProfile
    compliance: ProfileCompliance
    errors: tuple[float, ...]
    ratio: AngleRatio | None


def compensate(
    joint: Joint, law: Law, dimensions: ElementDimensions, method: Method
) -> Compensated:
    """The profile with which the element follows the law, as far as the method goes.

    Updates end when the error is small or no longer falls, and the best profile is taken (after a
    shift, the shifted one). Errors are those of the beam with the element's compliance
    (``simulated``).

    Raises:
        InfeasibleError: the joint cannot follow the law or the pseudo law, or the parts of the
            element do not fit together.
    """
    wanted, overruns = law, tuple(OVERRUNS)
    tries = [_tried(synthesise(joint, law), law, dimensions, None)]
    while len(tries) <= MOST_UPDATES[method] and _worth_it([each.error for each in tries]):
        last = tries[-1]
        # An overrun that comes and goes would change the contact part each time.
        reached = last.profile.flank.angle[-1] * (1.0 + 1e-9)
        overruns = tuple(share for share in overruns if share * wanted.deflection <= reached)
        ratio, told = None, None
        if method == "compliance":
            told = last.compliance.at_angle
        else:
            shift = method == "shift"
            ratio = shifted(law, last.curve) if shift else corrected(law, last.ratio, last.curve)
            wanted = pseudo_law(law, ratio)
        profile = synthesise(joint, wanted, compliance=told, overruns=overruns)
        tries.append(_tried(profile, law, dimensions, ratio))
    best = tries[-1] if method == "shift" else min(tries, key=lambda each: each.error)
    errors = tuple(each.error for each in tries)
    return Compensated(best.profile, best.compliance, errors, best.ratio)


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
    """Whether another update may help."""
    return errors[-1] >= SETTLED and (len(errors) == 1 or errors[-1] < errors[-2])


def simulated(profile: ContactProfile, compliance: ProfileCompliance) -> TorqueCurve:
    """Torque of the beam with the element's compliance, as far as the profile goes."""
    angle, rest = profile.flank.angle, profile.flank.angle[0]
    angles = rest + np.linspace(JUDGED_FROM, 1.0, _SIMULATED) * (angle[-1] - rest)
    stroke = forward(profile.joint, profile.curve, angles, compliance=compliance.at_place)
    on_profile = stroke.place <= profile.curve.length
    return TorqueCurve(angles[on_profile], stroke.torque[on_profile])


def torque_error(law: Law, curve: TorqueCurve) -> float:
    """Largest |τ/τ_law − 1| from ``JUDGED_FROM`` of the stroke to its end."""
    first = law.dead_zone + JUDGED_FROM * (law.deflection - law.dead_zone)
    counts = (curve.angle >= first * (1.0 - 1e-9)) & (curve.angle <= law.deflection * (1.0 + 1e-9))
    wanted = law.torque(curve.angle[counts])
    return float(np.max(np.abs(curve.torque[counts] / wanted - 1.0)))


def shifted(law: Law, curve: TorqueCurve) -> AngleRatio:
    """The pseudo law of 001: as far from the law as ``curve`` is, on the other side."""
    wanted, got = _angles_of_equal_torque(law, curve)
    return _fitted(wanted, 2.0 - got / wanted)


def corrected(law: Law, ratio: AngleRatio | None, curve: TorqueCurve) -> AngleRatio:
    """The next pseudo law after one with ``ratio`` (None: the law itself) gave ``curve``."""
    wanted, got = _angles_of_equal_torque(law, curve)
    last = np.ones_like(wanted) if ratio is None else ratio(wanted)
    return _fitted(wanted, last * wanted / got)


def pseudo_law(law: Law, ratio: AngleRatio) -> Law:
    """The law with every angle beyond the dead zone multiplied by its ratio.

    Raises:
        InfeasibleError: the angles would not ascend.
    """
    stroke = law.deflection - law.dead_zone
    x = np.linspace(0.0, (1.0 + OVERRUN) * stroke, _DENSE)
    y = x * ratio(x)
    least = float(np.min(np.diff(y) / np.diff(x)))
    if least <= 0.0:
        claim = "slope of the pseudo law's angle over that of the law, which must ascend"
        remedy = "use the compensation `compliance` or `multiplicative`, or a thicker contact part"
        raise InfeasibleError(claim, least, 0.0, "1", (remedy,))
    back = CubicSpline(y, x)
    energy = CubicSpline(y, law.torque(law.dead_zone + x)).antiderivative()

    def after_dead_zone(curve: Callable[[Floats], Floats]) -> Callable[[Floats], Floats]:
        def of_angle(angle: Floats) -> Floats:
            z = np.asarray(angle, dtype=np.float64) - law.dead_zone
            return np.where(z < 0.0, 0.0, curve(np.maximum(z, 0.0)))

        return of_angle

    return replace(
        law,
        deflection=law.dead_zone + stroke * float(ratio(np.array([stroke]))[0]),
        torque=after_dead_zone(lambda z: law.torque(law.dead_zone + back(z))),
        energy=after_dead_zone(energy),
        stiffness=after_dead_zone(lambda z: law.stiffness(law.dead_zone + back(z)) * back(z, 1)),
    )


def _angles_of_equal_torque(law: Law, curve: TorqueCurve) -> tuple[Floats, Floats]:
    """Angles at which law and curve have the torques of the curve, from the end of the dead zone.

    Torques beyond those of the law and its continuation are left out.
    """
    stroke = law.deflection - law.dead_zone
    x = np.linspace(0.0, (1.0 + OVERRUN) * stroke, _DENSE)
    torque = law.torque(law.dead_zone + x)
    rises = np.concatenate([[True], torque[1:] > np.maximum.accumulate(torque)[:-1]])
    got = curve.angle - law.dead_zone
    within = (curve.torque > torque[1]) & (curve.torque < torque[-1]) & (got > 0.0)
    wanted = CubicSpline(torque[rises], x[rises])(curve.torque[within])
    return np.asarray(wanted), got[within]


def _fitted(angle: Floats, ratio: Floats) -> AngleRatio:
    """Least-squares series through ratios (P,); of a lower degree through few."""
    first, last = float(angle.min()), float(angle.max())
    domain = [first, math.hypot(last, first)]
    degree = min(DEGREE, (len(angle) - 1) // 3)
    series = Chebyshev.fit(np.hypot(angle, first), ratio, degree, domain=domain)
    return AngleRatio(tuple(float(c) for c in series.coef), first, last)
