"""The torque law of a spec in the calculation sheet of every kind that can follow one."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence

import numpy as np

from springcad.kinds.law_spec import Law as LawSpec
from springcad.kinds.target_law import Law
from springcad.sheet import Step, derived, given

_SOURCE = "target.law"


def law_steps(given_law: LawSpec, law: Law, angle: str, shared: str = "") -> Iterator[Step]:
    """Torque ``T_w`` and energy ``W_w`` at the full deflection, and the slope ``k_0`` at rest.

    Args:
        given_law: as in the spec.
        law: the same over the whole angle, for one group.
        angle: what the full angle from the end of the dead zone is, as a formula.
        shared: symbol of the number of groups that share the torque, if they do.
    """
    end = np.array([law.deflection])
    torque, energy = float(law.torque(end)[0]), float(law.energy(end)[0])
    at_rest = float(law.stiffness(np.array([law.dead_zone]))[0])
    stroke = law.deflection - law.dead_zone
    yield derived("x_w", "angle from the end of the dead zone", angle, stroke, "rad", _SOURCE)
    forms = yield from _forms(given_law)
    told = zip(
        ("T_w", "W_w", "k_0"),
        ("torque of the law there", "energy of the law there", "stiffness of the law at rest"),
        (torque, energy, at_rest),
        ("N*m", "J", "N*m/rad"),
        strict=True,
    )
    for index, (symbol, meaning, value, unit) in enumerate(told):
        if forms:
            formula = f"({forms[index]})/{shared}" if shared else forms[index]
            yield derived(symbol, meaning, formula, value, unit, _SOURCE)
        else:
            yield given(symbol, meaning, value, unit, _SOURCE, law.words)


def _forms(law: LawSpec) -> Generator[Step, None, tuple[str, ...]]:
    """The numbers of the law, and its torque, energy and slope as formulas; none for a table."""
    if law.exponential is not None:
        yield given("T_s", "scale of the exponential law", law.exponential.scale, "N*m")
        yield given("x_d", "angle of a decade", law.exponential.decade, "rad")
        return _EXPONENTIAL
    coefficients = _coefficients(law)
    for power, coefficient in enumerate(coefficients, 1):
        yield given(f"c_{power}", f"coefficient of x^{power} in the torque", coefficient,
                    "N*m/rad" if power == 1 else f"N*m/rad^{power}")  # fmt: skip
    if not coefficients:
        return ()
    powers = range(2, len(coefficients) + 1)
    torque = " + ".join(["c_1*x_w", *(f"c_{power}*x_w**{power}" for power in powers)])
    energy = " + ".join(f"c_{power}*x_w**{power + 1}/{power + 1}" for power in (1, *powers))
    return torque, energy, "c_1"


def _coefficients(law: LawSpec) -> Sequence[float]:
    """Of the torque as a polynomial; none where it is another law."""
    if law.linear is not None:
        return (law.linear,)
    if law.stiffness is not None and law.stiffness.polynomial is not None:
        return [c / (power + 1.0) for power, c in enumerate(law.stiffness.polynomial)]
    return law.polynomial or ()


_EXPONENTIAL = (
    "T_s*(10**(x_w/x_d) - 1)",
    "T_s*(x_d*(10**(x_w/x_d) - 1)/log(10) - x_w)",
    "T_s*log(10)/x_d",
)
"""001, section 4.3, its integral, and its slope."""
