"""Room between the camshaft's teeth and the tips of the flexures, at rest and deformed."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray

from springcad.geometry.outline import Line, Outline
from springcad.geometry.outline_ops import contour_points, piece_end
from springcad.geometry.polyline import rotate_vectors
from springcad.kinds.rotary_flexure.cam_slot import Slot
from springcad.kinds.rotary_flexure.flexure_contact import global_points, tip_outlines
from springcad.mechanics.beam import PreparedBeam, contact_load
from springcad.mechanics.conjugate import Flank

if TYPE_CHECKING:
    from springcad.kinds.rotary_flexure.camshaft import CamshaftInputs

Floats = NDArray[np.float64]

_CHORD = 1e-8
"""Distance between the slot and the chords that stand for it where clearance is measured (m)."""


def overlap(beam: PreparedBeam, inputs: CamshaftInputs, slot: Slot, side: Flank) -> float:
    """How deep the deformed tip cuts into the teeth beside its slot, at the angles of ``side``.

    Tested both ways with dense points, of the tip against the slot and of the slot against the
    tip; arcs are chords within 10 nm.
    """
    space = slot_polygon(slot)
    boundary = np.asarray(space.exterior.coords)
    points = shapely.points(boundary[np.hypot(*boundary.T) < (1.0 + 1e-9) * slot.tip_radius])
    deepest = 0.0
    turned = replace(side, angle=side.angle + slot.free_play)
    for tip in tips_in_slot(beam, inputs, turned):
        inside = tip[np.hypot(*tip.T) < slot.tip_radius]
        deepest = max(deepest, float(shapely.distance(shapely.points(inside), space).max()))
        outline = shapely.Polygon(tip)
        shapely.prepare(outline)
        covered = points[shapely.contains(outline, points)]
        if len(covered):
            deepest = max(deepest, float(shapely.distance(covered, outline.exterior).max()))
    return deepest


def tips_in_slot(beam: PreparedBeam, inputs: CamshaftInputs, side: Flank) -> Floats:
    """Outlines (A, M, 2) of the deformed tip in the camshaft's frame at the angles of a flank."""
    states = contact_load(beam, side.station, side.force, side.direction)
    reach = 3.0 * (inputs.nose_station - inputs.pad_start)
    tips = tip_outlines(beam, states, inputs.nose_station, reach)
    around = global_points(tips, inputs.root_radius)
    turn = np.repeat(-side.direction * side.angle, around.shape[1])
    return rotate_vectors(around.reshape(-1, 2), turn).reshape(around.shape)


def slot_polygon(slot: Slot) -> shapely.Polygon:
    """The slot as a polygon, open outside the tip circle by as much as it is deep."""
    ends = [piece_end(slot.pieces[i], -i)[0] for i in (0, -1)]
    outside = [(2.0 - slot.bottom_radius / slot.tip_radius) * end for end in ends]
    corners = [(float(x), float(y)) for x, y in (ends[1], outside[1], outside[0], ends[0])]
    opening = tuple(Line(a, b) for a, b in pairwise(corners))
    return shapely.Polygon(contour_points(Outline((*slot.pieces, *opening)), _CHORD))


def thinnest_tooth(slot: Slot, count: int) -> float:
    """Smallest distance between a slot and the next, m."""
    space = slot_polygon(slot)
    pitch = 2.0 * np.pi / count
    return float(space.distance(shapely.affinity.rotate(space, pitch, (0, 0), use_radians=True)))
