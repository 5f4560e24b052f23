"""A torque law as numbers: torque and energy over the angle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError

Floats = NDArray[np.float64]

_AT_REST = 1e-7
"""The limit at rest is taken at this share of the largest torque."""


@dataclass(frozen=True)
class TorqueLaw:
    """A law τ(θ) and its integral W(θ) at A angles.

    Where the first angle is that of rest (τ = W = 0) the slope there must be given. Behind a dead
    zone, rest is at its end: the angles begin there. Leave rest out of a law whose slope is 0
    there; no part with a stiffness of its own can follow it so far.

    Attributes:
        angle: ascending magnitudes, >= 0 (A,) [rad].
        torque: > 0, at rest 0 (A,) [N m].
        energy: > 0, at rest 0 (A,) [J].
        stiffness_at_rest: slope of τ at rest [N m/rad]; unused where rest is not among the angles.
    """

    angle: Floats
    torque: Floats
    energy: Floats
    stiffness_at_rest: float = np.nan

    @property
    def begins_at_rest(self) -> bool:
        """Whether the first angle is that of rest."""
        return bool(self.torque[0] == 0.0 and self.energy[0] == 0.0)

    def at(self, rows: NDArray[np.intp]) -> TorqueLaw:
        """The law at some of its angles."""
        return TorqueLaw(self.angle[rows], self.torque[rows], self.energy[rows])


def share_of_one(law: TorqueLaw, count: int) -> TorqueLaw:
    """What the law asks of each of ``count`` equal parts, rest being stood for by a small load.

    The load has the torque ε and the energy ε²/(2k), so that the equations for torque and energy
    become, in the limit, the one for the stiffness k at rest.
    """
    torque, energy = law.torque / count, law.energy / count
    if law.begins_at_rest:
        small = _AT_REST * float(torque.max())
        torque[0] = small
        with np.errstate(divide="ignore"):
            energy[0] = 0.5 * small**2 * np.float64(count) / law.stiffness_at_rest
    return TorqueLaw(law.angle, torque, energy)


def require_law(law: TorqueLaw) -> None:
    """Refuse what is no law of an unloaded part.

    Raises:
        InfeasibleError: a torque or an energy at rest, or torque or energy not > 0 beyond.
    """
    degrees = np.degrees(law.angle)
    if law.angle[0] == 0.0 and not law.begins_at_rest:
        held = law.energy[0] != 0.0 and law.torque[0] == 0.0
        value, unit = (law.energy[0], "J") if held else (law.torque[0], "N*m")
        what = "energy" if held else "torque"
        claim = f"{what} of the law at 0 deg, where the unloaded part rests: it must be 0"
        raise InfeasibleError(claim, float(value), 0.0, unit)
    first = int(law.begins_at_rest)
    for name, values, unit in (("torque", law.torque, "N*m"), ("energy", law.energy, "J")):
        with np.errstate(invalid="ignore"):
            wrong = np.flatnonzero(~(np.isfinite(values) & (values > 0.0))[first:]) + first
        if len(wrong):
            claim = (
                f"{name} of the law at {degrees[wrong[0]]:.4g} deg, which must be positive: "
                "without a force nothing holds the contact (a law begins where its dead zone ends)"
            )
            raise InfeasibleError(claim, float(values[wrong[0]]), 0.0, unit)
    if first and not law.stiffness_at_rest >= 0.0:
        claim = f"slope of the law at rest ({degrees[0]:.4g} deg)"
        raise InfeasibleError(claim, law.stiffness_at_rest, 0.0, "N*m/rad")
