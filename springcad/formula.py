"""Formulas as text, ``k*theta**2/2``: what may stand in one, and its value.

A formula is a Python expression of numbers, symbols, ``+ - * / **``, signs, and the functions and
constants below. It is parsed and walked; nothing of it is ever handed to Python to run.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping

FUNCTIONS: Mapping[str, Callable[..., float]] = {
    "sqrt": math.sqrt,
    "cbrt": math.cbrt,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "atanh": math.atanh,
    "sinh": math.sinh,
    "asinh": math.asinh,
    "exp": math.exp,
    "log": math.log,
    "abs": abs,
    "ceil": math.ceil,
    "min": min,
    "max": max,
}
CONSTANTS: Mapping[str, float] = {"pi": math.pi}

_OPERATORS: Mapping[type[ast.AST], Callable[..., float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: math.pow,
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
}
_NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*")


class FormulaError(ValueError):
    """A text that is no formula, or that has a symbol without a value."""


def parse(formula: str) -> ast.expr:
    """The syntax tree, of numbers, names, operators and calls only; FormulaError otherwise."""
    try:
        tree = ast.parse(formula, mode="eval").body
    except SyntaxError as error:
        raise FormulaError(f"not a formula: {formula}") from error
    for node in ast.walk(tree):
        if not _is_allowed(node):
            raise FormulaError(f"{type(node).__name__} has no place in a formula: {formula}")
    return tree


def _is_allowed(node: ast.AST) -> bool:
    match node:
        case ast.Constant(value=value):
            return type(value) in (int, float)
        case ast.Call(func=ast.Name(id=name), keywords=keywords):
            return name in FUNCTIONS and not keywords
        case ast.Name() | ast.Load() | ast.BinOp() | ast.UnaryOp():
            return True
    return type(node) in _OPERATORS


def symbols(formula: str) -> tuple[str, ...]:
    """The symbols whose values a formula needs, each once, in the order in which they stand."""
    names = (node.id for node in _in_order(parse(formula)) if isinstance(node, ast.Name))
    return tuple(
        dict.fromkeys(name for name in names if name not in FUNCTIONS and name not in CONSTANTS)
    )


def _in_order(node: ast.AST) -> list[ast.AST]:
    inner = [found for child in ast.iter_child_nodes(node) for found in _in_order(child)]
    return [node, *inner]


def renamed(formula: str, names: Mapping[str, str]) -> str:
    """The formula with other names for some of its symbols."""
    return _NAME.sub(lambda match: names.get(match[0], match[0]), formula)


def evaluate(formula: str, values: Mapping[str, float]) -> float:
    """The formula with ``values`` for its symbols; nan where it has none (a root of -1, 1/0).

    Raises:
        FormulaError: the text is no formula, or a symbol has no value.
    """
    try:
        return float(_value(parse(formula), {**CONSTANTS, **values}))
    except (ArithmeticError, ValueError) as error:
        if isinstance(error, FormulaError):
            raise
        return math.nan


def _value(node: ast.expr, values: Mapping[str, float]) -> float:
    match node:
        case ast.Constant(value=int() | float() as number):
            return number
        case ast.Name(id=name):
            if name not in values:
                raise FormulaError(f"{name} has no value")
            return values[name]
        case ast.UnaryOp(op=sign, operand=inner):
            return _OPERATORS[type(sign)](_value(inner, values))
        case ast.BinOp(left=left, op=sign, right=right):
            return _OPERATORS[type(sign)](_value(left, values), _value(right, values))
        case ast.Call(func=ast.Name(id=name), args=args):
            return FUNCTIONS[name](*(_value(argument, values) for argument in args))
    raise FormulaError(f"{type(node).__name__} has no value")
