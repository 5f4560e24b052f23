"""Formulas of the calculation sheet: their values, what they refuse, and how they are written."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given as hypothesis_given
from hypothesis import strategies

from springcad.formula import FormulaError, evaluate, renamed, symbols
from springcad.report.formula_text import formula_text, numbers_text, symbol_text

VALUES = {"a": 2.0, "b": 0.3, "c": -1.7, "theta_1": 0.9}


def test_a_formula_has_the_value_that_python_gives_it():
    formula = "(a + b)*sin(theta_1)**2/sqrt(a) - c**-2 + min(a, b, 7)*pi"
    expected = 2.3 * math.sin(0.9) ** 2 / math.sqrt(2) - (-1.7) ** -2 + 0.3 * math.pi
    assert evaluate(formula, VALUES) == pytest.approx(expected, rel=1e-15)
    assert symbols(formula) == ("a", "b", "theta_1", "c")


@pytest.mark.parametrize(
    "formula", ["sqrt(c)", "1/(a - a)", "asin(a)", "(c)**0.5", "exp(1e9)", "log(0)"]
)
def test_what_has_no_value_is_not_a_number(formula):
    assert math.isnan(evaluate(formula, VALUES))


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os')",
        "a.real",
        "a if b else c",
        "[a]",
        "'a'",
        "True",
        "lambda: a",
        "sin(x=a)",
        "open(a)",
        "a < b",
        "1j",
        "a b",
        "",
        "a @ b",
        "(a := 1)",
    ],
)
def test_nothing_but_arithmetic_is_a_formula(text):
    with pytest.raises(FormulaError):
        evaluate(text, {**VALUES, "open": 1.0})


def test_a_symbol_without_a_value_is_told():
    with pytest.raises(FormulaError, match="k has no value"):
        evaluate("k*a", VALUES)


def test_renaming_leaves_functions_numbers_and_longer_names_alone():
    assert renamed("s*s_max + sin(s) + 1e3*as", {"s": "s_x", "e3": "no"}) == (
        "s_x*s_max + sin(s_x) + 1e3*as"
    )


@pytest.mark.parametrize(
    ("formula", "text"),
    [
        ("k*theta**2/2", "k·θ²/2"),
        ("a/(b*c)", "a/(b·c)"),
        ("a/b*c", "a/b·c"),
        ("a - (b - c)", "a − (b − c)"),
        ("-(a + b)*c", "−(a + b)·c"),
        ("a*(-b)", "a·(−b)"),
        ("(a*b)**2", "(a·b)²"),
        ("a**(1/3) + b**-2", "a^(1/3) + b⁻²"),
        ("sqrt(3*F*L)", "√(3·F·L)"),
        ("cbrt(q)**2", "(∛q)²"),
        ("cos(alpha)**2", "cos²(α)"),
        ("abs(a - b)", "|a − b|"),
        ("2*pi*r_0/n", "2·π·r₀/n"),
    ],
)
def test_formulas_are_written_with_the_signs_of_print(formula, text):
    assert formula_text(formula) == text


def test_symbols_have_greek_letters_and_small_digits():
    assert [symbol_text(name) for name in ("sigma_d", "K_0", "rho_t_near", "lamda_r", "L_12")] == [
        "σ_d", "K₀", "ρ_t_near", "λ_r", "L₁₂",
    ]  # fmt: skip


def test_numbers_are_put_in_with_the_units_that_people_read():
    quantities = {"k": (150.0, "N*m/rad"), "theta": (math.radians(14.5), "rad"), "d": (-2e-3, "m")}
    text = numbers_text("k*theta**2/2 + k/d", quantities).replace("\N{NO-BREAK SPACE}", " ")
    assert text == "150.0 N·m/rad · (14.50 deg)² / 2 + 150.0 N·m/rad / (−2.000 mm)"


_leaves = strategies.sampled_from(["a", "b", "c", "theta_1", "2", "0.5"])
_formulas = strategies.recursive(
    _leaves,
    lambda inner: strategies.one_of(
        strategies.tuples(inner, strategies.sampled_from("+-*/"), inner).map(
            lambda parts: f"({parts[0]}){parts[1]}({parts[2]})"
        ),
        inner.map(lambda part: f"-({part})"),
        strategies.tuples(inner, strategies.sampled_from(["2", "-1", "3"])).map(
            lambda parts: f"({parts[0]})**{parts[1]}"
        ),
        inner.map(lambda part: f"sin({part})"),
    ),
    max_leaves=12,
)


@hypothesis_given(_formulas)
def test_what_is_written_means_what_is_calculated(formula):
    """Read back as Python, a written formula has the value of the formula: no bracket is lost."""
    back = formula_text(formula).translate(str.maketrans("·−₁", "*-1")).replace("θ1", "theta_1")
    expected, found = evaluate(formula, VALUES), evaluate(_with_powers(back), VALUES)
    assert found == pytest.approx(expected, rel=1e-12, nan_ok=True), (formula, back)


_POWER = re.compile("⁻?[¹²³]")


def _with_powers(text: str) -> str:
    """Small digits back to powers; those behind ``sin`` are of the whole call."""
    while (match := _POWER.search(text)) is not None:
        power = f"**({match[0].translate(str.maketrans('¹²³⁻', '123-'))})"
        before, after = text[: match.start()], text[match.end() :]
        if before.endswith("sin"):
            end = _closing(after)
            text = f"{before[:-3]}(sin{after[:end]}{power}){after[end:]}"
        else:
            text = before + power + after
    return text


def _closing(text: str) -> int:
    """Where the bracket that ``text`` begins with is closed."""
    depth = 0
    for place, sign in enumerate(text):
        depth += {"(": 1, ")": -1}.get(sign, 0)
        if depth == 0:
            return place + 1
    raise ValueError(text)
