"""One written design judged again, from its folder to checks and input decks."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from springcad.export.files import write_files
from springcad.kinds import load_kind
from springcad.result import Check, Judgement, Progress
from springcad.verify.read_design import read_design
from springcad.verify.second_opinion import judgement_checks, second_opinion


@dataclass(frozen=True)
class Judged:
    """A written design, what the judge says of it, and the decks that were written."""

    name: str
    judgement: Judgement
    checks: tuple[Check, ...]
    decks: tuple[Path, ...]


def judge_one(path: Path, *, write_decks: bool, progress: Progress) -> Judged:
    """Judge the design whose report or folder is ``path``; with decks, write them beside it.

    Raises:
        IncompleteDesignError, DrawingError: the design cannot be read.
        OutputError: the decks cannot be written.
    """
    design, unchanged = read_design(path)
    judgement = second_opinion(design, progress)
    decks: tuple[Path, ...] = ()
    if write_decks and judgement.comparisons:
        progress("writing the input decks")
        texts = load_kind(design.kind).judge_decks(design)
        folder = path if path.is_dir() else path.parent
        decks = write_files(folder, {f"{design.name}-{key}.inp": t for key, t in texts.items()})
    return Judged(design.name, judgement, (unchanged, *judgement_checks(judgement)), decks)
