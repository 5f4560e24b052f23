"""From a spec file to a ``Spec``, or to all of its problems at once, each with line and column."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path as FilePath
from typing import Any

from pydantic import ValidationError

from springcad.errors import Problem, SpecError
from springcad.spec.common import CommonSpec
from springcad.spec.complaints import complaints
from springcad.spec.file_text import read_text
from springcad.spec.points import FOLDER
from springcad.spec.rules import broken_rules, valid_parts
from springcad.spec.text import printable, unknown
from springcad.spec.tree import MAX_PROBLEMS, Path, Place, Tree, dotted, nearest, parse

OVERRIDE = "--set"


@dataclass(frozen=True)
class Spec:
    """A spec that has been read and is valid.

    Attributes:
        path: the file as the user named it.
        kind, name: as in the spec.
        model: all values, defaults included, in SI.
        raw: what the user typed, with the overrides in place: text, numbers, booleans, sections.
        sha256: identity of what is asked for, see ``identity``.
        places: where each value stands.
        folder: where the files that it names are.
    """

    path: str
    kind: str
    name: str
    model: CommonSpec
    raw: dict[str, Any]
    sha256: str
    places: Mapping[Path, Place] = field(repr=False)
    folder: FilePath = FilePath()

    def problem(self, key: Sequence[str], message: str) -> Problem:
        """A problem with the value at ``key``, or at the section where it is left out."""
        path = tuple(key)
        return nearest(self.places, path).problem(message, dotted(path))


def read_spec(path: FilePath, overrides: Sequence[str] = ()) -> Spec:
    """Read the spec at ``path`` with ``overrides`` (``key.sub=value``) put in place.

    Raises SpecError with every problem, in the order of the file, those of the overrides last.
    """
    shown = printable(path, longest=500)
    tree = parse(read_text(path, shown), shown)
    for override in overrides:
        _put(tree, override)
    if () in tree.refused:
        raise spec_error(tree.problems)
    if not isinstance(tree.data, dict):
        what = "a spec is a list of keys with values, such as `kind: rotary-flexure`"
        raise spec_error([*tree.problems, tree.values[()].problem(what)])
    model = _validated(tree, path.parent)
    if tree.problems or model is None:
        raise spec_error(tree.problems)
    return Spec(
        path=shown,
        kind=model.kind,
        name=model.name,
        model=model,
        raw=tree.data,
        sha256=identity(model),
        places=tree.values,
        folder=path.parent,
    )


def changed_spec(spec: Spec, overrides: Sequence[str]) -> Spec:
    """The spec with ``overrides`` put in place as if they had been typed; SpecError if invalid."""
    tree = Tree(deepcopy(spec.raw), dict(spec.places), dict(spec.places))
    for override in overrides:
        _put(tree, override)
    model = _validated(tree, spec.folder)
    if tree.problems or model is None:
        raise spec_error(tree.problems)
    return replace(spec, model=model, raw=tree.data, sha256=identity(model), places=tree.values)


def restored_spec(raw: Mapping[str, Any], shown: str) -> Spec:
    """The spec that a report holds, its files put in place; ``shown`` is the report's name.

    Raises SpecError with every problem, all of them at the beginning of the report.
    """
    top = Place(shown, 1, 1)
    tree = Tree(data=dict(raw), keys={(): top}, values={(): top})
    model = _validated(tree, FilePath())
    if model is None:
        raise spec_error(tree.problems)
    sha256 = identity(model)
    return Spec(shown, model.kind, model.name, model, tree.data, sha256, tree.values)


def identity(model: CommonSpec) -> str:
    """SHA-256 of all values in SI to 12 digits, defaults included, in a fixed order of keys.

    So it does not depend on comments, layout, order, the unit a value is given in, or on whether
    a default is written out. What stands in a file that the spec names counts as if it stood in
    the spec.
    """
    values = _rounded(model.model_dump())
    text = json.dumps(values, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode("ascii")).hexdigest()


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _rounded(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(inner) for inner in value]
    return float(f"{value:.12g}") if isinstance(value, float) else value


def spec_error(problems: Iterable[Problem]) -> SpecError:
    """The problems in order; beyond the first hundred only their number."""
    ordered = sorted(dict.fromkeys(problems), key=_order)
    shown = ordered[:MAX_PROBLEMS]
    if more := ordered[MAX_PROBLEMS:]:
        first = more[0]
        shown.append(Problem(first.file, first.line, first.column, "and more problems after this"))
    return SpecError(shown)


def _order(problem: Problem) -> tuple[bool, str, int, int]:
    return problem.file == OVERRIDE, problem.file, problem.line, problem.column


def _put(tree: Tree, override: str) -> None:
    """Replace or add the value that ``override`` names; its problems go to the tree."""
    place = Place(OVERRIDE, 1, 1)
    key, equals, text = override.partition("=")
    path = tuple(key.strip().split("."))
    if not equals or not all(re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", part) for part in path):
        message = f"write key=value, as in flexures.count=24; got {printable(override)}"
        tree.problems.append(place.problem(message))
        return
    value = parse(text, OVERRIDE)
    for problem in value.problems:
        inner = f".{problem.key}" if problem.key else ""
        tree.problems.append(place.problem(problem.message, dotted(path) + inner))
    if value.problems or not isinstance(tree.data, dict):
        return
    section = tree.data
    for depth, part in enumerate(path[:-1], start=1):
        section = section.setdefault(part, {})
        tree.keys.setdefault(path[:depth], place)
        tree.values.setdefault(path[:depth], place)
        if not isinstance(section, dict):
            message = f"{dotted(path[:depth])} is a value, not a section"
            tree.problems.append(place.problem(message, dotted(path)))
            return
    section[path[-1]] = value.data
    for places in (tree.keys, tree.values):
        for old in [p for p in places if p[: len(path)] == path]:
            del places[old]
    tree.refused = {p for p in tree.refused if p[: len(path)] != path}
    for below in ((), *value.keys):
        tree.keys[path + below] = tree.values[path + below] = place


def _validated(tree: Tree, folder: FilePath) -> CommonSpec | None:
    """The model of the tree's values; None, with the problems in the tree, if it is not valid.

    Files that the spec names are looked for in ``folder``.
    """
    kind, data = _kind(tree)
    context = {FOLDER: folder}
    try:
        return kind.model_validate(data, context=context)
    except ValidationError as error:
        errors = error.errors(include_url=False)
    tree.problems += complaints(errors, kind, tree)
    bad = [tuple(str(key) for key in e["loc"]) for e in errors if e["loc"]]
    parts = dict(valid_parts(kind, data, [*bad, *tree.refused], context))
    for path, message in broken_rules(kind.RULES, parts):
        tree.problems.append(nearest(tree.values, path).problem(message, dotted(path)))
    return None


def _kind(tree: Tree) -> tuple[type[CommonSpec], dict[str, Any]]:
    """The model for the kind that the spec names, and what it is to validate.

    Where the kind is not known, only the keys that every kind has can be judged.
    """
    kinds = spec_models()
    name = tree.data.get("kind")
    if isinstance(name, str) and name in kinds:
        return import_module(kinds[name]).SPEC_MODEL, tree.data
    if isinstance(name, str):
        place = tree.values[("kind",)]
        tree.problems.append(place.problem(unknown("kind", name, kinds), "kind"))
    return CommonSpec, {k: v for k, v in tree.data.items() if k in CommonSpec.model_fields}


def spec_models() -> dict[str, str]:
    """Name of each kind → module with its ``SPEC_MODEL``.

    The kinds stand above this package and import it, so their registry is looked up when it is
    needed, by name.
    """
    registry = import_module("springcad.kinds").KINDS
    return {name: f"{package}.spec" for name, (package, _) in registry.items()}
