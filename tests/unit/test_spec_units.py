"""Quantities: what is read, and what is refused with which words."""

from __future__ import annotations

import math
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from springcad.spec.units import (
    ANGLE,
    DENSITY,
    LENGTH,
    STIFFNESS,
    STRESS,
    Dimension,
    parse_quantity,
    show,
)


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("33.5 mm", LENGTH, 0.0335),
        ("33.5mm", LENGTH, 0.0335),
        ("  33.5  mm ", LENGTH, 0.0335),
        ("+3.35 cm", LENGTH, 0.0335),
        ("3.35e1 mm", LENGTH, 0.0335),
        (".0335 m", LENGTH, 0.0335),
        ("2. um", LENGTH, 2e-6),
        ("2 µm", LENGTH, 2e-6),  # U+00B5, on keyboards
        ("2 μm", LENGTH, 2e-6),  # U+03BC, the Greek letter
        ("1 in", LENGTH, 0.0254),
        ("14.5 deg", ANGLE, 14.5 * math.pi / 180),
        ("14.5°", ANGLE, 14.5 * math.pi / 180),
        ("0.25 rad", ANGLE, 0.25),
        ("912 MPa", STRESS, 912e6),
        ("912 N/mm^2", STRESS, 912e6),
        ("912 N/mm**2", STRESS, 912e6),
        ("912 N/mm2", STRESS, 912e6),
        ("912 N/mm²", STRESS, 912e6),
        ("912 N mm^-2", STRESS, 912e6),
        ("0.912 GPa", STRESS, 912e6),
        ("1 psi", STRESS, 4.4482216152605 / 0.0254**2),
        ("132 ksi", STRESS, 132e3 * 4.4482216152605 / 0.0254**2),
        ("150 N*m/rad", STIFFNESS, 150.0),
        ("150 N m/rad", STIFFNESS, 150.0),
        ("150 Nm/rad", STIFFNESS, 150.0),
        ("150 N·m/rad", STIFFNESS, 150.0),
        ("150 N * m / rad", STIFFNESS, 150.0),
        ("150 (N*m)/rad", STIFFNESS, 150.0),
        ("150 J/rad", STIFFNESS, 150.0),
        ("150000 N*mm/rad", STIFFNESS, 150.0),
        ("2.6 N*m/deg", STIFFNESS, 2.6 * 180 / math.pi),
        ("7.7 g/cm^3", DENSITY, 7700.0),
        ("7700 kg/m3", DENSITY, 7700.0),
    ],
)
def test_accepted_spellings(text: str, dimension: Dimension, value: float) -> None:
    assert parse_quantity(text, dimension) == pytest.approx(value, rel=2e-16)


@pytest.mark.parametrize(
    ("text", "dimension", "words"),
    [
        ("33.5", LENGTH, "needs a unit, for example 33.5 mm"),
        ("150", STIFFNESS, "needs a unit, for example 150 N*m/rad"),
        ("mm", LENGTH, "mm is not a number with a unit, for example 33.5 mm"),
        ("", LENGTH, " is not a number with a unit, for example 33.5 mm"),
        ("1.2.3 mm", LENGTH, "1.2.3 mm is not a number with a unit, for example 33.5 mm"),
        (
            "33,5 mm",
            LENGTH,
            "write the decimal sign as a point and no thousands sign, for example 33.5 mm",
        ),
        ("33.5 MM", LENGTH, "unknown unit MM; did you mean mm?"),
        ("33.5 inch", LENGTH, "unknown unit inch; did you mean in?"),
        ("33.5 ms", LENGTH, "unknown unit ms; did you mean m?"),
        ("912 mpa", STRESS, "unknown unit mpa; did you mean MPa?"),
        ("150 nm/rad", STIFFNESS, "unknown unit nm; did you mean Nm?"),
        ("14.5 degrees", ANGLE, "unknown unit degrees; did you mean deg?"),
        ("20 degC", ANGLE, "unknown unit degC; did you mean deg?"),
        ("33.5 furlong", LENGTH, "unknown unit furlong; write mm, cm, m, um"),
        ("33.5 MPa", LENGTH, "33.5 MPa is a stress, expected a length (mm, cm, m, um)"),
        ("14.5 mm", ANGLE, "14.5 mm is a length, expected an angle (deg, rad)"),
        ("5 mm^2", LENGTH, "5 mm^2 has the wrong unit, expected a length (mm, cm, m, um)"),
        (
            "150 N*m",
            STIFFNESS,
            "150 N*m is a torque; a stiffness is per rad or per deg, as in N*m/rad",
        ),
        (
            "150 N/m",
            STIFFNESS,
            "150 N/m has the wrong unit, expected a torsional stiffness "
            "(N*m/rad, N*m/deg, Nm/rad, Nm/deg)",
        ),
        ("nan mm", LENGTH, "must be a finite number"),
        ("-inf mm", LENGTH, "must be a finite number"),
        (".inf mm", LENGTH, "must be a finite number"),
        ("1e999 mm", LENGTH, "must be a finite number"),
        ("9**9**9", LENGTH, "cannot read the unit **9**9; write mm, cm, m, um"),
        ("9 mm**9**9", LENGTH, "cannot read the unit mm**9**9; write mm, cm, m, um"),
        ("9 mm^99", LENGTH, "cannot read the unit mm^99; write mm, cm, m, um"),
        ("9 (((mm)))", LENGTH, "cannot read the unit (((mm))); write mm, cm, m, um"),
        ("9 mm +", LENGTH, "cannot read the unit mm +; write mm, cm, m, um"),
        (
            "9 __import__('os')",
            LENGTH,
            "cannot read the unit __import__('os'); write mm, cm, m, um",
        ),
        (
            "9 " + "mm*" * 99 + "mm",
            LENGTH,
            "is too long for a number with a unit, for example 33.5 mm",
        ),
    ],
)
def test_refused_with_a_reason(text: str, dimension: Dimension, words: str) -> None:
    with pytest.raises(ValueError) as caught:  # noqa: PT011
        parse_quantity(text, dimension)
    assert str(caught.value) == words


@pytest.mark.parametrize("dimension", [LENGTH, ANGLE, STRESS, STIFFNESS, DENSITY])
@settings(deadline=None)
@given(st.floats(min_value=1e-6, max_value=1e6))
def test_a_value_written_in_any_usual_unit_and_read_again_is_the_same(
    dimension: Dimension, value: float
) -> None:
    for unit in dimension.units:
        one = parse_quantity(f"1 {unit}", dimension)
        assert parse_quantity(f"{value / one!r} {unit}", dimension) == pytest.approx(
            value, rel=1e-15
        )
    shown = parse_quantity(show(value, dimension), dimension)
    assert shown == pytest.approx(value, rel=1e-5)


@settings(deadline=None)
@given(st.integers(min_value=-999_999, max_value=999_999), st.integers(min_value=0, max_value=5))
def test_decimal_digits_are_kept_exactly(digits: int, places: int) -> None:
    text = f"{digits}e-{places}"
    assert parse_quantity(f"{text} mm", LENGTH) == float(f"{digits}e-{places + 3}")
    assert parse_quantity(f"{text} GPa", STRESS) == float(f"{digits}e{9 - places}")


def outcome(text: str) -> float | str:
    """The length, or why it is none."""
    try:
        return parse_quantity(text, LENGTH)
    except ValueError as error:
        return str(error)


@settings(deadline=None)
@given(
    st.text(max_size=80)
    | st.from_regex(r"[mNP][a-zA-Z()*/^0-9 -]{0,12}", fullmatch=True)
    | st.lists(st.sampled_from(["mm", "m^2", "N/", "*", "/", "(", ")", "^-2", " "])).map("".join)
)
def test_any_text_is_a_finite_length_or_refused_in_printable_words(text: str) -> None:
    for result in (outcome(text), outcome(f"3 {text}")):
        assert result.isprintable() if isinstance(result, str) else math.isfinite(result)


def test_reading_a_quantity_loads_no_array_library_and_spoils_none() -> None:
    code = (
        "import sys\n"
        "from springcad.spec.units import LENGTH, parse_quantity\n"
        "assert 'pint' not in sys.modules\n"
        "assert parse_quantity('33.5 mm', LENGTH) == 0.0335\n"
        "assert not {'numpy', 'scipy'} & set(sys.modules)\n"
        "import numpy\n"
        "assert numpy.sqrt(4.0) == 2.0\n"
        "assert parse_quantity('4.5 mm', LENGTH) == 0.0045\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
