"""The joint of paper 001 and torque laws for it.

R = 40 mm, r = 4 mm and y0 = 8.95 mm are not in the paper; E is 206 GPa, not the 2.06 it prints.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from springcad.kinds.roller_cam.joint import Cantilever, Joint, Roller
from springcad.kinds.target_law import Law, Rise, exponential, law_of
from springcad.mechanics.torque_law import TorqueLaw

DEGREE = np.pi / 180.0
FULL = 1.9 * DEGREE
CANTILEVER = Cantilever(
    length=24.4e-3, height=4.9e-3, width=3.4e-3, elastic_modulus=206e9, poisson_ratio=0.29
)
EXPONENTIAL = law_of(exponential(0.15, DEGREE), FULL)
"""0.15 N m (10^(θ/deg) − 1)."""


def paper_joint(drum: float = 40e-3) -> Joint:
    """The joint with another radius of the drum."""
    return Joint(CANTILEVER, Roller(radius=4e-3, drum_radius=drum, offset=8.95e-3))


PAPER = paper_joint()


def power(exponent: float, full: float, dead_zone: float = 0.0) -> Law:
    """``full`` (N m) at 1.9 deg, and as a power of the angle beyond the dead zone before."""
    stroke, rate = FULL - dead_zone, exponent * full / (FULL - dead_zone)

    def stiffness(x: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore"):
            return rate * (x / stroke) ** (exponent - 1.0)

    rise = Rise(
        torque=lambda x: full * (x / stroke) ** exponent,
        energy=lambda x: full * stroke / (exponent + 1.0) * (x / stroke) ** (exponent + 1.0),
        stiffness=stiffness,
        words="a power",
        points=np.zeros((0, 2)),
    )
    return law_of(rise, FULL, dead_zone=dead_zone)


def sampled_law(torque: Callable[[np.ndarray], np.ndarray], angle: np.ndarray) -> TorqueLaw:
    """A law from its torque, linear near rest; its kinks, if any, at some of the angles."""
    nodes, weights = np.polynomial.legendre.leggauss(12)
    start, half = angle[:-1, None], 0.5 * np.diff(angle)[:, None]
    steps = (half * weights * torque(start + half * (1.0 + nodes))).sum(axis=1)
    values = torque(angle)
    energy = np.concatenate([[0.0], np.cumsum(steps)])
    return TorqueLaw(angle, values, energy, float(values[1] / angle[1]))
