"""The flexure sized for its stiffness with its real root: rim, fillets and inclination.

The design law clamps the flexure at the root radius. Finite elements of the root say how far that
is from the truth (``root_compliance``), and the shape is searched again for a serpentine factor
that makes up for it, until the spring is just softer at rest than wanted; the camshaft, whose
contact lies a little outside the contact radius, makes up for the rest exactly.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from springcad.errors import InfeasibleError
from springcad.geometry.ribbon import Ribbon
from springcad.kinds.rotary_flexure.calibrated import root_coefficient
from springcad.kinds.rotary_flexure.feasibility import Case
from springcad.kinds.rotary_flexure.flexure_contact import flexure_beam
from springcad.kinds.rotary_flexure.law import DesignLaw
from springcad.kinds.rotary_flexure.ring import FILLET_STEP, largest_fillet
from springcad.kinds.rotary_flexure.root_compliance import (
    Mounting,
    RootModel,
    root_model,
    root_unit,
)
from springcad.kinds.rotary_flexure.search import Found, find_shape
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.mechanics.beam import PreparedBeam, contact_load
from springcad.result import Progress

SOFTER = 0.997
"""Stiffness at rest, over the wanted one, that the sizing aims at."""
CLOSE = 0.0025
"""It stops within this share of its aim."""
PASSES = 6
LARGEST_FILLET = 0.5
"""Largest fillet radius over root thickness: beyond it the stress hardly falls any more."""
BLEND_OVER_SMALLEST = 1.5
"""Radius between taper and pad, over the smallest inside radius of the process."""


@dataclass(frozen=True)
class Sized:
    """A flexure with its root.

    Attributes:
        found: its shape.
        fillet: root fillet radius, m.
        blend: radius between taper and pad, m.
        root: what the root adds to a clamped beam.
        beam: the flexure as a beam on the root's spring.
        correction: factor on the law's serpentine factor that the root has asked for.
        stiffness_at_rest: of the whole ring with contact at the contact radius, N m/rad.
    """

    found: Found
    fillet: float
    blend: float
    root: RootModel
    beam: PreparedBeam
    correction: float
    stiffness_at_rest: float


def size_flexure(spec: RotaryFlexureSpec, case: Case, law: DesignLaw, progress: Progress) -> Sized:
    """Shape, fillet and root of the flexures.

    Raises:
        InfeasibleError: no shape or no fillet fits, or the sizing does not settle.
    """
    wanted = law.inputs.stiffness
    correction, fillet = 1.0, None
    for number in range(1, PASSES + 1):
        progress(f"searching for the shape of the flexures, pass {number}")
        found = find_shape(spec, case, law, progress, correction)
        fillet = _root_fillet(spec, case, found.ribbon, fillet)
        sized = _with_root(spec, case, law, found, fillet, correction)
        if abs(sized.stiffness_at_rest / (SOFTER * wanted) - 1.0) <= CLOSE:
            return sized
        correction = round(correction * sized.stiffness_at_rest / (SOFTER * wanted), 6)
    raise InfeasibleError(
        "stiffness at rest that the sizing arrives at", sized.stiffness_at_rest, wanted, "N*m/rad"
    )


def _with_root(
    spec: RotaryFlexureSpec,
    case: Case,
    law: DesignLaw,
    found: Found,
    fillet: float,
    correction: float,
) -> Sized:
    root = _calibrated_root(spec, case, found.ribbon, fillet)
    beam = _beam(spec, case, found.ribbon, root.compliance)
    # So small that the beam is linear; the arm of a tangential force is the contact radius.
    probe = 1e-6 * law.force
    energy = float(contact_load(beam, found.ribbon.length, probe, 1.0).energy[0])
    compliance = 2.0 * energy / (probe * case.inputs.contact_radius) ** 2
    return Sized(
        found=found,
        fillet=fillet,
        blend=blend_radius(spec),
        root=root,
        beam=beam,
        correction=correction,
        stiffness_at_rest=case.inputs.count / compliance,
    )


def _root_fillet(
    spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, earlier: float | None
) -> float:
    """The fillet asked for, or the largest that leaves the root no stiffer than a clamp.

    A larger one would lower the stress in the fillet, but take bending out of the flexure, which
    must then be longer: it costs gap. ``earlier`` is the choice of the first pass, kept if it fits.

    Raises:
        InfeasibleError: neighbouring fillets run into each other.
    """
    asked = spec.flexures.root_fillet
    smallest = spec.process.rules.min_inside_radius
    root = 2.0 * float(ribbon.at(np.zeros(1)).half_thickness[0])
    balanced = math.floor(LARGEST_FILLET * root / FILLET_STEP) * FILLET_STEP
    wanted = max(balanced, smallest) if isinstance(asked, str) else asked
    inputs = case.inputs
    fits = largest_fillet(ribbon, inputs.root_radius, inputs.count, smallest, wanted)
    if not isinstance(asked, str):
        if fits < asked:
            remedy = f"lower flexures.root_fillet to {1e3 * fits:g} mm, or set it to auto"
            claim = "root fillet that fits between neighbours"
            raise InfeasibleError(claim, fits, asked, "m", (remedy,))
        return asked
    if earlier is not None:
        return min(earlier, fits)

    def stiffening(radius: float) -> float:
        return -_root_model(spec, case, ribbon, radius).compliance

    if stiffening(fits) <= 0.0:
        return fits
    if stiffening(smallest) >= 0.0:
        return smallest
    balanced = float(brentq(stiffening, smallest, fits, xtol=FILLET_STEP))
    return max(smallest, round(balanced / FILLET_STEP) * FILLET_STEP)


def _calibrated_root(
    spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, fillet: float
) -> RootModel:
    """The root with what a bench test has found beyond the finite elements."""
    root = _root_model(spec, case, ribbon, fillet)
    thickness = 2.0 * float(ribbon.at(np.zeros(1)).half_thickness[0])
    unit = root_unit(case.inputs.elastic_modulus, case.inputs.thickness, thickness)
    return replace(root, compliance=root.compliance + root_coefficient(spec) * unit)


def _root_model(spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, fillet: float) -> RootModel:
    sector = SectorGeometry(
        ribbon,
        case.inputs.root_radius,
        case.outer_radius,
        case.inputs.count,
        fillet,
        blend_radius(spec),
    )
    return root_model(_beam(spec, case, ribbon, 0.0), sector, mounting_of(spec))


def _beam(
    spec: RotaryFlexureSpec, case: Case, ribbon: Ribbon, root_compliance: float
) -> PreparedBeam:
    return flexure_beam(
        ribbon,
        thickness=case.inputs.thickness,
        elastic_modulus=case.inputs.elastic_modulus,
        poisson_ratio=spec.material.values.poisson_ratio.value,
        root_compliance=root_compliance,
    )


def mounting_of(spec: RotaryFlexureSpec) -> Mounting:
    """How the housing holds the rim."""
    return "bore" if spec.mounting.dowels is None else "dowels"


def blend_radius(spec: RotaryFlexureSpec) -> float:
    """Radius in the hollow corner between taper and pad, m."""
    return BLEND_OVER_SMALLEST * spec.process.rules.min_inside_radius
