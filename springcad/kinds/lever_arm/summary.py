"""A lever arm as a result: numbers, curves, part, views, and what was taken for granted."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.lasting import Loading
from springcad.kinds.lever_arm.case import pivots
from springcad.kinds.lever_arm.checks import PIVOTS, joint_checks, largest_pivot_force
from springcad.kinds.lever_arm.made import MadeJoint
from springcad.kinds.lever_arm.mechanism import (
    Response,
    boundary,
    loads,
    pivot_load_ratio,
    response,
    stroke,
)
from springcad.kinds.lever_arm.views import mechanism_views
from springcad.kinds.provenance import sources
from springcad.kinds.strength import with_strength
from springcad.result import Outcome, Part, Plot, Result, Series, Value
from springcad.spec.source import Spec

Floats = NDArray[np.float64]

CURVES = 5
"""Pivot positions whose torque over the angle is told and drawn."""
VIEWS = 3
_ANGLES = 41


def summarise(spec: Spec, made: MadeJoint) -> Result:
    """Everything that the reports and files show."""
    spring = made.spring
    part = Part(
        "", spring.role, spring.profile, spring.sheet, made.spec.material.values.title,
        dimensions=spring.dimensions,
    )  # fmt: skip
    result = Result(
        kind=spec.kind,
        name=spec.name,
        spec=spec.raw,
        design=_design(made),
        response=_response(made),
        checks=joint_checks(made),
        outcomes=tuple(_outcomes(made)),
        parts=(part,),
        views=mechanism_views(made, pivots(made.case, VIEWS)),
        plots=(*_mechanism_plots(made), *_spring_plots(made), *spring.plots),
        assumptions=(*spring.assumptions, *_assumptions(made)),
        advice=(*spring.advice, *_advice(made)),
        provenance={
            "spec_sha256": spec.sha256,
            **sources(made.spec.material, made.spec.process),
        },
    )
    return with_strength(result, made.spec.material, made.spec.process, _loading(made))


def _loading(made: MadeJoint) -> Loading:
    """The worse of both directions; a torque alone says nothing, as the pivot moves."""
    spring, most = made.spring, made.case.deflection
    deflection = spring.deflection[spring.deflection > 0.0]
    stress = [np.interp(sign * deflection, spring.deflection, spring.stress) for sign in (1, -1)]
    return Loading("nominal stress", deflection / most, np.maximum(*stress))


def _design(made: MadeJoint) -> dict[str, Value]:
    case, spring = made.case, made.spring
    series = case.lever.series_stiffness
    return {
        "shape": case.shape,
        "count": case.count,
        "layers": spring.layers,
        "sheet_thickness_m": spring.sheet,
        "width_m": spring.width,
        "elastic_modulus_Pa": case.elastic_modulus,
        "poisson_ratio": case.poisson_ratio,
        "yield_strength_Pa": case.yield_strength,
        "spring_deflection_m": case.deflection,
        "mass_kg": spring.mass,
        "lever_length_m": case.lever.length,
        "crank_radius_m": case.lever.crank_radius,
        "output": case.lever.output,
        "series_stiffness_Nm_per_rad": series if math.isfinite(series) else None,
        **spring.design,
    }


def _response(made: MadeJoint) -> dict[str, Value]:
    case, spring = made.case, made.spring
    q = pivots(case, PIVOTS)
    end, rest = _ends(made, q)
    force = loads(case.lever, q, end.crank_angle, spring.law.force(end.deflection))
    return {
        "spring_stiffness_N_per_m": spring.stiffness,
        "spring_stiffness_at_rest_N_per_m": float(spring.law.stiffness(np.array(0.0))),
        "energy_J": float(spring.energy[-1]),
        "peak_nominal_stress_Pa": float(np.max(spring.stress)),
        "peak_pivot_force_N": largest_pivot_force(made.case, made.spring.law),
        "stiffness_range_Nm_per_rad": [float(rest.stiffness.min()), float(rest.stiffness.max())],
        "max_deflection_rad": float(np.max(end.angle)),
        "max_torque_Nm": float(np.max(end.torque)),
        "deflection_m": spring.deflection,
        "force_N": spring.force,
        "spring_energy_J": spring.energy,
        "stress_Pa": spring.stress,
        "pivot_m": q,
        "stiffness_at_rest_Nm_per_rad": rest.stiffness,
        "crank_stiffness_at_rest_Nm_per_rad": rest.crank_stiffness,
        "end_angle_rad": end.angle,
        "end_crank_angle_rad": end.crank_angle,
        "end_deflection_m": end.deflection,
        "end_torque_Nm": end.torque,
        "end_stiffness_Nm_per_rad": end.stiffness,
        "end_energy_J": end.energy,
        "end_output_force_N": force.output,
        "end_pivot_force_N": force.pivot,
        "end_lever_tilt_rad": force.tilt,
        "curves": [_curve(made, float(at)) for at in pivots(case, CURVES)],
        **spring.response,
    }


def _ends(made: MadeJoint, q: Floats) -> tuple[Response, Response]:
    """At the end of the stroke and at rest, for pivot positions (P,)."""
    lever, law = made.case.lever, made.spring.law
    return boundary(lever, law, q), response(lever, law, q, np.zeros_like(q))


def _over_stroke(made: MadeJoint, pivot: float) -> Response:
    """Both directions, at one pivot position."""
    end = float(stroke(made.case.lever, pivot, made.case.deflection))
    return response(made.case.lever, made.spring.law, pivot, np.linspace(-end, end, _ANGLES))


def _curve(made: MadeJoint, pivot: float) -> dict[str, Value]:
    over = _over_stroke(made, pivot)
    return {
        "pivot_m": pivot,
        "angle_rad": over.angle,
        "torque_Nm": over.torque,
        "stiffness_Nm_per_rad": over.stiffness,
        "energy_J": over.energy,
        "deflection_m": over.deflection,
    }


def _outcomes(made: MadeJoint) -> Iterator[Outcome]:
    case, spring = made.case, made.spring
    q = pivots(case, PIVOTS)
    end, rest = _ends(made, q)
    yield Outcome("stiffness of the spring", spring.stiffness, "N/m", case.stiffness or None,
                  f"of all leaves at {1e3 * case.deflection:.4g} mm")  # fmt: skip
    yield Outcome("energy of the spring", float(spring.energy[-1]), "J", None,
                  "at the spring deflection")  # fmt: skip
    yield Outcome("layers of a leaf", spring.layers, "1", None,
                  f"of {1e3 * spring.sheet:.4g} mm; {case.count} "
                  f"{'leaf' if case.count == 1 else 'leaves'}, {1e3 * spring.width:.4g} mm wide "
                  "each")  # fmt: skip
    for index, where in ((0, "nearest"), (-1, "farthest")):
        at = f"pivot {where}, q = {1e3 * q[index]:.4g} mm"
        yield Outcome(f"output stiffness at rest, {where}", float(rest.stiffness[index]),
                      "N*m/rad", None, at)  # fmt: skip
        yield Outcome(f"end of the stroke, {where}", float(end.angle[index]), "rad", None, at)
        yield Outcome(f"torque there, {where}", float(end.torque[index]), "N*m", None, at)
    force = largest_pivot_force(case, spring.law)
    yield Outcome("largest force on the pivot", force, "N",
                  case.max_pivot_force or None, "over all pivot positions")  # fmt: skip
    yield from spring.outcomes
    yield Outcome("mass of all leaves", spring.mass, "kg", None, "with eyes and blocks")


def _mechanism_plots(made: MadeJoint) -> tuple[Plot, ...]:
    case = made.case
    q = pivots(case, PIVOTS)
    end, rest = _ends(made, q)
    curves = [(at, _over_stroke(made, float(at))) for at in pivots(case, CURVES)]
    both = [np.concatenate([-values, [np.nan], values]) for values in (end.angle, end.torque)]
    ratio = pivot_load_ratio(case.lever, q, end.crank_angle)
    return (
        Plot("Torque over the angle, and the boundary of the workspace", "angle", "rad", "torque",
             "N*m", (*(Series(f"q = {1e3 * at:.4g} mm", over.angle, over.torque)
                       for at, over in curves),
                     Series("spring at its deflection", both[0], both[1], dashed=True))),
        Plot("Stiffness at rest over the pivot position", "pivot position q", "m", "stiffness",
             "N*m/rad",
             (Series("output", q, rest.stiffness),
              Series("without the series stiffness", q, rest.crank_stiffness, dashed=True)),
             y_scale="log"),
        Plot("Force on the pivot over that on the output, at the end of the stroke",
             "pivot position q", "m", "ratio", "1", (Series("1 + R sin φ/s", q, ratio),)),
    )  # fmt: skip


def _spring_plots(made: MadeJoint) -> tuple[Plot, ...]:
    spring = made.spring
    straight = spring.stiffness * spring.deflection
    return (
        Plot("Force of the spring", "deflection", "m", "force", "N",
             (Series("nonlinear beam", spring.deflection, spring.force),
              Series("secant at the end", spring.deflection, straight, dashed=True))),
        Plot("Largest stress over the deflection", "deflection", "m", "stress", "Pa",
             (Series("beam", spring.deflection, spring.stress),),
             limit=made.case.design_stress),
    )  # fmt: skip


def _assumptions(made: MadeJoint) -> Iterator[str]:
    case = made.case
    yield (
        "The stiffness of the spring is that of all leaves together, force over deflection at the "
        "spring deflection; every leaf acts in both directions."
    )
    yield {
        "yoke": "The lever's end is guided across by a slide in which the crank's pin runs (Scotch "
        "yoke): the equations of paper 000 are exact for that.",
        "crank-behind": "The lever's end is pinned to the crank, whose axis is beyond it.",
        "crank-ahead": "The lever's end is pinned to the crank, whose axis is on the pivot's side.",
    }[case.lever.output]
    yield (
        "Lever, pivot and guides are rigid and without friction and play; what yields in them is "
        + (
            f"a series stiffness of {case.lever.series_stiffness:.4g} N*m/rad."
            if math.isfinite(case.lever.series_stiffness)
            else "left out: near the crank the real stiffness will be lower."
        )
    )


def _advice(made: MadeJoint) -> Iterator[str]:
    case = made.case
    force = largest_pivot_force(made.case, made.spring.law)
    spring = float(made.spring.force[-1])
    yield (
        f"The pivot carries up to {force:.4g} N, {force / spring:.3g} times the spring's force: "
        "more deflection of the spring lowers that (000, Eq. 9)."
    )
    if math.isfinite(case.lever.series_stiffness):
        rest = response(case.lever, made.spring.law, case.pivot_low, 0.0)
        share = float(rest.stiffness / rest.crank_stiffness)
        yield (
            f"At the nearest pivot the series stiffness leaves {share:.1%} of the output stiffness."
        )
