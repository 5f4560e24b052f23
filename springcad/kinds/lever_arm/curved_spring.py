"""An omega leaf as the spring of a lever: found, laid in layers, drawn, with its law of force."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Circle
from springcad.geometry.outline_ops import profile_area
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.curved_foot import Room
from springcad.kinds.lever_arm.curved_part import clamp_shift, curved_profile, hub_radius
from springcad.kinds.lever_arm.made import MadeSpring
from springcad.kinds.lever_arm.omega import (
    OmegaCase,
    OmegaDesign,
    OmegaLeaf,
    OmegaResponse,
    Topology,
    find_omega,
    omega_response,
)
from springcad.kinds.lever_arm.spring_law import spring_law
from springcad.kinds.lever_arm.stack import layer_count
from springcad.kinds.lever_arm.straight import Fittings
from springcad.result import Check, Dimension, Outcome, Plot, Progress, Series, Shape, Value, check

Floats = NDArray[np.float64]

STEPS = 8
"""Deflections to each side of rest at which the leaf is analysed."""
HIGHEST = 0.8
"""Height of the hub above the enclosure's middle up to which the search may place it, over R_c."""
BESIDE_FOOT = 1.25
"""The leaf keeps so many radii of its feet's fillets farther from the lever than it must, so that
the feet have room there."""
STRESS_TOLERANCE = 1e-3
CLAMP_TOLERANCE = 0.02
"""Of the half's length; the stiffness changes by about three times as much at most."""
_PASSES = 12
_TOLERANCE = 1e-7


def curved_spring(
    case: Case,
    fittings: Fittings,
    search: tuple[Topology, int, int],
    density: float,
    progress: Progress,
) -> MadeSpring:
    """The spring of ``case.count`` omega leaves.

    Args:
        search: topology, number of starts and their seed.

    Raises:
        InfeasibleError: no leaf was found, or layers or height do not reach the stiffness.
    """
    topology, starts, seed = search
    omega = omega_case(case, fittings, topology)
    found = find_omega(omega, starts=starts, seed=seed, progress=progress)
    layers = layer_count(case, case.count * found.stiffness * case.sheet)
    progress("bending the leaf through its stroke")
    leaf = _at_stiffness(case, omega, found.leaf, layers)
    width = layers * case.sheet
    steps = case.deflection * np.arange(-STEPS, STEPS + 1) / STEPS
    states = omega_response(leaf, omega, width, steps)
    room = Room(case.radius, 0.5 * case.corridor)
    profile = curved_profile(leaf, fittings, room)
    force = case.count * states.force
    return MadeSpring(
        deflection=states.displacement,
        force=force,
        energy=case.count * states.energy,
        stress=states.peak_stress,
        law=spring_law(states.displacement, force),
        width=width,
        layers=layers,
        profile=profile,
        role="omega leaf",
        sheet=case.sheet,
        dimensions=_dimensions(leaf, fittings),
        shapes=_shapes(leaf, states),
        surroundings=(Shape(Circle((0.0, -leaf.middle), case.radius), "limit"),),
        mass=profile_area(profile) * width * case.count * density,
        design=_design(leaf, found, search, fittings),
        response=_response(states),
        checks=(*_checks(case, states), _clamp_check(leaf, clamp_shift(leaf, fittings, room))),
        outcomes=tuple(_outcomes(case, found, states)),
        plots=_plots(case, states),
        assumptions=tuple(_assumptions()),
        advice=tuple(_advice(case, found, leaf)),
    )


def omega_case(case: Case, fittings: Fittings, topology: Topology) -> OmegaCase:
    """What the search is asked for; the hub is the eye."""
    return OmegaCase(
        enclosure_radius=case.radius,
        stroke=case.deflection,
        elastic_modulus=case.elastic_modulus,
        poisson_ratio=case.poisson_ratio,
        allowable_stress=case.design_stress,
        min_web=case.min_web,
        min_gap=case.min_gap,
        corridor=case.corridor + 2.0 * BESIDE_FOOT * fittings.root_fillet,
        arms=(case.lever.length - case.pivot_high, case.lever.length - case.pivot_low),
        middle=(0.0, HIGHEST * case.radius),
        hub_radius=0.5 * fittings.pin_diameter + fittings.eye_wall,
        topology=topology,
    )


def _at_stiffness(case: Case, omega: OmegaCase, leaf: OmegaLeaf, layers: int) -> OmegaLeaf:
    """The leaf made thinner all along until the stack has just the wanted stiffness."""
    if not case.stiffness:
        return leaf
    width, share, thinned = layers * case.sheet, 1.0, leaf
    end = np.array([case.deflection])
    for _ in range(_PASSES):
        force = float(omega_response(thinned, omega, width, end).force[0])
        missing = case.stiffness * case.deflection / (case.count * force)
        if abs(missing - 1.0) <= _TOLERANCE:
            break
        share *= float(np.cbrt(missing))
        thickness = np.maximum(share * leaf.thickness_coefficients, omega.min_web)
        thinned = replace(leaf, thickness_coefficients=thickness)
    return thinned


def _shapes(leaf: OmegaLeaf, states: OmegaResponse) -> tuple[tuple[Floats, ...], ...]:
    pin = np.array([0.0, leaf.middle])
    return tuple((states.right[row] - pin, states.left[row] - pin) for row in (0, STEPS, 2 * STEPS))


def _dimensions(leaf: OmegaLeaf, fittings: Fittings) -> tuple[Dimension, ...]:
    radius = hub_radius(leaf, fittings)
    return (
        Dimension("hub", "radius", (0.0, 0.0), (0.0, radius)),
        Dimension("to the enclosure's middle", "linear", (0.0, 0.0), (0.0, -leaf.middle)),
    )


def _design(
    leaf: OmegaLeaf, found: OmegaDesign, search: tuple[Topology, int, int], fittings: Fittings
) -> dict[str, Value]:
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


def _response(states: OmegaResponse) -> dict[str, Value]:
    return {
        "side_force_N": states.side_force,
        "hub_rotation_rad": states.rotation,
        "self_gap_m": states.self_gap,
        "wall_gap_m": states.wall_gap,
        "corridor_gap_m": states.corridor_gap,
        "leaf_place_m": states.stations,
        "leaf_thickness_m": states.thickness,
        "leaf_x_m": states.right[STEPS, :, 0],
        "leaf_y_m": states.right[STEPS, :, 1],
        "leaf_stress_Pa": states.right_stress[-1],
        "leaf_stress_other_half_Pa": states.left_stress[-1],
    }


def _checks(case: Case, states: OmegaResponse) -> Iterator[Check]:
    for name, row in (("negative", 0), ("positive", -1)):
        yield check(
            f"stress at the {name} spring deflection", float(states.peak_stress[row]), "<=",
            (1.0 + STRESS_TOLERANCE) * case.design_stress, "Pa",
            source="nonlinear beam, bending with the curved-beam factor and axial; both halves",
            remedy="raise optimiser.starts, or lower material.design_stress for a margin",
        )  # fmt: skip
    remedy = "another optimiser.seed or more optimiser.starts"
    gaps = (
        ("gap of the leaf to itself", states.self_gap),
        ("gap to the enclosure's wall", states.wall_gap),
        ("gap to the lever's corridor", states.corridor_gap),
    )
    for name, gap in gaps:
        yield check(
            f"{name} over the stroke", float(np.min(gap)), ">=", (1.0 - 1e-3) * case.min_gap, "m",
            source="nonlinear beam at all deflections; smallest gap of the process", remedy=remedy,
        )  # fmt: skip
    yield check(
        "thinnest place of the leaf", float(states.thickness.min()), ">=",
        (1.0 - 1e-6) * case.min_web, "m", source="smallest web of the process", remedy=remedy,
    )  # fmt: skip
    yield check(
        "strain at the edge", float(states.peak_stress.max()) / case.elastic_modulus, "<=", 0.01,
        "1", source="linear elasticity of small strains; beyond it the material's curve counts",
        remedy="a lower material.design_stress", otherwise="warn",
    )  # fmt: skip


def _clamp_check(leaf: OmegaLeaf, shift: float) -> Check:
    return check(
        "feet as drawn against the analysed clamps, over the length of a half",
        abs(shift) / leaf.length, "<=", CLAMP_TOLERANCE, "1",
        source="mean over both edges of where the leaf runs into its foot",
        remedy="another optimiser.seed, for a leaf that meets the wall less obliquely",
        otherwise="warn",
    )  # fmt: skip


def _outcomes(case: Case, found: OmegaDesign, states: OmegaResponse) -> Iterator[Outcome]:
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


def _plots(case: Case, states: OmegaResponse) -> tuple[Plot, ...]:
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


def _assumptions() -> Iterator[str]:
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


def _advice(case: Case, found: OmegaDesign, leaf: OmegaLeaf) -> Iterator[str]:
    spread = found.spread
    yield (
        f"Of {spread.starts} searches {spread.feasible} met every limit: stiffness per width "
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
