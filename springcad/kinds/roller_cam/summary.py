"""A roller cam as a result: numbers, curves, part, and what was taken for granted."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from springcad.kinds.lasting import Loading
from springcad.kinds.provenance import sources
from springcad.kinds.roller_cam.checks import (
    TORQUE_TOLERANCE,
    first_contact,
    joint_checks,
    torque_errors,
    uncertain_until,
)
from springcad.kinds.roller_cam.correction import correction_entry, law_points
from springcad.kinds.roller_cam.correction_words import correction_assumptions, correction_outcomes
from springcad.kinds.roller_cam.element import MOUNTED
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.kinds.roller_cam.plots import joint_plots
from springcad.kinds.roller_cam.views import joint_views
from springcad.kinds.strength import with_strength
from springcad.result import Dimension, Outcome, Part, Result, Value
from springcad.spec.source import Spec


def summarise(spec: Spec, made: MadeJoint) -> Result:
    """Everything that the reports and files show."""
    result = Result(
        kind=spec.kind,
        name=spec.name,
        spec=spec.raw,
        design=_design(made),
        response=_response(made),
        checks=joint_checks(made),
        outcomes=tuple(_outcomes(made)),
        parts=(_part(made),),
        views=joint_views(made),
        plots=joint_plots(made),
        assumptions=tuple(_assumptions(made)),
        advice=tuple(_advice(made)),
        provenance=_provenance(spec, made),
    )
    return with_strength(result, made.spec.material, made.spec.process, _loading(made))


def _loading(made: MadeJoint) -> Loading:
    stroke, beam = made.stroke, made.joint.cantilever
    return Loading(
        name="nominal stress at the clamp",
        share=stroke.angle / stroke.angle[-1],
        stress=stroke.tip.stress,
        section=(beam.height, beam.width),
        torque=made.spec.groups * stroke.torque,
        load_ratio=0.0,
    )


def _design(made: MadeJoint) -> dict[str, Value]:
    beam, roller, size = made.joint.cantilever, made.joint.roller, made.geometry.dimensions
    return {
        "groups": made.spec.groups,
        "law": made.law.words,
        "law_points": law_points(made.spec),
        "elastic_modulus_Pa": beam.elastic_modulus,
        "poisson_ratio": beam.poisson_ratio,
        "yield_strength_Pa": made.case.yield_strength,
        "thickness_m": beam.width,
        "mass_kg": made.mass,
        "cantilever_length_m": beam.length,
        "cantilever_height_m": beam.height,
        "tip_stiffness_N_per_m": beam.tip_stiffness,
        "drum_radius_m": roller.drum_radius,
        "roller_radius_m": roller.radius,
        "roller_offset_m": roller.offset,
        "dead_zone_rad": made.law.dead_zone,
        "contact_part": {
            "thickness_m": size.thickness,
            "foot_fillet_radius_m": size.foot_fillet,
            "rounding_radius_m": size.rounding,
            "gap_to_mirrored_m": size.gap,
        },
        "mount": {
            "length_m": size.mount.length,
            "height_m": size.mount.height,
            "hole_diameter_m": size.mount.hole_diameter,
            "hole_count": size.mount.hole_count,
            "held": size.mount.mounting,
        },
        "root_fillet_radius_m": size.root_fillet,
        "method": made.spec.method,
        "compensation": made.spec.compensation,
        "torque_errors_of_updates": list(made.compensated.errors),
        "correction": correction_entry(made.correction),
        "stepwise_distance_m": made.stepwise_distance,
        "drawing_tolerance_m": made.drawn.tolerance,
        "drawing_torque_change": made.drawn.torque_change,
        "profile": {
            "x_m": made.geometry.points[:, 0],
            "y_m": made.geometry.points[:, 1],
            "tangent_x": made.geometry.tangents[:, 0],
            "tangent_y": made.geometry.tangents[:, 1],
        },
    }


def _response(made: MadeJoint) -> dict[str, Value]:
    stroke, groups = made.stroke, made.spec.groups
    relative, absolute = torque_errors(made)
    full = groups * float(stroke.torque[-1])
    return {
        "stiffness_Nm_per_rad": full / float(made.expected_angle[-1]),
        "max_deflection_rad": float(made.expected_angle[-1]),
        "max_torque_Nm": full,
        "energy_J": groups * float(stroke.energy[-1]),
        "torque_error": absolute,
        "relative_torque_error": relative,
        "peak_nominal_stress_Pa": float(np.max(stroke.tip.stress)),
        "peak_contact_pressure_Pa": float(np.max(made.strips.peak_pressure)),
        "peak_roller_force_N": float(np.max(stroke.normal_force)),
        "first_contact_angle_rad": first_contact(made),
        "largest_contact_angle_rad": float(np.nanmax(stroke.gamma)),
        "largest_tip_rotation_rad": float(np.max(np.abs(stroke.tip.rotation))),
        "angle_rad": stroke.angle,
        "expected_angle_rad": None if made.correction is None else made.expected_angle,
        "group_torque_Nm": stroke.torque,
        "law_torque_Nm": made.law.torque(made.expected_angle),
        "group_energy_J": stroke.energy,
        "roller_force_N": stroke.normal_force,
        "nominal_stress_Pa": stroke.tip.stress,
        "contact_pressure_Pa": made.strips.peak_pressure,
        "contact_angle_rad": stroke.gamma,
        "offset_sensitivity_N": made.sensitivity,
        **_hysteresis(made),
    }


def _hysteresis(made: MadeJoint) -> dict[str, Value]:
    """Loading and unloading with the friction of the spec; nothing without."""
    if made.friction is None:
        return {}
    return {
        "hysteresis_loss_J": made.spec.groups * made.friction.loss,
        "hysteresis_share": made.friction.loss_share,
        "friction_angle_rad": made.friction.angle,
        "loading_torque_Nm": made.friction.loading,
        "unloading_torque_Nm": made.friction.unloading,
    }


def _outcomes(made: MadeJoint) -> Iterator[Outcome]:
    stroke, groups, law = made.stroke, made.spec.groups, made.law
    relative, absolute = torque_errors(made)
    full = groups * float(law.torque(made.expected_angle[-1:])[0])
    yield from correction_outcomes(made)
    yield Outcome("deflection, each way", float(made.expected_angle[-1]), "rad", law.deflection)
    yield Outcome(
        "torque at the deflection", groups * float(stroke.torque[-1]), "N*m", full,
        f"of all groups ({groups})",
    )  # fmt: skip
    yield Outcome("energy", groups * float(stroke.energy[-1]), "J",
                  groups * float(made.followed.energy(stroke.angle[-1:])[0]))  # fmt: skip
    source = "forward analysis of the drawn profile" if made.correction is None else "expected"
    yield Outcome("torque error, over the full torque", absolute, "1", None, source)
    yield Outcome("torque error, relative", relative, "1", None,
                  "largest from 2.6 % of the stroke on")  # fmt: skip
    yield Outcome("nominal stress at the clamp", float(np.max(stroke.tip.stress)), "Pa",
                  made.spec.material.design_stress, "bending and axial, no notch")  # fmt: skip
    yield Outcome("contact pressure", float(np.max(made.strips.peak_pressure)), "Pa", None,
                  "elastic strip on the drawn profile")  # fmt: skip
    yield Outcome("force of the roller", float(np.max(stroke.normal_force)), "N")
    yield Outcome("tip stiffness of the cantilever", made.joint.cantilever.tip_stiffness, "N/m")
    yield Outcome("mass of an element", made.mass, "kg")
    if made.stepwise_distance is not None:
        settings = made.spec.stepwise
        form = settings.form if made.spec.method == "stepwise" else "sound form, rigid contact part"
        yield Outcome(
            "profile by steps against that by energy", made.stepwise_distance, "m", None,
            f"001, section 3.2, {form}, {settings.steps} steps; largest distance",
        )  # fmt: skip
    if made.friction is not None:
        yield Outcome("energy lost in a cycle", made.friction.loss_share, "1", None,
                      f"of the work of loading, friction {made.spec.friction:g}")  # fmt: skip


def _part(made: MadeJoint) -> Part:
    title = made.spec.material.values.title
    width = made.joint.cantilever.width
    return Part("", "element", made.element, width, title, made.drawn.tolerance, _dimensions(made))


def _dimensions(made: MadeJoint) -> tuple[Dimension, ...]:
    beam, top = made.joint.cantilever, made.geometry.top
    half = 0.5 * beam.height
    return (
        Dimension("cantilever length", "linear", (-beam.length, half), (0.0, half)),
        Dimension(
            "cantilever height", "linear",
            (-0.5 * beam.length, -half), (-0.5 * beam.length, half),
        ),
        Dimension(
            "contact part", "linear",
            (made.geometry.back - made.geometry.dimensions.thickness, top),
            (made.geometry.back, top),
        ),
    )  # fmt: skip


def _assumptions(made: MadeJoint) -> Iterator[str]:
    if made.correction is not None:
        yield from correction_assumptions(made, made.correction)
    mounting = made.geometry.dimensions.mount.mounting
    clamp = "clamped at" if mounting == "plates" else "on a spring against rotation at"
    yield (
        f"The cantilever is a beam with large deflections and shear, {clamp} the mount's face; "
        "the contact part's compliance is from linear plane-stress finite elements of the whole "
        f"element with {MOUNTED[mounting]}."
    )
    yield "The roller and its drum are rigid, the roller of the element's material; no play."
    yield (
        "Both directions are alike: a mirrored element for each, which the report does not repeat. "
        "The mirrored element must not be touched by this one; its clearance is that of the gap."
    )
    yield (
        "Contact is frictionless."
        if made.friction is None
        else "Loading and unloading are with friction on a rigid contact part; all else is without."
    )
    yield (
        f"The law: {made.law.words}. Near rest the torque is small and hangs on micrometres: 1 um "
        f"of profile offset is {1e-6 * float(np.max(made.sensitivity)):.3g} N*m."
    )
    yield (
        "The nominal stress knows no notch: that of the root fillet is in the second opinion. "
        "Edge quality is not checked."
    )
    yield "Drum radius, roller and their offset are as given; wear and bearing are not checked."


def _advice(made: MadeJoint) -> Iterator[str]:
    compensated = made.compensated
    if made.correction is not None:
        yield (
            "Simulate or measure this design in the same way; if it still misses the law by too "
            "much, springcad compensate corrects it in its turn."
        )
    law = "law" if made.correction is None else "pseudo law"
    updates = len(compensated.errors) - 1
    if updates:
        yield (
            f"A profile for a rigid contact part would miss the {law} by up to "
            f"{compensated.errors[0]:.1%} (relative, from 2.6 % of the stroke on); after {updates} "
            f"update{'s' if updates > 1 else ''} {compensated.error:.2%} is left."
        )
    yield from _near_rest(made)
    beam = made.joint.cantilever
    if beam.root_compliance > 0.0:
        softer = beam.root_compliance * beam.tip_stiffness * beam.length**2
        yield (
            f"In its pocket the mount yields: the tip is more compliant by {softer:.0%} than "
            "between plates. A mount held otherwise than mount.held says misses the law by as much."
        )
    turned = math.degrees(float(np.max(np.abs(made.stroke.tip.rotation))))
    yield f"The tip turns by up to {turned:.2f} deg."


def _near_rest(made: MadeJoint) -> Iterator[str]:
    """Where the law is not followed, nor can be."""
    until, first = uncertain_until(made), first_contact(made)
    if first > made.law.dead_zone:
        yield (
            f"Up to {math.degrees(first):.2g} deg the roller should touch where the mirrored "
            "element begins: those contacts are left out, and the torque there is not the law's. A "
            "law with some slope at rest needs none of them."
        )
    if until is not None:
        torque = float(made.law.torque(np.array([until]))[0])
        yield (
            f"Relative to the law the torque is off by more than {TORQUE_TOLERANCE:.0%} up to "
            f"{math.degrees(until):.2g} deg, where the law is {torque:.2g} N*m for a group."
        )


def _provenance(spec: Spec, made: MadeJoint) -> Mapping[str, Value]:
    curve = {} if made.correction is None else {"curve_sha256": made.correction.sha256}
    return {
        "spec_sha256": spec.sha256,
        **curve,
        **sources(made.spec.material, made.spec.process),
    }
