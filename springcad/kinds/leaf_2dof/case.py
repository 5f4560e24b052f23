"""What is asked of a wrist, and the units that may answer it; all of one axis, SI."""

from __future__ import annotations

from dataclasses import dataclass

from springcad.kinds.leaf_2dof.leaf import Clamp, Leaf, Lever

END_MARGIN = 0.5e-3
"""Of the leaf's straight edges beyond the furthest contact (m), for play and setting."""


@dataclass(frozen=True)
class Case:
    """A spec as the closed forms see it.

    Attributes:
        deflection: largest, at the longest effective length.
        least_stiffness, greatest_stiffness: wanted at rest, or None.
        arm_radius, roller_radius, clamp: of the lever.
        leaves: that bear together, or None: the fewest that will do.
        width, thickness: of the leaf, or the upper bounds for sizing.
        least_width, least_thickness: lower bounds, or None where the value is given.
        shortest, longest: effective lengths, or None: those that give the wanted stiffness.
        max_bend_angle: slope of the leaf at the roller; infinite for no limit.
        end_radius, guide_length, mount_length: of the leaf.
        leaf_room: for the whole leaf; infinite for no limit.
        design_stress, yield_strength: allowed in bending, and of the material.
        elastic_modulus, poisson_ratio: of the material.
        clearance: least gap between roller and guide.
        stress_factor, slope_factor: stress and bend angle of the exact unit over their estimates;
            1 while not known.
        stroke_factor: the same of the angle at which the torque peaks.
    """

    deflection: float
    least_stiffness: float | None
    greatest_stiffness: float | None
    arm_radius: float
    roller_radius: float
    clamp: Clamp
    leaves: int | None
    width: float
    least_width: float | None
    thickness: float
    least_thickness: float | None
    shortest: float | None
    longest: float | None
    max_bend_angle: float
    end_radius: float
    guide_length: float
    mount_length: float
    leaf_room: float
    design_stress: float
    yield_strength: float
    elastic_modulus: float
    poisson_ratio: float
    clearance: float
    stress_factor: float = 1.0
    slope_factor: float = 1.0
    stroke_factor: float = 1.0

    @property
    def is_sized(self) -> bool:
        """Whether width or thickness are to be found."""
        return self.least_width is not None or self.least_thickness is not None

    @property
    def lever(self) -> Lever:
        return Lever(self.arm_radius, self.roller_radius, self.clamp)

    def leaf(self, width: float, thickness: float) -> Leaf:
        """A leaf of the case's material."""
        return Leaf(width, thickness, self.elastic_modulus, self.poisson_ratio)


@dataclass(frozen=True)
class Setup:
    """The leaves of an axis, their lever, and the range of their effective length."""

    leaf: Leaf
    lever: Lever
    leaves: int
    shortest: float
    longest: float


def in_mm(length: float) -> str:
    """A length as people read it."""
    return f"{1e3 * length:.4g} mm"
