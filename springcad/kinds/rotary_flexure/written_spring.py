"""A rotary flexure spring rebuilt from its report and drawings, without solving anything again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.polyline import BulgePolyline, signed_area, turned_round
from springcad.geometry.ribbon import ORDER, Ribbon
from springcad.kinds.rotary_flexure.clearance import deformed_gaps
from springcad.kinds.rotary_flexure.flexure_contact import flexure_beam
from springcad.kinds.rotary_flexure.ring import root_fillet
from springcad.kinds.rotary_flexure.root_compliance import Mounting
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry
from springcad.mechanics.beam import BeamStates, PreparedBeam, contact_load
from springcad.mechanics.fem.assembly import Sheet
from springcad.written import IncompleteDesignError, WrittenDesign

Floats = NDArray[np.float64]

_MOUNTINGS: dict[str, Mounting] = {"bore": "bore", "dowels": "dowels"}


@dataclass(frozen=True)
class WrittenSpring:
    """What a judge needs to know of a finished spring, SI.

    Attributes:
        sector: one flexure of the ring with its piece of rim.
        sheet: of the ring and of the camshaft.
        mounting: of the rim.
        beam: the flexure as the design sees it.
        deflection: the largest angle, each way.
        free_play: angle by which the camshaft turns before it touches.
        ring, camshaft: the contours that matter, as drawn.
    """

    sector: SectorGeometry
    sheet: Sheet
    mounting: Mounting
    beam: PreparedBeam
    deflection: float
    free_play: float
    ring: BulgePolyline
    camshaft: BulgePolyline

    @property
    def tip_half_thickness(self) -> float:
        """Of the pad (m)."""
        ribbon = self.sector.ribbon
        return float(ribbon.at(ribbon.edges[-1:]).half_thickness[0])


def written_spring(written: WrittenDesign) -> WrittenSpring:
    """Raises IncompleteDesignError where a number or a contour is missing."""
    ribbon = _ribbon(written)
    sheet = Sheet(
        written.number("design.elastic_modulus_Pa"),
        written.number("design.poisson_ratio"),
        written.number("design.thickness_m"),
    )
    mounting = written.text("design.mounting")
    if mounting not in _MOUNTINGS:
        raise IncompleteDesignError(f"design.mounting {mounting!r} is not known")
    return WrittenSpring(
        sector=SectorGeometry(
            ribbon=ribbon,
            root_radius=written.number("design.root_radius_m"),
            outer_radius=written.number("design.outer_radius_m"),
            count=int(written.number("design.flexure_count")),
            fillet=written.number("design.root_fillet_radius_m"),
            blend=written.number("design.blend_radius_m"),
        ),
        sheet=sheet,
        mounting=_MOUNTINGS[mounting],
        beam=flexure_beam(
            ribbon,
            thickness=sheet.thickness,
            elastic_modulus=sheet.elastic_modulus,
            poisson_ratio=sheet.poisson_ratio,
            root_compliance=written.number("design.root_compliance_rad_per_Nm"),
        ),
        deflection=float(np.max(written.array("response.angle_rad"))),
        free_play=written.number("design.camshaft.free_play_rad"),
        ring=_contour(written, "", largest=False),
        camshaft=_contour(written, "camshaft", largest=True),
    )


def _ribbon(written: WrittenDesign) -> Ribbon:
    edges, curvature, half_thickness = (
        written.array(f"design.flexure.{key}")
        for key in ("panel_edges_m", "curvature_per_m", "half_thickness_m")
    )
    nodes = ORDER * (len(edges) - 1)
    if np.any(np.diff(edges) <= 0.0) or {len(curvature), len(half_thickness)} != {nodes}:
        raise IncompleteDesignError("the arrays of design.flexure do not fit together")
    return Ribbon(edges, curvature, half_thickness, written.number("design.flexure.root_angle_rad"))


def _contour(written: WrittenDesign, part: str, *, largest: bool) -> BulgePolyline:
    """The outer contour of a part, or the largest inside it, counter-clockwise."""
    contours = sorted(written.contours.get(part, ()), key=lambda line: -abs(signed_area(line)))
    index = 0 if largest else 1
    if len(contours) <= index:
        raise IncompleteDesignError(f"the drawing of the {part or 'ring'} lacks a contour")
    contour = contours[index]
    return contour if signed_area(contour) > 0.0 else turned_round(contour)


@dataclass(frozen=True)
class Reported:
    """What the report says of a spring at one angle (rad, counter-clockwise positive), SI.

    The beam is bent again where the report holds less than is asked for: with the contact force
    and at the station that it gives.
    """

    written: WrittenDesign
    spring: WrittenSpring

    def first_angle(self, direction: int) -> float:
        """The smallest that the report has in a direction, a magnitude; the deflection if none."""
        angles = direction * self.written.array("response.angle_rad")
        return float(np.min(angles[angles > 0.0], initial=self.spring.deflection))

    def hardest_pressed(self, direction: int) -> float:
        """Angle of the largest contact pressure in a direction, a magnitude."""
        angles, pressure = self._over_angle("contact_pressure_Pa")
        turned = direction * angles > 0.0
        if not np.any(turned):
            return self.spring.deflection
        return float(np.abs(angles[turned][np.argmax(pressure[turned])]))

    def torque(self, angle: float) -> float:
        """Magnitude."""
        return abs(self._at("torque_Nm", angle))

    def contact_pressure(self, angle: float) -> float:
        """Largest on the strip of contact."""
        return self._at("contact_pressure_Pa", angle)

    def gap(self, angle: float) -> float:
        """Between deformed neighbours."""
        sector = self.spring.sector
        return float(
            deformed_gaps(
                sector.ribbon, self.spring.beam, self._bent(angle), sector.root_radius, sector.count
            )[0]
        )

    def side_stress(self, angle: float) -> float:
        """Largest inner-fibre stress between the ``plain_stations``."""
        states = self._bent(angle)
        first, last = plain_stations(self.spring.sector)
        inside = (states.stations[0] >= first) & (states.stations[0] <= last)
        return float(np.max(states.local_stress[0, inside], initial=0.0))

    def fillet_stress(self, angle: float) -> float:
        """Nominal stress at the root times the factor of the fillets."""
        factor = self.written.number("design.root_fillet_stress_factor")
        return factor * float(self._bent(angle).nominal_stress[0, 0])

    def _at(self, key: str, angle: float) -> float:
        return float(np.interp(angle, *self._over_angle(key)))

    def _over_angle(self, key: str) -> tuple[Floats, Floats]:
        angles, values = (self.written.array(f"response.{name}") for name in ("angle_rad", key))
        if len(angles) != len(values):
            raise IncompleteDesignError(f"response.{key} and response.angle_rad differ in length")
        return angles, values

    def _bent(self, angle: float) -> BeamStates:
        station, force = (self._at(key, angle) for key in ("contact_station_m", "contact_force_N"))
        return contact_load(self.spring.beam, station, force, np.sign(angle))


def plain_stations(sector: SectorGeometry) -> tuple[float, float]:
    """Stations between which a flexure is free of what fillets and contact do to it.

    One root thickness from where the later fillet ends, two tip thicknesses from where the straight
    pad begins (Saint-Venant).
    """
    ribbon = sector.ribbon
    ends = (
        root_fillet(ribbon, sector.root_radius, sector.fillet, side).station for side in (1, -1)
    )
    tip = 2.0 * float(ribbon.at(ribbon.edges[-1:]).half_thickness[0])
    return max(ends) + sector.root_thickness, float(ribbon.edges[-2]) - 2.0 * tip
