"""What is wrong in a spec is said in plain words, all at once, at the right line and column."""

from __future__ import annotations

from pathlib import Path

import pytest

from springcad.errors import SpecError
from springcad.spec.source import read_spec

MINIMAL = """\
springcad: 1
kind: rotary-flexure
name: knee-s2
target:
  stiffness: 150 N*m/rad
  deflection: 14.5 deg
envelope:
  outer_radius: 33.5 mm
  root_radius: 31 mm
  contact_radius: 6 mm
  thickness: 4.5 mm
flexures: {count: 24}
material: {name: aisi-420, design_stress: 912 MPa}
process: wire-edm
"""


def problems(tmp_path: Path, text: str, *overrides: str) -> list[str]:
    """The lines a user would see, with the folder left out."""
    path = tmp_path / "spec.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SpecError) as caught:
        read_spec(path, overrides)
    assert caught.value.exit_code == 3
    return [str(problem).replace(str(path), "spec.yaml") for problem in caught.value.problems]


def changed(old: str, new: str) -> str:
    assert MINIMAL.count(old) == 1
    return MINIMAL.replace(old, new)


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        (
            "outer_radius",
            "outer_radus",
            "spec.yaml:8:3: envelope.outer_radus: unknown key; did you mean outer_radius?",
        ),
        (
            "  thickness: 4.5 mm",
            "  thickness: 4.5 mm\n  count: 24",
            "spec.yaml:12:3: envelope.count: unknown key; did you mean flexures.count?",
        ),
        (
            "process: wire-edm",
            "process: wire-edm\nzzz: 1",
            "spec.yaml:15:1: zzz: unknown key; a spec takes springcad, kind, name, target, "
            "envelope, flexures, material, stress, process, mounting, camshaft, optimiser, "
            "stack, objective, calibration, tolerance",
        ),
        (
            "  root_radius: 31 mm\n",
            "",
            "spec.yaml:8:3: envelope.root_radius: missing: radius at which the flexures leave the "
            "rim, in mm; auto with objective: diameter",
        ),
        (
            "33.5 mm",
            "33.5",
            "spec.yaml:8:17: envelope.outer_radius: needs a unit, for example 33.5 mm",
        ),
        (
            "33.5 mm",
            "33.5 MPa",
            "spec.yaml:8:17: envelope.outer_radius: 33.5 MPa is a stress, expected a length "
            "(mm, cm, m, um)",
        ),
        (
            "912 MPa",
            "912 mm",
            "spec.yaml:13:43: material.design_stress: 912 mm is a length, expected a stress "
            "(MPa, GPa, kPa, Pa)",
        ),
        (
            "912 MPa",
            "912 MPA",
            "spec.yaml:13:43: material.design_stress: unknown unit MPA; did you mean MPa?",
        ),
        (
            "150 N*m/rad",
            "150 N*m",
            "spec.yaml:5:14: target.stiffness: 150 N*m is a torque; a stiffness is per rad or per "
            "deg, as in N*m/rad",
        ),
        (
            "14.5 deg",
            "75 deg",
            "spec.yaml:6:15: target.deflection: must be from 0.01 deg to 60 deg, is 75 deg",
        ),
        (
            "14.5 deg",
            "-1 deg",
            "spec.yaml:6:15: target.deflection: must be from 0.01 deg to 60 deg, is -1 deg",
        ),
        ("count: 24", "count: 2", "spec.yaml:12:19: flexures.count: must be from 3 to 400, is 2"),
        (
            "count: 24",
            "count: 999",
            "spec.yaml:12:19: flexures.count: must be from 3 to 400, is 999",
        ),
        (
            "count: 24",
            "count: 24.0",
            "spec.yaml:12:19: flexures.count: must be a whole number or auto",
        ),
        (
            "count: 24",
            "count: '24'",
            "spec.yaml:12:19: flexures.count: must be a whole number or auto",
        ),
        (
            "count: 24",
            "count: true",
            "spec.yaml:12:19: flexures.count: must be a whole number or auto",
        ),
        (
            "count: 24",
            "count: 24, style: straigth",
            "spec.yaml:12:30: flexures.style: unknown word straigth; did you mean straight?",
        ),
        (
            "count: 24",
            "count: 24, bend_limit: 0.3 mm",
            "spec.yaml:12:35: flexures.bend_limit: must be a bare number, is '0.3 mm'",
        ),
        (
            "name: aisi-420",
            "name: AISI 420",
            "spec.yaml:13:18: material.name: unknown material AISI 420; did you mean aisi-420?",
        ),
        (
            "wire-edm",
            "wire-erosion",
            "spec.yaml:14:10: process: unknown process wire-erosion; did you mean wire-edm?",
        ),
        (
            "wire-edm",
            "{name: lazer, min_gap: 1 mm}",
            "spec.yaml:14:17: process.name: unknown process lazer; did you mean laser?",
        ),
        (
            "wire-edm",
            "wire-edm\nmounting: glue",
            "spec.yaml:15:11: mounting: must be bore, or dowels with their count and radius",
        ),
        (
            "wire-edm",
            "5",
            "spec.yaml:14:10: process: must be the name of a process, or a section with name and "
            "shop rules",
        ),
        (
            "wire-edm",
            "wire-edm\nmounting: {}",
            "spec.yaml:15:11: mounting.dowels: missing: dowel pins half sunk into the outer edge",
        ),
        (
            "flexures: {count: 24}",
            "flexures: 24",
            "spec.yaml:12:11: flexures: must be a section with keys, is 24",
        ),
        (
            "springcad: 1",
            "springcad: 2",
            "spec.yaml:1:12: springcad: must be 1, is 2",
        ),
        (
            "kind: rotary-flexure",
            "kind: rotary-flexur",
            "spec.yaml:2:7: kind: unknown kind rotary-flexur; did you mean rotary-flexure?",
        ),
        (
            "kind: rotary-flexure",
            "kind: coil",
            "spec.yaml:2:7: kind: unknown kind coil; known: rotary-flexure, roller-cam, lever-arm "
            "or leaf-2dof",
        ),
        (
            "name: knee-s2",
            "name: ../etc/passwd",
            "spec.yaml:3:7: name: must begin with a letter or a digit and have at most 64 letters, "
            "digits, '.', '_', '-'",
        ),
        ("name: knee-s2", "name: Con.x", "spec.yaml:3:7: name: cannot be a file name on Windows"),
        ("name: knee-s2", "name: knee.", "spec.yaml:3:7: name: cannot be a file name on Windows"),
        ("name: knee-s2", "name: 12", "spec.yaml:3:7: name: must be a text, is 12"),
        (
            "name: knee-s2",
            "name:",
            "spec.yaml:3:1: name: is empty: give a value or leave the key out",
        ),
    ],
)
def test_one_mistake_gives_one_line(tmp_path: Path, old: str, new: str, line: str) -> None:
    assert problems(tmp_path, changed(old, new)) == [line]


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        (
            "root_radius: 31 mm",
            "root_radius: 34 mm",
            "spec.yaml:9:16: envelope.root_radius: must be less than outer_radius, 33.5 mm",
        ),
        (
            "root_radius: 31 mm",
            "root_radius: 33.4 mm",
            "spec.yaml:9:16: envelope.root_radius: a rim (outer less root radius) of 0.1 mm is "
            "below the 0.3 mm that wire-edm can make",
        ),
        (
            "contact_radius: 6 mm",
            "contact_radius: 31 mm",
            "spec.yaml:10:19: envelope.contact_radius: must be less than root_radius, 31 mm",
        ),
        (
            "wire-edm",
            "wire-edm\ncamshaft: {bore_radius: 6 mm}",
            "spec.yaml:15:25: camshaft.bore_radius: must be less than contact_radius, 6 mm",
        ),
        (
            "count: 24",
            "count: 24, tip_thickness: 0.2 mm",
            "spec.yaml:12:38: flexures.tip_thickness: a web of 0.2 mm is below the 0.3 mm that "
            "wire-edm can make",
        ),
        (
            "process: wire-edm",
            "process: {name: wire-edm, min_web: 0.5 mm}",
            "spec.yaml:12:11: flexures.tip_thickness: a web of 0.35 mm is below the 0.5 mm that "
            "wire-edm can make",
        ),
        (
            "count: 24",
            "count: 24, min_gap: 0.1 mm",
            "spec.yaml:12:32: flexures.min_gap: a gap of 0.1 mm is below the 0.3 mm that wire-edm "
            "can make",
        ),
        (
            "count: 24",
            "count: 24, root_fillet: 0.1 mm",
            "spec.yaml:12:36: flexures.root_fillet: an inside radius of 0.1 mm is below the "
            "0.15 mm that wire-edm can make",
        ),
        (
            "wire-edm",
            "wire-edm\nmounting: {dowels: {count: 8, radius: 2.4 mm}}",
            "spec.yaml:15:39: mounting.dowels.radius: a web between dowel and root radius of "
            "0.1 mm is below the 0.3 mm that wire-edm can make",
        ),
        (
            "wire-edm",
            "wire-edm\nmounting: {dowels: {count: 80, radius: 1.5 mm}}",
            "spec.yaml:15:28: mounting.dowels.count: 80 dowels of radius 1.5 mm overlap on the "
            "outer edge",
        ),
        (
            "wire-edm",
            "wire-edm\noptimiser: {control_points: 2}",
            "spec.yaml:15:29: optimiser.control_points: has a meaning with form: control-points "
            "only",
        ),
    ],
)
def test_a_broken_rule_between_keys_stands_at_its_key(
    tmp_path: Path, old: str, new: str, line: str
) -> None:
    assert problems(tmp_path, changed(old, new)) == [line]


def test_all_problems_come_at_once_in_the_order_of_the_file(tmp_path: Path) -> None:
    text = (
        MINIMAL.replace("stiffness: 150 N*m/rad", "stifness: 150 N*m/rad")
        .replace("root_radius: 31 mm", "root_radius: 34 mm")
        .replace("thickness: 4.5 mm", "thickness: 4.5\n  thickness: 5 mm")
        .replace("count: 24", "count: yes")
        .replace("912 MPa", "&s 912 MPa")
    )
    assert [line.split(": ", 2)[:2] for line in problems(tmp_path, text)] == [
        ["spec.yaml:5:3", "target.stifness"],
        ["spec.yaml:9:16", "envelope.root_radius"],
        ["spec.yaml:11:14", "envelope.thickness"],
        ["spec.yaml:12:3", "envelope.thickness"],
        ["spec.yaml:13:19", "flexures.count"],
        ["spec.yaml:14:43", "material.design_stress"],
    ]


def test_a_rule_waits_only_for_the_keys_it_needs(tmp_path: Path) -> None:
    text = MINIMAL.replace("contact_radius: 6 mm", "contact_radius: 6").replace("31 mm", "34 mm")
    keys = [line.split(": ")[1] for line in problems(tmp_path, text)]
    assert keys == ["envelope.root_radius", "envelope.contact_radius"]


def test_with_an_unknown_kind_only_common_keys_are_judged(tmp_path: Path) -> None:
    text = MINIMAL.replace("kind: rotary-flexure", "kind: bicycle").replace("knee-s2", "-x")
    keys = [line.split(": ")[1] for line in problems(tmp_path, text)]
    assert keys == ["kind", "name"]


def test_a_thousand_mistakes_give_a_hundred_lines_and_say_so(tmp_path: Path) -> None:
    lines = problems(tmp_path, MINIMAL + "".join(f"extra{i}: 1\n" for i in range(1000)))
    assert len(lines) == 101
    assert lines[-1].endswith("and more problems after this")


def test_overrides_are_judged_like_the_file_and_named_as_what_they_are(tmp_path: Path) -> None:
    assert problems(
        tmp_path,
        MINIMAL,
        "envelope.outer_radus=30 mm",
        "flexures.count=two",
        "target.stiffness",
        "process.name=laser",
        "name=*x",
        "camshaft={backlash: *x}",
        "optimiser.starts=",
        "a..b=1",
    ) == [
        "--set:1:1: write key=value, as in flexures.count=24; got target.stiffness",
        "--set:1:1: process.name: process is a value, not a section",
        "--set:1:1: name: aliases (*) are not accepted",
        "--set:1:1: camshaft.backlash: aliases (*) are not accepted",
        "--set:1:1: optimiser.starts: holds nothing",
        "--set:1:1: write key=value, as in flexures.count=24; got a..b=1",
        "--set:1:1: envelope.outer_radus: unknown key; did you mean outer_radius?",
        "--set:1:1: flexures.count: must be a whole number or auto",
    ]


@pytest.mark.parametrize(
    ("content", "line"),
    [
        (b"", "spec.yaml:1:1: holds nothing"),
        (b"# only a comment\n", "spec.yaml:1:1: holds nothing"),
        (b"\x7fELF\0\0", "spec.yaml:1:1: is not a text file (it holds null bytes)"),
        (
            b"kind: x\nname: caf\xe9\n",
            "spec.yaml:2:10: is not UTF-8 text: the byte 0xE9 is no part of a character",
        ),
        (
            b"\xef\xbb\xbfn: \xc3\xa9\nname: caf\xe9\n",
            "spec.yaml:2:10: is not UTF-8 text: the byte 0xE9 is no part of a character",
        ),
        (b"# " + b"x" * (1 << 18), "spec.yaml:1:1: larger than 256 KiB"),
        (
            b"- a\n- b\n",
            "spec.yaml:1:1: a spec is a list of keys with values, such as `kind: rotary-flexure`",
        ),
        (
            b"just text",
            "spec.yaml:1:1: a spec is a list of keys with values, such as `kind: rotary-flexure`",
        ),
    ],
)
def test_what_is_not_a_spec_at_all_gives_one_line(
    tmp_path: Path, content: bytes, line: str
) -> None:
    path = tmp_path / "spec.yaml"
    path.write_bytes(content)
    with pytest.raises(SpecError) as caught:
        read_spec(path)
    assert str(caught.value).replace(str(path), "spec.yaml") == line


def test_a_missing_file_and_a_folder_give_one_line(tmp_path: Path) -> None:
    for path, reason in (
        (tmp_path / "none.yaml", "cannot be read: No such file or directory"),
        (tmp_path, "is a folder, not a file"),
        (Path("/dev/null"), "is not a regular file"),
        (tmp_path / "a\0b", "cannot be read: embedded null byte"),
    ):
        with pytest.raises(SpecError) as caught:
            read_spec(path)
        (problem,) = caught.value.problems
        assert problem.message == reason
        assert problem.file.isprintable()
