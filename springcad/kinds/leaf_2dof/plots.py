"""Curves of the report: strokes, limits over the effective length, and the workspace."""

from __future__ import annotations

import math

import numpy as np

from springcad.kinds.leaf_2dof import paper_unit
from springcad.kinds.leaf_2dof.case import in_mm
from springcad.kinds.leaf_2dof.made import MadeLeaves, at_length
from springcad.kinds.leaf_2dof.unit import rest_stiffness
from springcad.result import Plot, Series


def leaf_plots(made: MadeLeaves) -> tuple[Plot, ...]:
    """Torque, stiffness, limits, stress, workspace."""
    return (
        _torque(made),
        _stiffness(made),
        *_limits(made),
        _stress(made),
        _workspace(made),
        _rod_stiffness(made),
    )


def _torque(made: MadeLeaves) -> Plot:
    """Curves of one length have one colour: there are as many lengths as colours."""
    n, leaf, lever = made.setup.leaves, made.setup.leaf, made.setup.lever
    strokes = [at_length(made.strokes, index) for index in range(len(made.strokes.length))]
    words = [in_mm(float(s.length[0])) for s in strokes]
    exact = [Series(label, s.angle, n * s.torque) for label, s in zip(words, strokes, strict=True)]
    paper = [
        Series(f"{label}, Eq. 14", s.angle,
               n * paper_unit.torque(leaf, lever, s.length, s.angle), dashed=True)
        for label, s in zip(words, strokes, strict=True)
    ]  # fmt: skip
    title = "Torque of one axis at effective lengths, up to what is allowed"
    return Plot(title, "angle", "rad", "torque", "N*m", (*exact, *paper))


def _stiffness(made: MadeLeaves) -> Plot:
    n, leaf, lever, at = made.setup.leaves, made.setup.leaf, made.setup.lever, made.lengths
    paper = n * paper_unit.stiffness(leaf, lever, at, 0.0)
    return Plot(
        "Stiffness of one axis", "effective length", "m", "stiffness", "N*m/rad",
        (Series("at rest", at, n * rest_stiffness(leaf, lever, at)),
         Series("at the largest deflection allowed", at, n * made.reach.unit.stiffness),
         Series("at rest, 003, Eq. 16", at, paper, dashed=True)),
    )  # fmt: skip


def _limits(made: MadeLeaves) -> tuple[Plot, ...]:
    n, at, reach, at_yield = made.setup.leaves, made.lengths, made.reach, made.yield_reach
    leaf, lever, limit = made.setup.leaf, made.setup.lever, made.case.max_bend_angle
    linear = paper_unit.deflection_at_stress(leaf, lever, at, made.case.design_stress)
    deflection = [
        Series("allowed", at, reach.unit.angle),
        Series("at yield", at, at_yield.unit.angle),
        Series("at the design stress, 003, Eqs 6 and 10", at, linear, dashed=True),
    ]
    if math.isfinite(limit):
        bent = paper_unit.deflection_at_bend(lever, at, limit)
        deflection.append(Series("at the bend angle, 003, Eq. 8", at, bent, dashed=True))
    return (
        Plot("Largest deflection", "effective length", "m", "deflection", "rad",
             tuple(deflection)),
        Plot("Largest torque of one axis", "effective length", "m", "torque", "N*m",
             (Series("allowed", at, n * reach.unit.torque),
              Series("at yield", at, n * at_yield.unit.torque))),
        Plot("Largest energy of one axis", "effective length", "m", "energy", "J",
             (Series("allowed", at, n * reach.unit.energy),
              Series("at yield", at, n * at_yield.unit.energy))),
    )  # fmt: skip


def _stress(made: MadeLeaves) -> Plot:
    full, leaf, lever = made.full, made.setup.leaf, made.setup.lever
    paper = paper_unit.stress(leaf, lever, full.length, full.angle)
    return Plot(
        "Stress at the clamp, longest length", "angle", "rad", "stress", "Pa",
        (Series("exact", full.angle, full.stress),
         Series("003, Eq. 10", full.angle, paper, dashed=True)),
        limit=made.case.design_stress,
    )  # fmt: skip


def _workspace(made: MadeLeaves) -> Plot:
    tip = np.asarray(made.boundary)
    return Plot("Reach of the rod's tip at the longest length", "x", "m", "y", "m",
                (Series("edge", tip[:, 0], tip[:, 1]),))  # fmt: skip


def _rod_stiffness(made: MadeLeaves) -> Plot:
    angle, rod = made.full.angle, made.diagonal
    return Plot(
        "Stiffness of the rod, both axes turned alike, longest length", "angle of each axis",
        "rad", "stiffness", "N*m/rad",
        (Series("more tilt", angle, rod[:, 0, 0]), Series("sideways", angle, rod[:, 1, 1])),
    )  # fmt: skip
