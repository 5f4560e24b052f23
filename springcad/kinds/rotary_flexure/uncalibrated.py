"""A written spring without the root compliance of its calibration, for a judge who has none.

The finite elements of a sector have the root that is drawn. What a bench found beyond it (a soft
housing, say) they cannot know, so the design's own model is taken without it too, and the two are
compared like with like. That ring is stiffer, and pressed where the camshaft was not made for it:
contact pressures are left out.
"""

from __future__ import annotations

from dataclasses import replace

from springcad.kinds.rotary_flexure.bench_model import extra_root, seated_as_drawn
from springcad.kinds.rotary_flexure.response import both_ways
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.written import WrittenDesign

ROOT_ASSUMPTION = (
    "The root compliance that the calibration adds is in the design's numbers and not in the "
    "second opinion, which is compared with the design's model without it; contact pressure is "
    "then not compared."
)


def without_calibrated_root(written: WrittenDesign) -> WrittenDesign:
    """The design with the compliance and the response that its drawings alone give it.

    Raises IncompleteDesignError like ``written_spring``.
    """
    root = written.number("design.calibrated_root_coefficient")
    spring = written_spring(written)
    reported = written.array("response.angle_rad")
    angles = (reported[reported > 0.0], -reported[reported < 0.0][::-1])
    forward, backward = (
        seated_as_drawn(written, spring, way, angle, root=-root)
        for way, angle in zip((1, -1), angles, strict=True)
    )

    response = {
        "angle_rad": both_ways(forward.angle, -backward.angle),
        "torque_Nm": both_ways(forward.torque, -backward.torque),
        "contact_force_N": both_ways(forward.force, backward.force),
        "contact_station_m": both_ways(forward.station, backward.station),
    }
    compliance = written.number("design.root_compliance_rad_per_Nm") - extra_root(spring, root)
    return replace(
        written,
        design={
            **written.design,
            "root_compliance_rad_per_Nm": compliance,
            "calibrated_root_coefficient": 0.0,
        },
        response={**written.response, **response},
    )
