"""The law that a profile is made for so that the joint follows another one: a pseudo law.

A curve of the joint, simulated or measured, says at each torque by how much its angle is not that
of the law. A pseudo law has the torques of the law at other angles, and is kept as the ratio of
both angles, from the end of the dead zone: a short series. Interpolated ratios are too rough to be
corrected twice.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from springcad.errors import InfeasibleError
from springcad.kinds.target_law import OVERRUN, Law

Floats = NDArray[np.float64]

DEGREE = 7
SMALL_RESIDUAL, MORE_RESIDUAL = 2e-4, 1.1
"""Root mean square of a relative angle that is not worth another degree, and how much more of it
than the highest degree leaves."""
_FADE = 0.05
"""Share of the series' range over which its slope fades beyond its end."""
_DENSE = 3000


@dataclass(frozen=True)
class TorqueCurve:
    """An answer, simulated or measured: torque (A,) [N m] of one group at angles (A,) [rad] > 0."""

    angle: Floats
    torque: Floats


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


def simplest(law: Law, ratio: AngleRatio | None, curve: TorqueCurve) -> AngleRatio:
    """The same with no more terms than the curve is worth, for one that is of a drawing or noisy.

    Of the degrees whose residual is small, or not much larger than that of the highest, the least:
    arcs of a drawing waver, and a profile must not follow that.
    """
    wanted, got = _angles_of_equal_torque(law, curve)
    last = np.ones_like(wanted) if ratio is None else ratio(wanted)
    tries = [_fitted(wanted, last * wanted / got, degree) for degree in range(DEGREE + 1)]
    residuals = [_rms(found(wanted) * got / (last * wanted) - 1.0) for found in tries]
    enough = max(SMALL_RESIDUAL, MORE_RESIDUAL * residuals[-1])
    return next(found for found, left in zip(tries, residuals, strict=True) if left <= enough)


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2)))


def expected_angle(law: Law, given: TorqueCurve, before: TorqueCurve, after: TorqueCurve) -> Floats:
    """Angles at which the torques of ``after`` are expected where ``given`` is from (A,) [rad].

    ``given`` and ``before`` are of one profile, from elsewhere and by our own model. At equal
    torque their angles, from the end of the dead zone, have a ratio; it is taken to be the same
    for the profile of which our model says ``after`` (A torques, within those of the law and its
    continuation). Beyond the torques of ``given`` it stays what it is at its ends.
    """
    wanted, got = _angles_of_equal_torque(law, given)
    place, ours = _angles_of_equal_torque(law, before)
    angle_of, _ = _inverse(law)
    order = np.argsort(place)  # the torque of a drawing may waver
    then = wanted * np.interp(wanted, place[order], (ours / place)[order])
    ratio = np.interp(angle_of(after.torque), wanted, got / then)
    return np.asarray(law.dead_zone + (after.angle - law.dead_zone) * ratio)


def _angles_of_equal_torque(law: Law, curve: TorqueCurve) -> tuple[Floats, Floats]:
    """Angles at which law and curve have the torques of the curve, from the end of the dead zone.

    Torques beyond those of the law and its continuation are left out.
    """
    angle_of, (least, most) = _inverse(law)
    got = curve.angle - law.dead_zone
    within = (curve.torque > least) & (curve.torque < most) & (got > 0.0)
    return np.asarray(angle_of(curve.torque[within])), got[within]


def _inverse(law: Law) -> tuple[CubicSpline, tuple[float, float]]:
    """Angle from the end of the dead zone over torque, and between which torques it is known."""
    stroke = law.deflection - law.dead_zone
    x = np.linspace(0.0, (1.0 + OVERRUN) * stroke, _DENSE)
    torque = law.torque(law.dead_zone + x)
    rises = np.concatenate([[True], torque[1:] > np.maximum.accumulate(torque)[:-1]])
    return CubicSpline(torque[rises], x[rises]), (float(torque[1]), float(torque[-1]))


def _fitted(angle: Floats, ratio: Floats, degree: int = DEGREE) -> AngleRatio:
    """Least-squares series through ratios (P,); of a lower degree through few."""
    first, last = float(angle.min()), float(angle.max())
    domain = [first, math.hypot(last, first)]
    degree = min(degree, (len(angle) - 1) // 3)
    series = Chebyshev.fit(np.hypot(angle, first), ratio, degree, domain=domain)
    return AngleRatio(tuple(float(c) for c in series.coef), first, last)
