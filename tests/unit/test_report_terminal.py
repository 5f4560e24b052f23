"""The terminal keeps every number and every remedy at any width, and reads no text as markup."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from report_example import FILES, example_result
from rich.console import Console

from springcad.report.display import format_check, format_value
from springcad.report.terminal import print_checks, print_result
from springcad.result import check

PATHS = [Path("out/s2") / name for name in FILES]


def printed(result, width=80, paths=PATHS, **options):
    file = io.StringIO()
    print_result(result, paths, Console(file=file, width=width, **options))
    return file.getvalue()


def words(text):
    return " ".join(text.split())


@pytest.mark.parametrize("width", [48, 60, 80, 200])
def test_every_number_and_remedy_stands_in_full(width):
    result = example_result()
    text = printed(result, width)
    for claim in result.checks:
        value, limit = format_check(claim)
        assert value in text
        assert f"{claim.sense} {limit}" in text
        assert claim.remedy in words(text)
    for outcome in result.outcomes:
        assert format_value(outcome.value, outcome.unit) in text
    for sentence in (*result.assumptions, *result.advice):
        assert sentence in words(text)
    assert max(map(len, text.splitlines())) <= width
    assert "…" not in text


def test_the_verdict_is_the_first_line_and_the_files_are_the_last():
    lines = printed(example_result()).splitlines()
    assert lines[0].rstrip() == "s2 (rotary-flexure): 1 of 15 checks fails, 2 more warn"
    assert [line.strip() for line in lines[-len(FILES) :]] == list(FILES)
    assert lines[-len(FILES) - 1].strip() == f"Files in {Path('out/s2')}"


def test_targets_stand_beside_results_with_their_deviation():
    row = next(line for line in printed(example_result()).splitlines() if "148.5" in line)
    assert row.split()[-5:] == ["N*m/rad", "150.0", "N*m/rad", "-1.00", "%"]


def test_remedies_stand_only_for_checks_that_do_not_pass():
    result = example_result()
    text = printed(example_result(checks=tuple(c for c in result.checks if c.status == "pass")))
    assert "All 12 checks pass" in text
    assert "What to change" not in text


def test_without_a_terminal_there_is_no_colour_and_with_one_there_is():
    assert "\x1b" not in printed(example_result())
    assert "\x1b[1;31m" in printed(example_result(), force_terminal=True, color_system="standard")


def test_markup_and_control_characters_in_texts_stay_text():
    hostile = "[bold red]x[/] :smile: {{7*7}} \x1b[2J\u202e"
    claim = check(hostile, 1.0, "<=", 0.5, "m", source=hostile, remedy=hostile)
    result = example_result(
        name=hostile, checks=(claim,), assumptions=(hostile,), advice=(hostile,)
    )
    text = printed(result, 200, paths=[Path(hostile)])
    assert text.count("[bold red]x[/] :smile: {{7*7}} \ufffd[2J\ufffd") >= 6
    assert "\x1b" not in text


def test_a_name_without_spaces_is_folded_and_takes_no_room_from_the_numbers():
    name = "n" * 64
    claim = check(name, 0.253, "<=", 0.2, "rad", source="test", remedy="r" * 100)
    file = io.StringIO()
    print_checks([claim], "Checks", Console(file=file, width=60))
    text = file.getvalue()
    assert "14.50 deg" in text
    assert "<= 11.46 deg" in text
    assert text.count("n") - text.count("change") - text.count("not") >= 64
    assert text.count("r") >= 100


def test_paths_are_never_broken_since_they_are_copied():
    path = Path("folder" * 20) / ("name" * 15)
    assert f"Files in {path.parent}\n" in printed(example_result(), 60, paths=[path])
    other = Path("elsewhere/report.json")
    assert f"  {path}\n  {other}\n" in printed(example_result(), 60, paths=[path, other])


def test_a_console_that_knows_ascii_only_gets_the_report_all_the_same():
    raw = io.BytesIO()
    file = io.TextIOWrapper(raw, encoding="ascii", errors="strict", newline="\n")
    result = example_result(advice=("raise the radius to ≥ 27.3 mm",))
    print_result(result, PATHS, Console(file=file, width=80))
    file.flush()
    text = raw.getvalue().decode("ascii")
    assert "raise the radius to ? 27.3 mm" in text
    assert "148.5 N*m/rad" in text


def test_no_checks_print_no_table():
    file = io.StringIO()
    print_checks([], "Preflight", Console(file=file))
    assert file.getvalue() == ""
