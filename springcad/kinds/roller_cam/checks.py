"""The claims that a finished roller cam must stand up to."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from springcad.kinds.pressure import pressure_limit
from springcad.kinds.roller_cam.correction import Correction
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.kinds.roller_cam.remedies import (
    INTERFERENCE,
    bears_roller,
    synthesis_remedies,
    within_stress,
)
from springcad.result import Check, check

TORQUE_TOLERANCE = 0.01
"""Largest deviation from the law, over the full torque; relative to the law it is a warning."""
STRESS_TOLERANCE = 0.01
"""Stress counts as met within this share: the closed forms allow for as much."""
LARGEST_CORRECTION = 2.0
"""Factor of the law's angles beyond which a curve from elsewhere is hardly of the same joint."""


def joint_checks(made: MadeJoint) -> tuple[Check, ...]:
    """All checks, those made before the synthesis first."""
    return (*made.feasibility, *_torque(made), *_contact(made), *_strength(made))


def torque_errors(made: MadeJoint) -> tuple[float, float]:
    """Largest |τ/τ_law − 1| over the stroke, and |τ − τ_law| over the full torque.

    With a correction at the angles expected where its curve is from.
    """
    wanted = made.law.torque(made.expected_angle)
    away = np.abs(made.stroke.torque - wanted)
    return float(np.max(away / wanted)), float(np.max(away) / wanted[-1])


def first_contact(made: MadeJoint) -> float:
    """Angle from which on the roller touches where the law asks for it [rad].

    The first contacts of a law without slope are as high as the axis of the roller, and there the
    mirrored element begins.
    """
    return float(made.compensated.profile.angle_of(np.array([made.drawn.upper]))[0])


def uncertain_until(made: MadeJoint) -> float | None:
    """Last angle at which the torque misses the law by more than ``TORQUE_TOLERANCE`` of itself.

    From 2.6 % of the stroke on; None where there is none.
    """
    wanted = made.law.torque(made.expected_angle)
    missed = np.flatnonzero(np.abs(made.stroke.torque / wanted - 1.0) > TORQUE_TOLERANCE)
    return float(made.expected_angle[missed[-1]]) if len(missed) else None


def strip_room(made: MadeJoint) -> np.ndarray:
    """Of the profile, from the end of the strip of contact to its own lower end (A,) [m].

    Infinite where the roller is clear.
    """
    strips = made.strips
    end = made.stroke.place + strips.middle + strips.half_width
    return np.where(np.isfinite(end), made.drawn.curve.length - end, np.inf)


def _torque(made: MadeJoint) -> Iterator[Check]:
    relative, absolute = torque_errors(made)
    torque = "torque"
    source = "forward analysis of the drawn profile, beam and contact part elastic"
    remedy = torque_remedy(made)
    if made.correction is not None:
        torque = "expected torque"
        source = "given curve, its angles changed by what the forward analyses differ"
        remedy = "give a smoother curve with more points; or correct this design in its turn"
        yield from _correction(made.correction)
    yield check(
        f"{torque} against the law, over the full torque", absolute, "<=", TORQUE_TOLERANCE, "1",
        source=source, remedy=remedy,
    )  # fmt: skip
    yield check(
        f"{torque} against the law, relative, from 2.6 % of the stroke on", relative, "<=",
        TORQUE_TOLERANCE, "1", source=source, remedy=remedy, otherwise="warn",
    )  # fmt: skip
    yield check(
        "torque that the arcs of the drawing change, over the full torque",
        made.drawn.torque_change, "<=", made.spec.torque_tolerance, "1",
        source=f"drawn against designed profile; arcs within {1e6 * made.drawn.tolerance:.2g} um",
        remedy="raise torque_tolerance: no drawing is finer", otherwise="warn",
    )  # fmt: skip


def torque_remedy(made: MadeJoint) -> str:
    """By what the torque misses the law: compensation, room, drawing, or the joint itself."""
    if made.spec.compensation != "compliance":
        method = "" if made.spec.method == "energy" else "method to energy and "
        return f"set {method}compensation to compliance, or raise contact_part.thickness"
    if first_contact(made) > made.law.dead_zone:
        return (
            "lower torque_tolerance; before the first contact only a law with slope at rest helps"
        )
    if made.compensated.error <= TORQUE_TOLERANCE:
        return "lower torque_tolerance: the arcs of the drawing waver"
    return "raise joint.drum_radius or contact_part.thickness"


def _correction(correction: Correction) -> Iterator[Check]:
    ratio = correction.ratio(np.linspace(correction.ratio.first, correction.ratio.last))
    yield check(
        "correction of the law's angles, largest factor either way",
        float(np.max(np.maximum(ratio, 1.0 / ratio))), "<=", LARGEST_CORRECTION, "1",
        source=f"curve of {correction.before}, law over curve at equal torque; all corrections",
        remedy="look whether the curve begins at rest and is of this design", otherwise="warn",
    )  # fmt: skip


def _contact(made: MadeJoint) -> Iterator[Check]:
    stroke = made.stroke
    touching = np.flatnonzero(np.isfinite(stroke.gamma))
    if len(touching):
        worst = touching[int(np.argmax(stroke.gamma[touching]))]
        gamma, angle = float(stroke.gamma[worst]), float(stroke.angle[worst])
        claim = check(
            "contact angle round the roller", gamma, "<=", 0.5 * math.pi, "rad",
            source=f"forward analysis, largest at {math.degrees(angle):.4g} deg; beyond it the "
            "cantilever cannot store more",
        )  # fmt: skip
        yield _with_profile_remedy(claim, made, f"contact angle at {math.degrees(angle):.4g} deg")
    left = strip_room(made)
    tightest = int(np.argmin(left))
    where = f"{math.degrees(stroke.angle[tightest]):.4g} deg"
    claim = check(
        "profile beyond the strip of contact", float(left[tightest]), ">=", 0.0, "m",
        source=f"least at {where}, where the strip is "
        f"{2e3 * made.strips.half_width[tightest]:.3g} mm long",
    )  # fmt: skip
    yield _with_profile_remedy(claim, made, f"strip at {where}")
    deepest = int(np.argmin(made.gap))
    depth = max(0.0, -float(made.gap[deepest]))
    where = f"{math.degrees(stroke.angle[deepest]):.4g} deg"
    claim = check(
        "interference of roller and profile in the stroke", depth, "<=", INTERFERENCE, "m",
        source=f"smallest distance along the whole profile, at {where}",
    )  # fmt: skip
    yield _with_profile_remedy(claim, made, f"roller cuts the profile at {where}")
    limit, words = pressure_limit(made.spec.material.values)
    yield check(
        "contact pressure on the profile", float(np.max(made.strips.peak_pressure)), "<=", limit,
        "Pa", source=f"drawn profile; {words}",
        remedy="a larger joint.roller_radius or a thicker sheet lowers it", otherwise="warn",
    )  # fmt: skip


def _with_profile_remedy(claim: Check, made: MadeJoint, where: str) -> Check:
    """The claim; if it fails with changes that were tried, else with what was not."""
    if claim.status == "pass":
        return claim
    if made.spec.compensation != "compliance":
        return replace(claim, remedy=f"{where}: {torque_remedy(made)}")
    tried = "; or ".join(synthesis_remedies(made.case, bears_roller(made.case)))
    remedy = tried or "raise joint.drum_radius, or smooth target.law there; neither was tried"
    return replace(claim, remedy=f"{where}: {remedy}")


def _strength(made: MadeJoint) -> Iterator[Check]:
    allowed = made.spec.material.design_stress
    stress = float(np.max(made.stroke.tip.stress))
    remedy = "raise joint.drum_radius, or make the cantilever stronger"
    if stress > (1.0 + STRESS_TOLERANCE) * allowed:
        remedy = "; or ".join(synthesis_remedies(made.case, within_stress(made.case))) or remedy
    yield check(
        "nominal stress at the clamp", stress, "<=", (1.0 + STRESS_TOLERANCE) * allowed, "Pa",
        source=f"beam, bending and axial, no notch; design stress + {STRESS_TOLERANCE:.0%}",
        remedy=remedy,
    )  # fmt: skip
