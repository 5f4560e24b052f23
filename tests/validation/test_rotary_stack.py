"""Springs stacked to one joint: torques of sheets on a camshaft add, angles of springs in series.

The whole joint of the shipped spec: three sheets of 1.5 mm in parallel, two such springs in series,
36 N m/rad and 24 deg each way.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from rotary_cases import SPECS, rotary_model, spring_of, written_of

from springcad.errors import SpecError
from springcad.export.dxf import part_to_dxf
from springcad.geometry.outline import Circle, Profile
from springcad.geometry.outline_ops import profile_area, profile_polar_moment
from springcad.kinds.rotary_flexure import check_spec
from springcad.kinds.rotary_flexure.bench_model import Bench, bench_model
from springcad.kinds.rotary_flexure.calibration import calibrate_spring
from springcad.kinds.rotary_flexure.drawn_parts import parts
from springcad.kinds.rotary_flexure.inputs import case_of, joint_target_of, target_of
from springcad.kinds.rotary_flexure.joint import joint_design, joint_response
from springcad.kinds.rotary_flexure.law import straight_deflection
from springcad.kinds.rotary_flexure.sector_contact import sector_contact, torque, turn_through
from springcad.kinds.rotary_flexure.stack import stack_of
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.spec.source import read_spec
from springcad.spec.torque_curve import read_bench_file

JOINT = "rotary-stack"
THICK = (
    "stack={series: 2}",
    "envelope.thickness=4.5 mm",
)
"""The same joint of two thick sheets."""
ALONE = (
    "stack={sheet: 1.5 mm}",
    "target.stiffness=24 N*m/rad",
    "target.deflection=12 deg",
)
"""One sheet of the joint by itself."""
STIFFENING = (
    "target={law: {polynomial: [30 N*m/rad, 0 N*m/rad^2, 40 N*m/rad^3]}, deflection: 24 deg}",
    "flexures.tip_thickness=0.4 mm",
)


def test_a_sheet_of_the_joint_is_cut_from_the_drawing_of_that_sheet_alone() -> None:
    stacked, alone = (parts(spring_of(JOINT, *changes)) for changes in ((), ALONE))
    for part, single in zip(stacked, alone, strict=True):
        assert part_to_dxf(part) == part_to_dxf(single)
    assert [part.count for part in stacked] == [6, 2]
    assert [part.thickness for part in stacked] == [1.5e-3, pytest.approx(4.5e-3)]


def test_three_sheets_do_what_one_of_three_times_the_thickness_does() -> None:
    """Plane stress knows no thickness: torque, and torsion of the camshaft, as of the thick one."""
    stack, thick = spring_of(JOINT), spring_of(JOINT, *THICK)
    one, other = joint_response(stack), joint_response(thick)
    angle = np.asarray(one["angle_rad"])
    same = np.interp(angle, np.asarray(other["angle_rad"]), np.asarray(other["torque_Nm"]))
    np.testing.assert_allclose(one["torque_Nm"], same, atol=1e-5 * np.max(same))
    assert stack.camshaft.hub_stress == pytest.approx(thick.camshaft.hub_stress, rel=1e-6)
    assert profile_area(stack.ring) == pytest.approx(profile_area(thick.ring), rel=1e-3)


@pytest.mark.parametrize("changes", [(), STIFFENING], ids=["linear", "stiffening"])
def test_the_joint_follows_its_law_and_stores_the_energy_of_its_sheets(
    changes: tuple[str, ...],
) -> None:
    spring = spring_of(JOINT, *changes)
    joint, law = joint_response(spring), joint_target_of(spring.spec)
    angle, found = (np.asarray(joint[key]) for key in ("angle_rad", "torque_Nm"))
    full = float(law.torque(np.array([math.radians(24.0)]))[0])
    assert angle[-1] == pytest.approx(math.radians(24.0))
    assert np.max(np.abs(found - np.sign(angle) * law.torque(np.abs(angle)))) < 2e-3 * full
    forward = angle > 0.0
    work = np.trapezoid(np.append(0.0, found[forward]), np.append(0.0, angle[forward]))
    assert work == pytest.approx(6.0 * float(spring.strokes[0].energy[-1]), rel=1e-3)


def test_compliances_add_in_series_and_stiffnesses_in_parallel() -> None:
    spring = spring_of(JOINT)
    stroke = spring.strokes[0]
    of_sheet = float(stroke.torque[-1] / stroke.angle[-1])
    of_spring = sum([of_sheet] * 3)
    assert 1.0 / sum([1.0 / of_spring] * 2) == pytest.approx(36.0, rel=2e-4)


def test_law_of_a_sheet_is_the_derivative_of_its_energy() -> None:
    """Torque, energy and stiffness were scaled alike."""
    law = target_of(rotary_model(JOINT, *STIFFENING))
    angle, step = np.linspace(0.02, 0.2, 10), 1e-6
    slope = (law.energy(angle + step) - law.energy(angle - step)) / (2.0 * step)
    np.testing.assert_allclose(slope, law.torque(angle), rtol=1e-7)
    bend = (law.torque(angle + step) - law.torque(angle - step)) / (2.0 * step)
    np.testing.assert_allclose(bend, law.stiffness(angle), rtol=1e-7)


def test_straight_flexures_turn_further_in_series_than_in_parallel() -> None:
    """Eq. 11 of 004 at the stiffness of the joint: m^(2/3) against m^(1/3) times one sheet."""

    def angle(stiffness: float, thickness: float) -> float:
        return float(straight_deflection(stiffness, 22e-3, 5.5e-3, 25, thickness, 750e6, 200e9))

    one = angle(24.0, 1.5e-3)
    assert angle(24.0, 3 * 1.5e-3) == pytest.approx(3 ** (1 / 3) * one)
    assert 3 * angle(3 * 24.0, 1.5e-3) == pytest.approx(3 ** (2 / 3) * one)


def test_free_play_adds_in_series() -> None:
    """0.02 mm at 5.5 mm: half of it each way in each of two springs."""
    play = joint_design(spring_of(JOINT))["free_play_rad"]
    assert play == pytest.approx(2 * 0.01 / 5.5, rel=2e-3)


def test_finite_elements_of_one_sheet_give_the_torque_of_the_joint() -> None:
    spring = written_spring(written_of(JOINT))
    sector = sector_contact(spring, 1)
    half, full = turn_through(sector, [0.5 * spring.deflection, spring.deflection])
    for turn in (half, full):
        assert 3.0 * torque(sector, turn) == pytest.approx(36.0 * 2.0 * turn.angle, rel=0.01)


def test_a_bench_test_is_one_of_the_whole_joint(tmp_path: Path) -> None:
    """A sheet of 3 % less modulus makes the joint 3 % softer, play and all."""
    written = written_of(JOINT)
    model = bench_model(written, written_spring(written))
    turns = np.radians(np.concatenate([np.linspace(0, 24), np.linspace(24, -24), [-20.0, -10.0]]))
    travel = np.sign(np.gradient(turns)).astype(np.intp)
    measured = model.torque(Bench(modulus=0.97), turns, travel)
    assert np.max(measured) == pytest.approx(0.97 * 36.0 * (turns.max() - 0.0033), rel=2e-3)
    rows = "\n".join(f"{a},{t}" for a, t in zip(np.degrees(turns), measured, strict=True))
    file = tmp_path / "bench.csv"
    file.write_text(f"angle [deg],torque [N*m]\n{rows}\n")
    found = calibrate_spring(written, read_bench_file(file), "modulus", lambda _: None)
    assert found.estimates[0].value == pytest.approx(0.97 * 200e9, rel=1e-3)


def test_as_many_sheets_as_there_is_room_for() -> None:
    def stack(*changes: str) -> tuple[int, float]:
        found = stack_of(rotary_model(JOINT, "stack.parallel=auto", *changes))
        return found.parallel, found.spare

    assert stack("envelope.thickness=4.5 mm") == (3, 0.0)
    assert stack("envelope.thickness=5 mm") == (3, pytest.approx(0.5e-3))
    assert stack("envelope.thickness=4.499 mm") == (2, pytest.approx(1.499e-3))
    assert stack("stack.sheet=0.3 mm", "envelope.thickness=0.9 mm") == (3, 0.0)


def test_height_of_the_joint() -> None:
    assert stack_of(rotary_model(JOINT)).height == pytest.approx(2 * 4.5e-3 + 3e-3)


def test_remedies_are_in_the_numbers_of_the_joint(tmp_path: Path) -> None:
    """Too stiff: what the advice names, at the value that it names, is feasible."""
    spec = read_spec(SPECS / f"{JOINT}.yaml", ("target.stiffness=50 N*m/rad",))
    failed = [claim for claim in check_spec(spec) if claim.status == "fail"]
    assert failed
    assert all(claim.name.startswith("one sheet: ") for claim in failed)
    changes = {text.split(" from ")[0].split()[1]: text for text in failed[0].remedy.split("; or ")}
    text = changes["stack.sheet"]
    value = text.split(" to ")[1].strip("≥≤ ").split(" mm")[0]
    mended = ("target.stiffness=50 N*m/rad", f"stack.sheet={value} mm")
    again = check_spec(read_spec(SPECS / f"{JOINT}.yaml", mended))
    assert not [claim.name for claim in again if claim.status == "fail"]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (("envelope.thickness=4.5 mm",), "3 sheets of 1.5 mm are 4.5 mm thick"),
        (("stack={series: 2}",), "thickness is missing"),
        (("stack.parallel=auto",), "auto needs envelope.thickness"),
        (("stack={parallel: auto}", "envelope.thickness=4.5 mm"), "auto needs stack.sheet"),
        (("stack.parallel=auto", "envelope.thickness=1 mm"), "not one sheet fits"),
        (("stack.series=1",), "between springs in series only"),
    ],
)
def test_the_thickness_of_a_sheet_follows_in_exactly_one_way(
    changes: tuple[str, ...], said: str
) -> None:
    with pytest.raises(SpecError) as refused:
        read_spec(SPECS / f"{JOINT}.yaml", changes)
    assert len(refused.value.problems) == 1
    assert said in str(refused.value)


def test_a_target_of_the_joint_is_that_of_a_sheet_by_the_counts() -> None:
    inputs = case_of(rotary_model(JOINT)).inputs
    assert inputs.stiffness == pytest.approx(36.0 * 2 / 3)
    assert inputs.deflection == pytest.approx(math.radians(12.0))
    assert inputs.thickness == 1.5e-3


def test_polar_moment_of_a_ring() -> None:
    ring = Profile(Circle((0.0, 0.0), 30e-3), (Circle((0.0, 0.0), 20e-3),))
    exact = 0.5 * math.pi * (30e-3**4 - 20e-3**4)
    assert profile_polar_moment(ring) == pytest.approx(exact, rel=1e-4)
