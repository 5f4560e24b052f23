"""The serpentine springs of paper 004, Table I, as optimisation problems."""

from __future__ import annotations

import math

from springcad.kinds.rotary_flexure import law
from springcad.kinds.rotary_flexure.problem import FlexureProblem

STIFFNESS = 150.0
THICKNESS = 4.5e-3
ELASTIC_MODULUS = 200e9
DESIGN_STRESS = 912e6
TIP_HALF_THICKNESS = 0.2e-3

TABLE_I = {
    "S2": (31e-3, 6e-3, 24, 14.50),
    "S3": (26e-3, 6e-3, 24, 12.09),
    "S4": (26e-3, 5.1e-3, 31, 13.40),
}
"""Root radius R, contact radius r (m), count n, deflection (degrees)."""


def flexure(name: str, bend_limit: float) -> FlexureProblem:
    """One of S2, S3, S4 with a limit on half thickness x curvature (``inf``: none)."""
    root_radius, contact_radius, count, degrees = TABLE_I[name]
    deflection, span = math.radians(degrees), root_radius - contact_radius
    force = law.tip_force(STIFFNESS, deflection, contact_radius, count)
    root = float(law.tapered_half_thickness(force, span, THICKNESS, DESIGN_STRESS))
    area = law.required_area(
        STIFFNESS, deflection, count, THICKNESS, DESIGN_STRESS, ELASTIC_MODULUS
    )
    return FlexureProblem(
        span=span,
        root_radius=root_radius,
        count=count,
        root_half_thickness=root,
        tip_half_thickness=TIP_HALF_THICKNESS,
        serpentine_factor=float(area / law.straight_area(span, root)),
        bend_limit=bend_limit,
    )
