"""The decks of the second opinion: CalculiX finds in them what our elements find.

The rotary springs of paper 004 with the flanks of their camshafts, as ``verify --deck`` writes
them; the test reads what an engineer would read, the comments of the deck and CalculiX's prints.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from fem_cases import calculix_prints, nodal_stresses, printed_vectors
from rotary_cases import written_of

from springcad.kinds.rotary_flexure.deck import (
    judge_decks,
    middle_nodes,
    sector_deck,
    slice_factor,
)
from springcad.kinds.rotary_flexure.judge import SHARES
from springcad.kinds.rotary_flexure.sector_contact import (
    sector_contact,
    turn_through,
)
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.mechanics.fem.deck import SLICE

KEYWORDS = {
    *("*HEADING", "*NODE", "*ELEMENT", "*NSET", "*SURFACE", "*MATERIAL", "*ELASTIC"),
    *("*SOLID SECTION", "*SURFACE INTERACTION", "*SURFACE BEHAVIOR", "*CONTACT PAIR"),
    *("*EQUATION", "*STEP", "*STATIC", "*BOUNDARY", "*NODE PRINT", "*CONTACT PRINT"),
    *("*NODE FILE", "*EL FILE", "*END STEP"),
}
"""Known to CalculiX and to Abaqus, with the parameters and data lines that are used."""


def turned(name: str, direction: int, shares: Sequence[float]):
    """Model and turns at shares of the design deflection, in the order given."""
    spring = written_spring(written_of(name))
    sector = sector_contact(spring, direction)
    turns = turn_through(sector, [share * spring.deflection for share in shares])
    assert len(turns) == len(shares)
    return sector, turns


def contact_forces(printed: str) -> np.ndarray:
    """Force on the flexure and moment about the axis, of the slice (steps, 3)."""
    numbers = re.findall(r"total surface force .*\n\s*\n(.*)\n", printed)
    parts = np.array([line.split() for line in numbers], dtype=float)
    return parts[:, [0, 1, 5]]


def findings(deck: str) -> np.ndarray:
    """What the comments say that we found (turns, 7)."""
    rows = re.findall(r"^\*\* +(\d+(?: +[-\d.e+]+){6})$", deck, flags=re.MULTILINE)
    return np.array([row.split() for row in rows], dtype=float)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "direction"),
    [("S2", 1), ("S3", -1)],
    ids=["S2 counter-clockwise", "S3 clockwise"],
)
def test_calculix_repeats_the_second_opinion_to_the_full_deflection(
    require_tool: Callable[[str], str],
    tmp_path: Path,
    name: str,
    direction: int,
) -> None:
    """Torque and contact force within 0.5 %, tip within 0.2 %, stress at mid-flexure within 1.2 %.

    CalculiX extrapolates stresses from within its elements: 1.1 % on the inside of S3's bend.

    The direction of the force agrees within 0.01 rad: CalculiX takes it from faces, not the curve.
    """
    sector, turns = turned(name, direction, (1.0,))
    deck = sector_deck(sector, turns, name)
    printed = calculix_prints(require_tool("ccx"), deck, tmp_path, timeout=400)
    theirs, ours = contact_forces(printed)[1::2], findings(deck)
    np.testing.assert_array_equal(ours[:, 0], 2.0 + 2.0 * np.arange(len(turns)))
    np.testing.assert_allclose(theirs[:, 2], ours[:, 3], rtol=5e-3)
    np.testing.assert_allclose(
        direction * theirs[:, 2] * slice_factor(sector), ours[:, 2], rtol=5e-3
    )
    expected = [turn.state.contact.force for turn in turns if turn.state.contact is not None]
    scaled = np.array(expected) * SLICE / sector.spring.sheet.thickness
    np.testing.assert_allclose(np.hypot(*theirs[:, :2].T), np.hypot(*scaled.T), rtol=5e-3)
    angles = [np.arctan2(*forces[:, 1::-1].T) for forces in (theirs, scaled)]
    np.testing.assert_allclose(angles[0], angles[1], atol=1e-2)

    tip = sector.mesh.node_sets["tip"]
    moved = printed_vectors(printed, "displacements", "PART", tip)[1::2]
    for turn, tip_moved in zip(turns, moved, strict=True):
        expected = turn.state.displacement.reshape(-1, 2)[tip]
        assert np.abs(tip_moved - expected).max() < 2e-3 * np.abs(expected).max()

    stresses = nodal_stresses(tmp_path / "job.frd", middle_nodes(sector))[1::2]
    np.testing.assert_allclose(stresses[:, :, :2].sum(axis=-1), ours[:, 4:6], rtol=1.2e-2)


@pytest.fixture(scope="module")
def decks() -> dict[str, str]:
    return dict(judge_decks(written_of("S2")))


def test_a_deck_for_each_direction_is_the_same_every_time(decks: dict[str, str]) -> None:
    assert list(decks) == ["counter-clockwise", "clockwise"]
    assert judge_decks(written_of("S2")) == decks
    for way, deck in decks.items():
        assert deck.startswith(f"*HEADING\nS2, {way}: SI units")
        assert deck.count("*STEP, NLGEOM") == 2 * len(SHARES)
        assert findings(deck).shape == (len(SHARES), 7)


def test_a_deck_keeps_to_what_calculix_and_abaqus_read(decks: dict[str, str]) -> None:
    """Lines of 256 characters, 20 a field, 16 fields, 4 terms of an equation (Abaqus, 1.2.1)."""
    for deck in decks.values():
        assert deck.isascii()
        lines = [line for line in deck.splitlines()[2:] if not line.startswith("**")]
        assert {line.split(",")[0] for line in lines if line.startswith("*")} == KEYWORDS - {
            "*HEADING"
        }
        assert max(map(len, lines)) <= 256
        fields = [line.split(",") for line in lines if not line.startswith("*")]
        assert max(map(len, fields)) <= 16
        assert max(len(field.strip()) for row in fields for field in row) <= 20


def test_what_an_equation_eliminates_appears_nowhere_else(decks: dict[str, str]) -> None:
    """Abaqus allows it in no other equation and in no boundary condition."""
    for deck in decks.values():
        slaves, masters = [], []
        for block in re.findall(r"\*EQUATION\n\d+\n((?:[^*\n]+\n)+)", deck):
            terms = re.findall(r"(\d+), ([12]), (\S+?)(?:,|\n)", block)
            assert float(terms[0][2]) == 1.0
            slaves.append(terms[0][:2])
            masters += [term[:2] for term in terms[1:]]
        held = set(re.findall(r"^(\d+), ([12]), [12], ", deck.split("*STEP")[1], re.MULTILINE))
        assert len(slaves) == len(set(slaves)) > 20
        assert not set(slaves) & (set(masters) | held)
