"""The claims that a finished rotary flexure spring must stand up to."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.pressure import pressure_limit
from springcad.kinds.rotary_flexure.clearance import deformed_gaps
from springcad.kinds.rotary_flexure.full_load import DIRECTIONS, demand_of, loads_of
from springcad.kinds.rotary_flexure.inputs import target_of
from springcad.result import Check, check

if TYPE_CHECKING:
    from springcad.kinds.rotary_flexure.case import Case
    from springcad.kinds.rotary_flexure.sizing import Sized
    from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
    from springcad.kinds.rotary_flexure.spring import Spring

Floats = NDArray[np.float64]

STIFFNESS_TOLERANCE = 0.01
"""Largest deviation of the secant stiffness at the design deflection."""
REST_TOLERANCE = 0.001
"""The same at rest, of the flexures alone, with contact at the contact radius."""
STRESS_TOLERANCE = 0.005
"""Stress counts as met within this share."""
BEND_TOLERANCE = 1e-4
"""Share by which a search may pass the bend limit."""
DEFORMED_GAP = 5e-5
"""Gap between deformed flexures below which tolerances of cut and model may make them touch, m."""
THIN_TOOTH = "camshaft tooth, thinnest"
"""A claim that the choice of a contact radius looks at."""
INTERFERENCE = "interference of camshaft and tips in the stroke"
CAM_INTERFERENCE = 5e-6
"""Depth to which the calculated tips may cut into the camshaft, m: below what a cut resolves."""


def spring_checks(spring: Spring) -> tuple[Check, ...]:
    """All checks, those made before the search first."""
    return (
        *spring.feasibility,
        *_stiffness(spring),
        *_stress(spring),
        *_flexures(spring),
        *_camshaft(spring),
    )


def root_fillet_stress(spring: Spring) -> float:
    """Largest stress in the root fillets at full deflection, Pa."""
    nominal = max(float(stroke.full.nominal_stress[0, 0]) for stroke in spring.strokes)
    return nominal * spring.sized.root.fillet_stress_factor


def _stiffness(spring: Spring) -> Iterator[Check]:
    target, end = spring.target, np.array([spring.target.deflection])
    at_rest = float(target.stiffness(np.zeros(1))[0])
    full = float(target.torque(end)[0])
    wanted = full / target.deflection
    yield check(
        "stiffness at rest with contact at the contact radius, deviation from the target",
        abs(spring.sized.stiffness_at_rest / at_rest - 1.0), "<=", REST_TOLERANCE, "1",
        source="beam on the root's spring",
    )  # fmt: skip
    source = "forward analysis of the camshaft as drawn; beam with large deflections"
    for stroke in spring.strokes:
        secant = float(stroke.torque[-1] / stroke.angle[-1])
        yield check(
            f"secant stiffness {_way(stroke.direction)}, deviation from the target",
            abs(secant / wanted - 1.0), "<=", STIFFNESS_TOLERANCE, "1", source=source,
        )  # fmt: skip
        off = float(np.max(np.abs(stroke.torque - target.torque(stroke.angle)))) / full
        yield check(
            f"torque {_way(stroke.direction)}, largest deviation from the law over the full torque",
            off, "<=", STIFFNESS_TOLERANCE, "1", source=source,
        )  # fmt: skip


def _stress(spring: Spring) -> Iterator[Check]:
    case, allowed = spring.case, spring.law.inputs.design_stress
    yielding = case.yield_strength
    nominal = max(float(stroke.nominal_stress.max()) for stroke in spring.strokes)
    local = max(float(stroke.local_stress.max()) for stroke in spring.strokes)
    beam = "beam with large deflections, bending and axial force, both directions"
    kind, stress = (
        ("nominal", nominal) if spring.spec.stress == "nominal" else ("inner-fibre", local)
    )
    yield check(
        f"{kind} stress at full load", stress, "<=", (1.0 + STRESS_TOLERANCE) * allowed, "Pa",
        source=f"{beam}; design stress + {STRESS_TOLERANCE:.1%}",
    )  # fmt: skip
    yield check(
        "inner-fibre stress against yield", local, "<=", yielding, "Pa",
        source=f"{beam}, curved-beam factor; material data",
        otherwise="warn" if spring.spec.stress == "nominal" else "fail",
        remedy=f"lower flexures.bend_limit below {spring.found.ribbon.largest_bend:.2g}, which it "
        "is here, or lower material.design_stress",
    )  # fmt: skip
    yield from _fillet_stress(spring)


def _fillet_stress(spring: Spring) -> Iterator[Check]:
    stress, limit = root_fillet_stress(spring), spring.spec.flexures.fillet_stress
    yielding = spring.case.yield_strength
    source = "beam, times the stress factor of finite elements of the root"
    if limit is not None:
        yield check(
            "root fillet stress", stress, "<=", (1.0 + STRESS_TOLERANCE) * limit, "Pa",
            source=f"{source}; flexures.fillet_stress + {STRESS_TOLERANCE:.1%}",
            remedy="raise flexures.fillet_stress or lower target.deflection",
        )  # fmt: skip
    yield check(
        "root fillet stress against yield", stress, "<=", yielding, "Pa",
        source=f"{source}; material", otherwise="warn",
        remedy=f"this part reaches it at {_fillet_yields(spring):.1f} deg; "
        f"flexures.fillet_stress: {yielding / 1e6:g} MPa makes the roots thicker, if there is room",
    )  # fmt: skip


def _flexures(spring: Spring) -> Iterator[Check]:
    ribbon, case = spring.found.ribbon, spring.case
    yield check(
        "half thickness x curvature", ribbon.largest_bend, "<=",
        (1.0 + BEND_TOLERANCE) * spring.spec.flexures.bend_limit, "1",
        source="flexures.bend_limit; from 1 on the edge would fold over",
    )  # fmt: skip
    yield check(
        "gap between flexures at rest", spring.found.gap, ">=", case.min_gap, "m",
        source="polygons of the flexures; smallest gap wanted",
    )  # fmt: skip
    for stroke in spring.strokes:
        yield _deformed_gap(spring.spec, stroke.direction, float(stroke.gap.min()))
    yield check(
        "root fillet radius", spring.fillet, ">=", spring.spec.process.rules.min_inside_radius,
        "m", source="smallest inside radius of the process",
    )  # fmt: skip
    yield check(
        "lateral balance: radial over tangential compliance of the tip", _lateral_balance(spring),
        "<=", 0.01, "1", source="small deflections; what makes both directions alike",
        otherwise="warn", remedy="set optimiser.form to curvature, which balances exactly",
    )  # fmt: skip


def full_load_gaps(spec: RotaryFlexureSpec, case: Case, sized: Sized) -> Iterator[Check]:
    """Gap between the sized flexures in each direction, before there is a camshaft.

    Within micrometres of what the stroke on the drawn camshaft leaves.
    """
    inputs, ribbon = case.inputs, sized.found.ribbon
    demand = demand_of(target_of(spec), inputs.root_radius, inputs.contact_radius, inputs.count)
    states = loads_of(ribbon, sized.beam, demand)
    for direction, bent in zip(DIRECTIONS, states, strict=True):
        gaps = deformed_gaps(ribbon, sized.beam, bent, inputs.root_radius, inputs.count)
        yield _deformed_gap(spec, direction, float(gaps.min()))


def _deformed_gap(spec: RotaryFlexureSpec, direction: int, gap: float) -> Check:
    asked = spec.flexures.min_deformed_gap
    return check(
        f"gap between deformed flexures {_way(direction)}", gap, ">=", asked or DEFORMED_GAP, "m",
        source="polygons of the deformed flexures; below 0 they touch",
        otherwise="fail" if asked or not gap >= 0.0 else "warn",
        remedy="lower target.deflection",
    )  # fmt: skip


def _lateral_balance(spring: Spring) -> float:
    """|integral M y/(EI) ds| over integral M (L - x)/(EI) ds for the unloaded shape."""
    ribbon = spring.found.ribbon
    points = ribbon.at(ribbon.grid.nodes)
    lever = np.maximum(spring.found.problem.lever - points.x, 0.0)
    weight = ribbon.grid.weights * lever / points.half_thickness**3
    return float(abs(weight @ points.y) / (weight @ lever))


def _camshaft(spring: Spring) -> Iterator[Check]:
    camshaft, case = spring.camshaft, spring.case
    yielding = case.yield_strength
    same = "camshaft taken to be of the flexures' material"
    yield check(
        THIN_TOOTH, camshaft.tooth_thickness, ">=", case.min_web, "m",
        source="outline of the camshaft; thinnest web of the process",
        remedy="raise envelope.contact_radius or lower flexures.count",
    )  # fmt: skip
    yield check(
        "camshaft tooth root stress against yield", camshaft.tooth_stress, "<=", yielding, "Pa",
        source=f"finite elements of a tooth at the end of its flanks; {same}",
        remedy="raise envelope.contact_radius or lower flexures.count",
    )  # fmt: skip
    yield check(
        "camshaft torsion inside the slots", camshaft.hub_stress, "<=", yielding / math.sqrt(3.0),
        "Pa", source=f"round core without notches, von Mises; {same}",
        remedy="raise envelope.contact_radius",
    )  # fmt: skip
    limit, words = pressure_limit(spring.spec.material.values)
    pressure = max(float(stroke.pressure.max()) for stroke in spring.strokes)
    yield check(
        "contact pressure on the flanks", pressure, "<=", limit, "Pa",
        source=f"strip of contact on the flank as drawn; {words}; {same}", otherwise="warn",
        remedy="raise envelope.thickness or flexures.count",
    )  # fmt: skip
    yield check(
        INTERFERENCE, camshaft.overlap, "<=",
        CAM_INTERFERENCE, "m", source="deformed tips against the teeth, at every angle solved",
        remedy=f"raise camshaft.backlash by {math.ceil(1e5 * camshaft.overlap) / 1e2:g} mm",
    )  # fmt: skip


def _fillet_yields(spring: Spring) -> float:
    """Deflection at which the root fillets reach yield, deg; their stress follows the tip force."""
    share = spring.case.yield_strength / root_fillet_stress(spring)
    angles = [
        np.interp(share * stroke.force[-1], stroke.force, stroke.angle) for stroke in spring.strokes
    ]
    return math.degrees(min(angles))


def _way(direction: int) -> str:
    return "counter-clockwise" if direction > 0 else "clockwise"
