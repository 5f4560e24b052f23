"""The second opinion on a rotary flexure spring: contact finite elements against the report."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.judging import OUTLINE_TOLERANCE, distance_from, snapped
from springcad.kinds.rotary_flexure.sector_contact import (
    WAYS,
    SectorContact,
    Turn,
    fillet_stress,
    neighbour_gap,
    sector_contacts,
    side_stress,
    torque,
    turn_through,
)
from springcad.kinds.rotary_flexure.sector_pressure import contact_pressure
from springcad.kinds.rotary_flexure.uncalibrated import ROOT_ASSUMPTION, without_calibrated_root
from springcad.kinds.rotary_flexure.written_spring import Reported, plain_stations, written_spring
from springcad.result import Check, Comparison, Judgement, Progress, check
from springcad.written import WrittenDesign

Floats = NDArray[np.float64]

SHARES = (0.1, 0.25, 0.5, 0.75, 1.0)
"""Angles at which the models are compared, over the design deflection. That of the largest contact
pressure takes the place of the nearest if that is neither the first nor the last."""
TORQUE_TOLERANCE = 0.01
STRESS_TOLERANCE = 0.05
"""The curved-beam factor is within 2 % of finite elements, their own stress within 1 %."""
GAP_TOLERANCE = 1.5e-4
"""Over the outer radius: 5 um for a ring of 33 mm, less than a cut resolves; for small rings what a
drawing may lie beside its design."""
PRESSURE_TOLERANCE = 0.15
"""The largest is within 4 %, others within 1 % but where the end of the strip just meets the round
nose: there a sliver of it decides, and a micrometre of the place of contact."""
_FREE_EDGES = ("fillet_right", "flank_right", "nose", "flank_left", "fillet_left")

METHOD = "contact finite elements of one sector of the ring"
ASSUMPTIONS = (
    "The second opinion is by nonlinear plane-stress finite elements of one sector of the ring "
    "(flexure, fillets, nose, rim, cyclic symmetry), pushed without friction by the flank of the "
    "camshaft as drawn; the camshaft is rigid in it, but for the contact pressure.",
    "The second opinion shares with the design: elastic modulus, linear elasticity, a sheet in "
    "plane stress, the way the rim is held, no tolerances.",
)


Judged = Callable[[SectorContact, Turn], float]
"""A number that the finite elements give at one turn."""
Designed = Callable[[float], float]
"""The same number by the design's model, at a signed angle (rad)."""


@dataclass(frozen=True)
class _Stroke:
    """One direction: its model, and the turns that it reached of the angles that were asked."""

    sector: SectorContact
    asked: Sequence[float]
    turns: Sequence[Turn]


def judge_spring(written: WrittenDesign, progress: Progress) -> Judgement:
    """Compare torque, stresses, gap and contact pressure over the stroke, both directions.

    Raises:
        IncompleteDesignError: the report or a drawing lacks what the model needs.
    """
    rooted = written.design.get("calibrated_root_coefficient", 0.0) != 0.0
    written = without_calibrated_root(written) if rooted else written
    assumptions = (*ASSUMPTIONS, *([ROOT_ASSUMPTION] if rooted else []))
    spring = written_spring(written)
    reported = Reported(written, spring)
    try:
        sectors = sector_contacts(spring)
    except ValueError as error:
        return Judgement(METHOD, (), (_no_mesh(str(error)),), assumptions, {})
    strokes = []
    for sector in sectors:
        progress(f"second opinion: contact finite elements, {WAYS[sector.direction]}")
        asked = _angles(reported, sector.direction, pressed=not rooted)
        strokes.append(_Stroke(sector, asked, turn_through(sector, asked)))
    mesh = sectors[0].mesh
    return Judgement(
        method=METHOD,
        comparisons=tuple(_comparisons(reported, strokes, pressed=not rooted)),
        checks=(_mesh_lies_on_drawing(strokes[0].sector), *map(_reaches_the_end, strokes)),
        assumptions=assumptions,
        figures={"elements": len(mesh.elements), "unknowns": mesh.unknowns},
    )


def _angles(reported: Reported, direction: int, *, pressed: bool) -> list[float]:
    """Magnitudes at which to compare; very near rest the report has none."""
    deflection = reported.spring.deflection
    angles = [share * deflection for share in SHARES]
    if pressed:
        hardest = reported.hardest_pressed(direction)
        nearest = min(angles, key=lambda angle: abs(angle - hardest))
        if nearest in angles[1:-1]:
            angles.remove(nearest)
        angles = sorted({*angles, hardest})
    first = reported.first_angle(direction)
    return [angle for angle in angles if angle >= first]


def _comparisons(
    reported: Reported, strokes: Sequence[_Stroke], *, pressed: bool
) -> Iterator[Comparison]:
    """Comparisons of all that is judged, with ``pressed`` of the contact pressure too."""
    every = [(stroke.sector, turn) for stroke in strokes for turn in stroke.turns]
    gap_tolerance = max(GAP_TOLERANCE * reported.spring.sector.outer_radius, OUTLINE_TOLERANCE)
    last = [(stroke.sector, stroke.turns[-1]) for stroke in strokes if stroke.turns]

    def compared(
        name: str,
        unit: str,
        turns: Sequence[tuple[SectorContact, Turn]],
        designed: Designed,
        judged: Judged,
        tolerance: float,
        source: str,
        *,
        relative: bool = True,
    ) -> Comparison:
        places = np.array([sector.direction * turn.angle for sector, turn in turns])
        return Comparison(
            name=name,
            unit=unit,
            place="angle",
            place_unit="rad",
            places=places,
            designed=np.array([snapped(designed(float(angle))) for angle in places]),
            judged=np.array([snapped(judged(sector, turn)) for sector, turn in turns]),
            tolerance=tolerance,
            relative=relative,
            source=source,
        )

    if not last:
        return
    yield compared(
        "torque over the stroke", "N*m", every, reported.torque, torque, TORQUE_TOLERANCE,
        "beam on a root spring, seated on the flank; finite elements",
    )  # fmt: skip
    first_plain, last_plain = plain_stations(reported.spring.sector)
    if first_plain < last_plain:
        yield compared(
            "stress along a flexure", "Pa", last, reported.side_stress, side_stress,
            STRESS_TOLERANCE, "curved beam; finite elements; largest away from root and tip",
        )  # fmt: skip
    yield compared(
        "stress in the root fillets", "Pa", last, reported.fillet_stress, fillet_stress,
        STRESS_TOLERANCE, "factor of the root on the beam's stress; finite elements",
    )  # fmt: skip
    yield compared(
        "gap between deformed flexures", "m", every, reported.gap, neighbour_gap, gap_tolerance,
        "outlines bent with the beam; outlines of the finite elements", relative=False,
    )  # fmt: skip
    if pressed:
        yield compared(
            "contact pressure", "Pa", every, reported.contact_pressure, contact_pressure,
            PRESSURE_TOLERANCE,
            "strip of half-planes at the beam's place of contact; block of elements at theirs",
        )  # fmt: skip


def _no_mesh(reason: str) -> Check:
    return check(
        "second opinion: meshes of a sector",
        0.0,
        ">=",
        1.0,
        "1",
        source=reason,
        remedy="nobody has judged this part; change flexures.root_fillet or flexures.count",
    )


def _mesh_lies_on_drawing(sector: SectorContact) -> Check:
    """That the part which is judged is the one that is drawn."""
    mesh = sector.mesh
    nodes = np.unique(np.concatenate([mesh.node_sets[name] for name in _FREE_EDGES]))
    return check(
        "second opinion: its mesh against the ring as drawn",
        snapped(distance_from(sector.spring.ring, mesh.nodes[nodes])),
        "<=",
        OUTLINE_TOLERANCE,
        "m",
        source="largest distance of the mesh's free edge from the contour of the drawing",
        remedy="the drawing is not of the flexures in the report: design the spring again",
    )


def _reaches_the_end(stroke: _Stroke) -> Check:
    return check(
        f"second opinion: angle reached {WAYS[stroke.sector.direction]}",
        stroke.turns[-1].angle if stroke.turns else 0.0,
        ">=",
        stroke.asked[-1],
        "rad",
        source="contact finite elements, last equilibrium found",
        remedy="the finite elements find no equilibrium beyond; flexures may touch or snap there",
    )
