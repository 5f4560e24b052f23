"""Finished leaves as a result: numbers, curves, part, drawings and words."""

from __future__ import annotations

import math

import numpy as np

from springcad.kinds.lasting import Loading
from springcad.kinds.leaf_2dof import paper_unit
from springcad.kinds.leaf_2dof.checks import leaf_checks, pressure
from springcad.kinds.leaf_2dof.findings import advice, assumptions, outcomes
from springcad.kinds.leaf_2dof.made import MadeLeaves, RodState, at_length
from springcad.kinds.leaf_2dof.parts import leaf_dimensions
from springcad.kinds.leaf_2dof.plots import leaf_plots
from springcad.kinds.leaf_2dof.unit import rest_stiffness
from springcad.kinds.leaf_2dof.views import leaf_views
from springcad.kinds.leaf_2dof.wrist import solid_angle
from springcad.kinds.provenance import sources
from springcad.kinds.strength import with_strength
from springcad.result import Part, Result, Value
from springcad.spec.source import Spec

_ROD_PLACES = ("rest", "edge", "corner")


def summarise(spec: Spec, made: MadeLeaves) -> Result:
    """Everything that the reports and files show."""
    result = Result(
        kind=spec.kind,
        name=spec.name,
        spec=spec.raw,
        design=_design(made),
        response=_response(made),
        checks=leaf_checks(made),
        outcomes=tuple(outcomes(made)),
        parts=(_part(made),),
        views=leaf_views(made),
        plots=leaf_plots(made),
        assumptions=tuple(assumptions(made)),
        advice=tuple(advice(made)),
        provenance={
            "spec_sha256": spec.sha256,
            **sources(made.spec.material, made.spec.process),
        },
    )
    return with_strength(result, made.spec.material, made.spec.process, _loading(made))


def _loading(made: MadeLeaves) -> Loading:
    """A cycle at the longest length; shorter ones may be bent until the stress is that allowed."""
    full, leaf = made.full, made.setup.leaf
    shorter = min(float(np.max(made.strokes.stress)), made.case.design_stress)
    return Loading(
        name="stress at the clamp, longest length",
        share=full.angle / full.angle[-1],
        stress=full.stress,
        section=(leaf.width, leaf.thickness),
        local={"stress at the clamp at shorter lengths": shorter},
        load_ratio=0.0,
    )


def _design(made: MadeLeaves) -> dict[str, Value]:
    setup, plan, case = made.setup, made.planform, made.case
    limit = case.max_bend_angle
    return {
        "leaves_per_axis": setup.leaves,
        "leaf_count": 4 * setup.leaves,
        "arm_radius_m": setup.lever.radius,
        "roller_radius_m": setup.lever.roller_radius,
        "clamp": setup.lever.clamp,
        "leaf_width_m": setup.leaf.width,
        "leaf_thickness_m": setup.leaf.thickness,
        "shortest_length_m": setup.shortest,
        "longest_length_m": setup.longest,
        "elastic_modulus_Pa": setup.leaf.elastic_modulus,
        "poisson_ratio": setup.leaf.poisson_ratio,
        "design_stress_Pa": case.design_stress,
        "yield_over_design_stress": case.yield_strength / case.design_stress,
        "max_bend_angle_rad": limit if math.isfinite(limit) else None,
        "rod_length_m": made.spec.wrist.rod_length,
        "mass_kg": made.mass,
        "leaf": {
            "length_m": plan.length,
            "mount_length_m": plan.mount,
            "guide_length_m": plan.guide,
            "overhang_m": plan.overhang,
            "end_radius_m": plan.end_radius,
            "hole_count": plan.hole_count,
            "hole_diameter_m": plan.hole_diameter,
        },
        "stroke_count": len(made.strokes.length),
    }


def _response(made: MadeLeaves) -> dict[str, Value]:
    n, full, setup = made.setup.leaves, made.full, made.setup
    rest = n * rest_stiffness(setup.leaf, setup.lever, [setup.longest, setup.shortest])
    edge = made.boundary.T
    most = float(full.angle[-1])
    return {
        "least_stiffness_Nm_per_rad": float(rest[0]),
        "greatest_stiffness_Nm_per_rad": float(rest[1]),
        "stiffness_Nm_per_rad": n * float(full.torque[-1]) / most,
        "max_deflection_rad": most,
        "torque_Nm": n * float(full.torque[-1]),
        "energy_J": n * float(full.energy[-1]),
        "peak_nominal_stress_Pa": float(full.stress[-1]),
        "safety_factor": made.case.yield_strength / float(full.stress[-1]),
        "bend_angle_rad": float(full.bend_angle[-1]),
        "peak_contact_pressure_Pa": float(np.max(pressure(made))),
        "peak_roller_force_N": float(np.max(made.strokes.force)),
        "strokes": {
            str(index + 1): _stroke(made, index) for index in range(len(made.strokes.length))
        },
        "limits": _limits(made),
        "paper": _paper(made),
        "workspace": {
            "solid_angle": solid_angle(most, most),
            "tip_x_m": edge[0],
            "tip_y_m": edge[1],
            "tip_z_m": edge[2],
        },
        "rod": dict(zip(_ROD_PLACES, map(_rod, made.rods), strict=True)),
        "diagonal": {
            "axis_angle_rad": full.angle,
            "more_tilt_Nm_per_rad": made.diagonal[:, 0, 0],
            "sideways_Nm_per_rad": made.diagonal[:, 1, 1],
        },
    }


def _stroke(made: MadeLeaves, index: int) -> dict[str, Value]:
    """One effective length: of the axis torque, stiffness, energy; the rest of one leaf."""
    n, stroke = made.setup.leaves, at_length(made.strokes, index)
    return {
        "effective_length_m": float(stroke.length[0]),
        "angle_rad": stroke.angle,
        "torque_Nm": n * stroke.torque,
        "stiffness_Nm_per_rad": n * stroke.stiffness,
        "energy_J": n * stroke.energy,
        "roller_force_N": stroke.force,
        "bend_angle_rad": stroke.bend_angle,
        "contact_station_m": stroke.station,
        "nominal_stress_Pa": stroke.stress,
        "contact_pressure_Pa": pressure(made)[index],
    }


def _limits(made: MadeLeaves) -> dict[str, Value]:
    """At each length: what design stress, bend angle and geometry allow, and what yield does."""
    n, setup, reach, at_yield = made.setup.leaves, made.setup, made.reach, made.yield_reach
    return {
        "effective_length_m": made.lengths,
        "rest_stiffness_Nm_per_rad": n * rest_stiffness(setup.leaf, setup.lever, made.lengths),
        "stress_deflection_rad": reach.by_stress,
        "bend_deflection_rad": reach.by_bend,
        "geometry_deflection_rad": reach.by_geometry,
        "binding": list(reach.binding),
        "max_deflection_rad": reach.unit.angle,
        "max_torque_Nm": n * reach.unit.torque,
        "max_energy_J": n * reach.unit.energy,
        "stress_Pa": reach.unit.stress,
        "yield_deflection_rad": at_yield.unit.angle,
        "yield_torque_Nm": n * at_yield.unit.torque,
        "yield_energy_J": n * at_yield.unit.energy,
    }


def _paper(made: MadeLeaves) -> dict[str, Value]:
    """The closed forms of paper 003 at the same lengths, times the number of leaves."""
    n, leaf, lever = made.setup.leaves, made.setup.leaf, made.setup.lever
    at = made.lengths
    values: dict[str, Value] = {
        "rest_stiffness_Nm_per_rad": n * paper_unit.stiffness(leaf, lever, at, 0.0),
        "stress_deflection_rad": paper_unit.deflection_at_stress(
            leaf, lever, at, made.case.design_stress
        ),
    }
    if math.isfinite(made.case.max_bend_angle):
        bent = paper_unit.deflection_at_bend(lever, at, made.case.max_bend_angle)
        values |= {
            "bend_deflection_rad": bent,
            "bend_torque_Nm": n * paper_unit.torque(leaf, lever, at, bent),
            "bend_stress_Pa": paper_unit.stress(leaf, lever, at, bent),
        }
    return values


def _rod(state: RodState) -> dict[str, Value]:
    """Matrices as rows."""
    return {
        "axis_angle_rad": np.array(state.angle),
        "direction": state.direction,
        "azimuth_rad": state.azimuth,
        "tilt_rad": state.tilt,
        "axis_torque_Nm": state.axis_torque,
        "axis_stiffness_Nm_per_rad": state.axis_stiffness,
        "output_torque_Nm": state.output_torque,
        "spherical_stiffness_Nm_per_rad": list(state.spherical_stiffness),
        "paper_stiffness_Nm_per_rad": list(state.paper_stiffness),
        "rod_stiffness_Nm_per_rad": list(state.rod_stiffness),
    }


def _part(made: MadeLeaves) -> Part:
    title = made.spec.material.values.title
    thickness = made.setup.leaf.thickness
    return Part(
        "", "leaf", made.profile, thickness, title, dimensions=leaf_dimensions(made.planform)
    )
