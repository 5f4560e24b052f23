"""The root of a flexure: finite elements of root, fillets and rim against a table, against the
clamped flexure, and against the whole sector under large deflection.

The table is of the straight spring S1 of paper 004 (24 flexures, root radius 31 mm), from an
independent contact finite-element model with triangles that agrees with CalculiX to 0.001 %: root
spring c = C E t h^2 against a flexure clamped at the root radius, rim pressed into a rigid bore,
and the largest stress in the fillet at 12.6 deg.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from rotary_cases import problem_for
from sector_cases import sector_of

from springcad.kinds.rotary_flexure.flexure_contact import flexure_beam
from springcad.kinds.rotary_flexure.root_compliance import (
    RootModel,
    root_model,
    sector_supports,
    surface_stress,
)
from springcad.kinds.rotary_flexure.sector_blocks import COARSE, FINE, Density
from springcad.kinds.rotary_flexure.sector_mesh import sector_mesh
from springcad.kinds.rotary_flexure.sector_skeleton import SectorGeometry
from springcad.kinds.rotary_flexure.shape import straight_ribbon
from springcad.mechanics.beam import PreparedBeam, follower_load, prepare
from springcad.mechanics.centre_line import unloaded_points
from springcad.mechanics.dead_load import dead_load
from springcad.mechanics.fem.assembly import Sheet, edge_load, prepare_solid
from springcad.mechanics.fem.blocks import graded, join, straight, transfinite
from springcad.mechanics.fem.constraints import Constraints, prescribe, solve_constraints
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, State, prepare_model
from springcad.mechanics.fem.newton import linear_solution, solve_path

SHEET = Sheet(200e9, 0.3, 4.5e-3)
SPRINGS = ("S1", "S2", "S3", "S4")

FILLET_TABLE = {0.09: 3.63, 0.17: 3.00, 0.35: 1.60, 0.52: 0.08, 0.69: -1.54}
"""c by fillet radius over root thickness, rim 0.86 root thicknesses."""
RIM_TABLE = {0.35: 1.78, 0.52: 2.35, 1.38: 3.37, 2.76: 3.50}
"""c by rim over root thickness, fillet 0.17 root thicknesses."""
FILLET_STRESS = {0.09: 1766e6, 0.17: 1432e6, 0.35: 1197e6, 0.52: 1124e6, 0.69: 1107e6}
FLANK_STRESS = 891e6
"""Largest stress in the fillet and on the sides of the flexure at 12.6 deg, the nominal stress."""


def straight_s1(fillet_over_root: float, rim_over_root: float) -> SectorGeometry:
    ribbon = straight_ribbon(problem_for("S1", 0.3))
    root = 2.0 * float(ribbon.at(np.zeros(1)).half_thickness[0])
    outer = 31e-3 + rim_over_root * root
    return SectorGeometry(ribbon, 31e-3, outer, 24, fillet_over_root * root, 0.225e-3)


def beam_of(sector: SectorGeometry, root_compliance: float = 0.0) -> PreparedBeam:
    return flexure_beam(
        sector.ribbon,
        thickness=SHEET.thickness,
        elastic_modulus=SHEET.elastic_modulus,
        poisson_ratio=SHEET.poisson_ratio,
        root_compliance=root_compliance,
    )


def scaled(compliance: float, sector: SectorGeometry) -> float:
    """c = C E t h^2."""
    return compliance * SHEET.elastic_modulus * SHEET.thickness * sector.root_thickness**2


@cache
def s1_model(fillet: float, rim: float, mounting: str = "bore") -> RootModel:
    sector = straight_s1(fillet, rim)
    return root_model(beam_of(sector), sector, mounting)  # type: ignore[arg-type]


def tip_compliance(beam: PreparedBeam, sector: SectorGeometry) -> float:
    return 2.0 * float(follower_load(beam, sector.ribbon.length, 0.0, 1e-2).energy[0]) / 1e-4


def linear_state(mesh: Mesh, supports: Constraints) -> State:
    """Under a unit tip force in -y of the ring's frame."""
    model = prepare_model(prepare_solid(mesh, SHEET), supports)
    force = edge_load(mesh, "tip", np.array([0.0, -1.0]))
    return linear_solution(model, Load(force, np.zeros(mesh.unknowns)))


@cache
def clamped_compliance() -> float:
    """Tip compliance of the bare flexure of S1, clamped at the root radius."""
    ribbon = straight_s1(0.17, 0.86).ribbon
    # Even in sqrt(1 - x/L), as the taper is.
    stations = ribbon.length * (1.0 - (1.0 - 0.985 * graded(80)) ** 2)
    left, right = ribbon.boundary(np.append(stations, ribbon.length)[[*range(160), 161]])
    across = graded(8)
    block = transfinite(
        right.points,
        left.points,
        straight(right.points[0], left.points[0], across),
        straight(right.points[-1], left.points[-1], across),
    )
    mesh = join({"a": block}, {"root": [("a", "west")], "tip": [("a", "east")]})
    supports = solve_constraints(mesh.unknowns, prescribe(mesh.node_sets["root"]))
    return 2.0 * linear_state(mesh, supports).energy


def against_clamped(model: RootModel, sector: SectorGeometry) -> float:
    """c against the finite-element clamped flexure instead of the clamped beam."""
    beam = tip_compliance(beam_of(sector), sector)
    lever = sector.ribbon.length
    return scaled(model.compliance + (beam - clamped_compliance()) / lever**2, sector)


@pytest.mark.parametrize(("fillet", "expected"), FILLET_TABLE.items())
def test_the_root_spring_of_s1_follows_the_table_over_the_fillet(
    fillet: float, expected: float
) -> None:
    sector = straight_s1(fillet, 0.86)
    assert against_clamped(s1_model(fillet, 0.86), sector) == pytest.approx(expected, abs=0.12)


@pytest.mark.parametrize(("rim", "expected"), RIM_TABLE.items())
def test_the_root_spring_of_s1_follows_the_table_over_the_rim(rim: float, expected: float) -> None:
    sector = straight_s1(0.17, rim)
    assert against_clamped(s1_model(0.17, rim), sector) == pytest.approx(expected, abs=0.08)


def test_a_rim_of_2_5_mm_and_a_fillet_of_half_a_millimetre_soften_s1_by_4_1_per_cent() -> None:
    sector = straight_s1(0.17, 0.86)
    beam = beam_of(sector, s1_model(0.17, 0.86).compliance)
    change = clamped_compliance() / tip_compliance(beam, sector) - 1.0
    assert change == pytest.approx(-0.041, abs=0.001)


@pytest.mark.parametrize(("fillet", "stress"), FILLET_STRESS.items())
def test_the_fillet_stress_of_s1_follows_the_table(fillet: float, stress: float) -> None:
    factor = s1_model(fillet, 0.86).fillet_stress_factor
    assert factor == pytest.approx(stress / FLANK_STRESS, rel=0.04)


@pytest.mark.parametrize("name", SPRINGS)
def test_the_beam_with_the_root_spring_has_the_tip_compliance_of_the_finite_elements(
    name: str,
) -> None:
    sector = sector_of(name)
    model = root_model(beam_of(sector), sector, "bore")
    mesh = sector_mesh(sector, COARSE)
    elements = 2.0 * linear_state(mesh, sector_supports(mesh, sector.count, "bore")).energy
    beam = beam_of(sector, model.compliance)
    assert tip_compliance(beam, sector) == pytest.approx(elements, rel=1e-5)
    # A beam that has the root spring already needs no other one.
    again = root_model(beam, sector, "bore")
    assert again.compliance == pytest.approx(model.compliance, rel=1e-3, abs=1e-9)


@pytest.mark.parametrize("name", SPRINGS)
def test_the_beam_with_the_root_spring_bends_like_the_sector_at_full_load(name: str) -> None:
    sector = sector_of(name)
    beam = beam_of(sector, root_model(beam_of(sector), sector, "bore").compliance)
    clamped = beam_of(sector)
    mesh = sector_mesh(sector, COARSE)
    supports = sector_supports(mesh, sector.count, "bore")
    model = prepare_model(prepare_solid(mesh, SHEET), supports)
    push = edge_load(mesh, "tip", np.array([0.0, -1.0]))
    end = np.array([sector.ribbon.length])
    for force in (220.0, -220.0):
        load = Load(force * push, np.zeros(mesh.unknowns))
        (state,) = solve_path(model, [load])
        elements = float(push @ state.displacement)
        moved = [
            float(dead_load(b, end, np.array([[0.0, force]])).end_position[0, 1])
            - float(unloaded_points(b, end)[0][0, 1])
            for b in (beam, clamped)
        ]
        assert moved[0] == pytest.approx(elements, rel=5e-4)
        # The design chose fillets that leave the root no stiffer than a clamp, on dowels.
        assert moved[1] == pytest.approx(elements, rel=0.022)


@pytest.mark.parametrize("name", ["S1", "S3"])
def test_the_coarse_mesh_is_fine_enough(name: str) -> None:
    sector = sector_of(name)
    reference = Density(**{**vars(FINE), "skin": 5, "fillet": 16, "aspect": 1.0})
    coarse, fine = (root_model(beam_of(sector), sector, "bore", d) for d in (COARSE, reference))
    assert scaled(coarse.compliance, sector) == pytest.approx(
        scaled(fine.compliance, sector), abs=0.015
    )
    assert coarse.fillet_stress_factor == pytest.approx(fine.fillet_stress_factor, rel=0.01)


def test_a_large_fillet_makes_the_root_spring_negative_and_the_beam_takes_it() -> None:
    sector = straight_s1(0.69, 0.86)
    model = s1_model(0.69, 0.86)
    assert model.compliance < 0.0
    stiffer = tip_compliance(beam_of(sector, model.compliance), sector)
    assert stiffer < tip_compliance(beam_of(sector), sector)


def test_a_root_is_computed_once_and_every_number_tells_it_from_others() -> None:
    sector = straight_s1(0.17, 0.86)
    once = root_model(beam_of(sector), sector, "bore")
    assert root_model(beam_of(straight_s1(0.17, 0.86)), sector, "bore") is once
    thinner = replace(sector, outer_radius=sector.outer_radius - 0.2e-3)
    for other in (
        root_model(beam_of(sector), sector, "dowels"),
        root_model(beam_of(thinner), thinner, "bore"),
        root_model(beam_of(sector), replace(sector, fillet=1.1 * sector.fillet), "bore"),
    ):
        assert other.compliance != once.compliance


def test_less_support_is_softer() -> None:
    bore, dowels = (s1_model(0.17, 0.86, m).compliance for m in ("bore", "dowels"))
    assert bore < dowels
    # A thick rim does not care how its outer edge is held.
    thick = [s1_model(0.17, 2.76, m).compliance for m in ("bore", "dowels")]
    assert thick == pytest.approx([thick[0]] * 2, rel=0.01)


def test_a_rim_on_dowels_bends_freely_but_does_not_turn() -> None:
    sector = sector_of("S4")
    mesh = sector_mesh(sector, COARSE)
    state = linear_state(mesh, sector_supports(mesh, sector.count, "dowels"))
    outer = mesh.node_sets["outer"]
    radial = mesh.nodes[outer] / np.hypot(*mesh.nodes[outer].T)[:, None]
    moved, held = (values.reshape(-1, 2)[outer] for values in (state.displacement, state.reaction))
    share = edge_load(mesh, "outer", np.array([1.0, 0.0]))[2 * outer]
    along = moved[:, 1] * radial[:, 0] - moved[:, 0] * radial[:, 1]
    assert abs(share @ along) < 1e-9 * np.abs(share * along).sum()
    inside = ~np.isin(outer, [*mesh.node_sets["cut_left"], *mesh.node_sets["cut_right"]])
    across, round_ = (np.sum(held * d, axis=1)[inside] for d in (radial, radial[:, ::-1] * [-1, 1]))
    assert np.abs(across).max() < 1e-6 * np.abs(round_).max()
    assert np.ptp(np.sum(moved * radial, axis=1)) > 1e-4 * np.abs(state.displacement).max()


@pytest.mark.parametrize("mounting", ["bore", "dowels"])
def test_the_supports_carry_the_moment_of_the_tip_force_about_the_centre(mounting: str) -> None:
    sector = sector_of("S2")
    mesh = sector_mesh(sector, COARSE)
    supports = sector_supports(mesh, sector.count, mounting)  # type: ignore[arg-type]
    reaction = linear_state(mesh, supports).reaction.reshape(-1, 2)
    x, y = mesh.nodes.T
    moment = np.sum(x * reaction[:, 1] - y * reaction[:, 0])
    tip = sector.root_radius - float(sector.ribbon.at(np.array([sector.ribbon.length])).x[0])
    assert moment == pytest.approx(tip, rel=1e-6)


def test_the_stress_on_the_side_of_the_flexure_is_that_of_the_beam() -> None:
    """Away from root and tip the surface stress of the straight S1 is its nominal stress."""
    sector = straight_s1(0.17, 0.86)
    mesh = sector_mesh(sector, FINE)
    supports = sector_supports(mesh, sector.count, "bore")
    state = linear_state(mesh, supports)
    edges = mesh.edge_sets["flank_left"]
    x = sector.root_radius - mesh.nodes[edges[:, 1], 0]
    within = (x > 0.2 * sector.ribbon.length) & (x < 0.9 * sector.ribbon.length)
    sides = surface_stress(mesh, SHEET.elastic_modulus, state.displacement, "flank_left").mean(1)
    half = np.interp(x, *(lambda p: (p.x, p.half_thickness))(sector.ribbon.at(
        sector.ribbon.dense_stations(800))))  # fmt: skip
    nominal = 1.5 * (sector.ribbon.length - x) / (SHEET.thickness * half**2)
    assert np.abs(sides[within]) == pytest.approx(nominal[within], rel=0.01)
    assert math.copysign(1.0, sides[within].min()) == math.copysign(1.0, sides[within].max())


def test_a_part_of_twice_the_size_is_half_as_compliant() -> None:
    """To 0.1 %: the arcs that are cut keep within the same micrometre of the design."""
    sector = straight_s1(0.35, 0.86)
    ribbon = replace(
        sector.ribbon,
        edges=2.0 * sector.ribbon.edges,
        half_thickness=2.0 * sector.ribbon.half_thickness,
    )
    large = SectorGeometry(
        ribbon, 2.0 * sector.root_radius, 2.0 * sector.outer_radius, 24,
        2.0 * sector.fillet, 2.0 * sector.blend,
    )  # fmt: skip
    thick = prepare(replace(beam_of(large).beam, thickness=2.0 * SHEET.thickness))
    model = root_model(thick, large, "bore")
    small = beam_of(sector, s1_model(0.35, 0.86).compliance)
    twice = prepare(replace(thick.beam, root_compliance=model.compliance))
    assert tip_compliance(twice, large) == pytest.approx(
        0.5 * tip_compliance(small, sector), rel=1e-3
    )
    assert model.fillet_stress_factor == pytest.approx(
        s1_model(0.35, 0.86).fillet_stress_factor, rel=1e-3
    )
