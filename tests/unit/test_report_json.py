"""report.json: the keys that scripts rely on, finite numbers, the same bytes everywhere."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from report_example import FILES, example_result

from springcad import __version__
from springcad.report.json_report import result_to_dict, result_to_json

TOP_LEVEL = [
    "springcad",
    "kind",
    "name",
    "verdict",
    "spec",
    "design",
    "response",
    "checks",
    "outcomes",
    "verification",
    "assumptions",
    "advice",
    "files",
    "provenance",
]
CHECK_KEYS = ["name", "value", "limit", "unit", "sense", "status", "source", "remedy"]


def strict_loads(text):
    """JSON as RFC 8259 knows it: Python's NaN and Infinity are refused."""

    def refuse(token):
        raise AssertionError(f"{token} is not JSON")

    return json.loads(text, parse_constant=refuse)


@pytest.fixture(scope="module")
def text():
    return result_to_json(example_result(), FILES)


def test_keys_come_in_the_promised_order(text):
    report = strict_loads(text)
    assert list(report) == TOP_LEVEL
    assert all(list(entry) == CHECK_KEYS for entry in report["checks"])
    assert report["springcad"] == __version__
    assert report["verdict"] == {"status": "fail", "text": "1 of 15 checks fails, 2 more warn"}
    assert report["files"] == FILES


def test_the_file_holds_the_same_as_the_dict(text):
    assert strict_loads(text) == result_to_dict(example_result(), FILES)


def test_a_number_that_is_missing_is_null(text):
    report = strict_loads(text)
    assert report["response"]["finite_element_stiffness_Nm_per_rad"] is None
    assert next(c for c in report["checks"] if "finite" in c["name"])["value"] is None


def test_arrays_are_lists_on_one_line_and_keep_their_values(text):
    angle = example_result().response["angle_rad"]
    assert strict_loads(text)["response"]["angle_rad"] == pytest.approx(angle, rel=1e-11)
    assert '"curvature_coefficients": [12.5, -80.0, 150.25, -0.333333333333, 0.0, 0.0]' in text


def test_two_dimensional_arrays_keep_their_shape():
    points = np.array([[0.0, 1e-3], [np.inf, -0.0]])
    text = result_to_json(example_result(design={"points_m": points}), {})
    assert strict_loads(text)["design"]["points_m"] == [[0.0, 0.001], [None, 0.0]]
    assert "      [0.0, 0.001],\n      [null, 0.0]\n    ]" in text


@given(st.floats(allow_nan=False, allow_infinity=False), st.integers(-1, 1))
def test_numbers_survive_to_twelve_digits_and_the_last_bit_does_not_show(value, ulps):
    rounded = float(f"{value:.11e}")
    noisy = rounded + ulps * np.spacing(rounded) if np.isfinite(rounded) else rounded
    plain = [
        result_to_dict(example_result(design={"x": x}), {})["design"]["x"] for x in (rounded, noisy)
    ]
    if abs(rounded) > 1e-290:
        assert plain[0] == plain[1]
    assert plain[0] == pytest.approx(value, rel=1e-11)
    assert str(plain[0]) != "-0.0"


def test_whole_numbers_and_truths_stay_what_they_are():
    design = {"count": np.int64(24), "valid": np.bool_(True), "seed": 2**62 + 1, "none": None}
    text = result_to_json(example_result(design=design), {})
    assert strict_loads(text)["design"] == {
        "count": 24,
        "valid": True,
        "seed": 2**62 + 1,
        "none": None,
    }
    assert '"count": 24,' in text


def test_the_text_is_the_same_every_time_and_ends_with_a_newline(text):
    assert text == result_to_json(example_result(), FILES)
    assert text.endswith("}\n")
    assert "\r" not in text


def test_any_string_can_be_written_as_utf8():
    name = 'µ "quoted" \\ \x1b \ud800 </script>'
    text = result_to_json(example_result(name=name), {})
    assert json.loads(text.encode("utf-8"))["name"] == name


def test_an_empty_result_is_still_json():
    report = strict_loads(
        result_to_json(example_result(checks=(), outcomes=(), design={}, advice=()), {})
    )
    assert (report["checks"], report["design"], report["files"]) == ([], {}, {})


def test_what_json_cannot_hold_is_a_bug_and_not_a_string():
    with pytest.raises(TypeError, match="complex"):
        result_to_dict(example_result(design={"x": 1j}), {})
