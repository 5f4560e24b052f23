"""The decks of a lever arm's leaf: CalculiX finds in them what our elements find.

The tests read what an engineer would read: the comments of the decks and CalculiX's prints.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from fem_cases import calculix_prints, printed_vectors

from springcad.cli.run import run
from springcad.kinds.lever_arm.deck import judge_decks
from springcad.verify.read_design import read_design

ROOT = Path(__file__).parents[2]


def findings(deck: str, columns: int) -> np.ndarray:
    """What the comments say that we found, a row for each step; the force comes last."""
    row = rf"^\*\* +(\d+(?: +[-\d.e+]+){{{columns - 1}}})$"
    return np.array([text.split() for text in re.findall(row, deck, re.MULTILINE)], dtype=float)


def last_step(deck: str) -> str:
    """The deck with its last step alone, to save time."""
    model, *steps = deck.split("*STEP")
    return f"{model}*STEP{steps[-1]}"


def node_set(deck: str, name: str) -> np.ndarray:
    """Numbers of its nodes, from 0."""
    (text,) = re.findall(rf"^\*NSET, NSET={name}\n((?:[\d, ]+\n)+)", deck, re.MULTILINE)
    return np.array(re.findall(r"\d+", text), dtype=int) - 1


def forces(program: str, deck: str, folder: Path, name: str) -> np.ndarray:
    """Sum of the reactions on a node set after each step (steps, 2), by CalculiX."""
    folder.mkdir()
    printed = calculix_prints(program, deck, folder)
    return printed_vectors(printed, "forces", "PART", node_set(deck, name)).sum(axis=1)


@pytest.mark.slow
def test_calculix_bends_a_parabola_with_the_same_force(
    require_tool: Callable[[str], str], tmp_path: Path
) -> None:
    program = require_tool("ccx")
    spec = ROOT / "specs/lever-parabolic.yaml"
    assert run(["design", str(spec), "-o", str(tmp_path), "--no-verify"]) == 0
    design, _ = read_design(tmp_path / "lever-parabolic")
    (deck,) = judge_decks(design).values()
    known = findings(deck, 3)
    assert list(known[:, 1]) == [2.5, 5.0, 7.5, 10.0]
    across = forces(program, last_step(deck), tmp_path / "ccx", "PIN")[-1, 1]
    assert across == pytest.approx(known[-1, 2], rel=1e-4)
