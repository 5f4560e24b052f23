"""An omega leaf as the spring of a lever: found, laid in layers, drawn, with its law of force."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from springcad.errors import InfeasibleError
from springcad.geometry.outline import Circle
from springcad.geometry.outline_ops import profile_area
from springcad.kinds.lever_arm import curved_report
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.curved_foot import Room
from springcad.kinds.lever_arm.curved_part import clamp_shift, curved_profile, hub_radius
from springcad.kinds.lever_arm.curved_remedies import search_remedies
from springcad.kinds.lever_arm.made import MadeSpring
from springcad.kinds.lever_arm.omega import (
    OmegaCase,
    OmegaLeaf,
    OmegaResponse,
    Topology,
    find_omega,
    omega_response,
)
from springcad.kinds.lever_arm.spring_law import spring_law
from springcad.kinds.lever_arm.stack import layer_count, too_stiff
from springcad.kinds.lever_arm.straight import Fittings
from springcad.result import Dimension, Progress, Shape

Floats = NDArray[np.float64]

STEPS = 8
"""Deflections to each side of rest at which the leaf is analysed."""
HIGHEST = 0.8
"""Height of the hub above the enclosure's middle up to which the search may place it, over R_c."""
BESIDE_FOOT = 1.25
"""The leaf keeps so many radii of its feet's fillets farther from the lever than it must, so that
the feet have room there."""
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
    try:
        found = find_omega(omega, starts=starts, seed=seed, progress=progress)
    except InfeasibleError as error:
        changes = search_remedies(
            case, topology, starts, seed, lambda tried, kind: omega_case(tried, fittings, kind),
            progress,
        )  # fmt: skip
        if not changes:
            claim = f"{error.claim}; nor does twice the radius or half the deflection"
            raise InfeasibleError(claim, error.value, error.limit, error.unit) from error
        raise error.with_remedies(*changes) from error
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
        design=curved_report.design(leaf, found, search, fittings),
        response=curved_report.response(states),
        checks=(
            *curved_report.checks(case, states),
            curved_report.clamp_check(leaf, clamp_shift(leaf, fittings, room)),
        ),
        outcomes=tuple(curved_report.outcomes(case, found, states)),
        plots=curved_report.plots(case, states),
        assumptions=tuple(curved_report.assumptions()),
        advice=tuple(curved_report.advice(case, found, leaf)),
    )


def omega_case(case: Case, fittings: Fittings, topology: Topology) -> OmegaCase:
    """What the search is asked for; the hub is the eye."""
    return OmegaCase(
        enclosure_radius=case.radius,
        stroke=case.deflection,
        elastic_modulus=case.elastic_modulus,
        poisson_ratio=case.poisson_ratio,
        allowable_stress=case.design_stress,
        min_web=fittings.min_web,
        min_gap=case.min_gap,
        corridor=case.corridor + 2.0 * BESIDE_FOOT * fittings.root_fillet,
        arms=(case.lever.length - case.pivot_high, case.lever.length - case.pivot_low),
        middle=(0.0, HIGHEST * case.radius),
        hub_radius=0.5 * fittings.pin_diameter + fittings.eye_wall,
        topology=topology,
    )


def _at_stiffness(case: Case, omega: OmegaCase, leaf: OmegaLeaf, layers: int) -> OmegaLeaf:
    """The leaf made thinner, nowhere below its least web, until the stack is as stiff as wanted.

    Raises:
        InfeasibleError: at the least web all along it is stiffer still.
    """
    if not case.stiffness:
        return leaf
    width, end = case.count * layers * case.sheet, np.array([case.deflection])

    def thinned(share: float) -> OmegaLeaf:
        thickness = np.maximum(share * leaf.thickness_coefficients, omega.min_web)
        return replace(leaf, thickness_coefficients=thickness)

    def excess(exponent: float) -> float:
        """Stiffness over the wanted one, both as logarithms, at a share of the thickness."""
        force = omega_response(thinned(np.exp(exponent)), omega, width, end).force[0]
        return float(np.log(force / (case.stiffness * case.deflection)))

    if excess(0.0) <= _TOLERANCE:
        return leaf
    thinnest = float(np.log(omega.min_web / leaf.thickness_coefficients.max()))
    least = excess(thinnest)
    if least > 0.0:
        raise too_stiff(case, layers, case.stiffness * float(np.exp(least)))
    return thinned(np.exp(brentq(excess, thinnest, 0.0, xtol=_TOLERANCE)))


def _shapes(leaf: OmegaLeaf, states: OmegaResponse) -> tuple[tuple[Floats, ...], ...]:
    pin = np.array([0.0, leaf.middle])
    return tuple((states.right[row] - pin, states.left[row] - pin) for row in (0, STEPS, 2 * STEPS))


def _dimensions(leaf: OmegaLeaf, fittings: Fittings) -> tuple[Dimension, ...]:
    radius = hub_radius(leaf, fittings)
    return (
        Dimension("hub", "radius", (0.0, 0.0), (0.0, radius)),
        Dimension("to the enclosure's middle", "linear", (0.0, 0.0), (0.0, -leaf.middle)),
    )
