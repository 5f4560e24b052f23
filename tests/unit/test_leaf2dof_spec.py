"""Specs of leaf springs in a wrist: what they may say, and one clear message for each fault."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from springcad.errors import SpecError
from springcad.kinds.leaf_2dof.inputs import case_of, leaf_spec
from springcad.kinds.leaf_2dof.spec import SPEC_MODEL, TEMPLATE, Leaf2dofSpec
from springcad.spec.source import Spec, read_spec

SPECS = Path(__file__).parents[2] / "specs"
BASE = """\
springcad: 1
kind: leaf-2dof
name: wrist
target: {deflection: 14 deg, stiffness: [1.5 N*m/rad, 100 N*m/rad]}
unit: {arm_radius: 25 mm, roller_radius: 5 mm}
leaf: {width: 10 mm, thickness: 0.6 mm, effective_length: [10 mm, 45 mm]}
material: {name: 65mn, design_stress: 600 MPa}
process: wire-edm
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory, so that messages name files as a user sees them."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def spec_of(*overrides: str) -> Spec:
    Path("spec.yaml").write_text(BASE, encoding="utf-8")
    return read_spec(Path("spec.yaml"), overrides)


def model_of(spec: Spec) -> Leaf2dofSpec:
    return leaf_spec(spec.model)


def problems_of(*overrides: str) -> list[str]:
    with pytest.raises(SpecError) as refused:
        spec_of(*overrides)
    return [str(problem) for problem in refused.value.problems]


@pytest.mark.parametrize("name", ["paper", "design"])
def test_shipped_specs_are_valid(name: str) -> None:
    assert read_spec(SPECS / f"leaf2-{name}.yaml").name == f"leaf2-{name}"


def test_the_paper_s_spec_says_which_numbers_are_not_the_paper_s() -> None:
    text = (SPECS / "leaf2-paper.yaml").read_text(encoding="utf-8")
    for words in ("the paper does not say so", "safety factor is not given", "not in the\n# paper"):
        assert words in text
    case = case_of(read_spec(SPECS / "leaf2-paper.yaml").model)
    assert (case.arm_radius, case.roller_radius, case.leaves) == (25e-3, 5e-3, 2)
    assert (case.width, case.thickness, case.shortest, case.longest) == (
        10e-3,
        0.6e-3,
        10e-3,
        45e-3,
    )
    assert (case.elastic_modulus, case.yield_strength) == (208e9, 726e6)
    assert case.deflection == pytest.approx(14.83 * np.pi / 180.0)


def test_the_template_holds_every_key_with_its_default(folder: Path) -> None:
    """As written it is valid, and every optional key of the model stands in it."""
    Path("spec.yaml").write_text(TEMPLATE, encoding="utf-8")
    model, minimal = model_of(read_spec(Path("spec.yaml"))), model_of(spec_of())
    for section in ("guide", "mount", "wrist", "envelope"):
        assert getattr(model, section) == getattr(minimal, section), section
    assert (model.unit.clamp, model.unit.leaves_per_axis) == ("outboard", 2)
    assert model.leaf.end_radius == minimal.leaf.end_radius
    for section, field in SPEC_MODEL.model_fields.items():
        assert section in TEMPLATE
        if section in ("material", "process"):
            continue  # the same for all kinds
        for key in getattr(field.annotation, "model_fields", {}):
            assert f"{key}:" in TEMPLATE, f"{section}.{key}"


def test_a_section_is_given_or_bounded_and_lengths_are_a_range_or_auto(folder: Path) -> None:
    given = case_of(spec_of().model)
    assert (given.least_width, given.least_thickness, given.is_sized) == (None, None, False)
    sized = case_of(
        spec_of(
            "leaf.width=[6 mm, 12 mm]", "leaf.thickness=[0.3 mm, 1 mm]",
            "leaf.effective_length=auto", "unit.leaves_per_axis=auto",
        ).model
    )  # fmt: skip
    assert (sized.least_width, sized.width, sized.is_sized) == (6e-3, 12e-3, True)
    assert (sized.shortest, sized.longest, sized.leaves) == (None, None, None)


def test_without_a_stiffness_the_leaf_is_analysed(folder: Path) -> None:
    Path("spec.yaml").write_text(BASE.replace(", stiffness: [1.5 N*m/rad, 100 N*m/rad]", ""))
    case = case_of(read_spec(Path("spec.yaml")).model)
    assert (case.least_stiffness, case.greatest_stiffness) == (None, None)


PROBLEMS = {
    "bounds with lengths": (
        ["leaf.width=[6 mm, 12 mm]"],
        "spec.yaml:6:7: leaf: bounds of width or thickness need effective_length: auto",
    ),
    "number with lengths": (
        ["unit.leaves_per_axis=auto"],
        "unit.leaves_per_axis: auto needs leaf.effective_length: auto",
    ),
    "number of leaves": (["unit.leaves_per_axis=9"], "leaves_per_axis: must be from 1 to 8, is 9"),
    "half a leaf": (
        ["unit.leaves_per_axis=1.5"],
        "leaves_per_axis: must be a whole number or auto",
    ),
    "range upside down": (
        ["leaf.effective_length=[45 mm, 10 mm]"],
        "leaf.effective_length: must have its least value first",
    ),
    "one length": (
        ["leaf.effective_length=45 mm"],
        "leaf.effective_length: must be a list of two values, [least, greatest], or auto",
    ),
    "one stiffness": (
        ["target.stiffness=2 N*m/rad"],
        "target.stiffness: must be a list of two values, [least, greatest]",
    ),
    "stiffness upside down": (
        ["target.stiffness=[100 N*m/rad, 2 N*m/rad]"],
        "target.stiffness: must have its least value first",
    ),
    "torque for a stiffness": (
        ["target.stiffness=[1 N*m, 2 N*m/rad]"],
        "target.stiffness: 1 N*m is a torque; a stiffness is per rad or per deg",
    ),
    "deflection": (["target.deflection=31 deg"], "target.deflection: must be from 0.1 deg to 30"),
    "roller": (["unit.roller_radius=25 mm"], "roller_radius: must be less than arm_radius, 25 mm"),
    "clamp": (["unit.clamp=outbord"], "unit.clamp: unknown word outbord; did you mean outboard?"),
    "leaf on edge": (
        ["leaf.thickness=11 mm"],
        "leaf.thickness: must not be more than the width, 10 mm",
    ),
    "corners": (["leaf.end_radius=6 mm"], "leaf.end_radius: must be at most half the width, 5 mm"),
    "narrow leaf": (
        ["leaf.width=0.7 mm", "leaf.end_radius=0.1 mm", "mount.holes=0", "process=laser"],
        "leaf.width: a web of 0.7 mm is below the 1 mm that laser can make",
    ),
    "holes side by side": (
        ["mount.hole_diameter=7 mm"],
        "mount.hole_diameter: a web beside the holes of 0 mm is below the 0.3 mm",
    ),
    "hole as wide as the leaf": (
        ["mount.hole_diameter=9.8 mm", "mount.holes=1"],
        "mount.hole_diameter: a web beside the holes of 0.1 mm is below the 0.3 mm",
    ),
    "hole too small": (
        ["mount.hole_diameter=0.2 mm"],
        "mount.hole_diameter: a radius of 0.1 mm is below the 0.15 mm that wire-edm can make",
    ),
    "misspelt": (["leaf.lenght=3 mm"], "leaf.lenght: unknown key; leaf takes width, thickness,"),
}


@pytest.mark.parametrize(("overrides", "message"), PROBLEMS.values(), ids=PROBLEMS.keys())
def test_a_wrong_spec_has_one_clear_message(
    folder: Path, overrides: list[str], message: str
) -> None:
    (problem,) = problems_of(*overrides)
    assert message in problem


def test_auto_lengths_need_a_stiffness(folder: Path) -> None:
    Path("spec.yaml").write_text(BASE.replace(", stiffness: [1.5 N*m/rad, 100 N*m/rad]", ""))
    with pytest.raises(SpecError, match=r"leaf: effective_length: auto needs target\.stiffness"):
        read_spec(Path("spec.yaml"), ["leaf.effective_length=auto"])


def test_a_spec_loads_nothing_numeric(folder: Path) -> None:
    """A spec error shall not wait for numpy."""
    Path("spec.yaml").write_text(BASE, encoding="utf-8")
    code = (
        "import sys\n"
        "from pathlib import Path\n"
        "from springcad.spec.source import read_spec\n"
        "read_spec(Path('spec.yaml'))\n"
        "assert not {'numpy', 'scipy', 'ezdxf', 'shapely'} & set(sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
