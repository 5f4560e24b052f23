"""The strip on which the roller touches the profile: how long, and how hard it is pressed.

Roller and profile are nearly as round as each other towards full stroke: the strip is then a
millimetre long, and along it the relative curvature changes (``mechanics.contact_strip``).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.kinds.roller_cam.curve import ProfileCurve
from springcad.kinds.roller_cam.forward import Stroke
from springcad.kinds.roller_cam.joint import Joint
from springcad.kinds.roller_cam.part import roller_curvature
from springcad.mechanics.contact import contact_modulus
from springcad.mechanics.contact_strip import Strips, contact_strips

Floats = NDArray[np.float64]


def roller_strips(joint: Joint, curve: ProfileCurve, stroke: Stroke) -> Strips:
    """Strips (A,) of a roller of the element's material; where it is clear, of no size.

    Places are along the profile, from the place of the contact.

    Raises:
        InfeasibleError: the roller is rounder than the profile is hollow on no whole strip.
    """
    touching = stroke.normal_force > 0.0
    angle, gamma, place = (
        values[touching] for values in (stroke.angle, stroke.gamma, stroke.place)
    )
    roller = roller_curvature(joint.roller, angle, gamma)[:, None]
    tangent = curve.tangents(place)[:, None]

    def opening(along: Floats) -> tuple[Floats, Floats]:
        at = (place[:, None] + along).ravel()
        there = curve.tangents(at).reshape(*along.shape, 2)
        cross = tangent[..., 0] * there[..., 1] - tangent[..., 1] * there[..., 0]
        turn = np.arctan2(cross, np.sum(tangent * there, axis=-1))
        return roller * along + turn, roller + curve.curvature(at).reshape(along.shape)

    beam = joint.cantilever
    modulus = contact_modulus(*(beam.elastic_modulus, beam.poisson_ratio) * 2)
    force, curvature = stroke.normal_force[touching], stroke.curvature[touching]
    try:
        found = contact_strips(opening, force, beam.width, curvature, modulus)
    except ArithmeticError as error:
        claim = "strip of contact found; profile and roller are nearly as round as each other"
        raise InfeasibleError(claim, 0.0, 1.0, "1", ("raise joint.drum_radius",)) from error

    def whole(values: Floats) -> Floats:
        placed = np.zeros_like(stroke.angle)
        placed[touching] = values
        return placed

    return Strips(*(whole(v) for v in (found.middle, found.half_width, found.peak_pressure)))
