"""Formulas as people write them: ``k*theta**2/2`` is k·θ²/2, and so are the numbers put into it."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from typing import NamedTuple

from springcad.formula import CONSTANTS, parse
from springcad.report.display import format_value, typeset

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "eta": "η",
    "theta": "θ", "kappa": "κ", "lamda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π",
    "rho": "ρ", "sigma": "σ", "tau": "τ", "phi": "φ", "psi": "ψ", "omega": "ω", "Delta": "Δ",
    "Omega": "Ω",
}  # fmt: skip
"""Name in a symbol → letter; lambda is a word of Python's, so it loses its b."""
_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_TRIGONOMETRIC = ("sin", "cos", "tan")
_ROOTS = {"sqrt": "√", "cbrt": "∛"}

_SUM, _SIGNED, _PRODUCT, _QUANTITY, _POWER, _ATOM = range(1, 7)


class _Text(NamedTuple):
    """A piece of a formula, and how firmly it holds together."""

    text: str
    binding: int

    def within(self, least: int) -> str:
        """The text, in brackets where its neighbours would pull it apart."""
        return self.text if self.binding >= least else f"({self.text})"


class _Style(NamedTuple):
    """How symbols and the signs between them are written."""

    symbol: Callable[[str], _Text]
    times: str
    over: str


def symbol_text(symbol: str) -> str:
    """``sigma_d`` is σ_d, ``K_0`` is K₀."""
    first, *others = (GREEK.get(part, part) for part in symbol.split("_"))
    if others and others[0].isdigit():
        first += others.pop(0).translate(_SUBSCRIPTS)
    return "_".join([first, *others])


def formula_text(formula: str) -> str:
    """The formula with the signs of print."""
    style = _Style(lambda name: _Text(symbol_text(name), _ATOM), "·", "/")
    return _text(parse(formula), style).text


def numbers_text(formula: str, quantities: Mapping[str, tuple[float, str]]) -> str:
    """The formula with a value and its SI unit for each symbol, in the units that people read.

    Quantities are kept on one line by no-break spaces.
    """

    def quantity(name: str) -> _Text:
        if name in CONSTANTS:
            return _Text(symbol_text(name), _ATOM)
        value, unit = quantities[name]
        text = quantity_text(value, unit)
        binding = _SIGNED if value < 0 else _QUANTITY if unit != "1" else _ATOM
        return _Text(text, binding)

    return _text(parse(formula), _Style(quantity, " · ", " / ")).text


def quantity_text(value: float, unit: str) -> str:
    """An SI number as people read it, with the signs of print."""
    text = typeset(format_value(value, unit))
    for power in "234":
        text = text.replace(f"^{power}", power.translate(_SUPERSCRIPTS))
    return text


def _text(node: ast.expr, style: _Style) -> _Text:
    match node:
        case ast.Constant(value=int() | float() as number):
            return _Text(_literal(number), _ATOM)
        case ast.Name(id=name):
            return style.symbol(name)
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return _Text(f"−{_text(inner, style).within(_PRODUCT)}", _SIGNED)
        case ast.UnaryOp(operand=inner):
            return _text(inner, style)
        case ast.Call(func=ast.Name(id=name), args=args):
            return _Text(_call(name, [_text(argument, style) for argument in args]), _ATOM)
        case ast.BinOp(left=left, op=ast.Pow(), right=exponent):
            return _Text(_power(left, exponent, style), _POWER)
        case ast.BinOp(left=left, op=sign, right=right):
            return _joined(_text(left, style), sign, _text(right, style), style)
    raise TypeError(f"no text for {type(node).__name__}")


def _literal(number: float) -> str:
    mantissa, _, exponent = f"{number:.12g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


def _joined(left: _Text, sign: ast.operator, right: _Text, style: _Style) -> _Text:
    match sign:
        case ast.Mult():
            text = f"{left.within(_SIGNED)}{style.times}{right.within(_PRODUCT)}"
            return _Text(text, _first(left))
        case ast.Div():
            text = f"{left.within(_SIGNED)}{style.over}{right.within(_QUANTITY)}"
            return _Text(text, _first(left))
        case ast.Add():
            return _Text(f"{left.text} + {right.within(_PRODUCT)}", _SUM)
    return _Text(f"{left.text} − {right.within(_PRODUCT)}", _SUM)


def _first(left: _Text) -> int:
    """How firmly a product holds together: with a sign before it less than without."""
    return _SIGNED if left.binding == _SIGNED else _PRODUCT


def _call(name: str, args: list[_Text]) -> str:
    inner = ", ".join(argument.text for argument in args)
    if name == "abs":
        return f"|{inner}|"
    if name in _ROOTS:
        return _ROOTS[name] + args[0].within(_ATOM)
    return f"{name}({inner})"


def _power(base: ast.expr, exponent: ast.expr, style: _Style) -> str:
    raised = _exponent(exponent, style)
    match base:
        case ast.Call(func=ast.Name(id=name), args=[argument]) if name in _TRIGONOMETRIC:
            return f"{name}{raised}({_text(argument, style).text})"
        case ast.Call(func=ast.Name(id=name)) if name in _ROOTS:
            return f"({_text(base, style).text}){raised}"
    return _text(base, style).within(_ATOM) + raised


def _exponent(node: ast.expr, style: _Style) -> str:
    match node:
        case ast.Constant(value=int() as number):
            return str(number).translate(_SUPERSCRIPTS)
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() as number)):
            return str(-number).translate(_SUPERSCRIPTS)
    return f"^{_text(node, style).within(_ATOM)}"
