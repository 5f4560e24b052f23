"""What the sheets of a stack do together, as numbers, lines and a curve for the reports."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from springcad.geometry.outline_ops import profile_area, profile_polar_moment
from springcad.kinds.rotary_flexure.inputs import joint_target_of
from springcad.kinds.rotary_flexure.numbers import hysteresis, response_numbers
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.result import Outcome, Plot, Series, Value
from springcad.spec.units import LENGTH, show


def joint_design(spring: Spring) -> dict[str, Value]:
    """How many sheets there are, and what they are together; SI."""
    stack = spring.stack
    density = spring.spec.material.values.density.value
    rings = density * stack.sheets * stack.sheet
    camshafts = density * stack.series * stack.camshaft_length
    return {
        "parallel": stack.parallel,
        "series": stack.series,
        "ring_count": stack.sheets,
        "camshaft_count": stack.series,
        "sheet_thickness_m": stack.sheet,
        "camshaft_length_m": stack.camshaft_length,
        "gap_m": stack.gap,
        "height_m": stack.height,
        "spare_thickness_m": stack.spare,
        "free_play_rad": stack.series * spring.camshaft.slot.free_play,
        "ring_mass_kg": rings * profile_area(spring.ring),
        "camshaft_mass_kg": camshafts * profile_area(spring.camshaft.profile),
        "ring_inertia_kgm2": rings * profile_polar_moment(spring.ring),
        "camshaft_inertia_kgm2": camshafts * profile_polar_moment(spring.camshaft.profile),
    }


def joint_response(spring: Spring) -> dict[str, Value]:
    """Torque over angle of the whole joint: torques of sheets add, angles of springs do; SI."""
    stack, one = spring.stack, response_numbers(spring)
    share = {
        "stiffness_Nm_per_rad": 1.0 / stack.stiffness_share,
        "max_deflection_rad": stack.series,
        "max_torque_Nm": stack.parallel,
        "energy_J": stack.sheets,
        "usable_angle_rad": stack.series,
        "usable_torque_Nm": stack.parallel,
        "angle_rad": stack.series,
        "torque_Nm": stack.parallel,
        "stored_energy_J": stack.sheets,
    }
    if hysteresis(spring):
        share["hysteresis_loss_J"] = stack.sheets
    return {key: factor * np.asarray(one[key]) for key, factor in share.items()}


def with_joint(spring: Spring, of_sheet: Iterable[Outcome]) -> tuple[Outcome, ...]:
    """The lines that answer the targets of the spec, then those of one sheet."""
    stack, law = spring.stack, joint_target_of(spring.spec)
    response, design = joint_response(spring), joint_design(spring)
    end = np.array([law.deflection])
    torque, energy = (float(curve(end)[0]) for curve in (law.torque, law.energy))
    masses = design["ring_mass_kg"], design["camshaft_mass_kg"]
    return (
        Outcome("stiffness of the joint", _number(response["stiffness_Nm_per_rad"]), "N*m/rad",
                torque / law.deflection,
                f"{stack.parallel} sheets in parallel, {stack.series} springs in series"),
        Outcome("deflection of the joint, each way", _number(response["max_deflection_rad"]),
                "rad", law.deflection, "without free play"),
        Outcome("torque of the joint", _number(response["max_torque_Nm"]), "N*m", torque,
                "at the design deflection"),
        Outcome("energy of the joint", _number(response["energy_J"]), "J", energy),
        Outcome("free play of the joint, each way", _number(design["free_play_rad"]), "rad"),
        Outcome("mass of the joint", sum(map(_number, masses)), "kg", None,
                "rings and camshafts, without what joins them"),
        Outcome("height of the joint", stack.height, "m", None, _height(spring)),
        *(replace(outcome, label=f"one sheet: {outcome.label}") for outcome in of_sheet),
    )  # fmt: skip


def _height(spring: Spring) -> str:
    stack = spring.stack
    if stack.spare <= 0.0:
        return "along the axis"
    return f"along the axis; {show(stack.spare, LENGTH)} of the thickness allowed is left"


def joint_plot(spring: Spring) -> Plot:
    """Torque over angle of the whole joint."""
    response, law = joint_response(spring), joint_target_of(spring.spec)
    angle, torque = (np.asarray(response[key]) for key in ("angle_rad", "torque_Nm"))
    wanted = np.sign(angle) * law.torque(np.abs(angle))
    return Plot(
        "Torque of the joint", "angle", "rad", "torque", "N*m",
        (Series("joint", angle, torque), Series("target", angle, wanted, dashed=True)),
    )  # fmt: skip


def joint_assumptions(spring: Spring) -> tuple[str, ...]:
    """What is taken for granted about a joint of more than one sheet."""
    stack, sentences = spring.stack, []
    if stack.sheets > 1:
        sentences.append(
            "Stresses, checks, lives, advice and the second opinion are of one sheet, and so "
            f"are the curves but the first; its torque is 1/{stack.parallel} and its angle "
            f"1/{stack.series} of the joint's."
        )
    if stack.parallel > 1:
        sentences.append(
            f"The {stack.parallel} sheets on a camshaft are taken to be alike and in line: "
            "differences of thickness, and teeth or roots that are out of line, make them share "
            "the torque unevenly and are not modelled. The camshaft is driven from one end and "
            "twists by its own torque, which is left out."
        )
    if stack.series > 1:
        sentences.append(
            "What joins the camshaft of a spring to the rim of the next is taken to be rigid and "
            "is not designed; it turns with the joint."
        )
    return tuple(sentences)


def _number(value: Value) -> float:
    return float(np.asarray(value, dtype=np.float64))
