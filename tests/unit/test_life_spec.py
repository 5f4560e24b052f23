"""material.life in a spec: read in any kind, refused with the place and what to give instead."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from jsonschema import Draft7Validator

from springcad.errors import SpecError
from springcad.spec.schema import json_schema
from springcad.spec.source import Spec, read_spec

SPECS = Path(__file__).parents[2] / "specs"
MINIMAL = """\
springcad: 1
kind: rotary-flexure
name: knee
target: {stiffness: 150 N*m/rad, deflection: 14.5 deg}
envelope: {outer_radius: 33.5 mm, root_radius: 31 mm, contact_radius: 6 mm, thickness: 4.5 mm}
flexures: {count: 24}
process: wire-edm
material:
  name: aisi-420
  life: {cycles: 1e5}
"""
LIFE = "  life: {cycles: 1e5}\n"


def read(tmp_path: Path, life: str = LIFE, material: str = "aisi-420") -> Spec:
    path = tmp_path / "spec.yaml"
    path.write_text(MINIMAL.replace("aisi-420", material).replace(LIFE, life), encoding="utf-8")
    return read_spec(path)


def problems(tmp_path: Path, life: str, material: str = "aisi-420") -> list[str]:
    with pytest.raises(SpecError) as caught:
        read(tmp_path, life, material)
    return [str(problem).rpartition("spec.yaml:")[2] for problem in caught.value.problems]


def stress(tmp_path: Path, life: str, material: str = "aisi-420") -> float:
    return read(tmp_path, life, material).model.material.design_stress


def test_the_life_of_the_contract_gives_the_design_stress_of_paper_004(tmp_path: Path) -> None:
    told = "  life: {cycles: 1e5, load_ratio: -1, reliability: 0.5, surface: polished}\n"
    assert stress(tmp_path, told) == pytest.approx(912.0e6, abs=0.05e6)
    assert stress(tmp_path, "  life: {cycles: 100000}\n") == stress(tmp_path, told)
    assert read(tmp_path, LIFE).sha256 == read(tmp_path, told).sha256


@pytest.mark.parametrize(
    ("life", "lines"),
    [
        (
            "",
            [
                "9:3: material.design_stress: missing: give design_stress, or life to find it from",
            ],
        ),
        (
            "  life: {cycles: 1e5}\n  design_stress: 912 MPa\n",
            ["11:18: material.design_stress: give one of design_stress and life, not both"],
        ),
        (
            "  life: {cycles: 1e5 m, reliability: 0.7, surface: polish}\n",
            [
                "10:18: material.life.cycles: must be a bare number, is '1e5 m'",
                "10:38: material.life.reliability: must be 0.5, 0.9, 0.95, 0.99 or 0.999, is 0.7",
                "10:52: material.life.surface: unknown surface polish; did you mean polished?",
            ],
        ),
        (
            "  life: {reliability: 0.5}\n",
            ["10:9: material.life.cycles: missing: number of load cycles to bear, a bare number as "
             "1e5"],
        ),
        (
            "  life: {cycles: 1e5, load_ratio: 1}\n",
            ["10:35: material.life.load_ratio: must be less than 1.0, is 1"],
        ),
        (
            "  life: {cycles: 200}\n",
            [
                "10:18: material.life.cycles: must be at least 1000: below, plastic strain decides "
                "and not stress; or give S-N points that begin lower"
            ],
        ),
        (
            "  life: {cycles: 1e5, surface: ground, surface_factor: 0.6}\n",
            ["10:32: material.life.surface: give one of surface and surface_factor, not "
             "both"],
        ),
        (
            "  life: {cycles: 1e7, sn: [[1e3, 900 MPa], [1e6, 400 MPa]]}\n",
            [
                "10:18: material.life.cycles: must be within the S-N points, 1e3 to 1e6: nothing "
                "is extrapolated"
            ],
        ),
        (
            "  life: {cycles: 1e5, sn: [[1e3, 900 MPa], [1e6, 950 MPa], [1e7, 3]]}\n",
            [
                "10:44: material.life.sn: stress must be less than that of the point before",
                "10:66: material.life.sn: needs a unit, for example 3 MPa",
            ],
        ),
        (
            "  life: {cycles: 1e5, sn: [[1e3, 900 MPa]]}\n",
            ["10:27: material.life.sn: must be a list of 2 to 1000 pairs [cycles, stress in MPa]"],
        ),
        (
            "  life: {cycles: 1e5, histogram: [[20 N*m, 1e4], [0.5, 1e4], [1.5, many]]}\n",
            [
                "10:50: material.life.histogram: give torques, or shares of the deflection, not "
                "both",
                "10:63: material.life.histogram: must be more than 0 and at most 1, is 1.5",
                "10:68: material.life.histogram: must be a bare number, is 'many'",
            ],
        ),
        (
            "  yield_strength: 1800 MPa\n  life: {cycles: 1e5}\n",
            [
                "11:9: material.life: the ultimate strength, 1720 MPa, is below the yield "
                "strength, 1800 MPa: give both for one temper"
            ],
        ),
    ],
)  # fmt: skip
def test_one_clear_message_where_the_mistake_stands(
    tmp_path: Path, life: str, lines: list[str]
) -> None:
    assert problems(tmp_path, life) == lines


@pytest.mark.parametrize(
    ("material", "life", "line"),
    [
        (
            "pom-c",
            "  life: {cycles: 1e5}\n",
            "10:9: material.life: nothing is known of pom-c at 1e5 cycles: no fatigue strength, "
            "and none can be estimated but for steels; give S-N points of your own as life.sn: "
            "[[1e3, ... MPa], [1e6, ... MPa]]",
        ),
        (
            "al-7075-t6",
            "  life: {cycles: 1e5}\n",
            "10:9: material.life: nothing is known of al-7075-t6 at 1e5 cycles: the life of its "
            "fatigue strength, 159 MPa, is not stated; give S-N points of your own as life.sn: "
            "[[1e3, ... MPa], [1e6, ... MPa]]",
        ),
        (
            "50crva",
            "  life: {cycles: 1e5}\n",
            "10:9: material.life: nothing is known of 50crva at 1e5 cycles: no fatigue strength, "
            "and no ultimate strength to estimate one from; give material.ultimate_strength, or "
            "S-N points of your own as life.sn: [[1e3, ... MPa], [1e6, ... MPa]]",
        ),
        (
            "50crva",
            "  life: {cycles: 1e5, load_ratio: 0, sn: [[1e3, 900 MPa], [1e6, 400 MPa]]}\n",
            "10:35: material.life.load_ratio: goodman needs the ultimate strength of 50crva: give "
            "material.ultimate_strength, or mean_stress: soderberg",
        ),
        (
            "pom-c",
            "  life: {cycles: 1e5, surface: ground, sn: [[1e3, 50 MPa], [1e6, 20 MPa]]}\n",
            "10:32: material.life.surface: factors of surfaces are known for steels; use "
            "surface_factor",
        ),
    ],
)
def test_nothing_is_made_up_where_nothing_is_known(
    tmp_path: Path, material: str, life: str, line: str
) -> None:
    assert problems(tmp_path, life, material) == [line]


def test_mistakes_elsewhere_in_the_material_come_at_the_same_time(tmp_path: Path) -> None:
    assert problems(tmp_path, "  life: {cycles: 10}\n", "aisi-421") == [
        "9:9: material.name: unknown material aisi-421; did you mean aisi-420?"
    ]
    assert len(problems(tmp_path, "  density: 7\n  life: {cycls: 1e5}\n", "aisi-421")) == 3


def test_points_of_the_user_are_read_between_and_go_before_the_table(tmp_path: Path) -> None:
    sn = "sn: [[1e3, 50 MPa], [1e5, 25 MPa], [1e7, 20 MPa]]"
    assert stress(tmp_path, f"  life: {{cycles: 1e5, {sn}}}\n", "pom-c") == pytest.approx(25e6)
    assert stress(tmp_path, f"  life: {{cycles: 1e4, {sn}}}\n", "pom-c") == pytest.approx(
        1e6 * (50 * 25) ** 0.5
    )
    assert stress(tmp_path, f"  life: {{cycles: 1e5, {sn}}}\n") == pytest.approx(25e6)


def test_what_decides_the_stress_decides_the_identity(tmp_path: Path) -> None:
    more = ("", ", reliability: 0.9", ", histogram: [[0.5, 1e4]]", ", histogram: [[0.5, 2e4]]")
    lives = ["cycles: 2e5", *(f"cycles: 1e5{end}" for end in more)]
    assert len({read(tmp_path, f"  life: {{{life}}}\n").sha256 for life in lives}) == len(lives)


@pytest.mark.parametrize("name", ["lever-triangular", "leaf2-design"])
def test_kinds_without_a_single_torque_take_shares(name: str, tmp_path: Path) -> None:
    text = (SPECS / f"{name}.yaml").read_text(encoding="utf-8")
    start = text.index("design_stress: ")
    end = text.index(" MPa", start) + len(" MPa")
    path = tmp_path / "spec.yaml"
    for load, is_read in (("0.6", True), ("20 N*m", False)):
        life = f"life: {{cycles: 1e5, histogram: [[{load}, 1e4]]}}"
        path.write_text(text[:start] + life + text[end:], encoding="utf-8")
        if is_read:
            assert read_spec(path).model.material.life.histogram[0][0].value == 0.6
            continue
        with pytest.raises(SpecError, match="has no single torque; give shares"):
            read_spec(path)


def test_the_spec_with_a_life_asks_for_the_same_ring_as_s2() -> None:
    ours, paper = (read_spec(SPECS / f"{name}.yaml").model for name in ("rotary-life", "S2"))
    assert ours.material.design_stress == pytest.approx(paper.material.design_stress, rel=2e-5)
    for section in ("target", "envelope", "flexures", "process", "mounting", "camshaft", "stress"):
        assert getattr(ours, section) == getattr(paper, section), section


def test_editors_accept_one_of_stress_and_life() -> None:
    schema = Draft7Validator(json_schema())
    life = {"cycles": 1e5, "reliability": 0.99, "sn": [[1e3, "900 MPa"], [1e6, "400 MPa"]]}
    base = read_spec(SPECS / "S2.yaml").raw

    def is_valid(**material: object) -> bool:
        return schema.is_valid({**base, "material": {"name": "aisi-420", **material}})

    assert is_valid(life=life)
    assert is_valid(design_stress="912 MPa")
    assert not is_valid()
    assert not is_valid(life=life, design_stress="912 MPa")
    assert not is_valid(life={**life, "reliability": 0.7})
    assert not is_valid(life={**life, "load_ratio": 1})


def test_a_life_is_read_without_numpy() -> None:
    code = (
        "import sys; from pathlib import Path; from springcad.spec.source import read_spec;"
        f"read_spec(Path({str(SPECS / 'rotary-life.yaml')!r}));"
        "assert not {'numpy', 'scipy', 'shapely'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
