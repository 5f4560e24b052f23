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
from lever_cases import POM, POM_LEAF, STEEL, STEEL_LEAF

from springcad.cli.run import run
from springcad.kinds.lever_arm.curved_judge import CLEAR
from springcad.kinds.lever_arm.deck import judge_decks
from springcad.kinds.lever_arm.leaf_mesh import half_mesh
from springcad.kinds.lever_arm.omega import OmegaCase, OmegaLeaf, omega_response
from springcad.mechanics.fem.deck import SLICE
from springcad.verify.read_design import read_design
from springcad.written import WrittenDesign

ROOT = Path(__file__).parents[2]
WIDTH = 15e-3


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


def last_prints(program: str, deck: str, folder: Path) -> str:
    """What CalculiX prints of the deck's last step."""
    folder.mkdir()
    return str(calculix_prints(program, last_step(deck), folder))


def reaction(printed: str, deck: str, name: str) -> np.ndarray:
    """Sum of the reactions on a node set in the end (2,)."""
    return np.asarray(
        printed_vectors(printed, "forces", "PART", node_set(deck, name))[-1].sum(axis=0)
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "largest", "bound"), [("parabolic", 10.0, 1e-4), ("triangular", 8.0, 3e-4)]
)
def test_calculix_bends_a_straight_leaf_with_the_same_force(
    require_tool: Callable[[str], str], tmp_path: Path, name: str, largest: float, bound: float
) -> None:
    """The triangle's elements differ in width: each column has a section of its mean width."""
    program = require_tool("ccx")
    spec = ROOT / f"specs/lever-{name}.yaml"
    assert run(["design", str(spec), "-o", str(tmp_path), "--no-verify"]) == 0
    design, _ = read_design(tmp_path / f"lever-{name}")
    (deck,) = judge_decks(design).values()
    known = findings(deck, 3)
    np.testing.assert_allclose(known[:, 1], largest * np.array([0.25, 0.5, 0.75, 1.0]))
    across = reaction(last_prints(program, deck, tmp_path / "ccx"), deck, "PIN")[1]
    assert across == pytest.approx(known[-1, 2], rel=bound)


def written(leaf: OmegaLeaf, case: OmegaCase) -> WrittenDesign:
    """What the report of an omega leaf holds of its shape."""
    return WrittenDesign(
        "lever-arm",
        "omega",
        design={
            "shape": "omega",
            "width_m": WIDTH,
            "spring_deflection_m": case.stroke,
            "leaf": {
                "angle_coefficients_rad": leaf.angle_coefficients,
                "thickness_coefficients_m": leaf.thickness_coefficients,
                "half_length_m": leaf.length,
                "middle_m": leaf.middle,
                "hub_radius_m": leaf.hub_radius,
            },
            "enclosure_radius_m": case.enclosure_radius,
            "lever_corridor_m": case.corridor,
            "lever_arms_m": list(case.arms),
            "min_web_m": case.min_web,
            "min_gap_m": case.min_gap,
            "elastic_modulus_Pa": case.elastic_modulus,
            "poisson_ratio": case.poisson_ratio,
            "design_stress_Pa": case.allowable_stress,
        },
        response={},
        contours={},
    )


def side_stress(printed: str, deck: str, leaf: OmegaLeaf, case: OmegaCase) -> float:
    """Largest stress of a half's sides clear of its ends: E times their elongation in CalculiX.

    From node to node, which is the law of the beam. True stress differs from it by some times the
    strain, which in polymers is several per cent.
    """
    mesh, stations = half_mesh(leaf)
    middle = 0.5 * (stations[1:] + stations[:-1])
    clear = (middle > CLEAR[0] * leaf.length) & (middle < CLEAR[1] * leaf.length)
    elongation = []
    for side in ("RIGHT", "LEFT"):
        nodes = node_set(deck, side)
        before = mesh.nodes[nodes]
        after = before + printed_vectors(printed, "displacements", "PART", nodes)[-1]
        lengths = [np.hypot(*np.diff(line, axis=0).T) for line in (before, after)]
        elongation.append(np.abs(lengths[1] / lengths[0] - 1.0))
    right, left = elongation
    return case.elastic_modulus * float(np.max(np.maximum(right, left[::-1])[clear]))


@pytest.mark.parametrize(("leaf", "case"), [(STEEL_LEAF, STEEL), (POM_LEAF, POM)])
def test_calculix_bends_both_halves_of_an_omega_leaf_with_the_same_force_and_stress(
    require_tool: Callable[[str], str], tmp_path: Path, leaf: OmegaLeaf, case: OmegaCase
) -> None:
    """The right half less the left one, as the comments of the decks say; the beam's stress too."""
    program = require_tool("ccx")
    decks = judge_decks(written(leaf, case))
    known = findings(decks["right-half"], 4)
    np.testing.assert_allclose(known[:, 1], [5.0, 10.0])
    force, stress = {}, {}
    for name, deck in decks.items():
        printed = last_prints(program, deck, tmp_path / name)
        force[name] = reaction(printed, deck, "HUB")[0]
        stress[name] = side_stress(printed, deck, leaf, case)
    assert force["right-half"] - force["left-half"] == pytest.approx(known[-1, 3], rel=1e-3)
    beam = omega_response(leaf, case, WIDTH, np.array([case.stroke]))
    assert known[-1, 3] * WIDTH / SLICE == pytest.approx(beam.force[0], rel=0.02)
    inside = (beam.stations > CLEAR[0] * leaf.length) & (beam.stations < CLEAR[1] * leaf.length)
    assert stress["right-half"] == pytest.approx(beam.right_stress[0, inside].max(), rel=0.05)
    assert stress["left-half"] == pytest.approx(beam.left_stress[0, inside].max(), rel=0.05)
