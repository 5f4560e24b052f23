"""pydantic's errors in plain words, each at its place in the file."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import takewhile
from typing import Any

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from springcad.errors import Problem
from springcad.spec.csv_columns import FaultsError
from springcad.spec.rules import section_of
from springcad.spec.text import listing, nearest, printable, unknown
from springcad.spec.tree import MAX_PROBLEMS, Path, Place, Tree, dotted
from springcad.spec.tree import nearest as nearest_place

_MESSAGES = {
    "value_error": "{error}",
    "int_type": "must be a whole number, is {value}",
    "float_type": "must be a bare number, is {value}",
    "string_type": "must be a text, is {value}",
    "model_type": "must be a section with keys, is {value}",
    "greater_than_equal": "must be at least {ge}, is {value}",
    "greater_than": "must be more than {gt}, is {value}",
    "less_than_equal": "must be at most {le}, is {value}",
    "less_than": "must be less than {lt}, is {value}",
}


def complaints(
    errors: Sequence[ErrorDetails], model: type[BaseModel], tree: Tree
) -> Iterator[Problem]:
    """A problem for each of ``errors`` that validating ``tree`` by ``model`` gave.

    Not repeated are the values that the tree has left out already, the missing keys that an
    unknown key was meant to be, and the rules between keys (at the root), which are tested apart.
    """
    meant: set[Path] = set()
    unknown_keys = [_loc(error) for error in errors if error["type"] == "extra_forbidden"]
    for path in unknown_keys[: MAX_PROBLEMS + 1]:
        message, guess = _unknown_key(path, model)
        meant.add(guess)
        yield tree.keys[path].problem(message, dotted(path))
    for error in errors:
        path = _loc(error)
        if path == () or path in tree.refused or error["type"] == "extra_forbidden":
            continue
        if error["type"] == "missing":
            if path not in meant:
                what = _description(path, model)
                yield nearest_place(tree.values, path).problem(f"missing: {what}", dotted(path))
            continue
        cause = error.get("ctx", {}).get("error")
        if isinstance(cause, FaultsError):
            yield from _faults(cause, path, tree)
            continue
        key = dotted(_typed(path, tree.data))
        yield nearest_place(tree.values, path).problem(_message(error), key)


def _faults(cause: FaultsError, path: Path, tree: Tree) -> Iterator[Problem]:
    """The faults of one value, each where it stands, in the spec or in a file that it names."""
    for where, message in cause.faults:
        if isinstance(where, Place):
            yield where.problem(message)
        else:
            place = nearest_place(tree.values, (*path, *where))
            keys = takewhile(lambda key: not key.isdigit(), where)
            yield place.problem(message, dotted((*path, *keys)))


def _loc(error: ErrorDetails) -> Path:
    return tuple(str(key) for key in error["loc"])


def _message(error: ErrorDetails) -> str:
    context = error.get("ctx", {})
    if error["type"] == "literal_error":
        return _not_a_choice(context["expected"], error["input"])
    template = _MESSAGES.get(error["type"], "{msg}")
    shown = {**context, "msg": error["msg"], "value": printable(repr(error["input"]), 30)}
    return template.format(**shown)


def _typed(path: Path, data: Any) -> Path:
    """``path`` as far as the file has keys: ``process.name`` is ``process`` in ``process: x``."""
    for depth, key in enumerate(path):
        if not isinstance(data, dict):
            return path[:depth]
        data = data.get(key, {})
    return path


def _not_a_choice(expected: str, value: object) -> str:
    choices = re.findall("'([^']*)'", expected)
    if not choices:  # a number, as the version of the format
        return f"must be {expected}, is {printable(repr(value))}"
    if not isinstance(value, str):
        return f"must be {listing(choices)}, is {printable(repr(value))}"
    return unknown("word", value, choices)


def _unknown_key(path: Path, model: type[BaseModel]) -> tuple[str, Path]:
    """The message for a key that is not one, and the key that was probably meant."""
    *above, word = path
    parent = tuple(above)
    siblings = {p[-1]: p for p in _keys(model) if p[:-1] == parent}
    if guess := nearest(word, siblings):
        return f"unknown key; did you mean {guess}?", siblings[guess]
    for key in _keys(model):
        if key[-1] == word:
            return f"unknown key; did you mean {dotted(key)}?", key
    place = dotted(parent) or "a spec"
    return f"unknown key; {place} takes {', '.join(siblings)}", path


def _keys(model: type[BaseModel], path: Path = ()) -> Iterator[Path]:
    """All keys that ``model`` takes."""
    for name, field in model.model_fields.items():
        yield (*path, name)
        if section := section_of(field):
            yield from _keys(section, (*path, name))


def _description(path: Path, model: type[BaseModel]) -> str:
    """What the field at ``path`` is."""
    *above, name = path
    for key in above:
        section = section_of(model.model_fields[key])
        if section is None:
            return "a value"
        model = section
    text = (model.model_fields[name].description or "a value").split("\n")[0].rstrip(".")
    return text[0].lower() + text[1:]
