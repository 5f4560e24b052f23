"""Both axes together in the calculation sheet of leaves."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.kinds.leaf_2dof.made import MadeLeaves
from springcad.kinds.leaf_2dof.wrist import solid_angle, spherical_small
from springcad.sheet import Section, Step, derived, found, given

_PAGE = "theory/leaf-2dof.md, 3"
_HESSIAN = f"Hessian of the energy with its geometric term, {_PAGE}"


def wrist_section(made: MadeLeaves) -> Section:
    """The rod with both axes turned as far as at the longest length."""
    return Section(
        "The wrist, both axes turned, longest length", tuple(_steps(made)),
        "Each axis has its own leaves; the rod stands along z at rest; α is the angle of both.",
    )  # fmt: skip


def _steps(made: MadeLeaves) -> Iterator[Step]:
    corner = made.rods[-1]
    angle = corner.angle[0]
    x, y, z = (float(value) for value in corner.direction)
    rod = made.spec.wrist.rod_length
    yield derived("alpha", "angle of both axes", "phi_l", angle, "rad", "corner of the workspace")
    yield derived("w", "size of the rod's vector", "sqrt(1 - sin(alpha)**4)",
                  math.sqrt(1.0 - math.sin(angle) ** 4), "1", _PAGE)  # fmt: skip
    yield derived("a_x", "direction of the rod, x", "cos(alpha)*sin(alpha)/w", x, "1",
                  "003, Eq. 17")  # fmt: skip
    yield derived("a_y", "direction of the rod, y", "-sin(alpha)*cos(alpha)/w", y, "1",
                  "003, Eq. 17")  # fmt: skip
    yield derived("a_z", "direction of the rod, z", "cos(alpha)**2/w", z, "1",
                  "003, Eq. 17, corrected", "003 prints cos α_x sin α_y")  # fmt: skip
    yield derived("delta", "tilt of the rod", "atan(sqrt(2)*tan(alpha))", corner.tilt, "rad", _PAGE)
    yield derived("eta", "azimuth of the rod", "-atan(tan(alpha)/tan(alpha))", corner.azimuth,
                  "rad", _PAGE)  # fmt: skip
    yield derived("delta_18", "tilt by small angles", "sqrt(2)*alpha",
                  float(spherical_small(*corner.angle).tilt), "rad", "003, Eq. 18")  # fmt: skip
    yield derived("Omega", "solid angle of the workspace", "4*asin(sin(alpha)**2)",
                  solid_angle(*corner.angle), "1", _PAGE, "sr")  # fmt: skip
    yield given("l_r", "length of the rod", rod, "m")
    yield derived("x_r", "way of the rod's tip along x", "l_r*a_x", rod * x, "m", "geometry")
    yield found("K_tilt", "stiffness of the rod against more tilt",
                float(corner.rod_stiffness[0, 0]), "N*m/rad", _HESSIAN)  # fmt: skip
    yield found("K_side", "stiffness of the rod sideways", float(corner.rod_stiffness[1, 1]),
                "N*m/rad", _HESSIAN, "003, Eq. 22 lacks the geometric term")  # fmt: skip
    rest = made.rods[0]
    yield derived("K_rest", "stiffness of the rod at rest, any way", "K_0_long",
                  float(rest.rod_stiffness[0, 0]), "N*m/rad", _PAGE)  # fmt: skip
