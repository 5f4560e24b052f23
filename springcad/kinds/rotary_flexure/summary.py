"""A rotary flexure spring as a result."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from springcad.kinds.lasting import Loading
from springcad.kinds.rotary_flexure.calibrated import calibrated_sources
from springcad.kinds.rotary_flexure.checks import root_fillet_stress, spring_checks
from springcad.kinds.rotary_flexure.drawn_parts import parts
from springcad.kinds.rotary_flexure.joint import (
    joint_assumptions,
    joint_design,
    joint_plot,
    joint_response,
    with_joint,
)
from springcad.kinds.rotary_flexure.numbers import design_numbers, peak, response_numbers
from springcad.kinds.rotary_flexure.plots import plots
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.kinds.rotary_flexure.stack import named
from springcad.kinds.rotary_flexure.tolerance_report import with_tolerance
from springcad.kinds.rotary_flexure.words import advice, assumptions
from springcad.kinds.strength import with_strength
from springcad.result import Outcome, Result, Value
from springcad.spec.source import Spec


def summarise(spec: Spec, spring: Spring) -> Result:
    """Everything that the reports and files show."""
    stacked = spring.stack.sheets > 1
    result = Result(
        kind=spec.kind,
        name=spec.name,
        spec=spec.raw,
        design=design_numbers(spring) | ({"stack": joint_design(spring)} if stacked else {}),
        response=response_numbers(spring) | ({"joint": joint_response(spring)} if stacked else {}),
        checks=named(spring_checks(spring), spring.stack),
        outcomes=with_joint(spring, _outcomes(spring)) if stacked else _outcomes(spring),
        parts=parts(spring),
        plots=(*((joint_plot(spring),) if stacked else ()), *plots(spring)),
        assumptions=(*joint_assumptions(spring), *assumptions(spring)),
        advice=tuple(advice(spring)),
        provenance=_provenance(spec, spring),
    )
    told = with_strength(result, spring.spec.material, spring.spec.process, _loading(spring))
    return with_tolerance(told, spring)


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
        torque=spring.stack.parallel * forward.torque,
        local={
            "inner-fibre stress": peak(spring, "local_stress"),
            "root fillet stress": root_fillet_stress(spring),
        },
        keys={"root fillet stress": "flexures.fillet_stress"},
    )


def _outcomes(spring: Spring) -> tuple[Outcome, ...]:
    law, response = spring.law, response_numbers(spring)
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
        Outcome("sliding of a tip, one way", number("sliding_path_m"), "m", None,
                f"{0.1 * number('loss_per_friction_J') / number('energy_J'):.1%} of the energy is "
                "lost in a cycle for each 0.1 of friction"),
        Outcome("usable to, either way", spring.end.angle, "rad", None, f"then {spring.end.limit}"),
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
