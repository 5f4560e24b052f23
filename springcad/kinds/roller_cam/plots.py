"""The curves of a roller cam over the angle, one direction and one group."""

from __future__ import annotations

from springcad.kinds.roller_cam.made import MadeJoint
from springcad.result import Plot, Series


def joint_plots(made: MadeJoint) -> tuple[Plot, ...]:
    """Torque and its error, stress, contact pressure, and what an offset changes."""
    stroke, law, angle = made.stroke, made.law, made.expected_angle
    friction, correction = made.friction, made.correction
    drawn = "drawn profile" if correction is None else "expected"
    elsewhere = () if correction is None else (
        Series(f"{correction.before}, given", correction.given.angle, correction.given.torque),
        Series("springcad's model", stroke.angle, stroke.torque, dashed=True),
    )  # fmt: skip
    loops = () if friction is None else (
        Series("loading", friction.angle, friction.loading),
        Series("unloading", friction.angle, friction.unloading),
    )  # fmt: skip
    wanted = law.torque(angle)
    return (
        Plot("Torque of a group", "angle", "rad", "torque", "N*m",
             (Series(drawn, angle, stroke.torque),
              Series("law", angle, wanted, dashed=True), *elsewhere, *loops)),
        Plot("Torque error", "angle", "rad", "error over the full torque", "1",
             (Series(drawn, angle, (stroke.torque - wanted) / wanted[-1]),)),
        Plot("Stress at the clamp", "angle", "rad", "stress", "Pa",
             (Series("nominal", stroke.angle, stroke.tip.stress),),
             limit=made.spec.material.design_stress),
        Plot("Contact pressure", "angle", "rad", "pressure", "Pa",
             (Series("elastic strip", stroke.angle, made.strips.peak_pressure),)),
        Plot("Torque per outward offset of the profile", "angle", "rad", "torque per length", "N",
             (Series("sensitivity", stroke.angle, made.sensitivity),)),
    )  # fmt: skip
