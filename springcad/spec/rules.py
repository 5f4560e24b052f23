"""Rules between keys of a spec (``root_radius < outer_radius``), tested on whatever is valid.

A rule names the keys it needs. It is tested whenever these are valid, however wrong the rest of
the spec is, so that all independent problems of a file come at once.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel, ConfigDict, create_model
from pydantic.fields import FieldInfo

from springcad.spec.tree import Path


class Section(BaseModel):
    """A section of a spec: known keys only, finite numbers, no silent conversion, unchangeable."""

    model_config = ConfigDict(
        strict=True,
        extra="forbid",
        allow_inf_nan=False,
        frozen=True,
        validate_default=True,
        use_attribute_docstrings=True,
    )


@dataclass(frozen=True)
class Rule:
    """A claim about the values at ``needs``; ``broken`` gives the message if it does not hold.

    The first of ``needs`` is the key that the message is about.
    """

    needs: tuple[Path, ...]
    broken: Callable[..., str | None]


def rule(*needs: str) -> Callable[[Callable[..., str | None]], Rule]:
    """Make a function of the values at the dotted keys ``needs`` a rule."""
    return lambda broken: Rule(tuple(tuple(need.split(".")) for need in needs), broken)


def broken_rules(rules: Collection[Rule], parts: Mapping[Path, Any]) -> Iterator[tuple[Path, str]]:
    """Key and message of every broken rule among those whose needs are all in ``parts``."""
    for rule_ in rules:
        if all(need in parts for need in rule_.needs):
            message = rule_.broken(*(parts[need] for need in rule_.needs))
            if message:
                yield rule_.needs[0], message


def parts_of(model: BaseModel, path: Path = ()) -> Iterator[tuple[Path, Any]]:
    """Every key of ``model`` with its value, sections included."""
    for name in type(model).model_fields:
        value = getattr(model, name)
        yield (*path, name), value
        if isinstance(value, BaseModel):
            yield from parts_of(value, (*path, name))


def valid_parts(
    model: type[BaseModel],
    data: Mapping[str, Any],
    bad: Collection[Path],
    context: Mapping[str, Any],
    path: Path = (),
) -> Iterator[tuple[Path, Any]]:
    """The same for ``data`` that is not valid at the paths ``bad``: what stays when they go.

    ``context`` is that of the validation, as pydantic takes it.
    """
    good: dict[str, Any] = {}
    for name, field in model.model_fields.items():
        inner = (*path, name)
        if not any(place[: len(inner)] == inner for place in bad):
            good[name] = (field.annotation, field)
        elif (section := section_of(field)) and isinstance(data.get(name), dict):
            yield from valid_parts(section, data[name], bad, context, inner)
    sound = create_model(model.__name__, __base__=Section, **good)
    values = {name: data[name] for name in good if name in data}
    yield from parts_of(sound.model_validate(values, context=dict(context)), path)


def section_of(field: FieldInfo) -> type[Section] | None:
    """The section that ``field`` holds, if it holds one."""
    kind = field.annotation
    candidates = (kind, *getattr(kind, "__args__", ()))
    sections = (c for c in candidates if isinstance(c, type) and issubclass(c, Section))
    return next(sections, None)
