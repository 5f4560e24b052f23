"""The curves of a rotary flexure spring for the report."""

from __future__ import annotations

import numpy as np

from springcad.kinds.rotary_flexure.numbers import hysteresis
from springcad.kinds.rotary_flexure.response import both_ways
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.result import Plot, Series


def plots(spring: Spring) -> tuple[Plot, ...]:
    """Torque, stress and gap over the stroke, and stress along a flexure."""
    forward, backward = spring.strokes
    angle = both_ways(forward.angle, -backward.angle)
    allowed = spring.law.inputs.design_stress
    wanted = np.sign(angle) * spring.target.torque(np.abs(angle))
    along = [
        Series(
            f"{kind}, {way}",
            stroke.full.stations[0],
            getattr(stroke.full, f"{kind.replace(' ', '_')}_stress")[0],
            dashed=kind == "local",
        )
        for stroke, way in ((forward, "counter-clockwise"), (backward, "clockwise"))
        for kind in ("nominal", "local")
    ]
    return (
        Plot("Torque", "angle", "rad", "torque", "N*m",
             (Series("spring on its camshaft", angle,
                     both_ways(forward.torque, -backward.torque)),
              Series("target", angle, wanted, dashed=True),
              *_friction_series(spring))),
        Plot("Stress along a flexure at the design deflection", "distance from the root", "m",
             "stress", "Pa", tuple(along), limit=allowed),
        Plot("Largest stress over the stroke", "angle", "rad", "stress", "Pa",
             (Series("nominal", angle,
                     both_ways(forward.nominal_stress, backward.nominal_stress)),
              Series("inner fibre", angle,
                     both_ways(forward.local_stress, backward.local_stress), dashed=True)),
             limit=allowed),
        Plot("Smallest gap between flexures", "angle", "rad", "gap", "m",
             (Series("gap", both_ways(forward.gap_angle, -backward.gap_angle),
                     both_ways(forward.gap, backward.gap)),)),
    )  # fmt: skip


def _friction_series(spring: Spring) -> tuple[Series, ...]:
    response = hysteresis(spring)
    return tuple(
        Series(label, np.asarray(response["friction_angle_rad"]), np.asarray(response[key]))
        for label, key in (("loading", "loading_torque_Nm"), ("unloading", "unloading_torque_Nm"))
        if response
    )
