"""What an elastic part is to a rigid profile that touches it.

One of two bodies in contact carries the profile, the other, its mate, has a given surface. One of
them turns with the angle θ, the elastic one yields. The flexure of a ring is elastic and the mate
of a profile on the turning camshaft; the roller on a turning drum is the mate of a profile on the
tip of a cantilever. To the equations of contact that is all the same when places and directions are
given in the frame of the body that carries the profile.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ContactState:
    """States of an elastic part under L contact forces; frame of the body with the profile.

    Attributes:
        arm: torque against the motion per unit of normal force (L,) [m].
        reach: way of the turning body's point of contact per angle (L,) [m]; the radius, where
            the profile turns. Without friction ``arm / reach`` is the cosine of the pressure angle.
        energy: stored in the part (L,) [J].
        point: of contact (L, 2) [m].
        normal: of the mate's surface there, outward, so into the profile (L, 2).
        tangent: of the mate's surface towards larger ``arc`` (L, 2).
        arc: of the contact along the mate's surface (L,) [m].
        mate_curvature: of the mate's surface, convex positive, 0 for a flat pad (L,) [1/m].
    """

    arm: Floats
    reach: Floats
    energy: Floats
    point: Floats
    normal: Floats
    tangent: Floats
    arc: Floats
    mate_curvature: Floats


class ElasticPart(Protocol):
    """One elastic part in contact at θ = ``angle`` [rad] with the normal force ``force`` [N].

    ``station`` says where: the part's own coordinate of the contact, as a station along a flexure
    or an angle round a roller. Arrays (L,). Values that are not finite mean: no such state.

    A part with friction has a tangential force too, by its own coefficient; it acts on the mate
    along ``tangent`` and enters ``arm``.
    """

    def __call__(self, angle: Floats, force: Floats, station: Floats) -> ContactState: ...
