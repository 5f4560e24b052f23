"""What is told of an omega leaf: numbers for the report, checks, plots, assumptions, advice."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.changes import (
    FAULT,
    LARGEST_STRAIN,
    SEARCH_DECIDES,
    less_strain,
)
from springcad.kinds.lever_arm.curved_part import hub_radius
from springcad.kinds.lever_arm.feasibility import failures
from springcad.kinds.lever_arm.omega import OmegaDesign, OmegaLeaf, OmegaResponse, Topology
from springcad.kinds.lever_arm.straight import Fittings
from springcad.result import Check, Outcome, Plot, Series, Value, check

STRESS_TOLERANCE = 1e-3
CLAMP_TOLERANCE = 0.02
"""Of the half's length; the stiffness changes by about three times as much at most."""


def design(
    leaf: OmegaLeaf, found: OmegaDesign, search: tuple[Topology, int, int], fittings: Fittings
) -> dict[str, Value]:
    """What was found, and how, for the report."""
    case, spread = found.case, found.spread
    topology, starts, seed = search
    return {
        "leaf": {
            "angle_coefficients_rad": leaf.angle_coefficients,
            "thickness_coefficients_m": leaf.thickness_coefficients,
            "half_length_m": leaf.length,
            "middle_m": leaf.middle,
            "hub_radius_m": leaf.hub_radius,
            "drawn_hub_radius_m": hub_radius(leaf, fittings),
            "pin_diameter_m": fittings.pin_diameter,
            "root_fillet_radius_m": fittings.root_fillet,
        },
        "enclosure_radius_m": case.enclosure_radius,
        "lever_corridor_m": case.corridor,
        "lever_arms_m": list(case.arms),
        "min_web_m": case.min_web,
        "min_gap_m": case.min_gap,
        "design_stress_Pa": case.allowable_stress,
        "full_stiffness_per_width_N_per_m2": found.stiffness,
        "search": {
            "topology": topology,
            "starts": starts,
            "seed": seed,
            "searches": spread.starts,
            "feasible": spread.feasible,
            "linear_stiffness_per_width_N_per_m2": found.linear_stiffness,
            "stiffness_per_width_of_searches_N_per_m2": spread.stiffness,
        },
    }


def response(states: OmegaResponse) -> dict[str, Value]:
    """Forces, gaps and stresses beside those of every spring."""
    return {
        "side_force_N": states.side_force,
        "hub_rotation_rad": states.rotation,
        "self_gap_m": states.self_gap,
        "wall_gap_m": states.wall_gap,
        "corridor_gap_m": states.corridor_gap,
        "leaf_place_m": states.stations,
        "leaf_thickness_m": states.thickness,
        "leaf_x_m": states.right[len(states.force) // 2, :, 0],
        "leaf_y_m": states.right[len(states.force) // 2, :, 1],
        "leaf_stress_Pa": states.right_stress[-1],
        "leaf_stress_other_half_Pa": states.left_stress[-1],
    }


def checks(case: Case, states: OmegaResponse) -> Iterator[Check]:
    """Limits of the search, looked at again at all deflections."""
    for name, row in (("negative", 0), ("positive", -1)):
        yield check(
            f"stress at the {name} spring deflection", float(states.peak_stress[row]), "<=",
            (1.0 + STRESS_TOLERANCE) * case.design_stress, "Pa",
            source="nonlinear beam, bending with the curved-beam factor and axial; both halves",
            remedy=FAULT,
        )  # fmt: skip
    gaps = (
        ("gap of the leaf to itself", states.self_gap),
        ("gap to the enclosure's wall", states.wall_gap),
        ("gap to the lever's corridor", states.corridor_gap),
    )
    for name, gap in gaps:
        yield check(
            f"{name} over the stroke", float(np.min(gap)), ">=", (1.0 - 1e-3) * case.min_gap, "m",
            source="nonlinear beam at all deflections; smallest gap of the process", remedy=FAULT,
        )  # fmt: skip
    yield check(
        "thinnest place of the leaf", float(states.thickness.min()), ">=",
        (1.0 - 1e-6) * case.min_web, "m", source="smallest web of the process", remedy=FAULT,
    )  # fmt: skip
    bearable = LARGEST_STRAIN / (1.0 + STRESS_TOLERANCE)
    yield check(
        "strain at the edge", float(states.peak_stress.max()) / case.elastic_modulus, "<=",
        LARGEST_STRAIN, "1",
        source="linear elasticity of small strains; beyond it the material's curve counts",
        remedy=f"{less_strain(case, bearable, lambda tried: not failures(tried))} {SEARCH_DECIDES}",
        otherwise="warn",
    )  # fmt: skip


def clamp_check(leaf: OmegaLeaf, shift: float) -> Check:
    """Where the leaf runs into its feet, against the clamps of the beam."""
    return check(
        "feet as drawn against the analysed clamps, over the length of a half",
        abs(shift) / leaf.length, "<=", CLAMP_TOLERANCE, "1",
        source="mean over both edges of where the leaf runs into its foot",
        remedy=f"count with a stiffness up to {3.0 * abs(shift) / leaf.length:.1%} off; another "
        "optimiser.seed, a whole search, may find a leaf that meets the wall more squarely",
        otherwise="warn",
    )  # fmt: skip


def outcomes(case: Case, found: OmegaDesign, states: OmegaResponse) -> Iterator[Outcome]:
    """What is told first."""
    spread = found.spread
    yield Outcome("largest stress", float(states.peak_stress.max()), "Pa", case.design_stress,
                  "at the spring deflection, both directions, no notch")  # fmt: skip
    yield Outcome("stiffness per width at full stress", found.stiffness, "Pa", None,
                  "N/mm per mm; before the nonlinear correction "
                  f"{1e-6 * found.linear_stiffness:.4g}")  # fmt: skip
    yield Outcome("median of the searches", spread.quantile(0.5), "Pa", None,
                  f"{spread.feasible} of {spread.starts} searches; best "
                  f"{1e-6 * spread.quantile(1.0):.4g} N/mm per mm, linear")  # fmt: skip
    yield Outcome("thickness, least", float(states.thickness.min()), "m")
    yield Outcome("thickness, largest", float(states.thickness.max()), "m")


def plots(case: Case, states: OmegaResponse) -> tuple[Plot, ...]:
    """Stress, thickness and gaps."""
    return (
        Plot("Stress along the halves at the spring deflection", "distance from the hub", "m",
             "stress", "Pa",
             (Series("right half", states.stations, states.right_stress[-1]),
              Series("left half", states.stations, states.left_stress[-1])),
             limit=case.design_stress),
        Plot("Thickness along a half", "distance from the hub", "m", "thickness", "m",
             (Series("leaf", states.stations, states.thickness),)),
        Plot("Gaps over the deflection", "deflection", "m", "gap", "m",
             (Series("to itself", states.displacement, states.self_gap),
              Series("to the wall", states.displacement, states.wall_gap),
              Series("to the lever's corridor", states.displacement, states.corridor_gap)),
             limit=case.min_gap),
    )  # fmt: skip


def assumptions() -> Iterator[str]:
    """What was taken for granted."""
    yield (
        "The leaf is a beam with large deflections, stretch and shear in each half; both halves "
        "are clamped at their blocks' faces, and their hub is rigid. The lever holds the hub at "
        "its height and lets it turn."
    )
    yield "The layers of the stack bend side by side, each in its own plane; they do not rub."
    yield (
        "The leaf is the best of the searches, not the best there is: the landscape has many "
        "optima. The feet stand outside the enclosure's wall, in which there are openings for them."
    )
    yield ("The stress knows no notch: fillets, holes, surface and edge quality are not checked.")


def advice(case: Case, found: OmegaDesign, leaf: OmegaLeaf) -> Iterator[str]:
    """How the optima spread, and what layers cost."""
    spread = found.spread
    yield (
        f"Of {spread.starts} searches (starts, then restarts near the best) {spread.feasible} "
        "met every limit: stiffness per width "
        f"{1e-6 * spread.quantile(1.0):.4g} N/mm per mm at best, {1e-6 * spread.quantile(0.75):.4g}"
        f" in the upper quartile, {1e-6 * spread.quantile(0.5):.4g} in the middle and "
        f"{1e-6 * spread.quantile(0.25):.4g} in the lower quartile (linear beam)."
    )
    share = float(leaf.thickness_coefficients.max() / found.leaf.thickness_coefficients.max())
    if case.stiffness and share < 1.0:
        yield (
            f"The leaf was made {1.0 - share:.1%} thinner than its stress allows, because whole "
            "layers have more stiffness than is wanted."
        )
