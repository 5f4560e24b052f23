"""Torque of a written spring on a test bench, in microseconds for any modulus, root and friction.

The flexures as beams are seated on the flank of the camshaft's drawing, with friction, once for
some root compliances and coefficients of friction; between these the secant compliance (angle over
torque) is interpolated. The elastic modulus needs no table: of a ring and a camshaft of given
shape, with every compliance in proportion to 1/E, all torques are in proportion to E, at any
deflection and with dry friction (docs/theory/calibration.md).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial.polynomial import polyvander
from numpy.typing import NDArray

from springcad.kinds.rotary_flexure.drawn_flank import drawn_flank
from springcad.kinds.rotary_flexure.flexure_contact import NOSE_ALLOWANCE, flexure_part
from springcad.kinds.rotary_flexure.root_compliance import root_unit
from springcad.kinds.rotary_flexure.written_spring import WrittenSpring
from springcad.mechanics.beam import PreparedBeam, prepare
from springcad.mechanics.cam_contact import Seat, seat
from springcad.written import IncompleteDesignError, WrittenDesign

Floats = NDArray[np.float64]

ANGLES = 24
"""Angles up to the design deflection at which the spring is seated."""
ROOTS = np.array([0.0, 8.0, 24.0])
"""Coefficients of extra root compliance in the table."""
FRICTIONS = np.array([-0.4, -0.2, 0.0, 0.2, 0.4])
"""Coefficients of friction in the table; negative where the camshaft drags a tip outwards."""
LEAST_FRICTIONS = 3
FEWEST = 8
"""Angles that each direction must have."""


@dataclass(frozen=True)
class Bench:
    """What a bench may find other than the design says.

    Attributes:
        modulus: elastic modulus over that of the design.
        root: extra rotation of a flexure's root, over M/(E t h²) with the moment M, the thickness
            t of the sheet and h of the root in the plane.
        friction: coefficient between tips and camshaft.
        angle, torque: that the bench shows at rest (rad, N m).
    """

    modulus: float = 1.0
    root: float = 0.0
    friction: float = 0.0
    angle: float = 0.0
    torque: float = 0.0


@dataclass(frozen=True)
class Way:
    """The spring turned in one direction.

    Attributes:
        angle: magnitudes from contact (A,) [rad].
        compliance: coefficients of the secant compliance as a polynomial of root and friction
            (R, F, A).
        loading: +1 where a positive coefficient gives the loading torque, else -1 (A,).
    """

    angle: Floats
    compliance: Floats
    loading: Floats

    def stiffness(self, bench: Bench, travel: int) -> Floats:
        """Secant stiffness (A,), travel +1 while the angle grows, with the design's modulus."""
        roots = bench.root ** np.arange(len(ROOTS))
        signed = travel * bench.friction * self.loading
        powers = signed ** np.arange(len(FRICTIONS))[:, None]
        return np.asarray(1.0 / np.einsum("r,fa,rfa->a", roots, powers, self.compliance))


@dataclass(frozen=True)
class BenchModel:
    """The table of both directions; made by ``bench_model``.

    Attributes:
        ways: counter-clockwise, clockwise.
        free_play: angle each way by which a camshaft turns before it touches (rad).
        reach: largest angle of the whole joint in the table, free play included (rad).
        peak_torque: of the whole joint at the design deflection (N m).
        elastic_modulus: of the design (Pa).
        parallel, series: sheets on a camshaft, and springs, of the joint on the bench.
    """

    ways: tuple[Way, Way]
    free_play: float
    reach: float
    peak_torque: float
    elastic_modulus: float
    parallel: int
    series: int

    def torque(self, bench: Bench, angle: Floats, travel: NDArray[np.intp]) -> Floats:
        """What the bench shows (N,) at angles (N,) while they grow (``travel`` +1) or fall (-1).

        Beyond ``reach`` the last secant stiffness is taken, below the first angle the first.
        """
        turned = angle - bench.angle
        load = np.maximum(np.abs(turned) / self.series - self.free_play, 0.0)
        found = np.zeros_like(load)
        for direction, way in zip((1, -1), self.ways, strict=True):
            for onward in (1, -1):
                here = (np.sign(turned) == direction) & (travel * direction == onward)
                secant = np.interp(load[here], way.angle, way.stiffness(bench, onward))
                found[here] = self.parallel * direction * load[here] * secant
        return np.asarray(bench.modulus * found + bench.torque)


def extra_root(spring: WrittenSpring, root: float) -> float:
    """Root compliance of the coefficient ``root`` (rad/(N m))."""
    sheet = spring.sheet
    return root * root_unit(sheet.elastic_modulus, sheet.thickness, spring.sector.root_thickness)


def _softened(spring: WrittenSpring, root: float) -> PreparedBeam:
    """A flexure with extra root compliance."""
    beam = spring.beam.beam
    compliance = beam.root_compliance + extra_root(spring, root)
    return prepare(replace(beam, root_compliance=compliance))


def seated_as_drawn(
    written: WrittenDesign,
    spring: WrittenSpring,
    direction: int,
    angle: Floats,
    *,
    root: float = 0.0,
    friction: float = 0.0,
    near: Seat | None = None,
) -> Seat:
    """The ring on the flank as drawn, at magnitudes from contact (A,) [rad], as far as it touches.

    Args:
        root: coefficient of extra root compliance.
        friction: tangential over normal force on the tips, positive inwards.
        near: the ring with a root and a friction not far from these; else the report's.
    """
    if near is None:
        reported = direction * written.array("response.angle_rad")
        order = np.argsort(reported)[np.sum(reported <= 0.0) :]
        known = (
            reported,
            *map(written.array, ("response.contact_force_N", "response.contact_station_m")),
        )
        known_angle, known_force, known_station = (values[order] for values in known)
    else:
        known_angle, known_force, known_station = near.angle, near.force, near.station
    ribbon = spring.sector.ribbon
    found = seat(
        flexure_part(_softened(spring, root), spring.sector.root_radius, direction, friction),
        drawn_flank(spring.camshaft, direction).points,
        angle + spring.free_play,
        count=spring.sector.count,
        force=np.interp(angle, known_angle, known_force),
        station=np.interp(angle, known_angle, known_station),
        station_limits=(
            float(ribbon.edges[-2]),
            ribbon.length + NOSE_ALLOWANCE * spring.tip_half_thickness,
        ),
    )
    return replace(found, angle=found.angle - spring.free_play)


def stack_counts(written: WrittenDesign) -> tuple[int, int]:
    """Sheets in parallel and springs in series of the joint; 1 and 1 where nothing is stacked."""
    if "stack" not in written.design:
        return 1, 1
    parallel, series = (written.number(f"design.stack.{key}") for key in ("parallel", "series"))
    return int(parallel), int(series)


def bench_model(written: WrittenDesign, spring: WrittenSpring) -> BenchModel:
    """The table of a written spring, for the whole joint that it is a part of.

    Raises:
        IncompleteDesignError: the flexures do not rest on the camshaft as drawn.
    """
    ways = tuple(_way(written, spring, direction) for direction in (1, -1))
    parallel, series = stack_counts(written)
    return BenchModel(
        ways=(ways[0], ways[1]),
        free_play=spring.free_play,
        reach=series * (min(float(way.angle[-1]) for way in ways) + spring.free_play),
        peak_torque=parallel * float(np.max(np.abs(written.array("response.torque_Nm")))),
        elastic_modulus=spring.sheet.elastic_modulus,
        parallel=parallel,
        series=series,
    )


def _way(written: WrittenDesign, spring: WrittenSpring, direction: int) -> Way:
    angle = spring.deflection * np.arange(1, ANGLES + 1) / ANGLES
    compliance = np.full((len(ROOTS), len(FRICTIONS), ANGLES), np.nan)
    near = None
    for row, root in enumerate(ROOTS):
        near = seated_as_drawn(written, spring, direction, angle, root=root, near=near)
        for column, friction in enumerate(FRICTIONS):
            found = near
            if friction != 0.0:
                found = seated_as_drawn(
                    written, spring, direction, angle, root=root, friction=friction, near=near
                )
            # Near rest, with friction, a tip may touch with its nose.
            at = np.rint(found.angle / angle[0]).astype(np.intp) - 1
            compliance[row, column, at] = found.angle / found.torque
    fitted = [_polynomial(compliance[..., index]) for index in range(ANGLES)]
    known = [index for index, found in enumerate(fitted) if found is not None]
    if len(known) < FEWEST:
        raise IncompleteDesignError("the flexures do not rest on the camshaft as drawn")
    coefficients = np.stack([found for found in fitted if found is not None], axis=-1)
    # Without extra root compliance, the change of the secant compliance with friction.
    return Way(angle[known], coefficients, -np.sign(coefficients[0, 1]))


def _polynomial(compliance: Floats) -> Floats | None:
    """Coefficients (R, F) through the values (R, F) that are numbers; None if they are too few.

    Where a coefficient of friction is missing, the polynomial of the others is of lower degree: as
    if the pad of the tip went on.
    """
    there = np.isfinite(compliance).all(axis=0)
    if there.sum() < LEAST_FRICTIONS:
        return None
    roots = np.linalg.inv(polyvander(ROOTS, len(ROOTS) - 1))
    frictions = np.linalg.inv(polyvander(FRICTIONS[there], int(there.sum()) - 1))
    found = np.zeros_like(compliance)
    found[:, : there.sum()] = roots @ compliance[:, there] @ frictions.T
    return found
