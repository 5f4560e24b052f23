"""Specs of a roller cam: what they may say, and one clear message for each thing that is wrong."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from springcad.errors import SpecError
from springcad.kinds import KINDS
from springcad.kinds.roller_cam.inputs import group_law, joint_of, roller_spec
from springcad.kinds.roller_cam.spec import SPEC_MODEL, TEMPLATE, RollerCamSpec
from springcad.spec.source import Spec, read_spec

SPECS = Path(__file__).parents[2] / "specs"
SHIPPED = ("paper", "linear", "quadratic", "table", "stiffness")
DEGREE = np.pi / 180.0
BASE = """\
springcad: 1
kind: roller-cam
name: joint
target:
  law: {LAW}
  deflection: 1.9 deg
joint: {drum_radius: 40 mm, roller_radius: 4 mm, roller_offset: 8.95 mm}
envelope: {thickness: 3.4 mm}
cantilever: {length: 24.4 mm, height: 4.9 mm}
material: {name: 50crva, design_stress: 900 MPa}
process: wire-edm
"""
TABLE = "table: law.csv"
CSV = "angle [deg], torque [N*m]\n0, 0\n1, 2.5\n2, 8\n"


@pytest.fixture(autouse=True)
def _registered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(KINDS, "roller-cam", ("springcad.kinds.roller_cam", "roller cam"))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory, so that messages name files as a user sees them."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def spec_of(law: str, *overrides: str, csv: str | bytes | None = None) -> Spec:
    """The spec with a law, in the working directory, beside a file ``law.csv``."""
    Path("spec.yaml").write_text(BASE.replace("LAW", law), encoding="utf-8")
    if csv is not None:
        Path("law.csv").write_bytes(csv.encode() if isinstance(csv, str) else csv)
    return read_spec(Path("spec.yaml"), overrides)


def problems_of(law: str, *overrides: str, csv: str | bytes | None = None) -> list[str]:
    with pytest.raises(SpecError) as refused:
        spec_of(law, *overrides, csv=csv)
    return [str(problem) for problem in refused.value.problems]


def model_of(spec: Spec) -> RollerCamSpec:
    return roller_spec(spec.model)


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_specs_are_valid(name: str) -> None:
    spec = read_spec(SPECS / f"roller-{name}.yaml")
    assert spec.name == f"roller-{name}"


def test_the_paper_s_spec_says_which_numbers_are_not_the_paper_s() -> None:
    text = (SPECS / "roller-paper.yaml").read_text(encoding="utf-8")
    assert "not in the paper" in text
    model = model_of(read_spec(SPECS / "roller-paper.yaml"))
    joint = joint_of(model)
    beam = joint.cantilever
    assert (beam.length, beam.width, beam.height) == (24.4e-3, 3.4e-3, 4.9e-3)
    assert (beam.elastic_modulus, beam.poisson_ratio) == (206e9, 0.29)
    assert (joint.roller.drum_radius, joint.roller.radius, joint.roller.offset) == (
        40e-3, 4e-3, 8.95e-3,
    )  # fmt: skip
    end = np.array([1.9 * DEGREE])
    assert group_law(model).torque(end)[0] == pytest.approx(11.76492, rel=1e-6)


def test_the_template_holds_every_key_with_its_default(folder: Path) -> None:
    """As written it is valid, and every optional key of the model stands in it."""
    Path("spec.yaml").write_text(TEMPLATE, encoding="utf-8")
    model = model_of(read_spec(Path("spec.yaml")))
    minimal = model_of(spec_of("linear: 1 N*m/deg", "groups=3", "target.per=group"))
    for section in ("contact_part", "mount", "stepwise", "friction", "method", "compensation"):
        assert getattr(model, section) == getattr(minimal, section), section
    for section in SPEC_MODEL.model_fields:
        assert section in TEMPLATE


@pytest.mark.parametrize(
    ("law", "torque"),
    [
        ("linear: 4 N*m/deg", 7.6),
        ("polynomial: [1 N*m/deg, 2 N*m/deg^2]", 1.9 + 2 * 1.9**2),
        ("exponential: {scale: 0.15 N*m, decade: 1 deg}", 0.15 * (10**1.9 - 1)),
        ("table: [[0 deg, 0 N*m], [1 deg, 3 N*m], [1.9 deg, 5.7 N*m]]", 5.7),
        ("stiffness: {polynomial: [1 N*m/deg, 2 N*m/deg^2]}", 1.9 + 1.9**2),
        ("stiffness: {table: [[0 deg, 2 N*m/deg], [2 deg, 6 N*m/deg]]}", 2 * 1.9 + 1.9**2),
        ("table: law.csv", None),
    ],
)
def test_every_form_of_a_law(folder: Path, law: str, torque: float | None) -> None:
    model = model_of(spec_of(law, csv=CSV))
    at = np.array([0.0, 1.0, 1.9]) * DEGREE
    values = group_law(model).torque(at)
    assert values[0] == 0.0
    if torque is None:
        assert values[1] == pytest.approx(2.5)
    else:
        assert values[2] == pytest.approx(torque)


def test_a_law_of_the_joint_is_shared_by_its_groups(folder: Path) -> None:
    end = np.array([1.9 * DEGREE])
    joint = group_law(model_of(spec_of("linear: 6 N*m/deg", "groups=3")))
    group = group_law(model_of(spec_of("linear: 6 N*m/deg", "groups=3", "target.per=group")))
    assert 3.0 * joint.torque(end) == pytest.approx(group.torque(end))
    assert joint.words.endswith("shared by 3 groups")


@pytest.mark.parametrize(
    "csv",
    [
        CSV,
        "angle_deg,torque_Nm\n0,0\n1,2.5\n2,8\n",
        "torque (N*mm), angle (deg)\r\n0,0\r\n2500,1\r\n8000,2\r\n",
        "# from the bench\n\nangle [deg],torque [Nm]\n0,0\n\n# half way\n1,2.5\n2e0,8.0",
        "\ufeffAngle [°], Torque [N·m]\n0, 0\n1, 2.5\n2, 8\n",
    ],
)
def test_a_file_may_be_written_in_several_ways(folder: Path, csv: str) -> None:
    table = model_of(spec_of(TABLE, csv=csv)).target.law.table
    assert table is not None
    expected = [(0.0, 0.0), (1.0, 2.5), (2.0, 8.0)]
    assert [(a / DEGREE, t) for a, t in table] == [pytest.approx(point) for point in expected]


def test_the_identity_of_a_spec_is_that_of_its_numbers(folder: Path) -> None:
    """It changes with a number of the file, and not with its name, units, comments or order."""
    original = spec_of(TABLE, csv=CSV).sha256
    assert spec_of(TABLE, csv=CSV.replace("2.5", "2.6")).sha256 != original
    assert spec_of(TABLE, csv="# new\ntorque_Nmm,angle_deg\n0,0\n2500,1\n8000,2").sha256 == original
    inline = "table: [[0 deg, 0 N*m], [1 deg, 2.5 N*m], [2 deg, 8 N*m]]"
    assert spec_of(inline).sha256 == original


def test_a_file_lies_beside_its_spec_wherever_it_is_read_from(folder: Path) -> None:
    Path("sub/more").mkdir(parents=True)
    Path("sub/spec.yaml").write_text(BASE.replace("LAW", "table: more/law.csv"))
    Path("sub/more/law.csv").write_text(CSV)
    table = model_of(read_spec(Path("sub/spec.yaml"))).target.law.table
    assert table is not None
    assert len(table) == 3


HEAD = "angle [deg], torque [N*m]\n"
MUST_BE = "the first line is angle [deg], torque [N*m]"
FILES = {
    "nan": (HEAD + "0,0\n1,nan", "law.csv:3:3: torque: must be a finite number"),
    "infinite": (HEAD + "0,0\n1e999,3", "law.csv:3:1: angle: must be a finite number"),
    "text": (
        HEAD + "0,0\n1,=2+3",
        "law.csv:3:3: torque: =2+3 N*m is not a number with a unit, for example 33.5 N*m",
    ),
    "empty cell": (HEAD + "0,0\n1, ", "law.csv:3:4: torque is empty"),
    "too many cells": (
        HEAD + "0,0\n1,2,3",
        "law.csv:3:1: must be two numbers with a comma between them, is 3",
    ),
    "decimal comma": (
        HEAD + "0,0\n1,0,2,5",
        "law.csv:3:1: must be two numbers with a comma between them, is 4",
    ),
    "semicolons": (
        "angle [deg];torque [N*m]\n0;0\n",
        "law.csv:1:1: columns are separated by commas; write angle [deg], torque [N*m]",
    ),
    "no header": ("0,0\n1,2\n", f"law.csv:1:1: unknown column 0; {MUST_BE}"),
    "no unit": (
        "angle, torque [N*m]\n0,0\n1,2\n",
        "law.csv:1:1: unit of angle: needs a unit, for example 1 deg",
    ),
    "wrong unit": (
        "angle [deg], torque [N]\n0,0\n",
        "law.csv:1:14: unit of torque: 1 N is a force, expected a torque (N*m, Nm, N*mm, lbf*in)",
    ),
    "wrong name": (
        "angel [deg], torque [N*m]\n0,0\n",
        "law.csv:1:1: unknown column angel [deg]; did you mean angle?",
    ),
    "one column": (
        "angle [deg]\n0\n1\n",
        "law.csv:1:1: no column torque; write angle [deg], torque [N*m]",
    ),
    "same column twice": (
        "angle [deg], angle [rad]\n0,0\n",
        "law.csv:1:14: column angle is given a second time",
    ),
    "angle twice": (HEAD + "0,0\n1,2\n1,3", "law.csv:4:1: angle must be more than 1 deg"),
    "angles descend": (HEAD + "0,0\n1,2\n0.5,3\n2,4", "law.csv:4:1: angle must be more than 1 deg"),
    "torque falls": (
        HEAD + "0,0\n1,2\n1.5,1.9\n2,4",
        "law.csv:4:5: torque falls; it must not be less than the 2 N*m before it",
    ),
    "preload": (
        HEAD + "0,0.5\n2,1",
        "law.csv:2:3: torque at 0 is 0.5 N*m; must be 0: a mirrored pair has no preload",
    ),
    "does not begin at rest": (HEAD + "0.1,0\n2,1", "law.csv:2:1: the first angle must be 0"),
    "dead zone": (
        HEAD + "0,0\n0.2,0\n2,1",
        "law.csv:3:5: no torque up to 0.2 deg: give that as target.dead_zone instead",
    ),
    "negative": (
        HEAD + "0,0\n1,-2\n",
        "law.csv:3:3: torque: must be from 0 N*m to 1000000 N*m, is -2 N*m",
    ),
    "bidirectional text": (
        HEAD + "0,0\n1,\u202e2",
        "law.csv:3:3: the character '\\u202e' is not accepted",
    ),
}


@pytest.mark.parametrize(("csv", "message"), FILES.values(), ids=FILES.keys())
def test_a_bad_file_has_one_clear_message_at_the_place(
    folder: Path, csv: str, message: str
) -> None:
    """The rest of the file is sound or is not judged: only one problem is told."""
    assert problems_of(TABLE, csv=csv) == [message]


KEY = "spec.yaml:5:16: target.law.table: "


@pytest.mark.parametrize(
    ("csv", "message"),
    [
        (None, "law.csv: cannot be read: No such file or directory"),
        ("", "law.csv: holds no line"),
        (b"a\0b", "law.csv: is not a text file (it holds null bytes)"),
        ("x" * 300_000, "law.csv: larger than 256 KiB"),
        (HEAD + "0,0\n", "must have from 2 to 1000 points, has 1"),
        (HEAD + "".join(f"{i / 1000},{i}\n" for i in range(1200)),
         "must have from 2 to 1000 points, has more"),
        (HEAD + "0,0\n1,2\n", "ends at 1 deg, but must reach the deflection less the dead zone, "
         "1.9 deg"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_whole_file_stands_at_its_name(
    folder: Path, csv: str | bytes | None, message: str
) -> None:
    (problem,) = problems_of(TABLE, csv=csv)
    if csv == "":
        assert problem == "law.csv:1:1: holds no line with the columns, angle [deg], torque [N*m]"
    else:
        assert problem == KEY + message


@pytest.mark.parametrize("name", ["/etc/passwd", "../law.csv", "a/../../b.csv", "'.'", "''"])
def test_a_file_outside_the_folder_of_the_spec_is_not_read(folder: Path, name: str) -> None:
    (problem,) = problems_of(f"table: {name}")
    assert problem.endswith("must be a CSV file beside the spec file or in a folder below it")


def test_all_problems_of_spec_and_file_come_at_once(folder: Path) -> None:
    csv = HEAD + "0,0\n1,x\n0.5,y\n"
    problems = problems_of(TABLE, "groups=0", csv=csv)
    assert [problem.split(": ")[0] for problem in problems] == [
        "law.csv:3:3",
        "law.csv:4:5",
        "--set:1:1",
    ]


LINEAR = "linear: 4 N*m/deg"
PROBLEMS = {
    "no law": (
        "",
        [],
        "spec.yaml:5:8: target.law: give one of exponential, linear, polynomial, "
        "table, stiffness; none given",
    ),
    "two laws": (
        "linear: 1 N*m/deg, polynomial: [1 N*m/deg]",
        [],
        "target.law: give one of "
        "exponential, linear, polynomial, table, stiffness; linear and polynomial given",
    ),
    "unknown law": (
        "exponental: {}",
        [],
        "target.law.exponental: unknown key; did you mean exponential?",
    ),
    "inline pair": (
        "table: [[0 deg, 0 N*m], [1 deg]]",
        [],
        "spec.yaml:5:33: target.law.table: must be a pair [angle in deg, torque in N*m]",
    ),
    "inline cell": (
        "table: [[0 deg, 0 N*m], [2 deg, 3 N]]",
        [],
        "spec.yaml:5:41: target.law.table: torque: 3 N is a force",
    ),
    "inline without unit": (
        "table: [[0 deg, 0 N*m], [2 deg, 3]]",
        [],
        "spec.yaml:5:41: target.law.table: torque: needs a unit, for example 3 N*m",
    ),
    "not a list": ("table: {a: 1}", [], "target.law.table: must be the name of a CSV file"),
    "unit of a coefficient": (
        "polynomial: [1 N*m/deg, 2 N*m/deg]",
        [],
        "spec.yaml:5:33: "
        "target.law.polynomial: 2 N*m/deg is a torsional stiffness, expected "
        "a torque per rad^2 (N*m/rad^2, N*m/deg^2)",
    ),
    "bare coefficient": ("polynomial: [1]", [], "needs a unit, for example 1 N*m/rad"),
    "overflow": (
        "exponential: {scale: 1 N*m, decade: 0.1 deg}",
        [],
        "spec.yaml:5:45: target.law.exponential.decade: the torque grows by more than 12 decades",
    ),
    "dead zone": (
        LINEAR,
        ["target.dead_zone=2 deg"],
        "target.dead_zone: must be less than 1.9 deg",
    ),
    "roller": (
        LINEAR,
        ["joint.roller_radius=41 mm"],
        "joint.roller_radius: must be less than drum_radius, 40 mm",
    ),
    "bounds without objective": (
        LINEAR,
        ["cantilever.height=[3 mm, 5 mm]"],
        "cantilever: bounds need an objective",
    ),
    "objective without bounds": (
        LINEAR,
        ["cantilever.objective=min_volume"],
        "cantilever: objective has nothing to size",
    ),
    "bounds descend": (
        LINEAR,
        ["cantilever.height=[5 mm, 3 mm]"],
        "cantilever.height: must have its lower bound first",
    ),
    "target without stiffness": (
        LINEAR,
        ["cantilever.height=[3 mm, 5 mm]", "cantilever.objective=target_stiffness"],
        "cantilever.stiffness: missing: objective target_stiffness needs it",
    ),
    "stiffness without target": (
        LINEAR,
        ["cantilever.stiffness=1400 N/mm"],
        "cantilever.stiffness: has a meaning with objective target_stiffness or min_stress",
    ),
    "thin contact part": (
        LINEAR,
        ["contact_part.thickness=0.2 mm"],
        "contact_part.thickness: a web of 0.2 mm is below the 0.3 mm that wire-edm can make",
    ),
    "holes without web": (
        LINEAR,
        ["mount.hole_diameter=9.9 mm", "mount.holes=1"],
        "mount.hole_diameter: a web beside "
        "the holes of 0.05 mm is below the 0.3 mm that wire-edm can make",
    ),
    "mounts that overlap": (
        LINEAR,
        ["mount.height=18 mm"],
        "mount.height: must be at most 17.9 mm, twice the roller's offset",
    ),
    "stepwise without method": (
        LINEAR,
        ["stepwise.steps=50"],
        "stepwise: has a meaning with method: stepwise only",
    ),
}


@pytest.mark.parametrize(("law", "overrides", "message"), PROBLEMS.values(), ids=PROBLEMS.keys())
def test_a_wrong_spec_has_one_clear_message(
    folder: Path, law: str, overrides: list[str], message: str
) -> None:
    (problem,) = problems_of(law, *overrides)
    assert message in problem


def test_bounds_are_a_range_or_one_value(folder: Path) -> None:
    model = model_of(
        spec_of(LINEAR, "cantilever.height=[3 mm, 5 mm]", "cantilever.objective=min_stress")
    )
    assert model.cantilever.height == (3e-3, 5e-3)
    assert model.cantilever.length == (24.4e-3, 24.4e-3)
    assert joint_of(model).cantilever.height == 5e-3


def test_a_spec_with_a_table_loads_nothing_numeric(folder: Path) -> None:
    """A spec error shall not wait for numpy, not even one in the file."""
    spec_of(TABLE, csv=CSV)
    code = (
        "import sys\n"
        "from pathlib import Path\n"
        "from springcad.kinds import KINDS\n"
        "KINDS['roller-cam'] = ('springcad.kinds.roller_cam', 'roller cam')\n"
        "from springcad.spec.source import read_spec\n"
        "read_spec(Path('spec.yaml'))\n"
        "assert not {'numpy', 'scipy', 'ezdxf', 'shapely'} & set(sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
