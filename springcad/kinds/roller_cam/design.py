"""The roller cam from spec to result: law, profile, element, drawing, response, checks."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.geometry.outline_ops import profile_area, profile_faults
from springcad.kinds.roller_cam.case import Case
from springcad.kinds.roller_cam.compensation import JUDGED_FROM, Compensated, compensate
from springcad.kinds.roller_cam.correction import Correction, correction_of, followed_law
from springcad.kinds.roller_cam.curve import curve_through
from springcad.kinds.roller_cam.drawn import (
    FINEST,
    TIGHTER,
    DrawnProfile,
    drawn_profile,
    tolerance_for,
)
from springcad.kinds.roller_cam.element import (
    ElementDimensions,
    ElementGeometry,
    Mount,
    element_geometry,
    element_profile,
    first_place,
)
from springcad.kinds.roller_cam.feasibility import require_feasible
from springcad.kinds.roller_cam.forward import (
    Stroke,
    forward,
    least_gap,
    offset_sensitivity,
    roller_friction,
)
from springcad.kinds.roller_cam.inputs import case_of, foot_fillet, group_law, joint_of, roller_spec
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.roller_cam.made import MadeJoint
from springcad.kinds.roller_cam.part import exact_part, linear_part
from springcad.kinds.roller_cam.pseudo_law import TorqueCurve, expected_angle, pseudo_law
from springcad.kinds.roller_cam.remedies import synthesis_remedies
from springcad.kinds.roller_cam.sizing import size_cantilever
from springcad.kinds.roller_cam.spec import RollerCamSpec
from springcad.kinds.roller_cam.stepwise import distance, march, printed
from springcad.kinds.roller_cam.strip import roller_strips
from springcad.kinds.roller_cam.summary import summarise
from springcad.kinds.roller_cam.synthesis import ContactProfile, synthesise
from springcad.kinds.roller_cam.tip import linear_tip
from springcad.kinds.target_law import Law
from springcad.mechanics.conjugate import until
from springcad.mechanics.friction import FrictionLoop
from springcad.result import Progress, Result
from springcad.spec.source import Spec
from springcad.spec.torque_curve import TorqueFile
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

ANGLES = 200
"""Angles at which the drawn profile is analysed: its arcs waver, and none may be passed over."""
ROUNDING = 0.0125
"""Radius of outer corners over that of the roller: the first contact lies near the upper one."""
_BY_ENERGY = "use method: energy, which needs no steps"
_SMOOTHER = (
    "smooth target.law there, or raise contact_part.thickness; these were not tried, and no other "
    "number alone helps"
)
_ROUND_OFF = 1e-9


def design_joint(spec: Spec, progress: Progress) -> Result:
    """Design the element and say what the joint does with it.

    Raises:
        InfeasibleError: no element can give the law.
    """
    return summarise(spec, make_joint(roller_spec(spec.model), progress))


def redesign_joint(
    spec: Spec, written: WrittenDesign, curve: TorqueFile, progress: Progress
) -> Result:
    """The written design with the profile that its curve from elsewhere asks for.

    Raises:
        SpecError: the curve will not do.
        IncompleteDesignError: the report lacks something.
        InfeasibleError: no element can give the pseudo law.
    """
    model = roller_spec(spec.model)
    return summarise(spec, make_joint(model, progress, correction_of(written, model, curve)))


def make_joint(
    spec: RollerCamSpec, progress: Progress, correction: Correction | None = None
) -> MadeJoint:
    """The joint itself, without words about it.

    Raises:
        InfeasibleError: no element can give the law; with changes that were tried and that work.
    """
    law, case = group_law(spec), _case(spec, correction)
    followed = case.law
    feasibility = require_feasible(case)
    joint = _joint(spec, law, correction, progress)
    dimensions = _dimensions(spec) if correction is None else correction.dimensions
    progress("finding the profile")
    try:
        compensated = compensate(joint, followed, dimensions, spec.compensation)
    except InfeasibleError as error:
        if error.remedies:
            raise
        progress("no profile: trying what would help")
        raise error.with_remedies(*(synthesis_remedies(case) or [_SMOOTHER])) from error
    stepwise = None
    if spec.method == "stepwise":
        progress("stepping along the profile")
        compensated, stepwise = _stepped(spec, followed, compensated)
    profile = compensated.profile
    geometry = element_geometry(profile, dimensions)
    element = element_profile(geometry)
    faults = profile_faults(element)
    if faults:
        claim = f"faults in the outline of the element ({'; '.join(faults)})"
        raise InfeasibleError(claim, len(faults), 0.0, "1")
    progress("turning the joint through its stroke")
    angles = _angles(followed)
    try:
        sensitivity = offset_sensitivity(joint, profile.curve, angles)
        drawn, stroke = _drawn(spec, followed, compensated, geometry, sensitivity)
    except InfeasibleError as error:
        if stepwise is None:
            raise
        claim = f"on the profile of {spec.stepwise.steps} steps: {error.claim}"
        more = ("raise stepwise.steps", _BY_ENERGY)
        raise InfeasibleError(claim, error.value, error.limit, error.unit, more) from error
    density = spec.material.values.density.value
    return MadeJoint(
        spec=spec,
        case=case,
        law=law,
        correction=correction,
        followed=followed,
        feasibility=feasibility,
        joint=joint,
        compensated=compensated,
        stepwise_distance=(
            _stepwise_distance(spec, joint, followed) if stepwise is None else stepwise
        ),
        geometry=geometry,
        element=element,
        drawn=drawn,
        stroke=stroke,
        strips=roller_strips(joint, drawn.curve, stroke),
        expected_angle=_expected(law, stroke, correction),
        gap=least_gap(joint, drawn.curve, forward(joint, drawn.curve, angles)),
        sensitivity=sensitivity,
        friction=_friction(spec, followed, profile),
        mass=profile_area(element) * joint.cantilever.width * density,
    )


def _joint(
    spec: RollerCamSpec, law: Law, correction: Correction | None, progress: Progress
) -> Joint:
    """Cantilever and roller: as given, sized, or those of the design that is corrected."""
    if correction is not None:
        return correction.joint
    if spec.cantilever.objective is None:
        return joint_of(spec)
    progress("sizing the cantilever")
    return size_cantilever(spec, law).joint


def _case(spec: RollerCamSpec, correction: Correction | None) -> Case:
    """What the closed forms judge: the law, or the pseudo law and the joint of a correction."""
    case = case_of(spec)
    if correction is None:
        return case
    law = followed_law(case.law, correction)
    return replace(case, law=law, deflection=law.deflection, joint=correction.joint, is_sized=False)


def _friction(spec: RollerCamSpec, law: Law, profile: ContactProfile) -> FrictionLoop | None:
    if spec.friction == 0.0:
        return None
    flank = until(profile.flank, law.deflection * (1.0 + _ROUND_OFF))
    return roller_friction(profile.joint, profile.curve, flank, spec.friction)


def _expected(law: Law, stroke: Stroke, correction: Correction | None) -> Floats:
    if correction is None:
        return stroke.angle
    after = TorqueCurve(stroke.angle, stroke.torque)
    return expected_angle(law, correction.given, correction.ours, after)


def _dimensions(spec: RollerCamSpec) -> ElementDimensions:
    mount = spec.mount
    return ElementDimensions(
        thickness=spec.contact_part.thickness,
        root_fillet=spec.cantilever.root_fillet,
        foot_fillet=foot_fillet(spec),
        rounding=ROUNDING * spec.joint.roller_radius,
        gap=spec.process.rules.min_gap,
        mount=Mount(
            mount.length, mount.height, mount.hole_diameter, mount.holes, mounting=mount.held
        ),
    )


def _angles(law: Law) -> Floats:
    """Angles (A,) from where errors begin to count to the deflection, denser near rest."""
    share = np.linspace(np.sqrt(JUDGED_FROM), 1.0, ANGLES) ** 2
    return np.asarray(law.dead_zone + (law.deflection - law.dead_zone) * share)


def _drawn(
    spec: RollerCamSpec,
    law: Law,
    compensated: Compensated,
    geometry: ElementGeometry,
    sensitivity: Floats,
) -> tuple[DrawnProfile, Stroke]:
    """The profile in arcs fine enough for the torque, and the joint on it.

    An offset changes the torque by its sensitivity, but arcs also waver, and the torque is the
    slope of the energy: so the tolerance is tightened until the torque holds.
    """
    profile, angles = compensated.profile, _angles(law)
    yielding = compensated.compliance.at_place
    upper = first_place(profile, geometry.dimensions)
    designed = forward(profile.joint, profile.curve, angles, compliance=yielding).torque
    allowed = spec.torque_tolerance * float(designed[-1])
    tolerance = tolerance_for(allowed, sensitivity)
    while True:
        drawn = drawn_profile(geometry, upper, tolerance)
        try:
            stroke = forward(
                profile.joint, drawn.curve, angles, compliance=lambda place: yielding(place + upper)
            )
        except InfeasibleError:  # arcs waver, and a profile may be as round as the roller
            if tolerance <= FINEST:
                raise
        else:
            wandered = float(np.max(np.abs(stroke.torque - designed)))
            if wandered <= allowed or tolerance <= FINEST:
                share = wandered / float(designed[-1])
                return replace(drawn, torque_change=share), stroke
        tolerance = max(TIGHTER * tolerance, FINEST)


def _stepped(spec: RollerCamSpec, law: Law, compensated: Compensated) -> tuple[Compensated, float]:
    """The profile by the iteration of paper 001 in place of that by energy, and their distance.

    For the same law, with the same compensation.

    Raises:
        InfeasibleError: a step is not solved.
    """
    profile = compensated.profile
    wanted = law if compensated.ratio is None else pseudo_law(law, compensated.ratio)
    wanted = replace(wanted, deflection=float(profile.flank.angle[-1]))
    if spec.stepwise.form == "printed":
        steps = printed(profile.joint, wanted, spec.stepwise.steps)
    else:
        try:
            steps = march(exact_part(profile.joint), wanted, spec.stepwise.steps)
        except ArithmeticError as error:
            claim = f"steps of the iteration, without {error}"
            raise InfeasibleError(claim, 0.0, spec.stepwise.steps, "1", (_BY_ENERGY,)) from error
    if steps.failures:
        first = steps.failures[0]
        claim = (
            f"residual of {first.equation} in step {first.step} of the printed iteration, at "
            f"{math.degrees(first.angle):.4g} deg ({first.reason})"
        )
        raise InfeasibleError(claim, abs(first.residual), 0.0, "1", (_BY_ENERGY,))
    curve, _ = curve_through(steps.points)
    stepped = replace(compensated, profile=replace(profile, curve=curve))
    return stepped, distance(steps, profile.curve)


def _stepwise_distance(spec: RollerCamSpec, joint: Joint, law: Law) -> float | None:
    """How far the sound form of paper 001's iteration is from the energy balance.

    Both with the model of the paper: small rotations and a rigid contact part.
    """
    try:
        steps = march(linear_part(joint), law, spec.stepwise.steps)
        return distance(steps, synthesise(joint, law, beam=linear_tip).curve)
    except (ArithmeticError, InfeasibleError):
        return None
