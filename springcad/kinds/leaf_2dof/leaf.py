"""The parts of a unit: a leaf of constant section, and the lever whose roller bends it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from springcad.mechanics.section import second_moment_of_area

Clamp = Literal["outboard", "inboard"]


@dataclass(frozen=True)
class Leaf:
    """A strip of sheet, SI.

    Attributes:
        width: a, along the roller.
        thickness: b, in the plane of bending (the paper calls it width).
        elastic_modulus, poisson_ratio: of the sheet.
    """

    width: float
    thickness: float
    elastic_modulus: float
    poisson_ratio: float

    @property
    def bending_stiffness(self) -> float:
        """EI = E a b³/12 [N m²] (003, Eq. 7)."""
        inertia = second_moment_of_area(self.width, 0.5 * self.thickness)
        return self.elastic_modulus * float(inertia)


@dataclass(frozen=True)
class Lever:
    """A lever that turns about the pivot of an axis and carries a roller, SI.

    At rest the centre of the roller is at (R, 0) from the pivot, and the roller touches the leaf
    that lies along x beside it.

    Attributes:
        radius: R, from the pivot to the centre of the roller.
        roller_radius: r.
        clamp: the leaf is held at x = R + L (outboard) or at x = R − L (inboard).
    """

    radius: float
    roller_radius: float
    clamp: Clamp
