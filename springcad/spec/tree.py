"""YAML text to a plain tree of values, each with its line and column; hostile YAML is refused.

The events of ruamel.yaml's pure Python parser are checked one by one before anything is built from
them, so that neither nesting, nor aliases, nor merge keys can cost memory, time or stack.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, TypeAlias

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.events import (
    AliasEvent,
    CollectionEndEvent,
    CollectionStartEvent,
    DocumentStartEvent,
    Event,
    MappingStartEvent,
    NodeEvent,
    ScalarEvent,
)

from springcad.errors import Problem
from springcad.spec.scalar import read_plain
from springcad.spec.text import UNSAFE, printable

MAX_LINES = 20_000
MAX_EVENTS = 20_000
MAX_DEPTH = 32
MAX_SCALAR = 4096
MAX_PROBLEMS = 100

Path: TypeAlias = tuple[str, ...]
"""Keys from the root of the spec to a value; items of a list count as ``"0"``, ``"1"``, …"""


@dataclass(frozen=True)
class Place:
    """Where something stands; line and column count from 1."""

    file: str
    line: int
    column: int

    def problem(self, message: str, key: str = "") -> Problem:
        return Problem(self.file, self.line, self.column, message, key)


@dataclass
class Tree:
    """What a YAML text says.

    Attributes:
        data: the values (dict, list, str, int, float, bool); a refused value is left out.
        keys, values: where each key and each value stands.
        refused: paths of the values left out.
        problems: why, and whatever else is not accepted.
    """

    data: Any = None
    keys: dict[Path, Place] = field(default_factory=dict)
    values: dict[Path, Place] = field(default_factory=dict)
    refused: set[Path] = field(default_factory=set)
    problems: list[Problem] = field(default_factory=list)


def nearest(places: Mapping[Path, Place], path: Path) -> Place:
    """Where ``path`` stands, or else the nearest section above it that is in ``places``."""
    while path not in places:
        path = path[:-1]
    return places[path]


class _RefusedError(Exception):
    """The text cannot be read any further."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(str(problem))
        self.problem = problem


_NOTHING: Any = object()  # stands for a refused value while the tree is built


def parse(text: str, file: str) -> Tree:
    """Read ``text``; ``file`` is the name for messages. Never raises for what the text says."""
    start = Place(file, 1, 1)
    tree = Tree(values={(): start}, refused={()})
    tree.problems = list(islice(_unsafe_text(text, file), MAX_PROBLEMS))
    if not tree.problems:
        try:
            _Builder(_events(text, file), file, tree).document()
        except _RefusedError as refusal:
            tree.problems.append(refusal.problem)
            tree.refused.add(())
    return tree


def _unsafe_text(text: str, file: str) -> Iterator[Problem]:
    """Problems that are seen before any YAML is read."""
    lines = re.split("\r\n|\r|\n", text)
    if len(lines) > MAX_LINES:
        yield Place(file, MAX_LINES + 1, 1).problem(f"more than {MAX_LINES} lines")
    for number, line in enumerate(lines, start=1):
        if len(line) > MAX_SCALAR:
            column = MAX_SCALAR + 1
            yield Place(file, number, column).problem(f"line of more than {MAX_SCALAR} characters")
        if line.startswith("%"):
            yield Place(file, number, 1).problem("YAML directives are not accepted")
        for match in UNSAFE.finditer(line):
            yield Place(file, number, match.start() + 1).problem(_not_accepted(match[0]))


def _not_accepted(character: str) -> str:
    name = unicodedata.name(character, "control character").lower()
    return f"the character U+{ord(character):04X} ({name}) is not accepted"


def _place(event_or_mark: Any, file: str) -> Place:
    mark = getattr(event_or_mark, "start_mark", event_or_mark)
    return Place(file, mark.line + 1, mark.column + 1)


def _events(text: str, file: str) -> Iterator[Event]:
    """The parser's events; stops with ``_RefusedError`` at a limit or where it is not YAML."""
    depth = 0
    place = Place(file, 1, 1)
    try:
        for count, event in enumerate(YAML(typ="safe", pure=True).parse(text), start=1):
            place = _place(event, file)
            depth += isinstance(event, CollectionStartEvent)
            depth -= isinstance(event, CollectionEndEvent)
            if count > MAX_EVENTS:
                raise _RefusedError(place.problem("too many values for a spec"))
            if depth > MAX_DEPTH:
                raise _RefusedError(place.problem(f"nested deeper than {MAX_DEPTH} levels"))
            yield event
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = place if mark is None else _place(mark, file)
        raise _RefusedError(place.problem(_not_yaml(error.problem or error.context))) from error
    except (YAMLError, ValueError) as error:  # ValueError: an escape such as "\U00110000"
        raise _RefusedError(place.problem(_not_yaml(error))) from error


def _not_yaml(reason: object) -> str:
    return f"not valid YAML: {printable(reason, 120)}"


@dataclass
class _Builder:
    """Builds the tree from the events, noting problems as it goes."""

    events: Iterator[Event]
    file: str
    tree: Tree

    def document(self) -> None:
        next(self.events)  # the start of the stream
        event = next(self.events)
        if not isinstance(event, DocumentStartEvent):
            raise _RefusedError(Place(self.file, 1, 1).problem("holds nothing"))
        first = next(self.events)
        self.tree.refused.discard(())
        self.tree.data = self.value(first, ())
        next(self.events)  # the end of the document
        event = next(self.events)
        if isinstance(event, DocumentStartEvent):
            self.note(event, "one file holds one spec; a second document is not accepted")

    def note(self, at: Event | Place, message: str, path: Path = ()) -> None:
        if len(self.tree.problems) <= MAX_PROBLEMS:
            place = at if isinstance(at, Place) else _place(at, self.file)
            self.tree.problems.append(place.problem(message, dotted(path)))

    def value(self, event: Event, path: Path) -> Any:
        """The value that begins with ``event``; ``_NOTHING`` where it is refused."""
        self.tree.values[path] = _place(event, self.file)
        if isinstance(event, NodeEvent) and not isinstance(event, AliasEvent):
            if event.anchor is not None:
                self.note(event, "anchors (&) are not accepted", path)
            if getattr(event, "tag", None) is not None:
                self.note(event, "tags (!) are not accepted", path)
        result: Any
        if isinstance(event, MappingStartEvent):
            result = self.mapping(path)
        elif isinstance(event, CollectionStartEvent):
            result = self.sequence(path)
        elif isinstance(event, ScalarEvent):
            result = self.scalar(event, path)
        else:
            self.note(event, "aliases (*) are not accepted", path)
            result = _NOTHING
        if result is _NOTHING:
            self.tree.refused.add(path)
        return result

    def scalar(self, event: ScalarEvent, path: Path) -> Any:
        text = event.value
        if len(text) > MAX_SCALAR:
            raise _RefusedError(
                _place(event, self.file).problem(f"text of more than {MAX_SCALAR} characters")
            )
        if unsafe := UNSAFE.search(text):
            self.note(event, _not_accepted(unsafe[0]), path)
            return _NOTHING
        if "\n" in text or "\r" in text or "\t" in text:
            self.note(event, "a value is a text on one line, without tabs", path)
            return _NOTHING
        if event.style:  # quoted
            return text
        try:
            value = read_plain(text)
        except ValueError as error:
            self.note(event, str(error), path)
            return _NOTHING
        if value is None:
            # nothing stands there: the parser's mark is that of whatever comes next
            place = self.tree.keys.get(path, self.tree.values[path])
            self.note(place, "is empty: give a value or leave the key out", path)
            return _NOTHING
        return value

    def sequence(self, path: Path) -> list[Any]:
        items: list[Any] = []
        while not isinstance(event := next(self.events), CollectionEndEvent):
            items.append(self.value(event, (*path, str(len(items)))))
        return [item for item in items if item is not _NOTHING]

    def mapping(self, path: Path) -> dict[str, Any]:
        section: dict[str, Any] = {}
        while not isinstance(event := next(self.events), CollectionEndEvent):
            key = self.key(event, path)
            inner = (*path, key)
            if key == "<<":
                self.note(event, "merge keys (<<) are not accepted", path)
                self.skip()
            elif inner in self.tree.keys:
                line = self.tree.keys[inner].line
                self.note(event, f"given a second time (first in line {line})", inner)
                self.skip()
            elif key is _NOTHING:
                self.skip()
            else:
                self.tree.keys[inner] = _place(event, self.file)
                value = self.value(next(self.events), inner)
                if value is not _NOTHING:
                    section[key] = value
        return section

    def key(self, event: Event, path: Path) -> Any:
        """The key that begins with ``event``, as text."""
        if not isinstance(event, ScalarEvent):
            self.note(event, "a key is a plain word", path)
            self.skip(event)
            return _NOTHING
        if event.anchor is not None or event.tag is not None:
            self.note(event, "anchors (&) and tags (!) are not accepted", path)
        if len(event.value) > MAX_SCALAR:
            self.note(event, f"text of more than {MAX_SCALAR} characters", path)
            return _NOTHING
        if unsafe := UNSAFE.search(event.value):
            self.note(event, _not_accepted(unsafe[0]), path)
            return _NOTHING
        return event.value

    def skip(self, event: Event | None = None) -> None:
        """Pass over one whole value, unread."""
        depth = 0
        while True:
            event = event or next(self.events)
            depth += isinstance(event, CollectionStartEvent)
            depth -= isinstance(event, CollectionEndEvent)
            if depth == 0:
                return
            event = None


def dotted(path: Path) -> str:
    """``envelope.outer_radius``, safe to print."""
    return ".".join(printable(key, 40) for key in path)
