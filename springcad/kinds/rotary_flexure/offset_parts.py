"""Ring and camshaft whose cut edges all lie off the drawing by the same distance.

``offset`` is measured along the normal of the edge, out of the material: where it is positive, the
cut has left material on. Flexures are then thicker by twice the offset, the rim begins nearer to
the centre, and hollow corners are sharper. Derivation: docs/theory/tolerance.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from springcad.geometry.offset import sideways
from springcad.geometry.panels import panel_grid
from springcad.geometry.ribbon import ORDER, Ribbon
from springcad.geometry.transform import translate
from springcad.kinds.rotary_flexure.cam_slot import Slot
from springcad.kinds.rotary_flexure.root import flexure_on, mounting_of
from springcad.kinds.rotary_flexure.root_compliance import RootModel, root_model
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.mechanics.beam import PreparedBeam, follower_load

_PROBE = 1e-6
"""Tip force over the design's under which a flexure is linear."""


def thickened(ribbon: Ribbon, offset: float) -> Ribbon:
    """The ribbon with both edges moved by ``offset`` (m).

    Measured across the centre line an edge of slope λ' moves by offset·sqrt(1 + λ'^2); the root is
    left out: λ' is some per cent where a flexure bends.
    """
    return replace(ribbon, half_thickness=ribbon.half_thickness + offset)


def shortened(ribbon: Ribbon, length: float) -> Ribbon:
    """The ribbon without its first ``length`` (m); a negative one is grown on.

    The polynomials of the first panel go on there.
    """
    edges = np.append(0.0, ribbon.edges[1:] - length)
    points = ribbon.at(panel_grid(edges, ORDER).nodes + length)
    root = ribbon.at(np.array([length]))
    return Ribbon(edges, points.curvature, points.half_thickness, float(root.angle[0]))


def offset_root(spring: Spring, offset: float) -> RootModel:
    """What rim, root and fillets add to the thickened beam, still clamped at the root radius.

    Finite elements of the sector with all its edges moved. The flexure then leaves the rim
    ``offset`` nearer to the centre: the compliance is that which gives the beam clamped at the root
    radius of the design the tip compliance of these elements.

    Raises:
        ValueError: the moved root cannot be meshed: no fillet is left.
    """
    sized = spring.sized
    if offset == 0.0:
        return sized.root
    drawn, moved = _clamped_root(spring, 0.0), _clamped_root(spring, offset)
    change = moved.compliance - drawn.compliance
    factor = moved.fillet_stress_factor / drawn.fillet_stress_factor
    return RootModel(
        compliance=sized.root.compliance + change,
        fillet_stress_factor=sized.root.fillet_stress_factor * factor,
    )


def _clamped_root(spring: Spring, offset: float) -> RootModel:
    """By finite elements, for the thickened beam clamped at the root radius of the design."""
    spec, case, sized = spring.spec, spring.case, spring.sized
    whole = thickened(sized.found.ribbon, offset)
    free = shortened(whole, offset) if offset != 0.0 else whole
    sector = SectorGeometry(
        free,
        case.inputs.root_radius - offset,
        case.outer_radius + offset,
        case.inputs.count,
        sized.fillet - offset,
        sized.blend - offset,
    )
    beam = flexure_on(spec, case, free, 0.0)
    model = root_model(beam, sector, mounting_of(spec))
    probe = _PROBE * spring.law.force
    at_rim = _tip(beam, free.length, probe)
    at_root = _tip(flexure_on(spec, case, whole, 0.0), whole.length, probe)
    extra = at_rim.compliance - at_root.compliance + model.compliance * at_rim.lever**2
    return RootModel(
        compliance=extra / at_root.lever**2,
        fillet_stress_factor=model.fillet_stress_factor * at_rim.root_stress / at_root.root_stress,
    )


@dataclass(frozen=True)
class _Tip:
    """A clamped beam under a unit force across its tip: compliance, lever and stress of the root.

    [m/N], [m], [Pa/N].
    """

    compliance: float
    lever: float
    root_stress: float


def _tip(beam: PreparedBeam, station: float, force: float) -> _Tip:
    bent = follower_load(beam, station, 0.0, force)
    return _Tip(
        compliance=2.0 * float(bent.energy[0]) / force**2,
        lever=float(bent.root_moment[0]) / force,
        root_stress=float(bent.nominal_stress[0, 0]) / force,
    )


def moved_slot(slot: Slot, offset: float, outward: float) -> Slot:
    """The slot with its edges moved by ``offset``, then as a whole outward along its axis (m).

    Only the pieces move: the angle of rest and all else stays that of the slot as drawn.

    Raises:
        ValueError: more is taken off than the radius of an arc.
    """
    pieces = (translate(sideways(piece, offset), outward, 0.0) for piece in slot.pieces)
    return replace(slot, pieces=tuple(pieces))
