"""A rotary flexure spring as a result: numbers, curves, parts, and what was taken for granted."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from springcad.kinds.lasting import Loading
from springcad.kinds.rotary_flexure.calibrated import (
    calibrated_sources,
    calibration_assumptions,
    root_coefficient,
)
from springcad.kinds.rotary_flexure.checks import root_fillet_stress, spring_checks
from springcad.kinds.rotary_flexure.response import both_ways
from springcad.kinds.rotary_flexure.room import deflection_bound
from springcad.kinds.rotary_flexure.root import mounting_of
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.straight import straight_alternatives
from springcad.kinds.strength import with_strength
from springcad.result import Dimension, Outcome, Part, Plot, Result, Series, Value
from springcad.spec.source import Spec

FLANK_TOLERANCE = 6e-6
"""The arcs of the camshaft's drawing follow it within this share of the contact radius, 36 nm for
6 mm: at 2 um they waver enough to change the torque by 0.5 % locally."""


def summarise(spec: Spec, spring: Spring) -> Result:
    """Everything that the reports and files show."""
    result = Result(
        kind=spec.kind,
        name=spec.name,
        spec=spec.raw,
        design=_design(spring),
        response=_response(spring),
        checks=spring_checks(spring),
        outcomes=_outcomes(spring),
        parts=_parts(spring),
        plots=_plots(spring),
        assumptions=_assumptions(spring),
        advice=tuple(_advice(spring)),
        provenance=_provenance(spec, spring),
    )
    return with_strength(result, spring.spec.material, spring.spec.process, _loading(spring))


def _loading(spring: Spring) -> Loading:
    """The worse of both directions, and the places where the stress is higher than bounded."""
    forward, backward = spring.strokes
    bounded = "nominal_stress" if spring.spec.stress == "nominal" else "local_stress"
    share = forward.angle / forward.angle[-1]
    ahead = getattr(forward, bounded)
    behind = np.interp(share, backward.angle / backward.angle[-1], getattr(backward, bounded))
    root = 2.0 * float(spring.found.ribbon.at(np.zeros(1)).half_thickness[0])
    return Loading(
        name="nominal stress" if bounded == "nominal_stress" else "inner-fibre stress",
        share=share,
        stress=np.maximum(ahead, behind),
        section=(root, spring.law.inputs.thickness),
        torque=forward.torque,
        local={
            "inner-fibre stress": _peak(spring, "local_stress"),
            "root fillet stress": root_fillet_stress(spring),
        },
    )


def _design(spring: Spring) -> dict[str, Value]:
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
        "deflection_bound_rad": _deflection_bound(spring),
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
            "backlash_m": spring.camshaft_inputs.backlash,
            "friction": spring.spec.camshaft.friction,
            "free_play_rad": camshaft.slot.free_play,
            "exact_from_rad": max(camshaft.slot.exact_from),
            "preload_m": camshaft.slot.preload,
        },
    }


def _response(spring: Spring) -> dict[str, Value]:
    forward, backward = spring.strokes
    secant = 0.5 * sum(float(stroke.torque[-1] / stroke.angle[-1]) for stroke in spring.strokes)
    return {
        "stiffness_Nm_per_rad": secant,
        "max_deflection_rad": float(forward.angle[-1]),
        "max_torque_Nm": float(forward.torque[-1]),
        "energy_J": float(forward.energy[-1]),
        "peak_nominal_stress_Pa": _peak(spring, "nominal_stress"),
        "peak_local_stress_Pa": _peak(spring, "local_stress"),
        "peak_root_fillet_stress_Pa": root_fillet_stress(spring),
        "min_gap_m": spring.found.gap,
        "min_deformed_gap_m": min(float(stroke.gap.min()) for stroke in spring.strokes),
        "peak_contact_pressure_Pa": _peak(spring, "pressure"),
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
        **_hysteresis(spring),
    }


def _hysteresis(spring: Spring) -> dict[str, Value]:
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


def _peak(spring: Spring, field: str) -> float:
    return max(float(getattr(stroke, field).max()) for stroke in spring.strokes)


def _outcomes(spring: Spring) -> tuple[Outcome, ...]:
    law, response = spring.law, _response(spring)
    allowed = law.inputs.design_stress

    def number(key: str) -> float:
        value = response[key]
        assert isinstance(value, float)
        return value

    return (
        Outcome("stiffness", number("stiffness_Nm_per_rad"), "N*m/rad",
                law.torque / spring.target.deflection,
                "secant at the design deflection, mean of both directions"),
        Outcome("deflection, each way", number("max_deflection_rad"), "rad",
                spring.target.deflection),
        Outcome("torque at the design deflection", number("max_torque_Nm"), "N*m", law.torque),
        Outcome("energy", number("energy_J"), "J", law.energy),
        Outcome("mass of the ring", spring.mass, "kg"),
        Outcome("nominal stress", number("peak_nominal_stress_Pa"), "Pa", allowed,
                "large deflections, bending and axial, without root fillets"),
        Outcome("inner-fibre stress in the bends", number("peak_local_stress_Pa"), "Pa",
                allowed if spring.spec.stress == "local" else None, "curved-beam factor"),
        Outcome("root fillet stress", number("peak_root_fillet_stress_Pa"), "Pa", None,
                "finite elements of the root"),
        Outcome("gap at rest", spring.found.gap, "m"),
        Outcome("gap when deformed", number("min_deformed_gap_m"), "m", None,
                "the smaller of both directions"),
        Outcome("contact pressure", number("peak_contact_pressure_Pa"), "Pa"),
        Outcome("force on a tip", law.force, "N"),
        Outcome("serpentine factor", law.serpentine_factor, "1", None, "004, section II-B"),
        Outcome("density factor", law.density_factor, "1", None, "004, section II-B"),
        Outcome("energy per mass", number("energy_J") / spring.mass, "J/kg", None, "ring alone"),
        *(
            (
                Outcome("energy lost in a cycle", number("hysteresis_share"), "1", None,
                        f"of the work of loading, friction {spring.spec.camshaft.friction:g}"),
            )
            if spring.spec.camshaft.friction > 0.0
            else ()
        ),
    )  # fmt: skip


def _parts(spring: Spring) -> tuple[Part, ...]:
    title = spring.spec.material.values.title
    thickness = spring.law.inputs.thickness
    tolerance = FLANK_TOLERANCE * spring.law.inputs.contact_radius
    return (
        Part(
            "", "flexure ring", spring.ring, thickness, title,
            dimensions=(
                _radius("outer", spring.case.outer_radius, 40.0),
                _radius("root", spring.law.inputs.root_radius, 130.0),
                _radius("contact", spring.law.inputs.contact_radius, 220.0),
            ),
        ),
        Part(
            "camshaft", "camshaft", spring.camshaft.profile, thickness, title, tolerance,
            tuple(_camshaft_dimensions(spring)),
        ),
    )  # fmt: skip


def _camshaft_dimensions(spring: Spring) -> Iterator[Dimension]:
    yield _radius("tip", spring.camshaft.slot.tip_radius, 40.0)
    yield _radius("slot", spring.camshaft.slot.bottom_radius, 130.0)
    if spring.camshaft_inputs.bore_radius > 0.0:
        yield _radius("bore", spring.camshaft_inputs.bore_radius, 220.0)


def _radius(label: str, value: float, degrees: float) -> Dimension:
    at = math.radians(degrees)
    end = (value * math.cos(at), value * math.sin(at))
    return Dimension(label, "radius", (0.0, 0.0), end)


def _plots(spring: Spring) -> tuple[Plot, ...]:
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
    response = _hysteresis(spring)
    return tuple(
        Series(label, np.asarray(response["friction_angle_rad"]), np.asarray(response[key]))
        for label, key in (("loading", "loading_torque_Nm"), ("unloading", "unloading_torque_Nm"))
        if response
    )


def _assumptions(spring: Spring) -> tuple[str, ...]:
    spec, play = spring.spec, math.degrees(spring.camshaft.slot.free_play)
    held = (
        "fixed all round, as if pressed into a stiff bore"
        if spec.mounting.dowels is None
        else "held by its dowels and bends freely between them"
    )
    return (
        "The flexures are beams on a root spring. The spring and the stress in the root fillets "
        "come from linear plane-stress finite elements of one sector of the ring: rim, root, "
        f"fillets ({spring.fillet * 1e3:.2f} mm) and mounting, without dowel cut-outs.",
        *calibration_assumptions(spec),
        "Everything is linear-elastic: where a stress passes yield, stiffness and stresses are "
        "outside the model.",
        f"The rim is {held}; its own stress is not checked.",
        _friction_assumption(spec.camshaft.friction),
        *(
            (
                f"The camshaft has a free play of {play:.3g} deg each way before it touches the "
                "flexures; angles, stiffness and energy do not count it.",
            )
            if play > 0.0
            else ()
        ),
        "Stiffness, stress and gaps are those of a beam with large deflections, shear and axial "
        "force; flexures are sized by it.",
        f"The stress compared with material.design_stress is the {spec.stress} one; the root "
        "fillets are reported apart.",
        "Edge quality of the cut is not checked.",
        "The camshaft is of the same material and thickness as the ring; its fatigue is not "
        "checked. Both parts are cut to size: kerf and tolerances are the shop's.",
        "Paper 004 cites a patent application on the two-part spring, US 15/402,186: check before "
        "you sell.",
    )


def _friction_assumption(coefficient: float) -> str:
    if coefficient == 0.0:
        return (
            "Contact is frictionless. Dry friction adds hysteresis: paper 004 measured 9.7 to 12 % "
            "of the energy at full deflection; camshaft.friction computes it."
        )
    return (
        f"Loading and unloading are for dry friction of {coefficient:g}; stiffness, stress and "
        "camshaft are those of the frictionless contact between them."
    )


def _advice(spring: Spring) -> Iterator[str]:
    if spring.spec.target.law is not None:
        return
    bound = _deflection_bound(spring)
    yield (
        f"The design deflection is {spring.law.inputs.deflection / bound:.0%} of "
        f"{math.degrees(bound):.1f} deg, the bound of a full disk at this stress."
    )
    if spring.found.style == "serpentine":
        for alternative in straight_alternatives(spring.case):
            text = str(alternative)
            yield f"{text[0].upper()}{text[1:]}."


def _deflection_bound(spring: Spring) -> float:
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


def _provenance(spec: Spec, spring: Spring) -> Mapping[str, Value]:
    settings, found = spring.spec.optimiser, spring.found
    return {
        "spec_sha256": spec.sha256,
        "optimiser": {
            "form": settings.form if found.style == "serpentine" else "none (straight)",
            "seed": settings.seed,
            "starts": found.starts,
            "feasible_starts": found.feasible,
            "gaps_m": list(found.gaps),
        },
        **calibrated_sources(spring.spec),
    }
