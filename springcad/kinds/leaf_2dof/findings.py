"""What there is to say about finished leaves: results beside the paper's, assumptions, advice."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from springcad.kinds.leaf_2dof import paper_unit
from springcad.kinds.leaf_2dof.case import in_mm
from springcad.kinds.leaf_2dof.made import MadeLeaves
from springcad.kinds.leaf_2dof.unit import (
    SMOOTH_GUIDE,
    curvature_parameter,
    rest_stiffness,
    rest_stiffness_range,
)
from springcad.kinds.leaf_2dof.wrist import solid_angle, spherical_small
from springcad.materials.data import MATERIALS
from springcad.materials.ranking import rank_for_leaf
from springcad.result import Outcome


def outcomes(made: MadeLeaves) -> Iterator[Outcome]:
    """The results table."""
    setup, case, full = made.setup, made.case, made.full
    n, leaf, lever = setup.leaves, setup.leaf, setup.lever
    for words, length, wanted in (
        ("least", setup.longest, case.least_stiffness),
        ("greatest", setup.shortest, case.greatest_stiffness),
    ):
        paper = n * float(paper_unit.stiffness(leaf, lever, length, 0.0))
        yield Outcome(
            f"{words} stiffness at rest", n * float(rest_stiffness(leaf, lever, length)),
            "N*m/rad", wanted, f"length {in_mm(length)}; 003, Eq. 16: {paper:.4g}",
        )  # fmt: skip
    yield Outcome("deflection, each way", float(full.angle[-1]), "rad", case.deflection,
                  f"length {in_mm(setup.longest)}")  # fmt: skip
    paper_torque = n * float(paper_unit.torque(leaf, lever, setup.longest, full.angle[-1]))
    yield Outcome("torque there", n * float(full.torque[-1]), "N*m", None,
                  f"of one axis, {_leaves(n)}; 003, Eq. 14: {paper_torque:.4g}")  # fmt: skip
    yield Outcome("energy there", n * float(full.energy[-1]), "J", None, "of one axis")
    paper_stress = float(paper_unit.stress(leaf, lever, setup.longest, full.angle[-1]))
    yield Outcome("stress at the clamp there", float(full.stress[-1]), "Pa", case.design_stress,
                  f"no notch; 003, Eq. 10: {1e-6 * paper_stress:.4g} MPa")  # fmt: skip
    yield Outcome("safety factor there", case.yield_strength / float(full.stress[-1]), "1",
                  case.yield_strength / case.design_stress, "yield over stress")  # fmt: skip
    yield from _limit_outcomes(made)
    corner = made.rods[-1]
    paper_tilt = float(spherical_small(*corner.angle).tilt)
    yield Outcome("tilt of the rod, both axes turned", corner.tilt, "rad", None,
                  f"003, Eq. 18: {_degrees(paper_tilt)}")  # fmt: skip
    yield Outcome("solid angle of the workspace", solid_angle(*corner.angle), "1", None, "sr")
    yield Outcome("stiffness of the rod there, more tilt", float(corner.rod_stiffness[0, 0]),
                  "N*m/rad", None, "longest length")  # fmt: skip
    yield Outcome("stiffness of the rod there, sideways", float(corner.rod_stiffness[1, 1]),
                  "N*m/rad", None, "longest length, with the geometric term")  # fmt: skip
    yield Outcome("mass of a leaf", made.mass, "kg", None, f"{4 * n} leaves in all")


def _limit_outcomes(made: MadeLeaves) -> Iterator[Outcome]:
    """What is allowed at both ends of the range of lengths, and what yield would allow at most."""
    n, reach, limit = made.setup.leaves, made.reach, made.case.max_bend_angle
    if math.isfinite(limit):
        by_paper = paper_unit.deflection_at_bend(made.setup.lever, made.setup.longest, limit)
        yield Outcome(
            "deflection at the bend angle allowed, longest length", float(reach.by_bend[-1]),
            "rad", None, f"003, Eq. 8: {_degrees(float(by_paper))}",
        )  # fmt: skip
    for words, index in (("longest", -1), ("shortest", 0)):
        yield Outcome(
            f"largest deflection allowed, {words} length", float(reach.unit.angle[index]), "rad",
            None, f"{reach.binding[index]} ends it, at {n * reach.unit.torque[index]:.4g} N*m and "
            f"{n * reach.unit.energy[index]:.4g} J",
        )  # fmt: skip
    strongest = int(np.argmax(made.yield_reach.unit.torque))
    yield Outcome(
        "largest torque within yield, any length",
        n * float(made.yield_reach.unit.torque[strongest]), "N*m", None,
        f"of one axis, at {in_mm(made.lengths[strongest])}",
    )  # fmt: skip
    richest = int(np.argmax(made.yield_reach.unit.energy))
    yield Outcome(
        "largest energy within yield, any length",
        n * float(made.yield_reach.unit.energy[richest]), "J", None,
        f"of one axis, at {in_mm(made.lengths[richest])}",
    )  # fmt: skip


def assumptions(made: MadeLeaves) -> Iterator[str]:
    """What was taken for granted, and what was not checked."""
    setup = made.setup
    n, leaf = setup.leaves, setup.leaf
    yield (
        f"About each axis {_leaves(n)} bear{'s' * (n == 1)} in either direction: each roller lies "
        "between two leaves, which it touches at rest without play or preload, so a wrist needs "
        f"{4 * n}. Both directions are alike."
    )
    yield (
        "The leaf is a beam with large deflections, stretch and shear, clamped at the face of the "
        "guide; guide, lever and roller are rigid. The roller turns freely, so its force is normal "
        "to the leaf: there is no friction and no hysteresis. What the lever's pivot, the coupling "
        "and the gear give way is not counted."
    )
    plate = 1.0 / (1.0 - leaf.poisson_ratio**2) - 1.0
    searle = float(curvature_parameter(leaf, made.full.stress[-1]))
    yield (
        f"The leaf bends as a beam with E; a wide one is stiffer by up to {plate:.1%}. "
        f"Searle's a^2/(b rho) is {searle:.2g} at the largest deflection (below 1 a beam, far "
        "above 10 a plate)."
    )
    yield (
        "Held between smooth faces without play, on which it can slide, a leaf acts "
        f"{SMOOTH_GUIDE:g} times its thickness longer. From that to a plate the stiffness at rest "
        f"may be {_range(made, setup.shortest)}, and {_range(made, setup.longest)}: measure it."
    )
    yield (
        "The stress is that of the beam at the guide's face: its edges are rounded, so that they "
        "neither notch nor fret the leaf. Wear and edge quality are not checked."
    )
    yield (
        "The guide is as high as the roller; lever, pivot and coupling have room beside the leaf; "
        "the axes of the wrist cross at right angles and are without play."
    )
    if setup.lever.clamp == "inboard":
        yield "Held inboard, the guide lies over the lever, which must run beside it."


def advice(made: MadeLeaves) -> Iterator[str]:
    """What a fixed stop or bend angle would do to short leaves, and another material to all."""
    setup, case, n = made.setup, made.case, made.setup.leaves
    at = setup.leaf, setup.lever, setup.shortest
    allowed, wanted = float(made.reach.unit.angle[0]), case.deflection
    if allowed < wanted:
        stress = float(paper_unit.stress(*at, wanted))
        yield (
            f"At {in_mm(setup.shortest)} only {math.degrees(allowed):.3g} deg are allowed. The "
            f"{_degrees(wanted)} of the longest length would take "
            f"{n * float(paper_unit.torque(*at, wanted)):.3g} N*m and "
            f"{n * float(paper_unit.energy(*at, wanted)):.3g} J by paper 003, Eq. 14, at "
            f"{stress / 1e6:.4g} MPa, {stress / case.yield_strength:.3g} times the yield strength: "
            "a stop must move with the guide."
        )
    limit = case.max_bend_angle
    if math.isfinite(limit):
        least = float(paper_unit.least_length(setup.leaf, limit, case.yield_strength))
        which = "longer leaves only" if least > setup.shortest else "every length of this leaf"
        yield (
            f"A bend angle of {_degrees(limit)} reaches the yield strength at "
            f"{in_mm(least)} (003, Eq. 12): it protects {which}."
        )
    if made.spec.material.life is None:
        yield from _better_material(made)


def _better_material(made: MadeLeaves) -> Iterator[str]:
    """The best of the same family by sigma^3/E^2, with the same width, lengths and stiffness.

    E b^3 is then given, so at a deflection the stress is as E b, or E^(2/3).
    """
    own = made.spec.material.values
    family = [entry for entry in MATERIALS.values() if entry.family == own.family]
    best = rank_for_leaf(family).ranked[0]
    stiffer = best.modulus / own.elastic_modulus.value
    thickness = made.setup.leaf.thickness / stiffer ** (1.0 / 3.0)
    stress = float(made.full.stress[-1])
    factor = best.stress / (stress * stiffer ** (2.0 / 3.0))
    if factor > made.case.yield_strength / stress:
        yield (
            f"With the same width, lengths and stiffness a leaf of {best.material.name}, "
            f"{in_mm(thickness)} thick, would have a safety factor of {factor:.3g} against yield "
            "at the same deflection. `springcad materials rank --for leaf` has other materials and "
            "their sources."
        )


def _leaves(count: int) -> str:
    return "1 leaf" if count == 1 else f"{count} leaves"


def _range(made: MadeLeaves, length: float) -> str:
    """Least and greatest stiffness at rest of real leaves of one axis."""
    ends = rest_stiffness_range(made.setup.leaf, made.setup.lever, length)
    least, greatest = (made.setup.leaves * float(end) for end in ends)
    return f"{least:.4g} to {greatest:.4g} N*m/rad at {in_mm(length)}"


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.4g} deg"
