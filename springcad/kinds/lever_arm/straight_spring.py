"""A straight leaf as the spring of a lever: sized, drawn, and with its law of force."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from springcad.geometry.outline import Profile
from springcad.geometry.outline_ops import profile_area
from springcad.geometry.transform import rotate
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.changes import FAULT, LARGEST_STRAIN, less_strain
from springcad.kinds.lever_arm.feasibility import failures
from springcad.kinds.lever_arm.made import MadeSpring
from springcad.kinds.lever_arm.sizing import SizedLeaf, elastic, size_leaf
from springcad.kinds.lever_arm.spring_law import spring_law
from springcad.kinds.lever_arm.straight import Fittings, StraightLeaf, half_seen
from springcad.kinds.lever_arm.straight_beam import LeafStates, leaf_states
from springcad.kinds.lever_arm.straight_part import block_height, leaf_profile
from springcad.mechanics.leaf import SHAPES
from springcad.result import Check, Dimension, Outcome, Plot, Progress, Series, Value, check

Floats = NDArray[np.float64]

STEPS = 16
"""Deflections to each side of rest at which the leaf is analysed."""
STRESS_TOLERANCE = 1e-4
"""Stress counts as met within this share."""
_QUARTER = 0.5 * np.pi


def straight_spring(
    case: Case, fittings: Fittings, density: float, progress: Progress
) -> MadeSpring:
    """The spring of ``case.count`` straight leaves.

    Raises:
        InfeasibleError: see ``size_leaf`` and ``leaf_profile``.
    """
    progress("sizing the leaf")
    sized = size_leaf(case, fittings)
    leaf = sized.leaf
    states = leaf_states(leaf, elastic(case), case.deflection * np.arange(1, STEPS + 1) / STEPS)
    deflection, force = _both_ways(states.deflection), case.count * _both_ways(states.force)
    flat = leaf_profile(leaf)
    sheet = case.sheet if leaf.bends_in_sheet else leaf.thickness
    pieces = case.count * sized.layers
    return MadeSpring(
        deflection=deflection,
        force=force,
        energy=case.count * _mirrored(states.energy),
        stress=_mirrored(states.peak_stress),
        law=spring_law(deflection, force),
        width=leaf.width,
        layers=sized.layers,
        profile=_upright(flat) if leaf.bends_in_sheet else flat,
        role="leaf",
        sheet=sheet,
        dimensions=_dimensions(leaf),
        shapes=_shapes(states),
        surroundings=(),
        mass=profile_area(flat) * sheet * pieces * density,
        design=_design(sized, case),
        response=_response(states, sized),
        checks=tuple(_checks(case, sized, states)),
        outcomes=tuple(_outcomes(case, sized, states)),
        plots=_plots(case, sized, states),
        assumptions=tuple(_assumptions(sized)),
        advice=tuple(_advice(case, sized)),
    )


def _both_ways(values: Floats) -> Floats:
    """Odd function: its values at the negative deflections, 0 and the positive ones."""
    return np.concatenate([-values[::-1], [0.0], values])


def _mirrored(values: Floats) -> Floats:
    """Even function that is 0 at rest."""
    return np.concatenate([values[::-1], [0.0], values])


def _upright(profile: Profile) -> Profile:
    """The leaf along y, away from the lever."""
    return rotate(profile, _QUARTER)


def _shapes(states: LeafStates) -> tuple[tuple[Floats, ...], ...]:
    """Centre lines at -s_max, 0 and s_max, in the plane of bending, the leaf along y."""
    x, y = states.points[-1].T
    rest = np.column_stack([np.zeros_like(x), states.place])
    return tuple((line,) for line in (np.column_stack([-y, x]), rest, np.column_stack([y, x])))


def _dimensions(leaf: StraightLeaf) -> tuple[Dimension, ...]:
    turned = leaf.bends_in_sheet

    def at(x: float, y: float) -> tuple[float, float]:
        return (-y, x) if turned else (x, y)

    half = leaf.edge(np.array([0.5 * leaf.length]))[0]
    end = leaf.plan.root_center[1] - leaf.fittings.root_fillet
    radius = leaf.plan.eye_radius
    return (
        Dimension("length", "linear", at(0.0, 0.0), at(leaf.length, 0.0)),
        Dimension("at the clamp", "linear", at(leaf.length, -end), at(leaf.length, end)),
        Dimension(
            "in the middle",
            "linear",
            at(0.5 * leaf.length, -float(half[0])),
            at(0.5 * leaf.length, float(half[0])),
        ),
        Dimension("eye", "radius", at(0.0, 0.0), at(-radius, 0.0)),
    )


def _design(sized: SizedLeaf, case: Case) -> dict[str, Value]:
    leaf, size = sized.leaf, sized.leaf.fittings
    return {
        "leaf": {
            "length_m": leaf.length,
            "thickness_m": leaf.thickness,
            "width_m": leaf.width,
            "eye_radius_m": leaf.plan.eye_radius,
            "pin_diameter_m": size.pin_diameter,
            "eye_wall_m": size.eye_wall,
            "eye_fillet_radius_m": size.eye_fillet,
            "root_fillet_radius_m": size.root_fillet,
            "min_web_m": size.min_web,
            "block_length_m": size.block_length,
            "block_height_m": block_height(leaf),
            "hole_count": size.hole_count,
            "hole_diameter_m": size.hole_diameter,
        },
        "full_thickness_m": sized.full_thickness,
        "full_stiffness_N_per_m": sized.full_stiffness,
        "closed_form_thickness_m": sized.closed_thickness,
        "closed_form_stiffness_N_per_m": sized.closed_stiffness,
        "closed_form_volume_utilisation": SHAPES[case.shape].volume_utilisation,
    }


def _response(states: LeafStates, sized: SizedLeaf) -> dict[str, Value]:
    half = half_seen(sized.leaf, states.place)
    return {
        "leaf_place_m": states.place,
        "leaf_half_seen_m": half,
        "leaf_stress_Pa": states.stress[-1],
        "tip_shift_m": float(states.points[-1, 0, 0]),
    }


def _checks(case: Case, sized: SizedLeaf, states: LeafStates) -> Iterator[Check]:
    yield check(
        "stress at the spring deflection, both directions", float(states.peak_stress[-1]), "<=",
        (1.0 + STRESS_TOLERANCE) * case.design_stress, "Pa",
        source="nonlinear beam, bending and axial, no notch; the leaf is symmetric",
        remedy=FAULT,
    )  # fmt: skip
    if sized.leaf.bends_in_sheet:
        yield check(
            "thickness at the clamp", sized.leaf.thickness, ">=", case.min_web, "m",
            source="smallest web of the process", remedy=FAULT,
        )  # fmt: skip
    yield check(
        "strain at the edge", case.design_stress / case.elastic_modulus, "<=",
        LARGEST_STRAIN, "1",
        source="linear elasticity of small strains; beyond it the material's curve counts",
        remedy=less_strain(case, LARGEST_STRAIN, lambda tried: not failures(tried)),
        otherwise="warn",
    )  # fmt: skip


def _outcomes(case: Case, sized: SizedLeaf, states: LeafStates) -> Iterator[Outcome]:
    leaf = sized.leaf
    yield Outcome("thickness at the clamp", leaf.thickness, "m", None,
                  f"closed form {1e3 * sized.closed_thickness:.4g} mm at full stress, beam "
                  f"{1e3 * sized.full_thickness:.4g} mm")  # fmt: skip
    yield Outcome("stiffness of this width at full stress", sized.full_stiffness, "N/m", None,
                  f"closed form {1e-3 * sized.closed_stiffness:.4g} N/mm")  # fmt: skip
    yield Outcome("nominal stress", float(states.peak_stress[-1]), "Pa", case.design_stress,
                  "at the spring deflection, no notch")  # fmt: skip


def _plots(case: Case, sized: SizedLeaf, states: LeafStates) -> tuple[Plot, ...]:
    return (
        Plot("Stress along the leaf at the spring deflection", "distance from the pin", "m",
             "stress", "Pa", (Series("beam", states.place, states.stress[-1]),),
             limit=case.design_stress),
        Plot("Half of the leaf as seen in the sheet", "distance from the pin", "m", "half", "m",
             (Series("as cut", states.place, half_seen(sized.leaf, states.place)),)),
    )  # fmt: skip


def _assumptions(sized: SizedLeaf) -> Iterator[str]:
    yield (
        "The leaf is a beam with large deflections, stretch and shear, clamped at its block's face "
        "between plates that end with it. The pin in its eye is led across by a straight guide and "
        "slides freely along the leaf, so the force stays across it."
    )
    if sized.leaf.bends_in_sheet:
        yield ("The layers of the stack bend side by side, each in its own plane; they do not rub.")
    else:
        yield (
            "The triangular leaf bends out of its sheet; the lever holds it by a clevis on a screw "
            "through its eye. Anticlastic bending (plate action of a wide leaf) is not counted: at "
            "most it stiffens by 1/(1 - ν²)."
        )
    if sized.leaf.bends_in_sheet:
        yield ("The design stress knows no notch; the second opinion tells that of the fillets at "
               "the clamp. Eye and edge quality are not checked.")  # fmt: skip
    else:
        yield ("The stress knows no notch: fillet, hole and edge quality are not checked.")


def _advice(case: Case, sized: SizedLeaf) -> Iterator[str]:
    stiffer = sized.full_stiffness / sized.closed_stiffness - 1.0
    thicker = sized.full_thickness / sized.closed_thickness - 1.0
    yield (
        f"Against the closed form the beam finds {stiffer:+.1%} of stiffness at full stress, with "
        f"{thicker:+.1%} of thickness."
    )
    used = sized.leaf.thickness / sized.full_thickness
    if case.shape == "triangular" and used < 1.0:
        yield (
            f"The sheet has {used:.1%} of the thickness that the stress allows; a leaf of the same "
            f"width ground to {1e3 * sized.full_thickness:.4g} mm would have {used**-3:.2f} times "
            "the stiffness."
        )
