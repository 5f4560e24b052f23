"""A valid spec becomes SI values that remember where they stand, and an identity."""

from __future__ import annotations

import math
import pickle
import re
from pathlib import Path

import pytest

from springcad.kinds.rotary_flexure.spec import SPEC_MODEL, TEMPLATE
from springcad.spec.source import Spec, read_spec

MINIMAL = """\
springcad: 1
kind: rotary-flexure
name: knee-s2
target:      {stiffness: 150 N*m/rad, deflection: 14.5 deg}
envelope:    {outer_radius: 33.5 mm, root_radius: 31 mm, contact_radius: 6 mm, thickness: 4.5 mm}
flexures:    {count: 24}
material:    {name: aisi-420, design_stress: 912 MPa}
process:     wire-edm
"""


def read(tmp_path: Path, text: str, *overrides: str) -> Spec:
    path = tmp_path / "spec.yaml"
    path.write_text(text, encoding="utf-8")
    return read_spec(path, overrides)


def test_the_spec_of_the_contract_is_read_in_si(tmp_path: Path) -> None:
    model = read(tmp_path, MINIMAL).model
    assert isinstance(model, SPEC_MODEL)
    assert model.target.stiffness == 150.0
    assert model.target.deflection == pytest.approx(math.radians(14.5), rel=1e-15)
    assert model.envelope.model_dump() == {
        "outer_radius": 0.0335,
        "root_radius": 0.031,
        "contact_radius": 0.006,
        "thickness": 0.0045,
    }
    assert model.flexures.count == 24
    assert model.material.design_stress == 912e6
    assert model.process.rules.min_web == 0.3e-3


def test_what_is_left_out_has_the_stated_default(tmp_path: Path) -> None:
    model = read(tmp_path, MINIMAL).model
    assert isinstance(model, SPEC_MODEL)
    assert model.flexures.style == "auto"
    assert model.flexures.tip_thickness == 0.00035
    assert model.flexures.bend_limit == 0.3
    assert model.flexures.root_fillet == "auto"
    assert model.flexures.min_gap is None
    assert model.stress == "nominal"
    assert model.mounting.dowels is None
    assert (model.camshaft.backlash, model.camshaft.bore_radius) == (0.0, None)
    assert (model.optimiser.form, model.optimiser.starts, model.optimiser.seed) == (
        "curvature",
        6,
        1,
    )
    assert (model.optimiser.control_points, model.optimiser.weighting) == (2, "gap")


def test_everything_that_can_be_said_can_be_said_at_once(tmp_path: Path) -> None:
    text = MINIMAL.replace("aisi-420", "aisi-420, elastic_modulus: 195 GPa, density: 7.7 g/cm^3")
    text = text.replace(
        "wire-edm",
        """
  name: wire-edm
  min_gap: 0.35 mm
mounting: {dowels: {count: 8, radius: 1.5 mm}}
camshaft: {backlash: 0.02 mm, bore_radius: 2.5 mm}
stress: nominal
optimiser: {form: control-points, control_points: 3, weighting: sharpness, starts: 20, seed: 7}
""",
    )
    model = read(tmp_path, text).model
    assert isinstance(model, SPEC_MODEL)
    assert model.material.values.elastic_modulus.value == 195e9
    assert model.material.values.elastic_modulus.source == "spec"
    assert model.material.values.density.value == 7700.0
    assert model.material.values.yield_strength.value == 1310e6
    assert model.process.rules.min_gap == 0.35e-3
    assert model.process.rules.min_web == 0.3e-3
    assert model.mounting.dowels is not None
    assert model.mounting.dowels.radius == 1.5e-3
    assert model.optimiser.control_points == 3


def test_raw_is_what_was_typed(tmp_path: Path) -> None:
    raw = read(tmp_path, MINIMAL, "flexures.count=30").raw
    assert raw["envelope"]["outer_radius"] == "33.5 mm"
    assert raw["flexures"] == {"count": 30}
    assert list(raw) == [line.split(":")[0] for line in MINIMAL.splitlines()]


def test_overrides_replace_and_add_values_and_sections(tmp_path: Path) -> None:
    model = read(
        tmp_path,
        MINIMAL,
        "flexures.count=30",
        "camshaft.backlash=10 um",
        "target={stiffness: 2.6 N*m/deg, deflection: 0.2 rad}",
        "process=laser",
        "process={name: wire-edm}",
        "name=other=",
        "name=other",
    ).model
    assert isinstance(model, SPEC_MODEL)
    assert model.flexures.count == 30
    assert model.camshaft.backlash == 1e-5
    assert model.target.stiffness == pytest.approx(2.6 * 180 / math.pi, rel=1e-15)
    assert model.process.name == "wire-edm"
    assert model.name == "other"


def test_an_override_mends_what_it_replaces(tmp_path: Path) -> None:
    text = MINIMAL.replace("33.5 mm", "33.5 MPa")
    assert read(tmp_path, text, "envelope.outer_radius=33.5 mm").name == "knee-s2"


def test_a_later_problem_finds_its_line(tmp_path: Path) -> None:
    spec = read(tmp_path, MINIMAL, "flexures.count=30")
    found = str(spec.problem(("envelope", "root_radius"), "too small"))
    assert found == f"{tmp_path}/spec.yaml:5:51: envelope.root_radius: too small"
    absent = str(spec.problem(("material", "density"), "unknown"))
    assert absent == f"{tmp_path}/spec.yaml:7:14: material.density: unknown"
    assert str(spec.problem(("flexures", "count"), "odd")) == "--set:1:1: flexures.count: odd"


@pytest.mark.parametrize(
    "same",
    [
        MINIMAL.replace("\n", "   # a comment\n"),
        MINIMAL.replace("\n", "\r\n"),
        "\ufeff" + MINIMAL,
        "---\n" + MINIMAL + "...\n",
        "\n".join(reversed(MINIMAL.splitlines())),
        MINIMAL.replace("33.5 mm", "3.35 cm").replace("912 MPa", "0.912 GPa"),
        MINIMAL.replace("31 mm", "1.2204724409448818 in"),
        MINIMAL.replace("14.5 deg", "0.253072741539178 rad"),
        MINIMAL + "stress: nominal\ncamshaft: {backlash: 0 um}\n",
        MINIMAL.replace("wire-edm", "{name: wire-edm}"),
        MINIMAL.replace("knee-s2", "'knee-s2'"),
    ],
)
def test_layout_units_and_written_defaults_do_not_change_the_identity(
    tmp_path: Path, same: str
) -> None:
    assert read(tmp_path, same).sha256 == read(tmp_path, MINIMAL).sha256


@pytest.mark.parametrize("override", ["name=x", "flexures.count=25", "target.deflection=14.501deg"])
def test_a_changed_value_changes_the_identity(tmp_path: Path, override: str) -> None:
    assert read(tmp_path, MINIMAL, override).sha256 != read(tmp_path, MINIMAL).sha256


def test_the_template_is_valid_and_its_optional_keys_are_too(tmp_path: Path) -> None:
    assert read(tmp_path, TEMPLATE).name == "knee"
    lines = TEMPLATE.splitlines()
    start = lines.index("springcad: 1                       # version of the spec format")
    full = [line.replace("# ", "", 1) if _optional(line) else line for line in lines[start:]]
    names = ("process", "mounting")
    twice = [n for line in full for n in names if line.startswith(f"{n}:")]
    assert twice == ["process", "process", "mounting", "mounting"]
    # What belongs to the other of two choices.
    others = (
        "process: wire-edm", "mounting: bore", "design_stress: 912 MPa", "coefficients: 13",
        "objective: margin",
    )  # fmt: skip
    full = [line for line in full if line.split("#")[0].strip() not in others]
    text = "\n".join(full).replace("form: curvature ", "form: control-points ")
    model = read(tmp_path, text).model
    assert isinstance(model, SPEC_MODEL)
    assert model.mounting.dowels is not None
    assert model.material.values.density.source == "spec"
    assert model.material.life is not None
    assert model.material.life.cycles == 1e5


def _optional(line: str) -> bool:
    return re.match("(  )?# [a-z_]+: ", line) is not None


def test_the_template_mentions_every_key() -> None:
    for section in SPEC_MODEL.model_json_schema()["$defs"].values():
        for key in section["properties"]:
            assert f"{key}:" in TEMPLATE


def test_a_spec_can_be_sent_to_another_process(tmp_path: Path) -> None:
    spec = read(tmp_path, MINIMAL)
    assert pickle.loads(pickle.dumps(spec)) == spec
