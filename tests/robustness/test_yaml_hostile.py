"""Hostile YAML is refused with a line and a column, before it can cost memory, time or stack."""

from __future__ import annotations

import resource
import subprocess
import sys
import unicodedata
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from springcad.errors import SpecError
from springcad.kinds.rotary_flexure.spec import TEMPLATE
from springcad.spec.source import Spec, read_spec

HEAD = "springcad: 1\nkind: rotary-flexure\nname: "


def read(folder: Path, text: str, *overrides: str) -> Spec | list[str]:
    """The spec, or the lines that a user would see with the folder left out."""
    path = folder / "spec.yaml"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    try:
        return read_spec(path, overrides)
    except SpecError as error:
        return [str(problem).replace(str(path), "spec.yaml") for problem in error.problems]


def refused(folder: Path, text: str) -> list[str]:
    """Problems of ``text``, without those of the keys that are missing."""
    lines = read(folder, text)
    assert isinstance(lines, list)
    return [line for line in lines if ": missing: " not in line]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("name: &a x", "spec.yaml:1:7: name: anchors (&) are not accepted"),
        ("&a name: x", "spec.yaml:1:1: anchors (&) and tags (!) are not accepted"),
        ("name: *a", "spec.yaml:1:7: name: aliases (*) are not accepted"),
        ("name: !!str x", "spec.yaml:1:7: name: tags (!) are not accepted"),
        ("name: !<x> y", "spec.yaml:1:7: name: tags (!) are not accepted"),
        ("name: ! y", "spec.yaml:1:7: name: tags (!) are not accepted"),
        ("envelope: !env {}", "spec.yaml:1:11: envelope: tags (!) are not accepted"),
        ("name: x\n---\nname: y", "spec.yaml:2:1: one file holds one spec"),
        ("%YAML 1.1\n---\nname: x", "spec.yaml:1:1: YAML directives are not accepted"),
        ("%TAG ! tag:x,2000:\n---\nname: x", "spec.yaml:1:1: YAML directives are not accepted"),
        ("name: x\nname: y", "spec.yaml:2:1: name: given a second time (first in line 1)"),
        ("{name: x, 'name': y}", "spec.yaml:1:11: name: given a second time (first in line 1)"),
        ("? [a, b]\n: 1", "spec.yaml:1:3: a key is a plain word"),
        ("? {a: b}\n: 1", "spec.yaml:1:3: a key is a plain word"),
        ("name: |\n  a\n  b", "spec.yaml:1:7: name: a value is a text on one line"),
        ('name: "a\\tb"', "spec.yaml:1:7: name: a value is a text on one line"),
        ("name: ~", "spec.yaml:1:1: name: is empty: give a value or leave the key out"),
        ("name: {", "spec.yaml:1:8: not valid YAML: "),
        ("name: 'x", "spec.yaml:1:9: not valid YAML: "),
        ("name: x: y", "spec.yaml:1:8: not valid YAML: "),
        ("\tname: x", "spec.yaml:1:1: not valid YAML: "),
        ("name: @x", "spec.yaml:1:7: not valid YAML: "),
        ('name: "\\U00110000"', "spec.yaml:1:1: not valid YAML: "),
    ],
)
def test_refused_with_its_place(tmp_path: Path, text: str, line: str) -> None:
    lines = refused(tmp_path, text)
    assert len(lines) == 1
    assert lines[0].startswith(line)


def test_a_merge_key_bomb_is_refused_at_its_anchors_aliases_and_merges(tmp_path: Path) -> None:
    levels = ["x0: &x0 {k: 1}"]
    levels += [
        f"x{n}: &x{n} {{<<: [{', '.join([f'*x{n - 1}'] * 9)}], k{n}: 1}}" for n in range(1, 9)
    ]
    bomb = "\n".join(levels)
    assert len(bomb) < 700
    lines = refused(tmp_path, bomb)
    assert "spec.yaml:1:5: x0: anchors (&) are not accepted" in lines
    assert "spec.yaml:2:10: x1: merge keys (<<) are not accepted" in lines


def test_an_alias_bomb_is_refused_at_each_alias(tmp_path: Path) -> None:
    levels = ["a: &a [x, x, x, x, x, x, x, x, x]"]
    levels += [
        f"{b}: &{b} [{', '.join([f'*{a}'] * 9)}]"
        for a, b in zip("abcdefgh", "bcdefghi", strict=True)
    ]
    lines = refused(tmp_path, "\n".join(levels))
    assert sum("aliases (*) are not accepted" in line for line in lines) == 72


@pytest.mark.parametrize("character", ["\x00", "\x07", "\x1b", "\x7f", "\x85", "\x9b"])
def test_control_characters_are_refused_raw_and_escaped(tmp_path: Path, character: str) -> None:
    raw = refused(tmp_path, f"{HEAD}a{character}b\n")
    expected = f"spec.yaml:3:8: the character U+{ord(character):04X} (control character)"
    if character == "\x00":
        expected = "spec.yaml:1:1: is not a text file (it holds null bytes)"
    assert raw[0].startswith(expected)
    (escaped,) = refused(tmp_path, f'{HEAD}"a\\x{ord(character):02x}b"\n')
    assert escaped.startswith(f"spec.yaml:3:7: name: the character U+{ord(character):04X}")


@pytest.mark.parametrize(
    "character", "\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\ufeff"
)
def test_bidirectional_characters_are_refused_everywhere(tmp_path: Path, character: str) -> None:
    name = unicodedata.name(character).lower()
    words = f"the character U+{ord(character):04X} ({name}) is not accepted"
    assert refused(tmp_path, f"{HEAD}a{character}b") == [f"spec.yaml:3:8: {words}"]
    assert refused(tmp_path, f"{HEAD}ab # c{character}") == [f"spec.yaml:3:13: {words}"]
    escaped = f'"a\\u{ord(character):04x}b"'
    assert refused(tmp_path, HEAD + escaped) == [f"spec.yaml:3:7: name: {words}"]
    assert refused(tmp_path, f"{HEAD}x\n{escaped}: 1") == [f"spec.yaml:4:1: {words}"]


def test_half_a_surrogate_pair_is_refused(tmp_path: Path) -> None:
    (line,) = refused(tmp_path, HEAD + '"\\ud800"')
    assert line.startswith("spec.yaml:3:7: name: the character U+D800")
    (line,) = refused(tmp_path, HEAD + "\ud800")
    assert line == "spec.yaml:3:7: is not UTF-8 text: the byte 0xED is no part of a character"


@pytest.mark.parametrize("word", ["nan", "NaN", ".nan", "inf", "-inf", ".inf", "-.Inf", "Infinity"])
def test_what_is_not_finite_is_refused_as_number_and_in_a_quantity(
    tmp_path: Path, word: str
) -> None:
    text = TEMPLATE.replace("bend_limit: 0.4 ", f"bend_limit: {word} ")
    text = text.replace("thickness: 4.5 mm", f"thickness: {word} mm", 1)
    lines = refused(tmp_path, text)
    assert [line.split(": ", 1)[1] for line in lines] == [
        "envelope.thickness: must be a finite number",
        "flexures.bend_limit: must be a finite number",
    ]


def test_numbers_are_those_of_yaml_1_2(tmp_path: Path) -> None:
    """PyYAML reads these four as text, False, 10 and 750."""
    for text, value in (
        ("1e5", 1e5),
        ("200e9", 200e9),
        ("no", "no"),
        ("012", 12),
        ("12:30", "12:30"),
        ("0o14", 12),
        ("0x1F", 31),
        ("1_000", "1_000"),
        ("2026-11-22", "2026-11-22"),
        ("'12'", "12"),
        ("true", True),
        ("yes", "yes"),
        (".5", 0.5),
        ("1.", 1.0),
        ("=", "="),
    ):
        spec = read(tmp_path, TEMPLATE, f"optimiser.seed={text}")
        if type(value) is int:
            assert isinstance(spec, Spec)
            assert spec.raw["optimiser"]["seed"] == value
        else:
            assert spec == [
                f"--set:1:1: optimiser.seed: must be a whole number, is {value!r}",
            ]


@pytest.mark.parametrize("seed", ["9" * 4000, "-1", "4294967296", "1e999"])
def test_huge_numbers_are_refused(tmp_path: Path, seed: str) -> None:
    lines = read(tmp_path, TEMPLATE, f"optimiser.seed={seed}")
    assert isinstance(lines, list)
    (line,) = lines
    assert line.startswith("--set:1:1: optimiser.seed: must be")
    assert len(line) < 120


UNKNOWN = "unknown key; did you mean"
LIMITS = {
    "file": ("# " + "x" * (1 << 18), "larger than 256 KiB"),
    "brackets in one line": ("[" * 100_000, "line of more than 4096 characters"),
    "braces in one line": ("a: " + "{" * 100_000, "line of more than 4096 characters"),
    "brackets in many lines": ("[\n" * 19_999, "nested deeper than 32 levels"),
    "braces in many lines": ("{\n" * 19_999, "nested deeper than 32 levels"),
    "mappings": ("\n".join(" " * n + "a:" for n in range(500)), "nested deeper than 32 levels"),
    "questions": ("? " * 2000, "nested deeper than 32 levels"),
    "events": ("[" + ("1," * 10 + "\n") * 2500 + "1]", "too many values for a spec"),
    "lines": ("\n" * 260_000, "more than 20000 lines"),
    "comments": ("# x\n" * 60_000, "more than 20000 lines"),
    "line": ("a: " + "x" * 260_000, "line of more than 4096 characters"),
    "scalar": ("a: |\n" + (" " + "x" * 10 + "\n") * 19_900, "text of more than 4096 characters"),
    "quoted": ('a: "' + ("x" * 10 + "\n ") * 19_000 + '"', "text of more than 4096 characters"),
    "long key": ('"' + ("x" * 4000 + "\n ") * 2 + '": 1', "text of more than 4096 characters"),
    "unknown keys": (HEAD + "x\n" + "".join(f"proces{n}: 1\n" for n in range(9_900)), UNKNOWN),
    "long keys": (HEAD + "x\n" + "".join(f"{'x' * 15}{n}: 1\n" for n in range(9_900)), "unknown"),
    "duplicates": (HEAD + "x\n" + "name: x\n" * 9_900, "name: given a second time"),
    "anchors": (HEAD + "x\n" + "".join(f"a{n}: &a 1\n" for n in range(9_900)), "anchors (&)"),
    "control characters": ("\x07" * 260_000, "U+0007"),
}


@pytest.mark.parametrize("case", LIMITS)
def test_large_and_deep_input_is_refused_in_little_memory(tmp_path: Path, case: str) -> None:
    """In a process of its own: below 200 MB, and no array library for a spec that is refused."""
    text, reason = LIMITS[case]
    path = tmp_path / "spec.yaml"
    path.write_text(text, encoding="utf-8")
    code = (
        "import sys\n"
        "from pathlib import Path\n"
        "from springcad.errors import SpecError\n"
        "from springcad.spec.source import read_spec\n"
        "try:\n"
        "    read_spec(Path(sys.argv[1]))\n"
        "except SpecError as error:\n"
        "    print(error)\n"
        "status = Path('/proc/self/status').read_text()\n"
        "print(status.split('VmHWM:')[1].split()[0])\n"
        "print(sorted({'numpy', 'scipy', 'ezdxf', 'shapely', 'rich'} & set(sys.modules)))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(path)],
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30)),
    )
    *problems, memory, modules = done.stdout.splitlines()
    assert any(reason in problem for problem in problems)
    assert len(problems) <= 101
    assert max(map(len, problems)) < 400
    assert int(memory) < 200_000
    assert modules == "[]"


LINES = TEMPLATE.splitlines(keepends=True)
PIECES = st.sampled_from(
    [
        *LINES,
        "&a ",
        "*a",
        "<<: ",
        "!!x ",
        "{",
        "}",
        "[",
        "]",
        "- ",
        "? ",
        ": ",
        "|\n",
        '"',
        "'",
        "\n",
    ]
)


@settings(
    deadline=None, max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.text(max_size=60) | st.lists(PIECES, max_size=30).map("".join))
def test_any_text_is_a_spec_or_a_spec_error(tmp_path: Path, text: str) -> None:
    result = read(tmp_path, text)
    if isinstance(result, list):
        assert result
        assert all(line.isprintable() and line.startswith("spec.yaml:") for line in result)


@settings(
    deadline=None, max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.data())
def test_a_damaged_template_is_a_spec_or_a_spec_error(tmp_path: Path, data: st.DataObject) -> None:
    start = data.draw(st.integers(0, len(TEMPLATE)))
    stop = data.draw(st.integers(start, min(len(TEMPLATE), start + 40)))
    text = TEMPLATE[:start] + data.draw(st.text(max_size=8)) + TEMPLATE[stop:]
    result = read(tmp_path, text)
    assert isinstance(result, Spec) or all(line.isprintable() for line in result)


@settings(
    deadline=None, max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.binary(max_size=60))
def test_any_bytes_are_refused_with_a_spec_error(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "spec.yaml"
    path.write_bytes(content)
    with pytest.raises(SpecError) as caught:
        read_spec(path)
    assert str(caught.value).replace("\n", "").isprintable()


@settings(
    deadline=None, max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    st.text(max_size=40)
    | st.builds(
        "{}={}".format,
        st.sampled_from(["name", "process", "target", "flexures.count", "envelope.thickness.x"]),
        st.text(max_size=30),
    )
)
def test_any_override_is_taken_or_refused(tmp_path: Path, override: str) -> None:
    result = read(tmp_path, TEMPLATE, override)
    assert isinstance(result, Spec) or all(line.isprintable() for line in result)
