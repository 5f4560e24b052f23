"""Peak pressure between roller and profile, by a block of the contact part on fine elements.

The elements of the whole model give force and place of the contact; the strip itself is no wider
than a few of them (``springcad.mechanics.fem.pad``).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.polyline import BulgePolyline, flatten
from springcad.kinds.roller_cam.contact_model import ElementContact, Press
from springcad.mechanics.contact import contact_modulus
from springcad.mechanics.fem.pad import pad_pressure
from springcad.mechanics.fem.rigid_profile import RigidProfile, project, rigid_profile

Floats = NDArray[np.float64]

_CHORD = 1e-9
"""Between the arcs of the drawing and their chords (m): a few micrometres long."""
_REACH = 0.5
"""Of the profile to either side of the contact, over the radius of the roller; the widest strips
are half as wide."""
_STEEPEST = 0.5
"""Cosine of the angle to the contact up to which the profile is looked at."""


def contact_pressure(element: ElementContact, press: Press, drawn: BulgePolyline) -> float:
    """Peak pressure on the element's profile as drawn (Pa), both bodies of its material.

    Infinite where the strip runs off an end of the profile, not a number where nothing touches or
    there is no strip. The block is straight; what the profile is curved is given to the roller.
    """
    contact, pair = press.state.contact, element.model.contact
    assert contact is not None
    assert pair is not None
    shares = contact.pressure * pair.weights
    if not shares.any():
        return math.nan
    shares = shares / shares.sum()
    at_rest = np.einsum("ga,kai->kgi", pair.shape, pair.reference)
    middle = np.einsum("kg,kgi->i", shares, at_rest)
    roller = float(np.sum(shares * contact.near.curvature))
    sheet = element.model.solid.sheet
    modulus = contact_modulus(*(sheet.elastic_modulus, sheet.poisson_ratio) * 2)
    try:
        return pad_pressure(
            _difference(drawn, middle, roller, _REACH * element.roller.radius),
            np.zeros(2),
            float(np.hypot(*press.force)),
            half_thickness=0.5 * element.geometry.dimensions.thickness,
            sheet=replace(sheet, elastic_modulus=modulus),
        ).peak_pressure
    except ValueError:
        return math.nan


def _difference(drawn: BulgePolyline, middle: Floats, roller: float, reach: float) -> RigidProfile:
    """The body that is as far from a straight pad as the roller is from the profile.

    Args:
        drawn: contour of the element, counter-clockwise.
        middle: of the contact, on the unloaded profile (2,).
        roller: its curvature there [1/m].
        reach: of the profile to either side [m].
    """
    points = flatten(drawn, _CHORD)
    points = points[np.hypot(*(points - middle).T) < reach]
    near = project(rigid_profile(points), middle)
    away = points - middle
    steps = np.diff(away, axis=0)
    smooth = steps @ near.tangent > _STEEPEST * np.hypot(*steps.T)
    nearest = int(np.argmin(np.hypot(*away.T)))
    breaks = np.flatnonzero(~smooth)
    first = int(np.max(breaks[breaks < nearest], initial=-1)) + 1
    last = int(np.min(breaks[breaks >= nearest], initial=len(steps)))
    along, out = away[first : last + 1] @ near.tangent, away[first : last + 1] @ near.normal
    # A parabola for the circle would be as far off as the profile is from a roller nearly as round.
    sunk = (1.0 - np.sqrt(np.maximum(1.0 - (roller * along) ** 2, 0.0))) / roller
    gap = sunk - (out - out[nearest - first])
    return rigid_profile(np.column_stack([along, -gap])[::-1])
