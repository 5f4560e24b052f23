"""Torque laws nearer and nearer to a constant stiffness, as they would be typed.

A flexure has a stiffness of its own wherever it is touched, and the contact can only move along its
tip: a law may neither begin without a slope, nor stiffen much, nor soften. With a share w of it
replaced by the constant stiffness that ends at the same torque T,

    torque_w(x) = (1 - w) torque(x) + w T x / end,

its slope at rest and its energy go over into those of the constant one, and with w = 1 any law is a
linear one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from springcad.kinds.given_law import rise_of
from springcad.kinds.law_spec import Law
from springcad.spec.lists import per_angle

SHARES = (0.1, 0.25, 0.4, 0.55, 0.7, 0.85)
POINTS = 9
"""Points of a table that stands for a law of another form."""


def eased_laws(law: Law, end: float) -> Iterator[tuple[float, str]]:
    """Shares w and the law as it is typed, up to the angle ``end`` (rad), the mildest first.

    A polynomial stays one; other laws become tables.
    """
    rise = rise_of(law, end)
    torque = float(rise.torque(np.array([end]))[0])
    if law.linear is not None or torque <= 0.0:
        return
    angle = np.linspace(0.0, end, POINTS)
    for share in SHARES:
        if law.polynomial is not None:
            first, *higher = ((1.0 - share) * c for c in law.polynomial)
            yield share, _polynomial([first + share * torque / end, *higher])
            continue
        eased = (1.0 - share) * rise.torque(angle) + share * torque * angle / end
        yield share, _table(np.degrees(angle).tolist(), eased.tolist())
    yield 1.0, f"{{linear: {torque / end:.4g} N*m/rad}}"


def _polynomial(coefficients: Sequence[float]) -> str:
    terms = (f"{c:.4g} {per_angle(n).unit}" for n, c in enumerate(coefficients, start=1))
    return f"{{polynomial: [{', '.join(terms)}]}}"


def _table(degrees: Sequence[float], torques: Sequence[float]) -> str:
    points = (f"[{a:.12g} deg, {t:.5g} N*m]" for a, t in zip(degrees, torques, strict=True))
    return f"{{table: [{', '.join(points)}]}}"
