"""The joint of paper 001: a roller on a turning drum and a cantilever that carries a profile.

Frame (001, Fig. 2): origin at the tip of the unloaded cantilever, which is clamped at x = −length;
x along the cantilever and the axis of the drum, y along the way of the roller, against it: the
roller's centre starts at (start, offset) and goes to y = offset − R sin β. Its disc tilts with the
drum, so along z it is seen as an ellipse, r wide and r cos β high.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

POCKET, BLUNTED = 4.86, 1.33
"""Rotation of the root in a pocket, ``Cantilever.root_compliance``: without fillets, times E w h²,
and how fast fillets lessen it. From finite elements: within 4 % for fillets of 0.02 to 0.4 h and
mounts at least 3 h high and 2 h long; smaller ones yield less, by a fifth at 1.6 h."""


@dataclass(frozen=True)
class Cantilever:
    """The elastic part: a uniform bar of rectangular section, SI.

    Attributes:
        length: from clamp to tip.
        height: of the section in the plane of bending.
        width: thickness of the sheet, out of that plane.
        elastic_modulus, poisson_ratio: of the material.
        pocket_fillet: radius of the root fillets of a mount that a pocket holds (``Mounting``);
            None between plates, where no section of the mount turns.
    """

    length: float
    height: float
    width: float
    elastic_modulus: float
    poisson_ratio: float
    pocket_fillet: float | None = None

    @property
    def bending_stiffness(self) -> float:
        """E I with I = w h³/12 (N m²); 001 names the axis of bending y, it is z."""
        return self.elastic_modulus * self.width * self.height**3 / 12.0

    @property
    def tip_stiffness(self) -> float:
        """Force across the tip per deflection by bending alone, 3 E I/l³ (N/m)."""
        return 3.0 * self.bending_stiffness / self.length**3

    @property
    def root_compliance(self) -> float:
        """Rotation of the section at the clamp per moment there (rad/(N m))."""
        if self.pocket_fillet is None:
            return 0.0
        blunted = math.exp(-BLUNTED * self.pocket_fillet / self.height)
        return POCKET * blunted / (self.elastic_modulus * self.width * self.height**2)

    @property
    def shear_modulus(self) -> float:
        """G of an isotropic material (Pa)."""
        return self.elastic_modulus / (2.0 * (1.0 + self.poisson_ratio))


@dataclass(frozen=True)
class Roller:
    """The roller and the drum that carries it, m.

    Attributes:
        radius: r, of the roller.
        drum_radius: R, from the axis of the drum to the centre of the roller.
        offset: y₀ of the roller's centre at rest, over the axis of the cantilever.
        start: x of the roller's centre, from the tip of the cantilever.
    """

    radius: float
    drum_radius: float
    offset: float
    start: float = 0.0


@dataclass(frozen=True)
class Joint:
    """One cantilever and its roller."""

    cantilever: Cantilever
    roller: Roller
