"""Conditions that a finished joint is asked for and that a sound design cannot break, broken.

The joint of paper 001 with a drum of 27 mm, turned farther than it was made for or with a bump on
its profile: each check must see it, say where, and give changes that were tried.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from springcad.errors import InfeasibleError
from springcad.kinds.roller_cam.checks import joint_checks
from springcad.kinds.roller_cam.curve import curve_through
from springcad.kinds.roller_cam.design import make_joint
from springcad.kinds.roller_cam.element import last_place
from springcad.kinds.roller_cam.forward import forward, least_gap
from springcad.kinds.roller_cam.inputs import roller_spec
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.kinds.roller_cam.strip import roller_strips
from springcad.kinds.roller_cam.synthesis import synthesise
from springcad.result import Check
from springcad.spec.source import read_spec

PAPER = Path(__file__).parents[2] / "specs" / "roller-paper.yaml"


@cache
def made() -> MadeJoint:
    spec = read_spec(PAPER, ["joint.drum_radius=27 mm"])
    return make_joint(roller_spec(spec.model), lambda _: None)


def turned_by(factor: float) -> MadeJoint:
    """The drawn element, its contact part yielding, turned farther than it was made for."""
    joint = made()
    upper, yielding = joint.drawn.upper, joint.compensated.compliance.at_place
    angle = factor * joint.stroke.angle
    stroke = forward(
        joint.joint, joint.drawn.curve, angle, compliance=lambda place: yielding(place + upper)
    )
    return replace(
        joint,
        stroke=stroke,
        expected_angle=angle,
        strips=roller_strips(joint.joint, joint.drawn.curve, stroke),
        case=replace(joint.case, deflection=factor * joint.case.deflection),
    )


def claim_of(joint: MadeJoint, name: str) -> Check:
    (claim,) = (claim for claim in joint_checks(joint) if claim.name == name)
    return claim


def test_the_joint_as_made_breaks_none() -> None:
    assert not [claim.name for claim in joint_checks(made()) if claim.status == "fail"]


def test_beyond_the_level_end_of_the_profile_the_contact_passes_under_the_roller() -> None:
    """The profile ends level at most, seen from the tip: 90 deg and the tip's turn bound it."""
    joint = turned_by(1.08)
    claim = claim_of(joint, "contact angle round the roller")
    tip = abs(float(joint.stroke.tip.rotation[-1]))
    assert claim.status == "fail"
    assert 0.5 * math.pi + 0.5 * tip < claim.value <= 0.5 * math.pi + tip
    assert claim.limit == 0.5 * math.pi
    assert f"contact angle at {1.08 * 1.9:.4g} deg: " in claim.remedy
    turns = re.findall(r"(?:raise|lower) \S.*? from \S+ to \S+ \S+", claim.remedy)
    assert len(turns) == 3


def test_a_profile_of_a_sound_law_has_a_contact_angle_below_ninety_to_its_end() -> None:
    """Solved within that quarter: where it would be more, the energy is refused before."""
    gamma = made().compensated.profile.gamma
    assert np.all(np.diff(gamma) > 0.0)
    assert gamma[-1] < 0.5 * math.pi
    case = made().case
    short = replace(case.joint, roller=replace(case.joint.roller, drum_radius=24e-3))
    with pytest.raises(InfeasibleError, match="too soft"):
        synthesise(short, case.law)


def test_a_bump_is_told_with_its_depth_and_angle() -> None:
    joint = made()
    curve, place = joint.drawn.curve, float(joint.stroke.place[60])
    along = np.linspace(0.0, curve.length, 600)
    bump = 20e-6 * np.exp(-(((along - place) / 0.2e-3) ** 2))
    bumped, _ = curve_through(curve.points(along) - bump[:, None] * curve.normals(along), 3)
    rigid = forward(joint.joint, curve, joint.stroke.angle)
    cut = replace(joint, gap=least_gap(joint.joint, bumped, rigid))
    claim = claim_of(cut, "interference of roller and profile in the stroke")
    assert claim.status == "fail"
    assert claim.value == pytest.approx(20e-6, rel=0.05)
    # nothing in the numbers of this spec makes a bump, so no change of one is claimed to cure it
    assert "roller cuts the profile at" in claim.remedy
    assert "neither was tried" in claim.remedy


def test_a_round_roller_interferes_nowhere_with_a_profile_it_touches_everywhere() -> None:
    """The slope of the gap along the profile is the turn of one against the other: it only rises.

    Asked of the whole profile at every angle, with the tilt of the roller: no depth at all."""
    joint = made()
    curve = joint.compensated.profile.curve
    gap = least_gap(joint.joint, curve, forward(joint.joint, curve, joint.stroke.angle))
    assert gap.min() > -1e-8
    place = np.linspace(0.0, curve.length, 400)
    assert np.all(1.0 / joint.joint.roller.radius + curve.curvature(place) > 0.0)


def test_a_strip_that_runs_off_the_profile_is_told() -> None:
    """With the profile cut at its last contact half of the strip at full stroke has no support."""
    joint = made()
    profile = joint.compensated.profile
    beyond = last_place(profile) - profile.curve.length
    curve = joint.drawn.curve
    places = np.linspace(0.0, curve.length - beyond - 0.5e-3, 800)
    cut, _ = curve_through(curve.points(places), 3)
    claim = claim_of(
        replace(joint, drawn=replace(joint.drawn, curve=cut)),
        "profile beyond the strip of contact",
    )
    assert claim.status == "fail"
    assert claim.value < 0.0 == claim.limit
    assert "strip at 1.9 deg" in claim.remedy
