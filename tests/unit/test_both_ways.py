"""Both directions of a flexure in one solution, and the root that it ends with."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from rotary_cases import rotary_model

from springcad.kinds.rotary_flexure.flexure_contact import flexure_part
from springcad.kinds.rotary_flexure.full_load import Demand, demand_of, loads_of
from springcad.kinds.rotary_flexure.inputs import case_of, target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.root_compliance import root_unit
from springcad.kinds.rotary_flexure.sizing import Sized, size_flexure
from springcad.mechanics.beam import PreparedBeam, contact_load


@cache
def sized(name: str) -> tuple[Sized, Demand]:
    spec = rotary_model(name)
    case = case_of(spec).shifted
    target, inputs = target_of(spec), case.inputs
    flexure = size_flexure(spec, case, design_law(inputs), target, lambda _: None)
    demand = demand_of(target, inputs.root_radius, inputs.contact_radius, inputs.count)
    return flexure, demand


def test_a_negative_angle_turns_the_flexure_the_other_way() -> None:
    flexure, demand = sized("S4")
    angle, force = np.array([0.05, 0.2]), np.array([40.0, 200.0])
    station = np.full(2, flexure.found.ribbon.length)
    there = flexure_part(flexure.beam, demand.root_radius, -1)(angle, force, station)
    mirrored = flexure_part(flexure.beam, demand.root_radius, 1)(-angle, force, station)
    for name in ("arm", "reach", "energy", "point", "normal", "tangent"):
        np.testing.assert_allclose(getattr(mirrored, name), getattr(there, name), rtol=1e-12)


@pytest.mark.parametrize("name", ["S1", "S4"])
def test_at_every_angle_the_flexure_gives_the_torque_and_holds_the_energy(name: str) -> None:
    """By the moment of the contact force about the axis, not by what the search went by."""
    flexure, demand = sized(name)
    for states, way in zip(
        loads_of(flexure.found.ribbon, flexure.beam, demand), (1.0, -1.0), strict=True
    ):
        x, y = (states.point - [demand.root_radius, 0.0]).T
        moment = x * states.force[:, 1] - y * states.force[:, 0]
        np.testing.assert_allclose(way * moment, demand.law.torque, rtol=1e-10)
        np.testing.assert_allclose(states.energy, demand.law.energy, rtol=1e-10)


def test_a_straight_flexure_bears_the_same_both_ways() -> None:
    flexure, demand = sized("S1")
    one, other = loads_of(flexure.found.ribbon, flexure.beam, demand)
    np.testing.assert_allclose(one.end_station, other.end_station, rtol=1e-9)
    np.testing.assert_allclose(one.nominal_stress, other.nominal_stress, rtol=1e-7, atol=1.0)


@pytest.mark.parametrize("name", ["S2", "S4"])
def test_the_chosen_fillet_leaves_the_root_about_as_stiff_as_a_clamp(name: str) -> None:
    """Within a third of the unit 1/(E t h^2), of which a fillet of a tenth of h leaves 4 to 6."""
    flexure, _ = sized(name)
    thickness = 2.0 * float(flexure.found.ribbon.at(np.zeros(1)).half_thickness[0])
    assert abs(flexure.root.compliance) < root_unit(200e9, 4.5e-3, thickness) / 3.0


def test_stresses_follow_from_the_moments_of_the_states() -> None:
    """1.5 |M|/(t lambda^2) + |N|/(2 t lambda), 004, Eq. 1, and the axial force."""
    beam: PreparedBeam = sized("S4")[0].beam
    states = contact_load(beam, beam.edges[-2], 150.0, 1.0)
    width = states.half_thickness
    bending = 1.5 * np.abs(states.moment) / (4.5e-3 * width**2)
    axial = np.abs(states.axial_force) / (2.0 * 4.5e-3 * width)
    np.testing.assert_allclose(states.nominal_stress, bending + axial, rtol=1e-12)
    assert (states.local_stress >= states.nominal_stress * (1.0 - 1e-12)).all()
