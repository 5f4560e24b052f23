"""People read millimetres, degrees and megapascals, with four digits and never a stray power."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from report_example import example_result

from springcad.report.display import (
    format_apart,
    format_check,
    format_deviation,
    format_number,
    format_value,
    printable,
    typeset,
)
from springcad.report.entries import entries, spec_lines
from springcad.report.verdict import verdict
from springcad.result import Outcome, check


@pytest.mark.parametrize(
    ("value", "unit", "shown"),
    [
        (math.radians(14.5), "rad", "14.50 deg"),
        (-math.radians(14.5), "rad", "-14.50 deg"),
        (0.0335, "m", "33.50 mm"),
        (1.198e-3, "m", "1.198 mm"),
        (2e-6, "m", "0.002000 mm"),
        (912e6, "Pa", "912.0 MPa"),
        (199.95e9, "Pa", "199950 MPa"),
        (0.071, "kg", "71.00 g"),
        (150.0, "N*m/rad", "150.0 N*m/rad"),
        (37.958, "N*m", "37.96 N*m"),
        (4.7561, "J", "4.756 J"),
        (263.98, "N", "264.0 N"),
        (8000.0, "N/m", "8.000 N/mm"),
        (12.0, "s", "12.00 s"),
        (24, "1", "24"),
        (1.0, "1", "1"),
        (0.53, "1", "0.5300"),
        (1e5, "1", "100000"),
        (1e9, "1", "1.000e9"),
        (9.99996e-3, "m", "10.00 mm"),
        (0.0, "m", "0 mm"),
        (-0.0, "rad", "0 deg"),
        (3.2e-13, "m", "3.200e-10 mm"),
        (math.nan, "Pa", "not computed"),
        (math.inf, "1", "infinite"),
        (np.float64(0.0045), "m", "4.500 mm"),
    ],
)
def test_si_numbers_are_shown_in_the_units_of_the_workshop(value, unit, shown):
    assert format_value(value, unit) == shown


@pytest.mark.parametrize("exponent", range(-3, 7))
def test_numbers_of_normal_parts_show_four_digits_and_no_power_of_ten(exponent):
    shown = format_number(1.2346 * 10.0**exponent)
    assert "e" not in shown
    assert float(shown) == pytest.approx(1.2346 * 10.0**exponent, rel=5e-4)
    assert len(shown.replace(".", "").lstrip("0")) >= 4


def test_a_broken_limit_never_looks_like_a_kept_one():
    over = check("stress", 912.0004e6, "<=", 912e6, "Pa", source="beam")
    assert format_check(over) == ("912.0004 MPa", "912.0000 MPa")
    barely = check("strain factor", 1.00004, "<=", 1, "1", source="law")
    assert format_check(barely) == ("1.00004", "1")


def test_what_falls_short_of_a_limit_does_not_look_like_it():
    assert format_apart(0.012210, 0.012212, "J") == ("0.012210 J", "0.012212 J")
    assert format_apart(2.0, 2.0, "J") == ("2.000 J", "2.000 J")


def test_a_limit_kept_to_the_last_digit_is_shown_without_noise():
    at_the_limit = check("z", 0.3 - 1e-12, "<=", 0.3, "1", source="beam")
    assert format_check(at_the_limit) == ("0.3000", "0.3000")


@pytest.mark.parametrize(
    ("value", "target", "shown"),
    [
        (148.5, 150.0, "-1.00 %"),
        (151.0, 150.0, "+0.67 %"),
        (150.0 - 1e-9, 150.0, "0.00 %"),
        (-1.1, -1.0, "-10.00 %"),
        (1.0, None, ""),
        (1.0, 0.0, ""),
        (math.nan, 1.0, ""),
    ],
)
def test_deviation_from_the_target_is_in_per_cent_with_its_sign(value, target, shown):
    assert format_deviation(Outcome("stiffness", value, "N*m/rad", target)) == shown


def test_print_gets_its_own_signs_and_no_line_break_in_a_quantity():
    assert typeset("-1.5 N*m") == "\N{MINUS SIGN}1.5\N{NO-BREAK SPACE}N\N{MIDDLE DOT}m"


def test_text_that_steers_a_terminal_or_turns_a_line_around_is_defused():
    shown = printable("a\x1b[2Jb\x07\u202ec\ud800\n\N{NO-BREAK SPACE}µ")
    assert shown == "a\ufffd[2Jb\ufffd\ufffdc\ufffd\n\N{NO-BREAK SPACE}µ"


def test_the_verdict_is_the_worst_status_and_names_what_is_open_failures_first():
    judged = verdict(example_result().checks)
    assert (judged.status, judged.text) == ("fail", "1 of 15 checks fails, 2 more warn")
    assert [c.status for c in judged.open] == ["fail", "warn", "warn"]


def test_the_verdict_speaks_plainly_of_any_count():
    ok = check("gap", 1.0, ">=", 0.5, "m", source="polygons")
    bad, doubtful = replace(ok, status="fail"), replace(ok, status="warn")
    assert verdict([ok] * 14).text == "All 14 checks pass"
    assert verdict([ok]).text == "The only check passes"
    assert verdict([bad]).text == "The only check fails"
    assert verdict([bad, bad, doubtful]).text == "2 of 3 checks fail, 1 more warns"
    assert verdict([ok, doubtful]).text == "No check fails, 1 of 2 warns"
    assert verdict([ok, doubtful, doubtful]).text == "No check fails, 2 of 3 warn"
    assert (verdict([]).status, verdict([]).text) == ("warn", "Nothing was checked")


def test_keys_of_a_mapping_become_words_and_their_unit_suffix_a_unit():
    mapping = {
        "stiffness_Nm_per_rad": 148.5,
        "contact_radius_m": 6e-3,
        "torque_Nm": 37.58,
        "flexure_count": 24,
        "outline_valid": True,
        "second_opinion": None,
        "libraries": {"numpy": "2.3.5"},
        "angles_rad": [0.0, math.radians(2)],
        "curve_m": np.zeros(59),
    }
    assert dict(entries(mapping)) == {
        "stiffness": typeset("148.5 N*m/rad"),
        "contact radius": typeset("6.000 mm"),
        "torque": typeset("37.58 N*m"),
        "flexure count": "24",
        "outline valid": "yes",
        "second opinion": "not computed",
        "libraries: numpy": "2.3.5",
        "angles": typeset("0 deg") + ", " + typeset("2.000 deg"),
        "curve": "59 values",
    }


def test_the_spec_is_shown_as_it_was_typed():
    spec = {"target": {"deflection": "14.50 deg"}, "life": {"cycles": 1e5}, "tips": [1, 2]}
    assert spec_lines(spec) == [
        "target:",
        "  deflection: 14.50 deg",
        "life:",
        "  cycles: 100000.0",
        "tips: [1, 2]",
    ]
