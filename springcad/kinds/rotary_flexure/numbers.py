"""What a rotary flexure spring was decided to be, and what it does, as numbers for the report."""

from __future__ import annotations

import numpy as np

from springcad.kinds.rotary_flexure.calibrated import root_coefficient
from springcad.kinds.rotary_flexure.checks import root_fillet_stress
from springcad.kinds.rotary_flexure.response import ROUND_OFF, both_ways
from springcad.kinds.rotary_flexure.room import deflection_bound
from springcad.kinds.rotary_flexure.root import mounting_of
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.mechanics.conjugate import until
from springcad.mechanics.friction import sliding_loss, sliding_path
from springcad.result import Value


def design_numbers(spring: Spring) -> dict[str, Value]:
    """What was decided: the section ``design`` of the report, SI."""
    law, found, camshaft = spring.law, spring.found, spring.camshaft
    return {
        "serpentine_factor": law.serpentine_factor,
        "density_factor": law.density_factor,
        "flexure_count": law.inputs.count,
        "contact_radius_m": law.inputs.contact_radius,
        "root_radius_m": law.inputs.root_radius,
        "outer_radius_m": spring.case.outer_radius,
        "thickness_m": law.inputs.thickness,
        "material": spring.spec.material.name,
        "elastic_modulus_Pa": law.inputs.elastic_modulus,
        "poisson_ratio": spring.camshaft_inputs.poisson_ratio,
        "mounting": mounting_of(spring.spec),
        "mass_kg": spring.mass,
        "style": found.style,
        "law": spring.target.words,
        "loaded_radius_m": law.inputs.loaded_radius,
        "tip_force_N": law.force,
        "flexure_span_m": law.span,
        "flexure_length_m": found.ribbon.length,
        "root_thickness_m": 2.0 * float(found.ribbon.at(np.zeros(1)).half_thickness[0]),
        "tip_thickness_m": 2.0 * law.inputs.tip_half_thickness,
        "tip_pad_length_m": found.ribbon.length - float(found.ribbon.edges[-2]),
        "root_fillet_radius_m": spring.sized.fillet,
        "blend_radius_m": spring.sized.blend,
        "root_compliance_rad_per_Nm": spring.sized.root.compliance,
        "calibrated_root_coefficient": root_coefficient(spring.spec),
        "root_fillet_stress_factor": spring.sized.root.fillet_stress_factor,
        "stiffness_at_rest_Nm_per_rad": spring.sized.stiffness_at_rest,
        "deflection_bound_rad": bound_of(spring),
        "flexure": {
            "root_angle_rad": found.ribbon.root_angle,
            "panel_edges_m": found.ribbon.edges,
            "curvature_per_m": found.ribbon.curvature,
            "half_thickness_m": found.ribbon.half_thickness,
        },
        "camshaft": {
            "tooth_count": law.inputs.count,
            "tip_radius_m": camshaft.slot.tip_radius,
            "root_radius_m": camshaft.slot.bottom_radius,
            "tooth_thickness_m": camshaft.tooth_thickness,
            "tooth_height_m": camshaft.tooth_height,
            "tooth_root_stress_Pa": camshaft.tooth_stress,
            "torsional_stress_Pa": camshaft.hub_stress,
            "backlash_m": spring.camshaft_inputs.backlash,
            "friction": spring.spec.camshaft.friction,
            "free_play_rad": camshaft.slot.free_play,
            "exact_from_rad": max(camshaft.slot.exact_from),
            "preload_m": camshaft.slot.preload,
        },
    }


def response_numbers(spring: Spring) -> dict[str, Value]:
    """What the spring does over its stroke: the section ``response`` of the report, SI."""
    forward, backward = spring.strokes
    secant = 0.5 * sum(float(stroke.torque[-1] / stroke.angle[-1]) for stroke in spring.strokes)
    return {
        "stiffness_Nm_per_rad": secant,
        "max_deflection_rad": float(forward.angle[-1]),
        "max_torque_Nm": float(forward.torque[-1]),
        "energy_J": float(forward.energy[-1]),
        "peak_nominal_stress_Pa": peak(spring, "nominal_stress"),
        "peak_local_stress_Pa": peak(spring, "local_stress"),
        "peak_root_fillet_stress_Pa": root_fillet_stress(spring),
        "min_gap_m": spring.found.gap,
        "min_deformed_gap_m": min(float(stroke.gap.min()) for stroke in spring.strokes),
        "peak_contact_pressure_Pa": peak(spring, "pressure"),
        **sliding(spring),
        "usable_angle_rad": spring.end.angle,
        "usable_torque_Nm": spring.end.torque,
        "usable_limit": spring.end.limit,
        "angle_rad": both_ways(forward.angle, -backward.angle),
        "torque_Nm": both_ways(forward.torque, -backward.torque),
        "stored_energy_J": both_ways(forward.energy, backward.energy),
        "contact_force_N": both_ways(forward.force, backward.force),
        "contact_station_m": both_ways(forward.station, backward.station),
        "nominal_stress_Pa": both_ways(forward.nominal_stress, backward.nominal_stress),
        "local_stress_Pa": both_ways(forward.local_stress, backward.local_stress),
        "contact_pressure_Pa": both_ways(forward.pressure, backward.pressure),
        "gap_angle_rad": both_ways(forward.gap_angle, -backward.gap_angle),
        "gap_m": both_ways(forward.gap, backward.gap),
        **hysteresis(spring),
    }


def sliding(spring: Spring) -> dict[str, Value]:
    """How far the tips slide up to the design deflection, and what dry friction makes of it."""
    stroke = spring.target.deflection * (1.0 + ROUND_OFF)
    flanks = [until(flank, stroke) for flank in spring.camshaft.flanks]
    count = spring.law.inputs.count
    return {
        "sliding_path_m": max(map(sliding_path, flanks)),
        "loss_per_friction_J": 0.5 * sum(sliding_loss(flank, count) for flank in flanks),
    }


def hysteresis(spring: Spring) -> dict[str, Value]:
    """Loading and unloading with the friction of the spec; nothing without."""
    forward, backward = (stroke.friction for stroke in spring.strokes)
    if forward is None or backward is None:
        return {}
    return {
        "hysteresis_loss_J": 0.5 * (forward.loss + backward.loss),
        "hysteresis_share": 0.5 * (forward.loss_share + backward.loss_share),
        "friction_angle_rad": both_ways(forward.angle, -backward.angle),
        "loading_torque_Nm": both_ways(forward.loading, -backward.loading),
        "unloading_torque_Nm": both_ways(forward.unloading, -backward.unloading),
    }


def peak(spring: Spring, field: str) -> float:
    """Largest value of an array of the strokes in both directions, in its unit."""
    return max(float(getattr(stroke, field).max()) for stroke in spring.strokes)


def bound_of(spring: Spring) -> float:
    """Deflection of a full disk at the design stress, rad (``room.deflection_bound``)."""
    inputs = spring.law.inputs
    return float(
        deflection_bound(
            inputs.stiffness,
            inputs.root_radius,
            inputs.contact_radius,
            inputs.thickness,
            inputs.design_stress,
            inputs.elastic_modulus,
        )
    )
