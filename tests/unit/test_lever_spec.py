"""Specs of a lever arm: what they may say, and one clear message for each thing that is wrong."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from springcad.errors import SpecError
from springcad.kinds.lever_arm.inputs import case_of
from springcad.kinds.lever_arm.spec import TEMPLATE
from springcad.spec.source import read_spec

SPECS = Path(__file__).parents[2] / "specs"
STACK = SPECS / "lever-parabolic.yaml"
TRIANGLE = SPECS / "lever-triangular.yaml"
OMEGA = ("leaf={shape: omega, sheet_thickness: 3 mm}", "envelope={radius: 50 mm}")


def problems_of(path: Path, *overrides: str) -> list[str]:
    with pytest.raises(SpecError) as refused:
        read_spec(path, overrides)
    return [f"{problem.key}: {problem.message}" for problem in refused.value.problems]


def test_template_is_a_valid_spec(tmp_path: Path) -> None:
    path = tmp_path / "spec.yaml"
    path.write_text(TEMPLATE, encoding="utf-8")
    case = case_of(read_spec(path).model)
    assert (case.shape, case.stiffness, case.deflection) == ("parabolic", 85e3, 10e-3)


def test_omega_takes_an_enclosure_and_a_number_of_starts() -> None:
    spec = read_spec(STACK, (*OMEGA, "optimiser={starts: 8, seed: 3}"))
    case = case_of(spec.model)
    assert (case.radius, case.corridor, case.length) == (50e-3, 12e-3, 0.0)


WRONG = {
    "pivot beyond the lever": (
        STACK, ["mechanism.pivot=[5 mm, 50 mm]"],
        "mechanism.pivot: must stay below lever_length, 50 mm: the spring is there",
    ),
    "pivot the wrong way round": (
        STACK, ["mechanism.pivot=[30 mm, 5 mm]"],
        "mechanism.pivot: must have its lower bound first",
    ),
    "length missing": (
        STACK, ["leaf={shape: parabolic, sheet_thickness: 3 mm}"],
        "leaf.length: missing: shape parabolic needs it",
    ),
    "length of an omega": (
        STACK, [*OMEGA, "leaf.length=80 mm"],
        "leaf.length: has no meaning with shape: omega, which finds it",
    ),
    "bent by more than half its length": (
        STACK, ["leaf.length=19 mm"],
        "leaf.length: must be at least twice the spring_deflection, 20 mm",
    ),
    "sheet missing": (
        STACK, ["leaf={shape: constant, length: 80 mm}"],
        "leaf.sheet_thickness: missing: a leaf of shape constant is a stack of layers of sheet",
    ),
    "neither layers nor stiffness": (
        STACK, ["target={spring_deflection: 10 mm}"],
        "leaf.layers: give layers, or target.spring_stiffness to find them from",
    ),
    "layers of a triangle": (
        TRIANGLE, ["leaf.layers=3"],
        "leaf.layers: has no meaning with shape: triangular; use count",
    ),
    "width and stiffness of a triangle": (
        TRIANGLE, ["target.spring_stiffness=20 N/mm"],
        "leaf.width: give one of leaf.width and target.spring_stiffness; the other follows",
    ),
    "width of a stack": (
        STACK, ["leaf.width=30 mm"],
        "leaf.width: has no meaning with shape: parabolic; use layers",
    ),
    "topology of a straight leaf": (
        STACK, ["leaf.topology=free"],
        "leaf.topology: has a meaning with shape: omega only",
    ),
    "radius missing": (
        STACK, [OMEGA[0]], "envelope.radius: missing: shape omega needs it",
    ),
    "radius of a straight leaf": (
        STACK, ["envelope.radius=50 mm"], "envelope.radius: has a meaning with omega only",
    ),
    "corridor of a straight leaf": (
        STACK, ["envelope.lever_corridor=12 mm"],
        "envelope.lever_corridor: has a meaning with shape: omega only",
    ),
    "corridor as wide as the enclosure": (
        STACK, [*OMEGA, "envelope.lever_corridor=50 mm"],
        "envelope.lever_corridor: must be less than the radius, 50 mm",
    ),
    "optimiser of a straight leaf": (
        STACK, ["optimiser.starts=4"],
        "optimiser: has a meaning with shape: omega only; the other shapes follow from closed "
        "forms",
    ),
    "fillet too sharp": (
        STACK, ["mount.root_fillet=0.1 mm"],
        "mount.root_fillet: an inside radius of 0.1 mm is below the 0.25 mm that laser can make",
    ),
    "holes too large": (
        STACK, ["mount.hole_diameter=11 mm"],
        "mount.hole_diameter: a web beside the holes of 0.5 mm is below the 1 mm that laser can "
        "make",
    ),
    "block of an omega": (
        STACK, [*OMEGA, "mount.height=20 mm"],
        "mount.height: has no meaning with shape: omega, whose feet follow the wall",
    ),
    "thin eye": (
        STACK, ["connection.eye_wall=0.5 mm"],
        "connection.eye_wall: a web of 0.5 mm is below the 1 mm that laser can make",
    ),
    "torque for a stiffness": (
        STACK, ["target.spring_stiffness=85 N*m"],
        "target.spring_stiffness: 85 N*m is a torque, expected a linear stiffness (N/mm, N/m, "
        "kN/mm, lbf/in)",
    ),
    "unknown arrangement": (
        STACK, ["mechanism.output=crank"],
        "mechanism.output: unknown word crank; did you mean crank-ahead?",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("path", "overrides", "message"), WRONG.values(), ids=WRONG.keys())
def test_each_thing_wrong_has_one_message(path: Path, overrides: list[str], message: str) -> None:
    assert problems_of(path, *overrides) == [message]


def test_reading_a_spec_loads_no_numerics() -> None:
    """A refused spec must not wait for numpy."""
    code = (
        "import sys; from pathlib import Path; from springcad.spec.source import read_spec\n"
        f"read_spec(Path({str(STACK)!r}), ())\n"
        "print([n for n in ('numpy', 'scipy', 'shapely', 'ezdxf') if n in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
