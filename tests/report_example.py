"""A finished rotary flexure as the report tests see it: design S2 of paper 004, told in full."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from springcad.geometry.outline import Circle, Profile
from springcad.result import (
    Comparison,
    Dimension,
    Judgement,
    Outcome,
    Part,
    Plot,
    Result,
    Series,
    check,
)

DEG = np.pi / 180
DRAWING = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<svg xmlns="http://www.w3.org/2000/svg" width="71mm" height="71mm"'
    ' viewBox="-35.5 -35.5 71 71">'
    "<title>s2</title>"
    '<g fill="none" stroke="#000" stroke-width="0.25"><circle r="33.5"/><circle r="31"/>'
    '<circle r="6"/></g></svg>'
)
FILES = {
    "s2.dxf": "flexure ring, cut profile in millimetres",
    "s2-camshaft.dxf": "camshaft, cut profile in millimetres",
    "s2.svg": "drawing of both parts, true to size",
    "report.json": "this report for machines",
    "report.html": "this page",
    "manifest.json": "sha256 of every file",
}


def _checks():
    beam = "plane elastica with shear, free of end load at the rim; paper 004, Eq. 3"
    return (
        check("strain factor f_s", 0.7421, "<=", 1.0, "1", source="paper 004, Eq. 9"),
        check("density factor f_d", 0.5304, "<=", 0.75, "1", source="paper 004, Eq. 10"),
        check("nominal bending stress", 911.4e6, "<=", 912e6, "Pa", source=beam),
        check(
            "local inner-fibre stress",
            1139.5e6,
            "<=",
            1350e6,
            "Pa",
            source="nominal stress times the curved-beam factor K(z), z = 0.30",
        ),
        check("yield safety, local", 1.185, ">=", 1.0, "1", source="Rp0.2 of AISI 420, 52 HRC"),
        check(
            "stiffness, secant at the design deflection",
            148.5,
            ">=",
            147.0,
            "N*m/rad",
            source=beam,
        ),
        check("deflection reached", 14.5 * DEG, ">=", 14.5 * DEG, "rad", source=beam),
        check("smallest gap, unloaded", 1.198e-3, ">=", 0.3e-3, "m", source="polygon distance"),
        check(
            "smallest gap over the stroke",
            0.2871e-3,
            ">=",
            0.3e-3,
            "m",
            source="polygon distance in 18 deformed states, both directions",
            remedy="lower deflection from 14.5 deg to <= 14.2 deg, or raise contact_radius from "
            "6 mm to >= 6.3 mm; either gives a gap of at least 0.31 mm",
        ),
        check("root fillet radius", 0.62e-3, ">=", 0.15e-3, "m", source="process wire-edm"),
        check("smallest web", 0.801e-3, ">=", 0.3e-3, "m", source="process wire-edm"),
        check(
            "contact pressure at the tooth",
            1621e6,
            "<=",
            1500e6,
            "Pa",
            source="Hertz line contact, steel on steel",
            remedy="raise the tip nose radius from 0.8 mm to >= 0.94 mm",
            otherwise="warn",
        ),
        check("hub torsion", 214.7e6, "<=", 455e6, "Pa", source="solid shaft under peak torque"),
        check(
            "finite elements against beam, stiffness",
            float("nan"),
            "<=",
            0.02,
            "1",
            source="2-D plane stress, not run with --no-verify",
            remedy="run the design again without --no-verify",
            otherwise="warn",
        ),
        check(
            "offset of the centre line, z",
            0.2999999999,
            "<=",
            0.3,
            "1",
            source="half thickness times curvature, everywhere on the flexure",
        ),
    )


def _plots(angle, torque):
    arc_length = np.linspace(0, 38.4e-3, 160)
    share = arc_length / arc_length[-1]
    nominal = 911.4e6 * (1 - share**8) * (1 - 0.04 * np.sin(6 * share) ** 2)
    local = nominal * (1.0 + 0.25 * np.abs(np.sin(9.0 * share)))
    gap_angle = np.linspace(-14.5, 14.5, 61) * DEG
    return (
        Plot(
            "Torque over angle, both directions",
            "angle",
            "rad",
            "torque",
            "N*m",
            (
                Series("computed", angle, torque),
                Series("target, 150 N*m/rad", angle, 150 * angle, dashed=True),
            ),
        ),
        Plot(
            "Stress along the flexure at full deflection",
            "arc length from the root",
            "m",
            "edge stress",
            "Pa",
            (
                Series("nominal", arc_length, nominal),
                Series("local, with the curved-beam factor", arc_length, local),
            ),
            limit=1350e6,
        ),
        Plot(
            "Smallest gap between neighbours over the stroke",
            "angle",
            "rad",
            "gap",
            "m",
            (
                Series(
                    "smallest gap", gap_angle, 1.198e-3 - 0.9109e-3 * (gap_angle / 0.253073) ** 2
                ),
            ),
            limit=0.3e-3,
        ),
    )


def example_result(**changes) -> Result:
    """Design S2 with fifteen checks, of which one fails and two warn; fields by ``changes``."""
    angle = np.linspace(-14.5, 14.5, 59) * DEG
    torque = 148.9 * angle - 30 * angle**3
    ring = Profile(Circle((0.0, 0.0), 33.5e-3), (Circle((0.0, 0.0), 31e-3),))
    shaft = Profile(Circle((0.0, 0.0), 6.4e-3))
    result = Result(
        kind="rotary-flexure",
        name="s2",
        spec={
            "springcad": 1,
            "kind": "rotary-flexure",
            "name": "s2",
            "target": {"stiffness": "150 N*m/rad", "deflection": "14.5 deg"},
            "envelope": {
                "outer_radius": "33.5 mm",
                "root_radius": "31 mm",
                "contact_radius": "6 mm",
                "thickness": "4.5 mm",
            },
            "flexures": {"count": 24},
            "material": {"name": "aisi-420", "design_stress": "912 MPa"},
            "process": "wire-edm",
        },
        design={
            "serpentine_factor": 0.7421,
            "density_factor": 0.5304,
            "flexure_count": 24,
            "contact_radius_m": 6e-3,
            "mass_kg": 0.071,
            "centre_line": {
                "arc_length_m": 38.4e-3,
                "root_angle_rad": 0.1234567890123456,
                "curvature_coefficients": np.array([12.5, -80.0, 150.25, -1 / 3, 0.0, -0.0]),
            },
            "optimiser_form": "curvature",
        },
        response={
            "stiffness_Nm_per_rad": 148.5,
            "max_deflection_rad": 14.5 * DEG,
            "peak_nominal_stress_Pa": 911.4e6,
            "peak_local_stress_Pa": 1139.5e6,
            "min_gap_m": 0.2871e-3,
            "energy_J": 4.756,
            "angle_rad": angle,
            "torque_Nm": torque,
            "finite_element_stiffness_Nm_per_rad": float("nan"),
        },
        checks=_checks(),
        outcomes=(
            Outcome("stiffness", 148.5, "N*m/rad", 150.0, "secant at the design deflection"),
            Outcome("deflection", 14.5 * DEG, "rad", 14.5 * DEG, "either direction"),
            Outcome("peak nominal stress", 911.4e6, "Pa", 912e6),
            Outcome("peak local stress", 1139.5e6, "Pa", None, "inner fibre of the sharpest bend"),
            Outcome("mass, flexure ring", 0.071, "kg", None),
            Outcome("stored energy", 4.756, "J", None, "at the design deflection"),
            Outcome("torque at the design deflection", 37.58, "N*m", 37.96),
            Outcome("smallest gap over the stroke", 0.2871e-3, "m", None),
        ),
        parts=(
            Part(
                "",
                "flexure ring",
                ring,
                4.5e-3,
                "AISI 420, hardened to 52 HRC",
                dimensions=(Dimension("R33.5", "radius", (0.0, 0.0), (33.5e-3, 0.0)),),
            ),
            Part("camshaft", "camshaft", shaft, 4.5e-3, "AISI 420, hardened to 52 HRC"),
        ),
        plots=_plots(angle, torque),
        assumptions=(
            "The rim is taken as rigid; its own compliance was not checked.",
            "All 24 flexures are taken to carry the same load; pitch errors of the cut part share "
            "the load unevenly.",
            "Friction between tooth and flexure is left out, so the two directions of motion have "
            "the same curve and no hysteresis.",
            "Fatigue life was not checked: the spec gives a design stress and no life.",
        ),
        advice=(
            "A straight flexure would do with contact_radius 7.4 mm and 18 flexures: nominal "
            "stress 906 MPa, smallest gap 1.25 mm, mass 83 g.",
        ),
        judgement=Judgement(
            method="finite elements",
            comparisons=(
                Comparison(
                    name="torque over the stroke",
                    unit="N*m",
                    place="angle",
                    place_unit="rad",
                    places=np.array([-14.5 * DEG, 14.5 * DEG]),
                    designed=np.array([37.58, 37.58]),
                    judged=np.array([37.62, 37.41]),
                    tolerance=0.01,
                    relative=True,
                    source="beam; finite elements",
                ),
                Comparison(
                    name="gap between deformed flexures",
                    unit="m",
                    place="angle",
                    place_unit="rad",
                    places=np.array([14.5 * DEG]),
                    designed=np.array([0.2871e-3]),
                    judged=np.array([0.2862e-3]),
                    tolerance=5e-6,
                    relative=False,
                    source="beam; finite elements",
                ),
            ),
            checks=(),
            assumptions=("The camshaft is rigid.",),
            figures={"elements": 1446},
        ),
        provenance={
            "spec_sha256": "5f0d1c" * 10 + "9a3b",
            "seed": 20240601,
            "starts": 24,
            "feasible_starts": 24,
            "libraries": {"numpy": "2.3.5", "scipy": "1.16.3", "shapely": "2.1.2"},
        },
    )
    return replace(result, **changes)
